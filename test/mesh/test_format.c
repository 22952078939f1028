/* SPDX-License-Identifier: MIT */
/* Formats recognised by content, and by the file's name if the content does not decide. */
#include <lrcs/read.h>

#include <stdlib.h>

#include "build3ds.h"
#include "mesh/read/3ds.h"

static int format_of(const char *text, const char *name)
{
    return lrcs_format_check(text, strlen(text), name);
}

static void a_3ds_file_is_known_by_its_root_chunk(void **state)
{
    (void)state;
    static build3ds file;
    build3ds_begin(&file);
    build3ds_panel(&file, "p", 0.0f, "m");
    build3ds_end(&file);
    assert_int_equal(lrcs_format_check(file.bytes, file.size, NULL), LRCS_FORMAT_3DS);
    assert_int_equal(lrcs_format_check(file.bytes, file.size, "model.obj"), LRCS_FORMAT_3DS);
    /* cut short, or with more behind it, it is still one */
    assert_int_equal(lrcs_format_check(file.bytes, file.size - 5, NULL), LRCS_FORMAT_3DS);
    assert_int_equal(lrcs_format_check(file.bytes, file.size + 3, NULL), LRCS_FORMAT_3DS);
    assert_int_equal(lrcs_format_check(file.bytes, 8, NULL), LRCS_FORMAT_3DS);
    assert_int_equal(lrcs_format_check(file.bytes, 5, NULL), LRCS_FORMAT_UNKNOWN);
}

/* A root that claims more bytes than there are is known by its first chunk. */
static void a_3ds_file_cut_short_is_known_by_its_first_chunk(void **state)
{
    (void)state;
    static const unsigned first[] = {LRCSI_TDS_VERSION, LRCSI_TDS_EDITOR, LRCSI_TDS_KEYFRAMER};
    unsigned char bytes[8] = {0x4d, 0x4d, 100, 0, 0, 0, 0, 0};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++) {
        bytes[6] = (unsigned char)(first[i] & 0xff);
        bytes[7] = (unsigned char)(first[i] >> 8);
        assert_int_equal(lrcs_format_check(bytes, 8, NULL), LRCS_FORMAT_3DS);
        assert_int_equal(lrcs_format_check(bytes, 6, NULL), LRCS_FORMAT_UNKNOWN);
    }
    bytes[7] = 0x77;
    assert_int_equal(lrcs_format_check(bytes, 8, NULL), LRCS_FORMAT_UNKNOWN);
    bytes[2] = 5; /* shorter than its own header */
    assert_int_equal(lrcs_format_check(bytes, 8, NULL), LRCS_FORMAT_UNKNOWN);
}

static void text_that_starts_with_mm_is_not_3ds(void **state)
{
    (void)state;
    assert_int_equal(format_of("MMMMMMMMMMMM", NULL), LRCS_FORMAT_UNKNOWN);
}

static void an_obj_file_is_known_by_its_first_word(void **state)
{
    (void)state;
    static const char *const text[] = {
        "v 0 0 0\n", "# comment\n\n  # another\r\nv 1 2 3\n", "mtllib a.mtl\n", "o body\n",
        "g wing\n",  "\xef\xbb\xbf# bom\nvn 0 0 1\n",         "f 1 2 3\n",      "#\nusemtl gold\n",
    };
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        assert_int_equal(format_of(text[i], NULL), LRCS_FORMAT_OBJ);
        assert_int_equal(format_of(text[i], "model.3ds"), LRCS_FORMAT_OBJ);
    }
}

static void scene_and_material_files_are_no_models(void **state)
{
    (void)state;
    static const char *const text[] = {
        "# lrcs scene\n[[part]]\nmodel = \"a.obj\"\n",
        "title = \"x\"\n",
        "newmtl gold\nKd 1 1 0\n",
        "# only a comment\n",
        "v",
        "vertex 1 2 3\n",
        "\n\n",
        "{}",
    };
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        assert_int_equal(format_of(text[i], NULL), LRCS_FORMAT_UNKNOWN);
        assert_int_equal(format_of(text[i], "scene.toml"), LRCS_FORMAT_UNKNOWN);
    }
}

static void both_kinds_of_stl_are_known(void **state)
{
    (void)state;
    unsigned char binary[134] = "solid by name, binary by size";
    binary[80] = 1;
    assert_int_equal(lrcs_format_check(binary, sizeof binary, NULL), LRCS_FORMAT_STL);
    binary[0] = 'M'; /* whatever its header says */
    binary[1] = 'M';
    assert_int_equal(lrcs_format_check(binary, sizeof binary, NULL), LRCS_FORMAT_STL);
    assert_int_equal(format_of("solid a\nfacet normal 0 0 1\n", NULL), LRCS_FORMAT_STL);
    assert_int_equal(format_of("  SOLID\r\n\r\nENDSOLID\r\n", NULL), LRCS_FORMAT_STL);
    assert_int_equal(format_of("solid a\nbut a poem\n", NULL), LRCS_FORMAT_UNKNOWN);
}

static void a_binary_stl_of_wrong_size_is_known_by_its_name(void **state)
{
    (void)state;
    unsigned char binary[130] = "a header";
    binary[80] = 1;
    assert_int_equal(lrcs_format_check(binary, sizeof binary, NULL), LRCS_FORMAT_UNKNOWN);
    assert_int_equal(lrcs_format_check(binary, sizeof binary, "a.stl"), LRCS_FORMAT_STL);
}

static void the_name_decides_where_the_content_is_silent(void **state)
{
    (void)state;
    assert_int_equal(lrcs_format_check(NULL, 0, "/a/B.3DS"), LRCS_FORMAT_3DS);
    assert_int_equal(lrcs_format_check(NULL, 0, "x.Obj"), LRCS_FORMAT_OBJ);
    assert_int_equal(lrcs_format_check(NULL, 0, "x.stl"), LRCS_FORMAT_STL);
    assert_int_equal(lrcs_format_check(NULL, 0, "3ds"), LRCS_FORMAT_UNKNOWN);
    assert_int_equal(lrcs_format_check(NULL, 0, "x.3ds.txt"), LRCS_FORMAT_UNKNOWN);
    assert_int_equal(lrcs_format_check(NULL, 0, ""), LRCS_FORMAT_UNKNOWN);
    assert_int_equal(lrcs_format_check(NULL, 0, NULL), LRCS_FORMAT_UNKNOWN);
}

static void nothing_beyond_the_bytes_is_looked_at(void **state)
{
    (void)state;
    static const char *const text[] = {"MM\x40\x00\x00\x00==", "solid a\nfacet normal 0 0 1\n",
                                       "# c\r\nmtllib a\n", "\xef\xbb\xbfusemtl x\n"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        for (size_t size = 1; size <= 8; size++) {
            char *copy = malloc(size);
            assert_non_null(copy);
            memcpy(copy, text[i], size);
            int format = lrcs_format_check(copy, size, NULL);
            assert_true(format >= LRCS_FORMAT_UNKNOWN && format <= LRCS_FORMAT_STL);
            free(copy);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_3ds_file_is_known_by_its_root_chunk),
        cmocka_unit_test(a_3ds_file_cut_short_is_known_by_its_first_chunk),
        cmocka_unit_test(text_that_starts_with_mm_is_not_3ds),
        cmocka_unit_test(an_obj_file_is_known_by_its_first_word),
        cmocka_unit_test(scene_and_material_files_are_no_models),
        cmocka_unit_test(both_kinds_of_stl_are_known),
        cmocka_unit_test(a_binary_stl_of_wrong_size_is_known_by_its_name),
        cmocka_unit_test(the_name_decides_where_the_content_is_silent),
        cmocka_unit_test(nothing_beyond_the_bytes_is_looked_at),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
