/* SPDX-License-Identifier: MIT */
/* Which facets of a scene are proved to lie on a plane, cylinder, sphere or cone. */
#ifndef LRCS_CLI_INFO_SURFACES_H
#define LRCS_CLI_INFO_SURFACES_H

#include "cli/cli.h"

#include <lrcs/quadric.h>

typedef struct cli_surfaces {
    lrcs_quadric_region *region; /* the largest area first; the caller frees it */
    uint32_t count;
} cli_surfaces;

/* 0 or an exit code with the message printed. */
int cli_surfaces_find(const lrcs_scene *scene, cli_surfaces *surfaces);

void cli_surfaces_table(const cli_surfaces *surfaces, const lrcs_scene *scene);

/* The array "surfaces", a member of the object that is open. */
void cli_surfaces_json(const cli_surfaces *surfaces, const lrcs_scene *scene, lrcs_host_json *json);

#endif
