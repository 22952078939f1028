/* SPDX-License-Identifier: MIT */
/* Range profiles of curved shapes, which facets replace: bins against integrals over the true
   surfaces where nothing is hidden; and random scenes that hide and pierce each other, built coarse
   and fine, whose bins, sums and pulses differ by no more than both bounds together. */
#include <lrcs/profile.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "memory_limit.h"
#include "shape_scenes.h"

#define PI 3.14159265358979323846

typedef struct built {
    void *memory[2];
    lrcs_scene scene;
    const lrcs_prepared *prepared;
} built;

static void *memory_of(size_t size)
{
    void *memory = malloc(size);
    assert_non_null(memory);
    return memory;
}

/* What is prepared points to the scene, which stays where it is. */
static void build_models(const lrcs_recipe *recipe, const lrcs_mesh *models, double tolerance,
                         uint32_t most, int only, built *b)
{
    const lrcs_build_options options = {tolerance, most, LRCS_NORMALS_FLAT, only, 0, NULL};
    size_t need = lrcs_scene_need(recipe, models, &options);
    b->memory[0] = memory_of(need);
    lrcs_work work = lrcs_work_make(b->memory[0], need);
    assert_int_equal(lrcs_scene_build(recipe, models, &options, &work, &b->scene, NULL), LRCS_OK);
    int status = LRCS_E_MEMORY;
    b->memory[1] = NULL;
    for (need = lrcs_prepare_need(&b->scene); status == LRCS_E_MEMORY; need *= 2) {
        free(b->memory[1]);
        b->memory[1] = memory_of(need);
        work = lrcs_work_make(b->memory[1], need);
        status = lrcs_prepare_run(&b->scene, &work, &b->prepared);
    }
    assert_int_equal(status, LRCS_OK);
}

/* With the facets that profiles want, as hosts do. */
static void build(const lrcs_recipe *recipe, double tolerance, uint32_t most, built *b)
{
    build_models(recipe, NULL, tolerance, most, LRCS_FACETS_LOCAL, b);
}

static void built_free(built *b)
{
    free(b->memory[0]);
    free(b->memory[1]);
}

/* Returns the memory that holds the bins. */
static void *profile_make(const built *b, const double d[3], double bin, lrcs_profile *profile)
{
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    void *memory = NULL;
    int status = LRCS_E_MEMORY;
    for (size_t need = lrcs_profile_need(b->prepared, bin); status == LRCS_E_MEMORY; need *= 2) {
        free(memory);
        memory = memory_of(need);
        lrcs_work work = lrcs_work_make(memory, need);
        status = lrcs_profile_run(b->prepared, &pose, bin, &work, profile);
    }
    assert_int_equal(status, LRCS_OK);
    return memory;
}

/* The bin of number k; nothing where the profile has none. */
static lrcs_profile_bin bin_at(const lrcs_profile *profile, int64_t k)
{
    int inside = k >= profile->first && k < profile->first + profile->count;
    return inside ? profile->bin[k - profile->first] : (lrcs_profile_bin){0, 0, 0, 0, 0, 0};
}

static double sigma_of(const lrcs_profile_bin *bin)
{
    return bin->sigma_glint_m2 + bin->sigma_diffuse_m2;
}

/* --- true surfaces ---------------------------------------------------------------------------- */

/* f_r cos^2 from the cosine of incidence. */
static double reflect(const lrcs_brdf *brdf, double cosine)
{
    double tan2 = 1 / (cosine * cosine) - 1;
    return cosine > 0 ? brdf->A * exp(-tan2 / brdf->s / brdf->s) / pow(cosine, 4) +
                            brdf->B * pow(cosine, brdf->m + 2)
                      : 0;
}

/* Sigma, and its first moment about `about`, m^2 and m^3. */
typedef struct part_sum {
    double sigma, moment;
} part_sum;

#define STEPS 2000

/* The part of a sphere about the origin at ranges between two: ranges are -R cos(incidence), and
   the area between two of them is 2 pi R times their distance. Midpoint rule. */
static part_sum sphere_between(const lrcs_brdf *brdf, double radius, double from, double to,
                               double about)
{
    part_sum sum = {0, 0};
    double low = fmax(from, -radius);
    double high = fmin(to, 0);
    for (int i = 0; i < STEPS && low < high; i++) {
        double z = low + (i + 0.5) / STEPS * (high - low);
        double part = 4 * PI * reflect(brdf, -z / radius) * 2 * PI * radius * (high - low) / STEPS;
        sum.sigma += part;
        sum.moment += part * (z - about);
    }
    return sum;
}

/* The part of a wall about z from height 0, where its radius is a, to `height`, where it is b, and
   of its caps where it has them, seen from (sin tilt, 0, cos tilt). For each azimuth the incidence
   is constant along the wall, and range linear. The caps by strips of equal range. */
typedef struct wall {
    double a, b, height;
    int capped;
    lrcs_brdf brdf;
} wall;

/* Adds what lies between two ranges of a strip along the wall. Given: the radii and ranges at its
   ends. */
static void strip_add(double weight, const double radius[2], const double z[2], double low,
                      double high, double about, part_sum *sum)
{
    double fall = z[1] - z[0];
    double first = (low - z[0]) / fall;
    double last = (high - z[0]) / fall;
    const double t[2] = {fmin(1, fmax(0, fmin(first, last))), fmin(1, fmax(0, fmax(first, last)))};
    double grow = radius[1] - radius[0]; /* the radius, and with it the area, is linear in t */
    double area = (t[1] - t[0]) * (radius[0] + 0.5 * grow * (t[0] + t[1]));
    double square = (t[1] * t[1] - t[0] * t[0]) / 2;
    double cube = (t[1] * t[1] * t[1] - t[0] * t[0] * t[0]) / 3;
    sum->sigma += weight * area;
    sum->moment += weight * ((z[0] - about) * area + fall * (radius[0] * square + grow * cube));
}

static part_sum wall_between(const wall *w, double tilt, double low, double high, double about)
{
    part_sum sum = {0, 0};
    double across = sin(tilt);
    double along = cos(tilt);
    double slope = (w->a - w->b) / w->height;
    double length = sqrt(1 + slope * slope);
    double radius[2] = {w->a, w->b};
    for (int i = 0; i < STEPS; i++) {
        double azimuth = 2 * PI * (i + 0.5) / STEPS;
        double cosine = (across * cos(azimuth) + along * slope) / length;
        double z[2] = {-w->a * cos(azimuth) * across,
                       -w->b * cos(azimuth) * across - w->height * along};
        double weight = 4 * PI * reflect(&w->brdf, cosine) * w->height * length * 2 * PI / STEPS;
        strip_add(weight, radius, z, low, high, about, &sum);
    }
    if (w->capped) { /* between two chords of the cap that faces the laser */
        double cap = along > 0 ? w->b : w->a;
        double middle = along > 0 ? -w->height * along : 0;
        double x[2] = {fmin(cap, fmax(-cap, (low - middle) / across)),
                       fmin(cap, fmax(-cap, (high - middle) / across))};
        double half[2]; /* chords */
        for (int i = 0; i < 2; i++) {
            half[i] = sqrt(cap * cap - x[i] * x[i]);
        }
        double area = cap > 0 ? x[1] * half[1] - x[0] * half[0] +
                                    cap * cap * (asin(x[1] / cap) - asin(x[0] / cap))
                              : 0;
        double first = 2 / 3.0 * (pow(half[0], 3) - pow(half[1], 3)); /* of x over the area */
        double scale = 4 * PI * reflect(&w->brdf, fabs(along));
        sum.sigma += scale * area;
        sum.moment += scale * (area * (middle - about) + across * first);
    }
    return sum;
}

/* --- against them ----------------------------------------------------------------------------- */

/* All bins of a shape moved by `shift` in range. `off` is what the reference may be off by. */
static void check_bins(const lrcs_profile *p, double shift, double off,
                       part_sum (*truth)(const void *, double, double, double), const void *shape)
{
    double all = 0;
    for (int64_t k = p->first - 2; k < p->first + p->count + 2; k++) {
        double low = (double)k * p->bin_m - shift;
        part_sum want = truth(shape, low, low + p->bin_m, low + 0.5 * p->bin_m);
        lrcs_profile_bin bin = bin_at(p, k);
        check_abs(sigma_of(&bin), want.sigma, bin.bound_m2 + off);
        check_abs(bin.moment_m3, want.moment,
                  (0.5 * p->bin_m + p->range_err_m) * (bin.variation_m2 + off) +
                      p->range_err_m * (want.sigma + bin.bound_m2));
        assert_true(bin.variation_m2 >= bin.bound_m2);
        all += want.sigma;
    }
    check_abs(p->sigma_glint_m2 + p->sigma_diffuse_m2, all, p->bound_m2 + off);
}

typedef struct ball {
    double radius;
    lrcs_brdf brdf;
} ball;

static part_sum ball_truth(const void *shape, double low, double high, double about)
{
    const ball *b = shape;
    return sphere_between(&b->brdf, b->radius, low, high, about);
}

typedef struct leaning {
    wall wall;
    double tilt;
} leaning;

static part_sum wall_truth(const void *shape, double low, double high, double about)
{
    const leaning *l = shape;
    return wall_between(&l->wall, l->tilt, low, high, about);
}

static const lrcs_brdf shiny = {0.75, 0.25, 0.4, 1};

static lrcs_recipe recipe_of(lrcs_recipe_part *part, lrcs_recipe_material *material)
{
    *material = (lrcs_recipe_material){.name = "m", .brdf = shiny};
    *part = (lrcs_recipe_part){.name = "p", .place = lrcs_place_default(), .material = "m"};
    return (lrcs_recipe){.part = part, .part_count = 1, .material = material, .material_count = 1};
}

static void bins_of_a_sphere_hold_the_integral_over_it(void **state)
{
    (void)state;
    const double d[3][3] = {{0, 0, 1}, {1, 0, 0}, {2 / 3.0, -1 / 3.0, 2 / 3.0}};
    lrcs_recipe_part part;
    lrcs_recipe_material material;
    lrcs_recipe recipe = recipe_of(&part, &material);
    part.shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.75};
    part.place.translate[0] = 0.3;
    part.place.translate[2] = -1.1;
    const ball truth = {0.75, shiny};
    double loose[2];
    for (int fine = 0; fine < 2; fine++) {
        built b;
        build(&recipe, fine ? 1e-9 : 1e-3, fine ? 8000 : 1000, &b);
        for (int i = 0; i < 6; i++) {
            lrcs_profile profile;
            void *memory = profile_make(&b, d[i / 2], i % 2 ? 0.05 : 0.37, &profile);
            assert_true(profile.tessellation_known);
            double shift = -0.3 * d[i / 2][0] + 1.1 * d[i / 2][2];
            check_bins(&profile, shift, 1e-7, ball_truth, &truth);
            loose[fine] = profile.bound_m2 / profile.sigma_diffuse_m2;
            free(memory);
        }
        built_free(&b);
    }
    assert_true(loose[0] < 0.05 && loose[1] < 0.2 * loose[0]); /* second order in the facets */
}

/* Cylinders, cones and frusta, closed or of their wall alone, from above, aside and below. What
   faces the laser is visible as a whole. */
static void bins_of_walls_hold_the_integral_over_them(void **state)
{
    (void)state;
    static const int kind[] = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_CONE, LRCS_SHAPE_FRUSTUM};
    static const double tilt[] = {0.3, 1.0, 1.5, 2.2};
    for (int i = 0; i < 24; i++) {
        lrcs_recipe_part part;
        lrcs_recipe_material material;
        lrcs_recipe recipe = recipe_of(&part, &material);
        int capped = i < 12;
        leaning truth = {{0.5, 0.5, 1.25, capped, shiny}, tilt[i / 3 % 4]};
        part.shape = (lrcs_shape){.kind = kind[i % 3], .radius = 0.5, .length = 1.25};
        part.shape.parts = capped ? LRCS_SHAPE_ALL : LRCS_SHAPE_WALL;
        if (part.shape.kind == LRCS_SHAPE_CONE) {
            truth.wall.b = 0;
        } else if (part.shape.kind == LRCS_SHAPE_FRUSTUM) {
            truth.wall.a = part.shape.radius2 = 0.875;
        }
        const double d[3] = {sin(truth.tilt), 0, cos(truth.tilt)};
        built b;
        build_models(&recipe, NULL, 1e-4, 4000, i % 2 ? LRCS_FACETS_TOTAL : LRCS_FACETS_LOCAL, &b);
        for (int fine = 0; fine < 2; fine++) {
            lrcs_profile profile;
            void *memory = profile_make(&b, d, fine ? 0.05 : 0.4, &profile);
            assert_true(profile.tessellation_known);
            double sigma = profile.sigma_glint_m2 + profile.sigma_diffuse_m2;
            check_bins(&profile, 0, 1e-6 * sigma, wall_truth, &truth);
            assert_true(profile.bound_m2 < 1e-2 * sigma);
            free(memory);
        }
        built_free(&b);
    }
}

/* --- coarse against fine ---------------------------------------------------------------------- */

static void compare(const shape_scene *s, uint64_t seed, const lrcs_profile *a,
                    const lrcs_profile *b)
{
    int64_t first = a->first < b->first ? a->first : b->first;
    int64_t a_end = a->first + a->count;
    int64_t b_end = b->first + b->count;
    double rounding = 1e-15 * (a->sigma_glint_m2 + a->sigma_diffuse_m2);
    for (int64_t k = first; k < a_end || k < b_end; k++) {
        lrcs_profile_bin x = bin_at(a, k);
        lrcs_profile_bin y = bin_at(b, k);
        if (!(fabs(sigma_of(&x) - sigma_of(&y)) <= x.bound_m2 + y.bound_m2 + rounding)) {
            fprintf(stderr, "%s, seed %llu, bin %lld: ", shape_scene_name[s->family],
                    (unsigned long long)seed, (long long)k);
        }
        check_abs(sigma_of(&x), sigma_of(&y), x.bound_m2 + y.bound_m2 + rounding);
    }
    check_abs(a->sigma_glint_m2 + a->sigma_diffuse_m2, b->sigma_glint_m2 + b->sigma_diffuse_m2,
              a->bound_m2 + b->bound_m2 + rounding);
    for (int i = 0; i <= 20; i++) {
        double z = ((double)first + i / 20.0 * (double)(a_end - first)) * a->bin_m;
        double density[2];
        double bound[2];
        double estimate;
        assert_int_equal(lrcs_profile_pulse(a, 4 * a->bin_m, z, &density[0], &bound[0], &estimate),
                         LRCS_OK);
        assert_int_equal(lrcs_profile_pulse(b, 4 * b->bin_m, z, &density[1], &bound[1], &estimate),
                         LRCS_OK);
        check_abs(density[0], density[1], bound[0] + bound[1] + rounding / a->bin_m);
    }
}

static void coarse_and_fine_scenes_agree_within_their_bounds(void **state)
{
    (void)state;
    static const double bin[] = {0.02, 0.1, 0.5, 3};
    static const double sizes[] = {1, 1, 1e3, 1e-3, -1};
    static const double offsets[] = {0, 0, 1e3};
    int known = 0;
    shape_scene_seed = 31;
    for (int i = 0; i < 2 * SHAPE_SCENE_FAMILIES; i++) {
        uint64_t seed = shape_scene_seed;
        shape_scene plain;
        shape_scene s;
        lrcs_profile coarse;
        lrcs_profile fine;
        double d[3];
        shape_scene_make(&plain, i % SHAPE_SCENE_FAMILIES);
        shape_scene_direction(&plain, d);
        double size = sizes[pick(5)];
        shape_scene_transform(&plain, size, offsets[pick(3)] * fabs(size), &s);
        built b[2];
        build(&s.recipe, pick(2) ? 1e-9 : 0.05, 64u << pick(3), &b[0]);
        build(&s.recipe, 1e-9, 500, &b[1]);
        double width = bin[pick(4)] * fabs(size);
        void *memory[2] = {profile_make(&b[0], d, width, &coarse),
                           profile_make(&b[1], d, width, &fine)};
        if (coarse.tessellation_known && fine.tessellation_known) {
            compare(&s, seed, &coarse, &fine);
            known++;
        }
        for (int k = 0; k < 2; k++) {
            free(memory[k]);
            built_free(&b[k]);
        }
    }
    assert_true(2 * known > 3 * SHAPE_SCENE_FAMILIES);
}

/* --- what is not known, and what takes no part ------------------------------------------------ */

/* The sum of the bins is sigma of the facets, within the bounds of both but for what curved shapes
   would add to them. */
static void check_facets(const built *b, const double d[3], const lrcs_profile *profile)
{
    lrcs_pose pose;
    lrcs_result r;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_EXACT;
    options.tolerance = 1e-6; /* that of a profile, on which means over patches depend */
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    size_t need = lrcs_sigma_need(b->prepared, &options);
    void *memory = memory_of(need);
    lrcs_work work = lrcs_work_make(memory, need);
    assert_int_equal(lrcs_sigma_run(b->prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
    double bound = profile->bound_m2 + r.budget.visibility_m2 + r.budget.rounding_m2;
    check_abs(profile->sigma_glint_m2 + profile->sigma_diffuse_m2, r.sigma_m2, bound);
    check_most(bound, 1e-6 * r.sigma_m2);
    assert_true((r.budget.tessellation_m2 < 0) == !profile->tessellation_known);
    free(memory);
}

/* A ball that is sheared, and one so far away that rounding leaves facets without area: the bounds
   refer to the facets, and say so. Symptom: a profile of the former had more bins than there may
   be. */
static void bounds_without_known_curvature_are_those_of_facets(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        lrcs_recipe_part part[2];
        lrcs_recipe_material material;
        lrcs_recipe recipe = recipe_of(&part[0], &material);
        recipe.part_count = 1 + (uint32_t)i / 2;
        part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
        part[1] = part[0];
        part[1].place.translate[0] = 0.25;
        part[1].place.translate[2] = 2;
        if (i % 2) {
            part[0].place.translate[0] = part[1].place.translate[0] = 0x1p51;
            part[0].place.translate[1] = part[1].place.translate[1] = 0x1p51;
            part[0].place.scale[0] = part[0].place.scale[1] = part[0].place.scale[2] = 4;
        } else {
            part[0].place.rotate[0][1] = 0.5;
        }
        built b;
        lrcs_profile profile;
        const double d[3] = {i % 2 ? 0 : 0.1, 0, 1};
        build(&recipe, 0.05, 2000, &b);
        void *memory = profile_make(&b, d, 0.3, &profile);
        assert_int_equal(profile.tessellation_known, 0);
        if (i % 2 == 0) {
            check_facets(&b, d, &profile);
        }
        assert_true(profile.sigma_diffuse_m2 > 0);
        free(memory);
        built_free(&b);
    }
}

/* A pane of glass before a ball, and a facet of no area: they have no place in the profile, and do
   not touch its bounds. */
static void what_takes_no_part_changes_no_bin(void **state)
{
    (void)state;
    static lrcs_point vertex[6] = {{{-1, -1, 2}}, {{1, -1, 2}},  {{0, 1, 2}},
                                   {{0, 0, -9}},  {{9, 9, -20}}, {{0, 0, 30}}};
    static lrcs_facet facet[3] = {{{0, 1, 2}}, {{3, 3, 4}}, {{0, 1, 3}}};
    static uint32_t pane[3] = {0, 1, 1};
    static uint32_t zero[3];
    static lrcs_surface surface[2] = {{.name = "glass", .transparency = 1}, {.name = "skin"}};
    static const char *name[1] = {"model"};
    lrcs_profile profile[2];
    void *memory[2];
    built b[2];
    for (int i = 0; i < 2; i++) {
        lrcs_recipe_part part[2];
        lrcs_recipe_material material;
        lrcs_recipe recipe = recipe_of(&part[0], &material);
        part[1] = (lrcs_recipe_part){
            .name = "model", .file = "model", .place = lrcs_place_default(), .material_index = -1};
        const lrcs_mesh models[2] = {{0},
                                     {.vertex_count = 6,
                                      .facet_count = 3,
                                      .material_count = 2,
                                      .part_count = 1,
                                      .vertex = vertex,
                                      .facet = facet,
                                      .facet_material = pane,
                                      .facet_part = zero,
                                      .facet_smooth = zero,
                                      .material = surface,
                                      .part = name}};
        lrcs_mesh without[2] = {{0}, models[1]};
        without[1].facet_count = 1; /* the third facet, of skin, alone */
        without[1].facet = facet + 2;
        without[1].facet_material = pane + 2;
        recipe.part_count = 2;
        part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
        build_models(&recipe, i ? without : models, 0.01, 2000, LRCS_FACETS_TOTAL, &b[i]);
        memory[i] = profile_make(&b[i], (const double[3]){0.2, 0.1, 1}, 0.1, &profile[i]);
        assert_true(profile[i].tessellation_known);
    }
    assert_int_equal(profile[0].count, profile[1].count);
    assert_int_equal(profile[0].first, profile[1].first);
    for (uint32_t k = 0; k < profile[0].count; k++) {
        check_rel(sigma_of(&profile[0].bin[k]), sigma_of(&profile[1].bin[k]), 1e-12);
        check_rel(profile[0].bin[k].bound_m2, profile[1].bin[k].bound_m2, 1e-9);
    }
    for (int i = 0; i < 2; i++) {
        free(memory[i]);
        built_free(&b[i]);
    }
}

/* --- memory ----------------------------------------------------------------------------------- */

static const built *limited;
static lrcs_pose pose;
static lrcs_profile output;

static int profile_limited(lrcs_work *area)
{
    return lrcs_profile_run(limited->prepared, &pose, 0.2, area, &output);
}

/* A ball in front of a tube: areas of every facet, and the band about the contours. */
static void the_work_area_grows_until_it_suffices(void **state)
{
    (void)state;
    lrcs_recipe_part part[2];
    lrcs_recipe_material material;
    lrcs_recipe recipe = recipe_of(&part[0], &material);
    part[1] = part[0];
    recipe.part_count = 2;
    part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 1};
    part[1].place.translate[0] = -1.5;
    part[1].place.translate[1] = 0.25;
    built b;
    build(&recipe, 0.3, 64, &b);
    limited = &b;
    assert_int_equal(lrcs_pose_from_direction((const double[3]){4, 0, 1}, &pose), LRCS_OK);
    check_memory_limit(MEMORY_CASE("lrcs_profile_run", lrcs_profile_need(b.prepared, 0.2),
                                   profile_limited, output, 1));
    assert_true(output.tessellation_known && output.bound_m2 > 0);
    built_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_of_a_sphere_hold_the_integral_over_it),
        cmocka_unit_test(bins_of_walls_hold_the_integral_over_them),
        cmocka_unit_test(coarse_and_fine_scenes_agree_within_their_bounds),
        cmocka_unit_test(bounds_without_known_curvature_are_those_of_facets),
        cmocka_unit_test(what_takes_no_part_changes_no_bin),
        cmocka_unit_test(the_work_area_grows_until_it_suffices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
