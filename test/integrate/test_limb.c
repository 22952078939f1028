/* SPDX-License-Identifier: MIT */
/* Small bright targets behind the limb of a black ball, wholly in its true shadow, which ends beyond
   that of its facets: sigma is 0, and must not exceed the bound, whatever the facets leave visible.
   The contour of the facets follows the rings of the mesh, and may lie far above or below the
   target. usage: test_limb [SCENES SEED]    (many more) */
#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "random.h"
#include "recipe.h"

static uint64_t state_of_random;

static double between(double low, double high)
{
    return low + (high - low) * random_unit(&state_of_random);
}

static int one_of(int count)
{
    return (int)between(0, count);
}

/* A rotation about z, then by `tilt` about y, then about z. */
static void rotate(lrcs_recipe_part *part, double tilt)
{
    const double a = between(0, 2 * LRCS_PI);
    const double b = between(0, 2 * LRCS_PI);
    const double ca = cos(a);
    const double sa = sin(a);
    const double cb = cos(b);
    const double sb = sin(b);
    const double ct = cos(tilt);
    const double st = sin(tilt);
    const double R[3][3] = {{ca * ct * cb - sa * sb, -ca * ct * sb - sa * cb, ca * st},
                            {sa * ct * cb + ca * sb, -sa * ct * sb + ca * cb, sa * st},
                            {-st * cb, st * sb, ct}};
    memcpy(part->place.rotate, R, sizeof R);
}

/* A target of about this size: a plate, a box, a ball or a cylinder. No point of it is farther than
   1.8 sizes from its origin. */
static lrcs_shape target_of(double size)
{
    const lrcs_shape shapes[4] = {
        {.kind = LRCS_SHAPE_PLATE, .size = {size, size}},
        {.kind = LRCS_SHAPE_BOX, .size = {size, size, size}},
        {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5 * size},
        {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5 * size, .length = size}};
    return shapes[one_of(4)];
}

/* Runs such a scene. Returned: 1 if sigma is not 0 in the answer, but within the bound; -1 if it is
   beyond the bound; 0 otherwise. */
static int scene_check(void)
{
    static const double tolerances[5] = {1, 0.5, 0.2, 0.1, 0.05};
    static const double up[3] = {0, 0, 1};
    static const lrcs_brdf bright = {0, 0.7, 1, 0};
    lrcs_recipe_material material[2];
    lrcs_recipe_part part[2];
    const lrcs_recipe recipe = recipe_bright_and_black(&bright, part, material);
    const double tolerance = tolerances[one_of(5)];
    const double strip = 0.04 * fmin(tolerance, 0.15); /* about as wide as the outlines differ */
    const double inside = strip * between(0.02, 0.5);
    const double size = inside * exp(between(-4, -1)) / 1.8;
    const double azimuth = between(0, 2 * LRCS_PI);
    const double z = -sqrt(2 * inside + 4 * size) - between(0, 0.1); /* outside the ball */
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    rotate(&part[1], one_of(4) > 0 ? between(0, 0.3) : between(0, LRCS_PI));
    part[0].shape = target_of(size);
    rotate(&part[0], one_of(3) > 0 ? between(0, 0.3) : between(0, LRCS_PI));
    part[0].place.translate[0] = (1 - inside) * cos(azimuth);
    part[0].place.translate[1] = (1 - inside) * sin(azimuth);
    part[0].place.translate[2] = z;
    const lrcs_build_options build = {tolerance, 1u << 15, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_run_options run = lrcs_run_options_default();
    run.method = one_of(5) > 0 ? LRCS_METHOD_EXACT : LRCS_METHOD_AUTO;
    const lrcs_result r = recipe_run(&recipe, &build, &run, up);
    if (r.sigma_m2 > r.bound_m2) {
        fprintf(stderr, "tolerance %g, target at %.17g %.17g %.17g: sigma %g, bound %g\n",
                tolerance, part[0].place.translate[0], part[0].place.translate[1], z, r.sigma_m2,
                r.bound_m2);
    }
    return r.sigma_m2 > r.bound_m2 ? -1 : r.sigma_m2 > 0;
}

static int scenes_check(int count, uint64_t seed, int *lit)
{
    int beyond = 0;
    state_of_random = seed;
    *lit = 0;
    for (int i = 0; i < count; i++) {
        const int answer = scene_check();
        *lit += answer != 0;
        beyond += answer < 0;
    }
    return beyond;
}

static void targets_in_the_true_shadow_are_dark_within_the_bound(void **state)
{
    (void)state;
    int lit;
    assert_int_equal(scenes_check(120, 1, &lit), 0);
    assert_true(lit > 20);
}

int main(int argc, char **argv)
{
    if (argc == 3) {
        int lit;
        const int beyond = scenes_check(atoi(argv[1]), strtoull(argv[2], NULL, 10), &lit);
        printf("%s scenes, %d of them lit by facets, %d beyond their bounds\n", argv[1], lit,
               beyond);
        return beyond != 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(targets_in_the_true_shadow_are_dark_within_the_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
