/* SPDX-License-Identifier: MIT */
/* Curvature numbers under linear maps, against patches whose normals are drawn at random and mapped
   one by one. (The numbers before any map: test_tessellate.c.) */
#include "mesh/shape/patch_bounds.h"

#include "check.h"
#include "random.h"

#define NORMALS 24

static uint64_t seed = 5;

/* -1 .. 1. */
static double chance(void)
{
    return 2 * random_unit(&seed) - 1;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double v[3])
{
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

/* The numbers of a facet of area 1, by their definition, from pieces of patch. */
static lrcs_patch_bounds measure(const double facet[3], double normal[NORMALS][3],
                                 const double area[NORMALS])
{
    lrcs_patch_bounds c = {0, 0, 0, 0};
    double sum = 0;
    double square = 0;
    double vector[3] = {0, 0, 0};
    for (int i = 0; i < NORMALS; i++) {
        double along = dot(facet, normal[i]);
        double across[3];
        for (int k = 0; k < 3; k++) {
            across[k] = normal[i][k] - along * facet[k];
        }
        double sine = sqrt(dot(across, across));
        double turn = atan2(sine, along);
        for (int k = 0; k < 3 && sine > 0; k++) {
            vector[k] += area[i] * turn * across[k] / sine;
        }
        c.turn = fmax(c.turn, turn);
        sum += area[i];
        square += area[i] * turn * turn;
    }
    c.area_err = fabs(sum - 1);
    c.bias = sqrt(dot(vector, vector));
    c.rms_turn = sqrt(square);
    return c;
}

static void a_mapped_patch_stays_within_the_mapped_numbers(void **state)
{
    (void)state;
    double tightest = 0;
    for (int run = 0; run < 3000; run++) {
        /* Normals go by N = diag(1/scale), areas by |N n| times a constant. */
        double scale[3];
        double least = HUGE_VAL;
        double most = 0;
        double wide = pow(10, -2 + 1.5 * (chance() + 1) / 2);
        double facet[3] = {chance(), chance(), chance()};
        double normal[NORMALS][3];
        double area[NORMALS];
        double uneven;
        for (int k = 0; k < 3; k++) {
            scale[k] = exp((run % 3) * chance());
            least = fmin(least, scale[k]);
            most = fmax(most, scale[k]);
        }
        unit(facet);
        for (int i = 0; i < NORMALS; i++) {
            area[i] = (1 + 1e-3 * chance()) / NORMALS;
            for (int k = 0; k < 3; k++) {
                normal[i][k] = facet[k] + wide * chance();
            }
            unit(normal[i]);
        }
        lrcs_patch_bounds before = measure(facet, normal, area);
        lrcs_patch_bounds bound = lrcsi_patch_bounds_mapped(&before, most / least, &uneven);
        double whole = 0;
        for (int k = 0; k < 3; k++) {
            whole += facet[k] * facet[k] / scale[k] / scale[k];
        }
        for (int i = 0; i < NORMALS; i++) {
            double square = 0;
            for (int k = 0; k < 3; k++) {
                normal[i][k] /= scale[k];
                square += normal[i][k] * normal[i][k];
            }
            double more = sqrt(square / whole);
            check_most(more, (1 + uneven) * (1 + 1e-14));
            check_most(1 / more, (1 + uneven) * (1 + 1e-14));
            area[i] *= more;
            unit(normal[i]);
        }
        for (int k = 0; k < 3; k++) {
            facet[k] /= scale[k];
        }
        unit(facet);
        lrcs_patch_bounds after = measure(facet, normal, area);
        check_most(after.turn, bound.turn + 1e-14);
        check_most(after.area_err, bound.area_err + 1e-14);
        check_most(after.bias, bound.bias + 1e-14);
        check_most(after.rms_turn, bound.rms_turn + 1e-14);
        tightest = fmax(tightest, after.rms_turn / bound.rms_turn);
        if (run % 3 == 0) { /* no map */
            check_rel(bound.rms_turn, before.rms_turn, 1e-13);
            check_rel(bound.bias, before.bias, 1e-13);
            check_most(uneven, 1e-13);
        }
    }
    assert_true(tightest > 0.9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mapped_patch_stays_within_the_mapped_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
