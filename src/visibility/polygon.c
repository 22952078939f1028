/* SPDX-License-Identifier: MIT */
/* The visible regions of all facets as rings of points: counted first, then filled in. What is
   visible is decided in visibility/occlude.c; this file decides which of its pieces become rings,
   and where their corners lie on the facet. */
#include <lrcs/polygon.h>

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/work.h"
#include "visibility/occlude.h"

/* Rings and points per facet: twice what satellites take. ORDINARY_MORE facets are added, for small
   scenes whose facets cut each other into many pieces. */
#define ORDINARY_RINGS  6u
#define ORDINARY_POINTS 24u
#define ORDINARY_MORE   64u

/* The rings so far. What exceeds the room is counted but not written. */
typedef struct ring_list {
    lrcs_ring *ring;
    lrcs_ring_point *point;
    size_t ring_room, point_room;
    size_t rings, points;
    double bound; /* scaled area */
} ring_list;

/* --- one ring --------------------------------------------------------------------------------- */

/* A ring's point on the facet and in the view. Errors, with D the largest coordinate: on the facet
   8 u D (three products and two sums, with barycentric coordinates that add up to 1 within 4 u); in
   the view 4 u D for the first corner and 10 u of the reach, at most 2 D, for the frame. The
   barycentric coordinates add at most 100 u of the reach (visibility/cells/target.h). */
static lrcs_ring_point point_at(const lrcsi_target *t, const double at[2])
{
    const lrcs_prepared *p = t->view->prepared;
    const uint32_t *corner = p->scene->facet[t->facet].corner;
    lrcs_ring_point point;
    double weight[3];
    lrcsi_target_weights(t, at, weight);
    for (int k = 0; k < 3; k++) {
        point.body[k] = weight[0] * p->scene->vertex[corner[0]].x[k] +
                        weight[1] * p->scene->vertex[corner[1]].x[k] +
                        weight[2] * p->scene->vertex[corner[2]].x[k];
    }
    for (int k = 0; k < 2; k++) {
        const double *row = t->view->R[k];
        double first = row[0] * t->origin[0] + row[1] * t->origin[1] + row[2] * t->origin[2];
        point.view[k] = ldexp(first, p->exponent) + ldexp(at[k], p->exponent);
    }
    return point;
}

static void point_add(ring_list *list, const lrcsi_target *t, const double at[2])
{
    if (list->points < list->point_room) {
        list->point[list->points] = point_at(t, at);
    }
    list->points++;
}

static void ring_add(ring_list *list, const lrcsi_target *t, size_t first)
{
    if (list->rings < list->ring_room) {
        list->ring[list->rings] =
            (lrcs_ring){t->facet, (uint32_t)first, (uint32_t)(list->points - first)};
    }
    list->rings++;
}

/* An entirely visible facet keeps its corners, even if rounding makes some coincide in the view. */
static void ring_add_facet(ring_list *list, const lrcsi_target *t, const double (*corner)[2])
{
    size_t first = list->points;
    for (int k = 0; k < 3; k++) {
        point_add(list, t, corner[k]);
    }
    ring_add(list, t, first);
}

/* Of coinciding corners the first is kept. A piece whose area is 0 after rounding is left out. */
static void ring_add_piece(ring_list *list, const lrcsi_target *t, const lrcsi_clip_polygon *piece)
{
    size_t first = list->points;
    const double *before = piece->corner[piece->count - 1];
    for (uint32_t i = 0; i < piece->count; i++) {
        const double *at = piece->corner[i];
        if (at[0] != before[0] || at[1] != before[1]) {
            point_add(list, t, at);
            before = at;
        }
    }
    if (list->points - first >= 3 && lrcsi_clip_area(piece) > 0) {
        ring_add(list, t, first);
    } else {
        list->points = first;
    }
}

/* --- one facet -------------------------------------------------------------------------------- */

/* If the bounds of the visible area include the whole facet or 0, but not both, that is the result:
   its error is at most the difference of the bounds. */
static int facet_add(ring_list *list, lrcsi_occlusion *o, uint32_t facet)
{
    ring_list before = *list;
    const lrcsi_target *target = &o->single.target;
    lrcsi_occlude_open(o, facet);
    while (lrcsi_occlude_next(o)) {
        if (o->undecided) {
            ring_add_piece(list, target, &o->single.piece);
        } else {
            ring_add_facet(list, target, (const double(*)[2])o->single.piece.corner);
        }
    }
    lrcsi_visible_area visible = lrcsi_occlude_close(o);
    list->bound += visible.high - visible.low;
    if (!o->undecided) {
        return LRCS_OK;
    }
    list->bound += o->single.piece_err;
    int all = visible.high >= lrcsi_view_incidence(o->classification->view, facet).projected;
    int none = visible.low <= 0;
    if (all != none) {
        list->rings = before.rings;
        list->points = before.points;
        if (all) {
            ring_add_facet(list, target, (const double(*)[2])target->corner);
        }
    }
    return list->points < LRCS_NONE ? LRCS_OK : LRCS_E_LIMIT;
}

static int facets_add(ring_list *list, lrcsi_occlusion *o)
{
    int status = LRCS_OK;
    for (uint32_t f = 0;
         f < o->classification->view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        status = facet_add(list, o, f);
    }
    return status;
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcs_polygon_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_view_need(prepared), lrcsi_classify_need(prepared));
    need = lrcsi_work_add(need, lrcsi_occlude_need(prepared));
    facets += ORDINARY_MORE;
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, ORDINARY_RINGS * sizeof(lrcs_ring)));
    return lrcsi_work_add(need,
                          lrcsi_work_bytes(facets, ORDINARY_POINTS * sizeof(lrcs_ring_point)));
}

/* 1. Finds the rings of all facets to count them and their points. 2. Finds them again, and stores
   them above the memory used so far. 3. Moves them to the beginning of the work area. */
int lrcs_polygon_run(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                     lrcs_polygons *polygons)
{
    size_t mark = work->used;
    ring_list list = {0};
    lrcsi_view view;
    lrcsi_classification classification;
    lrcsi_occlusion *o = NULL;
    int status = lrcsi_view_make(prepared, pose, work, &view);
    status = status == LRCS_OK ? lrcsi_classify_make(&view, NULL, work, &classification) : status;
    status = status == LRCS_OK ? lrcsi_occlude_make(&classification, NULL, work, &o) : status;
    status = status == LRCS_OK ? facets_add(&list, o) : status;
    if (status == LRCS_OK) {
        list = (ring_list){.ring_room = list.rings, .point_room = list.points};
        list.ring = lrcsi_work_take(work, list.ring_room, sizeof *list.ring);
        list.point = lrcsi_work_take(work, list.point_room, sizeof *list.point);
        status = list.ring && list.point ? facets_add(&list, o) : LRCS_E_MEMORY;
    }
    work->used = mark;
    if (status != LRCS_OK) {
        return status;
    }
    double count = prepared->scene->facet_count;
    *polygons = (lrcs_polygons){.rings = (uint32_t)list.rings, .points = (uint32_t)list.points};
    polygons->ring = lrcsi_work_take(work, list.rings, sizeof *list.ring);
    polygons->point = lrcsi_work_take(work, list.points, sizeof *list.point);
    memmove(polygons->ring, list.ring, list.rings * sizeof *list.ring);
    memmove(polygons->point, list.point, list.points * sizeof *list.point);
    polygons->bound_m2 =
        lrcsi_prepared_area(prepared, list.bound * (LRCSI_OUTWARD_NANO + 2 * count * LRCSI_U));
    return LRCS_OK;
}
