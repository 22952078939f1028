/* SPDX-License-Identifier: MIT */
/* Which facets reflect from both sides, in addition to those that files specify. */
#ifndef LRCSI_HOST_SIDES_H
#define LRCSI_HOST_SIDES_H

#include "host/fail.h"

/* Makes facets of a scene that is built but not prepared two-sided: "all"; "open", those of shapes
   and of objects of models whose surface is not closed; or those of a part, an object of a model or
   a material of that name. Status: LRCS_OK; LRCS_E_NAME (nothing has that name); LRCS_E_MEMORY; as
   lrcs_mesh_check. */
int lrcsi_host_sides(lrcs_host_scene *host, const char *what, lrcs_host_error *error);

#endif
