/* SPDX-License-Identifier: MIT */
/* What commands that show the content of a scene share (lrcs/inventory.h). */
#ifndef LRCS_CLI_INFO_H
#define LRCS_CLI_INFO_H

#include "cli/cli.h"

#include <lrcs/inventory.h>

/* lrcs_host_inventory_make; 0, or CLI_FAILED with the message printed. */
int cli_inventory_make(const cli_args *args, const lrcs_host_scene *base, const lrcs_scene *scene,
                       lrcs_host_inventory *inventory);

/* 1 if a material is listed: the default material is not if it is assigned to no facet. */
int cli_material_listed(const lrcs_host_inventory *inventory, const lrcs_scene *scene,
                        uint32_t material);

/* The surfaces of lrcs info as a table, and as the array "surfaces" of the object that is open. */
void cli_surfaces_table(const lrcs_host_surfaces *surfaces, const lrcs_scene *scene);
void cli_surfaces_json(const lrcs_host_surfaces *surfaces, const lrcs_scene *scene,
                       lrcs_host_json *json);

#endif
