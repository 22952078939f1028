/* SPDX-License-Identifier: MIT */
/* Decides the slack between parts. visibility/proximity/proximity_band.c proves that the slack
   suffices. All results are rounded outward: every distance is increased by LRCSI_PROXIMITY_ERR. */
#include "scene/proximity.h"

#include <math.h>

#include "base/constant.h"
#include "base/degrees.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/shape/tessellate.h"

/* The rounding of vertices cannot reverse a facet if |cos(theta)| exceeds this times the error of
   the vertices over the facet's smallest altitude (scene/solid.c). */
#define GRAZING_FACTOR 16.0

int lrcsi_proximity_openings(const lrcs_prepared *p, uint32_t part)
{
    int kind = p->scene->part[part].kind;
    if (p->scene->part[part].solid || kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_DISC) {
        return 0;
    }
    return kind == LRCS_SHAPE_CYLINDER || kind == LRCS_SHAPE_FRUSTUM ? 2 : 1;
}

/* Is a part an open piece of a convex surface? */
static int part_is_open(const lrcs_prepared *p, uint32_t part)
{
    return lrcsi_proximity_openings(p, part) > 0;
}

double lrcsi_proximity_slack(const lrcs_prepared *p, uint32_t part, uint32_t other)
{
    double own = p->proximity.reach[part];
    double theirs = p->proximity.hausdorff[other];
    if (own == 0 && theirs == 0) {
        return 0;
    }
    return theirs + (part_is_open(p, other) ? lrcsi_max(own, theirs) : own) + LRCSI_PROXIMITY_ERR;
}

double lrcsi_proximity_slack_across(const lrcs_prepared *p, uint32_t part, uint32_t other,
                                    double lateral)
{
    double theirs = p->proximity.hausdorff[other];
    double slack = lrcsi_proximity_slack(p, part, other);
    return slack == 0 || (theirs > 0 && part_is_open(p, other))
               ? slack
               : lrcsi_min(slack, theirs + lateral + LRCSI_PROXIMITY_ERR);
}

double lrcsi_proximity_slack_aligned(const lrcs_prepared *p, uint32_t other)
{
    double theirs = p->proximity.hausdorff[other];
    return theirs > 0 ? (part_is_open(p, other) ? 2 : 1) * theirs + LRCSI_PROXIMITY_ERR : 0;
}

/* An upper bound of the sine of an angle, given its cosine to within 1e-14. */
static double sine_of(double cosine)
{
    return sqrt(lrcsi_max(0, (1 - cosine) * (1 + cosine))) + 1e-6;
}

lrcsi_displacement lrcsi_proximity_displacement(const lrcs_prepared *p, uint32_t facet)
{
    uint32_t index = p->scene->facet_part[facet];
    const lrcs_part *part = &p->scene->part[index];
    lrcsi_displacement d = {.reach = p->proximity.reach[index]};
    lrcsi_wall_patch patch;
    if (!part->rigid || d.reach == 0 || p->scene->facet_smooth[facet] == 0 ||
        !lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet,
                                &patch)) {
        return d;
    }
    double sine;
    double cosine;
    lrcsi_degrees_sincos_plain((2.0 * patch.sector + 1.0) * 180.0 / part->divisions.around, &sine,
                               &cosine);
    d.known = 1;
    for (int k = 0; k < 3; k++) {
        d.bound[k] = ldexp(part->bounds.displacement[k], -p->exponent) * LRCSI_OUTWARD_NANO;
        d.direction[0][k] = part->axis[0][k] * cosine + part->axis[1][k] * sine;
        d.direction[1][k] = part->axis[2][k];
        d.direction[2][k] = part->axis[1][k] * cosine - part->axis[0][k] * sine;
    }
    return d;
}

double lrcsi_displacement_along(const lrcsi_displacement *d, const double unit[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        sum += d->bound[i] * (fabs(lrcsi_vec3_dot(d->direction[i], unit)) + 1e-12);
    }
    return d->known ? lrcsi_min(d->reach, sum) : d->reach;
}

/* The tangential direction counts as perpendicular to any vector. */
double lrcsi_displacement_across(const lrcsi_displacement *d, const double unit[3])
{
    double sum = d->bound[2];
    for (int i = 0; i < 2; i++) {
        sum += d->bound[i] * sine_of(lrcsi_vec3_dot(d->direction[i], unit));
    }
    return d->known ? lrcsi_min(d->reach, sum) : d->reach;
}

/* --- facets ----------------------------------------------------------------------------------- */

double lrcsi_proximity_longest(const lrcs_prepared *p, uint32_t facet)
{
    return lrcsi_length_longest_side(lrcsi_prepared_corner(p, facet, 0),
                                     lrcsi_prepared_corner(p, facet, 1),
                                     lrcsi_prepared_corner(p, facet, 2));
}

int lrcsi_proximity_has_rows(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    int is_straight = part->kind == LRCS_SHAPE_CYLINDER || part->kind == LRCS_SHAPE_CONE ||
                      part->kind == LRCS_SHAPE_FRUSTUM;
    return is_straight && part->bounds.patch.turn > 0 && p->scene->facet_smooth[facet] != 0;
}

int lrcsi_proximity_on_round_wall(const lrcs_prepared *p, uint32_t facet)
{
    const uint32_t part = p->scene->facet_part[facet];
    return p->scene->facet_smooth[facet] != 0 && p->proximity.reach[part] > 0 &&
           lrcsi_shape_is_round(p->scene->part[part].kind);
}

/* Heights are measured towards `top`, the corner opposite the side on a circle. A wall's vertices
   are listed from the base up, and its facets by sectors (mesh/shape/tessellate.c): in each sector
   first the facet with its side on the base, then, except on a cone, the one with its side on the
   upper circle. So `top` is the vertex with the largest index in the former and with the smallest
   in the latter. */
lrcsi_row_range lrcsi_proximity_rows(const lrcs_prepared *p, uint32_t facet,
                                     const double *const corner[3], const lrcsi_slice *slice)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    const uint32_t *vertex = p->scene->facet[facet].corner;
    int is_below = part->kind == LRCS_SHAPE_CONE || (facet - part->first_facet) % 2 == 0;
    int top = 0;
    lrcsi_row_range rows = {1, 0};
    if (!lrcsi_proximity_has_rows(p, facet)) {
        return (lrcsi_row_range){0, 1};
    }
    for (int k = 1; k < 3; k++) {
        top = is_below == (vertex[k] > vertex[top]) ? k : top;
    }
    (void)lrcsi_slice_heights(slice, corner[top], corner[(top + 1) % 3], corner[(top + 2) % 3],
                              &rows.low, &rows.high);
    return is_below || rows.low > rows.high ? rows : (lrcsi_row_range){1 - rows.high, 1 - rows.low};
}

/* --- parts ------------------------------------------------------------------------------------ */

/* 0 if the bounds of some part are not known, or if a facet of a curved part has no area, by
   rounding: its other facets then do not determine what the part hides. */
static int parts_known(const lrcs_prepared *p)
{
    const lrcs_scene *scene = p->scene;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        const lrcs_part *part = &scene->part[scene->facet_part[f]];
        if (!lrcsi_prepared_material(p, f)->omitted &&
            (!part->bounds.known || (part->bounds.reach > 0 && p->topology.degenerate[f]))) {
            return 0;
        }
    }
    return 1;
}

/* Fills reach, hausdorff, max_hausdorff and grazing_cos. A facet of a convex part whose vertices
   have errors of at most vertex_err faces the same side as without these errors, and keeps its
   depth order among the part's facets, if |cos(theta)| exceeds GRAZING_FACTOR vertex_err divided by
   its smallest altitude (scene/solid.c). */
static void parts_fill(lrcs_prepared *p)
{
    lrcsi_proximity *proximity = &p->proximity;
    const lrcs_scene *scene = p->scene;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        proximity->reach[i] = ldexp(scene->part[i].bounds.reach, -p->exponent);
        proximity->hausdorff[i] = ldexp(scene->part[i].bounds.hausdorff, -p->exponent);
        proximity->max_hausdorff = lrcsi_max(proximity->max_hausdorff, proximity->hausdorff[i]);
        proximity->grazing_cos[i] = 0;
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        uint32_t i = scene->facet_part[f];
        if (p->skip[f] || proximity->reach[i] == 0) {
            continue;
        }
        double vertex_err = ldexp(scene->part[i].bounds.position_err, -p->exponent) + 4 * LRCSI_U;
        double altitude = p->normal[f].length / lrcsi_proximity_longest(p, f);
        proximity->grazing_cos[i] =
            lrcsi_max(proximity->grazing_cos[i], GRAZING_FACTOR * vertex_err / altitude);
    }
}

size_t lrcsi_proximity_need(const lrcs_scene *scene)
{
    size_t need = 0;
    for (uint32_t i = 0; i < scene->part_count && need == 0; i++) {
        if (scene->part[i].bounds.reach > 0) {
            need =
                lrcsi_work_bytes(4 * (size_t)scene->facet_count + 64, sizeof(lrcsi_proximity_pair));
            need = lrcsi_work_add(need, lrcsi_work_blocks(3, scene->part_count, sizeof(double)));
            need =
                lrcsi_work_add(need, lrcsi_work_bytes(scene->facet_count, sizeof(lrcsi_part_set)));
        }
    }
    return need;
}

int lrcsi_proximity_make(lrcs_prepared *p, lrcs_work *work)
{
    if (!parts_known(p)) {
        return LRCS_OK;
    }
    p->proximity.reach = lrcsi_work_take(work, p->scene->part_count, sizeof *p->proximity.reach);
    p->proximity.hausdorff =
        lrcsi_work_take(work, p->scene->part_count, sizeof *p->proximity.hausdorff);
    p->proximity.grazing_cos =
        lrcsi_work_take(work, p->scene->part_count, sizeof *p->proximity.grazing_cos);
    p->proximity.near =
        lrcsi_work_take_zero(work, p->scene->facet_count, sizeof *p->proximity.near);
    if (!p->proximity.reach || !p->proximity.hausdorff || !p->proximity.grazing_cos ||
        !p->proximity.near) {
        return LRCS_E_MEMORY;
    }
    parts_fill(p);
    return LRCS_OK;
}
