/* SPDX-License-Identifier: MIT */
/* The MTL reader, rule by rule, and under attack, on a mesh of four materials. */
#include <lrcs/read.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "random.h"

static const char two_words[] = "two words";
static const char accent[] = "caf\xc3\xa9";

typedef struct mtl_case {
    lrcs_mesh mesh;
    lrcs_surface material[4];
    lrcs_where where;
    int status;
} mtl_case;

/* Reads bytes, from a block of exactly their size, into a mesh whose materials are untouched. */
static void read_into(mtl_case *c, const char *bytes, size_t size)
{
    memset(c, 0, sizeof *c);
    c->material[0].name = "a";
    c->material[1].name = "b";
    c->material[2].name = two_words;
    c->material[3].name = accent;
    c->mesh.material = c->material;
    c->mesh.material_count = 4;
    char *block = malloc(size ? size : 1);
    assert_non_null(block);
    memcpy(block, bytes, size);
    c->status = lrcs_mtl_read(block, size, &c->mesh, &c->where);
    free(block);
}

static mtl_case read_good(const char *text)
{
    mtl_case c;
    read_into(&c, text, strlen(text));
    assert_int_equal(c.status, LRCS_OK);
    c.mesh.material = NULL; /* `material` moves with the copy */
    return c;
}

static void check_rgb(const lrcs_surface *surface, int r, int g, int b)
{
    assert_int_equal(surface->has_colour, 1);
    assert_int_equal(surface->rgb[0], r);
    assert_int_equal(surface->rgb[1], g);
    assert_int_equal(surface->rgb[2], b);
}

static void colours_are_rounded_to_bytes(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl b\nKd 0.25 0.8 1\nnewmtl a\nKd 0 0.0019 0.002\n");
    check_rgb(&c.material[1], 64, 204, 255);
    check_rgb(&c.material[0], 0, 0, 1);
    assert_int_equal(c.material[2].has_colour, 0);
}

static void colours_are_clamped(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nKd -1 2 1e300\n");
    check_rgb(&c.material[0], 0, 255, 255);
}

static void one_number_is_a_grey(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nKd 0.2\n");
    check_rgb(&c.material[0], 51, 51, 51);
}

static void spectral_and_xyz_colours_are_left_alone(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nKd spectral x.rfl 1\nnewmtl b\nKd xyz 1 1 1\n");
    assert_int_equal(c.material[0].has_colour, 0);
    assert_int_equal(c.material[1].has_colour, 0);
}

static void d_is_opacity_and_tr_transparency(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nd 0.25\nnewmtl b\nTr 0.25\nnewmtl two words\nd -halo 0\n"
                           "newmtl caf\xc3\xa9\nd 1.5\n");
    check_same(c.material[0].transparency, 0.75);
    check_same(c.material[1].transparency, 0.25);
    check_same(c.material[2].transparency, 1.0);
    check_same(c.material[3].transparency, 0.0);
}

static void d_beats_tr_in_either_order(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nd 1\nTr 1\nnewmtl b\nTr 1\nd 1\n");
    check_same(c.material[0].transparency, 0.0);
    check_same(c.material[1].transparency, 0.0);
}

static void names_match_as_the_obj_reader_writes_them(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl \t two words \r\nKd 1 0 0\r\nnewmtl caf\xe9\r\nKd 0 1 0\r\n");
    check_rgb(&c.material[2], 255, 0, 0);
    check_rgb(&c.material[3], 0, 255, 0);
    c = read_good("newmtl caf\xc3\xa9\nKd 0 0 1\nnewmtl two\nKd 1 1 1\nnewmtl two words 2\nKd 1\n");
    check_rgb(&c.material[3], 0, 0, 255);
    assert_int_equal(c.material[2].has_colour, 0);
}

static void materials_the_mesh_does_not_use_are_passed_over(void **state)
{
    (void)state;
    mtl_case c = read_good("Kd 1 1 1\nd 0\nnewmtl unused\nKd 1 1 1\nd 0\nnewmtl a\nnewmtl\nKd 1\n");
    for (int i = 0; i < 4; i++) {
        assert_int_equal(c.material[i].has_colour, 0);
        check_same(c.material[i].transparency, 0.0);
    }
}

static void the_last_definition_counts(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nKd 1 1 1\nd 0.5\nnewmtl b\nnewmtl a\nKd 0 0 0\n");
    check_rgb(&c.material[0], 0, 0, 0);
    check_same(c.material[0].transparency, 0.5);
}

static void undefined_materials_are_noticed(void **state)
{
    (void)state;
    mtl_case c = read_good("newmtl a\nnewmtl b\nnewmtl two words\n");
    assert_int_equal(c.mesh.notices, LRCS_MESH_UNDEFINED_MATERIAL);
    c = read_good("newmtl caf\xe9\nnewmtl a\nnewmtl b\nnewmtl two words\n");
    assert_int_equal(c.mesh.notices, 0);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(c.material[i].two_sided, 0);
    }
}

static void other_statements_are_passed_over(void **state)
{
    (void)state;
    mtl_case c = read_good("\xef\xbb\xbf# made by hand\n\nnewmtl a\n\tNs 250\nKa 1 x y\nillum 2\n"
                           "map_Kd a b.png\nNi nan\n Kd 1 1 \\\n 0 # gold\nKdx 1\n");
    check_rgb(&c.material[0], 255, 255, 0);
}

static void check_failure(const char *text, int status, uint64_t offset, uint32_t line,
                          const char *item, const char *found)
{
    mtl_case c;
    read_into(&c, text, strlen(text));
    assert_int_equal(c.status, status);
    assert_int_equal(c.where.offset, offset);
    assert_int_equal(c.where.line, line);
    assert_string_equal(c.where.item, item);
    assert_string_equal(c.where.expected[0] ? c.where.found : "", found);
    assert_int_equal(c.material[0].has_colour, 0);
    assert_int_equal(c.material[0].two_sided, 0);
    assert_int_equal(c.mesh.notices, 0);
}

static void what_is_no_number_is_refused_and_nothing_written(void **state)
{
    (void)state;
    check_failure("newmtl a\nKd 1 1 1\nKd 1 x 1\n", LRCS_E_SYNTAX, 23, 3, "Kd", "x");
    check_failure("newmtl a\nKd 1 1 1\nKd 1 1\n", LRCS_E_SYNTAX, 24, 3, "Kd", "end of line");
    check_failure("newmtl a\nKd 1 1 1\nd", LRCS_E_TRUNCATED, 19, 3, "d", "end of file");
    check_failure("newmtl a\nKd 1 1 1\nd nan\n", LRCS_E_NUMBER, 20, 3, "d", "nan");
    check_failure("newmtl a\nKd 1 1 1\nTr 1e999\n", LRCS_E_NUMBER, 21, 3, "Tr", "1e999");
    check_failure("newmtl unused\nKd -inf 1 1\n", LRCS_E_NUMBER, 17, 2, "Kd", "-inf");
}

static void no_bytes_are_an_error(void **state)
{
    (void)state;
    mtl_case c;
    read_into(&c, "", 0);
    assert_int_equal(c.status, LRCS_E_EMPTY);
}

static const char sample[] =
    "\xef\xbb\xbf# sample\r\nnewmtl a\nNs 10\rKd 0.5 .25 1e-1\nd 0.5\nnewmtl two words\nKd 1 \\\n"
    "1 0\nTr 0.125\nnewmtl caf\xe9\nKd 0.3\nd -halo 1\nnewmtl none\nillum 2\nKd spectral f.rfl\n";

static int attack(const char *bytes, size_t size)
{
    mtl_case c;
    read_into(&c, bytes, size);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(c.material[i].two_sided, 0);
        assert_true(c.material[i].transparency >= 0.0 && c.material[i].transparency <= 1.0);
    }
    if (c.status != LRCS_OK) {
        assert_non_null(c.where.item);
        assert_true(c.where.offset <= size && c.where.line >= 1);
        assert_int_equal(c.mesh.notices, 0);
    }
    return c.status == LRCS_OK;
}

static void every_prefix_is_read_or_refused(void **state)
{
    (void)state;
    int good = 0;
    for (size_t size = 0; size < sizeof sample; size++) {
        good += attack(sample, size);
    }
    assert_true(good > 50 && good < (int)sizeof sample - 5);
}

static void flipped_bytes_are_read_or_refused(void **state)
{
    (void)state;
    uint64_t seed = 20140156;
    int good = 0;
    enum { TRIES = 20000 };
    for (int i = 0; i < TRIES; i++) {
        char bytes[sizeof sample];
        memcpy(bytes, sample, sizeof sample);
        for (int k = 0; k <= i % 8; k++) {
            random_mmix(&seed);
            size_t at = (size_t)(seed >> 33) % (sizeof sample - 1);
            bytes[at] = (char)((unsigned char)bytes[at] ^ (1u << (seed >> 29 & 7)));
        }
        good += attack(bytes, sizeof sample - 1);
    }
    assert_true(good > TRIES / 20 && good < TRIES * 19 / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_are_rounded_to_bytes),
        cmocka_unit_test(colours_are_clamped),
        cmocka_unit_test(one_number_is_a_grey),
        cmocka_unit_test(spectral_and_xyz_colours_are_left_alone),
        cmocka_unit_test(d_is_opacity_and_tr_transparency),
        cmocka_unit_test(d_beats_tr_in_either_order),
        cmocka_unit_test(names_match_as_the_obj_reader_writes_them),
        cmocka_unit_test(materials_the_mesh_does_not_use_are_passed_over),
        cmocka_unit_test(the_last_definition_counts),
        cmocka_unit_test(undefined_materials_are_noticed),
        cmocka_unit_test(other_statements_are_passed_over),
        cmocka_unit_test(what_is_no_number_is_refused_and_nothing_written),
        cmocka_unit_test(no_bytes_are_an_error),
        cmocka_unit_test(every_prefix_is_read_or_refused),
        cmocka_unit_test(flipped_bytes_are_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
