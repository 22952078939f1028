/* SPDX-License-Identifier: MIT */
/* A few letters for the legend of a picture, five by seven pixels. */
#ifndef LRCSI_HOST_FONT_H
#define LRCSI_HOST_FONT_H

#include <stdint.h>

#define LRCSI_FONT_ADVANCE 6u /* pixels from one letter to the next, at scale 1 */

/* Draws text with its top left corner at x, y; letters that the font lacks are blank, what
   leaves the picture is cut. */
void lrcsi_font_draw(unsigned char *rgb, uint32_t size, uint32_t x, uint32_t y, uint32_t scale,
                     const char *text, const unsigned char colour[3]);

#endif
