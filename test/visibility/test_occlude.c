/* SPDX-License-Identifier: MIT */
/* One facet at a time: what is visible of it comes as pieces whose area is the area told. */
#include "visibility/occlude.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_contest contest;

/* A level plate of two facets at height 0, seen from above, and whatever else was put there. */
static lrcsi_occluding open_scene(void)
{
    lrcs_pose pose;
    lrcsi_occluding o;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0, 0, 1}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_contest_make(&view, &work, &contest), LRCS_OK);
    assert_int_equal(lrcsi_occlude_make(&contest, &work, &o), LRCS_OK);
    return o;
}

static void start(void)
{
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
}

/* The area of all pieces, their count in *pieces; the facet's area as told in *told. */
static double pieces_area(lrcsi_occluding *o, uint32_t facet, uint32_t *pieces, double *told)
{
    double area = 0;
    *pieces = 0;
    size_t used = work.used;
    assert_int_equal(lrcsi_occlude_open(o, facet), LRCS_OK);
    while (lrcsi_occlude_next(o)) {
        area += lrcsi_clip_area(&o->clip);
        *pieces += o->clip.list.pieces;
    }
    assert_false(lrcsi_occlude_next(o));
    *told = lrcsi_prepared_area(view.prepared, lrcsi_occlude_close(o).area);
    assert_int_equal(work.used, used);
    return lrcsi_prepared_area(view.prepared, area);
}

static void whole_facet_is_its_own_triangle(void **state)
{
    (void)state;
    uint32_t pieces;
    double told;
    start();
    lrcsi_occluding o = open_scene();
    check_rel(pieces_area(&o, 1, &pieces, &told), 0.5, 1e-15);
    assert_int_equal(pieces, 1);
    assert_int_equal(lrcsi_occlude_open(&o, 1), LRCS_OK);
    assert_true(lrcsi_occlude_next(&o));
    assert_int_equal(o.clip.list.end[0], 3);
    assert_memory_equal(o.clip.list.corner, o.target.corner, sizeof o.target.corner);
    assert_int_equal(o.target.facet, 1);
    lrcsi_occlude_close(&o);
}

static void hidden_and_edge_on_facets_have_no_pieces(void **state)
{
    (void)state;
    uint32_t pieces;
    double told;
    start();
    scene_plate(&scene, (const double[3]){-1, -1, 2}, (const double[3]){4, 0, 0},
                (const double[3]){0, 4, 0});
    scene_plate(&scene, (const double[3]){5, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 0, 1});
    lrcsi_occluding o = open_scene();
    static const uint32_t none[] = {0, 1, 4, 5};
    for (int i = 0; i < 4; i++) {
        check_same(pieces_area(&o, none[i], &pieces, &told), 0);
        check_same(told, 0);
        assert_int_equal(pieces, 0);
    }
}

/* A grid of plates, many more than a cell takes: each hides what it covers. */
static void pieces_of_a_contested_facet_have_the_area_told(void **state)
{
    (void)state;
    uint32_t pieces;
    double told;
    start();
    for (int i = 0; i < 64; i++) {
        scene_plate(&scene, (const double[3]){0.125 * (i % 8), 0.125 * (i / 8), 1},
                    (const double[3]){0.0625, 0, 0}, (const double[3]){0, 0.0625, 0});
    }
    lrcsi_occluding o = open_scene();
    double first = pieces_area(&o, 0, &pieces, &told);
    check_same(told, first);
    assert_true(pieces > 20);
    double second = pieces_area(&o, 1, &pieces, &told);
    check_same(told, second);
    check_rel(first + second, 0.75, 1e-14);
    check_same(pieces_area(&o, 0, &pieces, &told), first); /* however often it is asked */
    check_same(told, first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_facet_is_its_own_triangle),
        cmocka_unit_test(hidden_and_edge_on_facets_have_no_pieces),
        cmocka_unit_test(pieces_of_a_contested_facet_have_the_area_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
