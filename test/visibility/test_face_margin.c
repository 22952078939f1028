/* SPDX-License-Identifier: MIT */
/* The margins on a disc behind a ball: together they are the area between the outline of the ball's
   facets, a polygon, and that of the true ball, a circle. With fewer steps or less memory less is
   known, and what is known is right. */
#include "visibility/proximity/face_margin.h"

#include "recipe.h"

enum { FACE, BALL, SECOND, PARTS };

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_event_bands bands;

/* A disc, a ball above it and, if doubled, the disc once more. */
static void look(double tilt, int doubled)
{
    lrcs_recipe_part part[PARTS];
    lrcs_pose pose;
    for (int i = 0; i < PARTS; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = -1;
        part[i].shape = (lrcs_shape){.kind = LRCS_SHAPE_DISC, .radius = 1};
    }
    part[BALL].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.3};
    part[BALL].place.translate[2] = 0.5;
    const lrcs_recipe recipe = {.part = part, .part_count = doubled ? 3 : 2};
    const lrcs_build_options build = {1e-9, 2000, LRCS_NORMALS_FLAT, 1, 0, NULL};
    const lrcs_prepared *prepared = recipe_prepare(&recipe, NULL, &build, &scene, &work);
    const double d[3] = {sin(tilt), 0, cos(tilt)};
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_event_bands_make(&view, NULL, &work, &bands), LRCS_OK);
}

/* The area of the polygon less that of the circle. */
static double area_between_outlines(void)
{
    const double radius = ldexp(0.3, -view.prepared->exponent);
    double twice = 0;
    for (uint32_t e = 0; e < bands.events.count; e++) {
        if (bands.events.part[e] == BALL) {
            const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[e]];
            const double *a = view.point[edge->low].x;
            const double *b = view.point[edge->high].x;
            twice += bands.events.side[e] * (a[0] * b[1] - a[1] * b[0]);
        }
    }
    return 0.5 * twice - LRCS_PI * radius * radius;
}

static lrcsi_face_margin margins(size_t bytes, lrcsi_meter *meter, uint32_t part)
{
    lrcsi_face_margin face[PARTS];
    uint32_t on[4096];
    assert_true(bands.events.count <= 4096 && bytes <= work.size - work.used);
    lrcs_work room = lrcs_work_make(work.bytes + work.used, bytes);
    bands.meter = meter;
    lrcsi_face_margins_make(&bands, &classification, &room, face, on);
    assert_int_equal(room.used, 0);
    return face[part];
}

static void check_face(const lrcsi_face_margin *face)
{
    if (face->known) {
        check_abs(face->area, area_between_outlines(), face->error);
    }
}

static void margins_of_a_ball_are_what_lies_between_its_outlines(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        look(0.2 * i, 0);
        const lrcsi_face_margin face = margins(lrcsi_face_margins_need(view.prepared), NULL, FACE);
        assert_true(face.known);
        check_face(&face);
        check_most(face.error, 0.1 * bands.orders.outline[BALL].k);
    }
}

static void every_margin_counts_to_one_face_only(void **state)
{
    (void)state;
    look(0.2, 1);
    const size_t need = lrcsi_face_margins_need(view.prepared);
    assert_int_equal(margins(need, NULL, FACE).known, 1);
    assert_int_equal(margins(need, NULL, SECOND).known, 0);
}

static void little_memory_and_few_steps_leave_more_open(void **state)
{
    (void)state;
    look(0.2, 0);
    const size_t need = lrcsi_face_margins_need(view.prepared);
    const lrcsi_face_margin all = margins(need, NULL, FACE);
    int wider[2] = {0, 0};
    int unknown = 0;
    for (size_t bytes = 0; bytes < need; bytes += 1 + bytes / 4) {
        const lrcsi_face_margin face = margins(bytes, NULL, FACE);
        check_face(&face);
        unknown += !face.known;
        wider[0] += face.known && face.error > all.error;
        assert_true(!face.known || face.error >= all.error);
    }
    for (uint64_t steps = 0; steps < 20000; steps += 1 + steps / 4) {
        lrcsi_meter meter = {.limit = steps};
        const lrcsi_face_margin face = margins(need, &meter, FACE);
        assert_true(face.known && face.error >= all.error && meter.taken <= steps);
        check_face(&face);
        wider[1] += face.error > all.error;
    }
    assert_true(unknown > 0 && wider[0] > 0 && wider[1] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_of_a_ball_are_what_lies_between_its_outlines),
        cmocka_unit_test(every_margin_counts_to_one_face_only),
        cmocka_unit_test(little_memory_and_few_steps_leave_more_open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
