/* SPDX-License-Identifier: MIT */
/* A prepared scene: everything that does not depend on direction. Coordinates here are the
   scene's times a power of two, so that the largest magnitude lies in [0.5, 1): exact, and far
   from overflow; those that come out below LRCSI_COORDINATE_LEAST count as 0. Areas computed from
   them are scaled back by lrcsi_prepared_area. */
#ifndef LRCSI_PREPARE_H
#define LRCSI_PREPARE_H

#include <lrcs/run.h>

#include "mesh/intersection.h"
#include "mesh/topology.h"
#include "scene/across.h"
#include "scene/batch.h"
#include "scene/extent.h"
#include "scene/proximity.h"
#include "scene/runs.h"

/* Scaled coordinates and components of a direction below this count as 0: the exact predicates
   (base/exact.h) ask for that. */
#define LRCSI_COORDINATE_LEAST 0x1p-300

/* (b - a) x (c - a) in double-double. Its true value differs by at most `error` in norm. */
typedef struct lrcsi_normal {
    double high[3], low[3];
    double length; /* |N|, relative error at most 4 u beyond error / length */
    double error;  /* at most 2^-90 of the length */
} lrcsi_normal;

/* When another facet in the very same place is seen instead of a facet, which then hides nothing
   that the other does not hide (scene/coincident.h). */
enum lrcsi_redundant {
    LRCSI_NOT_REDUNDANT = 0,
    LRCSI_REDUNDANT_FROM_BEHIND = 1, /* where it faces away: its twin faces the laser then */
    LRCSI_REDUNDANT = 2              /* always; so are facets that are skipped */
};

struct lrcs_prepared {
    const lrcs_scene *scene;
    int exponent;             /* scene coordinate = vertex * 2^exponent */
    lrcs_point *vertex;       /* scaled */
    unsigned char *skip;      /* facet: 1 where degenerate or omitted; it takes part in nothing */
    unsigned char *redundant; /* facet: a lrcsi_redundant */
    uint32_t *twin; /* facet: the one in the same place wound the other way, or LRCS_NONE; NULL
                       where no facet has any */
    unsigned char *referenced; /* vertex: 1 where a live facet stands on it */
    lrcsi_normal *normal;
    lrcsi_batches batches;   /* facets that are not skipped, by material */
    lrcsi_topology topology; /* of all facets; skipped ones may still stand on its edges */
    lrcsi_across across;     /* across the sides of facets that are not redundant */
    lrcsi_intersections
        intersections;  /* between facets that are not redundant, but not between twins */
    lrcsi_runs runs;    /* facets that follow one another */
    uint32_t *piece;    /* facet: its piece of surface (scene/solid.h), where all are closed;
                           else NULL */
    double centre[3];   /* of the box around the live facets */
    double radius;      /* no live vertex is farther from the centre in any coordinate */
    double origin[3];   /* of views: the centre of the box around most vertices, */
    double bulk[3];     /* and half its sides (scene/bulk.h) */
    uint32_t live;      /* facets not skipped */
    int convex;         /* live facets lie on one convex surface, outward and one-sided: exactly, or
                           by construction; then only facets that graze the light can be hidden */
    double grazing_cos; /* where convex: a facet with cos(theta) above this is wholly visible */
    int solid;          /* winding number >= 0 everywhere, proved: back sides are never seen */
    int two_sided;      /* some live facet is */
    int glint, diffuse; /* some live facet's A, B is not 0 */
    int curved;         /* some live part was tessellated from a curved shape */
    lrcsi_proximity
        proximity; /* where curved shapes stand among others; else proximity.reach is NULL */
    const lrcsi_extent *extent; /* part: where it stands; NULL where no shape has a closed form */
    int articulated;            /* some part stands on a joint */
    int smooth;                 /* some live facet has curved normals */
};

/* The stages of lrcs_prepare_run, which are run in this order: one by one, so that a host can time
   them (the core has no clock). */
enum lrcsi_prepare_stage {
    LRCSI_PREPARE_EDGES,      /* scaled points, welded; edges */
    LRCSI_PREPARE_NEIGHBOURS, /* coincident facets; which facet lies across each side */
    LRCSI_PREPARE_NORMALS,    /* and what else is found facet by facet: box, effects, batches */
    LRCSI_PREPARE_CONTACTS,
    LRCSI_PREPARE_PROOFS, /* solid, convex, what is near curved shapes */
    LRCSI_PREPARE_STAGES
};

/* Checks the scene and starts its preparation. Status: as lrcs_prepare_run. After a failure, here
   or in a stage, the caller releases the work area. */
int lrcsi_prepare_start(const lrcs_scene *scene, lrcs_work *work, lrcs_prepared **prepared);
int lrcsi_prepare_stage(lrcs_prepared *prepared, int stage, lrcs_work *work);

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

/* The unit normals at a facet's corners, or NULL where it is flat. */
static inline const lrcs_point *lrcsi_prepared_normals(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_point *n =
        p->scene->corner_normal ? &p->scene->corner_normal[3 * (size_t)facet] : NULL;
    return n && (n->x[0] != 0 || n->x[1] != 0 || n->x[2] != 0) ? n : NULL;
}

/* An area in scaled units, in square metres. Exact but for overflow and underflow. */
double lrcsi_prepared_area(const lrcs_prepared *p, double scaled);

#endif
