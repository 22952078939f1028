/* SPDX-License-Identifier: MIT */
/* An item buffer as a picture. */
#ifndef LRCSI_IMAGE_H
#define LRCSI_IMAGE_H

#include <lrcs/run.h>

#include "view/view.h"

/* The largest number of pixels along a side, of rasters as well: 2^28 pixels in all. */
#define LRCSI_IMAGE_SIZE_MAX 16384u

/* Given: the view that was drawn; owner[image->size^2], row 0 at the bottom. Returned: the pixels
   of the image, row 0 at the top, and the position of its window. */
void lrcsi_image_fill(const lrcsi_view *view, const uint32_t *owner, lrcs_image *image);

#endif
