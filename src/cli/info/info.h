/* SPDX-License-Identifier: MIT */
/* The content of a scene, shared by the commands that report it. */
#ifndef LRCS_CLI_INFO_H
#define LRCS_CLI_INFO_H

#include "cli/cli.h"

/* The number of sentences of cli_info_notice, and the size of one. */
#define INFO_NOTICES     4
#define INFO_NOTICE_SIZE 160

typedef struct info_material {
    uint32_t facets;
    cli_sum area;
} info_material;

typedef struct cli_info {
    lrcs_host_scene scene;
    uint32_t parts; /* as files and shapes define them */
    lrcs_mesh_report report;
    info_material *material; /* for each material of the scene */
    lrcs_host_glint *glint;
    uint32_t glint_count;
} cli_info;

/* Reads the command's scene, including the normals in its files, and gathers its properties. The
   caller frees them in any case. 0 or an exit code with the message printed. */
int cli_info_read(const cli_args *args, const lrcs_host_options *options, cli_info *info);

/* The same for a scene that has been read, which must outlive the info. */
int cli_info_make(const cli_args *args, const lrcs_host_scene *base,
                  const lrcs_build_options *build, cli_info *info);
void cli_info_free(cli_info *info);

/* The area of a facet, m2. */
double cli_facet_area(const lrcs_scene *scene, uint32_t facet);

/* 1 if a material is listed: the default material is not if it is assigned to no facet. */
int cli_info_shows(const cli_info *info, uint32_t material);

/* Sentence `i` about the mesh, or NULL; about the glint, only the worst. */
const char *cli_info_notice(const cli_info *info, int i, char text[INFO_NOTICE_SIZE]);

#endif
