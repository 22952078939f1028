/* SPDX-License-Identifier: MIT */
/* The view of a prepared scene for a pose: the facing of each facet (exact), its incidence angle
   with an error bound, and view coordinates. Areas and candidates are computed from view
   coordinates; every decision that their error leaves open is made on the scene's own coordinates.
   */
#ifndef LRCSI_VIEW_H
#define LRCSI_VIEW_H

#include <math.h>

#include <lrcs/pose.h>

#include "base/constant.h"
#include "base/range.h"
#include "scene/meshlets.h"

/* The part of a facet's geometry that depends on direction. Lengths are scaled, as in
   lrcs_prepared. */
typedef struct lrcsi_incidence {
    double cos_theta; /* signed; its sign agrees with facing */
    double tan2;      /* tan^2(theta), infinity if edge-on */
    double tan2_err;  /* relative error of tan2; 1: the true value is in 0 .. tan2; infinity: it is
                        at least tan2, and the facet is edge-on to within 2^-500 rad */
    double projected; /* projected area, >= 0 */
    double error;     /* relative error of projected and of the area */
} lrcsi_incidence;

/* Which facets that face away from the laser hide others and can be visible: those whose
   lrcsi_redundant is less than this. */
enum lrcsi_backs_cast {
    LRCSI_BACKS_NONE = LRCSI_NOT_REDUNDANT,
    LRCSI_BACKS_OPEN = LRCSI_REDUNDANT_IN_SOLID,  /* those that are not in solid shells */
    LRCSI_BACKS_ALL = LRCSI_REDUNDANT_FROM_BEHIND /* on request: also those in solid shells, which
                                                     are proved not to be seen */
};

/* Those that may be seen. */
static inline int lrcsi_backs_needed(const lrcs_prepared *prepared)
{
    return prepared->solid ? LRCSI_BACKS_NONE : LRCSI_BACKS_OPEN;
}

/* What back sides do in a view. */
typedef struct lrcsi_view_backs {
    int cast;    /* a lrcsi_backs_cast */
    int reflect; /* 1: those that cast reflect if their material is two-sided */
} lrcsi_view_backs;

/* A vertex in the view. */
typedef struct lrcsi_view_vertex {
    double x[3]; /* coordinates about prepared->origin: x right, y up, z to the laser */
    double err;  /* bound on the error of each: lrcsi_view_point_err */
} lrcsi_view_vertex;

typedef struct lrcsi_view {
    const lrcs_prepared *prepared;
    double direction[3]; /* to the laser, exact, not normalised */
    double R[3][3];
    double length;  /* |direction| */
    double unit[3]; /* direction / length, rounded; and with unit_low to 2^-100 */
    double unit_low[3];
    signed char *facing;      /* facet: 1 front, -1 back, 0 edge-on or skipped; exact */
    lrcsi_facet_signs cast;   /* facet: its facing if it can be visible and hide others, else 0 */
    lrcsi_view_vertex *point; /* vertex */
    double scale;             /* a power of two; coordinates of the bulk of the scene times scale
                                 are below 1 */
    double low[2], side;      /* the square window around the projection of the live facets */
    uint32_t front, back;     /* live facets facing either way */
    lrcsi_view_backs backs;
} lrcsi_view;

/* A view without coordinates (point, scale and the window), which method facet does not need;
   lrcsi_view_project adds them. Status: LRCS_OK; LRCS_E_MEMORY; those of lrcsi_frame_make;
   LRCS_E_UNSUPPORTED (this thread's arithmetic: base/ieee.h). It stays in the work area. */
size_t lrcsi_view_face_need(const lrcs_prepared *prepared);
int lrcsi_view_face(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcsi_view_backs backs,
                    lrcs_work *work, lrcsi_view *view);
int lrcsi_view_project(lrcs_work *work, lrcsi_view *view);

/* lrcsi_view_face and lrcsi_view_project together. Back sides cast and reflect unless the scene is
   proved to show none. */
size_t lrcsi_view_need(const lrcs_prepared *prepared);
int lrcsi_view_make(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                    lrcsi_view *view);

/* Bound on the error of each of the view coordinates x of a vertex, or of another point of doubles
   in scene coordinates. It grows with the distance from the origin, so that distant parts do not
   affect the accuracy of others. Derivation: point_place in view.c. It exceeds the
   derived bound by 1.9 u of the same sum, which covers the rounding of adding it to a coordinate or
   to a difference of two. */
static inline double lrcsi_view_point_err(const double x[3])
{
    return 10 * LRCSI_U * (fabs(x[0]) + fabs(x[1]) + fabs(x[2]));
}

/* The largest error of a facet's corners. */
static inline double lrcsi_view_facet_err(const lrcsi_view *view, uint32_t facet)
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    return lrcsi_max3(view->point[corner[0]].err, view->point[corner[1]].err,
                      view->point[corner[2]].err);
}

/* Bounds of the true view coordinates of some vertices. Written out, because compilers do not
   unroll short loops. */
static inline void lrcsi_view_bounds(const lrcsi_view *view, const uint32_t *vertex, int count,
                                     double low[3], double high[3])
{
    low[0] = low[1] = low[2] = HUGE_VAL;
    high[0] = high[1] = high[2] = -HUGE_VAL;
    for (int i = 0; i < count; i++) {
        const double *x = view->point[vertex[i]].x;
        double err = view->point[vertex[i]].err;
        low[0] = lrcsi_min(low[0], x[0] - err);
        low[1] = lrcsi_min(low[1], x[1] - err);
        low[2] = lrcsi_min(low[2], x[2] - err);
        high[0] = lrcsi_max(high[0], x[0] + err);
        high[1] = lrcsi_max(high[1], x[1] + err);
        high[2] = lrcsi_max(high[2], x[2] + err);
    }
}

/* 1 if a facet can be visible and hide others: it faces the laser, or back sides cast, and it is
   not redundant in this view. Else 0. */
static inline int lrcsi_view_casts(const lrcsi_view *view, uint32_t facet)
{
    return view->cast.facet[facet] != 0;
}

/* 1 if a facet, if visible, reflects towards the laser; else 0, also for the back of a facet of a
   solid shell that does not cast. */
static inline int lrcsi_view_reflects(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return view->facing[facet] > 0 ||
           (view->facing[facet] < 0 && view->backs.reflect &&
            (p->redundant[facet] != LRCSI_REDUNDANT_IN_SOLID || lrcsi_view_casts(view, facet)) &&
            lrcsi_prepared_material(p, facet)->two_sided);
}

/* The incidence of a facet that is not skipped. */
lrcsi_incidence lrcsi_view_incidence(const lrcsi_view *view, uint32_t facet);

/* The point of a facet, rounded, of which the projection is a point of the view plane. Returns 0 if
   that is not in the facet. */
int lrcsi_view_point_above(const lrcsi_view *view, uint32_t facet, const double x[2],
                           double point[3]);

/* Only its projected area: the same bits, in a quarter of the time. */
double lrcsi_view_projected(const lrcsi_view *view, uint32_t facet);

/* More than the rounding error of a facet's cosine, of the unit normals and the direction: some 30
   u (facets that rounding may have turned further count as grazing: lrcsi_proximity.grazing_cos).
 */
#define LRCSI_VIEW_COS_ERR 1e-9

/* May a true surface whose normals differ from a facet's by at most `turn`, rad, face the laser? A
   normal at less than pi / 2 from the direction takes the facet's to less than pi / 2 + turn, of
   which the cosine is above -sin(turn) >= -turn; beyond a right angle nothing is excluded. The
   facet is not skipped. */
int lrcsi_view_may_face(const lrcsi_view *view, uint32_t facet, double turn);

/* The same: may it face the laser in one place, and face away in another? */
int lrcsi_view_may_show_both(const lrcsi_view *view, uint32_t facet, double turn);

/* The incidence of up to LRCSI_INCIDENCES facets: the same bits, in half the time. Returned:
   incidence[count]. */
#define LRCSI_INCIDENCES 32u
void lrcsi_view_incidences(const lrcsi_view *view, const uint32_t *facet, uint32_t count,
                           lrcsi_incidence *incidence);

/* n . d of a unit normal and a unit direction, both rounded: absolute error at most
   LRCSI_DOT_ERROR. With 1.01 u for each component of n, u for d's, u for each product and sum: at
   most 5.1 u sum |n_k d_k|, and that sum is at most 1. */
#define LRCSI_DOT_ERROR (6 * LRCSI_U)
static inline double lrcsi_view_dot(double x, double y, double z, const double d[3])
{
    return (x * d[0] + y * d[1]) + z * d[2];
}

/* The range of lrcsi_view_dot of the unit normals of a ball. */
static inline void lrcsi_view_dot_range(const lrcsi_normal_ball *ball, const double d[3],
                                        double *low, double *high)
{
    const double dot = lrcsi_view_dot(ball->middle[0], ball->middle[1], ball->middle[2], d);
    *low = dot - ball->radius;
    *high = dot + ball->radius;
}

/* View coordinates of a scene point. */
void lrcsi_view_coordinates(const lrcsi_view *view, const double point[3], double x[3]);

/* The point (x, y) of the view plane, on the plane through the origin, in scaled scene coordinates,
   rounded: the sample line through it along the direction is exact by definition. */
void lrcsi_view_unproject(const lrcsi_view *view, double x, double y, double point[3]);

/* Bound on the distance, in each view coordinate, of such a point from (x, y). */
double lrcsi_view_unproject_err(const lrcsi_view *view, double x, double y);

#endif
