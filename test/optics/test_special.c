/* SPDX-License-Identifier: MIT */
/* The special functions against mpmath at 60 digits: exp(x^2) erfc(x), and
   sqrt(pi) Gamma((nu+1)/2) / Gamma((nu+2)/2) by loggamma (their first asymptotic terms beyond 1e3
   and 1e9); and at 30 digits the root of Student's distribution by betainc. */
#include "optics/special.h"

#include "check.h"

static void erfcx_is_within_its_claim(void **state)
{
    (void)state;
    static const double vectors[][2] = {
        {0, 1.0},
        {1e-300, 1.0},
        {0.001, 0.9988726200811514},
        {0.5, 0.6156903441929259},
        {1.0, 0.427583576155807},
        {1.9999999, 0.25539568699015236},
        {2.0, 0.25539567631050575},
        {2.5, 0.2108063640611436},
        {3.0, 0.17900115118138996},
        {5.0, 0.11070463773306863},
        {10.0, 0.05614099274382259},
        {26.5, 0.021275046685371106},
        {27.0, 0.02088160799042094},
        {100.0, 0.005641613782989433},
        {100000000.0, 5.641895835477562e-09},
        {1e+300, 5.641895835477562e-301},
    };
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        check_rel(lrcsi_special_erfcx(vectors[i][0]), vectors[i][1], 12 * 0x1p-53);
    }
    check_same(lrcsi_special_erfcx(HUGE_VAL), 0.0);
}

static void erfcx_is_continuous_where_its_branches_meet(void **state)
{
    (void)state;
    double below = lrcsi_special_erfcx(nextafter(2.0, 0.0));
    check_rel(below, lrcsi_special_erfcx(2.0), 16 * 0x1p-53);
}

static void cosine_power_is_within_its_claim(void **state)
{
    (void)state;
    static const double vectors[][2] = {
        {0.0, 3.141592653589793},
        {0.5, 2.3962804694711846},
        {1.0, 2.0},
        {2.0, 1.5707963267948966},
        {2.5, 1.4377682816827106},
        {3.0, 1.3333333333333333},
        {7.25, 0.8994804264059377},
        {20.0, 0.5535393641535147},
        {23.4999, 0.5116089633739985},
        {23.5, 0.5116078979824938},
        {24.0, 0.506362713799522},
        {100.0, 0.2500369634803749},
        {102.5, 0.2469839678902688},
        {10000.0, 0.02506565609707554},
        {10002.0, 0.025063150032678713},
        {1000000.0, 0.0025066276479740104},
        {1000000000000.0, 2.506628274630374e-06},
        {1e+300, 2.5066282746310003e-150},
    };
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        check_rel(lrcsi_special_cosine_power(vectors[i][0]), vectors[i][1], 48 * 0x1p-53);
    }
}

static void student_is_within_its_claim(void **state)
{
    (void)state;
    static const struct {
        uint32_t freedom;
        double t;
    } vectors[] = {
        {1, 12.7062047361747046},    {2, 4.30265272974946385},         {3, 3.18244630528370959},
        {4, 2.77644510519779436},    {5, 2.57058183563631551},         {8, 2.30600413520416668},
        {9, 2.26215716279820502},    {10, 2.22813885198627475},        {20, 2.08596344726586484},
        {1000, 1.96233908082640848}, {UINT32_MAX, 1.95996398454005424}};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        check_rel(lrcsi_special_student(vectors[i].freedom), vectors[i].t, 1e-5);
    }
    check_rel(lrcsi_special_student(UINT32_MAX), 1.95996398454005424, 1e-9);
    check_same(lrcsi_special_student(0), HUGE_VAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(erfcx_is_within_its_claim),
        cmocka_unit_test(erfcx_is_continuous_where_its_branches_meet),
        cmocka_unit_test(cosine_power_is_within_its_claim),
        cmocka_unit_test(student_is_within_its_claim),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
