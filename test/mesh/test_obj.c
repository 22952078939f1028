/* SPDX-License-Identifier: MIT */
/* The OBJ reader, rule by rule, and under attack. Every input lies in a block of exactly its size
   and is read in exactly the work area that lrcs_mesh_need asks for. */
#include <lrcs/read.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "random.h"

typedef struct obj_case {
    char *bytes;
    unsigned char *area;
    lrcs_mesh mesh;
    lrcs_mesh_counts counts;
    lrcs_where where;
    int status;
} obj_case;

static void *block_of(const void *bytes, size_t size)
{
    void *block = malloc(size ? size : 1);
    assert_non_null(block);
    memcpy(block, bytes, size);
    return block;
}

static obj_case open_bytes(const char *bytes, size_t size)
{
    obj_case c;
    memset(&c, 0, sizeof c);
    c.bytes = block_of(bytes, size);
    c.status = lrcs_obj_count(c.bytes, size, &c.counts, &c.where);
    if (c.status == LRCS_OK) {
        size_t need = lrcs_mesh_need(&c.counts);
        c.area = malloc(need);
        assert_non_null(c.area);
        lrcs_work work = lrcs_work_make(c.area, need);
        c.status = lrcs_obj_read(c.bytes, size, &work, &c.mesh, &c.where);
        assert_int_equal(c.status, LRCS_OK);
    }
    return c;
}

static void close_case(obj_case *c)
{
    free(c->bytes);
    free(c->area);
}

static obj_case open_text(const char *text)
{
    return open_bytes(text, strlen(text));
}

static obj_case open_good(const char *text)
{
    obj_case c = open_text(text);
    assert_int_equal(c.status, LRCS_OK);
    return c;
}

#define SQUARE  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
#define NORMALS "vn 1 0 0\nvn 0 1 0\nvn 0 0 1\n"

/* The corners of a file's facets, from 0, as "0,1,2 0,2,3". */
static void check_facets(const char *text, const char *want)
{
    obj_case c = open_good(text);
    char got[256] = "";
    for (uint32_t i = 0; i < c.mesh.facet_count; i++) {
        const uint32_t *k = c.mesh.facet[i].corner;
        size_t used = strlen(got);
        snprintf(got + used, sizeof got - used, "%s%u,%u,%u", i ? " " : "", (unsigned)k[0],
                 (unsigned)k[1], (unsigned)k[2]);
    }
    assert_string_equal(got, want);
    close_case(&c);
}

static void check_failure(const char *text, int status, uint64_t offset, uint32_t line,
                          const char *item, const char *found)
{
    obj_case c = open_text(text);
    assert_int_equal(c.status, status);
    assert_int_equal(c.where.offset, offset);
    assert_int_equal(c.where.line, line);
    assert_string_equal(c.where.item, item);
    assert_non_null(c.where.expected);
    assert_string_equal(c.where.found, found);
    close_case(&c);
}

static void polygons_are_fanned_from_their_first_vertex(void **state)
{
    (void)state;
    check_facets(SQUARE "f 1 2 3\n", "0,1,2");
    check_facets(SQUARE "f 1 2 3 4\n", "0,1,2 0,2,3");
    check_facets(SQUARE "v 2 2 2\nv 3 3 3\nf 3 4 5 6 1 2\n", "2,3,4 2,4,5 2,5,0 2,0,1");
}

static void all_forms_of_corners_are_read(void **state)
{
    (void)state;
    check_facets(SQUARE "f 1/1 2/2 3/3\n", "0,1,2");
    check_facets(SQUARE NORMALS "f 1//1 2//2 3//3\n", "0,1,2");
    check_facets(SQUARE NORMALS "f 1/9/1 2/-7/3 3/0/+2\n", "0,1,2");
    check_facets(SQUARE "f 1/ 2// 3/4/\n", "0,1,2");
    check_facets(SQUARE "f +1 02 0000000000000000000000003\n", "0,1,2");
}

static void negative_indices_count_back_from_the_face(void **state)
{
    (void)state;
    check_facets(SQUARE "f -4 -3 -2\nv 5 5 5\nvn 1 0 0\nf -1//-1 -2/-2 -5\n", "0,1,2 4,3,0");
}

/* The normals' indices at the corners of every facet, "-" where a corner has none. */
static void check_corner_normals(const char *text, uint32_t count, const char *want)
{
    obj_case c = open_good(text);
    char got[256] = "";
    assert_int_equal(c.mesh.normal_count, count);
    for (uint32_t i = 0; i < 3 * c.mesh.facet_count; i++) {
        uint32_t normal = c.mesh.facet_normal[i / 3].corner[i % 3];
        char word[16] = "-";
        if (normal != LRCS_NONE) {
            snprintf(word, sizeof word, "%lu", (unsigned long)normal);
        }
        strcat(got, i == 0 ? "" : i % 3 == 0 ? " " : ",");
        strcat(got, word);
    }
    assert_string_equal(got, want);
    close_case(&c);
}

static void normals_are_read_as_they_are_given(void **state)
{
    (void)state;
    static const char text[] = SQUARE "vn 0 0 2\nvn -.5 1e-3 0 7\nvn 0 0 0\nf 1//3 2//1 3//2\n";
    obj_case c = open_good(text);
    assert_int_equal(c.mesh.normal_count, 3);
    check_same(c.mesh.normal[0].x[2], 2.0);
    check_same(c.mesh.normal[1].x[0], -0.5);
    check_same(c.mesh.normal[1].x[1], 1e-3);
    check_same(c.mesh.normal[2].x[2], 0.0);
    close_case(&c);
    check_corner_normals(text, 3, "2,0,1");
    check_corner_normals(SQUARE NORMALS "f 1/7/2 2//3 3/7 4/\n", 3, "1,2,- 1,-,-");
    check_corner_normals(SQUARE "f 1//3 2//2 3//1\n" NORMALS "f 1//-1 2//-2 3//-3\n", 3,
                         "2,1,0 2,1,0");
}

static void a_file_without_normals_stores_none(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "f 1 2 3\n");
    assert_int_equal(c.mesh.normal_count, 0);
    assert_null(c.mesh.normal);
    assert_null(c.mesh.facet_normal);
    close_case(&c);
}

static void indices_of_normals_out_of_range_are_refused(void **state)
{
    (void)state;
    static const char item[] = "normal of a face corner";
    check_failure(SQUARE "f 1 2//1 3\n", LRCS_E_INDEX, 36, 5, item, "2//1 with 0 in the file");
    check_failure(SQUARE "f 1 2/1/0 3\n", LRCS_E_INDEX, 36, 5, item, "2/1/0");
    check_failure(SQUARE "f 1 2//-1 3\nvn 0 0 1\n", LRCS_E_INDEX, 36, 5, item,
                  "2//-1 with 0 above");
    check_failure(SQUARE "f 1 2//2 3\nvn 0 0 1\n", LRCS_E_INDEX, 36, 5, item,
                  "2//2 with 1 in the file");
    check_failure(SQUARE "f 1 2//4294967297 3\nvn 0 0 1\n", LRCS_E_INDEX, 36, 5, item,
                  "2//4294967297");
}

static void normals_that_are_no_numbers_are_refused(void **state)
{
    (void)state;
    check_failure("vn 1 x 3\n", LRCS_E_SYNTAX, 5, 1, "vertex normal", "x");
    check_failure("vn 1 2\n", LRCS_E_SYNTAX, 6, 1, "vertex normal", "end of line");
    check_failure("vn 0 nan 0\n", LRCS_E_NUMBER, 5, 1, "vertex normal", "nan");
    check_failure("vn 0 2e100 0\n", LRCS_E_NUMBER, 5, 1, "vertex normal", "2e100");
}

static void positive_indices_may_point_forward(void **state)
{
    (void)state;
    check_facets("f 1 2 4\n" SQUARE, "0,1,3");
}

static void coordinates_are_read_to_the_last_bit(void **state)
{
    (void)state;
    obj_case c = open_good("v 0.1 -4.7276760e-3 9007199254740993\nv +.5 5. 1E2\n");
    assert_int_equal(c.mesh.vertex_count, 2);
    const double want[6] = {0.1, -0.004727676, 9007199254740992.0, 0.5, 5.0, 100.0};
    for (int k = 0; k < 6; k++) {
        check_same(c.mesh.vertex[k / 3].x[k % 3], want[k]);
    }
    close_case(&c);
}

static void weights_and_vertex_colours_are_passed_over(void **state)
{
    (void)state;
    obj_case c = open_good("v 1 2 3 0.5\nv 4 5 6 1 0 0\nv 7 8 9 1 1 0 0\n");
    assert_int_equal(c.mesh.vertex_count, 3);
    check_same(c.mesh.vertex[2].x[2], 9.0);
    close_case(&c);
}

static void materials_come_in_order_of_first_use(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "f 1 2 3\nusemtl never\nusemtl b\nf 1 2 3 4\nusemtl a\nf 1 2 3\n"
                                  "usemtl b\nf 2 3 4\nusemtl\nf 1 3 4\n");
    assert_int_equal(c.mesh.material_count, 2);
    assert_string_equal(c.mesh.material[0].name, "b");
    assert_string_equal(c.mesh.material[1].name, "a");
    assert_int_equal(c.mesh.material[0].has_colour, 0);
    const uint32_t want[] = {LRCS_NONE, 0, 0, 1, 0, LRCS_NONE};
    assert_int_equal(c.mesh.facet_count, 6);
    assert_memory_equal(c.mesh.facet_material, want, sizeof want);
    assert_int_equal(c.counts.materials, 3); /* an upper bound: "b" came twice */
    close_case(&c);
}

static void parts_are_names_of_o_and_g_in_order_of_their_facets(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "f 1 2 3\no box\ng lid\nf 1 2 3\no foot\nf 1 2 3 4\ng lid\n"
                                  "f 2 3 4\n");
    assert_int_equal(c.mesh.part_count, 3);
    assert_string_equal(c.mesh.part[0], "");
    assert_string_equal(c.mesh.part[1], "lid");
    assert_string_equal(c.mesh.part[2], "foot");
    const uint32_t want[] = {0, 1, 2, 2, 1};
    assert_memory_equal(c.mesh.facet_part, want, sizeof want);
    close_case(&c);
}

static void a_group_without_name_is_the_unnamed_part(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "f 1 2 3\no a\nf 1 2 3\ng\nf 1 2 3\n");
    const uint32_t want[] = {0, 1, 0};
    assert_int_equal(c.mesh.part_count, 2);
    assert_memory_equal(c.mesh.facet_part, want, sizeof want);
    close_case(&c);
}

static void names_keep_inner_blanks_and_lose_outer_ones(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "o \t two  words #1 \t\r\nusemtl Material #25\nf 1 2 3\n");
    assert_string_equal(c.mesh.part[0], "two  words #1");
    assert_string_equal(c.mesh.material[0].name, "Material #25");
    close_case(&c);
}

static void names_that_are_not_utf8_are_latin1_and_noticed(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "o caf\xc3\xa9\nusemtl caf\xe9\nf 1 2 3\n");
    assert_string_equal(c.mesh.part[0], "caf\xc3\xa9");
    assert_string_equal(c.mesh.material[0].name, "caf\xc3\xa9");
    assert_int_equal(c.mesh.notices, LRCS_MESH_LATIN1_NAMES);
    close_case(&c);
    c = open_good(SQUARE "o caf\xc3\xa9\nf 1 2 3\n");
    assert_int_equal(c.mesh.notices, 0);
    close_case(&c);
}

static void many_names_are_distinguished(void **state)
{
    (void)state;
    enum { MANY = 3000 };
    char *text = malloc(MANY * 40 + 64);
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, SQUARE);
    for (int i = 0; i < MANY; i++) {
        used += (size_t)sprintf(text + used, "g p%d\nusemtl m%d\nf 1 2 3\n", i % 1000, i % 700);
    }
    obj_case c = open_good(text);
    assert_int_equal(c.mesh.part_count, 1000);
    assert_int_equal(c.mesh.material_count, 700);
    for (uint32_t i = 0; i < MANY; i++) {
        assert_int_equal(c.mesh.facet_part[i], i % 1000);
        assert_int_equal(c.mesh.facet_material[i], i % 700);
    }
    assert_string_equal(c.mesh.material[699].name, "m699");
    close_case(&c);
    free(text);
}

static void smoothing_groups_become_bits(void **state)
{
    (void)state;
    obj_case c = open_good(SQUARE "f 1 2 3\ns 1\nf 1 2 3\ns 32\nf 1 2 3\ns off\nf 1 2 3\ns 33\n"
                                  "f 1 2 3\ns 0\nf 1 2 3\ns on\nf 1 2 3\ns\nf 1 2 3\ns 5 # five\n"
                                  "f 1 2 3\n");
    const uint32_t want[] = {0, 1, UINT32_C(1) << 31, 0, 1, 0, 1, 0, 16};
    assert_int_equal(c.mesh.facet_count, 9);
    assert_memory_equal(c.mesh.facet_smooth, want, sizeof want);
    close_case(&c);
}

static void check_library(const char *line, const char *want)
{
    obj_case c = open_good(line);
    if (want) {
        assert_non_null(c.mesh.material_file);
        assert_string_equal(c.mesh.material_file, want);
    } else {
        assert_null(c.mesh.material_file);
    }
    close_case(&c);
}

static void the_first_material_file_is_remembered(void **state)
{
    (void)state;
    check_library("mtllib a.mtl\nmtllib b.mtl\n", "a.mtl");
    check_library("mtllib a.mtl b.mtl\n", "a.mtl");
    check_library("mtllib my own.MTL  \r\n", "my own.MTL");
    check_library("mtllib materials\n", "materials");
    check_library("mtllib\n", NULL);
    check_library("v 1 2 3\n", NULL);
}

static void all_line_endings_are_read(void **state)
{
    (void)state;
    check_facets("v 0 0 0\r\nv 1 0 0\r\n\r\nv 1 1 0\r\nf 1 2 3\r\n", "0,1,2");
    check_facets("v 0 0 0\rv 1 0 0\r\rv 1 1 0\rf 1 2 3\r", "0,1,2");
    check_facets("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3", "0,1,2");
    check_failure("#\r\n#\r#\n\nf 1 2\r\n", LRCS_E_SYNTAX, 13, 5, "face", "end of line");
}

static void a_backslash_continues_the_line(void **state)
{
    (void)state;
    check_facets("v 0 0 0\nv 1 \\\n 0 0\nv 1 1 \\\r\n0\nf 1\\\n2 3\\\r \\\n\n", "0,1,2");
    check_facets(SQUARE "f \\\n\\\n1 2 3\\\n4\n", "0,1,2 0,2,3");
    check_failure("v 0 0 0\nf 1 \\\n x\n", LRCS_E_SYNTAX, 15, 3, "face corner", "x");
}

static void comments_end_with_their_line(void **state)
{
    (void)state;
    check_facets("# f 1 2 3\nv 0 0 0 # one\nv 1 0 0\nv 1 1 0 #\nf 1 2 3 # 4\n", "0,1,2");
    check_facets(SQUARE "# C:\\models\\\nf 1 2 3\n", "0,1,2");
}

static void blanks_tabs_and_empty_lines_are_nothing(void **state)
{
    (void)state;
    check_facets("\n \t \n\tv  0\t0 0 \n  v 1 0 0\nv\t1 1 0\n\n\n \tf\t1  2 3\t\n \n", "0,1,2");
}

static void a_byte_order_mark_is_passed_over(void **state)
{
    (void)state;
    check_facets("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "0,1,2");
}

static void other_statements_are_passed_over(void **state)
{
    (void)state;
    check_facets("vt 0 0\nvn 0 0 1\nvp 1 2\n" SQUARE "l 1 2 99\np 77\ncurv 0 1 \\\n2 3 4\n"
                 "call x.obj\nvertex nan\nf 1 2 3\nnonsense\n",
                 "0,1,2");
}

static void a_file_without_facets_is_an_empty_mesh(void **state)
{
    (void)state;
    obj_case c = open_good("# nothing\n");
    assert_int_equal(c.mesh.vertex_count, 0);
    assert_int_equal(c.mesh.facet_count, 0);
    assert_int_equal(c.mesh.part_count, 0);
    assert_int_equal(c.mesh.material_count, 0);
    close_case(&c);
}

static void no_bytes_are_an_error(void **state)
{
    (void)state;
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(lrcs_obj_count(NULL, 0, &counts, &where), LRCS_E_EMPTY);
    assert_int_equal(lrcs_obj_count("", 0, &counts, NULL), LRCS_E_EMPTY);
}

static void faces_of_fewer_than_three_vertices_are_refused(void **state)
{
    (void)state;
    check_failure(SQUARE "f 1 2\n", LRCS_E_SYNTAX, 37, 5, "face", "end of line");
    check_failure(SQUARE "f\nf 1 2 3\n", LRCS_E_SYNTAX, 33, 5, "face", "end of line");
    check_failure(SQUARE "f 1 2", LRCS_E_TRUNCATED, 37, 5, "face", "end of file");
}

static void indices_outside_the_list_are_refused(void **state)
{
    (void)state;
    check_failure(SQUARE "f 0 1 2\n", LRCS_E_INDEX, 34, 5, "face corner", "0");
    check_failure(SQUARE "f 1 2 5\n", LRCS_E_INDEX, 38, 5, "face corner", "5 with 4 in the file");
    check_failure(SQUARE "f 1 2 3/7\nf 1 7/1 3\nf 1 2 8\n", LRCS_E_INDEX, 46, 6, "face corner",
                  "7/1 with 4 in the file");
    check_failure(SQUARE "f 1 2 -5\nv 0 0 0\n", LRCS_E_INDEX, 38, 5, "face corner",
                  "-5 with 4 above");
    check_failure(SQUARE "f 1 2 99999999999999999999999\n", LRCS_E_INDEX, 38, 5, "face corner",
                  "99999999999999999999999");
    check_failure(SQUARE "f 1 2 -99999999999999999999999\n", LRCS_E_INDEX, 38, 5, "face corner",
                  "-99999999999999999999999 with 4 above");
    check_failure(SQUARE "f 1 2 4294967295\n", LRCS_E_INDEX, 38, 5, "face corner", "4294967295");
    check_failure(SQUARE "f 1 2 4294967297\n", LRCS_E_INDEX, 38, 5, "face corner", "4294967297");
}

static void corners_that_are_no_indices_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"x", "1x", "1/2/3/4", "/1", "1.5", "-", "1-2", "1/x", "//1"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, SQUARE "f 1 %s 2\n", bad[i]);
        check_failure(text, LRCS_E_SYNTAX, 36, 5, "face corner", bad[i]);
    }
}

static void coordinates_that_are_no_numbers_are_refused(void **state)
{
    (void)state;
    static const char item[] = "vertex coordinate";
    check_failure("v 1 x 3\n", LRCS_E_SYNTAX, 4, 1, item, "x");
    check_failure("v 1 2 3z\n", LRCS_E_SYNTAX, 6, 1, item, "3z");
    check_failure("v 1,5 2 3\n", LRCS_E_SYNTAX, 2, 1, item, "1,5");
    check_failure("v 0x1p3 2 3\n", LRCS_E_SYNTAX, 2, 1, item, "0x1p3");
    check_failure("v 1 2\nv 1 2 3\n", LRCS_E_SYNTAX, 5, 1, item, "end of line");
    check_failure("v 1 2", LRCS_E_TRUNCATED, 5, 1, item, "end of file");
    check_failure("v 1 2 3 red\n", LRCS_E_SYNTAX, 8, 1, item, "red");
}

static void coordinates_that_are_not_finite_or_huge_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"nan",   "NaN",    "-nan",     "inf",      "-Inf", "INFINITY",
                                      "1e999", "-1e999", "1.01e100", "-1.1e100", "1e308"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "\nv 1 %s 2\n", bad[i]);
        check_failure(text, LRCS_E_NUMBER, 5, 2, "vertex coordinate", bad[i]);
    }
    check_facets("v 1e100 -1e100 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "0,1,2");
}

static void words_that_resemble_nan_or_inf_are_no_numbers(void **state)
{
    (void)state;
    static const char *const bad[] = {"n", "ni", "nod", "none", "nix", "int", "iota", "-no", "+x"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "\nv 1 %s 2\n", bad[i]);
        check_failure(text, LRCS_E_SYNTAX, 5, 2, "vertex coordinate", bad[i]);
    }
}

static void smoothing_groups_that_are_no_numbers_are_refused(void **state)
{
    (void)state;
    check_failure("s maybe\n", LRCS_E_SYNTAX, 2, 1, "smoothing group", "maybe");
    check_failure("s -1\n", LRCS_E_SYNTAX, 2, 1, "smoothing group", "-1");
}

static const char sample[] =
    "\xef\xbb\xbf# sample\r\nmtllib a b.mtl\no one\nv 0 0 0\nv 1.5e0 0 0\rv 1 1 \\\n0 1\n"
    "v -.25 1 0\nvn 0 0 1\nusemtl red \xe9\ns 3\nf 1//1 2//1 3//1 4//1\ng two words\n"
    "usemtl blue\nf -4 -3 -1\ns off\nf 1 2 4 # end\no one\nf 4 3 2 1 2 3\n";

static void failure_leaves_the_outputs_untouched(void **state)
{
    (void)state;
    lrcs_mesh_counts counts;
    lrcs_mesh mesh;
    unsigned char area[4096];
    memset(&counts, 0x5a, sizeof counts);
    memset(&mesh, 0x5a, sizeof mesh);
    lrcs_mesh_counts counts_before = counts;
    lrcs_mesh mesh_before = mesh;
    lrcs_work work = lrcs_work_make(area, sizeof area);
    static const char bad[] = SQUARE "f 1 2 3\nf 1 2 9\n";
    assert_int_equal(lrcs_obj_count(bad, sizeof bad - 1, &counts, NULL), LRCS_E_INDEX);
    assert_int_equal(lrcs_obj_read(bad, sizeof bad - 1, &work, &mesh, NULL), LRCS_E_INDEX);
    assert_memory_equal(&counts, &counts_before, sizeof counts);
    assert_memory_equal(&mesh, &mesh_before, sizeof mesh);
    assert_int_equal(work.used, 0);
}

static void a_work_area_is_refused_until_it_is_large_enough(void **state)
{
    (void)state;
    lrcs_mesh_counts counts;
    assert_int_equal(lrcs_obj_count(sample, sizeof sample - 1, &counts, NULL), LRCS_OK);
    size_t need = lrcs_mesh_need(&counts);
    int served = 0;
    for (size_t size = 0; size <= need; size++) {
        unsigned char *area = malloc(size ? size : 1);
        assert_non_null(area);
        lrcs_work work = lrcs_work_make(area, size);
        lrcs_mesh mesh = {.vertex_count = 4711};
        lrcs_where where;
        int status = lrcs_obj_read(sample, sizeof sample - 1, &work, &mesh, &where);
        if (status == LRCS_E_MEMORY) {
            assert_int_equal(served, 0);
            assert_int_equal(work.used, 0);
            assert_int_equal(mesh.vertex_count, 4711);
            assert_string_equal(where.item, "work area");
        } else {
            assert_int_equal(status, LRCS_OK);
            assert_int_equal(mesh.vertex_count, 4);
            assert_int_equal(mesh.facet_count, 8);
            served = 1;
        }
        free(area);
    }
    assert_int_equal(served, 1);
}

/* Checks the properties of every mesh that was read, whatever the bytes. */
static void check_sound(const obj_case *c)
{
    const lrcs_mesh *m = &c->mesh;
    assert_int_equal(m->vertex_count, c->counts.vertices);
    assert_int_equal(m->facet_count, c->counts.facets);
    assert_true(m->part_count <= c->counts.parts && m->material_count <= c->counts.materials);
    for (uint32_t i = 0; i < 3 * m->vertex_count; i++) {
        check_most(fabs(m->vertex[i / 3].x[i % 3]), 1e100);
    }
    for (uint32_t i = 0; i < m->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            assert_true(m->facet[i].corner[k] < m->vertex_count);
        }
        assert_true(m->facet_part[i] < m->part_count);
        assert_true(m->facet_material[i] == LRCS_NONE || m->facet_material[i] < m->material_count);
    }
    for (uint32_t i = 0; i < m->part_count; i++) {
        assert_true(strlen(m->part[i]) <= sizeof sample * 2);
    }
    for (uint32_t i = 0; i < m->material_count; i++) {
        assert_true(strlen(m->material[i].name) <= sizeof sample * 2);
    }
}

/* Reads, and checks the contract of the reader, whether it succeeds or fails. Returns 1 if it
   succeeds. */
static int attack(const char *bytes, size_t size)
{
    obj_case c = open_bytes(bytes, size);
    if (c.status == LRCS_OK) {
        check_sound(&c);
    } else {
        assert_true(c.status < 0 && c.status != LRCS_E_MEMORY);
        assert_non_null(c.where.item);
        assert_non_null(c.where.expected);
        assert_true(c.where.offset <= size && c.where.line >= 1);
    }
    int good = c.status == LRCS_OK;
    close_case(&c);
    return good;
}

static void every_prefix_is_read_or_refused(void **state)
{
    (void)state;
    int good = 0;
    for (size_t size = 0; size < sizeof sample; size++) {
        good += attack(sample, size);
    }
    assert_true(good > 50 && good < (int)sizeof sample - 20);
}

static void flipped_bytes_are_read_or_refused(void **state)
{
    (void)state;
    static const char spice[] = "0123456789+-./eE# \t\r\n\\vfosgnai\xff";
    uint64_t seed = 20140156;
    int good = 0;
    enum { TRIES = 20000 };
    for (int i = 0; i < TRIES; i++) {
        char bytes[sizeof sample];
        memcpy(bytes, sample, sizeof sample);
        for (int k = 0; k <= i % 4; k++) {
            random_mmix(&seed);
            size_t at = (size_t)(seed >> 33) % (sizeof sample - 1);
            unsigned char bit = (unsigned char)(1u << (seed >> 29 & 7));
            bytes[at] = (seed >> 28 & 1) ? spice[(seed >> 20 & 255) % (sizeof spice - 1)]
                                         : (char)((unsigned char)bytes[at] ^ bit);
        }
        good += attack(bytes, sizeof sample - 1);
    }
    assert_true(good > TRIES / 20 && good < TRIES * 19 / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_are_fanned_from_their_first_vertex),
        cmocka_unit_test(all_forms_of_corners_are_read),
        cmocka_unit_test(negative_indices_count_back_from_the_face),
        cmocka_unit_test(normals_are_read_as_they_are_given),
        cmocka_unit_test(a_file_without_normals_stores_none),
        cmocka_unit_test(indices_of_normals_out_of_range_are_refused),
        cmocka_unit_test(normals_that_are_no_numbers_are_refused),
        cmocka_unit_test(positive_indices_may_point_forward),
        cmocka_unit_test(coordinates_are_read_to_the_last_bit),
        cmocka_unit_test(weights_and_vertex_colours_are_passed_over),
        cmocka_unit_test(materials_come_in_order_of_first_use),
        cmocka_unit_test(parts_are_names_of_o_and_g_in_order_of_their_facets),
        cmocka_unit_test(a_group_without_name_is_the_unnamed_part),
        cmocka_unit_test(names_keep_inner_blanks_and_lose_outer_ones),
        cmocka_unit_test(names_that_are_not_utf8_are_latin1_and_noticed),
        cmocka_unit_test(many_names_are_distinguished),
        cmocka_unit_test(smoothing_groups_become_bits),
        cmocka_unit_test(the_first_material_file_is_remembered),
        cmocka_unit_test(all_line_endings_are_read),
        cmocka_unit_test(a_backslash_continues_the_line),
        cmocka_unit_test(comments_end_with_their_line),
        cmocka_unit_test(blanks_tabs_and_empty_lines_are_nothing),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(other_statements_are_passed_over),
        cmocka_unit_test(a_file_without_facets_is_an_empty_mesh),
        cmocka_unit_test(no_bytes_are_an_error),
        cmocka_unit_test(faces_of_fewer_than_three_vertices_are_refused),
        cmocka_unit_test(indices_outside_the_list_are_refused),
        cmocka_unit_test(corners_that_are_no_indices_are_refused),
        cmocka_unit_test(coordinates_that_are_no_numbers_are_refused),
        cmocka_unit_test(coordinates_that_are_not_finite_or_huge_are_refused),
        cmocka_unit_test(words_that_resemble_nan_or_inf_are_no_numbers),
        cmocka_unit_test(smoothing_groups_that_are_no_numbers_are_refused),
        cmocka_unit_test(failure_leaves_the_outputs_untouched),
        cmocka_unit_test(a_work_area_is_refused_until_it_is_large_enough),
        cmocka_unit_test(every_prefix_is_read_or_refused),
        cmocka_unit_test(flipped_bytes_are_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
