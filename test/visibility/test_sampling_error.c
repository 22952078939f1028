/* SPDX-License-Identifier: MIT */
/* The likely error of samples where the true error has a closed form: a plate over another, their
   edges along the rows, so that every row errs by the same. */
#include <stdlib.h>

#include "scenes.h"

static test_scene scene;

/* A triangle of sides 8 and 5 under a plate that ends at x. Returns the run at N = 64, eight pixels
   a unit; *error is its true error, in square units, and 4 pi (1 + 1/4) times that in sigma. */
static lrcs_result partly_covered(double x, double *error)
{
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){8, 0, 0},
                   (const double[3]){8, 5, 0});
    scene_material(&scene, 0, 0, 0.2, 0); /* reflects nothing: all error is the triangle's */
    scene_plate(&scene, (const double[3]){0, 0, 1}, (const double[3]){x, 0, 0},
                (const double[3]){0, 5, 0});
    lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_ZBUFFER, 64);
    *error = fabs(r.sigma_m2 / (double)(5 * SCENE_PI) - (64 - x * x) * 5 / 16);
    check_most(*error * (double)(5 * SCENE_PI), r.bound_m2);
    return r;
}

/* Edges along the rows: each of about 20 rows errs by the same part of a pixel. */
static void edges_along_the_rows_err_by_what_is_guessed(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        double error = 0;
        lrcs_result r = partly_covered(4 + i / 64.0, &error);
        double guess = r.estimate_m2 / (double)(5 * SCENE_PI);
        double row = 20 / 64.0 * (4 - abs(i - 4)) / 8; /* midway between samples: 0 */
        check_abs(error, row, 0.5 / 64);
        check_most(error, guess);
        check_most(guess, 2 * row + 1.0 / 64);
    }
}

/* Without undecided facets the estimate is 0. */
static void whole_facets_have_no_likely_error(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){8, 1, 0},
                (const double[3]){0, 8, 0});
    lrcs_result r = scene_run(&scene, (const double[3]){1, 2, 3}, LRCS_METHOD_ZBUFFER, 64);
    check_same(r.estimate_m2, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_along_the_rows_err_by_what_is_guessed),
        cmocka_unit_test(whole_facets_have_no_likely_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
