/* SPDX-License-Identifier: MIT */
/* Grids list what stands in a bucket, and never more than they have asked memory for: whatever the
   size of the facets, in every number of bytes. */
#include "visibility/index/grid.h"

#include "recipe.h"
#include "visibility/stacked.h"
#include "visibility/uniform/classify.h"

static unsigned char little[1u << 20];

/* Surface components of 2 n^2 facets that share their corners, one above the other. */
static void components(uint32_t count, uint32_t n)
{
    scene_start(&scene);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t first = scene.scene.vertex_count;
        for (uint32_t i = 0; i < (n + 1) * (n + 1); i++) {
            scene_vertex(&scene, i % (n + 1) + 0x1p-6 * k, i / (n + 1) + 0x1p-7 * k, 0x1p-4 * k);
        }
        for (uint32_t i = 0; i < n * n; i++) {
            uint32_t v = first + i / n * (n + 1) + i % n;
            scene_facet(&scene, v, v + 1, v + n + 2);
            scene_facet(&scene, v, v + n + 2, v + n + 1);
        }
    }
}

/* The view from nearly above. */
static lrcsi_view view_of_scene(lrcs_work *work)
{
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *prepared = scene_prepare(&scene, work);
    const double direction[3] = {0.25, 0.125, 4};
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, work, &view), LRCS_OK);
    return view;
}

static uint32_t listed(const lrcsi_grid *grid)
{
    return grid->first[(size_t)grid->size * grid->size];
}

/* In the bucket of a place in the view, counted by hand. */
static int lists(const lrcsi_grid *grid, const double at[2], uint32_t item)
{
    uint32_t in[2];
    for (int k = 0; k < 2; k++) {
        double bucket =
            ((float)(at[k] * grid->view->scale) - grid->low[k]) * grid->buckets_per_unit;
        in[k] = (uint32_t)fmin(fmax(bucket, 0), grid->size - 1);
    }
    uint32_t bucket = in[1] * grid->size + in[0];
    for (uint32_t i = grid->first[bucket]; i < grid->first[bucket + 1]; i++) {
        if (grid->item[i] == item) {
            return 1;
        }
    }
    return 0;
}

/* A place on some vertices, in the view. */
static void place_on(const lrcsi_view *view, const uint32_t *vertex, int count, double at[2])
{
    double sum = 0;
    at[0] = at[1] = 0;
    for (int i = 0; i < count; i++) {
        double weight = 1 + random_to(64);
        sum += weight;
        for (int k = 0; k < 2; k++) {
            at[k] += weight * view->point[vertex[i]].x[k];
        }
    }
    at[0] /= sum;
    at[1] /= sum;
}

/* Every facet that can hide others, and every event edge, is listed wherever it is, every facet's box is that of its corners, and
   no list is longer than was asked for. Returns the grid's buckets along a side. */
static uint32_t check_grids_of(const lrcsi_view *of, lrcs_work *work)
{
    const lrcsi_view view = *of;
    lrcsi_classification classification;
    lrcsi_grid facets;
    assert_int_equal(lrcsi_classify_make(&view, NULL, work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_grid_facets(&classification.search.grid, &classification.search.boxes,
                                       NULL, work, &facets),
                     LRCS_OK);
    const lrcs_prepared *p = view.prepared;
    assert_true(listed(&facets) <= LRCSI_GRID_FACET_BUCKETS * p->scene->facet_count);
    assert_true(listed(&classification.search.grid) <= 8 * p->topology.edge_count);
    double at[2];
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        lrcsi_view_box box = lrcsi_view_box_of(&view, p->scene->facet[f].corner, 3);
        if (!lrcsi_view_casts(&view, f)) {
            continue;
        }
        assert_memory_equal(&box, lrcsi_boxes_facet(&facets.boxes, f), sizeof box);
        for (int i = 0; i < 20; i++) {
            place_on(&view, p->scene->facet[f].corner, 3, at);
            assert_true(lists(&facets, at, f));
        }
    }
    for (uint32_t i = 0; i < classification.events.count; i++) {
        const lrcsi_edge *edge = &p->topology.edge[classification.events.edge[i]];
        for (int k = 0; k < 20; k++) {
            place_on(&view, (const uint32_t[2]){edge->low, edge->high}, 2, at);
            assert_true(lists(&classification.search.grid, at, i));
        }
    }
    return facets.size;
}

static uint32_t check_grids(void)
{
    lrcs_work work;
    const lrcsi_view view = view_of_scene(&work);
    return check_grids_of(&view, &work);
}

static void what_stands_in_a_bucket_is_listed_there_and_not_too_often(void **state)
{
    (void)state;
    for (uint32_t count = 1; count <= 512; count *= 2) {
        stacked_triangles(count);
        assert_true(check_grids() <= 4); /* or each would be listed more than 16 times */
    }
    for (uint32_t count = 1; count <= 64; count *= 2) {
        components(count, 4);
        assert_true(check_grids() <= 16); /* where it would be 45 */
    }
}

/* The facets of a finely divided cylinder are long and narrow. Seen aslant, each is listed only in
   the buckets along it: if it were in all those of its box, the grid would have 6 along a side. */
static void long_facets_are_listed_along_them(void **state)
{
    (void)state;
    lrcs_recipe_part part = {.name = "tube", .place = lrcs_place_default(), .material_index = -1};
    part.shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 2};
    const double aslant[3][3] = {{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}};
    memcpy(part.place.rotate, aslant, sizeof part.place.rotate);
    const lrcs_recipe recipe = {.part = &part, .part_count = 1};
    const lrcs_build_options build = {1e-7, 1u << 16, LRCS_NORMALS_FLAT, LRCS_FACETS_LOCAL,
                                      0,    NULL};
    lrcs_scene tube;
    lrcs_work work;
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *prepared = recipe_prepare(&recipe, NULL, &build, &tube, &work);
    assert_true(tube.facet_count >= 32768);
    const double direction[3] = {4, 0.5, 0.25};
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_true(check_grids_of(&view, &work) >= 16);
}

static void buckets_of_small_facets_are_as_many_as_those(void **state)
{
    (void)state;
    components(1, 32);
    assert_int_equal(check_grids(), 45); /* the root of 2048 */
    components(2, 32);
    assert_int_equal(check_grids(), 64);
}

/* Large triangles in many buckets, whose edges alone make them fewer. */
static void edges_are_listed_no_more_often_than_asked_for(void **state)
{
    (void)state;
    lrcs_work work;
    stacked_triangles(40);
    lrcsi_view view = view_of_scene(&work);
    const lrcs_prepared *p = view.prepared;
    uint32_t edge[120];
    for (uint32_t i = 0; i < 120; i++) {
        edge[i] = 119 - i;
    }
    uint32_t before = 0;
    for (uint64_t most = 100; most <= 12800; most *= 2) {
        size_t mark = work.used;
        lrcsi_grid grid = lrcsi_grid_empty(&view, 64 * 64);
        assert_int_equal(lrcsi_grid_edges(edge, 120, most, &work, &grid), LRCS_OK);
        assert_true(listed(&grid) <= (most < 120 ? 120 : most));
        assert_true(grid.size >= before && (grid.size > 1) == (most > 200));
        before = grid.size;
        for (uint32_t i = 0; i < 120; i++) {
            const lrcsi_edge *e = &p->topology.edge[edge[i]];
            double at[2];
            place_on(&view, (const uint32_t[2]){e->low, e->high}, 2, at);
            assert_true(lists(&grid, at, i));
        }
        work.used = mark;
    }
    assert_int_equal(before, 64);
}

/* Facets in so many buckets make a grid coarser, until they are in 16 each on average. */
static void grids_are_made_coarser_for_large_facets(void **state)
{
    (void)state;
    lrcs_work work;
    stacked_triangles(40);
    lrcsi_view view = view_of_scene(&work);
    lrcsi_boxes boxes;
    assert_int_equal(lrcsi_boxes_make(&view, &work, &boxes), LRCS_OK);
    lrcsi_grid grid = lrcsi_grid_empty(&view, 64 * 64);
    assert_int_equal(lrcsi_grid_fit(&grid, &boxes), 0);
    assert_int_equal(grid.size, 64); /* no facet's box is made */
    for (uint32_t r = 0; r < view.prepared->meshlets.count; r++) {
        lrcsi_boxes_open(&boxes, r);
    }
    assert_int_equal(lrcsi_grid_fit(&grid, &boxes), 1);
    assert_int_equal(lrcsi_grid_fit(&grid, &boxes), 0);
    uint32_t buckets = 0;
    for (uint32_t f = 0; f < 40; f++) {
        lrcsi_grid_walk walk;
        lrcsi_grid_row row;
        lrcsi_grid_walk_facet(&grid, lrcsi_boxes_facet(&boxes, f), f, &walk);
        while (lrcsi_grid_walk_next(&walk, &row)) {
            buckets += row.x1 - row.x0;
        }
    }
    assert_true(grid.size < 64 && buckets <= 1.5 * LRCSI_GRID_FACET_BUCKETS * 40); /* about */
}

/* In so many bytes, and unharmed where they are too few. */
static int facets_in(lrcsi_classification *classification, const lrcsi_grid_readers *readers,
                     size_t size)
{
    lrcsi_grid grid;
    lrcs_work work = lrcs_work_make(little, size);
    int status = lrcsi_grid_facets(&classification->search.grid, &classification->search.boxes,
                                   readers, &work, &grid);
    assert_int_equal(status, work.peak <= size ? LRCS_OK : LRCS_E_MEMORY);
    assert_true(status == LRCS_OK || work.used == 0);
    return status;
}

static void grids_of_facets_fit_into_what_they_ask_for(void **state)
{
    (void)state;
    static unsigned char all[512];
    static uint32_t region[512];
    static signed char none[512 + LRCSI_MESHLET_FACETS];
    const lrcsi_facet_signs joinable = {none, none};
    memset(all, 1, sizeof all);
    const lrcsi_grid_readers readers = {all, region, &joinable};
    for (uint32_t count = 1; count <= 512; count = 3 * count / 2 + 1) {
        lrcs_work work;
        stacked_triangles(count);
        lrcsi_view view = view_of_scene(&work);
        lrcsi_classification classification;
        assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
        size_t need = lrcsi_grid_facets_need(view.prepared);
        size_t fits = 0;
        while (facets_in(&classification, &readers, fits) != LRCS_OK) {
            fits += count < 20 ? 1 : 97;
        }
        assert_true(fits <= need);
        assert_int_equal(facets_in(&classification, &readers, need), LRCS_OK);
        assert_int_equal(facets_in(&classification, NULL, need), LRCS_OK);
    }
}

static void classifications_fit_into_what_they_ask_for(void **state)
{
    (void)state;
    for (uint32_t count = 1; count <= 512; count = 3 * count / 2 + 1) {
        lrcs_work work;
        stacked_triangles(count);
        lrcsi_view view = view_of_scene(&work);
        size_t need = lrcsi_classify_need(view.prepared);
        int before = LRCS_E_MEMORY;
        for (size_t size = 0; size <= need; size += count < 10 ? 1 : need / 50) {
            lrcsi_classification classification;
            lrcs_work few = lrcs_work_make(little, size);
            int status = lrcsi_classify_make(&view, NULL, &few, &classification);
            assert_int_equal(status, few.peak <= size ? LRCS_OK : LRCS_E_MEMORY);
            assert_true(status == LRCS_OK ? few.used != 0 : before != LRCS_OK && few.used == 0);
            before = status;
        }
        assert_int_equal(before, LRCS_OK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stands_in_a_bucket_is_listed_there_and_not_too_often),
        cmocka_unit_test(long_facets_are_listed_along_them),
        cmocka_unit_test(buckets_of_small_facets_are_as_many_as_those),
        cmocka_unit_test(edges_are_listed_no_more_often_than_asked_for),
        cmocka_unit_test(grids_are_made_coarser_for_large_facets),
        cmocka_unit_test(grids_of_facets_fit_into_what_they_ask_for),
        cmocka_unit_test(classifications_fit_into_what_they_ask_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
