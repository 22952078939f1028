/* SPDX-License-Identifier: MIT */
/* From a prepared scene and a pose to a view. It decides facing, exactly, and the window; it does
   not decide what hides what. */
#include "view/view.h"

#include <math.h>
#include <string.h>

#include "base/bits.h"
#include "base/constant.h"
#include "base/exact.h"
#include "base/ieee.h"
#include "base/length.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "view/frame.h"
#include "view/product.h"

/* N . d and N x d. */
static inline double normal_products(const double *high, const double *low, const double *d,
                                     double *cross)
{
    cross[0] = lrcsi_product_cross(high, low, d, 1, 2);
    cross[1] = lrcsi_product_cross(high, low, d, 2, 0);
    cross[2] = lrcsi_product_cross(high, low, d, 0, 1);
    return lrcsi_product_dot(high, low, d);
}

/* A bound on the absolute errors of the components of N x d and of N . d, per unit of |d|, apart
   from one rounding of the result (view/product.h): the products and sums in double-double, and the
   error of N. */
static double normal_err(const lrcsi_normal *n)
{
    return 21 * LRCSI_U * LRCSI_U * n->length + n->error;
}

/* The sign of N . d: from doubles if their error allows it (N.high is N within u, three products
   and two sums: 4 u sum |N_k d_k| and N's own error), else exactly. */
static signed char facing_of(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    const double *d = view->direction;
    const double part[3] = {n->high[0] * d[0], n->high[1] * d[1], n->high[2] * d[2]};
    double dot = part[0] + part[1] + part[2];
    double size = fabs(part[0]) + fabs(part[1]) + fabs(part[2]);
    if (fabs(dot) > 8 * LRCSI_U * size + 2 * n->error * view->length) {
        return dot > 0 ? 1 : -1;
    }
    return (signed char)lrcsi_exact_orient(lrcsi_prepared_corner(view->prepared, facet, 0),
                                           lrcsi_prepared_corner(view->prepared, facet, 1),
                                           lrcsi_prepared_corner(view->prepared, facet, 2), d);
}

/* A dot product below this multiple of its error is computed exactly. Any value is right: this one
   keeps the relative error of the others below 8 u, and the exact computation, which is slow, for
   facets within some 2^-50 of edge-on. */
#define GRAZING_DOT 0x1p50
/* A cross product above this multiple of its error has a relative error of e <= 1e-3. The relative
   error of its square, with respect to the true one, is then at most 1 / (1 - e)^2 - 1 < 2.004 e,
   for which SQUARE_ERROR e is stated. Any value above 40 would do: for e below 1/40 it is less than
   2.1 e. */
#define CROSS_CERTAIN 1000
#define SQUARE_ERROR  2.1
/* Closer to edge-on than this, only a lower bound of tan^2 is known: about 2^1000, still a double.
 */
#define GRAZING_MIN 0x1p-500

/* |N . d| and a bound on its error: the computed value or, near grazing incidence, the exact one to
   2 u. Closer to edge-on than GRAZING_MIN it is replaced by that bound. */
typedef struct incidence_dot {
    double value, err;
    int replaced;
} incidence_dot;

static incidence_dot incidence_dot_of(const lrcsi_view *view, uint32_t facet, double product,
                                      double dot_err)
{
    incidence_dot dot = {fabs(product), dot_err, 0};
    if (!(dot.value > GRAZING_DOT * dot_err)) {
        dot.value =
            fabs(lrcsi_exact_dot(lrcsi_prepared_corner(view->prepared, facet, 0),
                                 lrcsi_prepared_corner(view->prepared, facet, 1),
                                 lrcsi_prepared_corner(view->prepared, facet, 2), view->direction));
        dot.err = 2 * LRCSI_U * dot.value;
    }
    double smallest = GRAZING_MIN * view->prepared->normal[facet].length * view->length;
    if (dot.value < smallest) {
        dot.value = smallest;
        dot.replaced = 1;
    }
    return dot;
}

static double incidence_projected(const lrcsi_view *view, incidence_dot dot)
{
    return dot.value / (2 * view->length);
}

/* tan^2 = |N x d|^2 / (N . d)^2. Near normal incidence the cross product is smaller than its
   error, and only an upper bound of tan^2 is known; near grazing incidence the dot product is, and
   is computed exactly. */
static lrcsi_incidence incidence_make(const lrcsi_view *view, uint32_t facet, double product,
                                      const double cross_product[3])
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    int facing = view->facing[facet];
    lrcsi_incidence incidence = {0, HUGE_VAL, 0, 0, 0};
    if (facing == 0) {
        return incidence;
    }
    double dot_err = normal_err(n) * view->length;
    double cross = lrcsi_length(cross_product);
    incidence_dot dot = incidence_dot_of(view, facet, product, dot_err);
    double relative = dot.err / dot.value;
    incidence.error = dot.replaced ? 2 : 2 * relative + n->error / n->length + 8 * LRCSI_U;
    incidence.tan2_err = 4 * relative + 12 * LRCSI_U;
    if (cross > CROSS_CERTAIN * dot_err) {
        incidence.tan2_err += SQUARE_ERROR * dot_err / cross;
    } else {
        cross += dot_err;
        incidence.tan2_err = 1;
    }
    incidence.tan2_err = dot.replaced ? HUGE_VAL : incidence.tan2_err;
    incidence.tan2 = (cross / dot.value) * (cross / dot.value);
    incidence.cos_theta = facing * lrcsi_min(1, dot.value / (n->length * view->length));
    incidence.projected = incidence_projected(view, dot);
    return incidence;
}

int lrcsi_view_point_above(const lrcsi_view *view, uint32_t facet, const double x[2],
                           double point[3])
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *corner = p->scene->facet[facet].corner;
    double weight[3];
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = view->point[corner[(k + 1) % 3]].x;
        const double *b = view->point[corner[(k + 2) % 3]].x;
        weight[k] = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
        weight[k] *= view->facing[facet]; /* 1: the corners run counter-clockwise */
        sum += weight[k];
    }
    for (int k = 0; k < 3; k++) {
        point[k] = 0;
        for (int i = 0; i < 3; i++) {
            point[k] += weight[i] / sum * lrcsi_prepared_corner(p, facet, i)[k];
        }
    }
    return sum > 0 && weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0;
}

double lrcsi_view_projected(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    if (view->facing[facet] == 0) {
        return 0;
    }
    double product = lrcsi_product_dot(n->high, n->low, view->direction);
    return incidence_projected(
        view, incidence_dot_of(view, facet, product, normal_err(n) * view->length));
}

/* Of a facet's normal; not a number if it has none. */
static double normal_cosine(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    return lrcsi_vec3_dot(n->high, view->direction) / (n->length * view->length);
}

int lrcsi_view_may_face(const lrcsi_view *view, uint32_t facet, double turn)
{
    return !(normal_cosine(view, facet) <= -(turn + LRCSI_VIEW_COS_ERR));
}

int lrcsi_view_may_show_both(const lrcsi_view *view, uint32_t facet, double turn)
{
    return !(fabs(normal_cosine(view, facet)) >= turn + LRCSI_VIEW_COS_ERR);
}

lrcsi_incidence lrcsi_view_incidence(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    double cross[3];
    double dot = normal_products(n->high, n->low, view->direction, cross);
    return incidence_make(view, facet, dot, cross);
}

/* Normals as a structure of arrays, so that compilers vectorize the loops. Unused lanes repeat the
   first facet, so that the trip count is constant. */
typedef struct normal_lanes {
    double high[3][LRCSI_INCIDENCES], low[3][LRCSI_INCIDENCES];
    double dot[LRCSI_INCIDENCES], cross[3][LRCSI_INCIDENCES];
} normal_lanes;

static void lanes_multiply(normal_lanes *lanes, const double *d)
{
    for (uint32_t i = 0; i < LRCSI_INCIDENCES; i++) {
        const double high[3] = {lanes->high[0][i], lanes->high[1][i], lanes->high[2][i]};
        const double low[3] = {lanes->low[0][i], lanes->low[1][i], lanes->low[2][i]};
        double cross[3];
        lanes->dot[i] = normal_products(high, low, d, cross);
        lanes->cross[0][i] = cross[0];
        lanes->cross[1][i] = cross[1];
        lanes->cross[2][i] = cross[2];
    }
}

void lrcsi_view_incidences(const lrcsi_view *view, const uint32_t *facet, uint32_t count,
                           lrcsi_incidence *incidence)
{
    normal_lanes lanes;
    for (uint32_t i = 0; i < LRCSI_INCIDENCES; i++) {
        const lrcsi_normal *n = &view->prepared->normal[facet[i < count ? i : 0]];
        for (int k = 0; k < 3; k++) {
            lanes.high[k][i] = n->high[k];
            lanes.low[k][i] = n->low[k];
        }
    }
    lanes_multiply(&lanes, view->direction);
    for (uint32_t i = 0; i < count; i++) {
        const double cross[3] = {lanes.cross[0][i], lanes.cross[1][i], lanes.cross[2][i]};
        incidence[i] = incidence_make(view, facet[i], lanes.dot[i], cross);
    }
}

/* Let p be the difference of the point and the origin, both doubles. The rounded difference has an
   error of u |p|; the row has an error of 4 u (view/frame.h), which changes the coordinate by 4 u
   |p|; three products and two sums add 3 u |p|. Together 8.01 u |p|, at most 8.1 u of the sum of
   |coordinates|. */
static inline void point_place(const lrcsi_view *view, const double point[3], double x[3])
{
    const double *o = view->prepared->origin;
    const double p[3] = {point[0] - o[0], point[1] - o[1], point[2] - o[2]};
    x[0] = view->R[0][0] * p[0] + view->R[0][1] * p[1] + view->R[0][2] * p[2];
    x[1] = view->R[1][0] * p[0] + view->R[1][1] * p[1] + view->R[1][2] * p[2];
    x[2] = view->R[2][0] * p[0] + view->R[2][1] * p[1] + view->R[2][2] * p[2];
}

void lrcsi_view_coordinates(const lrcsi_view *view, const double point[3], double x[3])
{
    point_place(view, point, x);
}

void lrcsi_view_unproject(const lrcsi_view *view, double x, double y, double point[3])
{
    for (int k = 0; k < 3; k++) {
        point[k] = view->prepared->origin[k] + (view->R[0][k] * x + view->R[1][k] * y);
    }
}

/* As vectors: the rows have errors of 4 u each, two products and a sum one of 2 u (|x| + |y|), and
   the last sum one of u times its result, whose length is below |x| + |y| plus sqrt(3) times the
   origin's largest coordinate. */
double lrcsi_view_unproject_err(const lrcsi_view *view, double x, double y)
{
    const double *o = view->prepared->origin;
    double origin = lrcsi_max3(fabs(o[0]), fabs(o[1]), fabs(o[2]));
    return LRCSI_U * (8 * (fabs(x) + fabs(y)) + 2 * origin);
}

/* Makes all of these facets face the same way. */
static void facings_alike(lrcsi_view *view, const uint32_t *facet, uint32_t count, int facing)
{
    for (uint32_t i = 0; i < count; i++) {
        view->facing[facet[i]] = (signed char)facing;
    }
    view->front += facing > 0 ? count : 0;
    view->back += facing < 0 ? count : 0;
}

/* Facing is the sign of the dot product of unit vectors. It is computed exactly if the product may
   have the wrong sign, which is so rare that one test for all lanes suffices. The ball of their
   normals decides most lanes at once. */
static void view_facings(lrcsi_view *view)
{
    const lrcs_prepared *p = view->prepared;
    const lrcsi_batches *b = &p->batches;
    const uint64_t magnitude = UINT64_MAX >> 1;
    const uint64_t error = lrcsi_bits_of(LRCSI_DOT_ERROR);
    const double d[3] = {view->unit[0], view->unit[1], view->unit[2]};
    memset(view->facing, 0, p->scene->facet_count);
    for (uint32_t place = 0; place < b->count; place += LRCSI_LANES) {
        const uint32_t *facet = b->facet + place;
        const uint32_t count = lrcsi_batch_lanes(place, b->count);
        double low;
        double high;
        lrcsi_view_dot_range(&b->ball[place / LRCSI_LANES], d, &low, &high);
        if (low > LRCSI_DOT_ERROR || high < -LRCSI_DOT_ERROR) {
            facings_alike(view, facet, count, low > 0 ? 1 : -1);
            continue;
        }
        const double *x = b->normal[0] + place;
        const double *y = b->normal[1] + place;
        const double *z = b->normal[2] + place;
        uint32_t back = 0;
        uint64_t undecided = 0; /* sign bit: some |dot| is at most the error */
        double dot[LRCSI_LANES];
        for (int i = 0; i < LRCSI_LANES; i++) {
            dot[i] = lrcsi_view_dot(x[i], y[i], z[i], d);
            undecided |= (lrcsi_bits_of(dot[i]) & magnitude) - error - 1;
        }
        for (uint32_t i = 0; i < count; i++) {
            uint32_t behind = (uint32_t)(lrcsi_bits_of(dot[i]) >> 63);
            view->facing[facet[i]] = (signed char)(1 | -(int)behind);
            back += behind;
        }
        view->back += back;
        view->front += count - back;
        for (uint32_t i = 0; undecided >> 63 && i < count; i++) {
            if (fabs(dot[i]) <= LRCSI_DOT_ERROR) {
                signed char facing = facing_of(view, facet[i]);
                view->front -= view->facing[facet[i]] > 0;
                view->back -= view->facing[facet[i]] < 0;
                view->front += facing > 0;
                view->back += facing < 0;
                view->facing[facet[i]] = facing;
            }
        }
    }
}

/* The facing of a facet that casts, else 0: a front casts unless it is always redundant, a back
   only if backs like it do (lrcsi_backs_cast). */
static inline signed char cast_of(signed char facing, unsigned char redundant, int backs)
{
    return (signed char)((facing > 0 && redundant != LRCSI_REDUNDANT) -
                         (facing < 0 && redundant < backs));
}

/* The same of a whole meshlet: the trip count is constant, so that compilers vectorize the loop. */
static void cast_meshlet(const signed char *restrict facing,
                         const unsigned char *restrict redundant, int backs,
                         signed char *restrict cast)
{
    for (uint32_t i = 0; i < LRCSI_MESHLET_FACETS; i++) {
        cast[i] = cast_of(facing[i], redundant[i], backs);
    }
}

static void view_cast(lrcsi_view *view)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t count = p->scene->facet_count;
    const uint32_t whole = count - count % LRCSI_MESHLET_FACETS;
    for (uint32_t f = 0; f < whole; f += LRCSI_MESHLET_FACETS) {
        cast_meshlet(view->facing + f, p->redundant + f, view->backs.cast, view->cast.facet + f);
    }
    for (uint32_t f = whole; f < count; f++) {
        view->cast.facet[f] = cast_of(view->facing[f], p->redundant[f], view->backs.cast);
    }
    lrcsi_facet_signs_finish(count, &view->cast);
}

size_t lrcsi_view_face_need(const lrcs_prepared *prepared)
{
    const uint32_t count = prepared->scene->facet_count;
    return lrcsi_work_add(lrcsi_work_bytes(count, 1), lrcsi_facet_signs_need(count));
}

int lrcsi_view_face(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcsi_view_backs backs,
                    lrcs_work *work, lrcsi_view *view)
{
    lrcsi_view v = {.prepared = prepared, .backs = backs};
    int status =
        lrcsi_ieee_conforms() ? lrcsi_frame_make(pose, v.direction, v.R) : LRCS_E_UNSUPPORTED;
    if (status != LRCS_OK) {
        return status;
    }
    const size_t mark = work->used;
    const uint32_t count = prepared->scene->facet_count;
    v.facing = lrcsi_work_take(work, count, sizeof *v.facing);
    if (!v.facing || !lrcsi_facet_signs_take(count, work, &v.cast)) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    v.length = sqrt(lrcsi_vec3_dot(v.direction, v.direction));
    static const double no_low[3] = {0, 0, 0};
    lrcsi_inverse inverse = lrcsi_length_inverse(v.direction, no_low, v.length);
    for (int k = 0; k < 3; k++) {
        lrcsi_dd d = lrcsi_inverse_times(&inverse, v.direction[k], 0);
        v.unit[k] = d.hi;
        v.unit_low[k] = d.lo;
    }
    view_facings(&v);
    view_cast(&v);
    *view = v;
    return LRCS_OK;
}

int lrcsi_view_project(lrcs_work *work, lrcsi_view *view)
{
    const lrcs_prepared *p = view->prepared;
    view->point = lrcsi_work_take(work, p->scene->vertex_count, sizeof *view->point);
    if (!view->point) {
        return LRCS_E_MEMORY;
    }
    /* The window: the square over the longer side of the projected box, centred. */
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < p->scene->vertex_count; i++) {
        lrcsi_view_vertex at;
        point_place(view, p->vertex[i].x, at.x);
        at.err = lrcsi_view_point_err(at.x);
        view->point[i] = at;
        if (p->referenced[i]) {
            lrcsi_range_extend(at.x[0], &low[0], &high[0]);
            lrcsi_range_extend(at.x[1], &low[1], &high[1]);
        }
    }
    if (p->live > 0) {
        view->side = lrcsi_max(high[0] - low[0], high[1] - low[1]);
        view->low[0] = 0.5 * (low[0] + high[0]) - 0.5 * view->side;
        view->low[1] = 0.5 * (low[1] + high[1]) - 0.5 * view->side;
    }
    double bulk = p->bulk[0] + p->bulk[1] + p->bulk[2];
    view->scale = bulk > 0 ? ldexp(1, -ilogb(bulk) - 1) : 1;
    return LRCS_OK;
}

size_t lrcsi_view_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_add(
        lrcsi_view_face_need(prepared),
        lrcsi_work_bytes(prepared->scene->vertex_count, sizeof(lrcsi_view_vertex)));
}

int lrcsi_view_make(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                    lrcsi_view *view)
{
    lrcsi_view v;
    size_t mark = work->used;
    const lrcsi_view_backs backs = {lrcsi_backs_needed(prepared), !prepared->solid};
    int status = lrcsi_view_face(prepared, pose, backs, work, &v);
    if (status == LRCS_OK) {
        status = lrcsi_view_project(work, &v);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *view = v;
    return LRCS_OK;
}
