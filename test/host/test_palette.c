/* SPDX-License-Identifier: MIT */
/* Colours of materials: all of them are told apart, on white, on dark and from grey. */
#include "host/chart/palette.h"
#include "host/picture/colouring.h"

#include "check.h"

#include <math.h>

/* The distance in CIE L*a*b*, of which 2.3 is just noticeable (G. Sharma, 2003); from the
   standard's formulas with XYZ in units of 100. */
static double difference(uint32_t a, uint32_t b)
{
    double lab[2][3];
    for (int i = 0; i < 2; i++) {
        double c[3];
        double xyz[3];
        for (int k = 0; k < 3; k++) {
            c[k] = ((i ? b : a) >> (16 - 8 * k) & 255u) / 255.0;
            c[k] = 100.0 * (c[k] > 0.04045 ? pow((c[k] + 0.055) / 1.055, 2.4) : c[k] / 12.92);
        }
        xyz[0] = (c[0] * 0.4124564 + c[1] * 0.3575761 + c[2] * 0.1804375) / 95.047;
        xyz[1] = (c[0] * 0.2126729 + c[1] * 0.7151522 + c[2] * 0.0721750) / 100.0;
        xyz[2] = (c[0] * 0.0193339 + c[1] * 0.1191920 + c[2] * 0.9503041) / 108.883;
        for (int k = 0; k < 3; k++) {
            xyz[k] = xyz[k] > 0.008856 ? pow(xyz[k], 1.0 / 3.0) : 7.787 * xyz[k] + 16.0 / 116.0;
        }
        lab[i][0] = 116.0 * xyz[1] - 16.0;
        lab[i][1] = 500.0 * (xyz[0] - xyz[1]);
        lab[i][2] = 200.0 * (xyz[1] - xyz[2]);
    }
    return sqrt(pow(lab[0][0] - lab[1][0], 2) + pow(lab[0][1] - lab[1][1], 2) +
                pow(lab[0][2] - lab[1][2], 2));
}

static double least_difference(uint32_t count)
{
    uint32_t colour[3 + LRCSI_COLOURING_MATERIALS] = {0xffffffu, 0x0d111cu, 0x787878u};
    double least = HUGE_VAL;
    lrcsi_palette_categorical(count, colour + 3);
    for (uint32_t i = 3; i < count + 3; i++) {
        for (uint32_t k = 0; k < i; k++) {
            least = fmin(least, difference(colour[i], colour[k]));
        }
    }
    return least;
}

static void colours_of_materials_are_distinct(void **state)
{
    (void)state;
    assert_true(least_difference(7) > 25.0);
    assert_true(least_difference(24) > 20.0);
    assert_true(least_difference(LRCSI_COLOURING_MATERIALS) > 10.0);
}

static void more_materials_do_not_change_the_colours_of_the_first(void **state)
{
    uint32_t few[5];
    uint32_t many[40];
    (void)state;
    lrcsi_palette_categorical(5, few);
    lrcsi_palette_categorical(40, many);
    assert_memory_equal(few, many, sizeof few);
    assert_int_equal(few[0], lrcsi_palette_named(1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_of_materials_are_distinct),
        cmocka_unit_test(more_materials_do_not_change_the_colours_of_the_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
