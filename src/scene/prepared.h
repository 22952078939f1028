/* SPDX-License-Identifier: MIT */
/* A prepared scene: all data that do not depend on direction. Comments name the modules that
   compute them; scene/prepare.h runs all of these. Coordinates are those of the scene times a power
   of two, exactly, so that the largest magnitude lies in [0.5, 1) and nothing overflows; scaled
   coordinates below LRCSI_COORDINATE_MIN become 0. lrcsi_prepared_area converts areas back to
   square metres. */
#ifndef LRCSI_PREPARED_H
#define LRCSI_PREPARED_H

#include <lrcs/prepare.h>

#include <float.h>
#include <math.h>

#include "base/elementary.h"
#include "mesh/contact/intersection.h"
#include "mesh/topology.h"
#include "scene/part_set.h"

/* Scaled coordinates and components of a direction below this count as 0, because the exact
   predicates (base/exact.h) do not allow smaller ones. */
#define LRCSI_COORDINATE_MIN 0x1p-300

/* (b - a) x (c - a) in double-double. Its true value differs by at most `error` in norm. */
typedef struct lrcsi_normal {
    double high[3], low[3];
    double length; /* |N|, relative error at most 4 u beyond error / length */
    double error;  /* at most 2^-90 of the length */
} lrcsi_normal;

/* When a facet is redundant: others are seen instead of it, and it hides nothing that they do not
   hide (scene/coincident.h, scene/solid.h). In this order each includes those before it. */
enum lrcsi_redundant {
    LRCSI_NOT_REDUNDANT = 0,
    LRCSI_REDUNDANT_IN_SOLID = 1,    /* if it faces away: fronts of its solid shell hide it */
    LRCSI_REDUNDANT_FROM_BEHIND = 2, /* if it faces away: its opposite then faces the laser */
    LRCSI_REDUNDANT = 3              /* always; also facets that are skipped */
};

/* The neighbours of facets (scene/neighbours.h). */
typedef struct lrcsi_neighbours {
    /* facet[f].corner[k]: the neighbour of facet f across its side from corner k to k + 1, which
       traverses the side in the opposite sense; the number of facets if there is none (a boundary
       edge); f itself if the edge is irregular or f is always redundant. */
    lrcs_facet *facet;
    uint32_t *irregular; /* irregular edges that have facets, ascending */
    uint32_t irregular_count;
} lrcsi_neighbours;

/* The unit normals of LRCSI_LANES elements of the batches, or of the last ones, are within `radius`
   of `middle`. The radius includes 2^-46, more than what rounding adds to the product of one of
   them and a unit direction. */
typedef struct lrcsi_normal_ball {
    double middle[3], radius;
} lrcsi_normal_ball;

/* Facets that are not skipped, sorted by material, and by index within one. A packet of LRCSI_LANES
   may start at any element: as many elements beyond the last are zero. */
typedef struct lrcsi_batches {
    uint32_t count;
    uint32_t *first;         /* material i: elements first[i] .. first[i + 1] - 1 */
    uint32_t *facet;         /* index in the scene */
    double *normal[3];       /* unit; relative error of each component at most 1.01 u */
    double *area;            /* S, scaled; relative error at most 3 u */
    lrcsi_normal_ball *ball; /* of elements LRCSI_LANES k .. LRCSI_LANES (k + 1) - 1 */
    int redundant;           /* the largest lrcsi_redundant of any of them */
} lrcsi_batches;

/* How many elements of the batches from `start` to `end` lie in the same ball. */
static inline uint32_t lrcsi_batch_lanes(uint32_t start, uint32_t end)
{
    const uint32_t left = LRCSI_LANES - start % LRCSI_LANES;
    return end - start < left ? end - start : left;
}

/* Two facets of different parts, the distance between which is within the slack of these parts
   (lrcsi_proximity_slack). Only what is so near the plane of the other that it matters counts in
   the fractions (visibility/proximity/proximity_band.c, 1.f). */
typedef struct lrcsi_proximity_pair {
    uint32_t facet, other;
    float front_fraction;    /* upper bound of the fraction of the facet's area that is within the
                                slack and in front of the plane of the other */
    float back_fraction;     /* the same, behind that plane */
    float row_low, row_high; /* around its rows with such points (lrcsi_proximity_rows) */
    float gain_fraction; /* at most back_fraction: the same where the true surface around the other
                             facet faces the laser (scene/proximity_contact.h) */
    float loss_fraction; /* likewise, at most front_fraction */
} lrcsi_proximity_pair;

typedef struct lrcsi_proximity {
    double *reach;       /* part: its bounds.reach, scaled; NULL if there is no curved shape among
                            other parts, or if the bounds of some part are not known */
    double *hausdorff;   /* part: its bounds.hausdorff, scaled */
    double *grazing_cos; /* part: rounding cannot reverse a facet with |cos(theta)| above this */
    double max_hausdorff;
    lrcsi_part_set *near;       /* facet on a round wall: the other parts of which a facet is within
                                   LRCSI_PROXIMITY_NEAR times the slack */
    lrcsi_proximity_pair *pair; /* in no order */
    size_t count;
} lrcsi_proximity;

/* Meshlets (scene/meshlets.h): meshlet m has LRCSI_MESHLET_FACETS facets from LRCSI_MESHLET_FACETS
   m on; the last one may have fewer. */
#define LRCSI_MESHLET_FACETS 16u

typedef struct lrcsi_meshlet {
    double low[3], high[3]; /* the box around its facets, except those always redundant */
    uint32_t first_side;
    int has_contacts; /* some facet has a contact or is marked in `met`
                         (mesh/contact/intersection.h) */
} lrcsi_meshlet;

/* A side of a facet of a meshlet that has no neighbour, or one in an earlier meshlet. */
typedef struct lrcsi_meshlet_side {
    uint32_t facet, other;
    uint32_t edge; /* of the topology */
} lrcsi_meshlet_side;

typedef struct lrcsi_meshlets {
    lrcsi_meshlet *meshlet; /* one more than the number of meshlets, for its first_side */
    uint32_t count;
    unsigned char *first; /* facet: the first facet connected with it within the meshlet, counted
                             from the meshlet's first facet */
    lrcsi_meshlet_side *side; /* those of meshlet m:
                                 side[meshlet[m].first_side .. meshlet[m + 1].first_side) */
    /* A compact form, which suffices where all facets of a meshlet have equal properties in a view:
     */
    unsigned char *whole; /* meshlet: 1 if all its facets are connected within it */
    uint32_t *link; /* the meshlets to which the sides of meshlet m lead, each once, and LRCS_NONE
                       if a side has no neighbour: link[first_link[m] .. first_link[m + 1]) */
    uint32_t *first_link;
} lrcsi_meshlets;

static inline uint32_t lrcsi_meshlets_count(uint32_t facet_count)
{
    return facet_count / LRCSI_MESHLET_FACETS + (facet_count % LRCSI_MESHLET_FACETS != 0);
}

/* The number of facets rounded up to whole meshlets. Arrays of so many entries can be processed a
   whole meshlet at a time. */
static inline size_t lrcsi_meshlets_room(uint32_t facet_count)
{
    return (size_t)lrcsi_meshlets_count(facet_count) * LRCSI_MESHLET_FACETS;
}

/* The end of a meshlet that starts at a facet. */
static inline uint32_t lrcsi_meshlet_end(uint32_t start, uint32_t facet_count)
{
    return facet_count - start < LRCSI_MESHLET_FACETS ? facet_count : start + LRCSI_MESHLET_FACETS;
}

/* The extent of a part (scene/extent.h). */
typedef struct lrcsi_extent {
    double low[3], high[3]; /* box around its live facets and true surface; low > high: none live */
    int closed_form; /* 1 if its sigma has a closed form where nothing hides it; that of the inside
                        of an open, two-sided shape is not included */
} lrcsi_extent;

struct lrcs_prepared {
    const lrcs_scene *scene;
    int exponent;              /* scene coordinate = vertex * 2^exponent */
    lrcs_point *vertex;        /* scaled */
    unsigned char *skip;       /* facet: 1 if degenerate or omitted; such a facet is ignored
                                  everywhere */
    unsigned char *redundant;  /* facet: a lrcsi_redundant */
    uint32_t *opposite;        /* facet: the facet that is seen instead of it from behind
                                  (scene/coincident.h), or LRCS_NONE; NULL if no facet has one */
    unsigned char *referenced; /* vertex: 1 if a live facet has it as a corner */
    lrcsi_normal *normal;
    lrcsi_batches batches;             /* facets that are not skipped, by material */
    lrcsi_topology topology;           /* of all facets; its edges may include skipped ones */
    lrcsi_neighbours neighbours;       /* of facets that are not always redundant */
    lrcsi_intersections intersections; /* between facets that are not always redundant, but not
                                          between a facet and its opposite */
    lrcsi_meshlets meshlets;           /* facets that follow one another */
    double centre[3];                  /* of the box around the live facets */
    double radius;                     /* half its longest side: no live vertex is farther from the
                                          centre in any coordinate */
    double origin[3];                  /* of views: the centre of the bulk (scene/bulk.h) */
    double bulk[3];                    /* half the sides of the bulk */
    uint32_t live;      /* facets not skipped: with an area, and a material that is not omitted */
    int convex;         /* live facets lie on one convex surface, outward and one-sided, exactly or
                           by construction; then only facets at grazing incidence can be hidden */
    double grazing_cos; /* if convex: a facet with cos(theta) above this is entirely visible */
    int solid;          /* all live facets are in solid shells (scene/solid.h): back sides are
                           never seen */
    uint32_t solid_shells;      /* how many there are; 0 if the scene is convex by construction */
    int two_sided;              /* some live facet is two-sided */
    int glint, diffuse;         /* some live facet has A > 0; B > 0 */
    int has_curved_shapes;      /* some live part was tessellated from a curved shape */
    lrcsi_proximity proximity;  /* if there are curved shapes among other parts; else
                                   proximity.reach is NULL */
    const lrcsi_extent *extent; /* part: its extent; NULL if no shape has a closed form */
    int articulated;            /* some part has a joint */
    int has_curved_normals;     /* some live facet has curved normals */
};

/* The material of a facet. */
static inline const lrcs_material *lrcsi_prepared_material(const lrcs_prepared *p, uint32_t facet)
{
    return &p->scene->material[p->scene->facet_material[facet]];
}

/* Corner k of a facet, scaled. */
static inline const double *lrcsi_prepared_corner(const lrcs_prepared *p, uint32_t facet, int k)
{
    return p->vertex[p->scene->facet[facet].corner[k]].x;
}

/* A facet's normal, of length 1 to within rounding. */
static inline void lrcsi_prepared_unit_normal(const lrcs_prepared *p, uint32_t facet, double n[3])
{
    for (int k = 0; k < 3; k++) {
        n[k] = p->normal[facet].high[k] / p->normal[facet].length;
    }
}

/* The unit normals at a facet's corners, or NULL if it is flat. */
static inline const lrcs_point *lrcsi_prepared_normals(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_point *n =
        p->scene->corner_normal ? &p->scene->corner_normal[3 * (size_t)facet] : NULL;
    return n && (n->x[0] != 0 || n->x[1] != 0 || n->x[2] != 0) ? n : NULL;
}

/* Converts a scaled area to square metres, exactly except for overflow and underflow. */
static inline double lrcsi_prepared_area(const lrcs_prepared *p, double scaled)
{
    return ldexp(scaled, 2 * p->exponent);
}

/* Converts a scaled bound on areas or on sigma to square metres, rounded outward. If the result is
   denormal, the conversion may round by up to 2^-1075, and so may the conversions of the values to
   which the bound applies, at most two: 2^-1073 covers all of them. */
static inline double lrcsi_prepared_bound(const lrcs_prepared *p, double scaled)
{
    double area = lrcsi_prepared_area(p, scaled);
    return scaled > 0 && area < DBL_MIN ? area + 0x1p-1073 : area;
}

#endif
