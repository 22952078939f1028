/* SPDX-License-Identifier: MIT */
/* The domain of the four parameters, its warnings, f_r from a cosine, and the material library. */
#include <lrcs/brdf.h>

#include <string.h>

#include "check.h"

static void numbers_outside_the_domain_are_refused(void **state)
{
    (void)state;
    static const lrcs_brdf bad[] = {
        {-1, 0, 0.2, 0},       {0, -1, 0.2, 0},     {1, 0, -0.2, 0},
        {1, 0, 0.2, -1},       {1, 0, 0, 0},        {HUGE_VAL, 0, 0.2, 0},
        {1, HUGE_VAL, 0.2, 0}, {1, 0, HUGE_VAL, 0}, {1, 0, 0.2, HUGE_VAL},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(lrcs_brdf_check(&bad[i]), LRCS_E_NUMBER);
    }
    lrcs_brdf nan_brdf = {1, nan(""), 0.2, 0.5};
    assert_int_equal(lrcs_brdf_check(&nan_brdf), LRCS_E_NUMBER);
}

static void warnings_name_what_the_model_does_not_mean(void **state)
{
    (void)state;
    static const struct {
        lrcs_brdf brdf;
        int bits;
    } cases[] = {
        {{1, 0.25, 0.2, 0.5}, 0},
        {{0, 0.25, 0, 0.5}, 0},
        {{0, 0.25, 0.8, 0.5}, 0},
        {{1e-3, 0.25, 0.71, 0.5}, LRCS_BRDF_SLOPE_LARGE},
        {{1e-3, 0.25, 0.7, 0.5}, 0},
        {{1, 0.3184, 0.2, 0.5}, LRCS_BRDF_DIFFUSE_GAIN},
        {{2, 0.1, 0.2, 0.5}, LRCS_BRDF_GLINT_GAIN},
        {{0, 0, 0.2, 0.5}, LRCS_BRDF_DARK},
        {{1, 1, 1, 0}, LRCS_BRDF_SLOPE_LARGE | LRCS_BRDF_DIFFUSE_GAIN | LRCS_BRDF_GLINT_GAIN},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(lrcs_brdf_check(&cases[i].brdf), cases[i].bits);
    }
    for (int bit = 1; bit <= LRCS_BRDF_DARK; bit <<= 1) {
        assert_true(strcmp(lrcs_brdf_warning_text(bit), lrcs_brdf_warning_text(0)) != 0);
    }
}

/* Values by mpmath, 50 digits, from the formula in the header at the double cosine. */
static void f_r_agrees_with_its_formula(void **state)
{
    (void)state;
    lrcs_brdf brdf = lrcs_brdf_default();
    check_rel(lrcs_brdf_eval(&brdf, 1.0), 1.25, 1e-15);
    check_rel(lrcs_brdf_eval(&brdf, 0.9375), 0.2890799976968470, 1e-14);
    check_rel(lrcs_brdf_eval(&brdf, 0.5), 0.1767766952966369, 1e-14);
    check_rel(lrcs_brdf_eval(&brdf, 0x1p-1000), 0.25 * 0x1p-500, 1e-15);
    check_rel(lrcs_brdf_eval(&(lrcs_brdf){0, 0.25, 0, 0.5}, 0.5), 0.1767766952966369, 1e-14);
    check_same(lrcs_brdf_eval(&brdf, 0.0), 0.0);
    check_same(lrcs_brdf_eval(&brdf, -1.0), 0.0);
    lrcs_brdf wide = {1.0, 0.0, 1e3, 0.0};
    check_rel(lrcs_brdf_eval(&wide, 0x1p-8), 263619968013539.27, 1e-14);
    check_same(lrcs_brdf_eval(&wide, 0x1p-1000), 0.0);
}

static void the_library_is_sane_and_found_by_name(void **state)
{
    (void)state;
    static const char *const names[] = {"solar-cell",    "mli-gold",           "mli-silver",
                                        "paint-white",   "paint-black",        "aluminium-bare",
                                        "ideal-diffuse", "aluminium-anodised", "ideal-glint"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const lrcs_brdf_entry *entry = lrcs_brdf_find(names[i]);
        assert_non_null(entry);
        assert_string_equal(entry->name, names[i]);
    }
    uint32_t count = 0;
    for (const lrcs_brdf_entry *e = lrcs_brdf_library(0); e; e = lrcs_brdf_library(++count)) {
        assert_ptr_equal(lrcs_brdf_find(e->name), e);
        assert_int_equal(lrcs_brdf_check(&e->brdf), 0);
        double received = 4.0 * 3.14159265358979 * e->brdf.A * e->brdf.s * e->brdf.s;
        check_most(received + 3.14159265358979 * e->brdf.B, 1.0);
    }
    assert_int_equal(count, 12);
    assert_null(lrcs_brdf_library(UINT32_MAX));
    assert_null(lrcs_brdf_find("Solar-Cell"));
}

/* Fortescue, Swinerd and Stark (eds), Spacecraft Systems Engineering, 4th ed. 2011, Table 11.3. */
static void materials_with_a_source_are_lambert_surfaces_of_its_reflectance(void **state)
{
    static const struct {
        const char *name;
        double absorptance, change;
    } table[] = {{"paint-white-silicone", 0.26, 0.03},
                 {"paint-white-silicate", 0.12, 0.02},
                 {"paint-black-epoxy", 0.95, 0.01}};
    uint32_t sourced = 0;
    (void)state;
    for (uint32_t i = 0; i < 3; i++) {
        const lrcs_brdf_entry *e = lrcs_brdf_find(table[i].name);
        assert_non_null(e);
        assert_non_null(e->source);
        check_rel(e->brdf.B * 3.14159265358979323846, 1.0 - table[i].absorptance, 1e-15);
        check_rel(e->error.B * 3.14159265358979323846, table[i].change, 1e-15);
        assert_true(e->brdf.A == 0.0 && e->brdf.m == 0.0);
        assert_int_equal(lrcs_brdf_error_check(&e->brdf, &e->error), LRCS_OK);
    }
    for (uint32_t i = 0; lrcs_brdf_library(i); i++) {
        const lrcs_brdf_entry *e = lrcs_brdf_library(i);
        assert_int_equal(e->error.B > 0.0, e->source != NULL);
        assert_true(e->error.A == 0.0 && e->error.s == 0.0 && e->error.m == 0.0);
        sourced += e->source != NULL;
    }
    assert_int_equal(sourced, 3);
}

static void errors_of_a_material_are_checked(void **state)
{
    (void)state;
    static const lrcs_brdf brdf = {1, 0.25, 0.2, 0.5};
    static const lrcs_brdf matt = {0, 0.25, 0, 0.5};
    static const struct {
        lrcs_brdf_error error;
        int status;
    } of[] = {
        {{0.1, 0.1, 0.1, 0.1, {0.5, -0.5, 0, 0, 0.5, 0}}, LRCS_OK},
        {{0.1, 0.1, 0.1, 0.1, {1, 0, 0, 0, 0, 0}}, LRCS_OK},         /* a pivot of 0, its row too */
        {{0.1, 0.1, 0.1, 0.1, {1, 0.5, 0, 0, 0, 0}}, LRCS_E_NUMBER}, /* but not its row */
        {{0.1, 0.1, 0.1, 0.1, {0.9, -0.9, 0, 0.9, 0, 0}}, LRCS_E_NUMBER}, /* a negative pivot */
        {{0.1, 0.1, 0.1, 0.1, {1.5, 0, 0, 0, 0, 0}}, LRCS_E_NUMBER},
        {{0.1, 0.1, 0.1, 0.1, {NAN, 0, 0, 0, 0, 0}}, LRCS_E_NUMBER},
        {{-0.1, 0, 0, 0, {0}}, LRCS_E_NUMBER},
        {{0, 0, 0, INFINITY, {0}}, LRCS_E_NUMBER},
    };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        assert_int_equal(lrcs_brdf_error_check(&brdf, &of[i].error), of[i].status);
    }
    /* a material without a slope has no glint of which A or s could be uncertain */
    const lrcs_brdf_error of_matt[] = {{.B = 0.1}, {.A = 0.1}, {.s = 0.1}};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(lrcs_brdf_error_check(&matt, &of_matt[i]),
                         i == 0 ? LRCS_OK : LRCS_E_ARGUMENT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_of_a_material_are_checked),
        cmocka_unit_test(numbers_outside_the_domain_are_refused),
        cmocka_unit_test(warnings_name_what_the_model_does_not_mean),
        cmocka_unit_test(f_r_agrees_with_its_formula),
        cmocka_unit_test(the_library_is_sane_and_found_by_name),
        cmocka_unit_test(materials_with_a_source_are_lambert_surfaces_of_its_reflectance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
