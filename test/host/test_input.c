/* SPDX-License-Identifier: MIT */
/* Which files a scene was read from, and what may be written. */
#include <lrcs/host.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

static char folder[64];

static int folder_make(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lrcs-test-XXXXXX");
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int folder_remove(void **state)
{
    (void)state;
    return chdir("/") == 0 ? rmdir(folder) : -1; /* fails where a test left anything behind */
}

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void a_scene_lists_every_file_that_it_was_read_from(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_host_error error;
    uint32_t count = 0;
    put("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    put("m.mtl", "newmtl red\nKd 1 0 0\n");
    put("s.toml", "[[part]]\nname = \"a\"\nfile = \"m.obj\"\n");
    assert_int_equal(lrcs_host_scene_read("s.toml", &options, &scene, &error), LRCS_OK);
    for (const lrcs_host_input *input = scene.input; input; input = input->next) {
        assert_int_equal(lrcs_host_output_check(input->path, &scene, &error), LRCS_E_ARGUMENT);
        assert_non_null(strstr(error.text, input->path));
        count++;
    }
    assert_int_equal(count, 3);
    assert_int_equal(lrcs_host_output_check("-", &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_output_check("none", &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_output_check("/dev/null", &scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_host_output_check("./m.mtl", &scene, NULL), LRCS_E_ARGUMENT);
    lrcs_host_scene_free(&scene);
    assert_null(scene.input);
    assert_int_equal(lrcs_host_scene_read("demo", &options, &scene, &error), LRCS_OK);
    assert_null(scene.input);
    lrcs_host_scene_free(&scene);
    remove("m.obj");
    remove("m.mtl");
    remove("s.toml");
}

static void two_outputs_are_one_where_folder_and_name_are(void **state)
{
    (void)state;
    put("there", "");
    assert_int_equal(symlink("there", "link"), 0);
    assert_true(lrcs_host_output_same("a", "a"));
    assert_true(lrcs_host_output_same("a", "./a"));
    assert_true(lrcs_host_output_same("there", "link"));
    assert_false(lrcs_host_output_same("a", "b"));
    assert_false(lrcs_host_output_same("a", "/tmp/a"));
    assert_false(lrcs_host_output_same("a", "there"));
    assert_false(lrcs_host_output_same("none/a", "./none/a")); /* neither can be written */
    remove("there");
    remove("link");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_lists_every_file_that_it_was_read_from),
        cmocka_unit_test(two_outputs_are_one_where_folder_and_name_are),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
