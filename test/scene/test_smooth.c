/* SPDX-License-Identifier: MIT */
/* Normals at corners, from vertex normals and smoothing groups, against what the rules of the
   formats make of bodies whose normals are known. */
#include "scene/build/smooth.h"

#include "curved.h"

static char text[CURVED_TEXT];

static const double *normal_of(const curved_case *c, uint32_t facet, uint32_t k)
{
    return c->scene.corner_normal[3 * facet + k].x;
}

static void check_normal(const curved_case *c, uint32_t facet, uint32_t k, double x, double y,
                         double z, double most)
{
    const double *n = normal_of(c, facet, k);
    double length = sqrt(x * x + y * y + z * z);
    check_abs(n[0], x / length, most);
    check_abs(n[1], y / length, most);
    check_abs(n[2], z / length, most);
}

static int is_flat(const curved_case *c, uint32_t facet)
{
    const double *n = c->scene.corner_normal ? normal_of(c, facet, 0) : NULL;
    return !n || (n[0] == 0 && n[1] == 0 && n[2] == 0);
}

/* The wall's normals at every corner are radial. */
static void check_radial(const curved_case *c, uint32_t facets, double most)
{
    for (uint32_t f = 0; f < facets; f++) {
        for (uint32_t k = 0; k < 3; k++) {
            const double *x = c->scene.vertex[c->scene.facet[f].corner[k]].x;
            check_normal(c, f, k, x[0], x[1], 0, most);
        }
    }
}

static void a_cylinder_has_radial_normals_from_either_kind_of_data(void **state)
{
    (void)state;
    for (int form = 0; form < 2; form++) {
        curved_cylinder(text, 12, 0.5, 2, form ? 'v' : 's');
        curved_case c = curved_obj(text);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        assert_int_equal(c.scene.facet_count, 24 + 20);
        check_radial(&c, 24, 4e-16);
        for (uint32_t f = 24; f < c.scene.facet_count; f++) {
            assert_true(is_flat(&c, f));
        }
        curved_free(&c);
    }
}

/* A cube, every side split along either diagonal; sides in a group each, or all in one. */
static void cube_text(int diagonals, int one_group)
{
    static const int quad[6][4] = {{1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5},
                                   {3, 7, 8, 4}, {1, 3, 4, 2}, {5, 6, 8, 7}};
    text[0] = '\0';
    for (int i = 0; i < 8; i++) {
        curved_line(text, "v %d %d %d", i & 1, i >> 1 & 1, i >> 2);
    }
    for (int i = 0; i < 6; i++) {
        int from = diagonals >> i & 1;
        curved_line(text, "s %d\nf %d %d %d %d", one_group ? 1 : i + 1, quad[i][from],
                    quad[i][(from + 1) % 4], quad[i][(from + 2) % 4], quad[i][(from + 3) % 4]);
    }
}

static void a_cube_is_hard_where_its_groups_meet(void **state)
{
    (void)state;
    cube_text(0, 0);
    curved_case c = curved_obj(text);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    assert_null(c.scene.corner_normal);
    curved_free(&c);
}

/* Each corner of a cube in one group has the diagonal for its normal, however its sides are split.
 */
static void the_split_of_a_flat_side_changes_no_normal(void **state)
{
    (void)state;
    for (int diagonals = 0; diagonals < 64; diagonals += 7) {
        cube_text(diagonals, 1);
        curved_case c = curved_obj(text);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        for (uint32_t f = 0; f < 12; f++) {
            for (uint32_t k = 0; k < 3; k++) {
                const double *x = c.scene.vertex[c.scene.facet[f].corner[k]].x;
                check_normal(&c, f, k, x[0] - 0.5, x[1] - 0.5, x[2] - 0.5, 4e-16);
            }
        }
        curved_free(&c);
    }
}

/* Two squares at a right angle over the y axis; each facet's group as given, edge vertices shared
   or doubled. */
static void roof_text(const char *left, const char *right, int doubled)
{
    text[0] = '\0';
    curved_line(text,
                "v 0 0 0\nv 0 1 0\nv -1 0 -1\nv -1 1 -1\nv 1 0 -1\nv 1 1 -1\nv 0 0 0\nv 0 1 0");
    curved_line(text, "%s\nf 1 2 4 3\n%s\n%s", left, right, doubled ? "f 8 7 5 6" : "f 2 1 5 6");
}

static void groups_are_shared_by_bit_and_by_vertex_index_only(void **state)
{
    (void)state;
    static const struct {
        const char *left, *right;
        int doubled, shared;
    } row[] = {{"s 1", "s 1", 0, 1}, {"s 1", "s 2", 0, 0},  {"s 1", "s off", 0, 0},
               {"s 1", "s 1", 1, 0}, {"s 33", "s 1", 0, 1}, {"s off", "s off", 0, 0}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        roof_text(row[i].left, row[i].right, row[i].doubled);
        curved_case c = curved_obj(text);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        assert_int_equal(c.scene.corner_normal != NULL, row[i].shared);
        if (row[i].shared) {
            check_normal(&c, 0, 0, 0, 0, 1, 4e-16);  /* on the ridge */
            check_normal(&c, 0, 2, -1, 0, 1, 4e-16); /* at the eaves: the side's own */
        }
        curved_free(&c);
    }
}

/* An ellipsoid of half axes (3, 1, 1) as a sphere's octant, stretched by its place. */
static void vertex_normals_go_with_the_inverse_transpose(void **state)
{
    (void)state;
    static const double scale[3][3] = {{3, 1, 1}, {3, 1, -1}, {-3, -1, -1}};
    for (int i = 0; i < 3; i++) {
        curved_case c = curved_obj("v 1 0 0\nv 0.6 0.8 0\nv 0.6 0 0.8\nvn 1 0 0\nvn 0.6 0.8 0\n"
                                   "vn 0.6 0 0.8\nf 1//1 2//2 3//3\n");
        for (int k = 0; k < 3; k++) {
            c.place.scale[k] = scale[i][k];
        }
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        for (uint32_t k = 0; k < 3; k++) { /* the gradient of (x/3)^2 + y^2 + z^2 */
            const double *x = c.scene.vertex[c.scene.facet[0].corner[k]].x;
            check_normal(&c, 0, k, x[0] / 9, x[1], x[2], 4e-16);
        }
        curved_free(&c);
    }
}

static void normals_turn_with_place_and_joint(void **state)
{
    (void)state;
    curved_cylinder(text, 12, 0.5, 2, 'v');
    curved_case c = curved_obj(text);
    static const double turn[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}; /* 90 deg about z */
    memcpy(c.place.rotate, turn, sizeof turn);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_radial(&c, 24, 4e-16);
    c.joint = (lrcs_joint){1, {0, 0, 1}, {0, 0, 3}, 90};
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_radial(&c, 24, 4e-16);
    curved_free(&c);
}

static void normals_that_all_point_behind_are_turned_round(void **state)
{
    (void)state;
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.1 0 -1\nvn 0 0.1 -1\nvn 0 0 -1\n"
                               "f 1//1 2//2 3//3\n");
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_normal(&c, 0, 0, -0.1, 0, 1, 4e-16);
    check_normal(&c, 0, 1, 0, -0.1, 1, 4e-16);
    check_normal(&c, 0, 2, 0, 0, 1, 0);
    curved_free(&c);
}

static void a_normal_that_points_behind_or_nowhere_gives_way_to_the_facets_own(void **state)
{
    (void)state;
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.1 0 1\nvn 0 0.1 -1\nvn 0 0 0\n"
                               "f 1//1 2//2 3//3\n");
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_normal(&c, 0, 0, 0.1, 0, 1, 4e-16);
    check_normal(&c, 0, 1, 0, 0, 1, 0);
    check_normal(&c, 0, 2, 0, 0, 1, 0);
    curved_free(&c);
}

/* Both skins of a panel, on the same vertices and in one group: their normals cancel. */
static void skins_that_share_vertices_stay_flat(void **state)
{
    (void)state;
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 1 1 0.2\nv 0 1 0\ns 1\nf 1 2 3\nf 1 3 2\n"
                               "f 1 3 4\nf 1 4 3\n");
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    assert_null(c.scene.corner_normal);
    curved_free(&c);
}

static void degenerate_facets_disturb_no_normal(void **state)
{
    (void)state;
    roof_text("s 1", "s 1", 0);
    strcat(text, "f 1 2 2\nf 1 1 1\nf 1 2 1\n");
    curved_case c = curved_obj(text);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_normal(&c, 0, 0, 0, 0, 1, 4e-16);
    assert_true(is_flat(&c, 4) && is_flat(&c, 5) && is_flat(&c, 6));
    curved_free(&c);
}

/* 24 sides turn by 15 deg each: too far for s = 0.05, nothing to s = 1 but for the chords. */
static void auto_asks_what_the_glint_calls_for(void **state)
{
    (void)state;
    static const struct {
        double A, s, tolerance;
        int curved;
    } row[] = {{1, 0.05, 1e-2, 1}, {1, 1.0, 1e-2, 0}, {1, 1.0, 1e-4, 1}, {0, 0.05, 1e-9, 0}};
    curved_cylinder(text, 24, 0.5, 2, 's');
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        curved_case c = curved_obj(text);
        c.brdf = (lrcs_brdf){row[i].A, 0.25, row[i].s, 0.5};
        c.tolerance = row[i].tolerance;
        curved_build(&c, LRCS_NORMALS_AUTO);
        assert_int_equal(c.scene.corner_normal != NULL, row[i].curved);
        assert_int_equal(c.scene.normals, LRCS_NORMALS_AUTO);
        curved_free(&c);
    }
}

static void the_hash_tells_curved_from_flat(void **state)
{
    (void)state;
    uint64_t hash[4];
    for (int i = 0; i < 4; i++) {
        curved_cylinder(text, 24, 0.5, 2, i < 2 ? 'v' : 'f');
        curved_case c = curved_obj(text);
        curved_build(&c, i % 2 ? LRCS_NORMALS_SMOOTH : LRCS_NORMALS_FLAT);
        hash[i] = lrcs_scene_hash(&c.scene);
        curved_free(&c);
    }
    assert_true(hash[0] != hash[1]);
    assert_true(hash[0] == hash[2] && hash[2] == hash[3]);
}

static void too_small_an_area_is_refused_until_it_suffices(void **state)
{
    (void)state;
    curved_cylinder(text, 8, 0.5, 2, 's');
    curved_case c = curved_obj(text);
    lrcs_recipe_part part = {.name = "m", .file = "m", .place = c.place, .material_index = -1};
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_build_options options = {1e-4, 64, LRCS_NORMALS_SMOOTH, 1, 0, NULL};
    size_t need = lrcs_scene_need(&recipe, &c.mesh, &options);
    int status = LRCS_E_MEMORY;
    size_t size = 0;
    for (; status != LRCS_OK && size <= need; size++) {
        void *area = malloc(size + 1);
        lrcs_work work = lrcs_work_make(area, size);
        lrcs_scene scene;
        status = lrcs_scene_build(&recipe, &c.mesh, &options, &work, &scene, NULL);
        assert_true(status == LRCS_OK || (status == LRCS_E_MEMORY && work.used == 0));
        free(area);
    }
    assert_int_equal(status, LRCS_OK);
    assert_true(size > need / 2);
    curved_free(&c);
}

static void a_normal_that_the_mesh_does_not_have_is_refused(void **state)
{
    (void)state;
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.1 1\nf 1//1 2//1 3//1\n");
    c.mesh.facet_normal[0].corner[1] = 1;
    lrcs_recipe_part part = {.name = "m", .file = "m", .place = c.place, .material_index = -1};
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_build_options options = {1e-4, 64, LRCS_NORMALS_SMOOTH, 1, 0, NULL};
    unsigned char area[4096];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_scene scene;
    assert_int_equal(lrcs_scene_build(&recipe, &c.mesh, &options, &work, &scene, NULL),
                     LRCS_E_INDEX);
    curved_free(&c);
}

static void names_and_kinds_of_normals_go_both_ways(void **state)
{
    (void)state;
    for (int i = LRCS_NORMALS_FLAT; i <= LRCS_NORMALS_SMOOTH; i++) {
        assert_int_equal(lrcs_normals_find(lrcs_normals_text(i)), i);
    }
    assert_int_equal(lrcs_normals_find("round"), LRCS_E_NAME);
    assert_null(lrcs_normals_text(3));
    assert_null(lrcs_normals_text(-1));
}

/* The left one has 135 deg at the first vertex, the right one 45: their normals count so. */
static void facets_count_by_their_angle_at_the_vertex(void **state)
{
    (void)state;
    curved_case c = curved_obj("v 0 0 0\nv 0 1 0\nv -1 -1 0\nv 0 1 -1\ns 1\nf 1 2 3\nf 1 4 2\n");
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_normal(&c, 0, 0, 1, 0, 3, 4e-16);
    check_normal(&c, 0, 1, CURVED_PI / 2, 0, 0.46364760900080612, 4e-16); /* atan(1/2) */
    curved_free(&c);
}

/* A fan of facets about the first vertex, no two in the same groups, all in the last. */
static void a_vertex_of_many_sets_of_groups_keeps_them_apart(void **state)
{
    (void)state;
    enum { N = 40 };
    text[0] = '\0';
    curved_line(text, "v 0 0 1");
    for (int i = 0; i < N; i++) {
        curved_line(text, "v %.17g %.17g 0", cos(2 * CURVED_PI * i / N),
                    sin(2 * CURVED_PI * i / N));
    }
    for (int i = 0; i < N; i++) {
        curved_line(text, "f 1 %d %d", i + 2, (i + 1) % N + 2);
    }
    curved_case c = curved_obj(text);
    for (uint32_t f = 0; f < N; f++) {
        c.mesh.facet_smooth[f] = 1u << 31 | f;
    }
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    for (uint32_t f = 0; f < N; f++) {
        check_normal(&c, f, 0, 0, 0, 1, 1e-15);
    }
    curved_free(&c);
}

static void normals_that_do_not_turn_are_not_called_for(void **state)
{
    (void)state;
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.1 0 1\nf 1//1 2//1 3//1\n");
    c.brdf.s = 0.001;
    curved_build(&c, LRCS_NORMALS_AUTO);
    assert_null(c.scene.corner_normal);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_normal(&c, 0, 2, 0.1, 0, 1, 4e-16);
    curved_free(&c);
}

/* By a right angle and by all but two, the second to the last bit. */
static void normals_that_turn_beyond_a_right_angle_are_called_for(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        curved_case c = curved_obj(i ? "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1e-30\nvn -1 0 1e-30\n"
                                       "f 1//1 2//2 3//1\n"
                                     : "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0.1\nvn -1 0 0.1\n"
                                       "f 1//1 2//2 3//1\n");
        c.brdf = (lrcs_brdf){1, 0, 10, 0}; /* so wide a glint minds only the chords: turn^2 / 24 */
        c.tolerance = i ? 0.40 : 0.35;
        curved_build(&c, LRCS_NORMALS_AUTO);
        assert_non_null(c.scene.corner_normal);
        c.tolerance = i ? 0.42 : 0.37;
        curved_build(&c, LRCS_NORMALS_AUTO);
        assert_null(c.scene.corner_normal);
        curved_free(&c);
    }
}

static void facets_without_normals_of_their_own_ask_for_none(void **state)
{
    (void)state;
    curved_case c =
        curved_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.1 1\nf 1 2 3\nf 1//1 2//1 3//1\n");
    assert_true(lrcsi_smooth_given(&c.mesh));
    c.mesh.facet_count = 1;
    assert_false(lrcsi_smooth_given(&c.mesh));
    for (int k = 0; k < 3; k++) {
        c.mesh.facet_normal[0] = (lrcs_facet){{LRCS_NONE, LRCS_NONE, LRCS_NONE}};
        c.mesh.facet_normal[0].corner[k] = 0;
        assert_true(lrcsi_smooth_given(&c.mesh));
    }
    curved_free(&c);
}

static void more_corners_than_indices_are_refused(void **state)
{
    (void)state;
    lrcs_work work = lrcs_work_make(NULL, 0);
    const lrcs_mesh mesh = {.facet_count = UINT32_MAX / 3 + 1};
    assert_int_equal(lrcsi_smooth_run(&mesh, NULL, NULL, &work, &(lrcs_scene){0}), LRCS_E_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cylinder_has_radial_normals_from_either_kind_of_data),
        cmocka_unit_test(a_cube_is_hard_where_its_groups_meet),
        cmocka_unit_test(the_split_of_a_flat_side_changes_no_normal),
        cmocka_unit_test(groups_are_shared_by_bit_and_by_vertex_index_only),
        cmocka_unit_test(vertex_normals_go_with_the_inverse_transpose),
        cmocka_unit_test(normals_turn_with_place_and_joint),
        cmocka_unit_test(normals_that_all_point_behind_are_turned_round),
        cmocka_unit_test(a_normal_that_points_behind_or_nowhere_gives_way_to_the_facets_own),
        cmocka_unit_test(skins_that_share_vertices_stay_flat),
        cmocka_unit_test(degenerate_facets_disturb_no_normal),
        cmocka_unit_test(auto_asks_what_the_glint_calls_for),
        cmocka_unit_test(the_hash_tells_curved_from_flat),
        cmocka_unit_test(too_small_an_area_is_refused_until_it_suffices),
        cmocka_unit_test(a_normal_that_the_mesh_does_not_have_is_refused),
        cmocka_unit_test(names_and_kinds_of_normals_go_both_ways),
        cmocka_unit_test(facets_count_by_their_angle_at_the_vertex),
        cmocka_unit_test(a_vertex_of_many_sets_of_groups_keeps_them_apart),
        cmocka_unit_test(normals_that_do_not_turn_are_not_called_for),
        cmocka_unit_test(normals_that_turn_beyond_a_right_angle_are_called_for),
        cmocka_unit_test(facets_without_normals_of_their_own_ask_for_none),
        cmocka_unit_test(more_corners_than_indices_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
