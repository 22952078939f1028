/* SPDX-License-Identifier: MIT */
/* The blocks of a surface with triangles above it: every block lists what has a point in it, and most blocks do not
   list most facets. */
#include "visibility/cells/cells_block.h"

#include "integer_view.h"
#include "visibility/uniform/query.h"

static unsigned char answer[SCENE_FACETS];
static unsigned listed, items; /* how many items blocks list, of so many */
static unsigned points;        /* in the interior of a block */

/* The block that has a point of the view in its interior, or none: at its border. */
static size_t block_at(const lrcsi_block_grid *g, const double x[2])
{
    for (uint32_t by = 0; by < g->size; by++) {
        for (uint32_t bx = 0; bx < g->size; bx++) {
            lrcsi_clip_polygon square;
            double middle[2];
            double extent = lrcsi_block_grid_square(g, bx, by, &square, middle);
            int inside = 1;
            for (int k = 0; k < 2; k++) {
                double off = x[k] - middle[k];
                assert_true(fabs(square.corner[2][k]) <= extent);
                inside &= off > square.corner[0][k] + 1e-12 && off < square.corner[2][k] - 1e-12;
            }
            if (inside) {
                return (size_t)by * g->size + bx;
            }
        }
    }
    return SIZE_MAX;
}

static int block_lists(const lrcsi_block_lists *lists, size_t block, uint32_t item)
{
    for (uint32_t i = lists->first[block]; i < lists->first[block + 1]; i++) {
        if (lists->item[i] == item) {
            return 1;
        }
    }
    return 0;
}

/* Takes random points of an item with so many corners. */
static void check_item(const lrcsi_block_grid *g, const lrcsi_block_lists *lists, uint32_t item,
                       const uint32_t *corner, int corners, uint64_t *random)
{
    for (int n = 0; n < 8; n++) {
        double weight[3] = {random_unit(random), random_unit(random),
                            corners == 3 ? random_unit(random) : 0};
        double sum = weight[0] + weight[1] + weight[2];
        double x[2] = {0, 0};
        for (int i = 0; i < corners; i++) {
            for (int k = 0; k < 2; k++) {
                x[k] += weight[i] / sum * view.point[corner[i]].x[k];
            }
        }
        size_t block = block_at(g, x);
        assert_true(block == SIZE_MAX || block_lists(lists, block, item));
        points += block != SIZE_MAX;
    }
    for (size_t block = 0; block < (size_t)g->size * g->size; block++) {
        listed += (unsigned)block_lists(lists, block, item);
        items++;
    }
}

static void blocks_list_what_has_a_point_in_them(void **state)
{
    (void)state;
    uint64_t random = 20261202;
    unsigned left_out = 0;
    for (int n = 0; n < 20; n++) {
        scene_terrain(&random, 12, 24);
        look_along(integer_between(&random, -1, 1), integer_between(&random, -1, 1), 2);
        assert_int_equal(lrcsi_query_uniform(&classification, NULL, &work, &facets, answer),
                         LRCS_OK);
        lrcsi_block_grid g;
        assert_int_equal(
            lrcsi_block_grid_make(&classification, n % 2 == 0 ? NULL : answer, &work, &g), 1);
        assert_true(g.size > 3);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            int is_hidden = !classification.undecided[f] && answer[f] == LRCSI_QUERY_HIDDEN;
            if (casts_exactly(f) && (n % 2 == 0 || !is_hidden)) {
                check_item(&g, &g.facets, f, scene.facet[f].corner, 3, &random);
                continue;
            }
            for (size_t block = 0; block < (size_t)g.size * g.size; block++) {
                assert_false(block_lists(&g.facets, block, f));
            }
            left_out += casts_exactly(f) != 0;
        }
        for (uint32_t i = 0; i < classification.events.count; i++) {
            const lrcsi_edge *e = &view.prepared->topology.edge[classification.events.edge[i]];
            const uint32_t ends[2] = {e->low, e->high};
            check_item(&g, &g.events, i, ends, 2, &random);
        }
    }
    assert_true(points > 50000 && left_out > 50);
    assert_true(listed < 0.5 * items);
}

static void without_memory_there_are_no_blocks(void **state)
{
    (void)state;
    uint64_t random = 5;
    lrcsi_block_grid g;
    scene_tangle(&random, 20, 40);
    look_along(1, 2, 3);
    lrcs_work little = lrcs_work_make(answer, 64);
    assert_int_equal(lrcsi_block_grid_make(&classification, NULL, &little, &g), 0);
    assert_int_equal(little.used, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_list_what_has_a_point_in_them),
        cmocka_unit_test(without_memory_there_are_no_blocks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
