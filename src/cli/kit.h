/* SPDX-License-Identifier: MIT */
/* The conformance kit as lrcs vectors writes it and lrcs compare reads it back: the names of its
   files, and its version. README.md of a kit describes their content. */
#ifndef LRCS_CLI_KIT_H
#define LRCS_CLI_KIT_H

#include "cli/cli.h"

/* Changes whenever a scene, an attitude or a column does. */
#define KIT_VERSION 1
#define KIT_TIERS   5

#define KIT_PATH 4096u /* size of a path */
#define KIT_NAME 32u   /* size of the name of a scene, an attitude or a material */

#define KIT_MATERIALS_FILE "materials.csv"
#define KIT_CASES_FILE     "cases.csv"

/* A pose of the kit: the direction is that of the truth, bit for bit; the quaternion adds the roll.
   Status: as lrcs_pose_from_quaternion. */
int cli_kit_pose(const double quaternion[4], const double direction[3], lrcs_pose *pose);

/* Writes "DIR/a/b" to path. 0, or CLI_FAILED with the message printed if it does not fit. */
__attribute__((format(printf, 2, 3))) int cli_kit_path(char path[KIT_PATH], const char *format,
                                                       ...);

/* The length of a facet's outline in the view plane, m. */
double cli_kit_outline(const lrcs_scene *scene, uint32_t facet, const lrcs_pose *pose);

/* Reads scenes/NAME.obj of a kit, assigns materials by these bindings, and prepares it. 0 or
   CLI_FAILED with the message printed; the caller frees the scene in any case. */
int cli_kit_scene(const char *folder, const char *name, const lrcs_binding *binding, uint32_t count,
                  lrcs_host_scene *scene);

#endif
