/* SPDX-License-Identifier: MIT */
/* What the planner proves of a shape, and what it must refuse to prove. */
#include "scene/solid.h"

#include "backs.h"
#include "recipe.h"
#include "scenes.h"

static test_scene scene;
static lrcs_work work;

static void box(double x, double y, double z, double size)
{
    scene_box(&scene, (const double[3]){x, y, z}, (const double[3]){x + size, y + size, z + size});
}

static int is_solid(void)
{
    return scene_prepare(&scene, &work)->solid;
}

static int is_convex(void)
{
    return scene_prepare(&scene, &work)->convex;
}

static void closed_outward_pieces_are_solid(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    assert_true(is_solid());
    box(3, 0, 0, 1); /* apart */
    assert_true(is_solid());
    box(0.5, 0.5, 0.5, 1); /* through the first: winding numbers add */
    assert_true(is_solid());
    box(0.25, 0.25, 0.25, 0.125); /* within it */
    assert_true(is_solid());
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 16);
    assert_true(is_solid());
    scene_shuffle(&scene, 3);
    assert_true(is_solid());
    scene_move(&scene, 0x1p-60, (const double[3]){1e-10, 3, 0});
    assert_false(is_solid()); /* the move has rounded all volume away */
}

static void open_inverted_and_odd_shapes_are_not_proved_solid(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    scene.scene.facet_count--; /* a facet is missing */
    assert_false(is_solid());
    scene_start(&scene);
    box(0, 0, 0, 1);
    scene_invert(&scene, 0);
    assert_false(is_solid());
    scene_start(&scene);
    box(0, 0, 0, 1);
    scene_invert(&scene, 11); /* one facet */
    assert_false(is_solid());
    scene_start(&scene);
    box(0, 0, 0, 4);
    box(1, 1, 1, 1);
    scene_invert(&scene, 12); /* a cavity: sound, but its piece has no positive volume */
    assert_false(is_solid());
    scene_start(&scene);
    box(0, 0, 0, 1);
    scene_plate(&scene, (const double[3]){3, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    assert_false(is_solid());
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(1, 1, 0, 1); /* they share an edge: four facets on it */
    assert_false(is_solid());
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(0, 0, 0, 1); /* the same box twice */
    assert_false(is_solid());
}

/* A box whose top is drawn down through its bottom: closed, volume positive, winding -1 below. */
static void piece_that_passes_through_itself_is_not_proved_solid(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    scene.scene.facet_count -= 2;
    uint32_t tip = scene_vertex(&scene, 0.5, 0.5, -0.5);
    static const uint32_t ring[5] = {4, 5, 7, 6, 4};
    for (int i = 0; i < 4; i++) {
        scene_facet(&scene, ring[i], ring[i + 1], tip);
    }
    assert_false(is_solid());
    scene.vertex[tip].x[2] = 0.5; /* within: a dent */
    assert_true(is_solid());
}

/* The backs of solid shells are drawn too, and nothing is known to be convex. */
static void draw_all_backs(lrcs_prepared *prepared)
{
    scene_draw_all_backs(prepared);
    prepared->convex = 0;
}

/* Where winding is negative, a back side is seen: what the proof must never allow. */
static void facets_seen_from_behind_are_never_in_a_solid(void **state)
{
    (void)state;
    uint64_t seed = 5;
    int solid = 0;
    for (int n = 0; n < 300; n++) {
        scene_start(&scene);
        for (int i = 0; i < 3; i++) {
            uint32_t first = scene.scene.facet_count;
            box(random_below(&seed, 5), random_below(&seed, 5), random_below(&seed, 5),
                1 + random_below(&seed, 3));
            if (random_below(&seed, 6) == 0) {
                scene_invert(&scene, first);
            }
            if (random_below(&seed, 6) ==
                0) { /* a corner displaced, perhaps through the far side */
                scene.vertex[8 * (uint32_t)i].x[2] += random_below(&seed, 9);
            }
        }
        lrcs_prepared prepared = *scene_prepare(&scene, &work);
        solid += prepared.solid;
        if (prepared.solid) {
            draw_all_backs(&prepared); /* none may show */
            const double d[3] = {1 + random_below(&seed, 3), random_below(&seed, 4),
                                 random_below(&seed, 5)};
            lrcs_result r = scene_pose(&scene, &prepared, &work, d, LRCS_METHOD_EXACT, 0);
            check_most(r.back_side_area_m2, 1e-12);
        }
    }
    assert_true(solid > 20 && solid < 280);
}

/* Which boxes of a scene are marked as solid, a bit each; all facets of a box, or none. */
static unsigned solid_boxes(uint32_t boxes)
{
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    unsigned solid = 0;
    for (uint32_t f = 0; f < 12 * boxes; f++) {
        int marked = p->redundant[f] == LRCSI_REDUNDANT_IN_SOLID;
        assert_true(f % 12 == 0 || marked == (int)(solid >> f / 12 & 1));
        solid |= (unsigned)marked << f / 12;
    }
    return solid;
}

static void solid_shells_are_found_among_others(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(0.5, 0.5, 0.5, 1); /* through the first */
    scene_plate(&scene, (const double[3]){-1, 0.25, 0.25}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0}); /* open */
    assert_false(is_solid());
    assert_int_equal(solid_boxes(2), 3);
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(3, 0, 0, 1);
    scene_invert(&scene, 12); /* inward */
    assert_int_equal(solid_boxes(2), 1);
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(3, 0, 0, 1);
    box(4, 1, 0, 1); /* four facets on one edge */
    assert_int_equal(solid_boxes(3), 1);
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(0, 0, 0, 1); /* the same: the second is redundant, and so is the first in no view */
    box(3, 0, 0, 1);
    scene_invert(&scene, 24);
    assert_int_equal(solid_boxes(1), 1);
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(1, 0, 0, 1); /* a common face, which both have, in opposite senses */
    box(3, 0, 0, 1);
    assert_int_equal(solid_boxes(3), 4);
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(3, 0, 0, 1);
    scene.vertex[15].x[2] -= 2; /* a corner of the second drawn down through its bottom */
    assert_int_equal(solid_boxes(2), 1);
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(3, 0, 0, 1);
    lrcs_part part[2] = {scene.part, scene.part};
    part[0].facet_count = part[1].facet_count = part[1].first_facet = 12;
    part[1].bounds.patch = (lrcs_patch_bounds){0.1, 0.01, 0.01, 0.1};
    part[1].bounds.reach = 0.01; /* it passes for curved */
    for (int f = 12; f < 24; f++) {
        scene.part_of[f] = 1;
    }
    scene.scene.part = part;
    scene.scene.part_count = 2;
    assert_int_equal(solid_boxes(2), 1);
    assert_true(is_solid());
}

/* In scenes of which a part is solid, all that is visible is the same as if the backs of solid
   shells were drawn too, and these are not visible. */
static void backs_of_solid_shells_make_no_difference(void **state)
{
    (void)state;
    uint64_t seed = 11;
    int mixed = 0;
    for (int n = 0; n < 300; n++) {
        scene_start(&scene);
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t first = scene.scene.facet_count;
            box(random_below(&seed, 5), random_below(&seed, 5), random_below(&seed, 5),
                1 + random_below(&seed, 3));
            uint32_t what = (uint32_t)random_below(&seed, 8);
            if (what < 2) { /* two facets of it or all face the other way */
                scene_invert(&scene, what == 0 ? first : first + 10);
            } else if (what == 2) {
                scene.vertex[8 * i].x[2] += random_below(&seed, 9);
            } else if (what == 3) { /* open */
                scene.scene.facet_count = first + 10;
                scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 5, 2},
                               (const double[3]){5, random_below(&seed, 5), 1});
                scene_triangle(&scene, (const double[3]){0, 5, 0}, (const double[3]){1, 0, 5},
                               (const double[3]){5, random_below(&seed, 5), 5});
            }
        }
        lrcs_prepared prepared = *scene_prepare(&scene, &work);
        int solid = 0;
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            solid |= prepared.redundant[f] == LRCSI_REDUNDANT_IN_SOLID;
        }
        if (!solid || prepared.solid) {
            continue;
        }
        const double d[3] = {1 + random_below(&seed, 3), random_below(&seed, 4),
                             random_below(&seed, 5)};
        lrcs_result without = scene_pose(&scene, &prepared, &work, d, LRCS_METHOD_EXACT, 0);
        draw_all_backs(&prepared);
        lrcs_result with = scene_pose(&scene, &prepared, &work, d, LRCS_METHOD_EXACT, 0);
        check_most(fabs(with.sigma_m2 - without.sigma_m2), with.bound_m2 + without.bound_m2);
        check_most(fabs(with.back_side_area_m2 - without.back_side_area_m2), 1e-12);
        check_most(fabs(with.projected_area_m2 - without.projected_area_m2), 1e-12);
        mixed++;
    }
    assert_true(mixed > 50);
}

/* A two-sided box beside a two-sided open cylinder: what rounding the cylinder may do to the backs
   of the box is no part of the bound. */
static void backs_of_solid_shells_add_nothing_to_bounds(void **state)
{
    (void)state;
    lrcs_recipe_part part[2];
    lrcs_recipe_material material[2];
    lrcs_recipe recipe = recipe_bright_and_black(&(lrcs_brdf){0.1, 0.2, 0.4, 0.5}, part, material);
    material[0].two_sided = 1;
    recipe.material_count = 1;
    part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {0.5, 0.5, 0.25}};
    part[0].place.translate[0] = 0.5;
    part[0].place.translate[2] = 1;
    part[1].shape = (lrcs_shape){
        .kind = LRCS_SHAPE_CYLINDER, .parts = LRCS_SHAPE_WALL, .radius = 0.7, .length = 0.5};
    part[1].place.translate[2] = 0.6;
    part[1].material = part[0].material;
    part[1].material_index = 0;
    lrcs_scene built;
    const lrcs_build_options build = lrcs_build_options_default();
    lrcs_prepared marked = *recipe_prepare(&recipe, NULL, &build, &built, &work);
    lrcs_prepared all = marked;
    static unsigned char redundant[4096];
    assert_true(built.facet_count <= sizeof redundant);
    memcpy(redundant, marked.redundant, built.facet_count);
    all.redundant = redundant;
    draw_all_backs(&all);
    const lrcs_run_options options = {.tolerance = 1e-2, .method = LRCS_METHOD_EXACT};
    uint64_t seed = 3;
    int smaller = 0;
    for (int n = 0; n < 60; n++) {
        lrcs_pose pose;
        lrcs_result result[2];
        const double d[3] = {random_unit(&seed) - 0.5, random_unit(&seed) - 0.5,
                             random_unit(&seed) - 0.5};
        assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(lrcs_sigma_run(i == 0 ? &marked : &all, &pose, &options, &work,
                                            &result[i], NULL, NULL),
                             LRCS_OK);
        }
        check_most(fabs(result[0].sigma_m2 - result[1].sigma_m2),
                   result[0].bound_m2 + result[1].bound_m2);
        check_most(result[0].bound_m2, result[1].bound_m2 * (1 + 1e-9));
        smaller += result[0].bound_m2 < 0.9 * result[1].bound_m2;
    }
    assert_true(smaller > 10);
}

static void convex_meshes_are_proved_convex(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    assert_true(is_convex());
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){0, 1, 0},
                   (const double[3]){1, 0, 0});
    uint32_t tip = scene_vertex(&scene, 0, 0, 1);
    scene_facet(&scene, 0, 2, tip);
    scene_facet(&scene, 2, 1, tip);
    scene_facet(&scene, 1, 0, tip);
    assert_true(is_convex());
}

static void shapes_with_a_hollow_are_not_proved_convex(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    scene.vertex[7].x[0] -= 0x1p-50; /* no longer planar: one of the diagonals is a valley */
    uint32_t convex = (uint32_t)is_convex();
    scene.vertex[7].x[0] += 0x1p-49;
    convex += (uint32_t)is_convex();
    assert_true(convex < 2);
    scene_start(&scene); /* an L */
    static const double l[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (int z = 0; z < 2; z++) {
        for (int i = 0; i < 6; i++) {
            scene_vertex(&scene, l[i][0], l[i][1], z);
        }
    }
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t j = (i + 1) % 6;
        scene_facet(&scene, i, j, 6 + j);
        scene_facet(&scene, i, 6 + j, 6 + i);
    }
    static const uint32_t top[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    for (int i = 0; i < 4; i++) {
        scene_facet(&scene, 6 + top[i][0], 6 + top[i][1], 6 + top[i][2]);
        scene_facet(&scene, top[i][0], top[i][2], top[i][1]);
    }
    assert_true(is_solid());
    assert_false(is_convex());
    scene_start(&scene); /* a dented sphere */
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 16);
    scene.vertex[40].x[0] *= 0.99;
    scene.vertex[40].x[1] *= 0.99;
    assert_true(is_solid());
    assert_false(is_convex());
    scene_start(&scene); /* two boxes */
    box(0, 0, 0, 1);
    box(2, 0, 0, 1);
    assert_false(is_convex());
    scene_start(&scene); /* the inside of a box */
    box(0, 0, 0, 1);
    scene_invert(&scene, 0);
    assert_false(is_convex());
    scene_start(&scene); /* a plate from a file: open */
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    assert_false(is_convex());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_outward_pieces_are_solid),
        cmocka_unit_test(open_inverted_and_odd_shapes_are_not_proved_solid),
        cmocka_unit_test(piece_that_passes_through_itself_is_not_proved_solid),
        cmocka_unit_test(facets_seen_from_behind_are_never_in_a_solid),
        cmocka_unit_test(solid_shells_are_found_among_others),
        cmocka_unit_test(backs_of_solid_shells_make_no_difference),
        cmocka_unit_test(backs_of_solid_shells_add_nothing_to_bounds),
        cmocka_unit_test(convex_meshes_are_proved_convex),
        cmocka_unit_test(shapes_with_a_hollow_are_not_proved_convex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
