/* SPDX-License-Identifier: MIT */
/* The mask of a proximity band: masked facets have no fractions, and a mask that does not fit leaves
   nothing behind. What is masked is tested through runs (test/integrate/test_shadows.c). */
#include "visibility/proximity/masked_band.h"

#include "check.h"

#define FACETS 3

static double fraction[4][FACETS] = {
    {0.5, 0.25, 1}, {0.4, 0.2, 0.9}, {0.3, 0.125, 0.8}, {0.2, 0.1, 0.7}};
static const lrcs_scene scene = {.facet_count = FACETS};
static const lrcs_prepared prepared = {.scene = &scene};
static const lrcsi_view view = {.prepared = &prepared};
static lrcsi_classification classification = {.view = &view};
static const lrcsi_proximity_band whole = {.classification = &classification,
                                           .mismatch = fraction[0],
                                           .gain = fraction[1],
                                           .loss = fraction[2],
                                           .rows = fraction[3]};

static void masked_facets_have_no_fractions(void **state)
{
    (void)state;
    unsigned char memory[64];
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    lrcsi_masked_band band;
    assert_int_equal(lrcsi_masked_band_make(&whole, &work, &band), LRCS_OK);
    for (int masked = 0; masked < 2; masked++) {
        band.facet_hidden[1] = (unsigned char)masked;
        for (uint32_t f = 0; f < FACETS; f++) {
            const int is_seen = f != 1 || !masked;
            check_same(lrcsi_masked_mismatch(&band, f), is_seen * fraction[0][f]);
            check_same(lrcsi_masked_gain(&band, f), is_seen * fraction[1][f]);
            check_same(lrcsi_masked_loss(&band, f), is_seen * fraction[2][f]);
            check_same(lrcsi_masked_rows(&band, f), is_seen * fraction[3][f]);
        }
    }
}

static void without_memory_there_is_no_mask(void **state)
{
    (void)state;
    unsigned char memory[64];
    int served = 0;
    for (size_t size = 0; size <= sizeof memory; size++) {
        lrcs_work work = lrcs_work_make(memory, size);
        lrcsi_masked_band band = {.whole = NULL};
        int status = lrcsi_masked_band_make(&whole, &work, &band);
        assert_int_equal(status, served || status == LRCS_OK ? LRCS_OK : LRCS_E_MEMORY);
        served += status == LRCS_OK;
        assert_true((band.whole == &whole) == (status == LRCS_OK));
        assert_true((work.used > 0) == (status == LRCS_OK));
    }
    assert_true(served > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masked_facets_have_no_fractions),
        cmocka_unit_test(without_memory_there_is_no_mask),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
