/* SPDX-License-Identifier: MIT */
/* Range profiles: closed forms of plates, bins against triangles cut in long double, their sum
   against sigma, edges, pulses, limits. */
#include <lrcs/profile.h>

#include "curved.h"
#include "integrate/range/range_bins.h"
#include "memory_limit.h"
#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static lrcs_pose pose;
static lrcs_profile profile;

static int profile_try(const double direction[3], double bin)
{
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    return lrcs_profile_run(prepared, &pose, bin, &work, &profile);
}

static void profile_make(const double direction[3], double bin)
{
    assert_int_equal(profile_try(direction, bin), LRCS_OK);
}

static double sigma_of(uint32_t i)
{
    return profile.bin[i].sigma_glint_m2 + profile.bin[i].sigma_diffuse_m2;
}

/* The bin of number k; nothing where the profile has none. */
static lrcs_profile_bin bin_at(int64_t k)
{
    int inside = k >= profile.first && k < profile.first + profile.count;
    return inside ? profile.bin[k - profile.first] : (lrcs_profile_bin){0, 0, 0, 0, 0, 0};
}

static void check_bin(int64_t k, long double truth)
{
    lrcs_profile_bin bin = bin_at(k);
    check_abs(bin.sigma_glint_m2 + bin.sigma_diffuse_m2, (double)truth,
              bin.bound_m2 + 4e-16 * (double)fabsl(truth));
}

/* A plate of 2 x 1 in the plane z = height. */
static void plate_at(double height)
{
    const double corner[3] = {-1, -0.5, height};
    const double u[3] = {2, 0, 0};
    const double v[3] = {0, 1, 0};
    scene_start(&scene);
    scene_plate(&scene, corner, u, v);
}

/* --- plates ----------------------------------------------------------------------------------- */

static void tilted_plate_has_a_uniform_density(void **state)
{
    (void)state;
    const double direction[3] = {3, 0, 4}; /* normalised exactly: 0.6, 0, 0.8 */
    long double sigma = scene_eq2(&(lrcs_brdf){1, 0.25, 0.2, 0.5}, 2, 0.64L);
    plate_at(0);
    profile_make(direction, 0.1); /* ranges -0.6 .. 0.6 */
    for (int64_t k = -7; k < 7; k++) {
        double from = fmax((double)k * 0.1, -0.6);
        double to = fmin((double)(k + 1) * 0.1, 0.6);
        check_bin(k, to > from ? sigma * ((long double)to - from) / 1.2L : 0);
        assert_true(bin_at(k).bound_m2 < 1e-12);
    }
    check_abs(profile.sigma_glint_m2 + profile.sigma_diffuse_m2, (double)sigma,
              profile.bound_m2 + 1e-15);
}

static void plate_normal_to_the_beam_is_in_one_bin(void **state)
{
    (void)state;
    const double direction[3] = {0, 0, 1};
    plate_at(-0.37);
    profile_make(direction, 0.25);
    assert_int_equal(profile.count, 1);
    assert_int_equal(profile.first, 1);
    check_abs(sigma_of(0), 4 * 3.14159265358979323846 * 2 * 1.25, profile.bin[0].bound_m2);
    assert_true(profile.bin[0].bound_m2 < 1e-12);
    check_abs(profile.bin[0].moment_m3, sigma_of(0) * (0.37 - 0.375), 1e-14);
}

static void plate_on_an_edge_is_in_the_farther_bin(void **state)
{
    (void)state;
    const double up[3] = {0, 0, 1};
    const double down[3] = {0, 0, -5};
    plate_at(0.5); /* range -0.5, the edge between bins -3 and -2 of 0.25 */
    profile_make(up, 0.25);
    assert_int_equal(profile.count, 1);
    assert_int_equal(profile.first, -2);
    assert_true(profile.bin[0].bound_m2 < 1e-12);
    scene_invert(&scene, 0);
    profile_make(down, 0.25);
    assert_int_equal(profile.count, 1);
    assert_int_equal(profile.first, 2);
    assert_true(profile.bin[0].bound_m2 < 1e-12);
    plate_at(nextafter(0.5, 1));
    profile_make(up, 0.25);
    assert_int_equal(profile.first, -3);
    assert_int_equal(profile.count, 1);
}

/* Turned by an exact rotation the plate is on the edge to within rounding only: both bins hold it
   in their bounds, and the sum does not. */
static void plate_that_rounding_puts_on_an_edge_is_in_both_bounds(void **state)
{
    (void)state;
    double direction[3] = {0, 0, 1};
    const int q[4] = {3, 1, 2, 1};
    plate_at(1);
    double scale = scene_turn(&scene, q, direction);
    assert_true(scale == 15);
    profile_make(direction, 5); /* range -15 */
    double sigma = 4 * 3.14159265358979323846 * 2 * 225 * 1.25;
    check_abs(profile.sigma_glint_m2 + profile.sigma_diffuse_m2, sigma, 1e-9);
    assert_true(profile.bound_m2 < 1e-9);
    double most = 0;
    for (int64_t k = -4; k < -2; k++) {
        lrcs_profile_bin bin = bin_at(k);
        double lacks = sigma - bin.sigma_glint_m2 - bin.sigma_diffuse_m2;
        assert_true(fabs(lacks) < 1e-9 || bin.bound_m2 >= sigma * (1 - 1e-12));
        most = fmax(most, bin.bound_m2);
    }
    assert_true(most >= sigma * (1 - 1e-12));
}

/* The same through the origin, at the edge of bins -1 and 0: the ranges of its corners have either
   sign and are no larger than their errors. Symptom: half of it in each bin, with bounds of
   rounding. */
static void plate_that_rounding_puts_before_or_behind_zero_is_in_both_bounds(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++) {
        double direction[3] = {0, 0, 1};
        const int q[4] = {3 + i % 5, 1 + i % 7, 2 - i % 4, 1 + i / 7};
        plate_at(0);
        double scale = scene_turn(&scene, q, direction);
        profile_make(direction, 5 * scale);
        double sigma = 4 * 3.14159265358979323846 * 2 * scale * scale * 1.25;
        check_rel(profile.sigma_glint_m2 + profile.sigma_diffuse_m2, sigma, 1e-9);
        assert_true(profile.bound_m2 < 1e-9 * sigma);
        for (int64_t k = -1; k < 1; k++) {
            lrcs_profile_bin bin = bin_at(k);
            double lacks = sigma - bin.sigma_glint_m2 - bin.sigma_diffuse_m2;
            assert_true(fabs(lacks) < 1e-9 * sigma || bin.bound_m2 >= sigma * (1 - 1e-12));
        }
    }
}

/* One unit in the last place nearer than an edge: in the nearer bin, however the quotient rounds.
 */
static void plates_just_before_an_edge_are_in_the_nearer_bin(void **state)
{
    (void)state;
    const double direction[3] = {0, 0, 1};
    uint64_t seed = 3;
    unsigned misled = 0;
    for (int i = 0; i < 4000; i++) {
        double bin = 0.001 + random_below(&seed, 1u << 20) * 0x1p-20;
        int64_t k = 1 + random_below(&seed, 100);
        double range = nextafter((double)k * bin, 0);
        misled += floor(range / bin) >= (double)k;
        plate_at(-range);
        profile_make(direction, bin);
        assert_int_equal(profile.first, k - 1);
        assert_int_equal(profile.count, 1);
    }
    assert_true(misled > 0); /* that the test tests it */
}

static void hidden_facets_contribute_nothing(void **state)
{
    (void)state;
    const double direction[3] = {0, 0, 1};
    const double corner[3] = {-2, -2, 1};
    const double u[3] = {4, 0, 0};
    const double v[3] = {0, 4, 0};
    plate_at(0);
    scene_plate(&scene, corner, u, v);
    profile_make(direction, 0.3);
    for (uint32_t i = 0; i < profile.count; i++) {
        int holds = profile.first + i == -4; /* -1.2 .. -0.9 */
        assert_true(holds ? sigma_of(i) > 200 : sigma_of(i) == 0 && profile.bin[i].bound_m2 == 0);
    }
    check_same(sigma_of(0), profile.sigma_glint_m2 + profile.sigma_diffuse_m2);
}

static void back_sides_contribute_only_where_two_sided(void **state)
{
    (void)state;
    const double below[3] = {0, 0, -1};
    plate_at(0.1);
    profile_make(below, 0.25);
    assert_int_equal(profile.count, 0);
    check_same(profile.bound_m2, 0);
    scene.material[0].two_sided = 1;
    profile_make(below, 0.25);
    assert_int_equal(profile.count, 1);
    assert_int_equal(profile.first, 0);
}

/* Facets stored twice are redundant: the second adds nothing to a bin, nor to its bound. */
static void a_plate_stored_twice_counts_once(void **state)
{
    (void)state;
    const double direction[3] = {3, 0, 4};
    plate_at(0.1);
    profile_make(direction, 0.1);
    lrcs_profile once = profile;
    lrcs_profile_bin bins[16];
    assert_true(once.count <= 16);
    memcpy(bins, once.bin, once.count * sizeof *bins);
    scene_plate(&scene, (const double[3]){-1, -0.5, 0.1}, (const double[3]){2, 0, 0},
                (const double[3]){0, 1, 0});
    profile_make(direction, 0.1);
    assert_int_equal(profile.count, once.count);
    for (uint32_t i = 0; i < once.count; i++) {
        check_rel(sigma_of(i), bins[i].sigma_glint_m2 + bins[i].sigma_diffuse_m2, 1e-14);
        check_most(profile.bin[i].bound_m2, 4 * bins[i].bound_m2);
    }
}

/* --- against triangles cut in long double ----------------------------------------------------- */

/* The share of a triangle's area nearer than z, from its corners' ranges in ascending order. */
static long double nearer(const long double z[3], long double at)
{
    if (at <= z[0]) {
        return 0;
    }
    if (at >= z[2]) {
        return 1;
    }
    return at < z[1] ? (at - z[0]) * (at - z[0]) / ((z[1] - z[0]) * (z[2] - z[0]))
                     : 1 - (z[2] - at) * (z[2] - at) / ((z[2] - z[1]) * (z[2] - z[0]));
}

/* Facet f's part of bin k, all of it being visible. */
static long double cut(uint32_t f, const double d[3], int64_t k, double bin)
{
    long double x[3][3];
    long double z[3];
    long double n[3];
    long double length =
        sqrtl((long double)d[0] * d[0] + (long double)d[1] * d[1] + (long double)d[2] * d[2]);
    for (int i = 0; i < 3; i++) {
        z[i] = 0;
        for (int j = 0; j < 3; j++) {
            x[i][j] = scene.vertex[scene.facet[f].corner[i]].x[j];
            z[i] -= x[i][j] * d[j] / length;
        }
    }
    for (int j = 0; j < 3; j++) {
        int a = (j + 1) % 3;
        int b = (j + 2) % 3;
        n[j] =
            (x[1][a] - x[0][a]) * (x[2][b] - x[0][b]) - (x[1][b] - x[0][b]) * (x[2][a] - x[0][a]);
    }
    long double twice = sqrtl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    long double cosine = (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / twice / length;
    if (cosine <= 0) {
        return 0;
    }
    for (int i = 0; i < 3; i++) {
        int a = i == 1;
        int b = i == 1 ? 2 : 1;
        if (z[a] > z[b]) {
            long double swap = z[a];
            z[a] = z[b];
            z[b] = swap;
        }
    }
    long double share = nearer(z, (double)(k + 1) * bin) - nearer(z, (double)k * bin);
    return scene_eq2(&scene.material[scene.material_of[f]].brdf, twice / 2, cosine * cosine) *
           share;
}

static double random_place(uint64_t *seed)
{
    return random_below(seed, 2000001) / 1e6 - 1;
}

/* Triangles side by side, none of which hides another: along each line of sight there is one. */
static void bins_hold_the_truth_of_random_triangles(void **state)
{
    (void)state;
    need_wide_long_double();
    uint64_t seed = 20261122;
    for (int round = 0; round < 400; round++) {
        scene_start(&scene);
        double shift = round % 3 == 0 ? 1000 * random_place(&seed) : 0;
        double direction[3] = {random_place(&seed), random_place(&seed), random_place(&seed)};
        const double corner[3][3] = {
            {random_place(&seed) + shift, random_place(&seed), random_place(&seed) - shift},
            {random_place(&seed) + shift, random_place(&seed), random_place(&seed) - shift},
            {random_place(&seed) + shift, random_place(&seed), random_place(&seed) - shift}};
        scene.material[0].brdf.s = round % 2 ? 0.2 : 0.6;
        scene_triangle(&scene, corner[0], corner[1], corner[2]);
        double bin = 0.01 + 0.5 * fabs(random_place(&seed));
        if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0) {
            continue;
        }
        profile_make(direction, bin);
        /* the pose's direction is the one given times a power of two at most */
        for (int64_t k = profile.first - 1; k <= profile.first + profile.count; k++) {
            check_bin(k, cut(0, pose.direction, k, bin));
        }
        for (uint32_t i = 0; i < profile.count; i++) {
            assert_true(profile.bin[i].bound_m2 < 1e-9);
        }
    }
}

/* --- sums ------------------------------------------------------------------------------------- */

/* A clutter of triangles that hide and pierce each other. */
static void clutter(uint64_t *seed, int count)
{
    scene_start(&scene);
    for (int i = 0; i < count; i++) {
        const double a[3] = {random_place(seed), random_place(seed), random_place(seed)};
        const double b[3] = {random_place(seed), random_place(seed), random_place(seed)};
        const double c[3] = {random_place(seed), random_place(seed), random_place(seed)};
        scene_triangle(&scene, a, b, c);
    }
    scene.material[0].two_sided = *seed % 2 == 0;
}

static void bins_add_up_to_sigma(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 60; round++) {
        double direction[3] = {random_place(&seed), random_place(&seed), 1};
        if (round % 4 == 0) {
            direction[0] = direction[1] = 0;
        }
        clutter(&seed, 4 + round);
        lrcs_result result = scene_run(&scene, direction, LRCS_METHOD_EXACT, 0);
        profile_make(direction, round % 2 ? 0.05 : 0.3);
        double sum = 0;
        double bound = 0;
        for (uint32_t i = 0; i < profile.count; i++) {
            sum += sigma_of(i);
            bound += profile.bin[i].bound_m2;
        }
        check_abs(sum, result.sigma_m2, result.bound_m2 + bound);
        check_abs(profile.sigma_glint_m2 + profile.sigma_diffuse_m2, result.sigma_m2,
                  result.bound_m2 + profile.bound_m2);
        check_abs(profile.sigma_glint_m2, result.sigma_glint_m2,
                  result.bound_m2 + profile.bound_m2);
        assert_true(profile.bound_m2 < 1e-9);
        assert_true(profile.bound_m2 <= bound * (1 + 1e-12));
    }
}

static void a_bin_is_the_sum_of_its_halves(void **state)
{
    (void)state;
    uint64_t seed = 99;
    for (int round = 0; round < 20; round++) {
        double direction[3] = {random_place(&seed), 1, random_place(&seed)};
        lrcs_profile_bin coarse[64];
        clutter(&seed, 30);
        profile_make(direction, 0.1);
        int64_t first = profile.first;
        uint32_t count = profile.count;
        assert_true(count <= 64);
        memcpy(coarse, profile.bin, count * sizeof *coarse);
        profile_make(direction, 0.05);
        for (uint32_t i = 0; i < count; i++) {
            int64_t k = first + i;
            lrcs_profile_bin half[2] = {bin_at(2 * k), bin_at(2 * k + 1)};
            check_abs(half[0].sigma_diffuse_m2 + half[1].sigma_diffuse_m2,
                      coarse[i].sigma_diffuse_m2,
                      coarse[i].bound_m2 + half[0].bound_m2 + half[1].bound_m2);
        }
    }
}

/* --- curved normals --------------------------------------------------------------------------- */

/* Runs the profile of a model with curved normals. */
static void profile_curved(curved_case *c, const double direction[3], double bin)
{
    curved_build(c, LRCS_NORMALS_SMOOTH);
    size_t need = lrcs_profile_need(c->prepared, bin);
    assert_true(need <= sizeof scene_memory);
    work = lrcs_work_make(scene_memory, need);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcs_profile_run(c->prepared, &pose, bin, &work, &profile), LRCS_OK);
    assert_true(profile.curvature_estimate_m2 >= 0);
}

/* 8 points of Gauss on [0, 1]. */
static const long double gauss_at[8] = {
    0.019855071751231884L, 0.101666761293186630L, 0.237233795041835507L, 0.408282678752175098L,
    0.591717321247824902L, 0.762766204958164493L, 0.898333238706813370L, 0.980144928248768116L};
static const long double gauss_weight[8] = {
    0.050614268145188130L, 0.111190517226687235L, 0.156853322938943644L, 0.181341891689180991L,
    0.181341891689180991L, 0.156853322938943644L, 0.111190517226687235L, 0.050614268145188130L};

/* What a triangle with normals interpolated between `unit` reflects, seen from +z, between two
   ranges -z: the integral over it of 4 pi f_r cos, or of that times range - about, in panels
   between the corners' ranges and the ends. */
static long double strip(const double at[3][3], const double unit[3][3], const lrcs_brdf *brdf,
                         long double from, long double to, long double about, int moment)
{
    int k[3] = {0, 1, 2};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 2; j++) {
            if (-at[k[j]][2] > -at[k[j + 1]][2]) {
                int swap = k[j];
                k[j] = k[j + 1];
                k[j + 1] = swap;
            }
        }
    }
    long double z[3] = {-at[k[0]][2], -at[k[1]][2], -at[k[2]][2]};
    long double area = fabsl((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                             (at[1][1] - at[0][1]) * (at[2][0] - at[0][0])) /
                       2;
    long double sum = 0;
    for (int part = 0; part < 2; part++) {
        long double low = fmaxl(z[part], from);
        long double high = fminl(z[part + 1], to);
        for (int panel = 0; panel < 8 * 8 && low < high; panel++) {
            long double share = (panel / 8 + gauss_at[panel % 8]) / 8;
            long double here = low + share * (high - low);
            long double t = (here - z[0]) / (z[2] - z[0]); /* on the long side */
            long double s = (here - z[part]) / (z[part + 1] - z[part]);
            long double width = 2 * area / (z[2] - z[0]) * (part == 0 ? s : 1 - s);
            long double line = 0;
            for (int i = 0; i < 8 * 4; i++) {
                long double u = (i / 8 + gauss_at[i % 8]) / 4;
                long double n[3];
                for (int c = 0; c < 3; c++) {
                    long double a = (1 - t) * unit[k[0]][c] + t * unit[k[2]][c];
                    long double b = (1 - s) * unit[k[part]][c] + s * unit[k[part + 1]][c];
                    n[c] = (1 - u) * a + u * b;
                }
                long double tan2 = (n[0] * n[0] + n[1] * n[1]) / (n[2] * n[2]);
                long double cosine = 1 / sqrtl(1 + tan2);
                line += gauss_weight[i % 8] / 4 *
                        (brdf->A / powl(cosine, 5) * expl(-tan2 / brdf->s / brdf->s) +
                         brdf->B * powl(cosine, brdf->m + 1));
            }
            sum += gauss_weight[panel % 8] / 8 * (high - low) * width * line *
                   (moment ? here - about : 1);
        }
    }
    return 4 * 3.14159265358979323846264338328L * sum;
}

/* A triangle over the unit square with normals that point to its front and up; 0: it has none. */
static int curved_triangle(uint64_t *seed, char *text, double at[3][3], double unit[3][3])
{
    double plane[3];
    text[0] = '\0';
    for (int i = 0; i < 3; i++) {
        double p = 0.5 * random_place(seed);
        double q = 0.5 * random_place(seed);
        double length = sqrt(1 + p * p + q * q);
        unit[i][0] = p / length;
        unit[i][1] = q / length;
        unit[i][2] = 1 / length;
        at[i][0] = random_place(seed);
        at[i][1] = random_place(seed);
        at[i][2] = 0.3 * random_place(seed);
        curved_line(text, "v %.17g %.17g %.17g\nvn %.17g %.17g %.17g", at[i][0], at[i][1], at[i][2],
                    unit[i][0], unit[i][1], unit[i][2]);
    }
    for (int k = 0; k < 3; k++) {
        int x = (k + 1) % 3;
        int y = (k + 2) % 3;
        plane[k] = (at[1][x] - at[0][x]) * (at[2][y] - at[0][y]) -
                   (at[1][y] - at[0][y]) * (at[2][x] - at[0][x]);
    }
    strcat(text, plane[2] > 0 ? "f 1//1 2//2 3//3\n" : "f 1//1 3//3 2//2\n");
    for (int i = 0; i < 3; i++) {
        double dot = plane[0] * unit[i][0] + plane[1] * unit[i][1] + plane[2] * unit[i][2];
        if (!(dot * (plane[2] > 0 ? 1 : -1) > 0.02)) {
            return 0;
        }
    }
    return fabs(plane[2]) > 0.05;
}

/* Against nested quadrature that cuts no polygons. */
static void bins_of_curved_triangles_are_those_of_quadrature(void **state)
{
    (void)state;
    need_wide_long_double();
    uint64_t seed = 17;
    int done = 0;
    const double direction[3] = {0, 0, 1};
    static char text[CURVED_TEXT];
    for (int round = 0; round < 60; round++) {
        double at[3][3];
        double unit[3][3];
        double bin = 0.02 + 0.1 * fabs(random_place(&seed));
        if (!curved_triangle(&seed, text, at, unit)) {
            continue;
        }
        curved_case c = curved_obj(text);
        c.brdf = (lrcs_brdf){1, 0.25, round % 2 ? 0.2 : 0.6, 0.5};
        profile_curved(&c, direction, bin);
        for (int64_t k = profile.first - 1; k <= profile.first + profile.count; k++) {
            lrcs_profile_bin got = bin_at(k);
            double from = (double)k * bin;
            double to = (double)(k + 1) * bin;
            long double about = ((long double)k + 0.5L) * bin;
            double truth = (double)strip((const double(*)[3])at, (const double(*)[3])unit, &c.brdf,
                                         from, to, about, 0);
            double moment = (double)strip((const double(*)[3])at, (const double(*)[3])unit, &c.brdf,
                                          from, to, about, 1);
            check_abs(got.sigma_glint_m2 + got.sigma_diffuse_m2, truth,
                      got.bound_m2 + got.curvature_estimate_m2 + 1e-13);
            check_abs(got.moment_m3, moment,
                      bin * (got.variation_m2 + got.curvature_estimate_m2) + 1e-13);
            assert_true(got.bound_m2 < 1e-10 && got.curvature_estimate_m2 < 1e-6);
        }
        done++;
        curved_free(&c);
    }
    assert_true(done > 20);
}

/* A closed cylinder by vertex normals, its wall hidden in part by a plate: the bins add up to
   sigma, and their halves to them. */
static void bins_with_curved_normals_add_up_to_sigma(void **state)
{
    (void)state;
    static const double direction[3][3] = {{1, 0, 0}, {3, -2, 1}, {0.2, 0.1, 1}};
    static char text[CURVED_TEXT];
    curved_cylinder(text, 20, 0.5, 2, 'v');
    curved_line(text, "v 2 -0.1 -0.7\nv 2 1.3 -0.7\nv 2 1.3 0.4\nv 2 -0.1 0.4\nf -4 -3 -2 -1");
    for (int i = 0; i < 3; i++) {
        curved_case c = curved_obj(text);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        lrcs_result result = curved_run(&c, direction[i], LRCS_METHOD_EXACT, 0);
        double sum[2] = {0, 0};
        double open[2] = {0, 0};
        for (int fine = 0; fine < 2; fine++) {
            profile_curved(&c, direction[i], fine ? 0.04 : 0.08);
            for (uint32_t k = 0; k < profile.count; k++) {
                sum[fine] += sigma_of(k);
                open[fine] += profile.bin[k].bound_m2 + profile.bin[k].curvature_estimate_m2;
            }
            check_abs(profile.sigma_glint_m2 + profile.sigma_diffuse_m2, result.sigma_m2,
                      profile.bound_m2 + profile.curvature_estimate_m2 + result.bound_m2 +
                          result.curvature_estimate_m2);
            check_abs(sum[fine], result.sigma_m2,
                      open[fine] + result.bound_m2 + result.curvature_estimate_m2);
            assert_true(open[fine] < 1e-5 * result.sigma_m2);
        }
        check_abs(sum[0], sum[1], open[0] + open[1]);
        curved_free(&c);
    }
}

/* --- pulses ----------------------------------------------------------------------------------- */

static void a_pulse_on_a_tilted_plate_is_a_difference_of_error_functions(void **state)
{
    (void)state;
    const double direction[3] = {3, 0, 4};
    double sigma = (double)scene_eq2(&(lrcs_brdf){1, 0.25, 0.2, 0.5}, 2, 0.64L);
    plate_at(0);
    profile_make(direction, 0.3 / 256);
    double d = 0.3 / (2 * sqrt(2 * log(2)));
    double sum = 0;
    for (int i = -300; i <= 300; i++) {
        double z = 0.005 * i;
        double density;
        double bound;
        double estimate;
        double truth =
            sigma / 1.2 * 0.5 * (erf((z + 0.6) / d / sqrt(2)) - erf((z - 0.6) / d / sqrt(2)));
        assert_int_equal(lrcs_profile_pulse(&profile, 0.3, z, &density, &bound, &estimate),
                         LRCS_OK);
        check_abs(density, truth, bound + 1e-15 * sigma);
        assert_true(bound < 2e-5 * sigma);
        sum += 0.005 * density;
    }
    check_rel(sum, sigma, 1e-12); /* the trapezoidal rule of a smooth function */
}

static void a_pulse_on_a_flat_plate_is_the_pulse(void **state)
{
    (void)state;
    const double direction[3] = {0, 0, 1};
    plate_at(-0.35);
    for (int k = 0; k < 3; k++) { /* coarse bins: the bound says so */
        profile_make(direction, k == 0 ? 0.001 : k == 1 ? 0.02 : 0.2);
        for (int i = 0; i < 40; i++) {
            double z = 0.05 * i - 0.5;
            double t = (z - 0.35) * 2 * sqrt(2 * log(2)) / 0.1;
            double truth =
                sigma_of(0) * exp(-t * t / 2) * 2 * sqrt(log(2) / 3.14159265358979323846) / 0.1;
            double density;
            double bound;
            double estimate;
            assert_int_equal(lrcs_profile_pulse(&profile, 0.1, z, &density, &bound, &estimate),
                             LRCS_OK);
            check_abs(density, truth, bound);
            assert_true(k > 0 || bound < 2e-3 * sigma_of(0));
        }
    }
}

/* --- limits ----------------------------------------------------------------------------------- */

static void widths_and_numbers_of_bins_have_limits(void **state)
{
    (void)state;
    static const double wrong[] = {0, -1, NAN, INFINITY, -INFINITY};
    const double direction[3] = {3, 0, 4};
    plate_at(0);
    memset(&profile, 0x5a, sizeof profile);
    lrcs_profile before = profile;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(profile_try(direction, wrong[i]), LRCS_E_ARGUMENT);
        assert_true(wrong[i] > 0 || lrcs_profile_need(scene_prepare(&scene, &work), wrong[i]) == 0);
    }
    assert_int_equal(profile_try(direction, 1e-6), LRCS_E_LIMIT);
    assert_int_equal(profile_try(direction, 1e-300), LRCS_E_LIMIT);
    plate_at(1e9);
    assert_int_equal(profile_try(direction, 1e-4), LRCS_E_LIMIT); /* numbers beyond 2^40 */
    plate_at(-1e9);
    assert_int_equal(profile_try(direction, 1e-4), LRCS_E_LIMIT);
    assert_memory_equal(&profile, &before, sizeof profile);
    plate_at(0);
    profile_make(direction, 1e-5);
    assert_int_equal(profile.count, 120000);
    profile_make(direction, 1e30);
    assert_int_equal(profile.count, 2);
    double density;
    double bound;
    double estimate;
    assert_int_equal(lrcs_profile_pulse(&profile, 0, 0, &density, &bound, &estimate),
                     LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_profile_pulse(&profile, NAN, 0, &density, &bound, &estimate),
                     LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_profile_pulse(&profile, 1, NAN, &density, &bound, &estimate),
                     LRCS_E_NUMBER);
    assert_int_equal(lrcs_profile_pulse(&profile, 1e-308, 0, &density, &bound, &estimate),
                     LRCS_E_ARGUMENT); /* its deviation is not a normal number */
    assert_int_equal(lrcs_profile_pulse(&profile, (double)INFINITY, 0, &density, &bound, &estimate),
                     LRCS_OK);
    check_same(density, 0);
}

static void nothing_has_no_bins(void **state)
{
    (void)state;
    const double direction[3] = {3, 0, 4};
    scene_start(&scene);
    profile_make(direction, 0.1);
    assert_int_equal(profile.count, 0);
    check_same(profile.sigma_glint_m2 + profile.sigma_diffuse_m2, 0);
    check_same(profile.bound_m2, 0);
}

/* A scene of 2^-900 m is computed at another scale, in which bins of 1e200 m are too wide. */
static void bins_too_wide_for_the_scale_of_the_scene_are_refused(void **state)
{
    (void)state;
    const double direction[3] = {3, 0, 4};
    const double still[3] = {0, 0, 0};
    plate_at(0);
    scene_move(&scene, 0x1p-900, still);
    assert_int_equal(profile_try(direction, 1e200), LRCS_E_ARGUMENT);
    plate_at(0);
    scene_move(&scene, 0x1p300, still); /* and in one of 2^300 m, bins of 1e-300 m too narrow */
    assert_int_equal(profile_try(direction, 1e-300), LRCS_E_ARGUMENT);
}

/* Facets so large that sigma is beyond doubles; a vertex that no facet has, far away. */
static void sigma_beyond_doubles_is_refused_and_loose_vertices_have_no_bins(void **state)
{
    (void)state;
    const double direction[3] = {3, 0, 4};
    const double still[3] = {0, 0, 0};
    plate_at(0);
    scene_move(&scene, 0x1p300, still);
    scene.material[0].brdf.B = 1e200;
    assert_int_equal(profile_try(direction, 0x1p290), LRCS_E_NUMBER);
    plate_at(0);
    profile_make(direction, 0.1);
    lrcs_profile before = profile;
    scene_vertex(&scene, 1e6, 1e6, 1e6);
    profile_make(direction, 0.1);
    assert_int_equal(profile.first, before.first);
    assert_int_equal(profile.count, before.count);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_true(lrcs_profile_need(prepared, 1e-300) == lrcs_profile_need(prepared, 1e-200));
}

static const lrcs_prepared *limited;

static int profile_limited(lrcs_work *area)
{
    return lrcs_profile_run(limited, &pose, 0.1, area, &profile);
}

static void the_work_area_grows_until_it_suffices(void **state)
{
    (void)state;
    uint64_t seed = 5;
    const double direction[3] = {1, 2, 3};
    clutter(&seed, 12);
    limited = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    check_memory_limit(MEMORY_CASE("lrcs_profile_run", lrcs_profile_need(limited, 0.1),
                                   profile_limited, profile, 1));
    static char text[CURVED_TEXT];
    curved_cylinder(text, 5, 0.5, 1, 'v');
    curved_case c = curved_obj(text);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    limited = c.prepared;
    check_memory_limit(MEMORY_CASE("lrcs_profile_run", lrcs_profile_need(limited, 0.1),
                                   profile_limited, profile, 1));
    curved_free(&c);
}

/* sigma scales by the square, and the bins with it, exactly for a power of two. */
static void a_scene_scaled_by_a_power_of_two_has_the_same_profile(void **state)
{
    (void)state;
    uint64_t seed = 11;
    const double direction[3] = {1, -2, 0.5};
    const double origin[3] = {0, 0, 0};
    lrcs_profile_bin small[64];
    clutter(&seed, 20);
    profile_make(direction, 0.125);
    uint32_t count = profile.count;
    int64_t first = profile.first;
    assert_true(count <= 64);
    memcpy(small, profile.bin, count * sizeof *small);
    scene_move(&scene, 1024, origin);
    profile_make(direction, 128);
    assert_int_equal(profile.count, count);
    assert_int_equal(profile.first, first);
    for (uint32_t i = 0; i < count; i++) {
        check_same(profile.bin[i].sigma_diffuse_m2, small[i].sigma_diffuse_m2 * 0x1p20);
        check_same(profile.bin[i].bound_m2, small[i].bound_m2 * 0x1p20);
        check_same(profile.bin[i].moment_m3, small[i].moment_m3 * 0x1p30);
    }
}

static void ranges_beyond_the_bins_are_in_the_outermost_ones(void **state)
{
    (void)state;
    const lrcsi_range_bins bins = {.bin_m = 0.5, .width = 0.5, .first = -2, .count = 4};
    static const double range[] = {-9, -1, -0.5, 0.25, 0.75, 1, 9};
    static const uint32_t bin[] = {0, 0, 1, 2, 3, 3, 3};
    for (int i = 0; i < 7; i++) {
        assert_int_equal(lrcsi_range_bin(&bins, range[i]), bin[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tilted_plate_has_a_uniform_density),
        cmocka_unit_test(plate_normal_to_the_beam_is_in_one_bin),
        cmocka_unit_test(plate_on_an_edge_is_in_the_farther_bin),
        cmocka_unit_test(plate_that_rounding_puts_on_an_edge_is_in_both_bounds),
        cmocka_unit_test(plate_that_rounding_puts_before_or_behind_zero_is_in_both_bounds),
        cmocka_unit_test(plates_just_before_an_edge_are_in_the_nearer_bin),
        cmocka_unit_test(a_plate_stored_twice_counts_once),
        cmocka_unit_test(hidden_facets_contribute_nothing),
        cmocka_unit_test(back_sides_contribute_only_where_two_sided),
        cmocka_unit_test(bins_hold_the_truth_of_random_triangles),
        cmocka_unit_test(bins_add_up_to_sigma),
        cmocka_unit_test(a_bin_is_the_sum_of_its_halves),
        cmocka_unit_test(bins_of_curved_triangles_are_those_of_quadrature),
        cmocka_unit_test(bins_with_curved_normals_add_up_to_sigma),
        cmocka_unit_test(a_pulse_on_a_tilted_plate_is_a_difference_of_error_functions),
        cmocka_unit_test(a_pulse_on_a_flat_plate_is_the_pulse),
        cmocka_unit_test(widths_and_numbers_of_bins_have_limits),
        cmocka_unit_test(ranges_beyond_the_bins_are_in_the_outermost_ones),
        cmocka_unit_test(nothing_has_no_bins),
        cmocka_unit_test(bins_too_wide_for_the_scale_of_the_scene_are_refused),
        cmocka_unit_test(sigma_beyond_doubles_is_refused_and_loose_vertices_have_no_bins),
        cmocka_unit_test(the_work_area_grows_until_it_suffices),
        cmocka_unit_test(a_scene_scaled_by_a_power_of_two_has_the_same_profile)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
