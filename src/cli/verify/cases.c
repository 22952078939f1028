/* SPDX-License-Identifier: MIT */
/* The hard cases of `lrcs verify --hard`: bodies and facets for which plain double formulas fail,
   with the correct answers. References are computed by test/vectors/hard.py with 50 digits; the
   tests compare them with its output. */
#include "cli/verify/verify.h"

#include <math.h>

/* --- facets by hand --------------------------------------------------------------------------- */

static uint32_t hand_vertex(hard_mesh *mesh, double x, double y, double z)
{
    mesh->vertex[mesh->vertices] = (lrcs_point){{x, y, z}};
    return mesh->vertices++;
}

static void hand_facet(hard_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->facet[mesh->facets] = (lrcs_facet){{a, b, c}};
    mesh->material[mesh->facets++] = mesh->wears;
}

/* The parallelogram corner, + u, + u + v, + v; front along u x v. */
static void hand_plate(hard_mesh *mesh, const double corner[3], const double u[3],
                       const double v[3])
{
    const double *c = corner;
    uint32_t i = hand_vertex(mesh, c[0], c[1], c[2]);
    hand_vertex(mesh, c[0] + u[0], c[1] + u[1], c[2] + u[2]);
    hand_vertex(mesh, c[0] + u[0] + v[0], c[1] + u[1] + v[1], c[2] + u[2] + v[2]);
    hand_vertex(mesh, c[0] + v[0], c[1] + v[1], c[2] + v[2]);
    hand_facet(mesh, i, i + 1, i + 2);
    hand_facet(mesh, i, i + 2, i + 3);
}

/* A square with the given side, from a corner; front on +z. */
static void hand_square(hard_mesh *mesh, double x, double y, double z, double side)
{
    hand_plate(mesh, (const double[3]){x, y, z}, (const double[3]){side, 0.0, 0.0},
               (const double[3]){0.0, side, 0.0});
}

/* From the origin to (a, b, c), closed, outward. */
static void hand_box(hard_mesh *mesh, double a, double b, double c)
{
    static const uint32_t quad[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int i = 0; i < 8; i++) {
        hand_vertex(mesh, i & 1 ? a : 0.0, i & 2 ? b : 0.0, i & 4 ? c : 0.0);
    }
    for (int i = 0; i < 6; i++) {
        hand_facet(mesh, quad[i][0], quad[i][1], quad[i][2]);
        hand_facet(mesh, quad[i][0], quad[i][2], quad[i][3]);
    }
}

static void build_plate(hard_mesh *mesh)
{
    hand_square(mesh, 0.0, 0.0, 0.0, 1.0);
}

static void build_tilted_plate(hard_mesh *mesh)
{
    hand_plate(mesh, (const double[3]){0.25, -0.75, 0.5}, (const double[3]){1.0, 2.0, 3.0},
               (const double[3]){-2.0, 1.0, 0.5});
}

/* The tip is 2^-40 away from the middle of the long side. */
static void build_needle(hard_mesh *mesh)
{
    const double third = 1.0 / 3.0;
    hand_vertex(mesh, 0.0, 0.0, 0.0);
    hand_vertex(mesh, 1.0, third, 0.25);
    hand_vertex(mesh, 0.5 + 0x1p-40, 0.5 * third, 0.125);
    hand_facet(mesh, 0, 1, 2);
}

static void build_sliver(hard_mesh *mesh)
{
    hand_vertex(mesh, 0.0, 0.0, 0.0);
    hand_vertex(mesh, 1.0, 0.0, 0.0);
    hand_vertex(mesh, 0.5, 0x1p-27, 0.0);
    hand_facet(mesh, 0, 1, 2);
}

static void build_plate_with_a_facet_of_no_area(hard_mesh *mesh)
{
    build_plate(mesh);
    hand_vertex(mesh, 0.5, 0.5, 0.0);
    hand_facet(mesh, 0, 4, 2);
}

static void build_small_box(hard_mesh *mesh)
{
    hand_box(mesh, 0x1p-500, 0x1p-500, 0x1p-500);
}

static void build_large_box(hard_mesh *mesh)
{
    hand_box(mesh, 0x1p300, 0x1p300, 0x1p300);
}

/* A plate, and a black wall on its edge that shadows it. */
static void hand_bracket(hard_mesh *mesh, double at, double side)
{
    hand_square(mesh, at, at, at, side);
    mesh->wears = 1;
    hand_plate(mesh, (const double[3]){at + side, at, at}, (const double[3]){0.0, side, 0.0},
               (const double[3]){0.0, 0.0, side});
}

static void build_bracket(hard_mesh *mesh)
{
    hand_bracket(mesh, 0.0, 1.0);
}

static void build_small_bracket(hard_mesh *mesh)
{
    hand_bracket(mesh, 0.0, 0x1p-20);
}

static void build_far_bracket(hard_mesh *mesh)
{
    hand_bracket(mesh, 0x1p20, 1.0);
}

static void build_comb(hard_mesh *mesh)
{
    hand_plate(mesh, (const double[3]){0.0, 0.0, 0.0}, (const double[3]){5.0, 0.0, 0.0},
               (const double[3]){0.0, 1.0, 0.0});
    for (int i = 1; i <= 40; i++) {
        hand_plate(mesh, (const double[3]){0.125 * i, 0.0, 0.0}, (const double[3]){0.0, 1.0, 0.0},
                   (const double[3]){0.0, 0.0, 1.0});
    }
}

static void build_crossing_plates(hard_mesh *mesh)
{
    hand_plate(mesh, (const double[3]){-1.0, 0.0, -1.0}, (const double[3]){2.0, 0.0, 2.0},
               (const double[3]){0.0, 1.0, 0.0});
    hand_plate(mesh, (const double[3]){-1.0, 0.0, 1.0}, (const double[3]){2.0, 0.0, -2.0},
               (const double[3]){0.0, 1.0, 0.0});
}

static void build_doubled_plate(hard_mesh *mesh)
{
    build_plate(mesh);
    build_plate(mesh);
}

static void build_overlapping_plates(hard_mesh *mesh)
{
    hand_square(mesh, 0.0, 0.0, 0.0, 2.0);
    hand_square(mesh, 1.0, 1.0, 0.0, 2.0);
}

static void build_skins(hard_mesh *mesh)
{
    hand_square(mesh, 0.0, 0.0, 1.0, 1.0);
    hand_square(mesh, 0.0, 0.0, 1.0 + 0x1p-52, 1.0);
}

static void build_inverted_box(hard_mesh *mesh)
{
    hand_box(mesh, 1.0, 1.0, 1.0);
    for (uint32_t f = 0; f < mesh->facets; f++) {
        uint32_t other = mesh->facet[f].corner[1];
        mesh->facet[f].corner[1] = mesh->facet[f].corner[2];
        mesh->facet[f].corner[2] = other;
    }
}

/* The ray from the facet's centroid to the laser meets the screen on its diagonal. */
static void build_screened_facet(hard_mesh *mesh)
{
    hand_vertex(mesh, -1.5, -3.0, 3.0);
    hand_vertex(mesh, -2.0, -2.5, 3.0);
    hand_vertex(mesh, -2.5, -3.5, 3.0);
    hand_facet(mesh, 0, 1, 2);
    mesh->wears = 1;
    hand_square(mesh, -5.0, -5.0, 8.0, 10.0);
}

static void build_t_junction(hard_mesh *mesh)
{
    hand_box(mesh, 3.0, 2.0, 1.0);
    /* on the diagonal of the top, from 7 to 4 */
    uint32_t middle = hand_vertex(mesh, 1.5, 1.0, 1.0);
    mesh->facet[10] = (lrcs_facet){{4, 5, middle}};
    hand_facet(mesh, 5, 7, middle);
}

static void build_nothing(hard_mesh *mesh)
{
    mesh->facets = 0;
}

/* One corner of the plate has a coordinate that is not a number. */
static void build_nan(hard_mesh *mesh)
{
    build_plate(mesh);
    mesh->vertex[2].x[0] = (double)NAN;
}

static void build_1e308(hard_mesh *mesh)
{
    build_plate(mesh);
    mesh->vertex[2].x[0] = 1e308;
}

static void build_beyond_1e100(hard_mesh *mesh)
{
    hand_square(mesh, 0.0, 0.0, 0.0, 1.01e100);
}

/* --- the cases -------------------------------------------------------------------------------- */

#define DEFAULT_BRDF                                                                               \
    {                                                                                              \
        1.0, 0.25, 0.2, 0.5                                                                        \
    }

static const hard_case hard_cases[] = {
    {.name = "sphere, s = 0.02",
     .naive = cli_naive_sphere,
     .reference_m2 = 5.6555684681635086,
     .brdf = {1.0, 0.25, 0.02, 0.5},
     .shape = {.kind = LRCS_SHAPE_SPHERE, .radius = 1.0}},
    {.name = "cylinder broadside, m = 10000",
     .naive = cli_naive_cylinder,
     .reference_m2 = 4.622493853433156,
     .brdf = {1.0, 0.25, 0.2, 1e4},
     .shape = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_WALL, .radius = 0.5, .length = 2.0},
     .aspect_deg = 90.0},
    {.name = "cylinder broadside, s = 0.0001",
     .naive = cli_naive_steps,
     .reference_m2 = 2231.848092140638,
     .brdf = {1e6, 0.25, 1e-4, 0.5},
     .shape = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_WALL, .radius = 0.5, .length = 2.0},
     .aspect_deg = 90.0},
    {.name = "cylinder wall seen end-on",
     .naive = cli_naive_cylinder,
     .reference_m2 = 0.0,
     .brdf = DEFAULT_BRDF,
     .shape = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_WALL, .radius = 0.5, .length = 2.0}},
    {.name = "cone of 1e-9 deg, nose-on",
     .naive = cli_naive_cone,
     .reference_m2 = 1.7991020791173928e-16,
     .brdf = DEFAULT_BRDF,
     .shape = {LRCS_SHAPE_CONE, LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 1e-9}},
    {.name = "cone of 89.9999 deg, s = 1e-6",
     .naive = cli_naive_cone,
     .reference_m2 = 2.936606606752193,
     .brdf = {1.0, 0.25, 1e-6, 0.5},
     .shape = {LRCS_SHAPE_CONE, LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 89.9999}},
    {.name = "cone along its side, s = 0.001",
     .naive = cli_naive_steps,
     .reference_m2 = 56.86808007367455,
     .brdf = {1e4, 0.25, 1e-3, 0.5},
     .shape = {LRCS_SHAPE_CONE, LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 45.0},
     .aspect_deg = 45.0},
    {.name = "paraboloid, m = 1",
     .naive = cli_naive_paraboloid,
     .reference_m2 = 1.394408727595629,
     .brdf = {1.0, 0.25, 0.2, 1.0},
     .shape = {LRCS_SHAPE_PARABOLOID, LRCS_SHAPE_WALL, .radius = 0.5, .length = 0.4}},
    {.name = "paraboloid 1e-6 deep",
     .naive = cli_naive_paraboloid,
     .reference_m2 = 49.34802200531355,
     .brdf = {1.0, 0.25, 0.5, 0.5},
     .shape = {LRCS_SHAPE_PARABOLOID, LRCS_SHAPE_WALL, .radius = 1.0, .length = 1e-6}},
    {.name = "plate 1e-60 rad from edge-on",
     .naive = cli_naive_facets,
     .reference_m2 = 3.141592653589793e-150,
     .brdf = DEFAULT_BRDF,
     .build = build_plate,
     .direction = {1.0, 0.0, 1e-60}},
    {.name = "plate exactly edge-on",
     .naive = cli_naive_facets,
     .reference_m2 = 0.0,
     .brdf = DEFAULT_BRDF,
     .build = build_tilted_plate,
     .direction = {-2.0, 1.0, 0.5}},
    {.name = "glint 1e-6 wide, 2e-6 off normal",
     .naive = cli_naive_facets,
     .reference_m2 = 3.37175375989053,
     .brdf = {1.0, 0.25, 1e-6, 0.5},
     .build = build_plate,
     .direction = {2e-6, 0.0, 1.0}},
    {.name = "glint that underflows, 63 deg",
     .naive = cli_naive_facets,
     .reference_m2 = 0.4201819258546651,
     .brdf = {1.0, 0.25, 1e-3, 0.5},
     .build = build_plate,
     .direction = {2.0, 0.0, 1.0}},
    {.name = "needle of aspect 1e12",
     .naive = cli_naive_facets,
     .reference_m2 = 9.142305073567316e-13,
     .brdf = DEFAULT_BRDF,
     .build = build_needle,
     .direction = {1.0, 2.0, -3.0}},
    {.name = "sliver of aspect 1e8, Heron",
     .naive = cli_naive_heron,
     .reference_m2 = 8.363415557206288e-09,
     .brdf = DEFAULT_BRDF,
     .build = build_sliver,
     .direction = {1.0, 2.0, 4.0}},
    {.name = "facet of no area",
     .naive = cli_naive_facets,
     .reference_m2 = 2.245037268816164,
     .brdf = DEFAULT_BRDF,
     .build = build_plate_with_a_facet_of_no_area,
     .direction = {1.0, 2.0, 4.0}},
    {.name = "box of 2^-500 m",
     .naive = cli_naive_facets,
     .reference_m2 = 2.40844876043914e-301,
     .brdf = DEFAULT_BRDF,
     .build = build_small_box,
     .direction = {1.0, 2.0, 3.0}},
    {.name = "box of 2^300 m",
     .naive = cli_naive_facets,
     .reference_m2 = 1.0708545185038595e+181,
     .brdf = DEFAULT_BRDF,
     .build = build_large_box,
     .direction = {1.0, 2.0, 3.0}},
    {.name = "L-bracket, 3/8 in shadow",
     .naive = cli_naive_facets,
     .reference_m2 = 1.9694972031069977,
     .brdf = DEFAULT_BRDF,
     .build = build_bracket,
     .direction = {3.0, 0.0, 8.0}},
    {.name = "the same, 2^-20 of its size",
     .naive = cli_naive_facets,
     .reference_m2 = 1.7912472713824152e-12,
     .brdf = DEFAULT_BRDF,
     .build = build_small_bracket,
     .direction = {3.0, 0.0, 8.0}},
    {.name = "the same, moved 2^20 m",
     .naive = cli_naive_facets,
     .reference_m2 = 1.9694972031069977,
     .brdf = DEFAULT_BRDF,
     .build = build_far_bracket,
     .direction = {3.0, 0.0, 8.0}},
    {.name = "comb of 40 fins",
     .naive = cli_naive_facets,
     .reference_m2 = 4.51695570293765,
     .brdf = DEFAULT_BRDF,
     .build = build_comb,
     .direction = {1.0, 0.0, 2.0}},
    {.name = "plates that cross",
     .naive = cli_naive_facets,
     .reference_m2 = 9.01452369216667,
     .brdf = DEFAULT_BRDF,
     .build = build_crossing_plates,
     .direction = {1.0, 0.0, 2.0}},
    {.name = "facets given twice",
     .naive = cli_naive_facets,
     .reference_m2 = 2.245037268816164,
     .brdf = DEFAULT_BRDF,
     .build = build_doubled_plate,
     .direction = {1.0, 2.0, 4.0}},
    {.name = "two plates that share a quarter",
     .naive = cli_naive_facets,
     .reference_m2 = 109.95574287564277,
     .brdf = DEFAULT_BRDF,
     .build = build_overlapping_plates,
     .direction = {0.0, 0.0, 1.0}},
    {.name = "skins one ulp apart",
     .naive = cli_naive_facets,
     .reference_m2 = 15.707963267948966,
     .brdf = DEFAULT_BRDF,
     .build = build_skins,
     .direction = {0.0, 0.0, 1.0}},
    {.name = "box inside out",
     .naive = cli_naive_facets,
     .reference_m2 = 0.0,
     .brdf = DEFAULT_BRDF,
     .build = build_inverted_box,
     .direction = {1.0, 2.0, 3.0}},
    {.name = "wholly behind a screen",
     .naive = cli_naive_facets,
     .reference_m2 = 0.0,
     .brdf = DEFAULT_BRDF,
     .build = build_screened_facet,
     .direction = {2.0, 3.0, 5.0}},
    {.name = "box with a T-junction",
     .naive = cli_naive_facets,
     .reference_m2 = 13.051277838328186,
     .brdf = DEFAULT_BRDF,
     .build = build_t_junction,
     .direction = {1.0, 2.0, 3.0}},
    {.name = "empty scene",
     .naive = cli_naive_facets,
     .reference_m2 = 0.0,
     .brdf = DEFAULT_BRDF,
     .build = build_nothing,
     .direction = {0.0, 0.0, 1.0}},
    {.name = "a coordinate NaN",
     .naive = cli_naive_facets,
     .reference_m2 = (double)NAN,
     .brdf = DEFAULT_BRDF,
     .build = build_nan,
     .direction = {0.0, 0.0, 1.0}},
    {.name = "a coordinate of 1e308 m",
     .naive = cli_naive_facets,
     .reference_m2 = (double)NAN,
     .brdf = DEFAULT_BRDF,
     .build = build_1e308,
     .direction = {0.0, 0.0, 1.0}},
    {.name = "a plate beyond 1e100 m",
     .naive = cli_naive_facets,
     .reference_m2 = (double)NAN,
     .brdf = DEFAULT_BRDF,
     .build = build_beyond_1e100,
     .direction = {0.0, 0.0, 1.0}},
};

const hard_case *cli_hard_case(size_t i)
{
    return i < sizeof hard_cases / sizeof hard_cases[0] ? &hard_cases[i] : NULL;
}
