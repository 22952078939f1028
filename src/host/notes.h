/* SPDX-License-Identifier: MIT */
/* Notices about a scene as a whole. */
#ifndef LRCSI_HOST_NOTES_H
#define LRCSI_HOST_NOTES_H

#include "host/fail.h"

/* Adds the notices about a scene that was just read and built. */
void lrcsi_host_scene_notes(lrcs_host_scene *host);

#endif
