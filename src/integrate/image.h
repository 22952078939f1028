/* SPDX-License-Identifier: MIT */
/* An item buffer as a picture. */
#ifndef LRCSI_IMAGE_H
#define LRCSI_IMAGE_H

#include "view/view.h"

/* Pixels along a side at most, of rasters too: 2^28 in all. */
#define LRCSI_IMAGE_SIZE_MAX 16384u

/* Given: the view that was drawn; owner, image->size squared, row 0 at the bottom. Returned: the
   rest of the image. */
void lrcsi_image_fill(const lrcsi_view *view, const uint32_t *owner, lrcs_image *image);

#endif
