/* SPDX-License-Identifier: MIT */
/* Colours, 0xRRGGBB, that people with any colour vision can distinguish. */
#ifndef LRCSI_HOST_PALETTE_H
#define LRCSI_HOST_PALETTE_H

#include <stdint.h>

/* One of the eight of lrcs_host_colour. */
uint32_t lrcsi_palette_named(int colour);

/* The colour map viridis, perceptually uniform, from 0 to 1; linear in RGB between knots. */
#define LRCSI_PALETTE_KNOTS 9
uint32_t lrcsi_palette_viridis(double value);

/* A colour for each number; those of neighbours differ. */
uint32_t lrcsi_palette_distinct(uint32_t number);

/* A categorical palette: colours that are distinct on either background of a picture, and from the
   grey of facets that return nothing. O(count). */
void lrcsi_palette_categorical(uint32_t count, uint32_t *colour);

/* The same colour in less light, 0 .. 1. */
uint32_t lrcsi_palette_shade(uint32_t colour, double light);

/* A mixture with white that contains this fraction of the colour. */
uint32_t lrcsi_palette_tint(uint32_t colour, double fraction);

#endif
