/* SPDX-License-Identifier: MIT */
/* The files that a scene is read from. */
#ifndef LRCSI_HOST_INPUT_H
#define LRCSI_HOST_INPUT_H

#include "host/run/memory.h"

/* The part of a path after its last slash. */
const char *lrcsi_host_basename(const char *path);

/* lrcs_host_file_read for a scene, which remembers the file. */
int lrcsi_host_input_read(lrcs_host_scene *scene, const char *path, lrcs_host_file *file,
                          lrcs_host_error *error);

#endif
