/* SPDX-License-Identifier: MIT */
/* Estimates planes, cylinders, spheres and cones: from three facets with corners on them, and by
   least squares from many. It proves nothing, and does not decide which facets belong together. */
#include "analysis/quadric.h"

#include <string.h>

#include "base/length.h"
#include "base/vec3.h"

#define PARAMETERS_MAX 6

/* What is added to the diagonal of the normal equations, relative to it and to its sum, so that the
   pivots of undetermined parameters are positive; and absolutely, for equations that are all 0. */
#define SOLVE_OWN_SHARE   1e-12
#define SOLVE_TRACE_SHARE 1e-28
#define SOLVE_ABSOLUTE    0x1p-1000

/* Normal equations of least squares: matrix x = right. */
typedef struct normal_equations {
    double matrix[PARAMETERS_MAX][PARAMETERS_MAX], right[PARAMETERS_MAX];
    int count;
} normal_equations;

static void equation_add(normal_equations *e, const double row[PARAMETERS_MAX], double right)
{
    for (int i = 0; i < e->count; i++) {
        for (int j = 0; j <= i; j++) {
            e->matrix[i][j] += row[i] * row[j];
        }
        e->right[i] += row[i] * right;
    }
}

/* Cholesky's decomposition; a parameter that the equations do not determine becomes about 0. 0 if
   the result is not finite. */
static int equations_solve(normal_equations *e, double x[PARAMETERS_MAX])
{
    double trace = 0.0;
    for (int i = 0; i < e->count; i++) {
        trace += e->matrix[i][i];
    }
    for (int i = 0; i < e->count; i++) {
        e->matrix[i][i] =
            e->matrix[i][i] * (1.0 + SOLVE_OWN_SHARE) + SOLVE_TRACE_SHARE * trace + SOLVE_ABSOLUTE;
    }
    for (int i = 0; i < e->count; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = e->matrix[i][j];
            for (int k = 0; k < j; k++) {
                sum -= e->matrix[i][k] * e->matrix[j][k];
            }
            if (i == j && !(sum > 0.0)) {
                return 0;
            }
            e->matrix[i][j] = i == j ? sqrt(sum) : sum / e->matrix[j][j];
        }
    }
    for (int i = 0; i < e->count; i++) {
        x[i] = e->right[i];
        for (int k = 0; k < i; k++) {
            x[i] -= e->matrix[i][k] * x[k];
        }
        x[i] /= e->matrix[i][i];
    }
    int finite = 1;
    for (int i = e->count - 1; i >= 0; i--) {
        for (int k = i + 1; k < e->count; k++) {
            x[i] -= e->matrix[k][i] * x[k];
        }
        x[i] /= e->matrix[i][i];
        finite &= isfinite(x[i]) != 0;
    }
    return finite;
}

/* Divides v by its length. Returns 0 if its squares may underflow or overflow. */
static int vector_unit(double v[3])
{
    double length = lrcsi_length(v);
    return length > 0x1p-400 && length < 0x1p400 && lrcsi_length_normalise(v);
}

/* The point at equal distance from the corners of each facet: on the perpendicular bisectors of all
   sides, projected along `axis` unless that is NULL. Relative to corner[0]. */
static int centre_guess(const lrcs_point *corner, int facets, const double *axis, double centre[3])
{
    normal_equations e;
    memset(&e, 0, sizeof e);
    e.count = 3;
    for (int i = 0; i < 3 * facets; i++) {
        double end[2][3];
        double row[PARAMETERS_MAX] = {0};
        int next = i % 3 == 2 ? i - 2 : i + 1;
        lrcsi_vec3_between(corner[0].x, corner[i].x, end[0]);
        lrcsi_vec3_between(corner[0].x, corner[next].x, end[1]);
        for (int j = 0; j < 2 && axis; j++) {
            double along = lrcsi_vec3_dot(end[j], axis);
            for (int k = 0; k < 3; k++) {
                end[j][k] -= along * axis[k];
            }
        }
        lrcsi_vec3_between(end[0], end[1], row);
        equation_add(&e, row,
                     0.5 * (lrcsi_vec3_dot(end[1], end[1]) - lrcsi_vec3_dot(end[0], end[0])));
    }
    double x[PARAMETERS_MAX] = {0};
    int solved = equations_solve(&e, x);
    for (int k = 0; k < 3 && solved; k++) {
        centre[k] = x[k];
    }
    return solved;
}

/* The axis of a cone around which the normals lie, and the point where the facets' planes meet. */
static int cone_guess(const lrcs_point corner[9], double normal[3][3], lrcs_quadric *surface)
{
    lrcsi_vec3_normal(normal[0], normal[1], normal[2], surface->axis);
    normal_equations e;
    memset(&e, 0, sizeof e);
    e.count = 3;
    for (int i = 0; i < 3; i++) {
        const double row[PARAMETERS_MAX] = {normal[i][0], normal[i][1], normal[i][2]};
        double to[3];
        lrcsi_vec3_between(corner[0].x, corner[(ptrdiff_t)3 * i].x, to);
        equation_add(&e, row, lrcsi_vec3_dot(normal[i], to));
    }
    double x[PARAMETERS_MAX] = {0};
    if (!vector_unit(surface->axis) || !equations_solve(&e, x)) {
        return 0;
    }
    double along = 0.0;
    double slope = 0.0;
    for (int k = 0; k < 3; k++) {
        surface->point[k] = corner[0].x[k] + x[k];
    }
    for (int i = 0; i < 9; i++) {
        double q[3];
        lrcsi_vec3_between(surface->point, corner[i].x, q);
        along += lrcsi_vec3_dot(q, surface->axis);
    }
    for (int k = 0; k < 3 && along < 0.0; k++) {
        surface->axis[k] = -surface->axis[k];
    }
    for (int i = 0; i < 9; i++) {
        lrcsi_quadric_at at = lrcsi_quadric_locate(surface, corner[i].x);
        slope += at.rho;
    }
    surface->slope = slope / fabs(along);
    return 1;
}

int lrcsi_quadric_guess(int kind, const lrcs_point corner[9], lrcs_quadric *surface)
{
    double normal[3][3];
    double centre[3] = {0};
    int facets = kind == LRCS_QUADRIC_PLANE ? 1 : kind == LRCS_QUADRIC_CYLINDER ? 2 : 3;
    int found = 1;
    *surface = (lrcs_quadric){.kind = kind};
    for (int i = 0; i < facets; i++) {
        lrcsi_quadric_cross(corner + (ptrdiff_t)3 * i, normal[i]);
        found = found && vector_unit(normal[i]);
    }
    if (found && kind == LRCS_QUADRIC_PLANE) {
        memcpy(surface->axis, normal[0], sizeof surface->axis);
    } else if (found && kind == LRCS_QUADRIC_CYLINDER) {
        lrcsi_vec3_cross(normal[0], normal[1], surface->axis);
        found = vector_unit(surface->axis) && centre_guess(corner, facets, surface->axis, centre);
    } else if (found && kind == LRCS_QUADRIC_SPHERE) {
        found = centre_guess(corner, facets, NULL, centre);
    } else if (found) {
        return cone_guess(corner, normal, surface) && lrcsi_quadric_check(surface) == LRCS_OK;
    }
    for (int k = 0; k < 3; k++) {
        surface->point[k] = corner[0].x[k] + centre[k];
    }
    for (int i = 0; i < 3 * facets && kind != LRCS_QUADRIC_PLANE; i++) {
        surface->radius += lrcsi_quadric_locate(surface, corner[i].x).rho / (3 * facets);
    }
    return found && lrcsi_quadric_check(surface) == LRCS_OK;
}

/* The derivatives of d in the parameters: shifts of the point along u, v and the axis; the axis
   turned towards u and v; the radius or slope. A parameter that the kind lacks has 0. */
static void derivatives(const lrcs_quadric *surface, const lrcsi_quadric_at *at, const double u[3],
                        const double v[3], double row[PARAMETERS_MAX])
{
    memset(row, 0, PARAMETERS_MAX * sizeof *row);
    double outward[2] = {0.0, 0.0}; /* components of r/rho */
    if (surface->kind == LRCS_QUADRIC_PLANE) {
        row[2] = -1.0;
        row[3] = lrcsi_vec3_dot(at->q, u);
        row[4] = lrcsi_vec3_dot(at->q, v);
        return;
    }
    if (!(at->rho > 0.0)) {
        row[2] = at->sin;
        row[5] = surface->kind == LRCS_QUADRIC_CONE ? -at->cos * at->cos * at->cos * at->z : -1.0;
        return;
    }
    outward[0] = lrcsi_vec3_dot(at->r, u) / at->rho;
    outward[1] = lrcsi_vec3_dot(at->r, v) / at->rho;
    for (int i = 0; i < 2; i++) {
        row[i] = -at->cos * outward[i];
        row[3 + i] = -(at->z * at->cos + at->rho * at->sin) * outward[i];
    }
    row[2] = at->sin;
    row[5] = -1.0;
    if (surface->kind == LRCS_QUADRIC_SPHERE) {
        row[2] = -lrcsi_vec3_dot(at->r, surface->axis) / at->rho;
        row[3] = row[4] = 0.0;
    } else if (surface->kind == LRCS_QUADRIC_CONE) { /* d alpha = cos^2 d slope */
        row[5] = -(at->rho * at->sin + at->z * at->cos) * at->cos * at->cos;
    }
}

int lrcsi_quadric_step(lrcs_quadric *surface, const lrcs_scene *scene, const uint32_t *facet,
                       uint32_t count, uint32_t stride)
{
    lrcs_quadric next = *surface;
    double u[3] = {0};
    double v[3];
    double x[PARAMETERS_MAX] = {0};
    normal_equations e;
    memset(&e, 0, sizeof e);
    e.count = PARAMETERS_MAX;
    if (surface->kind == LRCS_QUADRIC_SPHERE) { /* any frame serves */
        next.axis[0] = next.axis[1] = 0.0;
        next.axis[2] = 1.0;
    }
    int thin = fabs(next.axis[0]) < 0.6 ? 0 : 1; /* a coordinate axis that is far from it */
    u[thin] = 1.0;
    lrcsi_vec3_cross(next.axis, u, v);
    int valid = vector_unit(v);
    lrcsi_vec3_cross(v, next.axis, u);
    for (uint32_t i = 0; i < count; i += stride) {
        for (int k = 0; k < 3; k++) {
            double row[PARAMETERS_MAX];
            const double *p = scene->vertex[scene->facet[facet[i]].corner[k]].x;
            lrcsi_quadric_at at = lrcsi_quadric_locate(&next, p);
            derivatives(&next, &at, u, v, row);
            equation_add(&e, row, -at.distance);
        }
    }
    if (!valid || !equations_solve(&e, x)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        next.point[k] += x[0] * u[k] + x[1] * v[k] + x[2] * next.axis[k];
    }
    for (int k = 0; k < 3; k++) {
        next.axis[k] += x[3] * u[k] + x[4] * v[k];
    }
    if (next.kind == LRCS_QUADRIC_CONE) {
        next.slope += x[5];
    } else if (next.kind != LRCS_QUADRIC_PLANE) {
        next.radius += x[5];
    }
    valid = vector_unit(next.axis) && lrcsi_quadric_check(&next) == LRCS_OK;
    for (int k = 0; k < 3 && next.kind == LRCS_QUADRIC_SPHERE; k++) {
        next.axis[k] = 0.0;
    }
    if (valid) {
        *surface = next;
    }
    return valid;
}
