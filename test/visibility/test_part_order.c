/* SPDX-License-Identifier: MIT */
/* Which parts are behind a facet or in front of it: a post on a drum, and sunk into it, seen from
   above and from below. */
#include "visibility/proximity/part_order.h"

#include "pair.h"
#include "scene/proximity.h"

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_part_orders orders;

enum { POST, DRUM };

/* The post is upright at the origin, the top of the drum at this height. */
static void look_at_post(double top, double x, double y, double z)
{
    static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const lrcs_prepared *prepared =
        pair_prepare(&post, &drum, (const double[3]){0, 0, top - 1}, upright, 0, &scene, &work);
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction((const double[3]){x, y, z}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    static unsigned char memory[1u << 16];
    size_t need = lrcsi_part_orders_need(prepared);
    assert_true(need > 0 && need <= sizeof memory);
    lrcs_work room = lrcs_work_make(memory, need);
    assert_int_equal(lrcsi_part_orders_make(&view, &room, &orders), LRCS_OK);
    room = lrcs_work_make(memory, need / 2);
    lrcsi_part_orders none;
    assert_int_equal(lrcsi_part_orders_make(&view, &room, &none), LRCS_E_MEMORY);
}

/* Is the facet flat, and its normal along the axis? 1 up, -1 down, else 0: on the wall. */
static int level_side(uint32_t facet)
{
    const lrcsi_normal *n = &view.prepared->normal[facet];
    return n->high[2] > 0.99 * n->length ? 1 : n->high[2] < -0.99 * n->length ? -1 : 0;
}

typedef struct order_answers {
    int behind, in_front, separated;
} order_answers;

static order_answers ask(uint32_t facet, uint32_t part)
{
    double err;
    double unproved[3];
    order_answers a = {lrcsi_part_is_behind(&orders, facet, part, &unproved[0]),
                       lrcsi_part_is_in_front(&orders, facet, part, &err, &unproved[1]),
                       lrcsi_part_is_separated(&orders, facet, part, &unproved[2])};
    for (int i = 0; i < 3; i++) {
        assert_true(unproved[i] >= 0 && unproved[i] <= 0x1p-20);
    }
    assert_true(err >= 0 && err <= 0.5 * orders.outline[part].k);
    return a;
}

/* Seen from above, the drum is behind all of the post, and the post in front of all of the drum:
   of its top because the top is flat, elsewhere because a plane separates them. */
static void a_post_on_a_drum_is_in_front_of_it(void **state)
{
    (void)state;
    look_at_post(0, 0.1, 0.2, 1);
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        if (scene.facet_part[f] == POST) {
            order_answers a = ask(f, DRUM);
            assert_int_equal(a.behind, level_side(f) >= 0); /* its foot lies in the plane */
            assert_int_equal(a.in_front, 0);
            assert_int_equal(a.separated, a.behind);
        } else {
            order_answers a = ask(f, POST);
            assert_int_equal(a.behind, 0);
            assert_int_equal(a.in_front, 1);
            assert_int_equal(a.separated, level_side(f) <= 0);
        }
    }
}

/* From below it is the other way round. No facet faces the laser in whose plane the drum stands. */
static void a_post_on_a_drum_is_behind_it_from_below(void **state)
{
    (void)state;
    look_at_post(0, 0.1, 0.2, -1);
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        int is_post = scene.facet_part[f] == POST;
        int in_plane = level_side(f) == (is_post ? -1 : 1);
        order_answers a = ask(f, is_post ? DRUM : POST);
        assert_int_equal(a.behind, !is_post && !in_plane);
        assert_int_equal(a.separated, !in_plane);
        assert_int_equal(a.in_front, is_post && (!in_plane || view.facing[f] > 0));
    }
}

static void nothing_is_known_of_parts_that_meet(void **state)
{
    (void)state;
    look_at_post(0.001, 0.1, 0.2, 1);
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        order_answers a = ask(f, scene.facet_part[f] == POST ? DRUM : POST);
        assert_false(a.behind || a.in_front || a.separated);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_post_on_a_drum_is_in_front_of_it),
        cmocka_unit_test(a_post_on_a_drum_is_behind_it_from_below),
        cmocka_unit_test(nothing_is_known_of_parts_that_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
