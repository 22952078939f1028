/* SPDX-License-Identifier: MIT */
/* The library as the oracle of a unit test: an implementation of one's own, here a loop in float
   over a convex box, must agree with it to within the accuracy of float; the oracle states the
   largest possible error of its own answer. build: cc test_mine.c -I../../include
   ../../build/liblrcs.a -lcmocka -lm -pthread */
#include <lrcs/host.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define REL 1e-5 /* of a float sum over 12 facets; the exponential of the glint takes the most */

/* What is to be tested: sigma of a mesh that nothing shadows, m2. */
static float my_sigma(const lrcs_scene *scene, const lrcs_brdf *brdf, const float s_hat[3])
{
    float sum = 0.0f;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        float p[3][3];
        for (int i = 0; i < 9; i++) {
            p[i / 3][i % 3] = (float)scene->vertex[scene->facet[f].corner[i / 3]].x[i % 3];
        }
        float n[3]; /* twice the area, along the outward normal */
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            int k = (i + 2) % 3;
            n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) -
                   (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
        }
        float twice = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        float c = (n[0] * s_hat[0] + n[1] * s_hat[1] + n[2] * s_hat[2]) / twice;
        if (c > 0.0f) {
            float u = 1.0f / (c * c) - 1.0f; /* tan^2 */
            float glint = (float)brdf->A / powf(c, 6.0f) * expf(-u / (float)(brdf->s * brdf->s));
            sum += (glint + (float)brdf->B * powf(c, (float)brdf->m)) * c * c * twice / 2.0f;
        }
    }
    return 12.5663706f * sum;
}

static void my_sigma_is_right_from_all_sides(void **state)
{
    (void)state;
    lrcs_recipe_part part = {.name = "bus", .material_index = -1, .place = lrcs_place_default()};
    part.shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1.0, 0.8, 1.4}};
    lrcs_binding paint = {.kind = LRCS_BIND_DEFAULT, .brdf = {0.5, 0.2, 0.3, 0.5}, .two_sided = -1};
    lrcs_recipe recipe = {.part = &part, .part_count = 1, .binding = &paint, .binding_count = 1};
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_host_scene scene = {0};
    assert_int_equal(lrcs_host_scene_make(&recipe, &build, &scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(&scene, NULL), LRCS_OK);
    for (double az = 0; az < 360; az += 7) {
        lrcs_pose pose;
        lrcs_result truth;
        lrcs_run_options options = lrcs_run_options_default();
        assert_int_equal(lrcs_pose_from_azel(az, az / 4 - 45, &pose), LRCS_OK);
        assert_int_equal(
            lrcs_host_scene_run(&scene, &pose, &options, &truth, NULL, NULL, NULL, NULL), LRCS_OK);
        const double *z = pose.R[2]; /* the unit vector to the laser, body frame */
        const float s_hat[3] = {(float)z[0], (float)z[1], (float)z[2]};
        double error = fabs((double)my_sigma(&scene.scene, &paint.brdf, s_hat) - truth.sigma_m2);
        assert_true(error <= REL * truth.sigma_m2 + truth.bound_m2);
    }
    lrcs_host_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(my_sigma_is_right_from_all_sides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
