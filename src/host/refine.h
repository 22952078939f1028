/* SPDX-License-Identifier: MIT */
/* Finer divisions of a scene's curved shapes, for poses whose bound would miss the tolerance. */
#ifndef LRCSI_HOST_REFINE_H
#define LRCSI_HOST_REFINE_H

#include <lrcs/load.h>

/* For a scene built with a division, whose recipe and models last as long as it: the list of
   its finer divisions, none of them built yet. NULL if no part is curved, or if there is no
   memory. */
struct lrcsi_host_levels *lrcsi_host_levels_make(const lrcs_host_scene *scene,
                                                 const lrcs_build_options *build);
void lrcsi_host_levels_free(struct lrcsi_host_levels *levels);

/* The scene at the division for which the tolerance is likely to be met, given what a pose at the
   division `*level` returned (0: the scene's own), which is replaced. NULL if the tolerance is met,
   if the shapes are not what makes the pose miss it, or if they cannot be divided any finer. Built
   and prepared when first asked for; may be called from several threads. */
const lrcs_host_scene *lrcsi_host_finer(const lrcs_host_scene *scene,
                                        const lrcs_run_options *options, const lrcs_result *result,
                                        uint32_t *level);

/* Makes the scene the one that lrcsi_host_finer returned for `level`, which becomes its own. Not
   while other threads use the scene. Returned: its division; how many of its notices hold for any
   division. */
uint32_t lrcsi_host_level_adopt(lrcs_host_scene *scene, uint32_t level, double *division);

#endif
