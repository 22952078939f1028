/* SPDX-License-Identifier: MIT */
/* A kit and the answers to it, as the files that judge them use it. */
#ifndef LRCSI_KIT_H
#define LRCSI_KIT_H

#include "host/kit/table.h"

/* Writes a path; LRCS_E_LIMIT if it does not fit. */
#define LRCSI_KIT_PATH 4096u
__attribute__((format(printf, 3, 4))) int
lrcsi_kit_path(char path[LRCSI_KIT_PATH], lrcs_host_error *error, const char *format, ...);

/* The scene's facets, prepared; the truth's records of a case. Status: as lrcs_host_judge. */
int lrcsi_kit_scene(const lrcs_host_kit *kit, lrcs_host_kit_scene *scene, lrcs_host_error *error);
int lrcsi_kit_records(const lrcs_host_kit *kit, lrcs_host_kit_case *one, lrcs_host_error *error);

/* Runs a scene by the exact method without some effects (lrcs_run_options.without). */
int lrcsi_kit_run(const lrcs_host_scene *host, const lrcs_pose *pose, uint32_t without,
                  lrcs_facet_record *records, lrcs_host_error *error);

/* The case of a line whose columns 0 and 1 are scene and attitude. Status: LRCS_OK; LRCS_E_SYNTAX.
 */
int lrcsi_kit_find(const lrcs_host_kit *kit, const lrcsi_kit_table *table,
                   lrcs_host_kit_case **one);

#endif
