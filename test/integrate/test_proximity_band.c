/* SPDX-License-Identifier: MIT */
/* The tessellation bound under shadowing on random scenes of curved shapes among others, from
   random directions. Against itself: a scene built coarse and fine has one truth, so both answers
   differ by no more than both bounds together. And against rays over the true shapes. usage:
   test_proximity_band [SCENES SEED [RAYS [FINER [FAMILY]]]]    (many more; with RAYS squared a
   surface, against rays; FINER: shapes may have this many times as many facets; FAMILY: scenes of
   one family, by its number) */
#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "ray_caster.h"
#include "recipe.h"
#include "shape_scenes.h"

/* --- one build of it -------------------------------------------------------------------------- */

typedef struct built {
    void *area, *scratch;
    lrcs_scene scene;
    const lrcs_prepared *prepared;
} built;

static unsigned char run_memory[1u << 29];
static uint32_t finer = 1; /* times as many facets */

static void build_recipe(const lrcs_recipe *recipe, const lrcs_mesh *models, double tolerance,
                         uint32_t facets, built *b)
{
    lrcs_build_options options = {tolerance, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    size_t need = lrcs_scene_need(recipe, models, &options);
    b->area = malloc(need);
    lrcs_work work = lrcs_work_make(b->area, need);
    assert_int_equal(lrcs_scene_build(recipe, models, &options, &work, &b->scene, NULL), LRCS_OK);
    int status = LRCS_E_MEMORY;
    b->scratch = NULL;
    for (need = lrcs_prepare_need(&b->scene); status == LRCS_E_MEMORY; need *= 2) {
        free(b->scratch);
        b->scratch = malloc(need);
        work = lrcs_work_make(b->scratch, need);
        status = lrcs_prepare_run(&b->scene, &work, &b->prepared);
    }
    assert_int_equal(status, LRCS_OK);
}

static void build(const shape_scene *s, double tolerance, uint32_t facets, built *b)
{
    build_recipe(&s->recipe, NULL, tolerance, facets, b);
}

static void built_free(built *b)
{
    free(b->area);
    free(b->scratch);
}

/* In no more bytes than the library asks for. */
static lrcs_result run_from(const built *b, const double d[3], int method)
{
    lrcs_pose pose;
    lrcs_result result;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = method;
    options.resolution = method == LRCS_METHOD_ZBUFFER ? 100 : 0;
    size_t need = lrcs_sigma_need(b->prepared, &options);
    assert_true(need <= sizeof run_memory);
    lrcs_work work = lrcs_work_make(run_memory, need);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(b->prepared, &pose, &options, &work, &result, NULL, NULL),
                     LRCS_OK);
    assert_false(result.flags & LRCS_FLAG_MEMORY_FALLBACK);
    return result;
}

/* --- what the comparisons came to ------------------------------------------------------------- */

#define KEPT 100000

/* A family's: the share of the bound that errors use. */
typedef struct tally {
    double share[KEPT];
    unsigned count, scenes, unknown;
    double worst;
} tally;

static tally family[SHAPE_SCENE_FAMILIES];
static uint64_t failures;

static void count_share(int which, double error, double bound)
{
    tally *t = &family[which];
    if (bound > 0) {
        double share = error / bound;
        t->worst = fmax(t->worst, share);
        t->share[t->count++ % KEPT] = share;
    }
}

/* Rounding may leave a far-off part's facet without area: then nothing is claimed. */
static int is_known(int which, const lrcs_result *r)
{
    family[which].unknown += r->budget.tessellation_m2 < 0;
    return r->budget.tessellation_m2 >= 0;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void report(void)
{
    for (int i = 0; i < SHAPE_SCENE_FAMILIES; i++) {
        tally *t = &family[i];
        unsigned kept = t->count < KEPT ? t->count : KEPT;
        qsort(t->share, kept, sizeof t->share[0], by_size);
        printf("%-13s %7u scenes %7u comparisons, %u unknown, error / bound: worst %.3f, median "
               "%.2g\n",
               shape_scene_name[i], t->scenes, t->count, t->unknown, t->worst,
               kept ? t->share[kept / 2] : 0);
    }
    printf("%llu beyond their bounds\n", (unsigned long long)failures);
}

/* --- against itself --------------------------------------------------------------------------- */

static void compare(const shape_scene *s, uint64_t began, const double d[3], const lrcs_result *a,
                    const lrcs_result *b)
{
    if (!is_known(s->family, a) || !is_known(s->family, b)) {
        return;
    }
    double apart = fabs(a->sigma_m2 - b->sigma_m2);
    double most = (a->bound_m2 + b->bound_m2) * (1 + 1e-15) + 1e-15 * fabs(a->sigma_m2);
    if (!(apart <= most)) {
        failures++;
        fprintf(stderr,
                "%s, seed %llu, from %.17g %.17g %.17g: %.17g +- %.3g (method %d), "
                "%.17g +- %.3g\n",
                shape_scene_name[s->family], (unsigned long long)began, d[0], d[1], d[2],
                a->sigma_m2, a->bound_m2, a->method, b->sigma_m2, b->bound_m2);
    }
    if (a->method != LRCS_METHOD_FACET) { /* its bound is sigma: all of it may be hidden */
        count_share(s->family, apart, most);
    }
}

static double coarse_tolerance(void)
{
    static const double any[] = {1e-9, 1e-9, 0.5, 0.1, 0.01, 1e-3};
    return any[pick(6)];
}

/* A fine scene: either as fine as its facets allow, or such that round shapes have level rings too,
   so that their outlines are known (fineness.c). */
static void build_fine(const shape_scene *s, built *b)
{
    if (pick(2)) {
        build(s, 1e-9, (256u << pick(2)) * finer, b);
    } else {
        build(s, finer > 8 ? 1e-3 : 5e-2, 1u << 15, b);
    }
}

static double any_size(void)
{
    static const double any[] = {1, 1, 1, 1e6, 1e-6, 0.3, -1};
    return any[pick(7)];
}

/* In sizes of the scene. */
static double any_offset(double size, double most)
{
    static const double any[] = {0, 0, 0, 1, 1e3, 1e6};
    return fmin(most, any[pick(6)]) * fabs(size);
}

static void scene_compare(int which, uint32_t directions)
{
    uint64_t began = shape_scene_seed;
    shape_scene plain;
    shape_scene s;
    built coarse;
    built fine;
    shape_scene_make(&plain, which);
    double size = any_size();
    shape_scene_transform(&plain, size, any_offset(size, 1e6), &s);
    build(&s, coarse_tolerance(), (64u << pick(4)) * finer, &coarse);
    build_fine(&s, &fine);
    for (uint32_t i = 0; i < directions; i++) {
        double d[3];
        shape_scene_direction(&plain, d);
        lrcs_result best = run_from(&fine, d, LRCS_METHOD_EXACT);
        lrcs_result exact = run_from(&coarse, d, LRCS_METHOD_EXACT);
        lrcs_result other = run_from(&coarse, d, pick(2) ? LRCS_METHOD_ZBUFFER : LRCS_METHOD_FACET);
        lrcs_result patches = run_from(&coarse, d, LRCS_METHOD_AUTO);
        compare(&s, began, d, &exact, &best);
        compare(&s, began, d, &other, &best);
        compare(&s, began, d, &patches, &best);
    }
    family[which].scenes++;
    built_free(&coarse);
    built_free(&fine);
}

static void coarse_and_fine_agree_within_their_bounds(void **state)
{
    (void)state;
    shape_scene_seed = 23;
    for (int i = 0; i < SHAPE_SCENE_FAMILIES; i++) {
        scene_compare(i, 2);
    }
    finer = 8; /* so that round walls are integrated over their pieces */
    for (int i = 0; i < SHAPE_SCENE_FAMILIES; i++) {
        scene_compare(i, 1);
    }
    finer = 1;
    assert_int_equal(failures, 0);
}

/* --- the truth, by rays ----------------------------------------------------------------------- */

/* Plates and boxes are as placed, which at the farthest is 1e-12 off. The size of the scene enters
   the build only: sigma goes with its square. A mirrored scene is seen from the mirrored direction.
 */
static void scene_cast(int which, uint32_t directions, int side)
{
    uint64_t began = shape_scene_seed;
    shape_scene plain;
    shape_scene s;
    built b;
    shape_scene_make(&plain, which);
    cast_scene rays = {.seed = shape_scene_seed};
    for (uint32_t i = 0; i < plain.recipe.part_count; i++) {
        int assigned = plain.part[i].material_index;
        cast_part(&rays, &plain.part[i], &plain.material[assigned].brdf, assigned);
    }
    double size = any_size();
    shape_scene_transform(&plain, size, any_offset(size, 1e3), &s);
    build(&s, coarse_tolerance(), (64u << pick(5)) * finer, &b);
    for (uint32_t i = 0; i < directions; i++) {
        double d[3];
        shape_scene_direction(&plain, d);
        cast_answer truth = cast_run(&rays, d, side);
        for (int k = 0; k < 3; k++) {
            d[k] = size < 0 ? -d[k] : d[k];
        }
        lrcs_result r = run_from(&b, d, i % 2 ? LRCS_METHOD_AUTO : LRCS_METHOD_EXACT);
        double sigma = r.sigma_m2 / (size * size);
        double bound = r.bound_m2 / (size * size);
        double apart = fabs(sigma - truth.sigma);
        if (is_known(which, &r) && apart - bound > 7 * truth.error + 1e-9 * truth.sigma) {
            failures++;
            fprintf(stderr,
                    "%s, seed %llu, from %.17g %.17g %.17g: %.10g +- %.3g, by rays %.10g "
                    "+- %.3g\n",
                    shape_scene_name[which], (unsigned long long)began, d[0], d[1], d[2], sigma,
                    bound, truth.sigma, truth.error);
        }
        if (r.budget.tessellation_m2 >= 0 && bound > 10 * truth.error + 1e-8 * truth.sigma) {
            count_share(which, apart, bound);
        }
    }
    family[which].scenes++;
    built_free(&b);
}

static void rays_stay_within_the_bound(void **state)
{
    (void)state;
    shape_scene_seed = 21;
    for (int i = 0; i < SHAPE_SCENE_FAMILIES; i++) {
        scene_cast(i, 2, 10);
    }
    assert_int_equal(failures, 0);
}

/* only: a family, or -1 for all. */
static int many(unsigned long count, int side, int only)
{
    for (unsigned long i = 0; i < count; i++) {
        int which = only < 0 ? (int)(i % SHAPE_SCENE_FAMILIES) : only % SHAPE_SCENE_FAMILIES;
        if (side > 0) {
            scene_cast(which, 2, side);
        } else {
            scene_compare(which, 2);
        }
    }
    report();
    return failures != 0;
}

/* --- among models of any kind ----------------------------------------------------------------- */

/* A plate above two tubes that stand on each other; a fin on its edge that turns the wrong way, a
   third facet on its diagonal; then a pane of glass and a facet of no area, which take no part. */
static lrcs_point odd_vertex[7] = {{{0, 0, 3}},   {{0.5, 0, 3}},    {{0.5, 0.5, 3}},
                                   {{0, 0.5, 3}}, {{0.25, 0, 3.5}}, {{0.25, 0.25, 2.5}},
                                   {{1, 0.25, 3}}};
static lrcs_facet odd_facet[6] = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 1, 4}},
                                  {{0, 2, 5}}, {{1, 6, 2}}, {{0, 1, 1}}};
static uint32_t odd_material[6] = {0, 0, 0, 0, 1, 0};
static uint32_t odd_zero[6], odd_smooth[6] = {0, 1, 1, 0, 0, 0};
static lrcs_surface odd_surface[2] = {{.name = "skin"}, {.name = "glass", .transparency = 1}};
static const char *odd_name[1] = {"odd"};

static lrcs_mesh odd_mesh(uint32_t facets)
{
    return (lrcs_mesh){.vertex_count = 7,
                       .facet_count = facets,
                       .material_count = 2,
                       .part_count = 1,
                       .vertex = odd_vertex,
                       .facet = odd_facet,
                       .facet_material = odd_material,
                       .facet_part = odd_zero,
                       .facet_smooth = odd_smooth,
                       .material = odd_surface,
                       .part = odd_name};
}

/* Two tubes, a ball within the upper one, and the model. */
static void build_odd(double tolerance, uint32_t facets, int two_sided, built *b)
{
    const lrcs_mesh mesh = odd_mesh(facets);
    const lrcs_mesh models[4] = {{0}, {0}, {0}, mesh};
    lrcs_recipe_part part[4];
    for (int i = 0; i < 4; i++) {
        part[i] =
            (lrcs_recipe_part){.name = "p", .place = lrcs_place_default(), .material_index = -1};
        part[i].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .parts = LRCS_SHAPE_WALL};
        part[i].shape.radius = 0.5;
        part[i].shape.length = 1;
    }
    part[1].place.translate[2] = 1;
    part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.25};
    part[2].place.translate[2] = 1.5;
    part[3].file = "odd";
    lrcs_binding binding = {
        .kind = LRCS_BIND_DEFAULT, .brdf = {1, 0.25, 0.3, 0.5}, .two_sided = two_sided};
    const lrcs_recipe recipe = {
        .part = part, .part_count = 4, .binding = &binding, .binding_count = 1};
    build_recipe(&recipe, models, tolerance, 20000, b);
}

static void what_takes_no_part_leaves_bounds_and_models_do_not_break_them(void **state)
{
    (void)state;
    static const double from[4][3] = {{0.2, 0.1, 1}, {1, 0.5, 0.25}, {0.1, -0.05, -1}, {0, 0, 1}};
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        built coarse;
        built fine;
        built bare; /* without glass and the facet of no area */
        build_odd(1e-2, 6, two_sided, &coarse);
        build_odd(3e-3, 6, two_sided, &fine);
        build_odd(1e-2, 4, two_sided, &bare);
        for (int i = 0; i < 8; i++) {
            int method = i % 2 ? LRCS_METHOD_EXACT : LRCS_METHOD_ZBUFFER;
            lrcs_result a = run_from(&coarse, from[i / 2], method);
            lrcs_result b = run_from(&fine, from[i / 2], LRCS_METHOD_EXACT);
            lrcs_result c = run_from(&bare, from[i / 2], method);
            assert_true(a.budget.tessellation_m2 > 0 && b.budget.tessellation_m2 > 0);
            check_abs(a.sigma_m2, b.sigma_m2, a.bound_m2 + b.bound_m2);
            check_rel(a.sigma_m2, c.sigma_m2, 1e-12);
            check_rel(a.budget.tessellation_m2, c.budget.tessellation_m2, 1e-12);
        }
        built_free(&coarse);
        built_free(&fine);
        built_free(&bare);
    }
}

/* Where back sides were left out that open bodies show, what they hide is not known. */
static void back_sides_left_out_leave_tubes_unknown(void **state)
{
    (void)state;
    built b;
    lrcs_pose pose;
    build_odd(1e-1, 6, 0, &b);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.2, 0.1, 1}, &pose), LRCS_OK);
    for (int out = 0; out < 2; out++) {
        lrcs_result r;
        lrcs_run_options options = lrcs_run_options_default();
        options.method = LRCS_METHOD_EXACT;
        options.without = out ? 1u << LRCS_EFFECT_BACK_FACE_CASTERS : 0;
        lrcs_work work = lrcs_work_make(run_memory, sizeof run_memory);
        assert_int_equal(lrcs_sigma_run(b.prepared, &pose, &options, &work, &r, NULL, NULL),
                         LRCS_OK);
        assert_int_equal(r.budget.tessellation_m2 < 0, out);
        assert_int_equal((r.notices & LRCS_NOTICE_TESSELLATION_UNKNOWN) != 0, out);
    }
    built_free(&b);
}

/* --- what cannot be told ---------------------------------------------------------------------- */

/* Of a ball as it is, as an ellipsoid, and so small for its place that rounding leaves its facets
   without area: beside a plate and alone. */
static void what_is_not_known_of_one_part_is_known_of_no_sum(void **state)
{
    (void)state;
    static const double d[3] = {0.1, 0.2, 1};
    for (int i = 0; i < 6; i++) {
        lrcs_recipe_part part[2];
        for (int k = 0; k < 2; k++) {
            part[k] = (lrcs_recipe_part){
                .name = "p", .place = lrcs_place_default(), .material_index = -1};
        }
        part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = i % 3 < 2 ? 0.5 : 1e-17};
        part[0].place.scale[0] = i % 3 == 1 ? 2 : 1;
        for (int k = 0; k < 3 && i % 3 == 2; k++) {
            part[0].place.translate[k] = 1;
        }
        part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {1, 1}};
        part[1].place.translate[2] = 2;
        const lrcs_recipe recipe = {.part = part, .part_count = i < 3 ? 2 : 1};
        built b;
        build_recipe(&recipe, NULL, 1e-2, 2000, &b);
        for (int method = LRCS_METHOD_FACET; method <= LRCS_METHOD_EXACT; method++) {
            lrcs_result r = run_from(&b, d, method);
            int known = i % 3 < 2;
            assert_int_equal(r.budget.tessellation_m2 >= 0, known);
            assert_int_equal((r.notices & LRCS_NOTICE_TESSELLATION_UNKNOWN) != 0, !known);
        }
        built_free(&b);
    }
}

/* --- contours far below the true one ---------------------------------------------------------- */

/* A bright plate, or the top of a tilted box, beside a black ball whose axis is tilted: the true
   limb hides a strip of it. No facet does, and the contour of the facets lies farther below the
   plate than their distance from the true ball, since it follows the rings; a plane separates the
   two bodies. Truth: of the plate in closed form; of the box by rays (test/ray_caster.h, 400 a side,
   seed 5), +- 1.4e-8. */
static void a_contour_far_below_the_true_one_counts(void **state)
{
    (void)state;
    static const double up[3] = {0, 0, 1};
    static const lrcs_brdf bright = {0, 0.7, 1, 8};
    static const double ball[3][3] = {{0.99750279641627004, 0, 0.070626985931166675},
                                      {0, 1, 0},
                                      {-0.070626985931166675, 0, 0.99750279641627004}};
    static const double tilted[3][3] = {{0.99839775377204643, 0, 0.056585557017071249},
                                        {0, 1, 0},
                                        {-0.056585557017071249, 0, 0.99839775377204643}};
    const double width = 0.0073826811425432293;
    const double plate_x = 1.0033066673267363;
    const double limb = 0.01 * sqrt(1 - 1e-4) + asin(0.01); /* of sqrt(1 - y^2), |y| < 0.01 */
    const double strip = limb - 0.02 * (plate_x - 0.5 * width);
    const double truth[2] = {4 * LRCS_PI * 0.7 * (0.02 * width - strip), 0.001214353032};
    for (int box = 0; box < 2; box++) {
        lrcs_recipe_material material[2];
        lrcs_recipe_part part[2];
        const lrcs_recipe recipe = recipe_bright_and_black(&bright, part, material);
        part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {width, 0.02}};
        part[0].place.translate[0] = plate_x;
        part[0].place.translate[2] = -0.05662633641304219;
        if (box) {
            part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {width, 0.02, 0.05}};
            part[0].place.translate[0] = 1.0018861139648032;
            part[0].place.translate[2] = -0.081792177527735072;
            memcpy(part[0].place.rotate, tilted, sizeof tilted);
        }
        part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 1};
        memcpy(part[1].place.rotate, ball, sizeof ball);
        built b;
        build_recipe(&recipe, NULL, 0.1, 1u << 15, &b);
        const lrcs_result r = run_from(&b, up, LRCS_METHOD_EXACT);
        assert_true(fabs(r.sigma_m2 - truth[box]) > 1e-5); /* this is such a scene */
        check_abs(r.sigma_m2, truth[box], r.bound_m2 + 1e-7 * box);
        check_most(r.bound_m2, r.sigma_m2);
        built_free(&b);
    }
}

/* A tilted tube above a bright plate that another plate crosses along its diagonal, where both of
   its facets end (exact parts have no slack, and no pairs of near facets); or above its border. */
static void margins_end_at_contacts_and_borders_of_exact_parts(void **state)
{
    (void)state;
    static const double up[3] = {0, 0, 1};
    static const double diagonal[3][3] = {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}};
    static const double across[3][3] = {{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}};
    static const double tilted[3][3] = {
        {0.168, -0.96, 0.224}, {0.576, 0.28, 0.768}, {-0.8, 0, 0.6}};
    static const lrcs_brdf bright = {0, 1, 1, 0};
    for (int border = 0; border < 2; border++) {
        lrcs_recipe_part part[3];
        lrcs_recipe_material material[2];
        lrcs_recipe recipe = recipe_bright_and_black(&bright, part, material);
        part[2] = part[1];
        recipe.part_count = border ? 2 : 3;
        /* its diagonal, along (0.6, 0.8) in its own frame, is then the x axis */
        part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {1.2, 1.6}};
        memcpy(part[0].place.rotate, diagonal, sizeof diagonal);
        part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 0.5};
        memcpy(part[1].place.rotate, tilted, sizeof tilted);
        part[1].place.translate[1] = border ? 0.8 : -0.2;
        part[1].place.translate[2] = 1.5;
        part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {4, 0.8}};
        memcpy(part[2].place.rotate, across, sizeof across);
        lrcs_result r[2];
        for (int i = 0; i < 2; i++) {
            built b;
            build_recipe(&recipe, NULL, i == 0 ? 1e-3 : 1e-7, 1u << 15, &b);
            r[i] = run_from(&b, up, LRCS_METHOD_EXACT);
            built_free(&b);
        }
        check_abs(r[0].sigma_m2, r[1].sigma_m2, r[0].bound_m2 + r[1].bound_m2);
        check_most(r[0].bound_m2, 1e-3 * r[0].sigma_m2);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coarse_and_fine_agree_within_their_bounds),
        cmocka_unit_test(rays_stay_within_the_bound),
        cmocka_unit_test(what_takes_no_part_leaves_bounds_and_models_do_not_break_them),
        cmocka_unit_test(back_sides_left_out_leave_tubes_unknown),
        cmocka_unit_test(what_is_not_known_of_one_part_is_known_of_no_sum),
        cmocka_unit_test(a_contour_far_below_the_true_one_counts),
        cmocka_unit_test(margins_end_at_contacts_and_borders_of_exact_parts),
    };
    if (argc > 2) {
        shape_scene_seed = strtoull(argv[2], NULL, 10);
        finer = argc > 4 ? (uint32_t)strtoul(argv[4], NULL, 10) : 1;
        return many(strtoul(argv[1], NULL, 10), argc > 3 ? (int)strtol(argv[3], NULL, 10) : 0,
                    argc > 5 ? (int)strtol(argv[5], NULL, 10) : -1);
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
