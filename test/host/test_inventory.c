/* SPDX-License-Identifier: MIT */
/* What a scene holds: areas by material, notices about its mesh, surfaces found, against numbers of
   simple bodies. */
#include <lrcs/inventory.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

static char folder[] = "/tmp/lrcs-test-XXXXXX";
static lrcs_host_error error;
static lrcs_host_scene scene;
static lrcs_host_inventory inventory;

static int folder_make(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int folder_remove(void **state)
{
    (void)state;
    return unlink("body.obj") == 0 && chdir("/") == 0 ? rmdir(folder) : -1;
}

static int scene_free(void **state)
{
    (void)state;
    lrcs_host_inventory_free(&inventory);
    lrcs_host_scene_free(&scene);
    return 0;
}

static void inventory_of_file(FILE *out)
{
    lrcs_host_options options = lrcs_host_options_default();
    options.build.normals = LRCS_NORMALS_SMOOTH;
    options.unit_m = 1.0;
    assert_int_equal(fclose(out), 0);
    memset(&scene, 0, sizeof scene);
    assert_int_equal(lrcs_host_scene_read("body.obj", &options, &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_inventory_make(&scene, &scene.scene, &inventory, &error), LRCS_OK);
}

static const char *notice(int i)
{
    static char text[LRCS_HOST_INVENTORY_NOTICE];
    return lrcs_host_inventory_notice(&inventory, &scene.scene, i, text);
}

/* A box of 1 x 2 x 3 m, its bottom of a material of its own, with its fronts outside or inside. */
static void box_write(int inside, int open)
{
    static const char *const face[] = {"1 4 3 2", "5 6 7 8", "1 2 6 5",
                                       "2 3 7 6", "3 4 8 7", "4 1 5 8"};
    static const char *const turned[] = {"2 3 4 1", "8 7 6 5", "5 6 2 1",
                                         "6 7 3 2", "7 8 4 3", "8 5 1 4"};
    FILE *out = fopen("body.obj", "wb");
    assert_non_null(out);
    fputs("v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\nusemtl bottom\n",
          out);
    for (int i = 0; i < 6 - open; i++) {
        fprintf(out, "%sf %s\n", i == 1 ? "usemtl other\n" : "", inside ? turned[i] : face[i]);
    }
    inventory_of_file(out);
}

static void facets_and_areas_are_those_of_each_material(void **state)
{
    (void)state;
    box_write(0, 0);
    assert_int_equal(inventory.parts, 1);
    for (uint32_t i = 0; i < scene.scene.material_count; i++) {
        const char *name = scene.scene.material[i].name;
        if (strcmp(name, "bottom") == 0) {
            assert_int_equal(inventory.material[i].facets, 2);
            assert_true(inventory.material[i].area_m2 == 2.0);
        } else if (strcmp(name, "other") == 0) {
            assert_int_equal(inventory.material[i].facets, 10);
            assert_true(inventory.material[i].area_m2 == 20.0);
        } else {
            assert_int_equal(inventory.material[i].facets, 0);
        }
    }
    assert_true(inventory.report.closed && inventory.report.convex);
    assert_true(fabs(inventory.report.volume - 6.0) < 1e-14);
    assert_true(fabs(lrcs_host_facet_area(&scene.scene, 0) - 1.0) < 1e-15);
    assert_null(notice(0));
    assert_null(notice(1));
    assert_non_null(strstr(notice(2), "no smoothing groups"));
    assert_null(notice(3));
}

static void what_is_peculiar_is_noticed(void **state)
{
    (void)state;
    box_write(1, 0);
    assert_null(notice(0));
    assert_non_null(strstr(notice(1), "inverted"));
    scene_free(NULL);
    box_write(0, 1);
    assert_non_null(strstr(notice(0), "not closed"));
    assert_null(notice(1));
}

/* The wall of a prism of 48 sides in a circle of radius 1: its facets lie on a cylinder of that
   radius to within the height of an arc, 1 - cos(pi / 48). */
static void a_prism_lies_on_a_cylinder(void **state)
{
    (void)state;
    enum { SIDES = 48 };
    const double pi = acos(-1.0);
    lrcs_host_surfaces surfaces;
    FILE *out = fopen("body.obj", "wb");
    assert_non_null(out);
    for (int i = 0; i < SIDES; i++) {
        double x = cos(2.0 * pi * i / SIDES);
        double y = sin(2.0 * pi * i / SIDES);
        fprintf(out, "v %.17g %.17g 0\nv %.17g %.17g 2\n", x, y, x, y);
    }
    for (int i = 0; i < SIDES; i++) {
        int next = (i + 1) % SIDES;
        fprintf(out, "f %d %d %d %d\n", 2 * i + 1, 2 * next + 1, 2 * next + 2, 2 * i + 2);
    }
    inventory_of_file(out);
    assert_int_equal(lrcs_host_surfaces_find(&scene.scene, &surfaces, &error), LRCS_OK);
    assert_int_equal(surfaces.count, 1);
    const lrcs_host_surface_kind *kind = &surfaces.kind[LRCS_QUADRIC_CYLINDER];
    double height = 1.0 - cos(pi / SIDES);
    assert_int_equal(kind->regions, 1);
    assert_int_equal(kind->facets, 2 * SIDES);
    assert_true(fabs(kind->area_m2 - 2.0 * SIDES * 2.0 * sin(pi / SIDES)) < 1e-12);
    assert_true(kind->displacement >= 0.5 * height && kind->displacement < 1.001 * height);
    assert_int_equal(surfaces.kind[LRCS_QUADRIC_PLANE].regions, 0);
    lrcs_host_surfaces_free(&surfaces);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(facets_and_areas_are_those_of_each_material, scene_free),
        cmocka_unit_test_teardown(what_is_peculiar_is_noticed, scene_free),
        cmocka_unit_test_teardown(a_prism_lies_on_a_cylinder, scene_free),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
