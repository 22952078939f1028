/* SPDX-License-Identifier: MIT */
/* f_r cos^2 against mpmath over the whole domain, its bound, and its edges. */
#include "optics/reflect.h"

#include <float.h>

#include "check.h"

static const struct vector {
    double A, B, s, m, tan2, glint, diffuse;
} vectors[] = {
#include "vectors/reflect.inc"
};

#define COUNT (sizeof vectors / sizeof vectors[0])

/* The relative error that reflect.c claims, 28 units of 2^-53, doubled for its d and x terms. */
#define CLAIMED (56.0 * 0x1p-53)

static lrcs_brdf vector_brdf(const struct vector *v)
{
    return (lrcs_brdf){v->A, v->B, v->s, v->m};
}

static void both_parts_agree_with_mpmath(void **state)
{
    (void)state;
    double worst = 0.0;
    for (size_t i = 0; i < COUNT; i++) {
        const struct vector *v = &vectors[i];
        lrcs_brdf brdf = vector_brdf(v);
        lrcsi_reflection r = lrcsi_reflect(&brdf, v->tan2, 0.0);
        /* far flanks (x > 1400, 1 + u > 1e300) and s beyond 2^+-500 are good to 3e-12 */
        int far = v->s < 0x1p-500 || v->s > 0x1p500;
        double most = far ? 3e-12 : CLAIMED;
        if (v->glint <= DBL_MAX) {
            check_abs(r.glint, v->glint, most * v->glint + 0x1p-1070);
        }
        check_abs(r.diffuse, v->diffuse, CLAIMED * v->diffuse + 0x1p-1070);
        if (!far && v->glint > 1e-300 && v->glint <= DBL_MAX) {
            worst = fmax(worst, fabs(r.glint / v->glint - 1.0));
        }
        if (v->diffuse > 1e-300) {
            worst = fmax(worst, fabs(r.diffuse / v->diffuse - 1.0));
        }
    }
    print_message("worst relative error %.2g\n", worst);
}

static void the_bound_holds_and_is_tight(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT; i++) {
        const struct vector *v = &vectors[i];
        lrcs_brdf brdf = vector_brdf(v);
        lrcsi_reflection r = lrcsi_reflect(&brdf, v->tan2, 0.0);
        if (v->glint <= DBL_MAX) {
            check_most(fabs(r.glint - v->glint) + fabs(r.diffuse - v->diffuse), r.error);
            check_most(r.error, 1e-11 * (v->glint + v->diffuse) + 0x1p-890);
        } else {
            assert_true(isinf(r.error));
        }
    }
}

static void the_bound_covers_what_tan2_is_off_by(void **state)
{
    (void)state;
    static const double off[] = {1e-15, 1e-9, 1e-4, 0.01, 0.2, 0.5, 0.99};
    for (size_t i = 0; i < COUNT; i++) {
        const struct vector *v = &vectors[i];
        lrcs_brdf brdf = vector_brdf(v);
        for (size_t k = 0; k < sizeof off / sizeof off[0] && v->glint <= DBL_MAX; k++) {
            for (int sign = -1; sign <= 1; sign += 2) {
                lrcsi_reflection r = lrcsi_reflect(&brdf, v->tan2 * (1.0 + sign * off[k]),
                                                   off[k] * (1.0 + 1e-15) + 0x1p-52);
                check_most(fabs(r.glint - v->glint) + fabs(r.diffuse - v->diffuse), r.error);
            }
        }
    }
}

/* Where the glint leaves the doubles, against long double, which holds it down to x = 11000. */
static void far_flanks_stay_within_their_error(void **state)
{
    (void)state;
    need_wide_long_double();
    static const double amplitude[] = {1e-305, 0x1p-501, 0x1p-500, 1e-9,  1.0,
                                       1e9,    0x1p70,   0x1p71,   1e200, 1e305};
    static const double slope[] = {0.003, 0.1, 0.5, 2.0, 1e100};
    for (int i = 0; i < 10 * 5; i++) {
        lrcs_brdf brdf = {amplitude[i % 10], 0.0, slope[i / 10], 0.0};
        for (double x = 500.0; x < 3500.0; x *= 1.003) {
            double u = x * brdf.s * brdf.s;
            lrcsi_reflection r = lrcsi_reflect(&brdf, u, 0.0);
            long double log = 2.0L * log1pl(u) - u / ((long double)brdf.s * brdf.s);
            long double want = brdf.A * expl(log);
            if (want < 1e300L) {
                check_most((double)fabsl(r.glint - want), r.error);
                check_most(r.error, 1e-11 * (double)want + 0x1p-890);
            }
        }
    }
}

static void nothing_is_ever_nan(void **state)
{
    (void)state;
    static const double end[] = {0.0,    5e-324, 1e-300, 1e-160, 1e-6,  0.5,
                                 0.7072, 1.0,    1e3,    1e160,  1e300, DBL_MAX};
    for (size_t i = 0; i < 12 * 12 * 12 * 3; i++) {
        lrcs_brdf brdf = {i % 3 == 0 ? 0.0 : end[(i / 3 + 5) % 12], i % 3 == 1 ? 0.0 : 1.0,
                          end[i / 3 % 12], end[i / 36 % 12]};
        if (lrcs_brdf_check(&brdf) < 0) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            lrcsi_reflection r = lrcsi_reflect(&brdf, end[i / 432], k == 0 ? 0.0 : 0.2 * k);
            assert_true(isfinite(r.glint) && r.glint >= 0.0);
            assert_true(isfinite(r.diffuse) && r.diffuse >= 0.0);
            assert_true(r.error >= 0.0);
        }
    }
}

static void edge_on_reflects_exactly_nothing(void **state)
{
    (void)state;
    lrcs_brdf brdf = {1.0, 1.0, 1e3, 0.0};
    lrcsi_reflection r = lrcsi_reflect(&brdf, HUGE_VAL, 1e-15);
    check_same(r.glint, 0.0);
    check_same(r.diffuse, 0.0);
    check_same(r.error, 0.0);
}

static void a_part_of_no_amplitude_is_exactly_zero(void **state)
{
    (void)state;
    lrcs_brdf diffuse = {0.0, 0.25, 0.0, 0.5};
    lrcs_brdf glint = {1.0, 0.0, 0.2, 0.5};
    check_same(lrcsi_reflect(&diffuse, 0.3, 0.0).glint, 0.0);
    check_same(lrcsi_reflect(&glint, 0.3, 0.0).diffuse, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_parts_agree_with_mpmath),
        cmocka_unit_test(the_bound_holds_and_is_tight),
        cmocka_unit_test(the_bound_covers_what_tan2_is_off_by),
        cmocka_unit_test(far_flanks_stay_within_their_error),
        cmocka_unit_test(nothing_is_ever_nan),
        cmocka_unit_test(edge_on_reflects_exactly_nothing),
        cmocka_unit_test(a_part_of_no_amplitude_is_exactly_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
