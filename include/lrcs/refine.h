/* SPDX-License-Identifier: MIT */
/* Curved shapes among other parts, divided into facets as finely as a pose needs. */
#ifndef LRCS_REFINE_H
#define LRCS_REFINE_H

#include <lrcs/run.h>

/* Which parts to divide more finely, after a pose whose bound misses the tolerance because of its
   facets. Only the parts that cause the error are, each by a number of halvings of its division;
   all parts alike, if that takes hardly more facets, because more poses can then share them.
   Given: scene, built with the options `build` (its `halvings` are not read) and halvings[parts];
   the options and the result of the pose; part_error_m2[parts] as in lrcs_run_options, or NULL.
   Returned: 1 and finer halvings, with which the tolerance is likely to be met; 0 if it is met, if
   facets are not why it is missed, if no part can be divided any finer, or without memory.
   Work: lrcs_refine_need(part_count) bytes, which it gives back. */
size_t lrcs_refine_need(uint32_t part_count);
int lrcs_refine_halvings(const lrcs_scene *scene, const lrcs_build_options *build,
                         const lrcs_run_options *options, const lrcs_result *result,
                         const double *part_error_m2, lrcs_work *work, unsigned char *halvings);

/* sigma for a pose, of a scene that is built, prepared and run in the caller's work area, and again
   with finer divisions until the bound meets the tolerance.
   Given: recipe, models and build as for lrcs_scene_build, with a `division`: without one nothing
   is divided again; halvings[parts of the recipe], those to begin with; a pose; options (their
   part_error_m2 is not read).
   Returned: result; the halvings that it was found with. If memory or steps do not suffice for a
   finer division, the result is that of the finest one that they suffice for, with its bound, and
   has LRCS_FLAG_TOLERANCE_NOT_MET.
   Status: LRCS_OK; as lrcs_scene_build, lrcs_prepare_run and lrcs_sigma_run for the first division.
   Work: nothing stays in the work area. What a division needs is known only once it is built: a
   ball above a drum over a plate takes 850 bytes a facet. */
int lrcs_refine_run(const lrcs_recipe *recipe, const lrcs_mesh *models,
                    const lrcs_build_options *build, const lrcs_pose *pose,
                    const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                    unsigned char *halvings);

#endif
