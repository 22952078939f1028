/* SPDX-License-Identifier: MIT */
/* Writes a conformance kit for other implementations: small scenes, attitudes, materials, and the
   truth of each case, in five tiers. lrcs/conformance.h reads it and judges answers to it. */
#ifndef LRCS_KIT_H
#define LRCS_KIT_H

#include <lrcs/conformance.h>

#define LRCS_HOST_KIT_VERSION         1 /* changes whenever a scene, an attitude or a column does */
#define LRCS_HOST_KIT_RESOLUTION_MOST 4096u

typedef struct lrcs_host_kit_options {
    uint32_t tier;                    /* tiers 1 .. tier are written, up to LRCS_HOST_KIT_TIERS */
    uint32_t resolution;              /* side of the pictures in pixels; 0: no pictures */
    void (*begin)(const char *scene); /* called before each scene, for a display; or NULL */
} lrcs_host_kit_options;

typedef struct lrcs_host_kit_size {
    uint32_t scenes, cases;
} lrcs_host_kit_size;

/* Writes a kit into a folder, which is made if it does not exist: README.md, which says all that is
   needed to take part, materials.csv, cases.csv, kit.json, the scenes as OBJ, STL and JSON, and the
   truth of every case by the exact method for the OBJ file as written. The same bytes every time.
   Files of an older kit are overwritten; those of scenes that are not asked for stay.
   Returned: size unless NULL.
   Status: LRCS_OK; LRCS_E_ARGUMENT (options); LRCS_E_SYSTEM (a file, memory; or the folder holds
   files and no kit); LRCS_E_LIMIT (a path of 4096 bytes or more); LRCS_E_UNSUPPORTED (a case cannot
   be clipped exactly, because memory does not suffice); as lrcs_host_scene_read,
   lrcs_host_scene_prepare and lrcs_host_scene_run. */
int lrcs_host_kit_write(const char *folder, const lrcs_host_kit_options *options,
                        lrcs_host_kit_size *size, lrcs_host_error *error);

#endif
