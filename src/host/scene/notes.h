/* SPDX-License-Identifier: MIT */
/* Notices about a scene as a whole. */
#ifndef LRCSI_HOST_NOTES_H
#define LRCSI_HOST_NOTES_H

#include "host/fail.h"

/* Adds the notices about a scene as it is built, after the first `kept` notices; the others, of
   another division of it, are removed. */
void lrcsi_host_scene_notes(lrcs_host_scene *host, uint32_t kept);

#endif
