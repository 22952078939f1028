/* SPDX-License-Identifier: MIT */
/* From points of a facet's frame back to the facet: its corners exactly, needles along their whole
   length, points beside it to its rim. */
#include "visibility/cells/target.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;

#define U 0x1p-53

static lrcsi_target target_from(double x, double y, double z)
{
    lrcs_pose pose;
    lrcsi_target target;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){x, y, z}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    lrcsi_target_make(&view, 0, &target);
    return target;
}

/* How far the projection of the weighted point lies from `at`, in units of u times the reach. */
static double displacement(const lrcsi_target *t, const double at[2], const double weight[3])
{
    const double *origin = lrcsi_prepared_corner(view.prepared, 0, 0);
    long double off = 0;
    for (int k = 0; k < 2; k++) {
        long double sum = 0;
        for (int j = 0; j < 3; j++) {
            for (int i = 0; i < 3; i++) {
                sum += (long double)view.R[k][i] * weight[j] *
                       (lrcsi_prepared_corner(view.prepared, 0, j)[i] - (long double)origin[i]);
            }
        }
        off += (sum - at[k]) * (sum - at[k]);
    }
    return (double)(sqrtl(off) / (U * t->reach));
}

static void corners_come_back_exactly_whichever_way_the_facet_faces(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0.1, 0.2, 0.3}, (const double[3]){4, 0, 1},
                   (const double[3]){0.7, 4, 0});
    for (int sense = -1; sense <= 1; sense += 2) {
        lrcsi_target t = target_from(0.3, -0.2, sense);
        for (int k = 0; k < 3; k++) {
            double weight[3];
            int own = sense > 0 ? k : (3 - k) % 3; /* counter-clockwise in the view */
            lrcsi_target_weights(&t, t.corner[k], weight);
            for (int j = 0; j < 3; j++) {
                check_same(weight[j], j == own ? 1 : 0);
            }
        }
    }
}

/* Facets whose height shrinks to nothing beside their length, tilted up to grazing. */
static void points_come_back_to_where_they_are_seen_in_any_needle(void **state)
{
    (void)state;
    uint64_t seed = 5;
    double worst = 0;
    for (int power = 0; power <= 60; power++) {
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0.1, 0.2, 0.3}, (const double[3]){1, 0.5, 0.25},
                       (const double[3]){0.6, 0.4 + ldexp(1, -power), 0.3});
        for (int i = 0; i < 40; i++) {
            double part[3];
            double weight[3];
            lrcsi_target t = target_from(0.1 * i - 2, 0.3, 0.8);
            part[0] = random_below(&seed, 1000) / 1000.0;
            part[1] = (1 - part[0]) * random_below(&seed, 1000) / 1000.0;
            part[2] = 1 - part[0] - part[1];
            double at[2];
            for (int k = 0; k < 2; k++) {
                at[k] =
                    part[0] * t.corner[0][k] + part[1] * t.corner[1][k] + part[2] * t.corner[2][k];
            }
            lrcsi_target_weights(&t, at, weight);
            check_abs(weight[0] + weight[1] + weight[2], 1, 4 * U);
            for (int j = 0; j < 3; j++) {
                check_most(-weight[j], 0);
            }
            worst = fmax(worst, displacement(&t, at, weight));
        }
    }
    check_most(worst, 100); /* of visibility/cells/target.h */
}

static void points_beside_the_facet_go_to_its_rim(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                   (const double[3]){0, 1, 0});
    lrcsi_target t = target_from(0, 0, 1);
    static const double beside[][2] = {{-1, 0.25}, {0.25, -1}, {1, 1}, {3, -2}, {-1, -1}};
    for (size_t i = 0; i < sizeof beside / sizeof *beside; i++) {
        double weight[3];
        lrcsi_target_weights(&t, beside[i], weight);
        check_most(-fmin(weight[0], fmin(weight[1], weight[2])), 0);
        check_abs(fmin(weight[0], fmin(weight[1], weight[2])), 0, 4 * U);
        check_abs(weight[0] + weight[1] + weight[2], 1, 4 * U);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_come_back_exactly_whichever_way_the_facet_faces),
        cmocka_unit_test(points_come_back_to_where_they_are_seen_in_any_needle),
        cmocka_unit_test(points_beside_the_facet_go_to_its_rim),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
