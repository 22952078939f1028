/* SPDX-License-Identifier: MIT */
/* The tree of boxes against all pairs of boxes, and what its order must survive. */
#include "mesh/contact/tree_bounds.h"
#include "mesh/contact/tree_capsule.h"
#include "mesh/contact/tree_walk.h"

#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "check.h"

enum { ROOM = 8 << 20, MOST = 3000 };

static unsigned char room[ROOM];
static lrcs_point vertex[3 * MOST];
static lrcs_facet facet[MOST];
static uint32_t label[MOST];
static unsigned char skip[MOST];
static unsigned char met[MOST][MOST];

static uint32_t seed = 1;

static double next_number(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) * 0x1p-24;
}

/* Facets within a box of a place and a size. */
static void make_soup(uint32_t first, uint32_t end, double place, double size)
{
    for (uint32_t f = first; f < end; f++) {
        double centre[3] = {next_number(), next_number(), next_number()};
        double own = f % 20 == 0 ? 0.5 : 0.05;
        for (uint32_t c = 0; c < 3; c++) {
            for (int k = 0; k < 3; k++) {
                double x = centre[k] + own * (next_number() - 0.5);
                vertex[3 * f + c].x[k] = place + size * x;
            }
            facet[f].corner[c] = 3 * f + c;
        }
    }
}

static int boxes_meet(const lrcsi_box *a, const lrcsi_box *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->high[k] < b->low[k] || b->high[k] < a->low[k]) {
            return 0;
        }
    }
    return 1;
}

/* The pairs of a facet with those in the allowed lanes of a leaf whose boxes meet: marks them. */
static void meet_row(const lrcsi_tree *tree, uint32_t place, uint32_t leaf, unsigned allowed)
{
    lrcsi_box box =
        lrcsi_tree_box(&tree->node[0][place / LRCSI_TREE_LANES], place % LRCSI_TREE_LANES);
    unsigned lanes = lrcsi_tree_meets(&tree->node[0][leaf], &box) & allowed;
    for (; lanes != 0; lanes &= lanes - 1) {
        uint32_t at = leaf * LRCSI_TREE_LANES + lrcsi_tree_lane(lanes);
        uint32_t f = tree->order[place];
        uint32_t g = tree->order[at];
        assert_true(at < tree->count && f != g && !met[f][g] && !met[g][f]);
        met[f][g] = met[g][f] = 1;
    }
}

/* The self-join of a tree: marks pairs whose boxes meet. Returned: leaves that were compared. */
static uint32_t join(const lrcsi_tree *tree)
{
    uint32_t compared = 0;
    memset(met, 0, sizeof met);
    for (uint32_t leaf = 0; tree->levels > 0 && leaf < tree->nodes[0]; leaf++) {
        uint32_t first = leaf * LRCSI_TREE_LANES;
        uint32_t end =
            first + LRCSI_TREE_LANES < tree->count ? first + LRCSI_TREE_LANES : tree->count;
        for (uint32_t place = first; place < end; place++) {
            meet_row(tree, place, leaf, ~1u << place % LRCSI_TREE_LANES);
        }
        lrcsi_tree_walk walk = lrcsi_tree_after(tree, leaf);
        uint32_t other;
        while ((other = lrcsi_tree_next(&walk)) != LRCS_NONE) {
            assert_true(other > leaf && other < tree->nodes[0]);
            compared++;
            for (uint32_t place = first; place < end; place++) {
                meet_row(tree, place, other, ~0u);
            }
        }
    }
    return compared;
}

static lrcsi_tree make_tree(uint32_t facets, const unsigned char *left_out, const uint32_t *labels)
{
    static lrcs_work work;
    lrcsi_tree tree;
    work = lrcs_work_make(room, ROOM);
    assert_int_equal(lrcsi_tree_make(vertex, facet, facets, left_out, labels, 0, &work, &tree),
                     LRCS_OK);
    assert_true(work.peak <= lrcsi_tree_need(facets));
    return tree;
}

/* Every pair of boxes that meet comes up once, none but of one label is left out. */
static void check_join(uint32_t facets, const unsigned char *left_out, const uint32_t *labels)
{
    lrcsi_tree tree = make_tree(facets, left_out, labels);
    join(&tree);
    for (uint32_t f = 0; f < facets; f++) {
        lrcsi_box a = lrcsi_box_of(vertex, &facet[f]);
        for (uint32_t g = 0; g < facets; g++) {
            lrcsi_box b = lrcsi_box_of(vertex, &facet[g]);
            int both = f != g && !(left_out && (left_out[f] || left_out[g]));
            int meet = both && boxes_meet(&a, &b);
            int same = labels && labels[f] == labels[g] && labels[f] != LRCS_NONE;
            assert_true(met[f][g] == meet || (same && meet));
        }
    }
}

static void the_join_finds_all_pairs_of_boxes_that_meet_once_each(void **state)
{
    (void)state;
    static const uint32_t count[] = {0, 1, 2, 7, 8, 9, 63, 64, 65, 511, 513, 700};
    for (size_t i = 0; i < sizeof count / sizeof *count; i++) {
        make_soup(0, count[i], 0.0, 1.0);
        check_join(count[i], NULL, NULL);
    }
    for (uint32_t f = 0; f < 700; f++) {
        skip[f] = f % 3 == 0;
    }
    check_join(700, skip, NULL);
}

/* Leaves that walks by slabs from the start leave out, of those that meet by boxes: none that has a
   corner in common. Returned: how many are left. */
static uint32_t check_slabs(uint32_t facets)
{
    lrcsi_tree tree = make_tree(facets, NULL, NULL);
    uint32_t left = 0;
    lrcsi_tree_fill_slabs(vertex, facet, &tree);
    for (uint32_t leaf = 0; leaf < tree.nodes[0]; leaf++) {
        static unsigned char kept[MOST];
        memset(kept, 0, sizeof kept);
        lrcsi_tree_walk walk = lrcsi_tree_after(&tree, leaf);
        lrcsi_tree_narrow_by_slabs(&walk, leaf);
        for (uint32_t other; (other = lrcsi_tree_next(&walk)) != LRCS_NONE; left++) {
            kept[other] = 1;
        }
        for (uint32_t i = leaf * LRCSI_TREE_LANES; i < (leaf + 1) * LRCSI_TREE_LANES; i++) {
            for (uint32_t j = (leaf + 1) * LRCSI_TREE_LANES; j < facets && i < facets; j++) {
                const uint32_t *a = facet[tree.order[i]].corner;
                const uint32_t *b = facet[tree.order[j]].corner;
                for (int k = 0; k < 9; k++) {
                    assert_true(a[k / 3] != b[k % 3] || kept[j / LRCSI_TREE_LANES]);
                }
            }
        }
    }
    return left;
}

/* A tilted sheet, plane or not; a fan of slivers about a line; sheets one above the other, which
   slabs alone tell apart. */
static void slabs_leave_out_no_neighbours(void **state)
{
    (void)state;
    enum { N = 30 };
    for (int wave = 0; wave < 3; wave++) {
        for (uint32_t i = 0; i <= N * (N + 2); i++) {
            double x = (double)(i / (N + 1)) / N;
            double y = (double)(i % (N + 1)) / N;
            double z = wave * 0.2 * sin(9 * x) * cos(7 * y);
            vertex[i] = (lrcs_point){{x + 0.3 * z, y - 0.7 * z + 0.4 * x, z + 0.8 * x + 0.6 * y}};
        }
        for (uint32_t i = 0; i < N * N; i++) {
            uint32_t at = i / N * (N + 1) + i % N;
            facet[2 * i] = (lrcs_facet){{at, at + N + 1, at + N + 2}};
            facet[2 * i + 1] = (lrcs_facet){{at, at + N + 2, at + 1}};
        }
        assert_true(check_slabs(2 * N * N) > 0);
    }
    for (uint32_t i = 0; i < 600; i++) {
        double turn = 6.28 * i / 600;
        vertex[i] = (lrcs_point){{cos(turn), 0.6 * sin(turn), 0.8 * sin(turn)}};
        facet[i] = (lrcs_facet){{600, 601, i}};
    }
    vertex[600] = (lrcs_point){{0, 0, 0}};
    vertex[601] = (lrcs_point){{0, -0.8, 0.6}};
    check_slabs(600);
    for (uint32_t f = 0; f < 1600; f++) {
        for (uint32_t c = 0; c < 3; c++) { /* of either winding */
            double x = c > 0;
            double y = c > 1;
            double z = 1e-5 * f;
            vertex[3 * f + c] = (lrcs_point){{x + 0.5 * z, y - 0.3 * z, 0.7 * x + 0.4 * y + z}};
            facet[f].corner[f % 2 ? c : 2 - c] = 3 * f + c;
        }
    }
    assert_true(check_slabs(1600) < 2 * 200); /* of 200 leaves that all meet by boxes */
}

/* --- capsules --- */

/* The distance of a point from a capsule's segment, less the radius. */
static long double outside_capsule(const lrcsi_tree_capsule *c, const double *x)
{
    long double v[3];
    long double from[3];
    long double along = 0;
    long double length = 0;
    long double square = 0;
    for (int k = 0; k < 3; k++) {
        v[k] = (long double)c->end[1][k] - c->end[0][k];
        from[k] = (long double)x[k] - c->end[0][k];
        along += v[k] * from[k];
        length += v[k] * v[k];
    }
    long double t = length > 0 ? along / length : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int k = 0; k < 3; k++) {
        square += (from[k] - t * v[k]) * (from[k] - t * v[k]);
    }
    return sqrtl(square) - c->radius;
}

/* The capsule of a facet: that of a leaf in which it is listed several times. */
static lrcsi_tree_capsule facet_capsule(uint32_t f)
{
    enum { COPIES = LRCSI_TREE_LANES + 1 };
    static unsigned char own_room[1 << 16];
    lrcs_work work = lrcs_work_make(own_room, sizeof own_room);
    lrcs_facet copy[COPIES];
    lrcsi_tree tree;
    for (int i = 0; i < COPIES; i++) {
        copy[i] = facet[f];
    }
    assert_int_equal(lrcsi_tree_make(vertex, copy, COPIES, NULL, NULL, 0, &work, &tree), LRCS_OK);
    lrcsi_tree_fill_capsules(vertex, copy, &tree);
    return lrcsi_tree_lane_capsule(&tree, 1, 0, 0);
}

/* The walls of two cylinders of n strips that intersect at an angle, neither of them parallel to an
   axis. Strip i of the first is facet 2 i, of the second facet 2 i + 1. */
static void make_walls(uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t wall = 0; wall < 2; wall++) {
            for (uint32_t c = 0; c < 3; c++) {
                const double turn = 6.283185307179586 * (i + 0.5 * (c > 1)) / n;
                const double r = wall ? 0.7 : 1.0;
                const double at[3] = {r * cos(turn), r * sin(turn), c == 1 ? 4.0 : -4.0};
                double *x = vertex[3 * (2 * i + wall) + c].x;
                x[0] = 0.6 * at[wall ? 2 : 0] + 0.8 * at[1];
                x[1] = -0.8 * 0.6 * at[wall ? 2 : 0] + 0.36 * at[1] + 0.8 * at[wall ? 0 : 2];
                x[2] = 0.64 * at[wall ? 2 : 0] - 0.48 * at[1] + 0.6 * at[wall ? 0 : 2];
                facet[2 * i + wall].corner[c] = 3 * (2 * i + wall) + c;
            }
        }
    }
}

/* Facets of one wall whose capsules meet those of nodes of the other, all of them together. */
static uint32_t near_walls(uint32_t n, int by_capsules)
{
    for (uint32_t f = 0; f < 2 * n; f++) {
        label[f] = f % 2;
    }
    lrcsi_tree tree = make_tree(2 * n, NULL, label);
    uint32_t found = 0;
    lrcsi_tree_fill_capsules(vertex, facet, &tree);
    for (uint32_t f = 0; f < 2 * n; f += 2) {
        const lrcsi_box box = lrcsi_box_of(vertex, &facet[f]);
        const lrcsi_tree_capsule capsule = facet_capsule(f);
        lrcsi_tree_walk walk = lrcsi_tree_within(&tree, &box, 0);
        if (by_capsules) {
            lrcsi_tree_narrow_by_capsule(&walk, &capsule);
        }
        while (lrcsi_tree_next(&walk) != LRCS_NONE) {
            found++;
        }
    }
    return found;
}

static void capsules_contain_what_is_below_them(void **state)
{
    (void)state;
    enum { N = 700 };
    for (int walls = 0; walls < 2; walls++) {
        if (walls) {
            make_walls(N / 2);
        } else {
            make_soup(0, N, 5.0, 1e-3);
        }
        lrcsi_tree tree = make_tree(N, NULL, NULL);
        lrcsi_tree_fill_capsules(vertex, facet, &tree);
        uint32_t size = LRCSI_TREE_LANES; /* facets of a lane */
        for (int level = 1; level < tree.levels; level++, size *= LRCSI_TREE_LANES) {
            for (uint32_t place = 0; place < N; place++) {
                const uint32_t lane = place / size;
                const lrcsi_tree_capsule c = lrcsi_tree_lane_capsule(
                    &tree, level, lane / LRCSI_TREE_LANES, lane % LRCSI_TREE_LANES);
                const lrcsi_tree_capsule own = facet_capsule(tree.order[place]);
                assert_true(isfinite(c.radius) && isfinite(own.radius));
                for (int k = 0; k < 3; k++) {
                    const double *x = vertex[facet[tree.order[place]].corner[k]].x;
                    assert_true(outside_capsule(&c, x) <= 0 && outside_capsule(&own, x) <= 0);
                }
            }
        }
    }
}

/* Pairs of segments: any; parallel; rulings of one cone, whose lines meet. If the sum of
   their radii is 1/100 less than the distance of the segments, they are apart; if it is slightly
   more, they are not. The distance: the least of points along the one from the other. */
static void capsules_are_apart_if_their_segments_are(void **state)
{
    (void)state;
    enum { PAIRS = 3000, POINTS = 2000 };
    for (int pair = 0; pair < PAIRS; pair++) {
        lrcsi_tree_capsule c[2];
        for (int i = 0; i < 2; i++) {
            for (int k = 0; k < 3; k++) {
                c[i].end[0][k] = next_number() - 0.5;
                c[i].end[1][k] = pair % 3 == 2 ? 0.3 * c[i].end[0][k] : next_number() - 0.5;
                if (pair % 3 == 1 && i == 1) {
                    c[1].end[1][k] = c[1].end[0][k] + 0.5 * (c[0].end[1][k] - c[0].end[0][k]);
                }
            }
            c[i].radius = 0;
        }
        long double distance = HUGE_VAL;
        for (int n = 0; n <= POINTS; n++) {
            double x[3];
            for (int k = 0; k < 3; k++) {
                x[k] = c[0].end[0][k] + (c[0].end[1][k] - c[0].end[0][k]) * n / POINTS;
            }
            distance = fminl(distance, outside_capsule(&c[1], x));
        }
        if (distance > 0.1L) { /* so that sampling changes it by less than 1/100 */
            c[0].radius = (double)(0.99L * distance) * 0.25;
            c[1].radius = (double)(0.99L * distance) * 0.75;
            assert_true(lrcsi_tree_capsules_apart(&c[0], &c[1]));
            assert_true(lrcsi_tree_capsules_apart(&c[1], &c[0]));
            c[1].radius = (double)distance - c[0].radius * 0.99;
            assert_false(lrcsi_tree_capsules_apart(&c[0], &c[1]));
            assert_false(lrcsi_tree_capsules_apart(&c[1], &c[0]));
        }
    }
}

/* Facets of 2^-47 with sides along one direction, far apart in a plane perpendicular to it: points
   are beyond the ends of segments that are so short that rounding turns them. */
static void capsules_of_tiny_facets_contain_what_is_below_them(void **state)
{
    (void)state;
    enum { N = 64 };
    const double s = 0x1p-47;
    for (int round = 0; round < 50; round++) {
        const double middle = next_number() - 0.5;
        for (uint32_t f = 0; f < N; f++) {
            const double p = 0.5 * (next_number() - 0.5) + 0.0625 * (f / 8);
            const double along[3][2] = {{0, 0}, {s, s}, {0.75 * s, 0.25 * s}};
            for (uint32_t c = 0; c < 3; c++) {
                vertex[3 * f + c] =
                    (lrcs_point){{middle + p + along[c][0], middle - p + along[c][1], 0.25}};
                facet[f].corner[c] = 3 * f + c;
            }
        }
        lrcsi_tree tree = make_tree(N, NULL, NULL);
        lrcsi_tree_fill_capsules(vertex, facet, &tree);
        for (uint32_t place = 0; place < N; place++) {
            const uint32_t lane = place / LRCSI_TREE_LANES;
            const lrcsi_tree_capsule c = lrcsi_tree_lane_capsule(&tree, 1, 0, lane);
            for (int k = 0; k < 3; k++) {
                const double *x = vertex[facet[tree.order[place]].corner[k]].x;
                assert_true(outside_capsule(&c, x) <= 0);
            }
        }
    }
}

/* Facet f + 1 has a corner in the interior of facet f. */
static void capsules_leave_out_nothing_that_meets(void **state)
{
    (void)state;
    enum { N = 1200 };
    make_soup(0, N, 0.0, 1.0);
    for (uint32_t f = 1; f < N; f++) {
        const double s = next_number();
        const double t = next_number() * (1 - s);
        for (int k = 0; k < 3; k++) {
            const double a = vertex[3 * f - 3].x[k];
            vertex[3 * f].x[k] =
                a + s * (vertex[3 * f - 2].x[k] - a) + t * (vertex[3 * f - 1].x[k] - a);
            vertex[3 * f + 1].x[k] = vertex[3 * f].x[k] + next_number() - 0.5;
            vertex[3 * f + 2].x[k] = vertex[3 * f + 1].x[k] + 1e-3 * (next_number() - 0.5);
        }
    }
    lrcsi_tree tree = make_tree(N, NULL, NULL);
    lrcsi_tree_fill_capsules(vertex, facet, &tree);
    uint32_t left_out = 0;
    for (uint32_t f = 0; f + 1 < N; f++) {
        const lrcsi_box box = lrcsi_box_of(vertex, &facet[f]);
        const lrcsi_tree_capsule capsule = facet_capsule(f);
        lrcsi_tree_walk walk = lrcsi_tree_within(&tree, &box, LRCS_NONE);
        int found = 0;
        lrcsi_tree_narrow_by_capsule(&walk, &capsule);
        for (uint32_t at; (at = lrcsi_tree_next(&walk)) != LRCS_NONE;) {
            found |= tree.order[at] == f + 1;
        }
        const lrcsi_box next = lrcsi_box_of(vertex, &facet[f + 1]);
        assert_true(found || !boxes_meet(&box, &next)); /* rounding: the corner may be outside */
        left_out += walk.apart;
    }
    assert_true(left_out > 0);
}

/* Most boxes of one wall meet most of the other. */
static void capsules_tell_apart_long_facets_that_cross(void **state)
{
    (void)state;
    make_walls(300);
    const uint32_t boxes = near_walls(300, 0);
    const uint32_t few = near_walls(300, 1);
    make_walls(1200);
    const uint32_t many = near_walls(1200, 1);
    print_message("# pairs of 300 strips: %u by boxes, %u by capsules; of 1200: %u\n", boxes, few,
                  many);
    assert_true(boxes > 300 * 300 / 8);
    assert_true(many < 6 * few); /* nearly in proportion to the strips */
}

/* Nor one so small that products underflow. */
static void a_capsule_of_a_point_bounds_nothing(void **state)
{
    (void)state;
    vertex[0] = (lrcs_point){{0.1, 0.2, 0.3}};
    facet[0] = (lrcs_facet){{0, 0, 0}};
    make_soup(1, 2, 0.0, 1.0);
    const lrcsi_tree_capsule point = facet_capsule(0);
    const lrcsi_tree_capsule other = facet_capsule(1);
    assert_true(point.radius == HUGE_VAL);
    vertex[0] = (lrcs_point){{0, 0, 0}};
    vertex[1] = (lrcs_point){{0x1p-290, 0, 0}};
    vertex[2] = (lrcs_point){{0, 0x1p-291, 0}};
    facet[0] = (lrcs_facet){{0, 1, 2}};
    assert_true(facet_capsule(0).radius == HUGE_VAL);
    assert_false(lrcsi_tree_capsules_apart(&point, &other));
    assert_false(lrcsi_tree_capsules_apart(&other, &point));
}

/* Boxes that end where others start, at -0 and 0 too, and of no size. */
static void boxes_that_touch_meet(void **state)
{
    (void)state;
    for (uint32_t f = 0; f < 500; f++) {
        for (uint32_t c = 0; c < 3; c++) {
            for (int k = 0; k < 3; k++) {
                double x = floor(5.0 * next_number()) - 2.0;
                vertex[3 * f + c].x[k] = x == 0.0 && f % 2 ? -0.0 : x;
            }
            facet[f].corner[c] = 3 * f + (f % 5 == 0 ? 0 : c);
        }
    }
    check_join(500, NULL, NULL);
}

static void only_pairs_of_one_label_are_left_out(void **state)
{
    (void)state;
    make_soup(0, 600, 0.0, 1.0);
    for (uint32_t f = 0; f < 600; f++) {
        label[f] = vertex[3 * f].x[0] < 0.5 ? 3 : f % 2 ? LRCS_NONE : 1;
    }
    check_join(600, NULL, label);
    lrcsi_tree tree = make_tree(600, NULL, label);
    uint32_t with = join(&tree);
    tree = make_tree(600, NULL, NULL);
    assert_true(with < join(&tree)); /* whole leaves are left out */
}

static void a_walk_finds_all_boxes_that_meet_a_given_one(void **state)
{
    (void)state;
    make_soup(0, 600, 0.0, 1.0);
    for (uint32_t f = 0; f < 600; f++) {
        label[f] = vertex[3 * f].x[0] < 0.5 ? 3 : vertex[3 * f].x[1] < 0.5 ? 1 : f % 2;
    }
    lrcsi_tree tree = make_tree(600, NULL, label);
    uint32_t left_out = 0;
    uint32_t also_left_out = 0;
    for (int round = 0; round < 200; round++) {
        static unsigned char found[MOST];
        uint32_t without = round % 2 ? 3 : LRCS_NONE;
        lrcsi_box box;
        for (int k = 0; k < 3; k++) {
            box.low[k] = next_number();
            box.high[k] = box.low[k] + 0.3 * next_number();
        }
        memset(found, 0, sizeof found);
        const uint64_t also = round % 3 ? 0 : 2; /* label 1 */
        lrcsi_tree_walk walk = lrcsi_tree_within(&tree, &box, without);
        walk.also_without = also;
        for (uint32_t at; (at = lrcsi_tree_next(&walk)) != LRCS_NONE;) {
            assert_true(at < tree.count && !found[tree.order[at]]);
            found[tree.order[at]] = 1;
        }
        for (uint32_t f = 0; f < 600; f++) {
            lrcsi_box own = lrcsi_box_of(vertex, &facet[f]);
            int meet = boxes_meet(&own, &box);
            int may_lack = label[f] == without || (also >> label[f] & 1) != 0;
            assert_true(found[f] == meet || (meet && may_lack));
            left_out += found[f] != meet;
            also_left_out += found[f] != meet && label[f] != without;
        }
    }
    assert_true(left_out > 0 && also_left_out > 0);
}

/* One vertex 1e22 times as far away as the rest are from each other, and clusters within clusters,
   each 1e-6 of the size of the last: the order is as good as without. */
static void far_vertices_and_small_clusters_do_not_spoil_the_order(void **state)
{
    (void)state;
    enum { N = 2800 };
    make_soup(0, N, 0.0, 1.0);
    lrcsi_tree tree = make_tree(N, NULL, NULL);
    uint32_t compared = join(&tree);
    vertex[5].x[1] = 1e22;
    tree = make_tree(N, NULL, NULL);
    assert_true(join(&tree) < compared + tree.nodes[0]);
    double size = 1.0;
    for (uint32_t first = 0; first < N; first += N / 7) {
        make_soup(first, first + N / 7, 0.0, size);
        size *= 1e-6;
    }
    tree = make_tree(N, NULL, NULL);
    assert_true(join(&tree) < 2 * compared);
}

static void facets_in_one_place_are_found_there(void **state)
{
    (void)state;
    enum { N = 1000 };
    for (uint32_t f = 0; f < N; f++) {
        facet[f] = (lrcs_facet){{0, 0, f % 3}};
    }
    for (uint32_t v = 0; v < 3; v++) {
        vertex[v] = (lrcs_point){{0.1, 0.2, 0.3}};
    }
    lrcsi_tree tree = make_tree(N, NULL, NULL);
    lrcsi_box box = lrcsi_box_of(vertex, &facet[7]);
    lrcsi_tree_walk walk = lrcsi_tree_within(&tree, &box, LRCS_NONE);
    uint32_t found = 0;
    while (lrcsi_tree_next(&walk) != LRCS_NONE) {
        found++;
    }
    assert_int_equal(found, N);
}

/* Facets without a normal have slabs without a direction, and fans whose directions cancel, or are
   none, have cones that bound nothing: no node is left out. */
static void slabs_and_cones_without_a_direction_leave_out_nothing(void **state)
{
    (void)state;
    static const unsigned char unproved[3] = {0, 0, 0};
    for (int full = 0; full < 2; full++) {
        const uint32_t count = full ? 40 : 200; /* 40: few enough to keep their order */
        for (uint32_t v = 0; v < 5; v++) {
            vertex[v] = (lrcs_point){{0, 0, 0}};
        }
        for (uint32_t v = 1; v < 5 && full; v++) { /* a cross of four spokes about vertex 0 */
            vertex[v].x[v / 3] = v % 2 ? 1.0 : -1.0;
        }
        for (uint32_t f = 0; f < count; f++) {
            static const uint32_t spoke[4] = {1, 3, 2, 4};
            facet[f] = (lrcs_facet){{0, spoke[f % 4], spoke[(f + 1) % 4]}};
            label[f] = 0;
        }
        lrcs_work work = lrcs_work_make(room, ROOM);
        lrcsi_tree tree;
        assert_int_equal(lrcsi_tree_make(vertex, facet, count, NULL, label, 1, &work, &tree),
                         LRCS_OK);
        lrcsi_tree_fill_slabs(vertex, facet, &tree);
        lrcsi_tree_fill_cones(vertex, facet, unproved, &tree);
        for (uint32_t leaf = 0; leaf < tree.nodes[0]; leaf++) {
            lrcsi_tree_walk walk = lrcsi_tree_after(&tree, leaf);
            walk.without = LRCS_NONE;
            lrcsi_tree_narrow_by_cones(&walk, leaf);
            lrcsi_tree_narrow_by_slabs(&walk, leaf);
            uint32_t found = leaf + 1;
            while (lrcsi_tree_next(&walk) != LRCS_NONE) {
                found++;
            }
            assert_int_equal(found, tree.nodes[0]);
        }
    }
}

static void a_tree_of_no_facets_has_none_in_any_box(void **state)
{
    (void)state;
    lrcsi_tree tree = make_tree(0, NULL, NULL);
    lrcsi_box box = {{-1, -1, -1}, {1, 1, 1}};
    lrcsi_tree_walk walk = lrcsi_tree_within(&tree, &box, LRCS_NONE);
    assert_int_equal(lrcsi_tree_next(&walk), LRCS_NONE);
}

static void trees_in_too_little_memory_fail_clean(void **state)
{
    (void)state;
    make_soup(0, 70, 0.0, 1.0);
    size_t need = lrcsi_tree_need(70);
    int status = LRCS_E_MEMORY;
    for (size_t size = 0; size <= need; size += 8) {
        unsigned char *bytes = malloc(size + 1);
        assert_non_null(bytes);
        lrcs_work work = lrcs_work_make(bytes, size);
        lrcsi_tree tree = {.count = 99};
        status = lrcsi_tree_make(vertex, facet, 70, NULL, NULL, 0, &work, &tree);
        assert_int_equal(tree.count, status == LRCS_OK ? 70 : 99);
        assert_true(status == LRCS_OK || work.used == 0);
        free(bytes);
    }
    assert_int_equal(status, LRCS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_join_finds_all_pairs_of_boxes_that_meet_once_each),
        cmocka_unit_test(slabs_leave_out_no_neighbours),
        cmocka_unit_test(capsules_contain_what_is_below_them),
        cmocka_unit_test(capsules_are_apart_if_their_segments_are),
        cmocka_unit_test(capsules_of_tiny_facets_contain_what_is_below_them),
        cmocka_unit_test(capsules_leave_out_nothing_that_meets),
        cmocka_unit_test(capsules_tell_apart_long_facets_that_cross),
        cmocka_unit_test(a_capsule_of_a_point_bounds_nothing),
        cmocka_unit_test(boxes_that_touch_meet),
        cmocka_unit_test(only_pairs_of_one_label_are_left_out),
        cmocka_unit_test(a_walk_finds_all_boxes_that_meet_a_given_one),
        cmocka_unit_test(far_vertices_and_small_clusters_do_not_spoil_the_order),
        cmocka_unit_test(facets_in_one_place_are_found_there),
        cmocka_unit_test(slabs_and_cones_without_a_direction_leave_out_nothing),
        cmocka_unit_test(a_tree_of_no_facets_has_none_in_any_box),
        cmocka_unit_test(trees_in_too_little_memory_fail_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
