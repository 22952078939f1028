/* SPDX-License-Identifier: MIT */
/* Parts of a facet that nothing divides: found, and answered by one sample. A disc of many sectors
   hangs over the lower right half of a square of side 4; seen from above its rim alone divides what
   lies below. */
#include "visibility/calm.h"

#include "scenes.h"
#include "visibility/occlude.h"

enum { SECTORS = 256 };

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_contest contest;
static lrcsi_grid facets;
static lrcsi_target target;
static lrcsi_calm calm;

static void disc(double x, double y, double z, double radius)
{
    uint32_t apex = scene_vertex(&scene, x, y, z);
    for (uint32_t k = 0; k < SECTORS; k++) {
        double turn = 2 * (double)SCENE_PI * k / SECTORS;
        scene_vertex(&scene, x + radius * cos(turn), y + radius * sin(turn), z);
    }
    for (uint32_t k = 0; k < SECTORS; k++) {
        scene_facet(&scene, apex, apex + 1 + k, apex + 1 + (k + 1) % SECTORS);
    }
}

/* Looks straight down: what may divide facet 0. */
static uint32_t look(void)
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0, 0, 1}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_contest_make(&view, &work, &contest), LRCS_OK);
    assert_int_equal(lrcsi_grid_facets(&contest.grid, contest.cells, NULL, &work, &facets),
                     LRCS_OK);
    lrcsi_target_make(&view, 0, &target);
    size_t before = work.used;
    assert_int_equal(lrcsi_calm_make(prepared, &work, &calm), LRCS_OK);
    assert_true(work.used - before <= lrcsi_calm_need(prepared));
    return lrcsi_calm_start(&calm, &contest, &target);
}

static uint32_t look_down(double height)
{
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                (const double[3]){0, 4, 0});
    disc(2.75, 1.25, height, 0.5);
    return look();
}

/* A small square of the facet's frame about (x, y), in scene units, which the engine scales by 1/8.
 */
static lrcsi_clip_polygon square(double x, double y, double half)
{
    static const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    lrcsi_clip_polygon p = {.count = 4};
    for (int i = 0; i < 4; i++) {
        p.corner[i][0] = 0.125 * (x + half * sign[i][0]);
        p.corner[i][1] = 0.125 * (y + half * sign[i][1]);
    }
    return p;
}

static void check_square(double x, double y, double half, uint32_t edges, int answer)
{
    lrcsi_clip_polygon shape = square(x, y, half);
    assert_int_equal(lrcsi_calm_keep(&calm, &shape, 0, calm.edges) != 0, edges != 0);
    if (edges == 0) {
        assert_int_equal(lrcsi_calm_answer(&calm, &facets, &shape), answer);
    }
}

static void only_the_rim_divides_what_lies_below_a_disc(void **state)
{
    (void)state;
    assert_int_equal(look_down(1), SECTORS);
    assert_true(contest.contested[0]);
    check_square(2.75, 1.25, 0.3, 0, LRCSI_QUERY_HIDDEN);
    check_square(3.6, 0.5, 0.1, 0, LRCSI_QUERY_VISIBLE);
    check_square(3.25, 1.25, 0.01, 1, 0);
    check_square(2.75, 1.25, 0.8, 1, 0);
}

/* A point as large as rounding is no place for a sample. */
static void a_shape_too_thin_for_a_sample_is_not_answered(void **state)
{
    (void)state;
    look_down(1);
    lrcsi_clip_polygon shape = square(2.75, 1.25, 0x1p-50);
    assert_int_equal(lrcsi_calm_keep(&calm, &shape, 0, calm.edges), 0);
    assert_int_equal(lrcsi_calm_answer(&calm, &facets, &shape), LRCSI_QUERY_UNDECIDED);
}

/* The disc lies in the plate's plane, where it loses: nothing is contested. One ulp higher or
   tilted through the plate, each sector touches the plate and counts where it meets its plane. */
static void what_touches_the_inside_divides_it(void **state)
{
    (void)state;
    look_down(0);
    assert_false(contest.contested[0]);
    look_down(1);
    for (uint32_t v = 0; v < scene.scene.vertex_count;
         v++) { /* through the plate, along x = 2.75 */
        if (scene.vertex[v].x[2] > 0) {
            scene.vertex[v].x[2] = scene.vertex[v].x[0] - 2.75;
        }
    }
    assert_true(look() > SECTORS / 2);
    check_square(2.95, 1.25, 0.1, 0, LRCSI_QUERY_HIDDEN);
    check_square(2.55, 1.25, 0.1, 0, LRCSI_QUERY_VISIBLE);
    check_square(2.75, 1.25, 0.1, 1, 0);
}

/* The area is that of the square less that of the polygon, and comes in few pieces although a
   sector's tip is as thin as rounding. */
static void a_fan_costs_pieces_along_its_rim_only(void **state)
{
    (void)state;
    look_down(1);
    lrcsi_occluding o;
    assert_int_equal(lrcsi_occlude_make(&contest, &work, &o), LRCS_OK);
    assert_int_equal(lrcsi_occlude_open(&o, 0), LRCS_OK);
    int steps = 0;
    while (lrcsi_occlude_next(&o)) {
        steps++;
    }
    lrcsi_visible seen = lrcsi_occlude_close(&o);
    long double sector = 0.25L * 0.5L * sinl(2 * SCENE_PI / SECTORS);
    long double truth = (8 - SECTORS * sector) / 64; /* scaled by 1/8 */
    check_abs(seen.area, (double)truth, 1e-15);
    assert_true(seen.low <= (double)truth && (double)truth <= seen.high);
    assert_true(steps > 0 && steps < 8 * SECTORS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_the_rim_divides_what_lies_below_a_disc),
        cmocka_unit_test(a_shape_too_thin_for_a_sample_is_not_answered),
        cmocka_unit_test(what_touches_the_inside_divides_it),
        cmocka_unit_test(a_fan_costs_pieces_along_its_rim_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
