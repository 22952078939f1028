/* SPDX-License-Identifier: MIT */
/* A prepared scene seen from a pose: which way each facet faces (exact), its incidence angle with
   its error, and view coordinates. View coordinates carry areas and choose candidates; every
   decision that they leave open is taken on the scene's own coordinates. */
#ifndef LRCSI_VIEW_H
#define LRCSI_VIEW_H

#include "base/meter.h"
#include "scene/prepare.h"

/* The part of a facet's geometry that depends on direction. Lengths are scaled, as in
   lrcs_prepared. */
typedef struct lrcsi_tilt {
    double cos_theta; /* signed; its sign agrees with facing */
    double tan2;      /* tan^2(theta), infinity where edge-on */
    double stretch;   /* relative error of tan2; 1: it lies in 0 .. tan2; infinity: it is at
                         least tan2, the facet being edge-on to 2^-500 rad */
    double projected; /* projected area, >= 0 */
    double error;     /* relative error of projected and of the area */
} lrcsi_tilt;

typedef struct lrcsi_view {
    const lrcs_prepared *prepared;
    double direction[3]; /* to the laser, exact, not normalised */
    double R[3][3];
    double length;  /* |direction| */
    double unit[3]; /* direction / length, rounded; and with unit_low to 2^-100 */
    double unit_low[3];
    signed char *facing; /* facet: 1 front, -1 back, 0 edge-on or skipped; exact */
    lrcs_point *point;   /* vertex, view coordinates about the scene's centre: x right, y up,
                            z to the laser; each off by at most `off` */
    double off;
    double low[2], side;  /* the square window around the projection of the live facets */
    uint32_t front, back; /* live facets facing either way */
    int backs_cast;       /* facets facing away hide others and may be seen: not where the scene is
                             proved to show none, unless the planner was told otherwise */
    int backs_reflect;    /* they reflect, where their material is two-sided */
    lrcsi_meter *meter;   /* steps that may be made to tell what is seen; NULL: no limit */
} lrcsi_view;

/* A view without coordinates (point, off and the window), which method facet does without: they
   follow by lrcsi_view_project. Status: LRCS_OK; LRCS_E_MEMORY; those of lrcsi_frame_make;
   LRCS_E_UNSUPPORTED (this thread rounds otherwise: base/ieee.h). It stays in the work area. */
size_t lrcsi_view_face_need(const lrcs_prepared *prepared);
int lrcsi_view_face(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                    lrcsi_view *view);
int lrcsi_view_project(lrcs_work *work, lrcsi_view *view);

/* Both: a whole view. */
size_t lrcsi_view_need(const lrcs_prepared *prepared);
int lrcsi_view_make(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                    lrcsi_view *view);

/* Does a facet send light back, if seen? */
static inline int lrcsi_view_reflects(const lrcsi_view *view, uint32_t facet)
{
    return view->facing[facet] > 0 || (view->facing[facet] < 0 && view->backs_reflect &&
                                       lrcsi_prepared_material(view->prepared, facet)->two_sided);
}

/* The incidence of a facet that is not skipped. */
lrcsi_tilt lrcsi_view_tilt(const lrcsi_view *view, uint32_t facet);

/* Its projected area alone, the same to the last bit, in a fourth of the time. */
double lrcsi_view_projected(const lrcsi_view *view, uint32_t facet);

/* The incidence of up to LRCSI_TILTS facets, the same to the last bit, in half the time.
   Returned: tilt[count]. */
#define LRCSI_TILTS 32u
void lrcsi_view_tilts(const lrcsi_view *view, const uint32_t *facet, uint32_t count,
                      lrcsi_tilt *tilt);

/* n . d of the facets at `place` and after it in the scene's batches, n and d being unit vectors:
   absolute error at most LRCSI_DOT_ERROR. Returned: dot[], that of places beyond the last being 0.
 */
#define LRCSI_DOT_ERROR 0x1.8p-51
void lrcsi_view_dots(const lrcsi_view *view, uint32_t place, double dot[LRCSI_LANES]);

/* The point (x, y) of the view plane, on the plane through the scene's centre, in scaled scene
   coordinates, rounded: the sample line through it along the direction is exact by definition. */
void lrcsi_view_lift(const lrcsi_view *view, double x, double y, double point[3]);

#endif
