/* SPDX-License-Identifier: MIT */
/* What a scene holds, between the commands that tell it. */
#ifndef LRCS_CLI_INFO_H
#define LRCS_CLI_INFO_H

#include "cli/cli.h"

/* Where the glint error passes this, a run is warned about. */
#define INFO_GLINT_WARN 1e-2

/* How many sentences cli_info_notice knows, and the room for one. */
#define INFO_NOTICES     4
#define INFO_NOTICE_SIZE 160

typedef struct info_material {
    uint32_t facets;
    cli_sum area;
} info_material;

typedef struct cli_info {
    lrcs_host_scene scene;
    uint32_t parts; /* as files and shapes count them */
    lrcs_mesh_report report;
    info_material *material; /* of each of the scene's */
    lrcs_host_glint *glint;
    uint32_t glint_count;
} cli_info;

/* Reads the command's scene with what its files say of normals, and looks at all of it. To be freed
   in any case. 0 or an exit code with the message printed. */
int cli_info_read(const cli_args *args, const lrcs_host_options *options, cli_info *info);

/* The same of a scene that has been read, which must outlive the info. */
int cli_info_make(const cli_args *args, const lrcs_host_scene *base,
                  const lrcs_build_options *build, cli_info *info);
void cli_info_free(cli_info *info);

/* Curved parts of models whose flat facets are too coarse for their glint, as info finds them:
   none where normals are curved. The list is the caller's to free. 0 or CLI_FAILED. */
int cli_coarse_glint(const lrcs_host_scene *base, const lrcs_build_options *build,
                     lrcs_host_glint **list, uint32_t *count);

/* The area of a facet, m2. */
double cli_facet_area(const lrcs_scene *scene, uint32_t facet);

/* Whether a material is worth a line: the default is not when nothing wears it. */
int cli_info_shows(const cli_info *info, uint32_t material);

/* Sentence `i` about the mesh, or NULL; of the glint, the worst only. */
const char *cli_info_notice(const cli_info *info, int i, char text[INFO_NOTICE_SIZE]);

#endif
