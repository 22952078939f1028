/* SPDX-License-Identifier: MIT */
/* Integrates over visible pieces, and over margins at the borders of sets of sectors. It uses the
   sectors that have a partly visible facet, and neighbours of these where that reduces errors, if
   the same side of the surface above their facets faces the laser everywhere, and G is smooth
   enough for the rules there. An arc beyond the limb is not used: there the surface that faces the
   laser is farther than MAX_REACHES from the facet, or G is not bounded above its margin. */
#include "integrate/wall/round_pieces.h"

#include <math.h>
#include <string.h>

#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "integrate/wall/mean_rule.h"
#include "integrate/wall/patch.h"
#include "integrate/wall/patch_visibility.h"
#include "integrate/wall/round_rim.h"
#include "integrate/wall/round_sector.h"
#include "optics/reflect.h"

/* The remainder that a rule should have, relative to G: this times the tolerance, but within these
   limits; or a fraction of what is uncertain because of other parts. */
#define RULE_FRACTION  0x1p-7
#define BAND_FRACTION  0x1p-7
#define REMAINDER_LOW  0x1p-40
#define REMAINDER_HIGH 0x1p-12
/* A sector is not used if the remainder is larger than this, relative to G. */
#define REMAINDER_MAX 0x1p-10
/* A triangle is halved if its remainder is larger than this times the one that it should have:
   heuristic. */
#define TARGET_MISSED 4
/* A triangle is halved at most so often. With every halving the remainder that it should have grows
   by so many bits: only steep ones, of which the projection is small, are halved often. */
#define TRIANGLE_HALVINGS_MAX 11
#define TARGET_BITS           2
/* The largest distance of a facet from the true surface along d, as a multiple of its part's reach.
   Above a margin, which is at most 2 reaches wide, and where the tangent of the surface's
   inclination is at most 58.1 (integrate/wall/round_sector.h), the surface is then within
   60 + 2 (1 + 58.1) < 180 reaches of the facet (visibility/proximity/event_band.c, 5). */
#define MAX_REACHES 60.0
/* How often sectors beside a border where it is not known what is visible join the set: heuristic.
   Such a border is as wide as an event edge's band, mostly less than a facet. */
#define JOIN_ROUNDS 4

/* One side of a wall in a view. */
typedef struct pieces_job {
    const lrcsi_view *view;
    const lrcsi_masked_band *band;
    const lrcsi_visible_area *visible;
    lrcsi_classification *classification; /* for the occlusion */
    lrcsi_meter *meter;
    double target; /* the relative remainder that rules should have */
    lrcsi_round_wall wall;
} pieces_job;

/* --- triangles -------------------------------------------------------------------------------- */

/* The rule over triangles: coordinates r, s in 0 .. 1 of a Gauss-Legendre rule of n points each;
   the point c + r ((a - c) + s (b - a)) has the weight r. Exact up to degree 2 n - 2. */
typedef struct triangle_rule {
    const lrcsi_mean_rule *rule;
    double remainder; /* of G, per unit of area */
} triangle_rule;

/* The rule with the fewest points whose remainder is at most `target`, or else the best one. Given:
   the triangle's centre, and the largest distance of its points from there. */
static triangle_rule triangle_rule_choose(const pieces_job *job, const lrcsi_round_point *centre,
                                          double radius, double target)
{
    double best[LRCSI_MEAN_RULES];
    for (int n = 0; n < LRCSI_MEAN_RULES; n++) {
        best[n] = HUGE_VAL;
    }
    for (int i = 0; i < LRCSI_ROUND_RATIOS; i++) {
        double bound = lrcsi_round_bound(&job->wall.surface, &job->wall.brdf, centre,
                                         lrcsi_round_ratios[i] * radius);
        double q = 1 / lrcsi_round_ratios[i];
        if (!(bound < HUGE_VAL)) {
            break;
        }
        bound *= 2 * q / (1 - q);
        for (int n = 0, degree = 0; n < LRCSI_MEAN_RULES; n++) {
            for (; degree < 2 * lrcsi_mean_rules[n].points - 2; degree++) {
                bound *= q;
            }
            best[n] = lrcsi_min(best[n], bound);
        }
    }
    const int n = lrcsi_mean_rule_choose(best, target);
    return (triangle_rule){&lrcsi_mean_rules[n], best[n] * LRCSI_OUTWARD_NANO};
}

/* Adds the integral of G over the triangle `corner`, of the given area, to a sum. The weight of a
   point has few roundings (lrcsi_round_sum_add); that of the point's position is far below the
   position_err that at.error includes (integrate/wall/round_surface.c). */
static void triangle_add(const pieces_job *job, const lrcsi_round_point *centre,
                         const double corner[3][2], double area, const lrcsi_mean_rule *rule,
                         lrcsi_round_sum *sum)
{
    double x[LRCSI_MEAN_RULE_POINTS];
    double weight[LRCSI_MEAN_RULE_POINTS];
    int count = lrcsi_mean_rule_points(rule, x, weight);
    for (int i = 0; i < count; i++) {
        double r = 0.5 * (1 + x[i]);
        for (int j = 0; j < count; j++) {
            double s = 0.5 * (1 + x[j]);
            double v[2];
            for (int k = 0; k < 2; k++) {
                v[k] = corner[0][k] - centre->x[k] +
                       r * ((corner[1][k] - corner[0][k]) + s * (corner[2][k] - corner[1][k]));
            }
            lrcsi_round_value at =
                lrcsi_round_value_make(&job->wall.surface, &job->wall.brdf, centre, v);
            double share = area * (2 * r * weight[i] * weight[j]);
            lrcsi_round_sum_add(&job->wall, share, &at, sum);
        }
    }
}

/* The wall's point above the centre of a triangle, and the largest distance of the triangle's
   points from there. Returns 0 if there is none. */
static int triangle_centre(const pieces_job *job, const double corner[3][2],
                           lrcsi_round_point *centre, double *radius)
{
    double at[2];
    for (int k = 0; k < 2; k++) {
        at[k] = corner[0][k] + ((corner[1][k] - corner[0][k]) + (corner[2][k] - corner[0][k])) / 3;
    }
    *radius = 0;
    for (int i = 0; i < 3; i++) {
        *radius = lrcsi_max(*radius, lrcsi_length_flat(corner[i][0] - at[0], corner[i][1] - at[1]));
    }
    *radius *= LRCSI_OUTWARD_NANO;
    return lrcsi_round_point_make(&job->wall.surface, at, centre);
}

/* One half of a triangle, across its longest side. */
static void triangle_half(const double corner[3][2], int which, double half[3][2])
{
    double square;
    const int from = lrcsi_clip_longest_side(corner, &square);
    const double *a = corner[from];
    const double *b = corner[(from + 1) % 3];
    for (int k = 0; k < 2; k++) {
        const double middle = 0.5 * (a[k] + b[k]);
        half[0][k] = which == 0 ? a[k] : middle;
        half[1][k] = which == 0 ? middle : b[k];
        half[2][k] = corner[(from + 2) % 3][k];
    }
}

/* Adds the integral over a counter-clockwise triangle, one that has been halved `halved` times, if
   the remainder of a rule is small enough. wanted: the remainder, relative to G, that it should
   have if it is not halved. Returns 1 if it was added; 0 if the triangle is to be halved; -1 if the
   surface is not known, or rounding too large. */
static int triangle_try(const pieces_job *job, const double corner[3][2], double area,
                        double wanted, int halved, lrcsi_round_sum *sum)
{
    const double here[2] = {0, 0};
    lrcsi_round_point point;
    double radius;
    if (!triangle_centre(job, corner, &point, &radius)) {
        return -1;
    }
    const lrcsi_round_value at =
        lrcsi_round_value_make(&job->wall.surface, &job->wall.brdf, &point, here);
    const double scale = at.glint + at.diffuse;
    const double target = lrcsi_min(REMAINDER_MAX, ldexp(wanted, TARGET_BITS * halved));
    const double most = halved < TRIANGLE_HALVINGS_MAX
                            ? lrcsi_min(REMAINDER_MAX, TARGET_MISSED * target)
                            : REMAINDER_MAX;
    const triangle_rule rule = triangle_rule_choose(job, &point, radius, target * scale);
    if (!(rule.remainder <= most * scale)) {
        return halved < TRIANGLE_HALVINGS_MAX ? 0 : -1;
    }
    triangle_add(job, &point, corner, area, rule.rule, sum);
    sum->remainder += area * rule.remainder;
    return isfinite(sum->glint + sum->diffuse + sum->rounding + sum->remainder) ? 1 : -1;
}

/* Adds the integral over a counter-clockwise triangle. While the remainder would be too large, it
   is halved across its longest side: near the outline G varies most in one direction. wanted: as
   above. Returns 0 if the integral is not known. */
static int triangle_integrate(const pieces_job *job, const double corner[3][2], double area,
                              double wanted, lrcsi_round_sum *sum)
{
    double waiting[TRIANGLE_HALVINGS_MAX + 1][3][2];
    int halved[TRIANGLE_HALVINGS_MAX + 1] = {0};
    int count = 1;
    int added = 1;
    memcpy(waiting[0], corner, sizeof waiting[0]);
    while (count > 0 && added >= 0) {
        double triangle[3][2];
        const int times = halved[--count];
        memcpy(triangle, waiting[count], sizeof triangle);
        added = triangle_try(job, (const double(*)[2])triangle, ldexp(area, -times), wanted, times,
                             sum);
        for (int i = 0; i < 2 && added == 0; i++) {
            triangle_half((const double(*)[2])triangle, i, waiting[count]);
            halved[count++] = times + 1;
        }
    }
    return added > 0;
}

/* --- facets ----------------------------------------------------------------------------------- */

/* A bound on G above a facet; infinite if the surface is not known, or too far away. Because the
   wall is convex, its height along d is a concave function on the view plane: it lies between its
   linear interpolation over the corners, and its tangent plane at the centre. So its distance from
   the facet is at most the largest distance of either from the facet's corners. The normals above a
   facet turn from its own by at most `turn` on its own patch. On a patch next to it they turn by at
   most 2 `turn` from those on the common border, so by 3 `turn` from its own. No other patch is
   above the facet: on fine meshes because it would be farther than MAX_REACHES away, on coarse ones
   because the margins between, which must be known, are no wider than a facet. */
static double facet_bound(const pieces_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_round_surface *surface = &job->wall.surface;
    const uint32_t *corner = p->scene->facet[facet].corner;
    double at[3][2];
    double apart = 0;
    const lrcsi_incidence incidence = lrcsi_view_incidence(job->view, facet);
    double radius;
    lrcsi_round_point centre;
    for (int i = 0; i < 3; i++) {
        at[i][0] = job->view->point[corner[i]].x[0];
        at[i][1] = job->view->point[corner[i]].x[1];
    }
    if (!triangle_centre(job, (const double(*)[2])at, &centre, &radius)) {
        return HUGE_VAL;
    }
    for (int i = 0; i < 3; i++) {
        const double z = surface->side * job->view->point[corner[i]].x[2];
        lrcsi_round_point point;
        if (!lrcsi_round_point_make(surface, at[i], &point)) {
            return HUGE_VAL;
        }
        double slope = lrcsi_vec3_dot(centre.g, surface->axis[0]) * (at[i][0] - centre.x[0]) +
                       lrcsi_vec3_dot(centre.g, surface->axis[1]) * (at[i][1] - centre.x[1]);
        apart = lrcsi_max(apart, fabs(lrcsi_round_height(surface, &point) - z));
        apart = lrcsi_max(apart, fabs(lrcsi_round_height(surface, &centre) - slope / centre.s - z));
    }
    lrcsi_reflection bound = lrcsi_reflect_bound(&job->wall.brdf, atan(sqrt(incidence.tan2)),
                                                 3 * surface->part->bounds.patch.turn);
    return apart < MAX_REACHES * p->proximity.reach[p->scene->facet_part[facet]]
               ? (bound.glint + bound.diffuse) * LRCSI_OUTWARD_NANO
               : HUGE_VAL;
}

/* Integrates over the visible pieces of a facet. Returns 0 if that is not possible. */
static int facet_integrate(const pieces_job *job, lrcsi_occlusion *o, uint32_t facet,
                           lrcsi_wall_terms *terms)
{
    const lrcsi_view *view = job->view;
    const lrcsi_target *target = &o->single.target;
    double projected = lrcsi_view_projected(view, facet);
    double bound = facet_bound(job, facet);
    const double uncertain =
        job->band->whole->gain_aligned[facet] + job->band->whole->loss_aligned[facet];
    const double wanted = lrcsi_max(job->target, BAND_FRACTION * uncertain);
    lrcsi_round_sum sum = {.glint = 0};
    double area_err = 0;
    int known = 1;
    if (!(bound < HUGE_VAL)) {
        return 0;
    }
    (void)lrcsi_occlude_open(o, facet);
    while (lrcsi_occlude_next(o)) {
        const lrcsi_clip_polygon *polygon = &o->single.piece;
        double origin[3];
        lrcsi_view_coordinates(view, target->origin, origin);
        for (uint32_t i = 2; i < polygon->count && known; i++) {
            double area = lrcsi_clip_fan_area(polygon->corner[0], polygon->corner[i - 1],
                                              polygon->corner[i], &area_err);
            double corner[3][2];
            for (int k = 0; k < 2; k++) {
                corner[0][k] = origin[k] + polygon->corner[0][k];
                corner[1][k] = origin[k] + polygon->corner[i - 1][k];
                corner[2][k] = origin[k] + polygon->corner[i][k];
            }
            known = !target->needle &&
                    (!(area > 0) ||
                     triangle_integrate(job, (const double(*)[2])corner, area, wanted, &sum));
        }
    }
    area_err += lrcsi_occlude_piece_err(o);
    lrcsi_visible_area area = lrcsi_occlude_close(o);
    double gain =
        lrcsi_min(job->band->whole->gain_aligned[facet] * projected, projected - area.low);
    double loss = lrcsi_min(job->band->whole->loss_aligned[facet] * projected, area.high);
    *terms = (lrcsi_wall_terms){.way = LRCSI_WALL_PIECES,
                                .sum = sum,
                                .visibility =
                                    bound * (area.high - area.low + area_err) * LRCSI_OUTWARD_NANO,
                                .above = bound * lrcsi_max(0, gain) * LRCSI_OUTWARD_NANO,
                                .below = bound * lrcsi_max(0, loss) * LRCSI_OUTWARD_NANO,
                                .bound = bound * LRCSI_OUTWARD_NANO};
    return known;
}

/* Is it uncertain what is visible of a facet or of its patch? */
static int facet_is_uncertain(const pieces_job *job, uint32_t facet)
{
    const lrcsi_masked_band *band = job->band;
    int state = lrcsi_patch_state_of(job->view, facet, job->visible, band);
    return state == LRCSI_PATCH_PARTIAL ||
           (state == LRCSI_PATCH_HIDDEN && lrcsi_masked_mismatch(band, facet) > 0);
}

/* Does a facet belong to the part, and show this side of its wall to the laser? */
static int is_on_side(const pieces_job *job, uint32_t facet)
{
    return job->view->prepared->scene->facet_part[facet] == job->wall.part &&
           job->view->facing[facet] == job->wall.surface.side;
}

/* May a facet be used, apart from its visibility? The gain is known only of facets of round walls
   that show the laser their outside, or an inside that reflects. */
static int facet_is_eligible(const pieces_job *job, uint32_t facet)
{
    return is_on_side(job, facet) && job->band->whole->gain_aligned[facet] >= 0 &&
           lrcsi_patch_exists(job->view->prepared, facet);
}

/* Does a facet belong to the set, on this side of the wall? It may be LRCS_NONE. */
static int is_in_set(const pieces_job *job, const lrcsi_wall_terms *terms, uint32_t facet)
{
    return facet != LRCS_NONE && terms[facet].way == LRCSI_WALL_PIECES && is_on_side(job, facet);
}

/* Makes the sector of a facet. Returns 0 unless it is in the set, and the facet its first one: so
   the facets of a part name each sector of the set once. */
static int sector_of_set(const pieces_job *job, const lrcsi_wall_terms *terms, uint32_t facet,
                         lrcsi_round_sector *sector)
{
    return is_in_set(job, terms, facet) && lrcsi_round_sector_make(&job->wall, facet, sector) &&
           sector->facet[0] == facet;
}

/* May all facets of a sector be used, apart from what the integrals need? */
static int sector_is_eligible(const pieces_job *job, const lrcsi_wall_terms *terms,
                              const lrcsi_round_sector *sector)
{
    for (int i = 0; i < sector->facets; i++) {
        if (!facet_is_eligible(job, sector->facet[i]) ||
            terms[sector->facet[i]].way == LRCSI_WALL_PATCH) {
            return 0;
        }
    }
    return 1;
}

/* A part of a side of a sector, and what is visible beside it: 1 everything, 0 nothing, -1 not
   known. */
typedef struct side_part {
    lrcsi_round_range range;
    int state;
} side_part;
enum { SIDE_PARTS = 3 };

/* What is visible beside a free part of a side. For a uniform facet that is known. For any other
   facet a query decides, at a point so close to the middle of the part that what holds for the part
   holds for the point. from, to: as fractions of the way from the facet's corner k to k + 1. */
static int free_part_state(const pieces_job *job, const lrcsi_occlusion *o,
                           const lrcsi_round_side *side, double from, double to)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t f = side->facet;
    const int k = side->corner;
    const double *a = lrcsi_prepared_corner(p, f, k);
    const double *b = lrcsi_prepared_corner(p, f, (k + 1) % 3);
    const double *c = lrcsi_prepared_corner(p, f, (k + 2) % 3);
    const double inward =
        lrcsi_min(0.25, p->proximity.reach[job->wall.part] / lrcsi_length_longest_side(a, b, c));
    double point[3];
    for (int i = 0; i < 3; i++) {
        double middle = a[i] + 0.5 * (from + to) * (b[i] - a[i]);
        point[i] = middle + inward * (c[i] - middle);
    }
    int answer = o->answer[f];
    if (job->classification->undecided[f]) {
        answer = lrcsi_query_point(&o->facets, f, point, job->meter);
    }
    return answer == LRCSI_QUERY_VISIBLE ? 1 : answer == LRCSI_QUERY_HIDDEN ? 0 : -1;
}

/* Divides a side into the part near which event edges may pass, where it is not known what is
   visible, and the free parts before and after it. Returns how many there are. */
static int side_divide(const pieces_job *job, const lrcsi_occlusion *o,
                       const lrcsi_round_side *side, side_part part[SIDE_PARTS])
{
    const lrcs_scene *scene = job->view->prepared->scene;
    const lrcsi_segment_part near = job->band->whole->sides[side->facet].side[side->corner];
    const int is_free = lrcsi_segment_part_is_empty(near);
    const double limit[SIDE_PARTS + 1] = {0, is_free ? 1 : near.from, is_free ? 1 : near.to, 1};
    const double sign = side->vertex[0] == scene->facet[side->facet].corner[side->corner] ? 1 : -1;
    int count = 0;
    for (int i = 0; i < SIDE_PARTS; i++) {
        if (limit[i] < limit[i + 1]) {
            const double from = sign * (2 * limit[i] - 1);
            const double to = sign * (2 * limit[i + 1] - 1);
            part[count++] =
                (side_part){{lrcsi_min(from, to), lrcsi_max(from, to)},
                            i == 1 ? -1 : free_part_state(job, o, side, limit[i], limit[i + 1])};
        }
    }
    return count;
}

/* A bound on the integral over a part of a side's margin, given that part. Where none is known of
   the part, because its middle is steeper than the side's, that of the whole side holds for it.
   Infinite if neither is known. */
static double margin_largest(const pieces_job *job, const lrcsi_round_side *side,
                             const lrcsi_round_margin *part)
{
    lrcsi_round_margin whole = {.largest = part->largest};
    if (!isfinite(part->largest)) {
        (void)lrcsi_round_margin_bounds(&job->wall, side, lrcsi_round_whole_side, &whole);
    }
    return whole.largest;
}

/* Adds the margins at the border of the set to a facet of a sector: one of which something is
   visible, because the sum leaves out hidden ones. If there is none, margins are errors. */
static void sector_add_margins(const pieces_job *job, const lrcsi_occlusion *o,
                               const lrcsi_round_sector *sector, lrcsi_wall_terms *terms)
{
    const double reach = job->view->prepared->proximity.reach[job->wall.part];
    const uint32_t to =
        job->visible[sector->facet[0]].high > 0 ? sector->facet[0] : sector->facet[1];
    for (int i = 0; i < sector->sides; i++) {
        const lrcsi_round_side *side = &sector->side[i];
        side_part part[SIDE_PARTS];
        const int parts =
            is_in_set(job, terms, side->neighbour) ? 0 : side_divide(job, o, side, part);
        for (int k = 0; k < parts; k++) {
            lrcsi_round_margin margin;
            if (part[k].state == 0) {
                continue;
            }
            const int known = lrcsi_round_margin_make(&job->wall, side, part[k].range, &margin);
            if (known && part[k].state > 0 && margin.width <= 2 * reach &&
                job->visible[to].high > 0) {
                lrcsi_round_sum_append(&margin.sum, 1, &terms[to].sum);
            } else {
                terms[to].sum.remainder += margin_largest(job, side, &margin);
            }
        }
    }
}

/* Are the margins of all sides of a sector known? */
static int sector_has_margins(const pieces_job *job, const lrcsi_round_sector *sector)
{
    int known = 1;
    for (int i = 0; i < sector->sides && known; i++) {
        lrcsi_round_margin margin;
        known = lrcsi_round_margin_bounds(&job->wall, &sector->side[i], lrcsi_round_whole_side,
                                          &margin);
    }
    return known;
}

/* Integrates over the pieces of a sector that is eligible and has margins. It joins the set if all
   integrals are known. */
static void sector_integrate(const pieces_job *job, lrcsi_occlusion *o,
                             const lrcsi_round_sector *sector, lrcsi_wall_terms *terms)
{
    int known = 1;
    for (int i = 0; i < sector->facets && known; i++) {
        known = facet_integrate(job, o, sector->facet[i], &terms[sector->facet[i]]);
    }
    for (int i = 0; i < sector->facets; i++) {
        terms[sector->facet[i]].way = known ? LRCSI_WALL_PIECES : LRCSI_WALL_FACET;
    }
}

/* A bound on the integral over the parts of a side's margin where it is not known what is visible;
   infinite if a bound is not known. */
static double unknown_margin(const pieces_job *job, const lrcsi_occlusion *o,
                             const lrcsi_round_side *side)
{
    side_part part[SIDE_PARTS];
    const int parts = side_divide(job, o, side, part);
    double sum = 0;
    for (int k = 0; k < parts; k++) {
        lrcsi_round_margin margin;
        if (part[k].state < 0) {
            (void)lrcsi_round_margin_bounds(&job->wall, side, part[k].range, &margin);
            sum += margin_largest(job, side, &margin);
        }
    }
    return sum;
}

/* By how much the set's errors from margins fall if a sector joins it: by those of the sides to
   sectors of the set, less those of its other sides. */
static double joining_gain(const pieces_job *job, const lrcsi_occlusion *o,
                           const lrcsi_round_sector *sector, const lrcsi_wall_terms *terms)
{
    double gain = 0;
    for (int i = 0; i < sector->sides; i++) {
        const lrcsi_round_side *side = &sector->side[i];
        const double error = unknown_margin(job, o, side);
        gain += is_in_set(job, terms, side->neighbour) ? error : -error;
    }
    return gain;
}

/* Integrates over the neighbours of a sector of the set across sides beside which it is not known
   what is visible, where that reduces the error. Returns 1 if any of them joined the set. */
static int sector_add_neighbours(const pieces_job *job, lrcsi_occlusion *o,
                                 const lrcsi_round_sector *sector, lrcsi_wall_terms *terms)
{
    int any = 0;
    for (int i = 0; i < sector->sides; i++) {
        const uint32_t neighbour = sector->side[i].neighbour;
        lrcsi_round_sector next;
        if (neighbour != LRCS_NONE && terms[neighbour].way == LRCSI_WALL_FACET &&
            is_on_side(job, neighbour) && unknown_margin(job, o, &sector->side[i]) > 0 &&
            lrcsi_round_sector_make(&job->wall, neighbour, &next) &&
            sector_is_eligible(job, terms, &next) && sector_has_margins(job, &next) &&
            joining_gain(job, o, &next, terms) > 0) {
            sector_integrate(job, o, &next, terms);
            any |= terms[neighbour].way == LRCSI_WALL_PIECES;
        }
    }
    return any;
}

/* Integrates over the pieces of one side of a wall:
   1. over those of the sectors that have an uncertain facet and of which all is known;
   2. over those of their neighbours where it is not known what is visible between them;
   3. adds the rim of an open part above its inside; where it is not known, the inside is left out;
   4. adds the margins at the border of the set.
   The occlusion is made when it is first needed. Returns 0 if there is no memory for it. */
static int wall_integrate(pieces_job *job, lrcsi_occlusion **o, lrcs_work *work,
                          lrcsi_wall_terms *terms)
{
    const lrcs_part *part = job->wall.surface.part;
    const uint32_t end = part->first_facet + part->facet_count;
    int any = 0;
    lrcsi_round_sector sector;
    for (uint32_t f = part->first_facet; f < end; f++) { /* 1 */
        if (!facet_is_eligible(job, f) || !facet_is_uncertain(job, f) ||
            !lrcsi_round_sector_make(&job->wall, f, &sector) ||
            (f != sector.facet[0] && facet_is_uncertain(job, sector.facet[0])) || /* tried before */
            !sector_is_eligible(job, terms, &sector) || !sector_has_margins(job, &sector)) {
            continue;
        }
        if (!*o && lrcsi_occlude_make(job->classification, job->meter, work, o) != LRCS_OK) {
            return 0;
        }
        sector_integrate(job, *o, &sector, terms);
        any |= terms[f].way == LRCSI_WALL_PIECES;
    }
    int joined = any;
    for (int round = 0; round < JOIN_ROUNDS && joined; round++) { /* 2 */
        joined = 0;
        for (uint32_t f = part->first_facet; f < end; f++) {
            if (sector_of_set(job, terms, f, &sector)) {
                joined |= sector_add_neighbours(job, *o, &sector, terms);
            }
        }
    }
    if (any && job->wall.surface.side < 0 && /* 3 */
        !lrcsi_round_rim_add(&job->wall, job->band->whole, job->visible, *o, job->meter, work,
                             terms)) {
        for (uint32_t f = part->first_facet; f < end; f++) {
            if (is_in_set(job, terms, f)) {
                terms[f].way = LRCSI_WALL_FACET;
            }
        }
    }
    for (uint32_t f = part->first_facet; f < end && any; f++) { /* 4 */
        if (sector_of_set(job, terms, f, &sector)) {
            sector_add_margins(job, *o, &sector, terms);
        }
    }
    return 1;
}

/* Both sides of all round walls, except where a glint is so narrow that rounding matters. */
void lrcsi_round_pieces_make(lrcsi_classification *classification, const lrcsi_plan *plan,
                             const lrcsi_clear_shapes *clear, const lrcsi_masked_band *band,
                             const lrcsi_visible_area *visible, int derivatives, lrcsi_meter *meter,
                             lrcs_work *work, lrcsi_wall_terms *terms)
{
    const lrcsi_view *view = classification->view;
    const lrcs_scene *scene = view->prepared->scene;
    const size_t mark = work->used;
    pieces_job job = {.view = view,
                      .band = band,
                      .visible = visible,
                      .classification = classification,
                      .meter = meter};
    lrcsi_occlusion *o = NULL;
    int has_memory = 1;
    job.target =
        lrcsi_min(REMAINDER_HIGH, lrcsi_max(REMAINDER_LOW, RULE_FRACTION * plan->tolerance));
    for (uint32_t i = 0; i < scene->part_count && plan->patches; i++) {
        if (!lrcsi_shape_is_round(scene->part[i].kind) || !scene->part[i].rigid ||
            lrcsi_is_clear_shape(clear, i)) {
            continue;
        }
        for (int side = 1; side >= -1 && has_memory; side -= 2) {
            job.wall = lrcsi_round_wall_make(view, plan, i, side);
            job.wall.derivatives = derivatives;
            if (!(job.wall.brdf.A > 0) || job.wall.brdf.s >= LRCSI_PATCH_SLOPE_MIN) {
                has_memory = wall_integrate(&job, &o, work, terms);
            }
        }
    }
    work->used = mark;
    for (uint32_t f = 0; f < scene->facet_count && meter->spent; f++) {
        if (terms[f].way == LRCSI_WALL_PIECES) {
            terms[f].way = LRCSI_WALL_FACET;
        }
    }
}
