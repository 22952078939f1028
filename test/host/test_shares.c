/* SPDX-License-Identifier: MIT */
/* What contributes to sigma: every facet belongs to one part and to one material, and the lists are
   in order. test/cli/test_shares.sh checks the numbers of rows against sums made elsewhere. */
#include <lrcs/shares.h>

#include <math.h>
#include <stdlib.h>

#include "check.h"

static lrcs_host_scene scene;
static lrcs_host_shares shares;
static lrcs_facet_record *records;
static lrcs_result result;
static lrcs_host_error error;

static int shares_begin(void **state)
{
    (void)state;
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_pose pose;
    int status = lrcs_host_scene_read("demo", &options, &scene, &error);
    records = status == LRCS_OK ? calloc(scene.scene.facet_count, sizeof *records) : NULL;
    if (!records || lrcs_host_scene_prepare(&scene, &error) != LRCS_OK ||
        lrcs_pose_from_azel(50, 40, &pose) != LRCS_OK ||
        lrcs_host_scene_run(&scene, &pose, &run, &result, records, NULL, NULL, &error) != LRCS_OK) {
        return -1;
    }
    return lrcs_host_shares_make(&scene, &scene.scene, records, result.sigma_m2, &shares, &error);
}

static int shares_end(void **state)
{
    (void)state;
    lrcs_host_shares_free(&shares);
    lrcs_host_scene_free(&scene);
    free(records);
    return 0;
}

/* Both lists divide the same facets: each sums to the whole. */
static void list_holds_every_facet(const lrcs_host_share *row, uint32_t count)
{
    double sum[3] = {0};
    uint32_t facets = 0;
    assert_true(count > 1);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(row[i].facets > 0);
        assert_true(i == 0 || row[i - 1].sigma_m2 >= row[i].sigma_m2);
        sum[0] += row[i].sigma_m2;
        sum[1] += row[i].glint_m2;
        sum[2] += row[i].diffuse_m2;
        facets += row[i].facets;
    }
    assert_int_equal(facets, scene.scene.facet_count);
    assert_true(fabs(sum[0] - result.sigma_m2) <= 1e-12 * result.sigma_m2);
    assert_true(fabs(sum[1] - result.sigma_glint_m2) <= 1e-12 * result.sigma_m2);
    assert_true(fabs(sum[2] - result.sigma_diffuse_m2) <= 1e-12 * result.sigma_m2);
}

static void parts_and_materials_sum_to_sigma(void **state)
{
    (void)state;
    list_holds_every_facet(shares.part, shares.parts);
    list_holds_every_facet(shares.material, shares.materials);
    assert_true(shares.sigma_m2 == result.sigma_m2);
}

static void the_facets_listed_are_the_brightest(void **state)
{
    (void)state;
    assert_int_equal(shares.facets, LRCS_HOST_SHARES_FACETS);
    for (uint32_t i = 0; i < shares.facets; i++) {
        const lrcs_host_share_facet *one = &shares.facet[i];
        uint32_t brighter = 0;
        for (uint32_t k = 0; k < scene.scene.facet_count; k++) {
            brighter += records[k].sigma_m2 > one->sigma_m2;
        }
        assert_true(brighter <= i);
        assert_true(one->sigma_m2 == records[one->facet].sigma_m2);
        assert_int_equal(one->scene_part, scene.scene.facet_part[one->facet]);
    }
}

static void without_contributions_no_facet_is_listed(void **state)
{
    (void)state;
    lrcs_host_shares none;
    lrcs_facet_record *dark = calloc(scene.scene.facet_count, sizeof *dark);
    assert_non_null(dark);
    assert_int_equal(lrcs_host_shares_make(&scene, &scene.scene, dark, 0.0, &none, &error),
                     LRCS_OK);
    assert_int_equal(none.facets, 0);
    assert_int_equal(none.parts, shares.parts);
    assert_true(none.part[0].sigma_m2 == 0.0);
    lrcs_host_shares_free(&none);
    assert_null(none.part);
    free(dark);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_and_materials_sum_to_sigma),
        cmocka_unit_test(the_facets_listed_are_the_brightest),
        cmocka_unit_test(without_contributions_no_facet_is_listed),
    };
    return cmocka_run_group_tests(tests, shares_begin, shares_end);
}
