/* SPDX-License-Identifier: MIT */
/* Convexity is proved or refused: bodies one ulp either side, and closed surfaces that are convex
   at every edge and yet no convex body. */
#include "mesh/convex.h"

#include "check.h"

enum { ROOM = 4 << 20, MOST = 4200 };

static unsigned char room[ROOM];
static lrcs_point vertex[MOST];
static lrcs_facet facet[MOST];
static uint32_t vertices, facets;

static lrcs_mesh_report report_now(void)
{
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcs_mesh_report report;
    assert_int_equal(lrcs_mesh_check(vertex, vertices, facet, facets, &work, &report), LRCS_OK);
    return report;
}

/* The report must not depend on where the list of facets or of corners starts. */
static int convex_now(void)
{
    int convex = report_now().convex;
    for (int turn = 0; turn < 3; turn++) {
        lrcs_facet first = facet[0];
        for (uint32_t f = 0; f < facets; f++) {
            lrcs_facet g = f + 1 < facets ? facet[f + 1] : first;
            facet[f] = (lrcs_facet){{g.corner[1], g.corner[2], g.corner[0]}};
        }
        assert_int_equal(report_now().convex, convex);
    }
    return convex;
}

static void clear(void)
{
    vertices = facets = 0;
}

static uint32_t add_point(double x, double y, double z)
{
    vertex[vertices] = (lrcs_point){{x, y, z}};
    return vertices++;
}

static void add_facet(uint32_t a, uint32_t b, uint32_t c)
{
    facet[facets++] = (lrcs_facet){{a, b, c}};
}

static void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_facet(a, b, c);
    add_facet(a, c, d);
}

/* A ring of points, then a pyramid up and one down from it. */
static void add_bipyramid(uint32_t ring, uint32_t n, uint32_t top, uint32_t bottom)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t next = (i + 1) % n;
        add_facet(top, ring + i, ring + next);
        add_facet(bottom, ring + next, ring + i);
    }
}

static void make_cube(double x, double size)
{
    uint32_t o = vertices;
    for (uint32_t i = 0; i < 8; i++) {
        add_point(x + (i & 1 ? size : 0), i & 2 ? size : 0, i & 4 ? size : 0);
    }
    add_quad(o, o + 2, o + 3, o + 1);
    add_quad(o + 4, o + 5, o + 7, o + 6);
    add_quad(o, o + 1, o + 5, o + 4);
    add_quad(o + 2, o + 6, o + 7, o + 3);
    add_quad(o, o + 4, o + 6, o + 2);
    add_quad(o + 1, o + 3, o + 7, o + 5);
}

static void a_cube_is_convex_and_two_are_not(void **state)
{
    (void)state;
    clear();
    make_cube(0, 1);
    assert_true(convex_now());
    make_cube(5, 1);
    assert_true(report_now().closed && !convex_now());
}

/* Every face in n x n squares: flat points, edge points that are wedges, corners. */
static void a_gridded_cube_is_convex(void **state)
{
    (void)state;
    enum { N = 4 };
    clear();
    for (uint32_t side = 0; side < 6; side++) {
        uint32_t o = vertices;
        uint32_t k = side / 2;
        for (uint32_t i = 0; i <= N; i++) {
            for (uint32_t j = 0; j <= N; j++) {
                double x[3];
                x[k] = side % 2 ? N : 0;
                x[(k + 1) % 3] = side % 2 ? i : j;
                x[(k + 2) % 3] = side % 2 ? j : i;
                add_point(x[0], x[1], x[2]);
            }
        }
        for (uint32_t i = 0; i < N; i++) {
            for (uint32_t j = 0; j < N; j++) {
                uint32_t at = o + i * (N + 1) + j;
                add_quad(at, at + N + 1, at + N + 2, at + 1);
            }
        }
    }
    lrcs_mesh_report r = report_now();
    check_same(r.volume, N * N * N);
    assert_int_equal(r.vertices, 6 * N * N + 2);
    assert_true(convex_now());
}

/* A cube whose top has a point in its middle, lifted to `height`. */
static void make_roof(double height)
{
    clear();
    make_cube(0, 2);
    uint32_t top = add_point(1, 1, height);
    facet[2] = (lrcs_facet){{4, 5, top}};
    facet[3] = (lrcs_facet){{5, 7, top}};
    add_facet(7, 6, top);
    add_facet(6, 4, top);
}

static void one_ulp_of_dent_is_refused(void **state)
{
    (void)state;
    make_roof(2.0);
    assert_true(report_now().closed && convex_now());
    make_roof(nextafter(2.0, 3.0));
    assert_true(convex_now());
    make_roof(nextafter(2.0, 1.0));
    assert_true(report_now().closed && !convex_now());
}

/* Points on a parabola are a strictly convex ring; its apexes are points of many facets. */
static void a_bipyramid_over_a_thousand_points_is_convex(void **state)
{
    (void)state;
    enum { N = 1000 };
    clear();
    for (int i = 0; i < N; i++) {
        add_point(i, (double)i * i, 0);
    }
    uint32_t top = add_point(N / 2, 400000, 7);
    uint32_t bottom = add_point(N / 2, 400000, -1e-9);
    add_bipyramid(0, N, top, bottom);
    assert_true(convex_now());
    vertex[N / 2].x[1] += 1.0; /* on the line between its neighbours: still convex */
    assert_true(convex_now());
    vertex[N / 2].x[1] = nextafter(vertex[N / 2].x[1], 1e9);
    assert_true(report_now().closed && !convex_now());
}

/* Points of a regular n-gon, joined each to the one `step` further. */
static void make_star(uint32_t n, uint32_t step, double shrink)
{
    clear();
    for (uint32_t i = 0; i < n; i++) {
        double a = 2.0 * 3.14159265358979 * (double)(step * i % n) / (double)n;
        double r = i < n / 2 ? 1.0 : shrink;
        add_point(r * cos(a), r * sin(a), 0);
    }
}

static void a_star_bipyramid_is_refused(void **state)
{
    (void)state;
    make_star(5, 1, 1.0);
    add_bipyramid(0, 5, add_point(0, 0, 1), add_point(0, 0, -1));
    assert_true(convex_now());
    make_star(5, 2, 1.0);
    add_bipyramid(0, 5, add_point(0, 0, 1), add_point(0, 0, -1));
    lrcs_mesh_report r = report_now();
    assert_true(r.closed && !convex_now());
    assert_int_equal(r.nonmanifold_edges + r.misoriented_edges, 0);
    make_star(7, 3, 1.0);
    add_bipyramid(0, 7, add_point(0, 0, 1), add_point(0, 0, -1));
    assert_true(report_now().closed && !convex_now());
}

/* The same rays twice, the second time shorter: welding does not tell the two rounds apart by
   direction, only by length. */
static void a_ring_wound_twice_on_the_same_rays_is_refused(void **state)
{
    (void)state;
    clear();
    static const double x[3] = {4, -4, 0};
    static const double y[3] = {-4, -4, 4};
    for (int i = 0; i < 6; i++) {
        double r = i < 3 ? 1.0 : 0.5;
        add_point(r * x[2 - i % 3], r * y[2 - i % 3], 0);
    }
    add_bipyramid(0, 6, add_point(0, 0, 1), add_point(0, 0, -1));
    assert_true(report_now().closed && !convex_now());
    clear();
    for (int i = 0; i < 6; i++) { /* the other way round */
        double r = i < 3 ? 1.0 : 0.5;
        add_point(r * x[i % 3], r * y[i % 3], 0);
    }
    add_bipyramid(0, 6, add_point(0, 0, 1), add_point(0, 0, -1));
    assert_true(report_now().closed && !convex_now());
}

/* A prism over a pentagram with fans for caps: flat at the caps, a crease at every wall. */
static void make_prism(uint32_t n, uint32_t step)
{
    make_star(n, step, 1.0);
    for (uint32_t i = 0; i < n; i++) {
        add_point(vertex[i].x[0], vertex[i].x[1], 1);
    }
    uint32_t low = add_point(0, 0, 0);
    uint32_t high = add_point(0, 0, 1);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = (i + 1) % n;
        add_quad(i, j, n + j, n + i);
        add_facet(low, j, i);
        add_facet(high, n + i, n + j);
    }
}

static void a_star_prism_with_flat_caps_is_refused(void **state)
{
    (void)state;
    make_prism(5, 1);
    assert_true(convex_now());
    make_prism(5, 2);
    assert_true(report_now().closed && !convex_now());
}

static void flat_bodies_are_refused(void **state)
{
    (void)state;
    clear();
    add_point(0, 0, 0);
    add_point(1, 0, 0);
    add_point(0, 1, 0);
    add_facet(0, 1, 2);
    add_facet(0, 2, 1);
    assert_true(report_now().closed && !convex_now());
    clear(); /* a tetrahedron of no height */
    add_point(0, 0, 0);
    add_point(4, 0, 0);
    add_point(0, 4, 0);
    add_point(1, 1, 0);
    add_facet(0, 2, 1);
    add_facet(0, 1, 3);
    add_facet(1, 2, 3);
    add_facet(2, 0, 3);
    assert_true(report_now().closed && !convex_now());
    vertex[3].x[2] = 0x1p-200;
    assert_true(convex_now());
    vertex[3].x[2] = -0x1p-200;
    assert_true(!convex_now());
}

static void two_bodies_that_share_a_point_are_refused(void **state)
{
    (void)state;
    clear();
    make_cube(0, 1);
    make_cube(1, 1);
    for (uint32_t i = 8; i < 16; i++) {
        vertex[i].x[1] += 1;
        vertex[i].x[2] += 1;
    }
    lrcs_mesh_report r = report_now();
    assert_int_equal(r.vertices, 15);
    assert_true(r.closed && !convex_now());
}

static void a_ring_of_boxes_is_refused(void **state)
{
    (void)state;
    clear();
    for (uint32_t i = 0; i < 4; i++) { /* a square torus: inner edges are concave */
        double x = i == 0 || i == 3 ? -1 : 1;
        double y = i < 2 ? -1 : 1;
        add_point(x, y, 0);
        add_point(2 * x, 2 * y, 0);
        add_point(2 * x, 2 * y, 1);
        add_point(x, y, 1);
    }
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t a = 4 * i;
        uint32_t b = 4 * ((i + 1) % 4);
        for (uint32_t k = 0; k < 4; k++) {
            add_quad(a + k, a + (k + 1) % 4, b + (k + 1) % 4, b + k);
        }
    }
    lrcs_mesh_report r = report_now();
    assert_true(r.closed && !convex_now());
    check_same(fabs(r.volume), 12.0);
}

/* The same body, the facets at `bottom` listed first: its point is then the first one judged. */
static void add_spindle(uint32_t ring, uint32_t n, uint32_t top, uint32_t bottom, uint32_t from)
{
    for (uint32_t i = from; i < from + n; i++) {
        add_facet(bottom, ring + (i + 1) % n, ring + i % n);
    }
    for (uint32_t i = 0; i < n; i++) {
        add_facet(top, ring + i, ring + (i + 1) % n);
    }
}

/* A ring that winds twice: from +x by +y and -x to -y in the plane of the bottom point, then on
   through three points above it. */
static const double loop[8][3] = {{8, 0, 0}, {0, 8, 0},  {-8, 0, 0},  {0, -8, 0},
                                  {8, 8, 8}, {-8, 8, 8}, {-8, -8, 8}, {0, 0, 16}};

static void a_plane_fan_of_more_than_half_a_turn_is_refused(void **state)
{
    (void)state;
    clear();
    for (int i = 0; i < 8; i++) {
        add_point(loop[i][0], loop[i][1], loop[i][2]);
    }
    add_spindle(0, 7, 7, add_point(0, 0, 0), 0);
    lrcs_mesh_report r = report_now();
    assert_true(r.closed && !convex_now());
    assert_int_equal(r.nonmanifold_edges + r.misoriented_edges, 0);
}

/* The same where one of a wedge's two planes is wound one and a half times. */
static void a_wedge_wound_more_than_once_is_refused(void **state)
{
    (void)state;
    static const double x[8][3] = {{8, 0, 0},  {0, 8, 0},  {-8, 0, 0},  {0, -8, 0},
                                   {16, 0, 0}, {0, 16, 0}, {-16, 0, 0}, {0, -8, 8}};
    for (uint32_t from = 0; from < 8; from++) {
        clear();
        for (int i = 0; i < 8; i++) {
            add_point(x[i][0], x[i][1], x[i][2]);
        }
        uint32_t top = add_point(0, 0, 16);
        add_spindle(0, 8, top, add_point(0, 0, 0), from);
        lrcs_mesh_report r = report_now();
        assert_true(r.closed && !convex_now());
        assert_int_equal(r.nonmanifold_edges + r.misoriented_edges, 0);
    }
}

static void add_fan(uint32_t middle, uint32_t a, uint32_t b, uint32_t c)
{
    add_facet(middle, a, b);
    add_facet(middle, b, c);
    add_facet(middle, c, a);
}

/* Two facets of the body wound twice cross; a point on both makes two fans of one place. */
static void a_point_of_two_fans_is_refused(void **state)
{
    (void)state;
    clear();
    for (int i = 0; i < 8; i++) {
        add_point(loop[i][0], loop[i][1], loop[i][2]);
    }
    uint32_t bottom = add_point(0, 0, 0);
    uint32_t both = add_point(2, -2, 2);
    uint32_t below = add_point(1, -1, 1); /* on one of them only */
    add_fan(both, 4, 3, bottom);
    add_fan(both, 0, 6, below);
    add_facet(below, 6, bottom);
    add_facet(below, bottom, 0);
    add_spindle(0, 7, 7, bottom, 0);
    facet[8 + 3] = facet[--facets]; /* in place of the facets divided */
    facet[8 + 6] = facet[--facets];
    lrcs_mesh_report r = report_now();
    assert_true(r.closed && !convex_now());
    assert_int_equal(r.nonmanifold_edges + r.misoriented_edges, 0);
}

static void a_proof_without_enough_memory_says_so(void **state)
{
    (void)state;
    clear();
    make_cube(0, 1);
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology topology;
    assert_int_equal(lrcsi_topology_make(vertex, vertices, facet, facets, &work, &topology),
                     LRCS_OK);
    int status = LRCS_E_MEMORY;
    int convex = 77;
    for (size_t size = 0; status == LRCS_E_MEMORY; size++) {
        lrcs_work little = lrcs_work_make(room + work.used, size);
        assert_true(size <= lrcsi_convex_need(vertices, facets));
        assert_int_equal(convex, 77);
        status = lrcsi_convex_prove(vertex, vertices, facet, facets, &topology, &little, &convex);
        assert_int_equal(little.used, 0);
    }
    assert_int_equal(status, LRCS_OK);
    assert_int_equal(convex, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_convex_and_two_are_not),
        cmocka_unit_test(a_gridded_cube_is_convex),
        cmocka_unit_test(one_ulp_of_dent_is_refused),
        cmocka_unit_test(a_bipyramid_over_a_thousand_points_is_convex),
        cmocka_unit_test(a_star_bipyramid_is_refused),
        cmocka_unit_test(a_ring_wound_twice_on_the_same_rays_is_refused),
        cmocka_unit_test(a_star_prism_with_flat_caps_is_refused),
        cmocka_unit_test(flat_bodies_are_refused),
        cmocka_unit_test(two_bodies_that_share_a_point_are_refused),
        cmocka_unit_test(a_ring_of_boxes_is_refused),
        cmocka_unit_test(a_plane_fan_of_more_than_half_a_turn_is_refused),
        cmocka_unit_test(a_wedge_wound_more_than_once_is_refused),
        cmocka_unit_test(a_point_of_two_fans_is_refused),
        cmocka_unit_test(a_proof_without_enough_memory_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
