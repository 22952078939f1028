/* SPDX-License-Identifier: MIT */
/* What may divide a facet: found, and told to come near a part of it or not. */
#include "visibility/cut.h"

#include "visibility/plate_and.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_contest contest;
static lrcsi_target target;
static lrcsi_cuts cuts;

/* A plate of side 4 seen from above, and a triangle of which the corners are told. */
static uint32_t look(const double a[3], const double b[3], const double c[3])
{
    plate_and(&scene, a, b, c, &work, &view);
    assert_int_equal(lrcsi_contest_make(&view, &work, &contest), LRCS_OK);
    lrcsi_target_make(&view, 0, &target);
    assert_int_equal(lrcsi_cuts_make(&contest, &target, &work, &cuts), LRCS_OK);
    return cuts.count;
}

/* How many come near a small square about (x, y); the scene is scaled by 1/8. */
static uint32_t near(double x, double y, double half)
{
    static const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    lrcsi_clip_polygon p = {.count = 4};
    for (int i = 0; i < 4; i++) {
        p.corner[i][0] = 0.125 * (x + half * sign[i][0]);
        p.corner[i][1] = 0.125 * (y + half * sign[i][1]);
    }
    return lrcsi_cuts_keep(&cuts, &p, cuts.count);
}

static void the_rim_of_a_facet_in_front_divides(void **state)
{
    (void)state;
    assert_int_equal(
        look((const double[3]){1, 1, 1}, (const double[3]){2, 1, 1}, (const double[3]){1, 2, 4}),
        3);
    assert_int_equal(near(1.25, 1.25, 0.1), 0);
    assert_int_equal(near(0.5, 0.5, 0.4), 0);
    assert_int_equal(near(1, 1.5, 0.1), 1);
    assert_int_equal(near(1, 1, 0.1), 2);
    assert_int_equal(near(1.25, 1.25, 1), 3);
    uint32_t sheet = contest.sheet[1];
    assert_int_equal(lrcsi_cuts_of(&cuts, cuts.count, sheet), 3);
    assert_int_equal(lrcsi_cuts_of(&cuts, cuts.count, contest.sheet[0]), 0);
}

/* The line at half the height, and the sides that rise from it; what lies below divides nothing. */
static void a_facet_that_pierces_divides_where_it_does(void **state)
{
    (void)state;
    look((const double[3]){1, 1, -1}, (const double[3]){2, 1, -1}, (const double[3]){1, 2, 1});
    uint32_t contacts = 0;
    for (uint32_t i = 0; i < cuts.count; i++) {
        if (cuts.cut[i].other == 1) {
            contacts++;
            assert_int_equal(cuts.cut[i].kind, LRCSI_CONTACT_LINE);
            check_abs(cuts.cut[i].line.at[1], 0.125 * 1.5, 1e-16);
            check_abs(fabs(cuts.cut[i].line.to[0]), 0.125 * 0.5, 1e-16);
        }
    }
    assert_int_equal(contacts, 1);
    assert_true(near(1.25, 1.5, 0.01) == 1);
}

/* A corner that stands on the facet parts nothing; one in its plane divides along its rim. */
static void contacts_in_points_and_planes(void **state)
{
    (void)state;
    assert_int_equal(
        look((const double[3]){1, 1, 0}, (const double[3]){2, 1, 1}, (const double[3]){1, 2, 1}),
        3);
    look((const double[3]){1, 1, 0}, (const double[3]){2, 1, 0}, (const double[3]){1, 2, 0});
    assert_false(contest.contested[0]); /* the lower index wins */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rim_of_a_facet_in_front_divides),
        cmocka_unit_test(a_facet_that_pierces_divides_where_it_does),
        cmocka_unit_test(contacts_in_points_and_planes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
