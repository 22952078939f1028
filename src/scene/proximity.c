/* SPDX-License-Identifier: MIT */
/* Decides the slack between parts, and which facets are within it.
   visibility/proximity/proximity_band.c proves that the slack suffices. All results are rounded
   outward: every distance is increased by LRCSI_PROXIMITY_ERR. */
#include "scene/proximity.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/degrees.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/contact/tree_capsule.h"
#include "mesh/contact/tree_walk.h"
#include "mesh/shape/tessellate.h"
#include "mesh/slice.h"

/* The rounding of vertices cannot reverse a facet if |cos(theta)| exceeds this times the error of
   the vertices over the facet's smallest altitude (scene/solid.c). */
#define GRAZING_FACTOR 16.0

/* Products of vectors whose square is less may underflow. */
#define LEAST_SQUARE 0x1p-900

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

/* --- one pair --------------------------------------------------------------------------------- */

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

/* Heights are measured towards `top`, the corner opposite the side on a circle. A wall's vertices
   are listed from the base up, and its facets by sectors (mesh/shape/tessellate.c): in each sector
   first the facet with its side on the base, then, except on a cone, the one with its side on the
   upper circle. So `top` is the vertex with the largest index in the former and with the smallest
   in the latter. */
double lrcsi_proximity_rows(const lrcs_prepared *p, uint32_t facet, const double *const corner[3],
                            const lrcsi_slice *slice)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    const uint32_t *vertex = p->scene->facet[facet].corner;
    int is_below = part->kind == LRCS_SHAPE_CONE || (facet - part->first_facet) % 2 == 0;
    int top = 0;
    if (!lrcsi_proximity_has_rows(p, facet)) {
        return 1;
    }
    for (int k = 1; k < 3; k++) {
        top = is_below == (vertex[k] > vertex[top]) ? k : top;
    }
    return lrcsi_slice_extent(slice, corner[top], corner[(top + 1) % 3], corner[(top + 2) % 3]);
}

/* Are all corners of `other` farther than `slack` from the plane of a facet, on one side of it? */
static int pair_apart_by_plane(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack)
{
    const lrcsi_normal *n = &p->normal[facet];
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    double limit = slack * n->length;
    int above = 0;
    int below = 0;
    for (int k = 0; k < 3; k++) {
        double from_a[3];
        lrcsi_vec3_between(a, lrcsi_prepared_corner(p, other, k), from_a);
        double height = lrcsi_vec3_dot(n->high, from_a);
        above += height > limit;
        below += height < -limit;
    }
    return above == 3 || below == 3;
}

/* The longest side of a facet, as a vector. */
static void pair_longest_side(const lrcs_prepared *p, uint32_t facet, double side[3])
{
    lrcsi_vec3_between(lrcsi_prepared_corner(p, facet, 0), lrcsi_prepared_corner(p, facet, 1),
                       side);
    double longest = lrcsi_vec3_dot(side, side);
    for (int k = 1; k < 3; k++) {
        double at[3];
        lrcsi_vec3_between(lrcsi_prepared_corner(p, facet, k),
                           lrcsi_prepared_corner(p, facet, (k + 1) % 3), at);
        const double square = lrcsi_vec3_dot(at, at);
        if (square > longest) {
            longest = square;
            memcpy(side, at, sizeof at);
        }
    }
}

/* Are two facets farther apart than `slack` along the direction perpendicular to the longest sides
   of both? Distances along it have errors of some 16 u, which LRCSI_PROXIMITY_ERR covers, as long
   as no product underflows. */
static int pair_apart_by_sides(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack)
{
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    double side[2][3];
    double direction[3];
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    pair_longest_side(p, facet, side[0]);
    pair_longest_side(p, other, side[1]);
    lrcsi_vec3_cross(side[0], side[1], direction);
    const double square = lrcsi_vec3_dot(direction, direction);
    const double limit = slack * sqrt(square);
    for (int k = 0; k < 6; k++) {
        double from_a[3];
        lrcsi_vec3_between(a, lrcsi_prepared_corner(p, k < 3 ? facet : other, k % 3), from_a);
        lrcsi_range_extend(lrcsi_vec3_dot(direction, from_a), &low[k / 3], &high[k / 3]);
    }
    return square > LEAST_SQUARE && (low[0] - high[1] > limit || low[1] - high[0] > limit);
}

/* Is it proved that no part of a facet is within `slack` of the other? The long, narrow facets of
   two flat faces that intersect have boxes that overlap, and neither plane separates them; but most
   pass each other at a distance. */
static int pair_is_apart(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack,
                         double along)
{
    return pair_apart_by_plane(p, facet, other, slack) ||
           pair_apart_by_plane(p, other, facet, along) ||
           pair_apart_by_sides(p, facet, other, slack);
}

/* The part of a facet that may be within `slack` of the facet `other`, and within `along` of its
   plane: the part between the two planes at that distance from the plane of `other`, and within the
   three planes at the slack outside its sides. */
static lrcsi_slice pair_slice(const lrcs_prepared *p, uint32_t facet, uint32_t other, double slack,
                              double along)
{
    if (pair_is_apart(p, facet, other, slack, along)) {
        return (lrcsi_slice){.count = 0};
    }
    lrcsi_slice slice =
        lrcsi_slice_start(lrcsi_prepared_corner(p, facet, 0), lrcsi_prepared_corner(p, facet, 1),
                          lrcsi_prepared_corner(p, facet, 2));
    const double *origin = lrcsi_prepared_corner(p, other, 0);
    double n[3];
    lrcsi_prepared_unit_normal(p, other, n);
    lrcsi_slice_cut_between(&slice, n, origin, origin, along);
    for (int side = 0; side < 3 && slice.count > 0; side++) {
        const double *a = lrcsi_prepared_corner(p, other, side);
        const double *b = lrcsi_prepared_corner(p, other, (side + 1) % 3);
        double ab[3];
        double out[3];
        lrcsi_vec3_between(a, b, ab);
        lrcsi_vec3_cross(ab, n, out);
        lrcsi_slice_cut(&slice, out, a, slack * sqrt(lrcsi_vec3_dot(out, out)));
    }
    return slice;
}

/* The fractions of a facet's area that a slice of it has in front of the plane of another facet and
   behind it. */
static lrcsi_sides_fraction slice_fractions(const lrcs_prepared *p, uint32_t facet,
                                            const lrcsi_slice *slice, uint32_t other)
{
    const double *origin = lrcsi_prepared_corner(p, other, 0);
    const double whole = 0.5 * p->normal[facet].length;
    const double longest = lrcsi_proximity_longest(p, facet);
    lrcsi_slice front = *slice;
    lrcsi_slice back = *slice;
    double n[3];
    lrcsi_prepared_unit_normal(p, other, n);
    const double down[3] = {-n[0], -n[1], -n[2]};
    lrcsi_slice_cut(&front, down, origin, LRCSI_PROXIMITY_ERR);
    lrcsi_slice_cut(&back, n, origin, LRCSI_PROXIMITY_ERR);
    return (lrcsi_sides_fraction){lrcsi_slice_fraction(&front, whole, longest),
                                  lrcsi_slice_fraction(&back, whole, longest)};
}

lrcsi_sides_fraction lrcsi_proximity_fractions(const lrcs_prepared *p, uint32_t facet,
                                               uint32_t other, double slack)
{
    const lrcsi_slice slice = pair_slice(p, facet, other, slack, slack);
    return slice_fractions(p, facet, &slice, other);
}

int lrcsi_proximity_side_is_far(const lrcs_prepared *p, uint32_t facet, int side, uint32_t other,
                                double distance)
{
    const double *a = lrcsi_prepared_corner(p, facet, side);
    const double *b = lrcsi_prepared_corner(p, facet, (side + 1) % 3);
    lrcsi_slice slice =
        lrcsi_slice_start(lrcsi_prepared_corner(p, other, 0), lrcsi_prepared_corner(p, other, 1),
                          lrcsi_prepared_corner(p, other, 2));
    double n[3][3]; /* normal to the facet; along the side; in the facet, perpendicular to it */
    lrcsi_prepared_unit_normal(p, facet, n[0]);
    lrcsi_vec3_between(a, b, n[1]);
    lrcsi_vec3_cross(n[0], n[1], n[2]);
    for (int i = 0; i < 3 && slice.count > 0; i++) {
        const double square = lrcsi_vec3_dot(n[i], n[i]);
        if (square > LEAST_SQUARE) {
            lrcsi_slice_cut_between(&slice, n[i], a, b, distance * sqrt(square));
        }
    }
    return slice.count == 0;
}

/* --- all pairs -------------------------------------------------------------------------------- */

/* A fraction as a float, rounded up. */
static float fraction_float(double fraction)
{
    return (float)lrcsi_min(1, fraction * LRCSI_OUTWARD_FLOAT);
}

/* Pairs are allocated so many at a time, and must be contiguous. */
enum { PAIRS_TAKEN = 4 };
_Static_assert(PAIRS_TAKEN * sizeof(lrcsi_proximity_pair) % LRCS_WORK_ALIGN == 0,
               "no gaps between pairs");

int lrcsi_proximity_on_round_wall(const lrcs_prepared *p, uint32_t facet)
{
    const uint32_t part = p->scene->facet_part[facet];
    return p->scene->facet_smooth[facet] != 0 && p->proximity.reach[part] > 0 &&
           lrcsi_shape_is_round(p->scene->part[part].kind);
}

/* How far from the plane of a facet of another part points of a facet matter, at most its slack:
   visibility/proximity/proximity_band.c, 1.f. */
static double slack_along(const lrcs_prepared *p, uint32_t other, double slack,
                          const lrcsi_displacement *displacement)
{
    const uint32_t part = p->scene->facet_part[other];
    const double theirs = p->proximity.hausdorff[part];
    double n[3];
    lrcsi_prepared_unit_normal(p, other, n);
    return theirs > 0 && part_is_open(p, part)
               ? slack
               : lrcsi_min(slack, lrcsi_displacement_along(displacement, n) + theirs +
                                      LRCSI_PROXIMITY_ERR);
}

/* Adds a pair if part of the facet is within the slack of the other. Given: how far the facet's
   points are displaced. */
static int proximity_add(lrcs_prepared *p, uint32_t facet, uint32_t other, double slack,
                         const lrcsi_displacement *displacement, lrcs_work *work)
{
    lrcsi_proximity *proximity = &p->proximity;
    const double along = slack_along(p, other, slack, displacement);
    lrcsi_slice slice = pair_slice(p, facet, other, slack, along);
    if (slice.count == 0) {
        return LRCS_OK;
    }
    const double *const corner[3] = {lrcsi_prepared_corner(p, facet, 0),
                                     lrcsi_prepared_corner(p, facet, 1),
                                     lrcsi_prepared_corner(p, facet, 2)};
    const lrcsi_sides_fraction of = slice_fractions(p, facet, &slice, other);
    double rows = lrcsi_proximity_rows(p, facet, corner, &slice);
    if (!(of.front > 0 || of.back > 0)) {
        return LRCS_OK;
    }
    if (proximity->count % PAIRS_TAKEN == 0) {
        lrcsi_proximity_pair *more = lrcsi_work_take(work, PAIRS_TAKEN, sizeof *more);
        if (!more) {
            return LRCS_E_MEMORY;
        }
        proximity->pair = proximity->pair ? proximity->pair : more;
    }
    proximity->pair[proximity->count++] = (lrcsi_proximity_pair){
        facet, other, fraction_float(of.front), fraction_float(of.back), fraction_float(rows)};
    return LRCS_OK;
}

/* If the box of a leaf of the tree is near those of more than MANY_NEAR facets, the nodes that are
   left are also compared with the leaf by capsules (mesh/contact/tree_capsule.h); if these separate
   at least NEAR_NODES_APART nodes from it, so are those of the next leaf, from the start. The
   capsules of the tree are filled once leaves have met CAPSULES_COST times as many others as there
   are leaves: heuristics. */
enum { MANY_NEAR = 32, NEAR_NODES_APART = 4, CAPSULES_COST = 2 };

/* The search for pairs, one leaf of the tree after the other. */
typedef struct pair_search {
    lrcsi_tree tree;
    uint64_t excess;  /* facets that were met beyond the first MANY_NEAR of a leaf, in all */
    int capsules_pay; /* capsules separated at least NEAR_NODES_APART nodes from the last leaf */
} pair_search;

enum { PAIR_LANES = LRCSI_TREE_LANES };

/* The facets of curved parts in a leaf. */
typedef struct pair_leaf {
    unsigned lanes;                              /* theirs */
    lrcsi_box box;                               /* around them */
    double reach;                                /* the largest of their parts */
    lrcsi_displacement displacement[PAIR_LANES]; /* of their points */
} pair_leaf;

static uint32_t lane_facet(const lrcsi_tree *tree, uint32_t leaf, uint32_t lane)
{
    return tree->order[leaf * PAIR_LANES + lane];
}

static pair_leaf pair_leaf_make(const lrcs_prepared *p, const lrcsi_tree *tree, uint32_t leaf)
{
    pair_leaf of = {.lanes = 0, .box = lrcsi_box_empty()};
    const uint32_t left = tree->count - leaf * PAIR_LANES;
    for (uint32_t lane = 0; lane < PAIR_LANES && lane < left; lane++) {
        const uint32_t facet = lane_facet(tree, leaf, lane);
        const double reach = p->proximity.reach[p->scene->facet_part[facet]];
        if (reach > 0) {
            const lrcsi_box box = lrcsi_tree_box(&tree->node[0][leaf], lane);
            lrcsi_box_add(&of.box, box.low);
            lrcsi_box_add(&of.box, box.high);
            of.lanes |= 1u << lane;
            of.reach = lrcsi_max(of.reach, reach);
            of.displacement[lane] = lrcsi_proximity_displacement(p, facet);
        }
    }
    return of;
}

/* A box that contains what is within a distance of another. */
static lrcsi_box box_within(const lrcsi_box *box, double distance)
{
    lrcsi_box wide = *box;
    for (int k = 0; k < 3; k++) {
        wide.low[k] -= distance;
        wide.high[k] += distance;
    }
    return wide;
}

/* The distance between two boxes along the axis where it is largest; negative if they overlap. */
static double boxes_gap(const lrcsi_box *a, const lrcsi_box *b)
{
    double gap = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        gap = lrcsi_max3(gap, a->low[k] - b->high[k], b->low[k] - a->high[k]);
    }
    return gap;
}

/* Adds the pairs of a facet of a curved part and another one of another part, in both orders. If
   both parts are curved, only the order in which this facet comes first is added here: the other
   order is added for the other facet. Given: the gap between their boxes, and the displacement of
   the first one's points. */
static int pairs_of_two(lrcs_prepared *p, uint32_t facet, uint32_t other, double gap,
                        const lrcsi_displacement *displacement, lrcs_work *work)
{
    const lrcsi_displacement none = {.known = 0};
    const uint32_t *part = p->scene->facet_part;
    const double slack = lrcsi_proximity_slack(p, part[facet], part[other]);
    int status = gap <= slack ? proximity_add(p, facet, other, slack, displacement, work) : LRCS_OK;
    if (status == LRCS_OK && p->proximity.reach[part[other]] == 0) {
        const double back = lrcsi_proximity_slack(p, part[other], part[facet]);
        status = gap <= back ? proximity_add(p, other, facet, back, &none, work) : LRCS_OK;
    }
    return status;
}

/* From here on compares nodes with the capsule of a leaf, `within` wider. */
static void narrow_search(const lrcsi_tree *tree, uint32_t leaf, double within,
                          lrcsi_tree_walk *walk)
{
    if (tree->levels > 1) {
        lrcsi_tree_capsule capsule =
            lrcsi_tree_lane_capsule(tree, 1, leaf / PAIR_LANES, leaf % PAIR_LANES);
        capsule.radius += within;
        lrcsi_tree_narrow_by_capsule(walk, &capsule);
    }
}

/* Adds the pairs of the facets of curved parts in a leaf and those of other parts. */
static int pairs_of_leaf(lrcs_prepared *p, uint32_t leaf, const pair_leaf *of, pair_search *search,
                         lrcs_work *work)
{
    lrcsi_tree *tree = &search->tree;
    const uint32_t *part = p->scene->facet_part;
    const double within = 2 * (of->reach + p->proximity.max_hausdorff) + LRCSI_PROXIMITY_ERR;
    const lrcsi_box wide = box_within(&of->box, within);
    lrcsi_tree_walk walk = lrcsi_tree_within(tree, &wide, tree->label[0][leaf]);
    int status = LRCS_OK;
    uint32_t at;
    if (search->capsules_pay) {
        narrow_search(tree, leaf, within, &walk);
    }
    for (uint32_t met = 0; status == LRCS_OK && (at = lrcsi_tree_next(&walk)) != LRCS_NONE; met++) {
        search->excess += met >= MANY_NEAR;
        if (!tree->has_capsules && search->excess > (uint64_t)CAPSULES_COST * tree->nodes[0]) {
            lrcsi_tree_fill_capsules(p->vertex, p->scene->facet, tree);
        }
        if (tree->has_capsules && met == MANY_NEAR && !search->capsules_pay) {
            narrow_search(tree, leaf, within, &walk);
        }
        const uint32_t other = tree->order[at];
        const lrcsi_box other_box =
            lrcsi_tree_box(&tree->node[0][at / PAIR_LANES], at % PAIR_LANES);
        const lrcsi_box near = box_within(&other_box, within);
        unsigned lanes = of->lanes & lrcsi_tree_meets(&tree->node[0][leaf], &near);
        for (; lanes != 0 && status == LRCS_OK; lanes &= lanes - 1) {
            const uint32_t lane = lrcsi_tree_lane(lanes);
            const uint32_t facet = lane_facet(tree, leaf, lane);
            if (part[other] != part[facet]) {
                const lrcsi_box box = lrcsi_tree_box(&tree->node[0][leaf], lane);
                status = pairs_of_two(p, facet, other, boxes_gap(&box, &other_box),
                                      &of->displacement[lane], work);
            }
        }
    }
    search->capsules_pay = walk.apart >= NEAR_NODES_APART;
    return status;
}

/* How far a facet of a part is from others that it is near, at most. */
static double near_distance(const lrcs_prepared *p, double reach)
{
    const double most = lrcsi_max(reach, p->proximity.max_hausdorff);
    return LRCSI_PROXIMITY_NEAR * (p->proximity.max_hausdorff + most + 2 * LRCSI_PROXIMITY_ERR);
}

/* Notes which other parts a facet with the given box is near. Of each part that it is near, only
   facets in nodes together with those of other parts are met after the first one. */
static void near_find(lrcs_prepared *p, uint32_t facet, const lrcsi_box *box,
                      const lrcsi_tree *tree)
{
    const uint32_t *part = p->scene->facet_part;
    const lrcsi_box wide = box_within(box, near_distance(p, p->proximity.reach[part[facet]]));
    lrcsi_tree_walk walk = lrcsi_tree_within(tree, &wide, part[facet]);
    lrcsi_part_set *near = &p->proximity.near[facet];
    for (uint32_t at; (at = lrcsi_tree_next(&walk)) != LRCS_NONE;) {
        const uint32_t other = tree->order[at];
        const lrcsi_part_set set = lrcsi_part_set_of(part[other]);
        if (part[other] == part[facet] || (*near & set) != 0) {
            continue;
        }
        const double distance =
            LRCSI_PROXIMITY_NEAR * lrcsi_proximity_slack(p, part[facet], part[other]);
        const lrcsi_box other_box = lrcsi_box_of(p->vertex, &p->scene->facet[other]);
        if (boxes_gap(box, &other_box) <= distance &&
            pair_slice(p, facet, other, distance, distance).count > 0) {
            *near |= set;
            walk.also_without |= part[other] < LRCSI_PART_SET_SINGLE ? set : 0;
        }
    }
}

/* Finds what the facets on round walls in a leaf are near: nothing, if no other part is near their
   box. */
static void near_of_leaf(lrcs_prepared *p, uint32_t leaf, const pair_leaf *of,
                         const lrcsi_tree *tree)
{
    const lrcsi_box wide = box_within(&of->box, near_distance(p, of->reach));
    lrcsi_tree_walk walk = lrcsi_tree_within(tree, &wide, tree->label[0][leaf]);
    if (lrcsi_tree_next(&walk) == LRCS_NONE) {
        return;
    }
    for (unsigned lanes = of->lanes; lanes != 0; lanes &= lanes - 1) {
        const uint32_t lane = lrcsi_tree_lane(lanes);
        const uint32_t facet = lane_facet(tree, leaf, lane);
        if (lrcsi_proximity_on_round_wall(p, facet)) {
            const lrcsi_box box = lrcsi_tree_box(&tree->node[0][leaf], lane);
            near_find(p, facet, &box, tree);
        }
    }
}

/* Finds all pairs. Their list grows above the tree in the work area, and is moved to the place of
   the tree at the end. */
static int pairs_find(lrcs_prepared *p, lrcs_work *work)
{
    lrcsi_proximity *proximity = &p->proximity;
    const lrcs_scene *scene = p->scene;
    pair_search search = {.excess = 0};
    size_t mark = work->used;
    int status = lrcsi_tree_make(p->vertex, scene->facet, scene->facet_count, p->skip,
                                 scene->facet_part, 0, work, &search.tree);
    for (uint32_t leaf = 0; status == LRCS_OK && leaf < search.tree.nodes[0]; leaf++) {
        const pair_leaf of = pair_leaf_make(p, &search.tree, leaf);
        if (of.lanes != 0) {
            status = pairs_of_leaf(p, leaf, &of, &search, work);
            near_of_leaf(p, leaf, &of, &search.tree);
        }
    }
    work->used = mark;
    if (status == LRCS_OK) {
        const lrcsi_proximity_pair *above = proximity->pair;
        proximity->pair = lrcsi_work_take(work, proximity->count, sizeof *proximity->pair);
        status = proximity->pair ? LRCS_OK : LRCS_E_MEMORY;
        for (size_t i = 0; i < proximity->count && status == LRCS_OK; i++) {
            proximity->pair[i] = above[i];
        }
    }
    return status;
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
    return pairs_find(p, work);
}
