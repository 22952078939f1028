/* SPDX-License-Identifier: MIT */
/* Finer divisions of a scene's curved shapes, for poses whose bound would miss the tolerance. */
#ifndef LRCSI_HOST_LEVELS_H
#define LRCSI_HOST_LEVELS_H

#include <lrcs/load.h>

/* A scene with some of its shapes divided more finely, prepared. */
typedef struct lrcsi_host_level {
    lrcs_host_scene *scene;  /* NULL: it is being built */
    unsigned char *halvings; /* lrcs_build_options.halvings */
    int failed;              /* it could not be built */
    uint32_t users;          /* poses that use it or wait for it */
    uint64_t used;           /* when it was last asked for */
    struct lrcsi_host_level *next;
} lrcsi_host_level;

/* For a scene built with a division, whose recipe and models last as long as it: the list of
   its finer divisions, none of them built yet. NULL if no part is curved, or if there is no
   memory. */
struct lrcsi_host_levels *lrcsi_host_levels_make(const lrcs_host_scene *scene,
                                                 const lrcs_build_options *build);
void lrcsi_host_levels_free(struct lrcsi_host_levels *levels);

/* The level with which the tolerance is likely to be met, given what a pose returned at the level
   `from` (NULL: the scene itself), which the pose no longer uses; part_error_m2[part_count], unless
   NULL, says which parts to divide. NULL if the tolerance is met, if the shapes are not what makes
   the pose miss it, or if they cannot be divided any finer. Built when first asked for; may be
   called from several threads. */
lrcsi_host_level *lrcsi_host_finer(const lrcs_host_scene *scene, const lrcs_run_options *options,
                                   const lrcs_result *result, const double *part_error_m2,
                                   lrcsi_host_level *from);

/* Ends the use of a level, unless NULL. */
void lrcsi_host_level_release(const lrcs_host_scene *scene, lrcsi_host_level *level);

/* Makes the scene the one of a level that lrcsi_host_finer returned, and which is never released.
   Not while other threads use the scene. Returned: the halvings, which last as long as the scene;
   how many of its notices hold for any division. */
uint32_t lrcsi_host_level_adopt(lrcs_host_scene *scene, const lrcsi_host_level *level,
                                const unsigned char **halvings);

#endif
