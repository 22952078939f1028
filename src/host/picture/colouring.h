/* SPDX-License-Identifier: MIT */
/* The meaning of a picture's colours: the colour of each facet, and the scale of the colours. */
#ifndef LRCSI_COLOURING_H
#define LRCSI_COLOURING_H

#include <lrcs/picture.h>

#include "host/chart/axis.h"

#define LRCSI_COLOURING_MATERIALS 64u
#define LRCSI_COLOURING_GREY      0x787878u

typedef struct lrcsi_colouring {
    const lrcs_host_picture *picture;
    int scaled;         /* colours are read by a scale */
    lrcsi_axis scale;   /* then this one */
    int greys;          /* something visible returns nothing, and is LRCSI_COLOURING_GREY, shaded */
    double centre[3];   /* of the bounding box of the facets, body frame */
    uint32_t materials; /* of different appearance; only when coloured by material */
    uint32_t material[LRCSI_COLOURING_MATERIALS]; /* one of each */
    uint32_t hue[LRCSI_COLOURING_MATERIALS];      /* its false colour */
    uint32_t more;                                /* number of further ones */
} lrcsi_colouring;

/* Without records, fills only what does not depend on them: everything except the scale. */
lrcsi_colouring lrcsi_colouring_make(const lrcs_host_picture *picture);

/* The background of a picture, and the colour of text on it. */
uint32_t lrcsi_colouring_background(const lrcsi_colouring *colouring);
uint32_t lrcsi_colouring_text_colour(const lrcsi_colouring *colouring);

/* The title of the scale, or NULL. */
const char *lrcsi_colouring_name(const lrcsi_colouring *colouring);

/* The colour of a facet at a point of the observation frame (m, about the body's origin). */
uint32_t lrcsi_colouring_colour(const lrcsi_colouring *colouring, uint32_t facet,
                                const double view[2]);

/* The false colour of a material, and its display name. */
uint32_t lrcsi_colouring_material(const lrcsi_colouring *colouring, uint32_t material);
const char *lrcsi_colouring_material_name(const lrcsi_colouring *colouring, uint32_t material);

/* Does a facet have a slope that its colour depends on? Then height = at[0] + at[1] x + at[2] y on
   its plane, above the scene's centre, m. */
int lrcsi_colouring_slope(const lrcsi_colouring *colouring, uint32_t facet, double at[3]);

/* Does an outline run between two facets that meet in the picture? */
int lrcsi_colouring_outline(const lrcsi_colouring *colouring, uint32_t a, uint32_t b);

#endif
