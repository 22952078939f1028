/* SPDX-License-Identifier: MIT */
/* What must not change sigma, on random scenes: five families, the three methods, seen from
   directions of small integers. Coordinates have bits to spare, so that turning, moving, scaling
   and splitting make exactly the same scene elsewhere: the engine's own intervals must then
   overlap, with nothing added; where the arithmetic is the same it must be so to the bit. */
#include "scenes.h"

static test_scene scene;
enum { FACET, ZBUFFER, EXACT, METHODS };
static const int methods[METHODS] = {LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT};

#define SCENES 16u /* of each family */

/* --- families --------------------------------------------------------------------------------- */

/* A multiple of 2^-bits in -reach .. reach. */
static double grain(uint64_t *seed, int bits, uint32_t reach)
{
    uint32_t steps = 2 * (reach << bits) + 1;
    return ldexp((double)random_below(seed, steps), -bits) - (double)reach;
}

static void random_point(uint64_t *seed, int bits, uint32_t reach, double x[3])
{
    for (int k = 0; k < 3; k++) {
        x[k] = grain(seed, bits, reach);
    }
}

static void soup(uint64_t *seed, uint32_t count, int bits, uint32_t reach)
{
    for (uint32_t f = 0; f < count; f++) {
        double x[3][3];
        scene.assigned = random_below(seed, scene.scene.material_count);
        for (int c = 0; c < 3; c++) {
            random_point(seed, bits, reach, x[c]);
        }
        scene_triangle(&scene, x[0], x[1], x[2]);
    }
}

static void loose_soup(uint64_t *seed)
{
    soup(seed, 24, 10, 3);
}

/* Corners on integers: facets in one plane, duplicates, edges through each other, edge-on ones. */
static void lattice_soup(uint64_t *seed)
{
    soup(seed, 24, 0, 2);
}

/* Large plates through one small region. */
static void piercing_plates(uint64_t *seed)
{
    for (int i = 0; i < 8; i++) {
        double corner[3];
        double u[3];
        double v[3];
        scene.assigned = random_below(seed, scene.scene.material_count);
        random_point(seed, 8, 4, u);
        random_point(seed, 8, 4, v);
        for (int k = 0; k < 3; k++) {
            corner[k] = -0.5 * (u[k] + v[k]) + grain(seed, 8, 1) / 4;
        }
        scene_plate(&scene, corner, u, v);
    }
}

/* Needles whose tip stands 2^-26 to 2^-6 off a long side, and a few triangles between them. */
static void slivers(uint64_t *seed)
{
    for (int i = 0; i < 16; i++) {
        double x[3][3];
        scene.assigned = random_below(seed, scene.scene.material_count);
        random_point(seed, 6, 2, x[0]);
        random_point(seed, 6, 2, x[1]);
        double off = ldexp(1, -6 - (int)random_below(seed, 21));
        for (int k = 0; k < 3; k++) {
            x[2][k] = 0.5 * (x[0][k] + x[1][k]) + off * grain(seed, 0, 2);
        }
        scene_triangle(&scene, x[0], x[1], x[2]);
    }
    soup(seed, 8, 6, 2);
}

/* A bus, a faceted ball that may pierce it, two arrays, a boom; sizes and places at random. */
static void satellite(uint64_t *seed)
{
    double low[3];
    double high[3];
    double at[3];
    for (int k = 0; k < 3; k++) {
        low[k] = -0.25 - ldexp((double)random_below(seed, 256), -8);
        high[k] = 0.25 + ldexp((double)random_below(seed, 256), -8);
        at[k] = grain(seed, 8, 1);
    }
    scene.assigned = 0;
    scene_box(&scene, low, high);
    scene.assigned = random_below(seed, scene.scene.material_count);
    uint32_t first = scene.scene.vertex_count;
    scene_sphere(&scene, at, 0.5, 8);
    for (uint32_t v = first; v < scene.scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            scene.vertex[v].x[k] = nearbyint(scene.vertex[v].x[k] * 4096) / 4096;
        }
    }
    for (int side = -1; side <= 1; side += 2) {
        scene.assigned = random_below(seed, scene.scene.material_count);
        scene_plate(&scene, (const double[3]){side * 1.625 - 1, -0.5, at[2] / 4},
                    (const double[3]){2, 0, at[0] / 4}, (const double[3]){0, 1, at[1] / 4});
    }
    scene_box(&scene, (const double[3]){-0.0625, -2, 0}, (const double[3]){0.0625, 2, 0.125});
}

typedef void family(uint64_t *seed);
static family *const families[] = {loose_soup, lattice_soup, piercing_plates, slivers, satellite};
#define FAMILIES (sizeof families / sizeof *families)

/* Scene `number` of a family, with materials of one law or of three, one of them two-sided; and a
   direction of small integers. */
static void make(size_t kind, uint32_t number, int laws, double direction[3])
{
    uint64_t seed = 0x9e3779b97f4a7c15u * (number * FAMILIES + kind + 1);
    scene_start(&scene);
    scene.material[0].brdf.s = 0.5;
    *scene_material(&scene, 1, 0.25, 0.5, 0.5) = scene.material[0];
    scene.material[1].two_sided = 1;
    if (laws == 3) {
        scene.material[1].brdf = (lrcs_brdf){0.5, 0.125, 0.3, 2};
        scene_material(&scene, 0, 0.5, 0.2, 0);
    }
    families[kind](&seed);
    do {
        for (int k = 0; k < 3; k++) {
            direction[k] = grain(&seed, 0, number % 4 == 0 ? 1 : 9);
        }
    } while (direction[0] == 0 && direction[1] == 0 && direction[2] == 0);
}

/* By every method, prepared once; records are the last one's. */
static void run_methods(const double direction[3], lrcs_result result[METHODS])
{
    lrcs_work work;
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    for (int k = 0; k < METHODS; k++) {
        uint32_t size = methods[k] == LRCS_METHOD_ZBUFFER ? 48 : 0;
        result[k] = scene_pose(&scene, p, &work, direction, methods[k], size);
    }
}

/* The two intervals, the second of them for `factor` times the truth, must overlap. 4e-16 is for
   the rounding of this check. */
static void check_overlap(const lrcs_result *one, const lrcs_result *other, double factor)
{
    assert_true(one->bound_m2 >= 0 && other->bound_m2 >= 0);
    check_abs(other->sigma_m2, factor * one->sigma_m2,
              other->bound_m2 + factor * one->bound_m2 + 4e-16 * factor * one->sigma_m2);
}

/* Every scene of every family; `change` makes the other scene and returns the factor of sigma. */
static void each_scene(int laws, double (*change)(uint64_t *seed, double direction[3]))
{
    for (size_t kind = 0; kind < FAMILIES; kind++) {
        for (uint32_t number = 0; number < SCENES; number++) {
            uint64_t seed = number + 77;
            double direction[3];
            lrcs_result before[METHODS];
            lrcs_result after[METHODS];
            make(kind, number, laws, direction);
            run_methods(direction, before);
            double factor = change(&seed, direction);
            run_methods(direction, after);
            for (int k = 0; k < METHODS; k++) {
                check_overlap(&before[k], &after[k], factor);
                check_overlap(&before[EXACT], &after[k], factor);
            }
        }
    }
}

/* --- what changes nothing --------------------------------------------------------------------- */

static double turn_both(uint64_t *seed, double direction[3])
{
    int q[4];
    do {
        for (int k = 0; k < 4; k++) {
            q[k] = (int)random_below(seed, 5) - 2;
        }
    } while (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0);
    double factor = scene_turn(&scene, q, direction);
    return factor * factor;
}

static void turning_mesh_and_laser_together_changes_nothing(void **state)
{
    (void)state;
    each_scene(3, turn_both);
}

static double mirror_both(uint64_t *seed, double direction[3])
{
    (void)seed;
    for (uint32_t v = 0; v < scene.scene.vertex_count; v++) {
        scene.vertex[v].x[0] = -scene.vertex[v].x[0];
    }
    scene_invert(&scene, 0);
    direction[0] = -direction[0];
    return 1;
}

static void mirroring_mesh_and_laser_together_changes_nothing(void **state)
{
    (void)state;
    each_scene(3, mirror_both);
}

static double move_away(uint64_t *seed, double direction[3])
{
    (void)direction;
    double by[3];
    random_point(seed, 0, 30000, by);
    scene_move(&scene, 1, by);
    return 1;
}

static void moving_changes_nothing(void **state)
{
    (void)state;
    each_scene(3, move_away);
}

static double shuffle(uint64_t *seed, double direction[3])
{
    (void)direction;
    scene_shuffle(&scene, *seed);
    return 1;
}

static void shuffling_facets_changes_nothing(void **state)
{
    (void)state;
    each_scene(1, shuffle);
}

/* Every other facet in two, from a corner to the middle of the opposite side: T-junctions too. */
static double split(uint64_t *seed, double direction[3])
{
    (void)direction;
    uint32_t count = scene.scene.facet_count;
    for (uint32_t f = 0; f < count; f += 2) {
        uint32_t turn = random_below(seed, 3);
        uint32_t a = scene.facet[f].corner[turn];
        uint32_t b = scene.facet[f].corner[(turn + 1) % 3];
        uint32_t c = scene.facet[f].corner[(turn + 2) % 3];
        const double *p = scene.vertex[b].x;
        const double *q = scene.vertex[c].x;
        uint32_t middle =
            scene_vertex(&scene, 0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2]));
        scene.assigned = scene.material_of[f];
        scene.facet[f] = (lrcs_facet){{a, b, middle}};
        scene_facet(&scene, a, middle, c);
    }
    return 1;
}

static void splitting_facets_changes_nothing(void **state)
{
    (void)state;
    each_scene(1, split);
}

static double duplicate(uint64_t *seed, double direction[3])
{
    (void)seed;
    (void)direction;
    uint32_t count = scene.scene.facet_count;
    for (uint32_t f = 0; f < count; f += 3) {
        scene.assigned = scene.material_of[f];
        scene_facet(&scene, scene.facet[f].corner[1], scene.facet[f].corner[2],
                    scene.facet[f].corner[0]);
    }
    return 1;
}

static void duplicating_casters_changes_nothing(void **state)
{
    (void)state;
    each_scene(1, duplicate);
}

/* To the bit, with the square of the scale. */
static void scaling_by_powers_of_two_is_exact(void **state)
{
    (void)state;
    static const int power[] = {-240, -20, 20, 240};
    for (size_t kind = 0; kind < FAMILIES; kind++) {
        for (uint32_t number = 0; number < SCENES; number++) {
            double direction[3];
            lrcs_result one[METHODS];
            lrcs_result r[METHODS];
            int p = power[number % 4];
            make(kind, number, 3, direction);
            run_methods(direction, one);
            scene_move(&scene, ldexp(1, p), (const double[3]){0, 0, 0});
            run_methods(direction, r);
            for (int k = 0; k < METHODS; k++) {
                check_same(r[k].sigma_m2, ldexp(one[k].sigma_m2, 2 * p));
                check_same(r[k].sigma_glint_m2, ldexp(one[k].sigma_glint_m2, 2 * p));
                check_same(r[k].bound_m2, ldexp(one[k].bound_m2, 2 * p));
                check_same(r[k].projected_area_m2, ldexp(one[k].projected_area_m2, 2 * p));
                assert_int_equal(r[k].method, one[k].method);
                assert_int_equal(r[k].flags, one[k].flags);
            }
        }
    }
}

/* --- methods and areas ------------------------------------------------------------------------ */

static void methods_agree_at_ten_resolutions(void **state)
{
    (void)state;
    static const uint32_t size[] = {1, 2, 5, 16, 33, 64, 100, 127, 160, 200};
    for (size_t kind = 0; kind < FAMILIES; kind++) {
        for (uint32_t number = 0; number < SCENES; number++) {
            double direction[3];
            lrcs_work work;
            make(kind, number, 3, direction);
            const lrcs_prepared *p = scene_prepare(&scene, &work);
            lrcs_result exact = scene_pose(&scene, p, &work, direction, LRCS_METHOD_EXACT, 0);
            lrcs_result r = scene_pose(&scene, p, &work, direction, LRCS_METHOD_FACET, 0);
            check_overlap(&exact, &r, 1);
            r = scene_pose(&scene, p, &work, direction, LRCS_METHOD_AUTO, 0);
            check_overlap(&exact, &r, 1);
            for (int k = 0; k < 10; k++) {
                r = scene_pose(&scene, p, &work, direction, LRCS_METHOD_ZBUFFER, size[k]);
                check_overlap(&exact, &r, 1);
            }
        }
    }
}

/* What the contract says of each visible area, summed: 1e-12 of the facet's projected area and
   1e-15 of the extent squared. Records are those of the last run. */
static double areas_error(void)
{
    double extent = 0;
    double error = 0;
    for (uint32_t v = 0; v < scene.scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            extent = fmax(extent, fabs(scene.vertex[v].x[k] - scene.vertex[0].x[k]));
        }
    }
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        error += 1e-12 * scene.record[f].area_m2 * fabs(scene.record[f].cos_theta) +
                 1e-15 * extent * extent;
    }
    return error;
}

/* Other facets are seen from behind, but the silhouette is the same. */
static void silhouette_is_the_same_from_both_sides(void **state)
{
    (void)state;
    for (size_t kind = 0; kind < FAMILIES; kind++) {
        for (uint32_t number = 0; number < SCENES; number++) {
            double d[3];
            make(kind, number, 1, d);
            lrcs_result front = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
            double error = areas_error();
            double sum = scene_seen(&scene, 0, scene.scene.facet_count);
            check_rel(sum, front.projected_area_m2, 1e-14);
            lrcs_result back =
                scene_run(&scene, (const double[3]){-d[0], -d[1], -d[2]}, LRCS_METHOD_EXACT, 0);
            check_abs(back.projected_area_m2, front.projected_area_m2, 2 * error);
        }
    }
}

/* Boxes on a lattice of 16 x 16 x 16 seen along z: the highest top over each cell, by counting. */
enum { CELLS = 16, BOXES = 10 };

static void count_tops(uint32_t box[BOXES][6], uint32_t cells[BOXES])
{
    for (uint32_t x = 0; x < CELLS; x++) {
        for (uint32_t y = 0; y < CELLS; y++) {
            int best = -1;
            for (int b = 0; b < BOXES; b++) {
                const uint32_t *c = box[b];
                int over = x >= c[0] && x < c[3] && y >= c[1] && y < c[4];
                if (over && (best < 0 || c[5] > box[best][5])) {
                    best = b;
                }
            }
            if (best >= 0) {
                cells[best]++;
            }
        }
    }
}

static void visible_areas_of_boxes_are_those_counted_cell_by_cell(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int number = 0; number < 60; number++) {
        uint32_t box[BOXES][6];
        uint32_t cells[BOXES] = {0};
        double total = 0;
        scene_start(&scene);
        for (int b = 0; b < BOXES; b++) {
            for (int k = 0; k < 3; k++) {
                box[b][k] = random_below(&seed, CELLS - 1);
                box[b][k + 3] = box[b][k] + 1 + random_below(&seed, CELLS - 1 - box[b][k]);
            }
            scene_box(&scene, (const double[3]){box[b][0], box[b][1], box[b][2]},
                      (const double[3]){box[b][3], box[b][4], box[b][5]});
        }
        count_tops(box, cells);
        lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_EXACT, 0);
        for (uint32_t b = 0; b < BOXES; b++) {
            check_abs(scene_seen(&scene, 12 * b + 10, 2), cells[b], areas_error());
            total += cells[b];
        }
        check_rel(r.projected_area_m2, total, 1e-13);
        check_bound(r, (double)scene_eq2(&scene.material[0].brdf, total, 1));
        for (uint32_t size = 7; size < 200; size *= 3) {
            r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_ZBUFFER, size);
            check_bound(r, (double)scene_eq2(&scene.material[0].brdf, total, 1));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turning_mesh_and_laser_together_changes_nothing),
        cmocka_unit_test(mirroring_mesh_and_laser_together_changes_nothing),
        cmocka_unit_test(moving_changes_nothing),
        cmocka_unit_test(shuffling_facets_changes_nothing),
        cmocka_unit_test(splitting_facets_changes_nothing),
        cmocka_unit_test(duplicating_casters_changes_nothing),
        cmocka_unit_test(scaling_by_powers_of_two_is_exact),
        cmocka_unit_test(methods_agree_at_ten_resolutions),
        cmocka_unit_test(silhouette_is_the_same_from_both_sides),
        cmocka_unit_test(visible_areas_of_boxes_are_those_counted_cell_by_cell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
