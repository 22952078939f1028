/* SPDX-License-Identifier: MIT */
/* Converts an item buffer to a picture with row 0 at the top, and computes the position of its
   window relative to the body's origin. visibility/raster/raster_draw.c has decided which facet
   owns each pixel. */
#include "integrate/image.h"

#include <math.h>
#include <string.h>

void lrcsi_image_fill(const lrcsi_view *view, const uint32_t *owner, lrcs_image *image)
{
    const lrcs_prepared *p = view->prepared;
    double corner[2] = {view->low[0], view->low[1] + view->side};
    for (int k = 0; k < 2; k++) {
        const double *axis = view->R[k];
        const double *c = p->origin;
        corner[k] += axis[0] * c[0] + axis[1] * c[1] + axis[2] * c[2];
    }
    image->left_m = ldexp(corner[0], p->exponent);
    image->top_m = ldexp(corner[1], p->exponent);
    image->side_m = ldexp(view->side, p->exponent);
    size_t size = image->size;
    for (size_t y = 0; y < size; y++) {
        memcpy(image->facet + y * size, owner + (size - 1 - y) * size, size * sizeof *owner);
    }
}
