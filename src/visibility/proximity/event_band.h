/* SPDX-License-Identifier: MIT */
/* The band of a facet about one event edge: which fractions of the facet lie so near the edge in
   projection that the true shapes may hide them and their facets not, or the reverse; and which
   sides of the facet an event edge comes near. */
#ifndef LRCSI_EVENT_BAND_H
#define LRCSI_EVENT_BAND_H

#include "base/meter.h"
#include "mesh/box.h"
#include "scene/proximity.h"
#include "visibility/index/edge_search.h"
#include "visibility/proximity/edge_rectangle.h"
#include "visibility/proximity/outline_area.h"
#include "visibility/proximity/part_order.h"
#include "visibility/proximity/proximity_events.h"

/* What the bands of a view are made from. */
typedef struct lrcsi_event_bands {
    const lrcsi_view *view;
    lrcsi_meter *meter;
    lrcsi_proximity_events events;
    lrcsi_part_orders orders;
    lrcsi_box *box;             /* part: that of its facets in the view */
    lrcsi_outline_areas *areas; /* event: the areas along it between the outlines of the true shape
                                   and of its facets */
} lrcsi_event_bands;

/* Upper bound of the bytes for it. It stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY;
   LRCS_E_LIMIT. */
size_t lrcsi_event_bands_need(const lrcs_prepared *prepared);
int lrcsi_event_bands_make(const lrcsi_view *view, lrcsi_meter *meter, lrcs_work *work,
                           lrcsi_event_bands *bands);

/* Which point of the true surface a point of a facet stands for. */
enum lrcsi_correspondence {
    LRCSI_MAPPED, /* the one that the map of facets onto the true surface takes it to */
    LRCSI_ALIGNED /* the one with the same projection: event_band.c, 5 */
};

/* Is an event edge a rim inside the outline of its part? */
int lrcsi_event_rim_is_inside(const lrcsi_event_bands *bands, uint32_t event);

/* Where to look for the event edges that may be near facets. */
typedef struct lrcsi_band_search {
    lrcsi_edge_search edges;
    double reach; /* the largest of their parts */
} lrcsi_band_search;

/* For the event edges near a facet. */
lrcsi_band_search lrcsi_band_search_make(const lrcsi_event_bands *bands, uint32_t facet);

/* For those near any of several facets. The walk meets all of them. */
lrcsi_band_search lrcsi_band_search_around(const lrcsi_event_bands *bands, const uint32_t *facet,
                                           uint32_t count, lrcsi_grid_walk *walk);

/* Is an event edge too far from the facets of a search, for its part? *line: as for
   lrcsi_edge_search_excludes. */
int lrcsi_band_excludes(const lrcsi_event_bands *bands, const lrcsi_band_search *where,
                        uint32_t event, int *line);

/* The sector of a straight wall that a facet lies on, in view coordinates: see event_band.c, 7. */
typedef struct lrcsi_band_sector {
    int known;                    /* 0: the facet lies on none; the other fields are not set */
    double half, cosine, tangent; /* h, cos h, tan h */
    double kappa;                 /* the middle of a side is at kappa times the true radius */
    double origin[3];             /* a point of the axis */
    double radial[3], around[3];  /* unit vectors, of the middle of the sector */
    double rounding;              /* a bound on what rounding adds to displacements */
} lrcsi_band_sector;

/* What the bands of a facet depend on, beside the event edges. */
typedef struct lrcsi_band_facet {
    uint32_t facet;
    const lrcsi_edge_search *where; /* of its lrcsi_band_search */
    int inside;                     /* lrcsi_band_sees_inside */
    lrcsi_displacement displacement;
    double lateral; /* lrcsi_displacement_across the line of sight */
    lrcsi_band_sector sector;
} lrcsi_band_facet;

lrcsi_band_facet lrcsi_band_facet_make(const lrcsi_event_bands *bands, uint32_t facet,
                                       const lrcsi_edge_search *where);

/* May the laser see a facet through an opening of its own part? */
int lrcsi_band_sees_inside(const lrcsi_event_bands *bands, uint32_t facet);

/* The fractions of a facet near an event edge. */
typedef struct lrcsi_event_band {
    double area;          /* of its area, where the edge matters */
    lrcsi_row_range rows; /* around its rows there */
    double gain, loss;
    double unproved; /* where a proof about the edge's part does not hold */
} lrcsi_event_band;

/* The band about an event edge that the search does not exclude. Given also: a
   lrcsi_correspondence. Returns 0 if there is none. */
int lrcsi_event_band_make(lrcsi_event_bands *bands, const lrcsi_band_facet *at, uint32_t event,
                          int correspondence, lrcsi_event_band *band);

/* A part of each side of a facet, from corner k to k + 1, which contains all points of it near
   which event edges pass: where it is empty, the side is free. */
typedef struct lrcsi_near_sides {
    lrcsi_segment_part side[3];
} lrcsi_near_sides;

/* Extends these parts by what is near an event edge that the search does not exclude. Edges of a
   part behind the facet's own do not matter. */
void lrcsi_event_sides(lrcsi_event_bands *bands, const lrcsi_band_facet *at, uint32_t event,
                       lrcsi_near_sides *near);

/* The same for the sides on rims of its own part through which the laser sees a facet of an inside:
   extends near[of the facet that has such a side] by what is near event edges of other parts.
   Given: the event edges that the search does not exclude. */
void lrcsi_event_rims(lrcsi_event_bands *bands, const lrcsi_band_facet *at, const uint32_t *listed,
                      uint32_t count, lrcsi_segment_part *near);

#endif
