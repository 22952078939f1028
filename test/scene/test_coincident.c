/* SPDX-License-Identifier: MIT */
/* Facets in the same place: one is seen, as the tie is decided, and the others cost nothing. */
#include "scene/coincident.h"

#include <lrcs/polygon.h>

#include "backs.h"
#include "scenes.h"
#include "visibility/uniform/classify.h"

static test_scene scene;
static test_scene reference;

/* The triangle 0 0 0, 1 0 0, 0 1 0, its corners turned round, on vertices of its own. */
static uint32_t add_copy(uint32_t turn, int back)
{
    static const double corner[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    uint32_t f =
        scene_triangle(&scene, corner[turn % 3], corner[(turn + 1) % 3], corner[(turn + 2) % 3]);
    if (back) {
        scene_invert(&scene, f);
    }
    return f;
}

/* Two materials that differ, the second of two sides; copies of either, either way round. */
static void random_copies(uint64_t *seed, uint32_t count)
{
    scene_start(&scene);
    scene_material(&scene, 1, 0.5, 0.3, 1);
    scene_material(&scene, 0, 0.7, 0.2, 2)->two_sided = 1;
    scene_material(&scene, 3, 1, 0.2, 2)->omitted = 1;
    for (uint32_t i = 0; i < count; i++) {
        scene.assigned = random_below(seed, 4);
        add_copy(random_below(seed, 3), (int)random_below(seed, 2));
    }
}

/* Which of them is seen from z > 0 (side 1) or z < 0 (-1): a front, else a back that reflects, else
   any; of equals the first. LRCS_NONE: all are omitted. */
static uint32_t who_is_seen(int side)
{
    uint32_t best = LRCS_NONE;
    int rank = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const lrcs_material *material = &scene.material[scene.material_of[f]];
        const lrcs_point *v = scene.vertex;
        const uint32_t *c = scene.facet[f].corner;
        double up = (v[c[1]].x[0] - v[c[0]].x[0]) * (v[c[2]].x[1] - v[c[0]].x[1]) -
                    (v[c[1]].x[1] - v[c[0]].x[1]) * (v[c[2]].x[0] - v[c[0]].x[0]);
        int of_f = up * side > 0 ? 3 : material->two_sided ? 2 : 1;
        if (!material->omitted && of_f > rank) {
            rank = of_f;
            best = f;
        }
    }
    return best;
}

static void one_is_seen_as_the_tie_is_decided_by_every_method(void **state)
{
    (void)state;
    static const int methods[] = {LRCS_METHOD_AUTO, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT};
    uint64_t seed = 5;
    for (uint32_t i = 0; i < 600; i++) {
        random_copies(&seed, 1 + i % 9);
        int side = i % 2 ? 1 : -1;
        uint32_t seen = who_is_seen(side);
        lrcs_result r = scene_run(&scene, (const double[3]){0, 0, side}, methods[i % 3], 16);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            check_abs(scene.record[f].visible_area_m2, f == seen ? 0.5 : 0, 1e-14);
            check_abs(scene.record[f].sigma_m2, f == seen ? r.sigma_m2 : 0, 1e-14);
        }
        check_abs(r.projected_area_m2, seen == LRCS_NONE ? 0 : 0.5, 1e-14);
        if (r.method == LRCS_METHOD_EXACT) { /* pixels are left unsure of what is hidden */
            check_most(r.bound_m2, 1e-9 * (r.sigma_m2 + 1e-6));
        }
    }
}

static void copies_are_recorded_as_hidden_facets(void **state)
{
    (void)state;
    scene_start(&scene);
    for (uint32_t i = 0; i < 100; i++) {
        add_copy(i, 0);
    }
    lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_EXACT, 0);
    assert_int_equal(r.facets_front, 100);
    assert_int_equal(r.facets_hidden, 99);
    for (uint32_t f = 0; f < 100; f++) {
        check_same(scene.record[f].area_m2, 0.5);
        check_same(scene.record[f].cos_theta, 1);
    }
}

/* Symptom: a thousand facets in one place took seconds, ten thousand hours: each was compared with
   all others. Now at most two take part: two of one winding, or one of each. */
static void any_number_of_copies_is_the_work_of_one(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int both = 0; both < 2; both++) {
        random_copies(&seed, 2000);
        for (uint32_t f = 0; f < 2000 && !both; f++) { /* as the first is wound */
            scene.facet[f] = scene.facet[0];
        }
        lrcs_work work;
        lrcs_pose pose;
        lrcsi_view view;
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        assert_int_equal(p->intersections.first[2000],
                         both ? 0 : 2); /* opposite facets have no contact */
        assert_int_equal(lrcs_pose_from_direction((const double[3]){0.1, 0.2, 1}, &pose), LRCS_OK);
        assert_int_equal(lrcsi_view_make(p, &pose, &work, &view), LRCS_OK);
        uint32_t cast = 0;
        for (uint32_t f = 0; f < 2000; f++) {
            cast += lrcsi_view_casts(&view, f) != 0;
        }
        assert_int_equal(cast, both ? 1 : 2);
    }
}

/* Sides of two faces of a panel that are the same edge have the same mark, wherever their corners
   begin; the panel's side from (0, 0) to (1, 0) overlaps a longer side of another facet. */
static void both_faces_of_a_panel_mark_the_same_sides(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 9; turn++) {
        lrcs_work work;
        scene_start(&scene);
        add_copy(turn % 3, 0);
        scene_triangle(&scene, (const double[3]){-1, 0, 0}, (const double[3]){2, 0, 0},
                       (const double[3]){0, 0, 1});
        add_copy(turn / 3, 1);
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        assert_int_equal(p->opposite[2], 0);
        uint32_t marked = 0;
        for (uint32_t f = 0; f < 3; f += 2) {
            for (int k = 0; k < 3; k++) {
                const uint32_t *corner = scene.facet[f].corner;
                int level = scene.vertex[corner[k]].x[1] == 0 &&
                            scene.vertex[corner[(k + 1) % 3]].x[1] == 0;
                assert_int_equal(lrcsi_intersection_along(&p->intersections, f, k), level);
                marked += level != 0;
            }
        }
        assert_int_equal(marked, 2);
    }
}

/* A sphere's facets and a mesh's in one place: the true sphere bulges, and may hide the mesh. */
static void facets_of_curved_shapes_are_no_copies(void **state)
{
    (void)state;
    for (int reach = 0; reach < 2; reach++) {
        lrcs_work work;
        scene_start(&scene);
        scene.part.bounds.reach = 0.01 * reach;
        add_copy(0, 0);
        add_copy(1, 0);
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        assert_int_equal(p->redundant[0], LRCSI_NOT_REDUNDANT);
        assert_int_equal(p->redundant[1], reach ? LRCSI_NOT_REDUNDANT : LRCSI_REDUNDANT);
        add_copy(2, 1);
        p = scene_prepare(&scene, &work);
        assert_int_equal(p->opposite != NULL, !reach);
    }
}

/* --- opposite pairs --------------------------------------------------------------------------- */

/* Plates, boxes and a polyhedron on a lattice: they touch, pierce each other, and lie in one plane
   in part. */
static void random_bodies(uint64_t *seed)
{
    scene_start(&scene);
    scene_material(&scene, 0.3, 0.5, 0.3, 1);
    scene_material(&scene, 0, 0.7, 0.2, 2)->two_sided = 1;
    for (uint32_t i = 0; i < 6; i++) {
        double at[3];
        double far[3];
        scene.assigned = random_below(seed, 3);
        for (int k = 0; k < 3; k++) {
            at[k] = 0.25 * random_below(seed, 9);
            far[k] = at[k] + 0.25 * (1 + random_below(seed, 4));
        }
        if (i == 0) {
            scene_sphere(&scene, at, 0.6, 8);
        } else if (random_below(seed, 2)) {
            scene_box(&scene, at, far);
        } else {
            scene_plate(&scene, at, (const double[3]){far[0] - at[0], 0, 0.25},
                        (const double[3]){0, far[1] - at[1], 0});
        }
    }
}

/* Stores facets once more, from another corner and on points of their own, wound the other way: all
   of them, or about half; in another material, in another order. */
static void store_twice(uint64_t *seed, int all)
{
    for (uint32_t f = 0, count = scene.scene.facet_count; f < count; f++) {
        if (all || random_below(seed, 2)) {
            const uint32_t *c = scene.facet[f].corner;
            uint32_t turn = random_below(seed, 3);
            lrcs_point p[3] = {scene.vertex[c[turn]], scene.vertex[c[(turn + 2) % 3]],
                               scene.vertex[c[(turn + 1) % 3]]};
            scene.assigned = random_below(seed, 3);
            scene_triangle(&scene, p[0].x, p[1].x, p[2].x);
        }
    }
    scene_shuffle(&scene, *seed);
}

/* Are they on the same points? */
static int same_place(const test_scene *s, uint32_t f, uint32_t g)
{
    int same = 0;
    for (int i = 0; i < 9; i++) {
        same += memcmp(&s->vertex[s->facet[f].corner[i / 3]], &s->vertex[s->facet[g].corner[i % 3]],
                       sizeof(lrcs_point)) == 0;
    }
    return same == 3;
}

/* The scene without those of an opposite pair that face away, as their recorded cosines say.
   Returned: place[facet], where it stands in the reference, or LRCS_NONE. */
static void keep_what_faces_the_laser(uint32_t *place)
{
    reference = scene;
    reference.scene.facet_count = 0;
    reference.scene.vertex = reference.vertex;
    reference.scene.facet = reference.facet;
    reference.scene.facet_material = reference.material_of;
    reference.scene.facet_part = reference.part_of;
    reference.scene.facet_smooth = reference.smooth_of;
    reference.scene.material = reference.material;
    reference.scene.part = &reference.part;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        int pairs = 0;
        for (uint32_t g = 0; g < scene.scene.facet_count; g++) {
            pairs |= g != f && same_place(&scene, f, g) &&
                     scene.record[f].cos_theta * scene.record[g].cos_theta < 0;
        }
        place[f] = LRCS_NONE;
        if (!pairs || scene.record[f].cos_theta > 0) {
            place[f] = reference.scene.facet_count++;
            reference.facet[place[f]] = scene.facet[f];
            reference.material_of[place[f]] = scene.material_of[f];
        }
    }
    reference.part.facet_count = reference.scene.facet_count;
}

static void twins_are_seen_as_the_side_that_faces_the_laser(void **state)
{
    (void)state;
    static uint32_t place[SCENE_FACETS];
    uint64_t seed = 11;
    double hidden = 0;
    for (uint32_t i = 0; i < 60; i++) {
        random_bodies(&seed);
        store_twice(&seed, i % 2 != 0);
        double d[3];
        for (int k = 0; k < 3; k++) {
            d[k] = i % 5 == 0 ? random_below(&seed, 2) : random_below(&seed, 1000) / 500.0 - 1;
        }
        d[2] += d[0] == 0 && d[1] == 0 && d[2] == 0;
        for (int m = 0; m < 3; m++) {
            static const int methods[] = {LRCS_METHOD_EXACT, LRCS_METHOD_ZBUFFER,
                                          LRCS_METHOD_FACET};
            lrcs_result twice = scene_run(&scene, d, methods[m], 61);
            keep_what_faces_the_laser(place);
            lrcs_result once = scene_run(&reference, d, methods[m], 61);
            check_abs(twice.sigma_m2, once.sigma_m2, 1e-12 * once.sigma_m2);
            check_abs(twice.projected_area_m2, once.projected_area_m2,
                      1e-12 * once.projected_area_m2);
            check_abs(twice.bound_m2, once.bound_m2, 0.05 * once.bound_m2);
            assert_int_equal(twice.facets_partial, once.facets_partial);
            assert_int_equal(twice.back_side_facets, once.back_side_facets);
            for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
                const lrcs_facet_record none = {0};
                const lrcs_facet_record *r = &scene.record[f];
                const lrcs_facet_record *want =
                    place[f] == LRCS_NONE ? &none : &reference.record[place[f]];
                check_abs(r->visible_area_m2, want->visible_area_m2, 1e-12);
                check_abs(r->sigma_m2, want->sigma_m2, 1e-11);
                assert_true(r->area_m2 > 0);
            }
            hidden += once.facets_hidden + once.facets_partial;
        }
    }
    assert_true(hidden > 1000);
}

/* Steps are what exact visibility spends its time on. Each panel has one contour, not three. */
static void twins_cost_what_one_of_them_costs(void **state)
{
    (void)state;
    uint64_t seed = 21;
    lrcs_work work;
    lrcs_pose pose;
    const double d[3] = {0.3, -0.5, 0.7};
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    for (uint32_t i = 0; i < 10; i++) {
        uint32_t events[2];
        uint32_t undecided[2];
        uint64_t steps[2];
        for (int doubled = 0; doubled < 2; doubled++) {
            uint64_t again = seed + i;
            lrcsi_view view;
            lrcsi_classification classification;
            random_bodies(&again);
            if (doubled) {
                store_twice(&again, 1);
            }
            lrcs_prepared p = *scene_prepare(&scene, &work);
            scene_draw_all_backs(&p); /* stored twice, no shell is solid */
            steps[doubled] = scene_pose(&scene, &p, &work, d, LRCS_METHOD_EXACT, 0).steps;
            assert_int_equal(lrcsi_view_make(&p, &pose, &work, &view), LRCS_OK);
            assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
            events[doubled] = classification.events.count;
            undecided[doubled] = classification.undecided_count;
        }
        assert_int_equal(events[1], events[0]);
        assert_int_equal(undecided[1], undecided[0]);
        check_most((double)steps[1], 1.3 * (double)steps[0]);
    }
}

/* Pictures and polygons name the facets that face the laser. */
static void twins_own_pixels_and_rings_by_the_side_that_faces_the_laser(void **state)
{
    (void)state;
    static uint32_t owner[64 * 64];
    uint64_t seed = 31;
    random_bodies(&seed);
    store_twice(&seed, 1);
    lrcs_work work;
    lrcs_pose pose;
    lrcs_result result;
    lrcs_polygons polygons;
    lrcs_image image = {.size = 64, .facet = owner};
    lrcs_run_options options = {.tolerance = 1e-4, .method = LRCS_METHOD_EXACT};
    assert_int_equal(lrcs_pose_from_direction((const double[3]){1, 2, -3}, &pose), LRCS_OK);
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_sigma_run(p, &pose, &options, &work, &result, scene.record, &image),
                     LRCS_OK);
    uint32_t owned = 0;
    for (uint32_t i = 0; i < 64 * 64; i++) {
        if (owner[i] != LRCS_NONE) {
            assert_true(scene.record[owner[i]].cos_theta > 0);
            owned++;
        }
    }
    assert_true(owned > 500);
    assert_int_equal(lrcs_polygon_run(p, &pose, &work, &polygons), LRCS_OK);
    assert_true(polygons.rings > 20);
    for (uint32_t i = 0; i < polygons.rings; i++) {
        assert_true(scene.record[polygons.ring[i].facet].cos_theta > 0);
    }
}

/* What the contacts of facets stored twice are, against those of the facets stored once: between
   all sides of the one and of the other. */
static void twins_have_the_contacts_of_both_sides(void **state)
{
    (void)state;
    uint64_t seed = 41;
    uint32_t met = 0;
    uint32_t marked = 0;
    for (uint32_t i = 0; i < 20; i++) {
        lrcs_work work;
        random_bodies(&seed);
        store_twice(&seed, 0);
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            for (uint32_t g = 0; g < scene.scene.facet_count; g++) {
                uint32_t listed = 0;
                for (uint32_t k = p->intersections.first[f]; k < p->intersections.first[f + 1];
                     k++) {
                    listed += p->intersections.entry[k].other == g;
                }
                int live = p->redundant[f] != LRCSI_REDUNDANT && p->redundant[g] != LRCSI_REDUNDANT;
                int want = g != f && live && !(p->opposite && p->opposite[f] == g) &&
                           lrcsi_intersection_pair(p->vertex, scene.facet[f], scene.facet[g]) !=
                               LRCSI_INTERSECTION_NONE;
                assert_int_equal(listed, want);
                met += listed;
            }
            if (p->opposite && p->opposite[f] != LRCS_NONE) {
                uint32_t o = p->opposite[f];
                assert_int_equal(p->intersections.met[f] != 0, p->intersections.met[o] != 0);
                for (int k = 0; k < 9; k++) { /* sides that are the same edge have the same mark */
                    if (p->topology.facet_edge[f].corner[k / 3] ==
                        p->topology.facet_edge[o].corner[k % 3]) {
                        assert_int_equal(lrcsi_intersection_along(&p->intersections, f, k / 3),
                                         lrcsi_intersection_along(&p->intersections, o, k % 3));
                        marked += lrcsi_intersection_along(&p->intersections, f, k / 3) != 0;
                    }
                }
                assert_int_equal(p->opposite[p->opposite[f]], f);
            }
        }
    }
    assert_true(met > 500);
    assert_true(marked > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_is_seen_as_the_tie_is_decided_by_every_method),
        cmocka_unit_test(copies_are_recorded_as_hidden_facets),
        cmocka_unit_test(any_number_of_copies_is_the_work_of_one),
        cmocka_unit_test(both_faces_of_a_panel_mark_the_same_sides),
        cmocka_unit_test(facets_of_curved_shapes_are_no_copies),
        cmocka_unit_test(twins_are_seen_as_the_side_that_faces_the_laser),
        cmocka_unit_test(twins_cost_what_one_of_them_costs),
        cmocka_unit_test(twins_own_pixels_and_rings_by_the_side_that_faces_the_laser),
        cmocka_unit_test(twins_have_the_contacts_of_both_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
