/* SPDX-License-Identifier: MIT */
/* sigma in memory that is kept from pose to pose. */
#ifndef LRCSI_HOST_RUN_H
#define LRCSI_HOST_RUN_H

#include "host/run/memory.h"

/* lrcs_host_scene_run in an area that is the caller's, for any number of poses. The result is the
   same whatever the area was used for before. */
int lrcsi_host_sigma(const lrcs_host_scene *scene, const lrcs_pose *pose,
                     const lrcs_run_options *options, lrcsi_host_area *area, lrcs_result *result,
                     lrcs_facet_record *records, lrcs_image *image, lrcs_host_error *error);

/* lrcs_host_scene_uncertainty, likewise. */
int lrcsi_host_uncertainty(const lrcs_host_scene *scene, const lrcs_pose *pose,
                           const lrcs_run_options *options, const lrcs_uncertainty_options *how,
                           lrcsi_host_area *area, lrcs_result *result,
                           lrcs_sensitivity *sensitivity, lrcs_uncertainty *uncertainty,
                           lrcs_host_error *error);

#endif
