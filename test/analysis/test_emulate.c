/* SPDX-License-Identifier: MIT */
/* Hardware emulated: bit for bit what another implementation computes (test/vectors/emulate.py),
   pixels counted by hand, known costs of depth and precision, and scenes made to break floats. */
#include <lrcs/emulate.h>

#include "curved.h"
#include "memory_limit.h"
#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static uint32_t owner[512 * 512];

/* --- another implementation ------------------------------------------------------------------- */

typedef struct emulate_run {
    int precision;
    uint32_t depth_bits;
    double glint, diffuse, running;
    const char *owner; /* a letter for every facet */
} emulate_run;

typedef struct emulate_case {
    uint32_t vertices, facets, size;
    double vertex[64][3];
    uint32_t facet[24][3];
    double brdf[24][5]; /* A, B, s, m, two-sided */
    double R[3][3];
    emulate_run run[5];
} emulate_case;

#include "vectors/emulate.inc"

#define CASES (sizeof emulate_cases / sizeof emulate_cases[0])

static lrcs_material case_material[24];

static void case_make(const emulate_case *c)
{
    scene_start(&scene);
    for (uint32_t v = 0; v < c->vertices; v++) {
        scene_vertex(&scene, c->vertex[v][0], c->vertex[v][1], c->vertex[v][2]);
    }
    for (uint32_t f = 0; f < c->facets; f++) {
        const double *b = c->brdf[f];
        scene_facet(&scene, c->facet[f][0], c->facet[f][1], c->facet[f][2]);
        scene.material_of[f] = f;
        case_material[f] = scene.material[0];
        case_material[f].brdf = (lrcs_brdf){b[0], b[1], b[2], b[3]};
        case_material[f].two_sided = b[4] != 0;
    }
    scene.scene.material = case_material;
    scene.scene.material_count = c->facets;
}

/* The item buffer as text: a letter for each pixel, from the bottom row up. */
static void owners_write(uint32_t size, char *text)
{
    for (uint32_t y = 0; y < size; y++) {
        for (uint32_t x = 0; x < size; x++) {
            uint32_t at = owner[(size - 1 - y) * size + x];
            *text++ = at == LRCS_NONE ? '.' : (char)('A' + at);
        }
    }
    *text = '\0';
}

/* exp and pow of two math libraries may differ by some ulp of doubles; results in floats have the
   same bits. */
#define LIBM_OFF 0x1p-50

static void another_implementation_gives_the_same_bits(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        const emulate_case *c = &emulate_cases[i];
        case_make(c);
        lrcs_pose pose = {.direction = {c->R[2][0], c->R[2][1], c->R[2][2]}};
        memcpy(pose.R, c->R, sizeof pose.R);
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        for (int k = 0; k < 5; k++) {
            const emulate_run *want = &c->run[k];
            lrcs_emulation_options options = {c->size, want->precision, want->depth_bits};
            lrcs_image image = {.size = c->size, .facet = owner};
            lrcs_emulation e;
            char text[512];
            assert_int_equal(
                lrcs_emulate_run(prepared, &pose, &options, &work, &e, scene.record, &image),
                LRCS_OK);
            owners_write(c->size, text);
            assert_string_equal(text, want->owner);
            double off = want->precision == LRCS_PRECISION_FLOAT64 ? LIBM_OFF : 0;
            check_rel(e.sigma_glint_m2, want->glint, off);
            check_rel(e.sigma_diffuse_m2, want->diffuse, off);
            check_rel(e.sigma_m2, want->glint + want->diffuse, off);
            check_rel(e.running_m2, want->running, off);
        }
    }
}

static void those_cases_tell_depths_and_precisions_apart(void **state)
{
    (void)state;
    int depths = 0;
    int precisions = 0;
    for (size_t i = 0; i < CASES; i++) {
        const emulate_run *run = emulate_cases[i].run;
        depths += strcmp(run[2].owner, run[4].owner) != 0;
        precisions += run[0].glint != run[2].glint || run[0].diffuse != run[2].diffuse;
    }
    assert_true(depths >= 3);
    assert_true(precisions >= 8);
}

/* --- runs ------------------------------------------------------------------------------------- */

static lrcs_emulation emulated(const double direction[3], uint32_t size, int precision,
                               uint32_t depth_bits)
{
    lrcs_emulation_options options = {size, precision, depth_bits};
    lrcs_image image = {.size = size, .facet = owner};
    lrcs_emulation e;
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcs_emulate_run(prepared, &pose, &options, &work, &e, scene.record, &image),
                     LRCS_OK);
    return e;
}

static const int precisions[] = {LRCS_PRECISION_FLOAT64, LRCS_PRECISION_FLOAT32};
static const uint32_t depths[] = {16, 24, 32, 64};
static const double up[3] = {0, 0, 1};

/* --- pixels counted by hand ------------------------------------------------------------------- */

/* A unit square fills the window; its diagonal runs through pixel centres, each of which one of the
   two facets owns. At normal incidence f_r cos = A + B. */
static void a_square_fills_its_window(void **state)
{
    (void)state;
    static const uint32_t sizes[] = {1, 2, 7, 64, 100};
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    for (int i = 0; i < 5; i++) {
        for (int p = 0; p < 2; p++) {
            for (int d = 0; d < 4; d++) {
                lrcs_emulation e = emulated(up, sizes[i], precisions[p], depths[d]);
                check_rel(e.sigma_m2, 4 * (double)SCENE_PI * 1.25, p ? 3e-7 : 1e-15);
                check_rel(e.projected_area_m2, 1.0, 1e-15);
            }
        }
    }
}

/* The right triangle below the diagonal of an 8 x 8 window: 28 pixel centres are below the
   diagonal; the 8 on it belong to the facet of which it is a left edge. */
static void the_diagonal_belongs_to_the_facet_on_its_right(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                   (const double[3]){1, 1, 0});
    check_same(emulated(up, 8, LRCS_PRECISION_FLOAT32, 24).projected_area_m2, 36.0 / 64);
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 0},
                   (const double[3]){0, 1, 0});
    check_same(emulated(up, 8, LRCS_PRECISION_FLOAT32, 24).projected_area_m2, 28.0 / 64);
}

/* A square of 3 x 3 pixels over one of 8 x 8, below its top left corner: 9 pixels and 55. */
static void a_nearer_facet_takes_its_pixels(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){8, 0, 0},
                (const double[3]){0, 8, 0});
    scene_plate(&scene, (const double[3]){1, 4, 2}, (const double[3]){3, 0, 0},
                (const double[3]){0, 3, 0});
    emulated(up, 8, LRCS_PRECISION_FLOAT32, 16);
    check_same(scene_seen(&scene, 0, 2), 55);
    check_same(scene_seen(&scene, 2, 2), 9);
    check_rel(scene.record[2].sigma_m2 + scene.record[3].sigma_m2, 9 * 4 * (double)SCENE_PI * 1.25,
              3e-7);
    /* row 1 from the top, column 1: image rows go down */
    assert_true(owner[8 + 1] >= 2 && owner[0] < 2 && owner[3 * 8 + 3] >= 2 && owner[4 * 8 + 3] < 2);
}

static void a_back_side_hides_and_does_not_shine(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){8, 0, 0},
                (const double[3]){0, 8, 0});
    scene_plate(&scene, (const double[3]){1, 4, 2}, (const double[3]){0, 3, 0},
                (const double[3]){3, 0, 0});
    lrcs_emulation e = emulated(up, 8, LRCS_PRECISION_FLOAT64, 64);
    check_rel(e.sigma_m2, 55 * 4 * (double)SCENE_PI * 1.25, 1e-15);
    check_same(e.projected_area_m2, 64);
    scene.material[0].two_sided = 1;
    e = emulated(up, 8, LRCS_PRECISION_FLOAT64, 64);
    check_rel(e.sigma_m2, 64 * 4 * (double)SCENE_PI * 1.25, 1e-15);
}

/* --- what depth and precision cost ------------------------------------------------------------ */

/* Two plates 2^-12 to 2^-26 of the depth range apart, the far one first, a speck at the other end
   of that range: 16 bits are steps of 2^-16, 24 of 2^-24; a float has those in the far half of the
   range, and 2^-31 where the near margin ends. Where no step lies between them the first one keeps
   all pixels. */
static void skins_closer_than_a_step_of_depth_fight(void **state)
{
    (void)state;
    static const struct {
        int apart;
        double speck; /* above the skins, or below */
        uint32_t told_by;
    } row[] = {{-12, 1 - 0x1p-6, 16}, {-18, 1 - 0x1p-6, 24}, {-26, 1 - 0x1p-6, 64},
               {-12, 0x1p-6 - 1, 16}, {-18, 0x1p-6 - 1, 24}, {-26, 0x1p-6 - 1, 32}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double z = row[i].speck;
        double skin = z > 0 ? 0 : -ldexp(1, row[i].apart);
        scene_start(&scene);
        for (int k = 0; k < 2; k++, skin += ldexp(1, row[i].apart)) {
            scene_plate(&scene, (const double[3]){0, 0, skin}, (const double[3]){1, 0, 0},
                        (const double[3]){0, 1, 0});
        }
        scene_triangle(&scene, (const double[3]){0, 0, z}, (const double[3]){0x1p-30, 0, z},
                       (const double[3]){0, 0x1p-30, z});
        for (int d = 0; d < 4; d++) {
            emulated(up, 64, LRCS_PRECISION_FLOAT64, depths[d]);
            check_same(scene_seen(&scene, 2, 2), depths[d] >= row[i].told_by ? 1.0 : 0.0);
        }
    }
}

/* No front of a sphere's mesh is hidden if it is alone: its error is that of sampling, here some
   1e-4, and floats add a hundredth of that. */
static void floats_cost_a_convex_body_little(void **state)
{
    (void)state;
    static const double from[3] = {0.3, -0.8, 0.5};
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){10, 20, 30}, 2, 24);
    double truth = scene_run(&scene, from, LRCS_METHOD_EXACT, 0).sigma_m2;
    double deep = emulated(from, 256, LRCS_PRECISION_FLOAT64, 64).sigma_m2;
    double flat = emulated(from, 256, LRCS_PRECISION_FLOAT32, 32).sigma_m2;
    check_rel(deep, truth, 2e-3);
    check_rel(flat, deep, 2e-5);
    assert_true(flat != deep);
}

/* 512 x 512 equal pixels: the larger the sum grows, the more of each pixel is lost to rounding, and
   over long stretches these errors have the same sign. */
static void a_running_sum_of_floats_loses_what_pairs_keep(void **state)
{
    (void)state;
    scene_start(&scene);
    scene.material[0].brdf = (lrcs_brdf){0, 0.25 / (double)SCENE_PI, 0.2, 0};
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    lrcs_emulation e = emulated(up, 512, LRCS_PRECISION_FLOAT32, 24);
    check_rel(e.sigma_m2, 1.0, 2e-7);
    assert_true(fabs(e.running_m2 - 1) > 1e-4 && fabs(e.running_m2 - 1) < 1e-2);
    e = emulated(up, 512, LRCS_PRECISION_FLOAT64, 64);
    check_rel(e.running_m2, 1.0, 512 * 512 * 0x1p-53);
}

/* Summed over directions the error falls as 1 / N, which is by 4 from each size to the next; the
   test requires half of that. */
static void sampling_converges_as_one_over_n(void **state)
{
    (void)state;
    static const uint32_t sizes[] = {16, 64, 256};
    double error[3] = {0, 0, 0};
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 2, 1});
    scene_box(&scene, (const double[3]){0.5, 0.25, 1.5}, (const double[3]){1, 3, 2});
    for (int i = 0; i < 40; i++) {
        const double from[3] = {sin(i), cos(1.7 * i), 1.1};
        double truth = scene_run(&scene, from, LRCS_METHOD_EXACT, 0).sigma_m2;
        for (int k = 0; k < 3; k++) {
            double sigma = emulated(from, sizes[k], LRCS_PRECISION_FLOAT64, 64).sigma_m2;
            error[k] += fabs(sigma - truth) / truth;
        }
    }
    assert_true(error[2] > 0);
    check_most(error[1], error[0] / 2);
    check_most(error[2], error[1] / 2);
}

/* At equal depths the facet drawn first stays; in the reference a front takes precedence. */
static void of_equal_depths_the_first_drawn_wins(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){0, 1, 0},
                (const double[3]){1, 0, 0});
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    check_same(emulated(up, 16, LRCS_PRECISION_FLOAT32, 24).sigma_m2, 0);
    check_rel(scene_run(&scene, up, LRCS_METHOD_ZBUFFER, 16).sigma_m2, 5 * (double)SCENE_PI, 1e-12);
}

/* --- scenes made to break floats -------------------------------------------------------------- */

/* Powers of two change nothing but the unit of area, far beyond the range of floats. */
static void sigma_scales_by_the_square_beyond_the_range_of_floats(void **state)
{
    (void)state;
    static const double from[3] = {0.3, -0.8, 0.5};
    static const int powers[] = {-100, -300, 100, 300};
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0.25, 0, 0}, (const double[3]){2, 2, 1});
    double sigma = emulated(from, 64, LRCS_PRECISION_FLOAT32, 24).sigma_m2;
    for (int i = 0; i < 4; i++) {
        scene_move(&scene, ldexp(1, powers[i]), (const double[3]){0, 0, 0});
        check_same(emulated(from, 64, LRCS_PRECISION_FLOAT32, 24).sigma_m2,
                   ldexp(sigma, 2 * powers[i]));
        scene_move(&scene, ldexp(1, -powers[i]), (const double[3]){0, 0, 0});
    }
}

/* Needles along the line of sight, slivers, a tiny bright facet far away: all results are
   finite. */
static void odd_scenes_give_finite_answers(void **state)
{
    (void)state;
    static const double thin[] = {1e-3, 1e-12, 1e-30, 1e-60, 1e-85};
    static const double from[4][3] = {{0, 0, 1}, {1, 0, 0}, {1, 1e-9, 0}, {1e-20, 1, 1e-20}};
    for (int i = 0; i < 5; i++) {
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, thin[i], 0},
                       (const double[3]){1, 0, thin[i]});
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){thin[i], 0, 0},
                       (const double[3]){0, 1, 0});
        scene_triangle(&scene, (const double[3]){1, 1, 1}, (const double[3]){1, 1, 1},
                       (const double[3]){0, 1, 0}); /* no area */
        for (int d = 0; d < 4; d++) {
            for (int p = 0; p < 2; p++) {
                for (int k = 0; k < 4; k++) {
                    lrcs_emulation e = emulated(from[d], 33, precisions[p], depths[k]);
                    assert_true(isfinite(e.sigma_m2) && e.sigma_m2 >= 0);
                    assert_true(isfinite(e.projected_area_m2));
                }
            }
        }
    }
}

/* Amplitudes beyond floats are refused where they are seen; slopes and exponents beyond that
   range act as their limits: no glint except at the normal, all glint, no diffuse term but at
   the normal. */
static void materials_beyond_floats_are_refused_or_limits(void **state)
{
    (void)state;
    static const struct {
        lrcs_brdf brdf;
        int status;
    } row[] = {{{1e300, 0, 0.2, 0}, LRCS_E_NUMBER}, {{0, 1e300, 0.2, 0}, LRCS_E_NUMBER},
               {{1, 0.25, 1e-60, 0.5}, LRCS_OK},    {{1, 0.25, 1e300, 0.5}, LRCS_OK},
               {{1, 0.25, 0.2, 1e300}, LRCS_OK},    {{0, 1e-60, 0, 0}, LRCS_OK},
               {{1e-60, 0, 1e30, 0}, LRCS_OK}};
    static const double from[3][3] = {{0, 0, 1}, {1, 0, 1}, {1, 0, 1e-12}};
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        scene.material[0].brdf = row[i].brdf;
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        for (int d = 0; d < 2; d++) {
            lrcs_emulation_options options = {16, LRCS_PRECISION_FLOAT32, 24};
            lrcs_emulation e = {.sigma_m2 = -1};
            lrcs_pose pose;
            assert_int_equal(lrcs_pose_from_direction(from[d], &pose), LRCS_OK);
            assert_int_equal(lrcs_emulate_run(prepared, &pose, &options, &work, &e, NULL, NULL),
                             row[i].status);
            assert_true(row[i].status == LRCS_OK ? e.sigma_m2 >= 0 && isfinite(e.sigma_m2)
                                                 : e.sigma_m2 < 0);
        }
    }
}

static void an_empty_scene_gives_nothing(void **state)
{
    (void)state;
    scene_start(&scene);
    lrcs_emulation e = emulated(up, 8, LRCS_PRECISION_FLOAT32, 24);
    check_same(e.sigma_m2, 0);
    check_same(e.projected_area_m2, 0);
}

/* --- the contract ----------------------------------------------------------------------------- */

static void options_outside_their_domain_are_refused(void **state)
{
    (void)state;
    static const lrcs_emulation_options bad[] = {{0, 0, 24},   {16385, 0, 24}, {16, 2, 24},
                                                 {16, -1, 24}, {16, 0, 0},     {16, 1, 23},
                                                 {16, 0, 65}};
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 2, 1});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_pose pose = lrcs_pose_default();
    lrcs_emulation e = {.sigma_m2 = -1};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(lrcs_emulate_run(prepared, &pose, &bad[i], &work, &e, NULL, NULL),
                         LRCS_E_ARGUMENT);
    }
    lrcs_emulation_options options = lrcs_emulation_options_default();
    lrcs_image image = {.size = 512, .facet = owner};
    assert_int_equal(lrcs_emulate_run(prepared, &pose, &options, &work, &e, NULL, &image),
                     LRCS_E_ARGUMENT);
    check_same(e.sigma_m2, -1);
}

static void names_of_precisions_find_them_again(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(lrcs_precision_find(lrcs_precision_text(precisions[i])), precisions[i]);
    }
    assert_int_equal(lrcs_precision_find("float16"), LRCS_E_NAME);
    assert_null(lrcs_precision_text(2));
}

static void the_work_area_that_it_asks_for_is_enough_and_no_less(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 2, 1});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_emulation_options options = {16, LRCS_PRECISION_FLOAT32, 24};
    lrcs_pose pose = lrcs_pose_default();
    size_t need = lrcs_emulate_need(prepared, &options);
    for (size_t size = 0; size <= need; size++) {
        lrcs_work little = lrcs_work_make(scene_memory + work.used + 7, size);
        lrcs_emulation e = {.sigma_m2 = -1};
        int status = lrcs_emulate_run(prepared, &pose, &options, &little, &e, NULL, NULL);
        assert_true(status == LRCS_OK || (status == LRCS_E_MEMORY && little.peak > size));
        assert_true((status == LRCS_OK) == (e.sigma_m2 >= 0));
        assert_true(status == LRCS_OK || size < need);
        assert_int_equal(little.used, 0);
    }
}

/* Graphics hardware is emulated for flat facets only. */
static void curved_normals_are_not_emulated(void **state)
{
    (void)state;
    static char text[1 << 16];
    curved_cylinder(text, 8, 0.5, 2, 'v');
    curved_case c = curved_obj(text);
    for (int normals = LRCS_NORMALS_FLAT; normals <= LRCS_NORMALS_SMOOTH; normals += 2) {
        curved_build(&c, normals);
        const lrcs_emulation_options options = {16, LRCS_PRECISION_FLOAT32, 24};
        size_t need = lrcs_emulate_need(c.prepared, &options);
        void *area = malloc(need);
        assert_non_null(area);
        lrcs_work given = lrcs_work_make(area, need);
        lrcs_pose pose;
        lrcs_emulation e = {.sigma_m2 = -1};
        assert_int_equal(lrcs_pose_from_azel(20, 30, &pose), LRCS_OK);
        int status = lrcs_emulate_run(c.prepared, &pose, &options, &given, &e, NULL, NULL);
        assert_int_equal(status, normals == LRCS_NORMALS_FLAT ? LRCS_OK : LRCS_E_UNSUPPORTED);
        assert_true((e.sigma_m2 > 0) == (status == LRCS_OK));
        free(area);
    }
    curved_free(&c);
}

/* A pose with one invalid number: 0 to 2 of the direction, from 3 on of R. */
static void pose_that_is_none_is_refused(void **state)
{
    (void)state;
    static const double wrong[] = {NAN, HUGE_VAL, 1.5, 1e308};
    scene_start(&scene);
    scene_material(&scene, 1, 0.25, 0.2, 0.5);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int number = 0; number < 12; number++) {
        for (int i = 0; i < 4; i++) {
            lrcs_pose pose;
            assert_int_equal(lrcs_pose_from_azel(30, 20, &pose), LRCS_OK);
            *(number < 3 ? &pose.direction[number] : &pose.R[number / 3 - 1][number % 3]) =
                wrong[i];
            const lrcs_emulation_options options = {8, LRCS_PRECISION_FLOAT32, 24};
            lrcs_emulation e;
            int status = lrcs_emulate_run(prepared, &pose, &options, &work, &e, NULL, NULL);
            assert_int_equal(status, i < 2 ? LRCS_E_NUMBER : LRCS_E_ARGUMENT);
        }
    }
}

static const lrcs_prepared *limited_scene;
static lrcs_emulation limited_emulation;
static const lrcs_emulation_options limited_options = {16, LRCS_PRECISION_FLOAT32, 24};

static int call_emulation(lrcs_work *area)
{
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_azel(20, 60, &pose), LRCS_OK);
    return lrcs_emulate_run(limited_scene, &pose, &limited_options, area, &limited_emulation, NULL,
                            NULL);
}

static void it_grows_until_it_fits(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_material(&scene, 1, 0.25, 0.2, 0.5);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    limited_scene = scene_prepare(&scene, &work);
    check_memory_limit(MEMORY_CASE("emulation", lrcs_emulate_need(limited_scene, &limited_options),
                                   call_emulation, limited_emulation, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_implementation_gives_the_same_bits),
        cmocka_unit_test(those_cases_tell_depths_and_precisions_apart),
        cmocka_unit_test(a_square_fills_its_window),
        cmocka_unit_test(the_diagonal_belongs_to_the_facet_on_its_right),
        cmocka_unit_test(a_nearer_facet_takes_its_pixels),
        cmocka_unit_test(a_back_side_hides_and_does_not_shine),
        cmocka_unit_test(skins_closer_than_a_step_of_depth_fight),
        cmocka_unit_test(floats_cost_a_convex_body_little),
        cmocka_unit_test(a_running_sum_of_floats_loses_what_pairs_keep),
        cmocka_unit_test(sampling_converges_as_one_over_n),
        cmocka_unit_test(of_equal_depths_the_first_drawn_wins),
        cmocka_unit_test(sigma_scales_by_the_square_beyond_the_range_of_floats),
        cmocka_unit_test(odd_scenes_give_finite_answers),
        cmocka_unit_test(materials_beyond_floats_are_refused_or_limits),
        cmocka_unit_test(an_empty_scene_gives_nothing),
        cmocka_unit_test(options_outside_their_domain_are_refused),
        cmocka_unit_test(names_of_precisions_find_them_again),
        cmocka_unit_test(the_work_area_that_it_asks_for_is_enough_and_no_less),
        cmocka_unit_test(curved_normals_are_not_emulated),
        cmocka_unit_test(pose_that_is_none_is_refused),
        cmocka_unit_test(it_grows_until_it_fits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
