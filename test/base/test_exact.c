/* SPDX-License-Identifier: MIT */
/* Exact signs and values: against rational arithmetic (vectors/exact_signs.py), against 64-bit
   integers, and the identities that a determinant obeys. */
#include "base/exact.h"

#include <string.h>

#include "check.h"
#include "random.h"

typedef struct sign_case {
    char kind; /* s: side, t: turn */
    int sign;
    double x[14]; /* a, b, c, and p or d; the determinant, the rest of it */
} sign_case;

static const sign_case sign_cases[] = {
#define CASE(kind, sign, ...)                                                                      \
    {                                                                                              \
        kind, sign,                                                                                \
        {                                                                                          \
            __VA_ARGS__                                                                            \
        }                                                                                          \
    }
#include "vectors/exact_signs.inc"
};

enum { SIGN_CASES = sizeof sign_cases / sizeof *sign_cases };

static int ask(char kind, const double *a, const double *b, const double *c, const double *d)
{
    return kind == 's' ? lrcsi_exact_side(a, b, c, d) : lrcsi_exact_orient(a, b, c, d);
}

/* The determinant as one would write it in plain doubles. */
static double plain_det(char kind, const double *x)
{
    double m[3][3];
    for (int k = 0; k < 3; k++) {
        m[0][k] = x[3 + k] - x[k];
        m[1][k] = x[6 + k] - x[k];
        m[2][k] = kind == 's' ? x[9 + k] - x[k] : x[9 + k];
    }
    return m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
           m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) +
           m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
}

static int sign_of(double x)
{
    return (x > 0.0) - (x < 0.0);
}

static void signs_agree_with_rational_arithmetic(void **state)
{
    (void)state;
    int plain_wrong = 0;
    for (int i = 0; i < SIGN_CASES; i++) {
        const double *x = sign_cases[i].x;
        assert_int_equal(ask(sign_cases[i].kind, x, x + 3, x + 6, x + 9), sign_cases[i].sign);
        plain_wrong += sign_of(plain_det(sign_cases[i].kind, x)) != sign_cases[i].sign;
    }
    assert_true(SIGN_CASES >= 2000);
    assert_true(plain_wrong > 300); /* the table is hard */
}

static void swapping_two_points_negates(void **state)
{
    (void)state;
    for (int i = 0; i < SIGN_CASES; i++) {
        char kind = sign_cases[i].kind;
        const double *x = sign_cases[i].x;
        assert_int_equal(ask(kind, x + 3, x, x + 6, x + 9), -sign_cases[i].sign);
        assert_int_equal(ask(kind, x, x + 6, x + 3, x + 9), -sign_cases[i].sign);
        if (kind == 's') {
            assert_int_equal(ask(kind, x + 9, x + 3, x + 6, x), -sign_cases[i].sign);
        }
    }
}

static void cyclic_shift_keeps_the_sign(void **state)
{
    (void)state;
    for (int i = 0; i < SIGN_CASES; i++) {
        const double *x = sign_cases[i].x;
        assert_int_equal(ask(sign_cases[i].kind, x + 3, x + 6, x, x + 9), sign_cases[i].sign);
        assert_int_equal(ask(sign_cases[i].kind, x + 6, x, x + 3, x + 9), sign_cases[i].sign);
    }
}

static void mirroring_negates(void **state)
{
    (void)state;
    for (int i = 0; i < SIGN_CASES; i++) {
        double x[12];
        for (int k = 0; k < 12; k++) {
            x[k] = -sign_cases[i].x[k];
        }
        assert_int_equal(ask(sign_cases[i].kind, x, x + 3, x + 6, x + 9), -sign_cases[i].sign);
    }
}

static void powers_of_two_change_nothing(void **state)
{
    (void)state;
    static const double scales[] = {0x1p-290, 0x1p-40, 0x1p60, 0x1p300};
    for (int i = 0; i < SIGN_CASES; i++) {
        for (int s = 0; s < 4; s++) {
            double x[12];
            for (int k = 0; k < 12; k++) {
                x[k] = sign_cases[i].x[k] * scales[s];
            }
            assert_int_equal(ask(sign_cases[i].kind, x, x + 3, x + 6, x + 9), sign_cases[i].sign);
        }
    }
}

/* Coordinates m 2^-20 + n 2^30 with small m and n: plain doubles lose m in the products, while the
   determinant of the differences m alone is exact in 64 bits when n is common to all points. */
static void far_from_the_origin_agrees_with_integers(void **state)
{
    (void)state;
    uint64_t seed = 12345;
    for (int i = 0; i < 20000; i++) {
        long long m[4][3];
        double x[4][3];
        for (int p = 0; p < 4; p++) {
            for (int k = 0; k < 3; k++) {
                random_mmix(&seed);
                m[p][k] = (long long)(seed >> 60) - 8;
                x[p][k] = (double)m[p][k] * 0x1p-20 + 0x1p30;
            }
        }
        for (int p = 1; p < 4; p++) {
            for (int k = 0; k < 3; k++) {
                m[p][k] -= m[0][k];
            }
        }
        long long det = m[3][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                        m[3][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                        m[3][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        int want = (det > 0) - (det < 0);
        assert_int_equal(lrcsi_exact_side(x[0], x[1], x[2], x[3]), want);
    }
}

/* Accurate to double-double, and the dot product to a double, however much cancels. */
static void values_agree_with_rational_arithmetic(void **state)
{
    (void)state;
    for (int i = 0; i < SIGN_CASES; i++) {
        const double *x = sign_cases[i].x;
        const double *value = x + 12;
        if (sign_cases[i].kind == 's') {
            lrcsi_dd height = lrcsi_exact_height(x, x + 3, x + 6, x + 9);
            lrcsi_dd off = lrcsi_dd_sub(height, (lrcsi_dd){value[0], value[1]});
            check_abs(off.hi, 0, 100 * 0x1p-106 * fabs(value[0]));
        } else {
            check_rel(lrcsi_exact_dot(x, x + 3, x + 6, x + 9), value[0], 0x1p-52);
        }
    }
}

/* d = 2^44 p + e with small integers: the large part lies in the plane of p and q. */
static void dot_keeps_its_digits_where_all_but_e_cancels(void **state)
{
    (void)state;
    uint64_t seed = 54321;
    for (int i = 0; i < 20000; i++) {
        long long m[3][3]; /* p, q, e */
        double x[4][3];
        for (int k = 0; k < 3; k++) {
            for (int v = 0; v < 3; v++) {
                random_mmix(&seed);
                m[v][k] = (long long)(seed >> 60) - 8;
            }
            x[0][k] = 0.375 * k;
            x[1][k] = x[0][k] + (double)m[0][k];
            x[2][k] = x[0][k] + (double)m[1][k];
            x[3][k] = (double)m[0][k] * 0x1p44 + (double)m[2][k];
        }
        long long det = m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
                        m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) +
                        m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
        check_rel(lrcsi_exact_dot(x[0], x[1], x[2], x[3]), (double)det, 0x1p-52);
    }
}

static void one_ulp_off_the_plane_is_seen(void **state)
{
    (void)state;
    const double a[3] = {0.1, 0.7, 1e6};
    const double b[3] = {1e5, 0.3, 1e6};
    const double c[3] = {0.2, 1e-9, 1e6};
    double p[3] = {-3e4, 77.0, 1e6};
    assert_int_equal(lrcsi_exact_side(a, b, c, p), 0);
    p[2] = nextafter(1e6, 2e6);
    assert_int_equal(lrcsi_exact_side(a, b, c, p), -1);
    p[2] = nextafter(1e6, 0.0);
    assert_int_equal(lrcsi_exact_side(a, b, c, p), 1);
}

static void equal_points_give_zero(void **state)
{
    (void)state;
    for (int i = 0; i < SIGN_CASES; i++) {
        const double *a = sign_cases[i].x;
        const double *b = a + 3;
        const double *c = a + 6;
        assert_int_equal(lrcsi_exact_side(a, b, c, a), 0);
        assert_int_equal(lrcsi_exact_side(a, b, c, b), 0);
        assert_int_equal(lrcsi_exact_side(a, b, c, c), 0);
        assert_int_equal(lrcsi_exact_side(a, b, b, c), 0);
        assert_int_equal(lrcsi_exact_side(a, a, b, c), 0);
        assert_int_equal(lrcsi_exact_orient(a, b, b, c), 0);
        assert_int_equal(lrcsi_exact_orient(a, a, b, c), 0);
        assert_int_equal(lrcsi_exact_orient(a, b, a, c), 0);
    }
}

static void turn_along_an_axis_is_the_planar_turn(void **state)
{
    (void)state;
    const double a[3] = {0.0, 0.0, 5.0};
    const double b[3] = {1.0, 0.0, -7.0};
    const double c[3] = {0.0, 1.0, 2.0};
    const double up[3] = {0.0, 0.0, 1.0};
    const double down[3] = {0.0, 0.0, -1.0};
    assert_int_equal(lrcsi_exact_orient(a, b, c, up), 1);
    assert_int_equal(lrcsi_exact_orient(a, b, c, down), -1);
    assert_int_equal(lrcsi_exact_side(a, b, c, a), 0);
}

static void collinear_means_exactly_on_one_line(void **state)
{
    (void)state;
    const double a[3] = {0.1, 0.2, 0.3};
    const double b[3] = {0.1 + 0x1p-30, 0.2 - 0x1p-29, 0.3 + 0x1p-28};
    double c[3];
    for (int k = 0; k < 3; k++) {
        c[k] = b[k] + (b[k] - a[k]);
    }
    assert_int_equal(lrcsi_exact_collinear(a, b, c), 1);
    assert_int_equal(lrcsi_exact_collinear(c, a, b), 1);
    assert_int_equal(lrcsi_exact_collinear(a, b, b), 1);
    assert_int_equal(lrcsi_exact_collinear(a, a, a), 1);
    for (int k = 0; k < 3; k++) {
        double d[3];
        memcpy(d, c, sizeof d);
        d[k] = nextafter(d[k], 10.0);
        assert_int_equal(lrcsi_exact_collinear(a, b, d), 0);
        assert_int_equal(lrcsi_exact_collinear(d, b, a), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs_agree_with_rational_arithmetic),
        cmocka_unit_test(values_agree_with_rational_arithmetic),
        cmocka_unit_test(swapping_two_points_negates),
        cmocka_unit_test(cyclic_shift_keeps_the_sign),
        cmocka_unit_test(mirroring_negates),
        cmocka_unit_test(powers_of_two_change_nothing),
        cmocka_unit_test(far_from_the_origin_agrees_with_integers),
        cmocka_unit_test(dot_keeps_its_digits_where_all_but_e_cancels),
        cmocka_unit_test(one_ulp_off_the_plane_is_seen),
        cmocka_unit_test(equal_points_give_zero),
        cmocka_unit_test(turn_along_an_axis_is_the_planar_turn),
        cmocka_unit_test(collinear_means_exactly_on_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
