/* SPDX-License-Identifier: MIT */
/* Samples in cells, the surfaces that cover cells, and what is removed behind them: against all
   facets at random points of the cells, in plain doubles. */
#include "visibility/cells/cells_cover.h"

#include "integer_view.h"
#include "visibility/cells/cells_cut.h"

#define FACETS   1024u
#define RECORDS  (FACETS + 1)
#define SEGMENTS 8192u
#define LISTS    (1u << 18)
/* Points nearer to the border of a facet than this are not compared. */
#define BORDER 1e-9

static lrcsi_blocks blocks;
static lrcsi_cells_sample sample;
static lrcsi_cells_surface surface;
/* By the numbers of facets: */
static unsigned char coplanar[FACETS], finding[FACETS], wanted[FACETS];
static lrcsi_cell_area area[FACETS];
static uint32_t record[FACETS];
/* By the numbers of records: */
static uint32_t listed[RECORDS], covers[RECORDS], hit[RECORDS];
static uint32_t surface_facet[RECORDS], foreground[RECORDS], adjoining[RECORDS];
static unsigned char record_finding[RECORDS], record_wanted[RECORDS];
static lrcsi_cells_facet facet[RECORDS];
static lrcsi_cell_area record_area[RECORDS];
static lrcsi_cell_border border[LRCSI_SURFACE_BORDERS];
static lrcsi_cells_segment segment[SEGMENTS];
static lrcsi_cell stack[LRCSI_CELL_STACK];
static unsigned char made[SCENE_VERTICES];
static lrcsi_cells_point point[SCENE_VERTICES];
static uint32_t facet_lists[LISTS], segment_lists[LISTS];

static void blocks_make(void)
{
    memset(area, 0, sizeof area);
    memset(finding, 0, sizeof finding);
    memset(record, 0, sizeof record);
    memset(wanted, 1, sizeof wanted);
    memset(made, 0, sizeof made);
    memset(listed, 0, sizeof listed);
    memset(covers, 0, sizeof covers);
    memset(foreground, 0, sizeof foreground);
    memset(adjoining, 0, sizeof adjoining);
    assert_true(scene.scene.facet_count <= FACETS);
    sample = (lrcsi_cells_sample){.hit = hit, .covers = covers, .listed.entry = listed};
    surface = (lrcsi_cells_surface){.facet = surface_facet,
                                    .border = border,
                                    .foreground.entry = foreground,
                                    .adjoining.entry = adjoining};
    blocks = (lrcsi_blocks){.frame = {.view = &view, .made = made, .point = point},
                            .coplanar = coplanar,
                            .wanted = wanted,
                            .area = area,
                            .finding = finding,
                            .record_finding = record_finding,
                            .division = {.view = &view,
                                         .facet = facet,
                                         .record = record,
                                         .record_room = RECORDS,
                                         .segment = segment,
                                         .segment_room = SEGMENTS,
                                         .wanted = record_wanted,
                                         .area = record_area,
                                         .stack = stack,
                                         .facet_lists = facet_lists,
                                         .segment_lists = segment_lists,
                                         .facet_lists_room = LISTS,
                                         .segment_lists_room = LISTS}};
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        coplanar[f] = lrcsi_view_casts(&view, f) && lrcsi_cells_has_coplanar(&view, f);
    }
    assert_int_equal(lrcsi_block_grid_make(&classification, NULL, &work, &blocks.grid), 1);
    lrcsi_cells_frame_make(&blocks.frame);
}

/* Where a point of the block is relative to a facet: 1 inside, 0 at its border, -1 outside. If
   inside, *z is its height there. From the vertices of the view, not from the block's records. */
static int place_in_facet(uint32_t f, const double at[2], double *z)
{
    double turn[3];
    double sum = 0;
    double least = HUGE_VAL;
    const double *x[3];
    for (int k = 0; k < 3; k++) {
        x[k] = view.point[scene.facet[f].corner[k]].x;
    }
    const double p[2] = {at[0] + blocks.frame.middle[0], at[1] + blocks.frame.middle[1]};
    for (int k = 0; k < 3; k++) {
        const double *a = x[(k + 1) % 3];
        const double *b = x[(k + 2) % 3];
        turn[k] =
            ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) * facing_exactly(f);
        sum += turn[k];
        least = fmin(least, turn[k]);
    }
    *z = (turn[0] * x[0][2] + turn[1] * x[1][2] + turn[2] * x[2][2]) / sum;
    return least > BORDER * BORDER && least > BORDER * sum ? 1 : least < -BORDER * sum ? -1 : 0;
}

/* The facet nearest to the laser at a point; LRCS_NONE if there is none; at a border, a number that
   no facet has. */
#define AT_BORDER (LRCS_NONE - 1)
static uint32_t nearest_at(const double at[2])
{
    uint32_t nearest = LRCS_NONE;
    double height = -HUGE_VAL;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        double z;
        if (!casts_exactly(f)) {
            continue;
        }
        int place = place_in_facet(f, at, &z);
        if (place == 0) {
            return AT_BORDER;
        }
        if (place > 0 && z > height) {
            height = z;
            nearest = f;
        }
    }
    return nearest;
}

/* A point of a cell: the mean of its corners with random weights. */
static void point_in(const lrcsi_clip_polygon *shape, uint64_t *random, double at[2])
{
    double sum = 0;
    at[0] = at[1] = 0;
    for (uint32_t i = 0; i < shape->count; i++) {
        double weight = random_unit(random);
        at[0] += weight * shape->corner[i][0];
        at[1] += weight * shape->corner[i][1];
        sum += weight;
    }
    at[0] /= sum;
    at[1] /= sum;
}

static int in_surface(uint32_t number)
{
    for (uint32_t i = 0; i < surface.facet_count; i++) {
        if (surface.facet[i] == number) {
            return 1;
        }
    }
    return 0;
}

static int in_cell(const lrcsi_cell *cell, uint32_t number)
{
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        if (cell->facet[i] == number) {
            return 1;
        }
    }
    return 0;
}

/* What was compared how often. */
static unsigned samples_found, samples_empty, kept_samples, covered, occluded, culled, culled_edges;

static void check_sample(void)
{
    uint32_t nearest = nearest_at(sample.at);
    if (nearest != AT_BORDER && sample.outcome != LRCSI_SAMPLE_UNSURE) {
        assert_int_equal(sample.outcome,
                         nearest == LRCS_NONE ? LRCSI_SAMPLE_EMPTY : LRCSI_SAMPLE_FOUND);
        samples_empty += nearest == LRCS_NONE;
        samples_found += nearest != LRCS_NONE;
    }
    if (nearest < AT_BORDER && sample.outcome == LRCSI_SAMPLE_FOUND) {
        assert_int_equal(facet[sample.nearest].facet, nearest);
    }
}

/* Every point of the cell is covered by exactly one facet of the surface. */
static void check_cover(const lrcsi_cell *cell, uint64_t *random)
{
    for (int n = 0; n < 10; n++) {
        double at[2];
        double z;
        int count = 0;
        point_in(&cell->shape, random, at);
        for (uint32_t i = 0; i < surface.facet_count; i++) {
            int place = place_in_facet(facet[surface.facet[i]].facet, at, &z);
            count += place == 0 ? 100 : place > 0;
        }
        assert_true(count == 1 || count >= 100);
    }
}

/* What is removed is hidden at every point of the cell that it covers. */
static void check_cull(const lrcsi_cell *before, const lrcsi_cell *after, uint64_t *random)
{
    for (uint32_t k = 0; k < before->facet_count; k++) {
        uint32_t i = before->facet[k];
        if (in_cell(after, i)) {
            continue;
        }
        assert_false(in_surface(i));
        assert_false(lrcsi_marked(&sample.listed, i));
        for (int n = 0; n < 10; n++) {
            double at[2];
            point_in(&after->shape, random, at);
            assert_int_not_equal(nearest_at(at), facet[i].facet);
        }
        culled++;
    }
}

/* Points of an edge that is removed are nowhere in the cell nearer than the surface. */
static void check_culled_edges(const lrcsi_cell *before, const lrcsi_cell *after, uint64_t *random)
{
    for (uint32_t i = 0; i < before->segment_count; i++) {
        const lrcsi_cells_segment *e = &segment[before->segment[i]];
        int is_left = 0;
        for (uint32_t k = 0; k < after->segment_count; k++) {
            is_left |= after->segment[k] == before->segment[i];
        }
        for (int n = 0; n < 10 && !is_left && !e->contact; n++) {
            double at[3];
            double t = random_unit(random);
            double inside = HUGE_VAL;
            for (int k = 0; k < 3; k++) {
                at[k] = e->end[0][k] + t * (e->end[1][k] - e->end[0][k]);
            }
            for (uint32_t k = 0; k < after->shape.count; k++) {
                const double *p = after->shape.corner[k];
                const double *q = after->shape.corner[(k + 1) % after->shape.count];
                inside =
                    fmin(inside, (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]));
            }
            for (uint32_t k = 0; k < surface.facet_count && inside > BORDER; k++) {
                double z;
                if (place_in_facet(facet[surface.facet[k]].facet, at, &z) > 0) {
                    check_most(at[2], z + BORDER);
                    culled_edges++;
                }
            }
        }
    }
}

/* Takes a sample in a cell, or keeps that of the cell before; *s: the sides of the cell. Returns 1
   if it is kept, with the surface. */
static int take_sample(lrcsi_cell *cell, lrcsi_clip_sides *s)
{
    lrcsi_division *d = &blocks.division;
    lrcsi_clip_sides_make(&cell->shape, lrcsi_division_tolerance(d, cell), s);
    lrcsi_cells_filter_segments(d, cell, s);
    if (cell->keeps_sample && lrcsi_cells_sample_keep(d, cell, s, &sample)) {
        lrcsi_cells_surface_keep(d, cell, &surface);
        return 1;
    }
    lrcsi_cells_sample_clear(&sample, RECORDS);
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        listed[cell->facet[i]] = sample.listed.number;
    }
    lrcsi_cells_sample_take(d, cell, s, &sample);
    return 0;
}

/* Takes a sample in a cell, finds what covers it, removes what is behind; and cuts it along its
   first segment. */
static void process(lrcsi_cell *cell, uint64_t *random)
{
    static uint32_t facets_before[FACETS];
    static uint32_t segments_before[SEGMENTS];
    lrcsi_division *d = &blocks.division;
    lrcsi_clip_sides s;
    int kept = take_sample(cell, &s);
    int component_covers = 0;
    check_sample();
    kept_samples += kept != 0;
    if (sample.outcome == LRCSI_SAMPLE_FOUND) {
        int covers_cell =
            kept ||
            lrcsi_cells_surface_find(d, cell, &s, &sample, LRCSI_SURFACE_LISTED, &surface) ||
            lrcsi_cells_surface_find(d, cell, &s, &sample, LRCSI_SURFACE_IN_CELL, &surface);
        component_covers = covers_cell;
        covered += covers_cell != 0;
        if (!covers_cell && lrcsi_cells_surface_occluder(d, cell, &s, &sample, &surface)) {
            covers_cell = 1;
            occluded++;
        }
        if (covers_cell) {
            lrcsi_cell before = *cell;
            memcpy(facets_before, cell->facet, cell->facet_count * sizeof *cell->facet);
            memcpy(segments_before, cell->segment, cell->segment_count * sizeof *cell->segment);
            before.facet = facets_before;
            before.segment = segments_before;
            check_cover(cell, random);
            lrcsi_cells_cull(&blocks, cell, &s, &surface, 0, &sample);
            check_cull(&before, cell, random);
            check_culled_edges(&before, cell, random);
        }
    }
    if (cell->segment_count > 0) {
        lrcsi_cells_divide(d, cell, &s,
                           &segment[cell->segment[random_below(random, cell->segment_count)]],
                           component_covers ? sample.at : NULL);
    }
}

/* Puts the first cell of a block on the stack. */
static void begin_block(uint32_t block)
{
    const uint32_t size = blocks.grid.size;
    lrcsi_cell cell = {.cuts = 0};
    blocks.division.extent = lrcsi_block_grid_square(&blocks.grid, block % size, block / size,
                                                     &cell.shape, blocks.frame.middle);
    blocks.frame.block = block + 1;
    assert_int_equal(lrcsi_blocks_begin(&blocks, block, &cell), 1);
}

static void check_scene(uint64_t *random)
{
    blocks_make();
    uint32_t size = blocks.grid.size;
    for (uint32_t block = 0; block < size * size; block++) {
        begin_block(block);
        for (int n = 0; n < 30 && blocks.division.stack_count > 0; n++) {
            lrcsi_cell cell = stack[--blocks.division.stack_count];
            process(&cell, random);
        }
        blocks.division.stack_count = 0;
        lrcsi_blocks_end(&blocks, block);
    }
}

static void cells_agree_with_all_facets(void **state)
{
    (void)state;
    uint64_t random = 20261203;
    for (int n = 0; n < 72; n++) {
        if (n % 2 == 0) {
            scene_terrain(&random, 8, 12);
        } else {
            scene_tangle(&random, 12, 14);
        }
        look_along(integer_between(&random, -1, 1), integer_between(&random, -1, 1), 2);
        check_scene(&random);
    }
    assert_true(samples_found > 1000 && samples_empty > 100);
    assert_true(kept_samples > 100 && covered > 500 && occluded > 20 && culled > 500 &&
                culled_edges > 500);
}

/* Of two level facets, one above the other by no more than their heights may be off by, the exact
   order decides, whichever comes first in the list. */
static void the_nearest_is_found_where_heights_do_not_tell(void **state)
{
    (void)state;
    unsigned found = 0;
    for (int n = 0; n < 24; n++) {
        const uint32_t upper = (uint32_t)n % 2;
        scene_start(&scene);
        for (uint32_t f = 0; f < 2; f++) {
            double z = f == upper ? ldexp(1, -44 - n / 2) : 0;
            scene_triangle(&scene, (const double[3]){0, 0, z}, (const double[3]){5, 0, z},
                           (const double[3]){0, 3, z});
        }
        look_along(1, 2, 2);
        blocks_make();
        for (uint32_t block = 0; block < blocks.grid.size * blocks.grid.size; block++) {
            begin_block(block);
            while (blocks.division.stack_count > 0) {
                lrcsi_clip_sides s;
                lrcsi_cell cell = stack[--blocks.division.stack_count];
                (void)take_sample(&cell, &s);
                if (sample.outcome == LRCSI_SAMPLE_FOUND) {
                    assert_int_equal(facet[sample.nearest].facet, upper);
                    found++;
                } else if (cell.segment_count > 0) {
                    lrcsi_cells_divide(&blocks.division, &cell, &s, &segment[cell.segment[0]],
                                       NULL);
                }
            }
            lrcsi_blocks_end(&blocks, block);
        }
    }
    assert_true(found >= 24);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_agree_with_all_facets),
        cmocka_unit_test(the_nearest_is_found_where_heights_do_not_tell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
