/* SPDX-License-Identifier: MIT */
/* Blocks of a mesh in the work area. */
#include "mesh/store.h"

#include <lrcs/read.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

static void the_need_serves_at_any_alignment_and_the_blocks_are_cleared(void **state)
{
    (void)state;
    const lrcs_mesh_counts counts = {7, 5, 3, 2, 11, 6};
    size_t need = lrcs_mesh_need(&counts);
    for (size_t shift = 0; shift < LRCS_WORK_ALIGN; shift++) {
        unsigned char *area = malloc(need + shift);
        assert_non_null(area);
        memset(area, 0xa5, need + shift);
        lrcs_work work = lrcs_work_make(area + shift, need);
        lrcs_mesh mesh;
        char *text;
        assert_int_equal(lrcsi_store_take(&counts, &work, &mesh, &text), LRCS_OK);
        memset(text, 'x', counts.text_bytes);
        for (uint32_t i = 0; i < counts.facets; i++) {
            assert_int_equal(mesh.facet_material[i], LRCS_NONE);
            assert_int_equal(mesh.facet_part[i] | mesh.facet_smooth[i], 0);
            assert_int_equal(mesh.facet_normal[i].corner[2], LRCS_NONE);
        }
        assert_int_equal(mesh.notices, 0);
        assert_null(mesh.material_file);
        assert_ptr_equal(work.bytes + work.used, mesh.vertex + counts.vertices);
        free(area);
    }
}

static void counts_beyond_memory_need_more_than_there_is(void **state)
{
    (void)state;
    const lrcs_mesh_counts counts = {LRCS_NONE - 1, LRCS_NONE - 1, LRCS_NONE - 1,
                                     LRCS_NONE - 1, SIZE_MAX,      LRCS_NONE - 1};
    assert_int_equal(lrcs_mesh_need(&counts), SIZE_MAX);
    unsigned char area[256];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_mesh mesh;
    char *text;
    assert_int_equal(lrcsi_store_take(&counts, &work, &mesh, &text), LRCS_E_MEMORY);
    assert_int_equal(work.used, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_need_serves_at_any_alignment_and_the_blocks_are_cleared),
        cmocka_unit_test(counts_beyond_memory_need_more_than_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
