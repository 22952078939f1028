/* SPDX-License-Identifier: MIT */
/* The tessellation bound under shadowing on random scenes of curved shapes among others, from
   random directions. Against itself: a scene built coarse and fine has one truth, so both answers
   differ by no more than both bounds together. And against rays over the true shapes. usage:
   test_margin [SCENES SEED [RAYS]]    (many more; with RAYS squared a surface, against rays) */
#include <lrcs/lrcs.h>

#include <stdlib.h>

#include "caster.h"
#include "check.h"
#include "nasty.h"

/* --- one build of it -------------------------------------------------------------------------- */

typedef struct built {
    void *area, *scratch;
    lrcs_scene scene;
    const lrcs_prepared *prepared;
} built;

static unsigned char run_memory[1u << 27];

static void build(const nasty_scene *s, double tolerance, uint32_t facets, built *b)
{
    lrcs_build_options options = {tolerance, facets, LRCS_NORMALS_FLAT};
    size_t need = lrcs_scene_need(&s->recipe, NULL, &options);
    b->area = malloc(need);
    lrcs_work work = lrcs_work_make(b->area, need);
    assert_int_equal(lrcs_scene_build(&s->recipe, NULL, &options, &work, &b->scene, NULL), LRCS_OK);
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

static void unbuild(built *b)
{
    free(b->area);
    free(b->scratch);
}

/* In no more bytes than the library asks for. */
static lrcs_result look(const built *b, const double d[3], int method)
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

/* --- what the comparisons came to --------------------------------------------------------------
 */

#define KEPT 100000

/* A family's: the share of the bound that errors use. */
typedef struct tally {
    double share[KEPT];
    unsigned count, scenes, unknown;
    double worst;
} tally;

static tally family[NASTY_FAMILIES];
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
    for (int i = 0; i < NASTY_FAMILIES; i++) {
        tally *t = &family[i];
        unsigned kept = t->count < KEPT ? t->count : KEPT;
        qsort(t->share, kept, sizeof t->share[0], by_size);
        printf("%-13s %7u scenes %7u comparisons, %u unknown, error / bound: worst %.3f, median "
               "%.2g\n",
               nasty_name[i], t->scenes, t->count, t->unknown, t->worst,
               kept ? t->share[kept / 2] : 0);
    }
    printf("%llu beyond their bounds\n", (unsigned long long)failures);
}

/* --- against itself --------------------------------------------------------------------------- */

static void compare(const nasty_scene *s, uint64_t began, const double d[3], const lrcs_result *a,
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
                nasty_name[s->family], (unsigned long long)began, d[0], d[1], d[2], a->sigma_m2,
                a->bound_m2, a->method, b->sigma_m2, b->bound_m2);
    }
    count_share(s->family, apart, most);
}

static double coarse_tolerance(void)
{
    static const double any[] = {1e-9, 1e-9, 0.5, 0.1, 0.01, 1e-3};
    return any[pick(6)];
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
    uint64_t began = nasty_seed;
    nasty_scene plain;
    nasty_scene s;
    built coarse;
    built fine;
    nasty_make(&plain, which);
    double size = any_size();
    nasty_transform(&plain, size, any_offset(size, 1e6), &s);
    build(&s, coarse_tolerance(), 64u << pick(4), &coarse);
    build(&s, 1e-9, 256u << pick(2), &fine);
    for (uint32_t i = 0; i < directions; i++) {
        double d[3];
        nasty_direction(&plain, d);
        lrcs_result best = look(&fine, d, LRCS_METHOD_EXACT);
        lrcs_result exact = look(&coarse, d, LRCS_METHOD_EXACT);
        lrcs_result other = look(&coarse, d, pick(2) ? LRCS_METHOD_ZBUFFER : LRCS_METHOD_FACET);
        compare(&s, began, d, &exact, &best);
        compare(&s, began, d, &other, &best);
    }
    family[which].scenes++;
    unbuild(&coarse);
    unbuild(&fine);
}

static void coarse_and_fine_agree_within_their_bounds(void **state)
{
    (void)state;
    nasty_seed = 20;
    for (int i = 0; i < 3 * NASTY_FAMILIES; i++) {
        scene_compare(i % NASTY_FAMILIES, 1);
    }
    assert_int_equal(failures, 0);
}

/* --- the truth, by rays ----------------------------------------------------------------------- */

/* Plates and boxes are as placed, which at the farthest is 1e-12 off. The size of the scene enters
   the build only: sigma goes with its square. A mirrored scene is seen from the mirrored direction.
 */
static void scene_cast(int which, uint32_t directions, int side)
{
    uint64_t began = nasty_seed;
    nasty_scene plain;
    nasty_scene s;
    built b;
    nasty_make(&plain, which);
    cast_scene rays = {.seed = nasty_seed};
    for (uint32_t i = 0; i < plain.recipe.part_count; i++) {
        int wears = plain.part[i].wears;
        cast_part(&rays, &plain.part[i], &plain.material[wears].brdf, wears);
    }
    double size = any_size();
    nasty_transform(&plain, size, any_offset(size, 1e3), &s);
    build(&s, coarse_tolerance(), 64u << pick(5), &b);
    for (uint32_t i = 0; i < directions; i++) {
        double d[3];
        nasty_direction(&plain, d);
        cast_answer truth = cast_run(&rays, d, side);
        for (int k = 0; k < 3; k++) {
            d[k] = size < 0 ? -d[k] : d[k];
        }
        lrcs_result r = look(&b, d, LRCS_METHOD_EXACT);
        double sigma = r.sigma_m2 / (size * size);
        double bound = r.bound_m2 / (size * size);
        double apart = fabs(sigma - truth.sigma);
        if (is_known(which, &r) && apart - bound > 7 * truth.error + 1e-9 * truth.sigma) {
            failures++;
            fprintf(stderr,
                    "%s, seed %llu, from %.17g %.17g %.17g: %.10g +- %.3g, by rays %.10g "
                    "+- %.3g\n",
                    nasty_name[which], (unsigned long long)began, d[0], d[1], d[2], sigma, bound,
                    truth.sigma, truth.error);
        }
        if (r.budget.tessellation_m2 >= 0 && bound > 10 * truth.error + 1e-8 * truth.sigma) {
            count_share(which, apart, bound);
        }
    }
    family[which].scenes++;
    unbuild(&b);
}

static void rays_stay_within_the_bound(void **state)
{
    (void)state;
    nasty_seed = 21;
    for (int i = 0; i < 3 * NASTY_FAMILIES; i++) {
        scene_cast(i % NASTY_FAMILIES, 2, 10);
    }
    assert_int_equal(failures, 0);
}

static int many(unsigned long count, int side)
{
    for (unsigned long i = 0; i < count; i++) {
        int which = (int)(i % NASTY_FAMILIES);
        if (side > 0) {
            scene_cast(which, 2, side);
        } else {
            scene_compare(which, 2);
        }
    }
    report();
    return failures != 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coarse_and_fine_agree_within_their_bounds),
        cmocka_unit_test(rays_stay_within_the_bound),
    };
    if (argc > 2) {
        nasty_seed = strtoull(argv[2], NULL, 10);
        return many(strtoul(argv[1], NULL, 10), argc > 3 ? (int)strtol(argv[3], NULL, 10) : 0);
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
