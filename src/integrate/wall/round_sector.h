/* SPDX-License-Identifier: MIT */
/* The sectors of a round wall in a view, and the margins of their sides: the area in projection
   between a side and the arc of the true surface that it stands for
   (integrate/wall/round_pieces.h). */
#ifndef LRCSI_ROUND_SECTOR_H
#define LRCSI_ROUND_SECTOR_H

#include "integrate/plan/plan.h"
#include "integrate/wall/round_surface.h"
#include "integrate/wall/wall_terms.h"
#include "mesh/shape/revolution.h"

/* One side of the wall of a part, in a view. */
typedef struct lrcsi_round_wall {
    const lrcsi_view *view;
    uint32_t part;
    lrcsi_round_surface surface;
    lrcsi_revolution body;
    double unit; /* scaled length of a unit of the shape */
    lrcs_brdf brdf;
    int derivatives; /* 1: sums include what derivatives need; lrcsi_round_wall_make sets 0 */
} lrcsi_round_wall;
lrcsi_round_wall lrcsi_round_wall_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                       uint32_t part, int side);

/* Ratios of e to the largest |v| (integrate/wall/round_surface.h) for which G_max is computed; the
   smallest remainder is used. */
#define LRCSI_ROUND_RATIOS 6
extern const double lrcsi_round_ratios[LRCSI_ROUND_RATIOS];

/* Adds an element of area to the sum, which counts as negative if the area does. Its bound on the
   rounding error includes 16 roundings of the area and of the products with it. */
void lrcsi_round_sum_add(const lrcsi_round_wall *wall, double area, const lrcsi_round_value *value,
                         lrcsi_round_sum *sum);

/* Adds a sum to another, or subtracts it (sign -1). */
void lrcsi_round_sum_append(const lrcsi_round_sum *sum, double sign, lrcsi_round_sum *to);

/* A side of a sector: the arc of its patch and the chord of its facets, with one parameter t in
   -1 .. 1. The arc is a part of a row's circle or of a meridian, with its own parameter, sign t. */
typedef struct lrcsi_round_side {
    int is_row;
    double sign;
    double rho, z, azimuth, polar; /* of the middle, scaled; z of rows, polar of meridians */
    double half;                   /* half the difference between the ends: of azimuths of a row; of
                                      polar angles on the meridian of a sphere or dome, of radii on
                                      that of a paraboloid */
    double chord[2], step[2];      /* the middle of the chord, half of it */
    uint32_t vertex[2];
    uint32_t facet, neighbour; /* the facet that has it, and the one across it, or LRCS_NONE */
    int corner;                /* it is that facet's side from this corner to the next */
} lrcsi_round_side;

/* A sector and its sides, counter-clockwise in the view. */
typedef struct lrcsi_round_sector {
    uint32_t facet[2];
    int facets, sides;
    lrcsi_round_side side[4];
} lrcsi_round_sector;

/* Makes the sector of a facet on the wall. Returns 0 if its corners are not known. */
int lrcsi_round_sector_make(const lrcsi_round_wall *wall, uint32_t facet,
                            lrcsi_round_sector *sector);

/* A margin, or a part of it: the integral of G over it, positive where the arc is outside the
   sector; a bound on the size of that integral over any part of it, infinite if none is known; and
   bounds on its width and area. */
typedef struct lrcsi_round_margin {
    lrcsi_round_sum sum;
    double largest, width, area;
    int pieces; /* in how many pieces it is integrated */
} lrcsi_round_margin;

/* A part of a side's margin: where the parameter t is in these limits. */
typedef struct lrcsi_round_range {
    double from, to;
} lrcsi_round_range;
extern const lrcsi_round_range lrcsi_round_whole_side; /* -1 .. 1 */

/* Its width and area. */
void lrcsi_round_margin_extent(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                               lrcsi_round_range range, lrcsi_round_margin *margin);

/* Makes a margin, except for the integral itself. Returns 0 if only width and area are known, or if
   the tangent of the true surface's inclination to the view plane may exceed 58.1 above it;
   `largest` is infinite then. */
int lrcsi_round_margin_bounds(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                              lrcsi_round_range range, lrcsi_round_margin *margin);

/* Makes a margin. Returns 0 if its integral is not known, because its bounds are not, or because of
   rounding; in the latter case `largest` is finite. */
int lrcsi_round_margin_make(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                            lrcsi_round_range range, lrcsi_round_margin *margin);

#endif
