/* SPDX-License-Identifier: MIT */
/* Degrees: exact at the corners, and within the stated error of mpmath elsewhere. */
#include "base/degrees.h"

#include "check.h"

static const struct vector {
    double deg, more, sine, sine_rest, cosine, cosine_rest;
} vectors[] = {
#include "vectors/degrees.inc"
};

static void multiples_of_thirty_and_ninety_are_exact(void **state)
{
    (void)state;
    static const double want[12] = {0, 0.5, -2, 1, -2, 0.5, 0, -0.5, -2, -1, -2, -0.5};
    for (int turn = -3; turn <= 3; turn++) {
        for (int i = 0; i < 12; i++) {
            double s, c;
            lrcsi_degrees_sincos(360.0 * turn + 30.0 * i, &s, &c);
            if (want[i] > -2) {
                check_same(s, want[i]);
            }
            if (want[(i + 3) % 12] > -2) {
                check_same(c, want[(i + 3) % 12]);
            }
            assert_false(s == 0.0 && signbit(s));
            assert_false(c == 0.0 && signbit(c));
        }
    }
}

static void doubles_are_within_half_an_ulp_or_so(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        if (vectors[i].more == 0.0) {
            double s, c;
            lrcsi_degrees_sincos(vectors[i].deg, &s, &c);
            check_rel(s, vectors[i].sine, 0x1p-53);
            check_rel(c, vectors[i].cosine, 0x1p-53);
        }
    }
}

static void plain_doubles_are_within_their_error(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        if (vectors[i].more == 0.0) {
            double s, c;
            lrcsi_degrees_sincos_plain(vectors[i].deg, &s, &c);
            check_abs(s - vectors[i].sine, 0.0, 0x1p-50);
            check_abs(c - vectors[i].cosine, 0.0, 0x1p-50);
        }
    }
    for (int n = 3; n < 3000; n += 7) { /* the azimuths of a body's sectors */
        for (int k = 0; k < n; k++) {
            lrcsi_dd want_s, want_c;
            double s, c;
            double deg = (2.0 * k + 1.0) * 180.0 / n;
            lrcsi_degrees_sincos_dd(deg, 0.0, &want_s, &want_c);
            lrcsi_degrees_sincos_plain(deg, &s, &c);
            check_abs(s - want_s.hi, 0.0, 0x1p-50);
            check_abs(c - want_c.hi, 0.0, 0x1p-50);
        }
    }
}

static void sums_keep_twenty_eight_digits(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        const struct vector *v = &vectors[i];
        lrcsi_dd s, c;
        lrcsi_degrees_sincos_dd(v->deg, v->more, &s, &c);
        double err = fabs(v->sine) > 0x1p-960 ? 0x1p-96 : 0x1p-53;
        check_abs((s.hi - v->sine) + (s.lo - v->sine_rest), 0.0, err * fabs(v->sine));
        check_abs((c.hi - v->cosine) + (c.lo - v->cosine_rest), 0.0, 0x1p-96 * fabs(v->cosine));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiples_of_thirty_and_ninety_are_exact),
        cmocka_unit_test(doubles_are_within_half_an_ulp_or_so),
        cmocka_unit_test(plain_doubles_are_within_their_error),
        cmocka_unit_test(sums_keep_twenty_eight_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
