/* SPDX-License-Identifier: MIT */
/* The comparison of methods: which truth is taken, that every error is within its bound, and what a
   scene without curved shapes has. No test depends on a time. */
#include <lrcs/convergence.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

static char folder[] = "/tmp/lrcs-test-XXXXXX";
static const char path[] = "scene.toml";
static lrcs_host_error error;
static int stages;

static void count_stage(const char *name, uint32_t done, uint32_t count)
{
    stages += name[0] != '\0' && done <= count;
}

static lrcs_host_convergence *convergence_of(const char *text, double az, double el)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
    lrcs_host_convergence *all = calloc(1, sizeof *all);
    assert_non_null(all);
    all->path = path;
    all->load = lrcs_host_options_default();
    all->seconds = 0.02;
    all->stage = count_stage;
    stages = 0;
    assert_int_equal(lrcs_pose_from_azel(az, el, &all->pose), LRCS_OK);
    assert_int_equal(lrcs_host_convergence_read(all, &error), LRCS_OK);
    assert_int_equal(lrcs_host_convergence_measure(all, &error), LRCS_OK);
    assert_true(stages > 0);
    return all;
}

static void check_settings(const lrcs_host_convergence *all)
{
    for (uint32_t i = 0; i < all->settings; i++) {
        const lrcs_host_convergence_setting *one = &all->setting[i];
        assert_true(one->runs >= 1 && one->mesh < all->meshes);
        if (one->bound_m2 >= 0.0) {
            assert_true(one->error_m2 <= one->bound_m2 + all->truth.bound_m2);
        }
    }
}

static void convergence_free(lrcs_host_convergence *all)
{
    lrcs_host_convergence_free(all);
    free(all);
}

static const char material[] =
    "schema = 1\n[[material]]\nname = \"m\"\nA = 1\nB = 0.25\ns = 0.2\nm = 0.5\n";

static char *scene_text(const char *parts)
{
    static char text[2000];
    snprintf(text, sizeof text, "%s%s", material, parts);
    return text;
}

static void the_truth_of_a_single_shape_is_its_closed_form(void **state)
{
    (void)state;
    lrcs_host_convergence *all =
        convergence_of(scene_text("[[part]]\nname = \"c\"\nshape = \"cylinder\"\nradius = "
                                  "0.5\nlength = 2\nmaterial = \"m\"\n"),
                       0.0, 30.0);
    const lrcs_shape shape = {
        .kind = LRCS_SHAPE_CYLINDER, .parts = LRCS_SHAPE_ALL, .radius = 0.5, .length = 2.0};
    const lrcs_brdf brdf = {1.0, 0.25, 0.2, 0.5};
    const lrcs_aspect aspect = {.deg = 60.0};
    lrcs_closed_form closed;
    assert_int_equal(lrcs_closed_eval(&shape, &brdf, &aspect, &closed), LRCS_OK);
    assert_string_equal(all->truth.text, "the closed form of the cylinder");
    assert_true(all->truth.true_shapes);
    assert_true(fabs(all->truth.sigma_m2 - closed.sigma_m2) <= 1e-12 * closed.sigma_m2);
    assert_true(all->meshes > 1 && all->mesh[0].digits == 1);
    assert_true(lrcs_host_convergence_finest(all)->scene.scene.facet_count >
                all->mesh[0].scene.scene.facet_count);
    check_settings(all);
    convergence_free(all);
}

/* Two plates: no tolerance changes their facets, and exact is the truth. */
static void without_curved_shapes_there_is_one_mesh(void **state)
{
    (void)state;
    lrcs_host_convergence *all = convergence_of(
        scene_text("[[part]]\nname = \"a\"\nshape = \"plate\"\nsize = [2, 1]\nmaterial = \"m\"\n"
                   "[[part]]\nname = \"b\"\nshape = \"plate\"\nsize = [1, 1]\ntranslate = [0, 0, "
                   "1]\nmaterial = \"m\"\n"),
        0.0, 60.0);
    int exact = 0;
    assert_int_equal(all->meshes, 1);
    assert_int_equal(all->mesh[0].digits, 0);
    for (uint32_t i = 0; i < all->settings; i++) {
        exact += all->setting[i].kind == LRCS_HOST_CONVERGENCE_KIND_EXACT &&
                 all->setting[i].error_m2 == 0.0;
        assert_true(all->setting[i].kind != LRCS_HOST_CONVERGENCE_KIND_MESH);
    }
    assert_int_equal(exact, 1);
    assert_string_equal(all->truth.text, "exact on the mesh, 4 facets");
    assert_true(lrcs_host_convergence_relative(all, all->truth.sigma_m2) == 1.0);
    check_settings(all);
    convergence_free(all);
}

static void what_cannot_be_read_is_told(void **state)
{
    (void)state;
    lrcs_host_convergence *all = calloc(1, sizeof *all);
    assert_non_null(all);
    all->path = "none.toml";
    all->load = lrcs_host_options_default();
    assert_int_equal(lrcs_host_convergence_read(all, &error), LRCS_E_SYSTEM);
    convergence_free(all);
}

static int folder_make(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int folder_remove(void **state)
{
    (void)state;
    return unlink(path) == 0 && chdir("/") == 0 ? rmdir(folder) : -1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_truth_of_a_single_shape_is_its_closed_form),
        cmocka_unit_test(without_curved_shapes_there_is_one_mesh),
        cmocka_unit_test(what_cannot_be_read_is_told),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
