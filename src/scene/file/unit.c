/* SPDX-License-Identifier: MIT */
/* The known units of length, and their values in metres (inch and foot exactly 25.4 mm and 304.8
   mm, the international yard and pound agreement of 1959). */
#include "scene/file/unit.h"

#include <lrcs/status.h>

#include <string.h>

int lrcsi_unit_find(const char *name, double *metres)
{
    static const struct {
        const char name[3];
        double metres;
    } unit[] = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}};
    for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++) {
        if (strcmp(name, unit[i].name) == 0) {
            *metres = unit[i].metres;
            return LRCS_OK;
        }
    }
    return LRCS_E_NAME;
}
