/* SPDX-License-Identifier: MIT */
/* Integrals of positive parts of quadratic functions, against sums over many points. */
#include "base/parabola.h"

#include "check.h"
#include "random.h"

static double positive_sum(const double value[3], double sign, double shift)
{
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = (i + 0.5) / STEPS;
        const double at = value[0] * (1 - t) * (1 - 2 * t) + 4 * value[1] * t * (1 - t) +
                          value[2] * t * (2 * t - 1);
        sum += fmax(0, sign * at + shift) / STEPS;
    }
    return sum;
}

static void the_bound_is_above_the_integral_and_close(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 300; i++) {
        double value[3];
        double size = 0;
        for (int k = 0; k < 3; k++) {
            value[k] = 2 * random_unit(&seed) - 1;
            size += fabs(value[k]);
        }
        const double shift = i % 3 == 0 ? 0.2 * random_unit(&seed) : 0;
        for (int sign = -1; sign <= 1; sign += 2) {
            const double want = positive_sum(value, sign, shift);
            const double got = lrcsi_parabola_positive(value, sign, shift);
            check_most(want, got + 1e-7 * size); /* the sum's error */
            check_most(got, want + 0.02 * size);
        }
    }
}

/* Linear functions have no distance from their chords: the bound is exact, but where the sign
   changes within a chord, which is exact as well. */
static void linear_functions_are_exact(void **state)
{
    (void)state;
    check_abs(lrcsi_parabola_positive((const double[3]){1, 2, 3}, 1, 0), 2, 1e-14);
    check_abs(lrcsi_parabola_positive((const double[3]){1, 2, 3}, -1, 0), 0, 0);
    check_abs(lrcsi_parabola_positive((const double[3]){-1, 0, 1}, 1, 0), 0.25, 1e-14);
    check_abs(lrcsi_parabola_positive((const double[3]){-1, 0, 1}, -1, 0), 0.25, 1e-14);
    check_abs(lrcsi_parabola_positive((const double[3]){0, 0, 0}, 1, 0.5), 0.5, 1e-14);
    check_abs(lrcsi_parabola_positive((const double[3]){0, 0, 0}, 1, -0.5), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bound_is_above_the_integral_and_close),
        cmocka_unit_test(linear_functions_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
