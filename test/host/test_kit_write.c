/* SPDX-License-Identifier: MIT */
/* Writing a kit: its meshes against volumes and areas known in closed form, a tier that is written
   and read back, and what is refused. test/cli/test_vectors.sh reads whole kits with readers of
   Python's own. */
#include <lrcs/kit.h>

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"
#include "host/kit/vectors.h"

static char folder[64];
static lrcs_host_error error;
static int begun;

static const lrcsi_vectors_scene *scene_named(const char *name)
{
    const lrcsi_vectors_scene *scene = lrcsi_vectors_scenes;
    while (strcmp(scene->name, name) != 0) {
        scene++;
    }
    return scene;
}

static lrcs_mesh_report report_of(const char *name)
{
    lrcsi_vectors_mesh mesh;
    lrcs_mesh_report report;
    assert_int_equal(lrcsi_vectors_mesh_make(scene_named(name), &mesh, &error), LRCS_OK);
    size_t need = lrcs_mesh_check_need(mesh.vertices, mesh.facets);
    void *bytes = malloc(need);
    lrcs_work work = lrcs_work_make(bytes, need);
    assert_int_equal(
        lrcs_mesh_check(mesh.vertex, mesh.vertices, mesh.facet, mesh.facets, &work, &report),
        LRCS_OK);
    free(bytes);
    lrcsi_vectors_mesh_free(&mesh);
    return report;
}

/* Coordinates are rounded to single precision, which changes a volume by some 1e-7 of it. */
static void closed_bodies_have_their_volume_and_fronts_outside(void **state)
{
    (void)state;
    const double pi = acos(-1.0);
    const struct {
        const char *name;
        double volume;
    } body[] = {{"box", 3.0},
                {"brick", 3.0},
                {"drum", 12.0 * sin(pi / 12.0) * 0.25 * 2.0},
                {"cone", 12.0 * sin(pi / 12.0) * 0.25 * 1.5 / 3.0},
                {"needle-drum", 24.0 * sin(pi / 24.0) * 0.25 * 2.0}};
    for (size_t i = 0; i < sizeof body / sizeof *body; i++) {
        lrcs_mesh_report report = report_of(body[i].name);
        assert_true(report.closed);
        assert_true(fabs(report.volume - body[i].volume) < 1e-6 * body[i].volume);
    }
    assert_true(report_of("ball").closed && report_of("ball").volume > 0.0);
    assert_true(fabs(report_of("plate-turned").area - 2.0) < 1e-6);
    assert_true(fabs(report_of("slivers").area - 360.0 * sin(pi / 360.0) -
                     (2.0 * 0.125 * 0.125 + 4.0 * 0.125 * 3.0)) < 1e-6);
}

static void every_scene_is_exact_in_single_precision(void **state)
{
    (void)state;
    for (const lrcsi_vectors_scene *scene = lrcsi_vectors_scenes; scene->name; scene++) {
        lrcsi_vectors_mesh mesh;
        assert_int_equal(lrcsi_vectors_mesh_make(scene, &mesh, &error), LRCS_OK);
        assert_true(mesh.facets > 0 && strlen(scene->name) < LRCS_HOST_KIT_NAME);
        for (uint32_t i = 0; i < mesh.vertices; i++) {
            for (int k = 0; k < 3; k++) {
                assert_true(mesh.vertex[i].x[k] == (double)(float)mesh.vertex[i].x[k]);
            }
        }
        for (uint32_t i = 0; i < mesh.facets; i++) {
            const uint32_t *v = mesh.facet[i].corner;
            assert_true(v[0] < mesh.vertices && v[1] < mesh.vertices && v[2] < mesh.vertices);
            assert_true(v[0] != v[1] && v[1] != v[2] && v[2] != v[0]);
        }
        lrcsi_vectors_mesh_free(&mesh);
    }
}

static int folder_make(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lrcs-test-XXXXXX");
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static void files_remove(const char *path)
{
    char inside[400];
    struct dirent *entry;
    DIR *list = opendir(path);
    while (list && (entry = readdir(list)) != NULL) {
        snprintf(inside, sizeof inside, "%s/%s", path, entry->d_name);
        remove(inside);
    }
    if (list) {
        closedir(list);
    }
    remove(path);
}

static int folder_remove(void **state)
{
    static const char *const name[] = {"kit/scenes", "kit/truth", "kit", "other", "."};
    (void)state;
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        files_remove(name[i]);
    }
    return chdir("/") == 0 ? rmdir(folder) : -1;
}

static void count_scene(const char *scene)
{
    begun += scene[0] != '\0';
}

/* By Eq. 2 sigma of the plate of 2 m2 seen along its normal is 4 pi B S. */
static void a_tier_is_written_and_read_back(void **state)
{
    (void)state;
    const lrcs_host_kit_options options = {.tier = 1, .resolution = 8, .begin = count_scene};
    lrcs_host_kit_size size;
    lrcs_host_kit kit;
    struct stat about;
    begun = 0;
    assert_int_equal(lrcs_host_kit_write("kit", &options, &size, &error), LRCS_OK);
    assert_int_equal(lrcs_host_kit_read("kit", &kit, &error), LRCS_OK);
    assert_int_equal(kit.scenes, size.scenes);
    assert_int_equal(kit.cases, size.cases);
    assert_int_equal((uint32_t)begun, size.scenes);
    assert_string_equal(kit.scene[0].name, "plate-white");
    assert_string_equal(kit.list[0].attitude, "nose");
    double sigma = 4.0 * acos(-1.0) * 0.25 * 2.0;
    assert_true(fabs(kit.list[0].sigma_m2 - sigma) <= kit.list[0].bound_m2 + 1e-15 * sigma);
    assert_int_equal(kit.list[0].image, 0); /* one picture of a scene, not along an axis */
    assert_int_equal(kit.list[1].image, 8);
    assert_int_equal(stat("kit/truth/plate-white.t05.item.u32", &about), 0);
    assert_int_equal(about.st_size, 4 * 8 * 8);
    lrcs_host_kit_free(&kit);
    /* over an older one */
    assert_int_equal(lrcs_host_kit_write("kit", &options, NULL, &error), LRCS_OK);
}

static void what_cannot_be_written_is_refused(void **state)
{
    (void)state;
    lrcs_host_kit_options options = {.tier = LRCS_HOST_KIT_TIERS + 1};
    char path[5000];
    assert_int_equal(lrcs_host_kit_write("kit2", &options, NULL, &error), LRCS_E_ARGUMENT);
    options.tier = 1;
    options.resolution = LRCS_HOST_KIT_RESOLUTION_MOST + 1;
    assert_int_equal(lrcs_host_kit_write("kit2", &options, NULL, &error), LRCS_E_ARGUMENT);
    options.resolution = 0;
    assert_int_equal(mkdir("other", 0777), 0);
    fclose(fopen("other/file", "wb"));
    assert_int_equal(lrcs_host_kit_write("other", &options, NULL, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "contains other files"));
    assert_int_equal(lrcs_host_kit_write("none/kit", &options, NULL, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "cannot make this folder"));
    memset(path, 'a', sizeof path);
    path[sizeof path - 1] = '\0';
    assert_int_equal(lrcs_host_kit_write(path, &options, NULL, &error), LRCS_E_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_bodies_have_their_volume_and_fronts_outside),
        cmocka_unit_test(every_scene_is_exact_in_single_precision),
        cmocka_unit_test(a_tier_is_written_and_read_back),
        cmocka_unit_test(what_cannot_be_written_is_refused),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
