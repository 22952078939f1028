/* SPDX-License-Identifier: MIT */
/* Bindings whose names are patterns for names of materials. */
#ifndef LRCSI_HOST_BINDING_H
#define LRCSI_HOST_BINDING_H

#include "host/run/memory.h"

/* Replaces bindings by patterns, and by names that differ in case, by bindings of the names that
   they match. To be called after the models are read and before the scene is built. Status:
   LRCS_OK; LRCS_E_SYSTEM (memory). */
int lrcsi_host_bindings_expand(lrcs_host_scene *scene, lrcs_host_error *error);

/* The names that a NAME (kind LRCS_BIND_NAME) or a MAP_NAME binding can have: of the models'
   materials; for NAME also of the recipe's, and those of the library that parts and maps use. In an
   array of the scene's memory, or NULL if there is no memory. */
const char *const *lrcsi_host_binding_names(lrcs_host_scene *scene, int kind, uint32_t *count);

#endif
