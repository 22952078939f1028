/* SPDX-License-Identifier: MIT */
/* STL: the two kinds distinguished, welding, and malformed files, which must be refused. */
#include "mesh/read/stl.h"

#include <lrcs/read.h>

#include "hostile.h"

static const hostile_reader reader_stl = {lrcs_stl_count, lrcs_stl_read};

static unsigned char area[1 << 20];

/* A binary file: 84 bytes of head, 50 a facet. */
typedef struct binary {
    unsigned char bytes[4096];
    size_t size;
} binary;

static void put_float(binary *file, double value)
{
    float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    for (int i = 0; i < 4; i++) {
        file->bytes[file->size++] = (unsigned char)(bits >> 8 * i);
    }
}

static void put_count(binary *file, uint32_t count)
{
    for (int i = 0; i < 4; i++) {
        file->bytes[80 + i] = (unsigned char)(count >> 8 * i);
    }
}

static void begin_binary(binary *file, const char *header)
{
    memset(file->bytes, 0, 84);
    memcpy(file->bytes, header, strlen(header));
    file->size = 84;
}

/* A facet of three corners, with its stored normal. */
static void put_facet(binary *file, const double normal[3], const double corner[9])
{
    for (int i = 0; i < 3; i++) {
        put_float(file, normal[i]);
    }
    for (int i = 0; i < 9; i++) {
        put_float(file, corner[i]);
    }
    file->bytes[file->size++] = 0x34; /* an attribute word, of no meaning */
    file->bytes[file->size++] = 0x12;
    put_count(file, (uint32_t)((file->size - 84) / 50));
}

static const double up[3] = {0, 0, 1};
static const double lower[9] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
static const double upper[9] = {0, 0, 0, 1, 1, 0, 0, 1, 0};

static void make_square(binary *file, const char *header)
{
    begin_binary(file, header);
    put_facet(file, up, lower);
    put_facet(file, up, upper);
}

static int try_read(const void *bytes, size_t size, lrcs_mesh *mesh, lrcs_where *where)
{
    lrcs_work work = lrcs_work_make(area, sizeof area);
    int status = lrcs_stl_read(bytes, size, &work, mesh, where);
    assert_int_equal(check_read(&reader_stl, bytes, size), status);
    return status;
}

static lrcs_mesh read_bytes(const void *bytes, size_t size)
{
    lrcs_mesh mesh;
    lrcs_where where = {0};
    int status = try_read(bytes, size, &mesh, &where);
    if (status != LRCS_OK) {
        print_message("%s, line %u: %s, found %s\n", lrcs_status_text(status), where.line,
                      where.item, where.found);
    }
    assert_int_equal(status, LRCS_OK);
    return mesh;
}

static lrcs_mesh read_text(const char *text)
{
    return read_bytes(text, strlen(text));
}

/* The text must be refused with this status on this line. */
static void refuse_text(const char *text, int status, uint32_t line)
{
    lrcs_mesh mesh;
    lrcs_where where;
    assert_int_equal(try_read(text, strlen(text), &mesh, &where), status);
    assert_int_equal(where.line, line);
}

#define LOWER                                                                                      \
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 1 1 0\n"               \
    " endloop\nendfacet\n"
#define UPPER                                                                                      \
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 1 0\n vertex 0 1 0\n"               \
    " endloop\nendfacet\n"
#define SQUARE LOWER UPPER

static void check_square(const lrcs_mesh *mesh)
{
    static const double vertex[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    static const uint32_t corner[2][3] = {{0, 1, 2}, {0, 2, 3}};
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->facet_count, 2);
    assert_int_equal(mesh->part_count, 1);
    assert_int_equal(mesh->material_count, 0);
    for (int i = 0; i < 12; i++) {
        check_same(mesh->vertex[i / 3].x[i % 3], vertex[i / 3][i % 3]);
    }
    for (int i = 0; i < 6; i++) {
        assert_int_equal(mesh->facet[i / 3].corner[i % 3], corner[i / 3][i % 3]);
    }
    for (int i = 0; i < 2; i++) {
        assert_int_equal(mesh->facet_material[i], LRCS_NONE);
        assert_int_equal(mesh->facet_part[i], 0);
        assert_int_equal(mesh->facet_smooth[i], 0);
    }
}

/* --- binary -----------------------------------------------------------------------------------*/

static void corners_are_welded_in_order_of_first_use(void **state)
{
    (void)state;
    binary file;
    make_square(&file, "made for a test");
    lrcs_mesh mesh = read_bytes(file.bytes, file.size);
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "");
    assert_int_equal(mesh.notices, 0);
}

static void counting_gives_three_vertices_a_facet(void **state)
{
    (void)state;
    binary file;
    make_square(&file, "");
    lrcs_mesh_counts counts;
    assert_int_equal(lrcs_stl_count(file.bytes, file.size, &counts, NULL), LRCS_OK);
    assert_int_equal(counts.vertices, 6);
    assert_int_equal(counts.facets, 2);
    assert_int_equal(counts.parts, 1);
}

static void minus_zero_is_welded_to_zero(void **state)
{
    (void)state;
    static const double signed_zero[9] = {-0.0, -0.0, 0, 1, 1, -0.0, -0.0, 1, 0};
    binary file;
    begin_binary(&file, "");
    put_facet(&file, up, lower);
    put_facet(&file, up, signed_zero);
    lrcs_mesh mesh = read_bytes(file.bytes, file.size);
    check_square(&mesh);
}

static void neighbours_by_one_bit_stay_apart(void **state)
{
    (void)state;
    binary file;
    make_square(&file, "");
    file.bytes[file.size - 50 + 12] = 1; /* the first corner's x becomes the least float */
    lrcs_mesh mesh = read_bytes(file.bytes, file.size);
    assert_int_equal(mesh.vertex_count, 5);
    check_same(mesh.vertex[3].x[0], 0x1p-149);
}

static void what_welding_saves_is_given_back(void **state)
{
    (void)state;
    binary file;
    begin_binary(&file, "");
    for (int i = 0; i < 40; i++) {
        put_facet(&file, up, lower);
    }
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_mesh mesh;
    lrcs_where where;
    assert_int_equal(lrcs_stl_read(file.bytes, file.size, &work, &mesh, &where), LRCS_OK);
    assert_int_equal(mesh.vertex_count, 3);
    assert_ptr_equal(work.bytes + work.used, mesh.vertex + 3);
}

static void a_binary_file_may_start_with_solid(void **state)
{
    (void)state;
    static const char *const header[] = {"solid", "solid cube", "solid a\nfacet normal 0 0 1",
                                         "solid a\n", "SOLID\r\n   "};
    for (size_t i = 0; i < sizeof header / sizeof *header; i++) {
        binary file;
        make_square(&file, header[i]);
        lrcs_mesh mesh = read_bytes(file.bytes, file.size);
        check_square(&mesh);
    }
}

static void stray_bytes_behind_a_binary_file_are_noticed(void **state)
{
    (void)state;
    binary file;
    make_square(&file, "solid with more behind it");
    for (int i = 0; i < 120; i++) {
        file.bytes[file.size++] = (unsigned char)(i % 3 ? i : '\n');
        lrcs_mesh mesh = read_bytes(file.bytes, file.size);
        check_square(&mesh);
        assert_int_equal(mesh.notices, LRCS_MESH_TRAILING_BYTES);
    }
}

static void a_binary_file_cut_short_is_said_to_be(void **state)
{
    (void)state;
    static const char *const header[] = {"made for a test", "solid cube"};
    for (size_t i = 0; i < 2; i++) {
        binary file;
        make_square(&file, header[i]);
        for (size_t size = 1; size < file.size; size++) {
            lrcs_mesh mesh;
            lrcs_where where;
            assert_int_equal(try_read(file.bytes, size, &mesh, &where), LRCS_E_TRUNCATED);
        }
    }
}

static void an_inflated_count_is_refused(void **state)
{
    (void)state;
    binary file;
    make_square(&file, "");
    put_count(&file, 0xffffffffu);
    lrcs_mesh mesh;
    lrcs_where where;
    assert_int_equal(try_read(file.bytes, file.size, &mesh, &where), LRCS_E_TRUNCATED);
    assert_int_equal(where.offset, 80);
    assert_string_equal(where.found, "4294967295 with bytes for 2");
}

static void corners_that_are_not_finite_are_refused_where_they_stand(void **state)
{
    (void)state;
    static const double bad[] = {HUGE_VAL, -HUGE_VAL, (double)NAN};
    for (size_t i = 0; i < 27; i++) {
        binary file;
        make_square(&file, "");
        size_t at = 84 + 50 + 12 + 4 * (i % 9);
        size_t end = file.size;
        file.size = at;
        put_float(&file, bad[i / 9]);
        file.size = end;
        lrcs_mesh mesh;
        lrcs_where where;
        assert_int_equal(try_read(file.bytes, file.size, &mesh, &where), LRCS_E_NUMBER);
        assert_int_equal(where.offset, at);
    }
}

static void normals_against_the_winding_are_noticed(void **state)
{
    (void)state;
    static const struct {
        double normal[3];
        uint32_t notices;
    } given[] = {{{0, 0, 1}, 0},
                 {{0, 0, -1}, LRCS_MESH_NORMALS_DISAGREE},
                 {{1, 0, -0x1p-10}, LRCS_MESH_NORMALS_DISAGREE},
                 {{1, 0, 0}, 0}, /* in the plane: neither way */
                 {{0, 0, 0}, 0}, /* left out by the writer */
                 {{(double)NAN, 0, -1}, 0},
                 {{0, 0, -HUGE_VAL}, 0}};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        binary file;
        begin_binary(&file, "");
        put_facet(&file, up, lower);
        put_facet(&file, given[i].normal, upper);
        lrcs_mesh mesh = read_bytes(file.bytes, file.size);
        check_square(&mesh);
        assert_int_equal(mesh.notices, given[i].notices);
    }
}

static void a_binary_file_without_facets_is_an_empty_mesh(void **state)
{
    (void)state;
    binary file;
    begin_binary(&file, "");
    lrcs_mesh mesh = read_bytes(file.bytes, file.size);
    assert_int_equal(mesh.facet_count + mesh.vertex_count, 0);
    assert_int_equal(mesh.part_count, 1);
}

static void no_bytes_are_refused(void **state)
{
    (void)state;
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(lrcs_stl_count(NULL, 0, &counts, &where), LRCS_E_EMPTY);
}

/* --- text -------------------------------------------------------------------------------------*/

static void text_is_read(void **state)
{
    (void)state;
    lrcs_mesh mesh = read_text("solid a square\n" SQUARE "endsolid a square\n");
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "a square");
    assert_int_equal(mesh.notices, 0);
}

static void the_end_may_be_missing(void **state)
{
    (void)state;
    lrcs_mesh mesh = read_text("solid\n" SQUARE);
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "");
}

static void white_space_and_byte_order_mark_may_lead(void **state)
{
    (void)state;
    lrcs_mesh mesh = read_text("\xef\xbb\xbf \t\r\n\n  solid s\n" SQUARE "endsolid\n");
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "s");
}

/* The square's text with every line end replaced. */
static void check_line_ends(const char *line_end)
{
    static const char text[] = "solid s \n" SQUARE "endsolid s\n";
    char changed[2 * sizeof text];
    size_t used = 0;
    for (size_t i = 0; text[i]; i++) {
        if (text[i] == '\n') {
            memcpy(changed + used, line_end, strlen(line_end));
            used += strlen(line_end);
        } else {
            changed[used++] = text[i];
        }
    }
    lrcs_mesh mesh = read_bytes(changed, used);
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "s");
}

static void lines_end_in_lf_crlf_or_cr(void **state)
{
    (void)state;
    check_line_ends("\n");
    check_line_ends("\r\n");
    check_line_ends("\r");
    check_line_ends(" \t\n\n\v\f");
}

static void words_are_read_in_either_case(void **state)
{
    (void)state;
    char text[] = "solid s\n" SQUARE "endsolid s\n";
    for (size_t i = 0; text[i]; i++) {
        text[i] = text[i] >= 'a' && text[i] <= 'z' ? (char)(text[i] - 32) : text[i];
    }
    lrcs_mesh mesh = read_text(text);
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "S");
}

static void a_file_may_be_one_line(void **state)
{
    (void)state;
    char text[] = "solid one line\n" SQUARE "endsolid one line";
    for (size_t i = 0; text[i]; i++) {
        text[i] = text[i] == '\n' ? ' ' : text[i];
    }
    lrcs_mesh mesh = read_text(text);
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "one line");
}

static void text_is_known_by_the_words_that_start_it(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int is_text;
    } of[] = {{"solid a\nfacet", 1},
              {"solid a\nendsolid", 1},
              {"solid a\nsolid", 1},
              {"solid a\n", 1},
              {"solid", 1},
              {"facet normal 0 0 1", 1},
              {"solid a\nof something", 0},
              {"facet of something", 0},
              {"a solid\nfacet", 0}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        const unsigned char *bytes = (const unsigned char *)of[i].text;
        assert_int_equal(lrcsi_stl_is_text(bytes, strlen(of[i].text)), of[i].is_text);
    }
}

static void several_solids_are_one_part(void **state)
{
    (void)state;
    lrcs_mesh mesh =
        read_text("solid first\n" LOWER "endsolid first\n\nsolid second\n" UPPER "endsolid\n");
    check_square(&mesh);
    assert_string_equal(mesh.part[0], "first");
    mesh = read_text("solid first\n" LOWER "solid second\n" UPPER);
    check_square(&mesh);
}

static void names_may_hold_anything(void **state)
{
    (void)state;
    static const char *const name[] = {
        "Exported from Blender-2.79 (sub 0)",       "facet",        "facet normal",
        "endsolid solid facet normal vertex 1 2 3", "\x01\x7f\xe9", "v 1 2 3 # {}"};
    static const char *const want[] = {
        "Exported from Blender-2.79 (sub 0)",       "facet",      "facet normal",
        "endsolid solid facet normal vertex 1 2 3", "??\xc3\xa9", "v 1 2 3 # {}"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        char text[1024];
        snprintf(text, sizeof text, "solid %s\n%sendsolid %s\n", name[i], SQUARE, name[i]);
        lrcs_mesh mesh = read_text(text);
        check_square(&mesh);
        assert_string_equal(mesh.part[0], want[i]);
        assert_int_equal(mesh.notices, i == 4 ? LRCS_MESH_LATIN1_NAMES : 0);
    }
}

static void a_long_blank_name_takes_linear_time(void **state)
{
    (void)state;
    /* a million blanks: were each place to look ahead over them all, this would take minutes */
    size_t size = 1000000;
    char *text = malloc(size);
    assert_non_null(text);
    memset(text, ' ', size);
    memcpy(text, "solid x facet normal", 20);
    memcpy(text + size - 10, "\nendsolid\n", 10);
    lrcs_mesh_counts counts;
    assert_int_equal(lrcs_stl_count(text, size, &counts, NULL), LRCS_OK);
    assert_int_equal(counts.facets, 0);
    free(text);
}

static void stored_normals_need_not_be_numbers(void **state)
{
    (void)state;
    lrcs_mesh mesh = read_text(
        "solid\n" LOWER
        "facet normal -nan(ind) nan 1.#QNAN\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid\n");
    check_square(&mesh);
    assert_int_equal(mesh.notices, 0);
}

static void numbers_are_read_in_every_decimal_form(void **state)
{
    (void)state;
    lrcs_mesh mesh = read_text("solid\nfacet normal 0 0 1\nouter loop\n"
                               "vertex 1.5e+00 -.25 +3.\nvertex 1E2 0.1 -1e-400\n"
                               "vertex -1e100 1e100 0\nendloop\nendfacet\n");
    check_same(mesh.vertex[0].x[0], 1.5);
    check_same(mesh.vertex[0].x[1], -0.25);
    check_same(mesh.vertex[0].x[2], 3.0);
    check_same(mesh.vertex[1].x[0], 100.0);
    check_same(mesh.vertex[1].x[1], 0.1);
    check_same(mesh.vertex[1].x[2], 0.0);
    check_same(mesh.vertex[2].x[1], 1e100);
}

static void coordinates_that_no_mesh_holds_are_refused_with_their_line(void **state)
{
    (void)state;
    static const char *const number[] = {"1.1e100", "-1e101", "1e999", "nan", "-inf", "NaN(5)"};
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        char text[256];
        snprintf(text, sizeof text, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 %s 0\n",
                 number[i]);
        refuse_text(text, LRCS_E_NUMBER, 4);
    }
    refuse_text("solid\r\nfacet normal 0 0 1\r\nouter loop\r\nvertex 0 zero 0\r\n", LRCS_E_SYNTAX,
                4);
    refuse_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 1.0x 0\n", LRCS_E_SYNTAX, 4);
    refuse_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0x10 0\n", LRCS_E_SYNTAX, 4);
}

static void words_out_of_place_are_refused_with_their_line(void **state)
{
    (void)state;
    refuse_text("solid\nfacet 0 0 1\n", LRCS_E_SYNTAX, 2);
    refuse_text("solid\n" LOWER "vertex 0 0 0\n", LRCS_E_SYNTAX, 9);
    refuse_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 1\n"
                "vertex 1 1 1\nendloop\nendfacet\n",
                LRCS_E_SYNTAX, 7);
    refuse_text("solid\n" LOWER "endsolid\nrubbish", LRCS_E_SYNTAX, 10);
}

static void text_cut_short_is_said_to_be(void **state)
{
    (void)state;
    refuse_text("solid", LRCS_E_TRUNCATED, 1);
    refuse_text("solid name\n", LRCS_E_TRUNCATED, 2);
    refuse_text("solid\nfacet", LRCS_E_TRUNCATED, 2);
    refuse_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0", LRCS_E_TRUNCATED, 4);
}

static void text_without_facets_is_an_empty_mesh(void **state)
{
    (void)state;
    lrcs_mesh mesh = read_text("solid nothing\nendsolid nothing\n");
    assert_int_equal(mesh.facet_count, 0);
    assert_string_equal(mesh.part[0], "nothing");
}

/* --- attacks ----------------------------------------------------------------------------------*/

static void cut_files_give_a_status_or_a_sound_mesh(void **state)
{
    (void)state;
    static const char text[] = "solid s\xe9\n" SQUARE "endsolid s\nsolid\n" LOWER;
    binary file;
    make_square(&file, "solid");
    attack_by_cutting(&reader_stl, file.bytes, file.size);
    attack_by_cutting(&reader_stl, text, sizeof text - 1);
}

static void changed_bytes_give_a_status_or_a_sound_mesh(void **state)
{
    (void)state;
    static const char text[] = "solid s\n" SQUARE "endsolid s\n";
    binary file;
    make_square(&file, "solid");
    attack_by_bits(&reader_stl, file.bytes, file.size);
    attack_by_bytes(&reader_stl, file.bytes, file.size, 3000);
    attack_by_inflation(&reader_stl, file.bytes, file.size);
    attack_by_bits(&reader_stl, text, sizeof text - 1);
    attack_by_bytes(&reader_stl, text, sizeof text - 1, 3000);
}

static void a_read_in_too_little_memory_takes_and_touches_nothing(void **state)
{
    (void)state;
    static const char text[] = "solid s\n" SQUARE;
    binary file;
    make_square(&file, "solid");
    attack_by_too_little_memory(&reader_stl, file.bytes, file.size);
    attack_by_too_little_memory(&reader_stl, text, sizeof text - 1);
}

/* A text with more facets would have some 2^36 bytes: so many are said to be read. */
static void facets_end_where_indices_of_their_corners_do(void **state)
{
    (void)state;
    static const char text[] = "solid s facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0\n"
                               "vertex 0 1 0 endloop endfacet endsolid";
    for (uint32_t less = 0; less < 2; less++) {
        lrcs_where where = {0};
        lrcsi_stl_walk walk = {.bytes = (const unsigned char *)text,
                               .size = sizeof text - 1,
                               .where = &where,
                               .facets = (LRCS_NONE - 1) / 3 - less};
        assert_int_equal(lrcsi_stl_read_text(&walk), less ? LRCS_OK : LRCS_E_LIMIT);
        assert_int_equal(walk.facets, (LRCS_NONE - 1) / 3);
        assert_true(less ? !where.item : strcmp(where.item, "facet") == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_are_welded_in_order_of_first_use),
        cmocka_unit_test(counting_gives_three_vertices_a_facet),
        cmocka_unit_test(minus_zero_is_welded_to_zero),
        cmocka_unit_test(neighbours_by_one_bit_stay_apart),
        cmocka_unit_test(what_welding_saves_is_given_back),
        cmocka_unit_test(a_binary_file_may_start_with_solid),
        cmocka_unit_test(stray_bytes_behind_a_binary_file_are_noticed),
        cmocka_unit_test(a_binary_file_cut_short_is_said_to_be),
        cmocka_unit_test(an_inflated_count_is_refused),
        cmocka_unit_test(corners_that_are_not_finite_are_refused_where_they_stand),
        cmocka_unit_test(normals_against_the_winding_are_noticed),
        cmocka_unit_test(a_binary_file_without_facets_is_an_empty_mesh),
        cmocka_unit_test(no_bytes_are_refused),
        cmocka_unit_test(text_is_read),
        cmocka_unit_test(the_end_may_be_missing),
        cmocka_unit_test(white_space_and_byte_order_mark_may_lead),
        cmocka_unit_test(lines_end_in_lf_crlf_or_cr),
        cmocka_unit_test(words_are_read_in_either_case),
        cmocka_unit_test(a_file_may_be_one_line),
        cmocka_unit_test(text_is_known_by_the_words_that_start_it),
        cmocka_unit_test(several_solids_are_one_part),
        cmocka_unit_test(names_may_hold_anything),
        cmocka_unit_test(a_long_blank_name_takes_linear_time),
        cmocka_unit_test(stored_normals_need_not_be_numbers),
        cmocka_unit_test(numbers_are_read_in_every_decimal_form),
        cmocka_unit_test(coordinates_that_no_mesh_holds_are_refused_with_their_line),
        cmocka_unit_test(words_out_of_place_are_refused_with_their_line),
        cmocka_unit_test(text_cut_short_is_said_to_be),
        cmocka_unit_test(text_without_facets_is_an_empty_mesh),
        cmocka_unit_test(cut_files_give_a_status_or_a_sound_mesh),
        cmocka_unit_test(changed_bytes_give_a_status_or_a_sound_mesh),
        cmocka_unit_test(a_read_in_too_little_memory_takes_and_touches_nothing),
        cmocka_unit_test(facets_end_where_indices_of_their_corners_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
