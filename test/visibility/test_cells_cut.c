/* SPDX-License-Identifier: MIT */
/* Cells cut along segments: areas, lists and charges of cells put together by hand. */
#include "visibility/cells/cells_cut.h"

#include <string.h>

#include "check.h"
#include "random.h"

#define FACETS   12u
#define SEGMENTS 8u
#define LISTS    4096u

static lrcsi_cells_facet facet[FACETS];
static lrcsi_cells_segment segment[SEGMENTS];
static unsigned char wanted[FACETS];
static lrcsi_cell_area area[FACETS];
static lrcsi_cell stack[LRCSI_CELL_STACK];
static uint32_t facet_lists[LISTS];
static uint32_t segment_lists[LISTS];
static lrcsi_division division;
static lrcsi_cell cell;
static lrcsi_clip_sides sides;

/* A counter-clockwise triangle without errors. */
static void facet_set(uint32_t i, double x0, double y0, double x1, double y1, double x2, double y2)
{
    lrcsi_cells_facet *f = &facet[i];
    *f = (lrcsi_cells_facet){.x = {x0, x1, x2}, .y = {y0, y1, y2}, .facet = i};
    for (int k = 0; k < 3; k++) {
        const double p[2] = {f->x[k], f->y[k]};
        const double q[2] = {f->x[(k + 1) % 3], f->y[(k + 1) % 3]};
        f->length[k] = lrcsi_line_through(p, q, f->side[k]);
    }
    f->low[0] = fmin(x0, fmin(x1, x2));
    f->high[0] = fmax(x0, fmax(x1, x2));
    f->low[1] = fmin(y0, fmin(y1, y2));
    f->high[1] = fmax(y0, fmax(y1, y2));
}

static void segment_set(uint32_t i, double x0, double y0, double x1, double y1, double line_err)
{
    lrcsi_cells_segment *e = &segment[i];
    *e = (lrcsi_cells_segment){.end = {{x0, y0, 0}, {x1, y1, 0}},
                               .line_err = line_err,
                               .owner = {LRCS_NONE, LRCS_NONE},
                               .edge = LRCS_NONE};
    e->length = lrcsi_line_through(e->end[0], e->end[1], e->line);
}

/* A division with one cell, which lists so many facets and segments. */
static void division_set(const lrcsi_clip_polygon *shape, uint32_t facets, uint32_t segments)
{
    memset(area, 0, sizeof area);
    memset(wanted, 1, sizeof wanted);
    division = (lrcsi_division){.facet = facet,
                                .segment = segment,
                                .segment_count = segments,
                                .segment_room = SEGMENTS,
                                .extent = 1,
                                .wanted = wanted,
                                .area = area,
                                .stack = stack,
                                .facet_lists = facet_lists,
                                .segment_lists = segment_lists,
                                .facet_lists_room = LISTS,
                                .segment_lists_room = LISTS};
    cell = (lrcsi_cell){.shape = *shape, .facet = facet_lists, .facet_count = facets};
    for (uint32_t i = 0; i < facets; i++) {
        facet_lists[i] = i;
    }
    lrcsi_division_start(&division, &cell);
    cell = stack[--division.stack_count];
    lrcsi_clip_sides_make(&cell.shape, lrcsi_division_tolerance(&division, &cell), &sides);
}

static const lrcsi_clip_polygon unit_square = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 4};

static int lists(const uint32_t *list, uint32_t count, uint32_t item)
{
    for (uint32_t i = 0; i < count; i++) {
        if (list[i] == item) {
            return 1;
        }
    }
    return 0;
}

static int is_inside(const lrcsi_clip_polygon *shape, const double x[2])
{
    int inside = 1;
    for (uint32_t i = 0; i < shape->count; i++) {
        const double *a = shape->corner[i];
        const double *b = shape->corner[(i + 1) % shape->count];
        inside &= (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) > 0;
    }
    return inside;
}

static int is_in_facet(const lrcsi_cells_facet *f, const double x[2])
{
    return lrcsi_line_at(f->side[0], x[0], x[1]) > 0 && lrcsi_line_at(f->side[1], x[0], x[1]) > 0 &&
           lrcsi_line_at(f->side[2], x[0], x[1]) > 0;
}

/* Points of a facet, or of a segment, in a part are in what the part lists. */
static void check_lists(const lrcsi_cell *part, uint32_t along, uint64_t *random)
{
    for (int n = 0; n < 200; n++) {
        const double x[2] = {2 * random_unit(random) - 1, 2 * random_unit(random) - 1};
        for (uint32_t i = 0; i < FACETS; i++) {
            if (is_inside(&part->shape, x) && is_in_facet(&facet[i], x)) {
                assert_true(lists(part->facet, part->facet_count, i));
            }
        }
        for (uint32_t i = 0; i < SEGMENTS; i++) {
            const lrcsi_cells_segment *e = &segment[i];
            double t = random_unit(random);
            const double on[2] = {e->end[0][0] + t * (e->end[1][0] - e->end[0][0]),
                                  e->end[0][1] + t * (e->end[1][1] - e->end[0][1])};
            if (i != along && is_inside(&part->shape, on)) {
                assert_true(lists(part->segment, part->segment_count, i));
            }
        }
    }
    assert_false(lists(part->segment, part->segment_count, along));
}

static void the_parts_of_a_cell_make_up_the_cell(void **state)
{
    (void)state;
    uint64_t random = 20261201;
    unsigned dropped = 0;
    for (int n = 0; n < 500; n++) {
        lrcsi_clip_polygon shape = {.count = 3 + random_below(&random, 8)};
        double start = random_unit(&random);
        for (uint32_t i = 0; i < shape.count; i++) {
            double angle = 2 * LRCS_PI * (start + i) / shape.count;
            shape.corner[i][0] = 0.9 * cos(angle);
            shape.corner[i][1] = 0.7 * sin(angle);
        }
        for (uint32_t i = 0; i < FACETS; i++) {
            double at = 2 * LRCS_PI * random_unit(&random);
            double x = 1.6 * random_unit(&random) - 0.8;
            double y = 1.6 * random_unit(&random) - 0.8;
            facet_set(i, x, y, x + 0.3 * cos(at), y + 0.3 * sin(at), x + 0.3 * cos(at + 1),
                      y + 0.3 * sin(at + 1));
        }
        for (uint32_t i = 0; i < SEGMENTS; i++) {
            segment_set(i, 2 * random_unit(&random) - 1, 2 * random_unit(&random) - 1,
                        2 * random_unit(&random) - 1, 2 * random_unit(&random) - 1, 0);
        }
        segment_set(0, 1, 0.4 * random_unit(&random) - 0.2, -1, 0.4 * random_unit(&random) - 0.2,
                    0);
        division_set(&shape, FACETS, SEGMENTS);
        assert_true(lrcsi_cells_divide(&division, &cell, &sides, &segment[0], NULL));
        assert_int_equal(division.stack_count, 2);
        const lrcsi_cell *right = &stack[0];
        const lrcsi_cell *left = &stack[1];
        check_abs(lrcsi_clip_area(&left->shape) + lrcsi_clip_area(&right->shape),
                  lrcsi_clip_area(&shape), 1e-15);
        for (int side = 0; side < 2; side++) {
            const lrcsi_cell *part = side ? right : left;
            double range[2];
            lrcsi_line_range(&part->shape, segment[0].line, range);
            check_most(side ? range[1] : -range[0], 1e-15);
            check_lists(part, 0, &random);
            dropped += FACETS - part->facet_count;
        }
    }
    assert_true(dropped > 500);
}

static void a_cell_is_halved_across_its_longer_side(void **state)
{
    (void)state;
    const lrcsi_clip_polygon wide = {{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}}, 4};
    facet_set(0, 0.6, 0.1, 0.9, 0.1, 0.9, 0.4);
    facet_set(1, 0.1, 0.1, 0.4, 0.1, 0.4, 0.4);
    facet_set(2, 0.1, 0.1, 0.9, 0.1, 0.9, 0.4);
    division_set(&wide, 3, 0);
    assert_true(lrcsi_cells_halve(&division, &cell, &sides));
    for (int i = 0; i < 2; i++) {
        const lrcsi_cell *half = &stack[i];
        uint32_t near = half->shape.corner[0][0] + half->shape.corner[2][0] > 1 ? 0 : 1;
        check_abs(lrcsi_clip_area(&half->shape), 0.25, 0);
        assert_int_equal(half->facet_count, 2);
        assert_true(lists(half->facet, half->facet_count, near));
        assert_true(lists(half->facet, half->facet_count, 2));
        check_abs(area[i].uncertainty, 0, 0); /* halving leaves nothing undecided */
    }
}

/* The strip along x = 1/2 is 2 w wide, w being the error of the line and 12 u; a facet is charged
   for the length that both share, a facet that owns the segment for one half of the strip. Strips
   extend 2^34 w beyond that. */
static void a_cut_charges_the_facets_that_it_crosses(void **state)
{
    (void)state;
    const double w = 1e-15 + 12 * LRCSI_U;
    facet_set(0, -1, -1, 3, -1, -1, 3);         /* contains the square */
    facet_set(1, 0.4, 0.25, 0.6, 0.25, 0.5, 1); /* 3/4 of the segment */
    facet_set(2, 0, 0, 0.4, 0, 0.4, 1);         /* beside it */
    facet_set(3, 0.5, -0.5, 2, 0, 0.5, 1.5);    /* its own side */
    facet_set(4, -1, -1, 3, -1, -1, 3);         /* not wanted */
    segment_set(0, 0.5, -0.5, 0.5, 1.5, 1e-15);
    segment[0].owner[0] = 3;
    division_set(&unit_square, 5, 1);
    wanted[4] = 0;
    assert_true(lrcsi_cells_divide(&division, &cell, &sides, &segment[0], NULL));
    const double length[5] = {1, 0.75, 0, 0.5, 0}; /* of a strip of two sides */
    for (int i = 0; i < 5; i++) {
        check_most(2 * w * length[i], area[i].uncertainty * (1 + 1e-15));
        check_most(area[i].uncertainty, length[i] > 0 ? 2 * w * (length[i] + 3 * 0x1p34 * w) : 0);
    }
}

/* The part of a cell that a sample is in is processed next, whichever side of the segment it is on.
   Only that part keeps the sample. */
static void the_part_with_the_sample_is_next(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        const double at[2] = {k % 2 ? 0.75 : 0.25, 0.5};
        facet_set(0, -1, -1, 3, -1, -1, 3);
        segment_set(0, 0.5, k < 2 ? -0.5 : 1.5, 0.5, k < 2 ? 1.5 : -0.5, 0);
        division_set(&unit_square, 1, 1);
        assert_true(lrcsi_cells_divide(&division, &cell, &sides, &segment[0], at));
        assert_int_equal(division.stack_count, 2);
        for (uint32_t part = 0; part < 2; part++) {
            const lrcsi_cell *c = &division.stack[part];
            double low[2];
            double high[2];
            lrcsi_clip_box(&c->shape, low, high);
            assert_int_equal(c->keeps_sample, part == 1);
            assert_int_equal(low[0] < at[0] && at[0] < high[0], part == 1);
            assert_true(lrcsi_line_at(c->cut_line, 0.5 * (low[0] + high[0]), 0.5) > 0);
        }
        division_set(&unit_square, 1, 1);
        assert_true(lrcsi_cells_divide(&division, &cell, &sides, &segment[0], NULL));
        assert_int_equal(division.stack[0].keeps_sample + division.stack[1].keeps_sample, 0);
    }
}

/* Of four segments one crosses the cell; two are outside; one is along its border, whose strip is
   charged to the facet at this side, not to the one at the other side. */
static void segments_that_do_not_cross_leave_the_list(void **state)
{
    (void)state;
    facet_set(0, 0.8, 0.1, 1, 0.1, 1, 0.9);
    facet_set(1, 0, 0.1, 0.2, 0.1, 0, 0.9);
    segment_set(0, 0.5, -0.5, 0.7, 0.5, 0);
    segment_set(1, 1.1, 0, 1.1, 1, 0);
    segment_set(2, 1, 0, 1, 1, 1e-15);
    segment_set(3, 0.5, 1.3, 1.4, 0.9, 0); /* its box meets that of the cell */
    division_set(&unit_square, 2, 4);
    lrcsi_cells_filter_segments(&division, &cell, &sides);
    assert_int_equal(cell.segment_count, 1);
    assert_int_equal(cell.segment[0], 0);
    assert_int_equal(cell.removed, 1);
    assert_true(cell.widest_strip >= 1e-15 && cell.widest_strip < 1e-13);
    check_most(0.8 * 1e-15, area[0].uncertainty + cell.uncertainty);
    check_abs(area[1].uncertainty, 0, 0);
}

/* A cell is thin if its sample is within 2^-32 of its perimeter from the border. Then it is no more
   than its area that is undecided, and no less than the strips may cover. */
static void a_thin_cell_is_undecided_along_its_strips(void **state)
{
    (void)state;
    const lrcsi_clip_polygon needle = {{{0, 0}, {1, 0}, {1, 1e-12}, {0, 1e-12}}, 4};
    division_set(&needle, 0, 0);
    cell.widest_strip = 1e-15;
    double uncertainty = lrcsi_cells_thin_uncertainty(&cell, &sides, 5e-13, 3, 1e-15);
    check_most(3 * 4 * 2e-15 * 2, uncertainty);
    check_most(uncertainty, 1e-12 + 1e-13);
    check_abs(lrcsi_cells_thin_uncertainty(&cell, &sides, 1e-9, 3, 1e-15), 0, 0);
}

static void a_narrow_cell_is_charged_whole(void **state)
{
    (void)state;
    const lrcsi_clip_polygon needle = {{{0, 0}, {1, 0}, {1, 1e-15}, {0, 1e-15}}, 4};
    facet_set(0, 0, -1, 1, -1, 0.5, 1);
    facet_set(1, 0, -1, 1, -1, 0.5, 1);
    division_set(&needle, 2, 0);
    wanted[1] = 0;
    cell.uncertainty = 0.25;
    assert_true(lrcsi_cells_charge_all(&division, &cell, &sides));
    check_most(0.25 + 1e-15, area[0].uncertainty);
    check_abs(area[1].uncertainty, 0, 0);
    division_set(&unit_square, 2, 0);
    assert_false(lrcsi_cells_charge_all(&division, &cell, &sides));
    check_abs(area[0].uncertainty, 0, 0);
}

/* The last cell that fits, and one more, of each limit. */
static void a_cell_without_room_is_not_cut(void **state)
{
    (void)state;
    facet_set(0, 0, 0, 1, 0, 0, 1);
    for (int limit = 0; limit < 4; limit++) {
        for (int over = 0; over < 2; over++) {
            segment_set(0, 0.5, -0.5, 0.5, 1.5, 0);
            segment_set(1, 0.2, 0.2, 0.8, 0.7, 0);
            division_set(&unit_square, 1, 2);
            cell.cuts = limit == 0 ? LRCSI_CELL_MAX_CUTS - 1 + (uint32_t)over : 0;
            division.stack_count = limit == 1 ? LRCSI_CELL_STACK - 2 + (uint32_t)over : 0;
            division.facet_lists_room = limit == 2 ? 2 - (size_t)over : LISTS;
            division.segment_lists_room = limit == 3 ? 4 - (size_t)over : LISTS;
            assert_int_equal(lrcsi_cells_divide(&division, &cell, &sides, &segment[0], NULL),
                             !over);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_parts_of_a_cell_make_up_the_cell),
        cmocka_unit_test(a_cell_is_halved_across_its_longer_side),
        cmocka_unit_test(a_cut_charges_the_facets_that_it_crosses),
        cmocka_unit_test(the_part_with_the_sample_is_next),
        cmocka_unit_test(segments_that_do_not_cross_leave_the_list),
        cmocka_unit_test(a_thin_cell_is_undecided_along_its_strips),
        cmocka_unit_test(a_narrow_cell_is_charged_whole),
        cmocka_unit_test(a_cell_without_room_is_not_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
