/* SPDX-License-Identifier: MIT */
/* One model file, with the material file beside it. */
#ifndef LRCSI_HOST_MODEL_H
#define LRCSI_HOST_MODEL_H

#include "host/run/memory.h"

/* Reads a model from bytes already in memory into memory that the scene owns; `path` serves
   messages and finds the material file of an OBJ. Notices go to the scene. */
int lrcsi_host_model_read(lrcs_host_scene *scene, const char *path, const lrcs_host_file *file,
                          lrcs_mesh *mesh, lrcs_host_error *error);

/* "FOLDER/NAME", FOLDER being the one that `beside` lies in; NAME itself if it is absolute. Owned
   by the scene; NULL if there is no memory. */
char *lrcsi_host_beside(lrcs_host_scene *scene, const char *beside, const char *name);

#endif
