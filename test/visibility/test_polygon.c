/* SPDX-License-Identifier: MIT */
/* Visible polygons: convex, disjoint, on their facets, of the area that exact rational arithmetic
   gives, and seen at just those points that exact integer arithmetic sees. */
#include <lrcs/polygon.h>

#include "visible.h"

#define U 0x1p-53

static test_scene scene;
static lrcs_work work;
static lrcs_pose pose;
static lrcs_polygons polygons;

/* The scene's polygons; its records are those of the exact method. */
static void make_polygons(const double direction[3])
{
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    scene_pose(&scene, prepared, &work, direction, LRCS_METHOD_EXACT, 0);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    size_t used = work.used;
    work.size = used + lrcs_polygon_need(prepared);
    assert_int_equal(lrcs_polygon_run(prepared, &pose, &work, &polygons), LRCS_OK);
    assert_true(work.used <= used + polygons.rings * sizeof(lrcs_ring) +
                                 polygons.points * sizeof(lrcs_ring_point) + 64);
}

/* --- geometry in long double ------------------------------------------------------------------ */

typedef struct flat_polygon {
    long double x[64][2];
    uint32_t count;
} flat_polygon;

static long double cross2(const long double *a, const long double *b, const long double *c)
{
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

static long double distance2(const long double *a, const long double *b)
{
    return hypotl(b[0] - a[0], b[1] - a[1]);
}

static flat_polygon ring_of(const lrcs_ring *ring)
{
    flat_polygon p = {.count = ring->count};
    assert_true(ring->count >= 3 && ring->count < 60);
    assert_true(ring->first + ring->count <= polygons.points);
    for (uint32_t i = 0; i < ring->count; i++) {
        p.x[i][0] = polygons.point[ring->first + i].view[0];
        p.x[i][1] = polygons.point[ring->first + i].view[1];
    }
    return p;
}

/* A facet's projection, counter-clockwise. */
static flat_polygon facet_of(uint32_t facet)
{
    flat_polygon p = {.count = 3};
    for (int i = 0; i < 3; i++) {
        const double *x = scene.vertex[scene.facet[facet].corner[i]].x;
        for (int k = 0; k < 2; k++) {
            p.x[i][k] = (long double)pose.R[k][0] * x[0] + (long double)pose.R[k][1] * x[1] +
                        (long double)pose.R[k][2] * x[2];
        }
    }
    if (cross2(p.x[0], p.x[1], p.x[2]) < 0) {
        flat_polygon q = p;
        memcpy(p.x[1], q.x[2], sizeof p.x[1]);
        memcpy(p.x[2], q.x[1], sizeof p.x[2]);
    }
    return p;
}

static long double area_of(const flat_polygon *p)
{
    long double twice = 0;
    for (uint32_t i = 0; i + 1 < p->count; i++) {
        twice += (p->x[i][0] - p->x[0][0]) * (p->x[i + 1][1] - p->x[0][1]) -
                 (p->x[i][1] - p->x[0][1]) * (p->x[i + 1][0] - p->x[0][0]);
    }
    return 0.5L * twice;
}

static long double perimeter_of(const flat_polygon *p)
{
    long double sum = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        sum += distance2(p->x[i], p->x[(i + 1) % p->count]);
    }
    return sum;
}

/* How far inside a convex polygon a point lies; below 0: outside by at least that. Sides that are
   but the rounding of their ends have no direction. */
static long double depth_in(const flat_polygon *p, const long double *at)
{
    long double depth = HUGE_VALL;
    for (uint32_t i = 0; i < p->count; i++) {
        const long double *a = p->x[i];
        const long double *b = p->x[(i + 1) % p->count];
        if (distance2(a, b) > 1e-13L * perimeter_of(p)) {
            depth = fminl(depth, cross2(a, b, at) / distance2(a, b));
        }
    }
    return depth;
}

/* What of p lies left of a -> b. */
static flat_polygon left_of(const flat_polygon *p, const long double *a, const long double *b)
{
    flat_polygon out = {.count = 0};
    for (uint32_t i = 0; i < p->count; i++) {
        const long double *q = p->x[i];
        const long double *r = p->x[(i + 1) % p->count];
        long double side = cross2(a, b, q);
        long double next = cross2(a, b, r);
        if (side >= 0) {
            memcpy(out.x[out.count++], q, sizeof out.x[0]);
        }
        if ((side > 0 && next < 0) || (side < 0 && next > 0)) {
            long double t = side / (side - next);
            out.x[out.count][0] = q[0] + t * (r[0] - q[0]);
            out.x[out.count++][1] = q[1] + t * (r[1] - q[1]);
        }
    }
    return out;
}

static long double common_area(const flat_polygon *p, const flat_polygon *q)
{
    flat_polygon both = *p;
    for (uint32_t i = 0; i < q->count && both.count > 2; i++) {
        both = left_of(&both, q->x[i], q->x[(i + 1) % q->count]);
    }
    return both.count > 2 ? area_of(&both) : 0;
}

/* --- one scene -------------------------------------------------------------------------------- */

/* The largest distance of a facet's corners from the body's origin. */
static double farthest(uint32_t facet)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        const double *x = scene.vertex[scene.facet[facet].corner[i]].x;
        most = fmax(most, sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
    }
    return most;
}

/* Points of a ring: on the facet's plane, inside it, and where `view` says. */
static void check_points(const lrcs_ring *ring)
{
    const double *a = scene.vertex[scene.facet[ring->facet].corner[0]].x;
    const double *b = scene.vertex[scene.facet[ring->facet].corner[1]].x;
    const double *c = scene.vertex[scene.facet[ring->facet].corner[2]].x;
    flat_polygon whole = facet_of(ring->facet);
    double far = farthest(ring->facet);
    for (uint32_t i = 0; i < ring->count; i++) {
        const lrcs_ring_point *p = &polygons.point[ring->first + i];
        long double normal = 0;
        long double height = 0;
        long double seen[2] = {0, 0};
        const long double view[2] = {p->view[0], p->view[1]};
        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3;
            int n = (k + 2) % 3;
            long double N = ((long double)b[m] - a[m]) * ((long double)c[n] - a[n]) -
                            ((long double)b[n] - a[n]) * ((long double)c[m] - a[m]);
            normal += N * N;
            height += N * ((long double)p->body[k] - a[k]);
            seen[0] += (long double)pose.R[0][k] * p->body[k];
            seen[1] += (long double)pose.R[1][k] * p->body[k];
        }
        check_abs((double)(height / sqrtl(normal)), 0, 8 * U * far);
        check_most((double)distance2(seen, view), 256 * U * far);
        check_most(-(double)depth_in(&whole, view), 64 * U * far);
    }
}

/* The rings of a facet: convex and disjoint but for their points' rounding. Returns their area. */
static double check_rings(uint32_t first, uint32_t end)
{
    long double area = 0;
    for (uint32_t r = first; r < end; r++) {
        flat_polygon p = ring_of(&polygons.ring[r]);
        double off = 64 * U * farthest(polygons.ring[r].facet);
        check_points(&polygons.ring[r]);
        for (uint32_t i = 0; i < p.count; i++) {
            const long double *a = p.x[i];
            const long double *b = p.x[(i + 1) % p.count];
            const long double *c = p.x[(i + 2) % p.count];
            check_most(-(double)cross2(a, b, c), off * (double)(distance2(a, b) + distance2(b, c)));
        }
        for (uint32_t other = first; other < r; other++) {
            flat_polygon q = ring_of(&polygons.ring[other]);
            check_most((double)common_area(&p, &q), off * (double)perimeter_of(&p));
        }
        area += area_of(&p);
    }
    return (double)area;
}

/* The rings of a facet: first .. *end. */
static uint32_t rings_of(uint32_t facet, uint32_t *end)
{
    uint32_t first = 0;
    while (first < polygons.rings && polygons.ring[first].facet < facet) {
        first++;
    }
    *end = first;
    while (*end < polygons.rings && polygons.ring[*end].facet == facet) {
        (*end)++;
    }
    return first;
}

/* Areas of rings against the truth, the engine's own areas and its own bound. */
static void check_facet(uint32_t facet, double share)
{
    uint32_t end;
    uint32_t first = rings_of(facet, &end);
    double area = check_rings(first, end);
    double whole = scene.record[facet].area_m2 * fabs(scene.record[facet].cos_theta);
    double off = polygons.bound_m2;
    for (uint32_t r = first; r < end; r++) {
        flat_polygon p = ring_of(&polygons.ring[r]);
        off += 32 * U * farthest(facet) * (double)perimeter_of(&p);
    }
    check_abs(area, scene.record[facet].visible_area_m2, off);
    check_abs(area, share * whole, off + 1e-14 * whole);
}

static void rings_have_the_area_of_rational_arithmetic(void **state)
{
    (void)state;
    double worst = 0;
    unsigned rings = 0;
    for (size_t i = 0; i < CASES; i++) {
        visible_scene(&scene, &cases[i], 1);
        make_polygons(cases[i].direction);
        for (uint32_t f = 0; f < cases[i].facets; f++) {
            check_facet(f, fmax(0, cases[i].share[f]));
        }
        worst = fmax(worst, polygons.bound_m2);
        rings += polygons.rings;
    }
    check_most(worst, 1e-8); /* of scenes some 100 m^2 large */
    assert_true(rings > 2 * CASES);
}

static void wholly_visible_facets_are_one_ring_of_their_corners(void **state)
{
    (void)state;
    unsigned wholes = 0;
    for (size_t i = 0; i < CASES; i++) {
        visible_scene(&scene, &cases[i], 1);
        make_polygons(cases[i].direction);
        for (uint32_t f = 0; f < cases[i].facets; f++) {
            uint32_t end;
            uint32_t first = rings_of(f, &end);
            if (cases[i].share[f] <= 0) {
                assert_int_equal(first, end);
            } else if (cases[i].share[f] == 1) {
                assert_int_equal(first + 1, end);
                const lrcs_ring_point *p = &polygons.point[polygons.ring[first].first];
                int turned = p[1].body[0] != scene.vertex[scene.facet[f].corner[1]].x[0] ||
                             p[1].body[1] != scene.vertex[scene.facet[f].corner[1]].x[1] ||
                             p[1].body[2] != scene.vertex[scene.facet[f].corner[1]].x[2];
                for (int k = 0; k < 3; k++) {
                    uint32_t v = scene.facet[f].corner[turned ? (3 - k) % 3 : k];
                    assert_memory_equal(p[k].body, scene.vertex[v].x, sizeof p[k].body);
                }
                wholes++;
            }
        }
    }
    assert_true(wholes > CASES / 4);
}

/* --- samples in exact integers ---------------------------------------------------------------- */

#define PARTS 97

static int64_t dot3(const int64_t *a, const int64_t *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross3(const int64_t *a, const int64_t *b, int64_t out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static void corner_int(uint32_t facet, int k, int64_t factor, int64_t out[3])
{
    for (int j = 0; j < 3; j++) {
        out[j] = factor * (int64_t)scene.vertex[scene.facet[facet].corner[k]].x[j];
    }
}

static void normal_int(uint32_t facet, int64_t normal[3])
{
    int64_t x[3][3];
    for (int k = 0; k < 3; k++) {
        corner_int(facet, k, 1, x[k]);
    }
    for (int j = 0; j < 3; j++) {
        x[1][j] -= x[0][j];
        x[2][j] -= x[0][j];
    }
    cross3(x[1], x[2], normal);
}

/* Does `other` hide the point at / PARTS of `facet`? 1, 0, or -1 where the line meets its rim or
   the point itself lies on it. */
static int hides(uint32_t facet, uint32_t other, const int64_t *at, const int64_t *d)
{
    int64_t normal[3];
    int64_t own[3];
    int64_t gap[3];
    normal_int(other, normal);
    int64_t facing = dot3(normal, d);
    if (facing == 0) {
        return 0;
    }
    int rim = 0;
    for (int k = 0; k < 3; k++) {
        int64_t a[3];
        int64_t b[3];
        int64_t turn[3];
        corner_int(other, k, 1, a);
        corner_int(other, (k + 1) % 3, 1, b);
        for (int j = 0; j < 3; j++) {
            b[j] -= a[j];
            gap[j] = at[j] - PARTS * a[j];
        }
        cross3(b, gap, turn);
        int64_t side = dot3(turn, d) * (facing > 0 ? 1 : -1);
        if (side < 0) {
            return 0;
        }
        rim |= side == 0;
    }
    int64_t nearer = -dot3(normal, gap) * (facing > 0 ? 1 : -1);
    if (rim || nearer < 0) {
        return nearer < 0 ? 0 : -1;
    }
    normal_int(facet, own);
    cross3(own, normal, gap);
    if (nearer == 0 && dot3(gap, gap) != 0) {
        return -1;
    }
    int front = dot3(own, d) > 0;
    return nearer > 0 || (front != (facing > 0) ? !front : other < facet);
}

/* Is the point seen? 1, 0, or -1 where it cannot be said. */
static int seen(uint32_t facet, const int64_t *at, const int64_t *d)
{
    int answer = 1;
    for (uint32_t other = 0; other < scene.scene.facet_count; other++) {
        int hidden = other == facet ? 0 : hides(facet, other, at, d);
        if (hidden > 0) {
            return 0;
        }
        answer = hidden < 0 ? -1 : answer;
    }
    return answer;
}

/* In how many rings of the facet the point lies; -1 where it is on the rim of one. */
static int rings_around(uint32_t facet, const int64_t *at)
{
    uint32_t end;
    int count = 0;
    long double view[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        view[0] += (long double)pose.R[0][k] * at[k] / PARTS;
        view[1] += (long double)pose.R[1][k] * at[k] / PARTS;
    }
    for (uint32_t r = rings_of(facet, &end); r < end; r++) {
        flat_polygon p = ring_of(&polygons.ring[r]);
        long double depth = depth_in(&p, view);
        if (fabsl(depth) < 1e-11L) {
            return -1;
        }
        count += depth > 0;
    }
    return count;
}

static void rings_hold_just_the_points_that_are_seen(void **state)
{
    (void)state;
    uint64_t seed = 17;
    unsigned answers[2] = {0, 0};
    for (size_t i = 0; i < CASES; i++) {
        visible_scene(&scene, &cases[i], 0);
        make_polygons(cases[i].direction);
        int64_t d[3];
        for (int k = 0; k < 3; k++) {
            d[k] = (int64_t)cases[i].direction[k];
        }
        for (uint32_t n = 0; n < 40 * cases[i].facets; n++) {
            uint32_t f = n / 40;
            int64_t at[3] = {0, 0, 0};
            int64_t x[3];
            uint32_t p = 1 + random_below(&seed, PARTS - 2);
            uint32_t q = 1 + random_below(&seed, PARTS - 1 - p);
            const uint32_t part[3] = {p, q, PARTS - p - q};
            for (int c = 0; c < 3; c++) {
                corner_int(f, c, part[c], x);
                at[0] += x[0];
                at[1] += x[1];
                at[2] += x[2];
            }
            int want = cases[i].share[f] < 0 ? 0 : seen(f, at, d);
            int got = rings_around(f, at);
            if (want >= 0 && got >= 0) {
                if (got != want) {
                    fprintf(stderr, "scene %zu (%s), facet %u\n", i, cases[i].kind, f);
                }
                assert_int_equal(got, want);
                answers[want]++;
            }
        }
    }
    assert_true(answers[0] > 10000 && answers[1] > 10000);
}

/* --- size and memory -------------------------------------------------------------------------- */

/* A plate under `n` x `n` small ones. */
static void many_holes(int n)
{
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    for (int i = 0; i < n * n; i++) {
        scene_plate(&scene, (const double[3]){(i % n + 0.25) / n, (i / n + 0.25) / n, 1},
                    (const double[3]){0.5 / n, 0, 0}, (const double[3]){0, 0.5 / n, 0});
    }
}

static void scenes_far_and_small_keep_their_rings(void **state)
{
    (void)state;
    static const double factor[] = {0x1p-60, 1, 0x1p200};
    for (int i = 0; i < 3; i++) {
        many_holes(4);
        scene_move(&scene, factor[i],
                   (const double[3]){64 * factor[i], -3 * factor[i], 8 * factor[i]});
        make_polygons((const double[3]){0, 0, 1});
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            uint32_t end;
            uint32_t first = rings_of(f, &end);
            double whole = scene.record[f].area_m2;
            check_rel(check_rings(first, end) / whole, f < 2 ? 0.75 : 1, 1e-12);
        }
    }
}

static void empty_scenes_have_no_rings(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                   (const double[3]){2, 0, 0});
    make_polygons((const double[3]){0, 0, 1});
    assert_int_equal(polygons.rings, 0);
    assert_int_equal(polygons.points, 0);
    check_same(polygons.bound_m2, 0);
}

/* Two corners an ulp apart: in the view rounding puts them in one place. Found by fuzzing. */
static void a_needle_an_ulp_wide_is_a_ring_of_its_three_corners(void **state)
{
    (void)state;
    const double far[3] = {-7, -7, -4};
    const double one[3] = {-1, -1, 1};
    const double other[3] = {-1, -1 + 0x1p-53, 1};
    const double direction[3] = {1, 2, 3};
    scene_start(&scene);
    scene.material[0].two_sided = 1;
    scene_triangle(&scene, far, one, other);
    make_polygons(direction);
    assert_int_equal(polygons.rings, 1);
    assert_int_equal(polygons.points, 3);
    assert_int_equal(polygons.ring[0].count, 3);
    check_same(polygons.point[1].view[0], polygons.point[2].view[0]);
    check_same(polygons.point[1].view[1], polygons.point[2].view[1]);
}

static void more_rings_than_ordinary_ask_for_more_memory(void **state)
{
    (void)state;
    const double up[3] = {0, 0, 1};
    many_holes(16);
    scene.scene.facet_count = 2 + 2 * 16 * 16;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(up, &pose), LRCS_OK);
    lrcs_work after = work;
    lrcs_polygons want;
    assert_int_equal(lrcs_polygon_run(prepared, &pose, &work, &want), LRCS_OK);
    size_t peak = work.peak;
    int before = LRCS_E_MEMORY;
    for (size_t size = after.used; size < peak + 4096; size += 997) {
        lrcs_work little = after;
        lrcs_polygons untouched;
        memset(&polygons, 0x55, sizeof polygons);
        memset(&untouched, 0x55, sizeof untouched);
        little.size = size;
        little.peak = 0;
        int status = lrcs_polygon_run(prepared, &pose, &little, &polygons);
        if (status == LRCS_OK) {
            assert_int_equal(polygons.rings, want.rings);
            assert_int_equal(polygons.points, want.points);
        } else {
            assert_int_equal(status, LRCS_E_MEMORY);
            assert_true(before == LRCS_E_MEMORY && little.peak > size);
            assert_int_equal(little.used, after.used);
            assert_memory_equal(&polygons, &untouched, sizeof untouched);
        }
        before = status;
    }
    assert_int_equal(before, LRCS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_have_the_area_of_rational_arithmetic),
        cmocka_unit_test(wholly_visible_facets_are_one_ring_of_their_corners),
        cmocka_unit_test(rings_hold_just_the_points_that_are_seen),
        cmocka_unit_test(scenes_far_and_small_keep_their_rings),
        cmocka_unit_test(empty_scenes_have_no_rings),
        cmocka_unit_test(a_needle_an_ulp_wide_is_a_ring_of_its_three_corners),
        cmocka_unit_test(more_rings_than_ordinary_ask_for_more_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
