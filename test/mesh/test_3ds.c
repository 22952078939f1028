/* SPDX-License-Identifier: MIT */
/* Peculiarities of real 3DS files, one in each test; and malformed files, which must be refused. */
#include <lrcs/read.h>

#include "mesh/read/3ds.h"

#include "build3ds.h"
#include "hostile.h"

static const hostile_reader reader_3ds = {lrcs_3ds_count, lrcs_3ds_read};

static build3ds file; /* too large for a stack */
static unsigned char area[1 << 22];

/* Reads `file`, which must be readable. */
static lrcs_mesh read_file(void)
{
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_mesh mesh;
    lrcs_where where = {0};
    int status = lrcs_3ds_read(file.bytes, file.size, &work, &mesh, &where);
    if (status != LRCS_OK) {
        print_message("%s, at %lu: %s\n", lrcs_status_text(status), (unsigned long)where.offset,
                      where.item);
    }
    assert_int_equal(status, LRCS_OK);
    assert_int_equal(check_read(&reader_3ds, file.bytes, file.size), LRCS_OK);
    return mesh;
}

/* `file` must be refused with this status at this place. */
static void refuse_file(int status, size_t offset)
{
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(lrcs_3ds_count(file.bytes, file.size, &counts, &where), status);
    assert_int_equal(where.offset, offset);
    assert_int_equal(check_read(&reader_3ds, file.bytes, file.size), status);
}

/* --- chunks -----------------------------------------------------------------------------------*/

static void a_square_is_read_as_stored(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "gold", 255, 204, 0);
    build3ds_panel(&file, "panel", 2.5f, "gold");
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.facet_count, 2);
    assert_int_equal(mesh.part_count, 1);
    assert_int_equal(mesh.material_count, 1);
    assert_int_equal(mesh.notices, 0);
    assert_null(mesh.material_file);
    check_same(mesh.vertex[2].x[0], 1.0);
    check_same(mesh.vertex[2].x[1], 1.0);
    check_same(mesh.vertex[2].x[2], 2.5);
    assert_int_equal(mesh.facet[1].corner[2], 3);
    assert_int_equal(mesh.facet_material[1], 0);
    assert_string_equal(mesh.part[0], "panel");
    assert_string_equal(mesh.material[0].name, "gold");
    assert_int_equal(mesh.material[0].rgb[1], 204);
    assert_int_equal(mesh.material[0].has_colour, 1);
    assert_int_equal(mesh.material[0].two_sided, 0);
}

static void several_meshes_lie_behind_each_other(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_panel(&file, "same", 1.0f, "x");
    build3ds_panel(&file, "same", 2.0f, "x");
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.part_count, 2); /* equal names are two parts */
    assert_string_equal(mesh.part[1], "same");
    assert_int_equal(mesh.facet_part[1], 0);
    assert_int_equal(mesh.facet_part[2], 1);
    assert_int_equal(mesh.facet[3].corner[2], 7);
    check_same(mesh.vertex[mesh.facet[3].corner[2]].x[2], 2.0);
}

static void two_meshes_in_one_object_are_two_parts(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "pair");
    build3ds_square(&file, 0.0f);
    build3ds_close(&file);
    build3ds_open(&file, 0x4100);
    build3ds_square(&file, 1.0f);
    build3ds_faces(&file);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.part_count, 2);
    assert_string_equal(mesh.part[0], "pair");
    assert_string_equal(mesh.part[1], "pair");
    assert_int_equal(mesh.facet_part[0], 1);
    assert_int_equal(mesh.facet[0].corner[0], 4);
}

static void a_long_name_of_many_meshes_is_stored_once(void **state)
{
    (void)state;
    static char name[20000];
    memset(name, 'n', sizeof name - 1);
    build3ds_begin(&file);
    build3ds_mesh(&file, name);
    for (int i = 0; i < 20000; i++) {
        build3ds_close(&file);
        build3ds_open(&file, 0x4100);
    }
    build3ds_end(&file);
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(lrcs_3ds_count(file.bytes, file.size, &counts, &where), LRCS_OK);
    assert_int_equal(counts.parts, 20001);
    assert_int_equal(counts.text_bytes, sizeof name);
}

static void materials_may_stand_behind_and_between_objects(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_panel(&file, "a", 0.0f, "late");
    build3ds_material(&file, "middle", 1, 2, 3);
    build3ds_panel(&file, "b", 1.0f, "middle");
    build3ds_material(&file, "late", 4, 5, 6);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_material[0], 1);
    assert_int_equal(mesh.facet_material[2], 0);
    assert_string_equal(mesh.material[1].name, "late");
    assert_int_equal(mesh.notices, 0);
}

static void chunks_of_a_mesh_come_in_any_order(void **state)
{
    (void)state;
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                    {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int i = 0; i < 6; i++) {
        build3ds_begin(&file);
        build3ds_mesh(&file, "m");
        for (int k = 0; k < 3; k++) {
            if (order[i][k] == 0) {
                build3ds_square(&file, 0.0f);
            } else if (order[i][k] == 1) {
                build3ds_faces(&file);
                build3ds_smooth(&file, 1, 2);
                build3ds_close(&file);
            } else {
                build3ds_matrix(&file, 1.0f);
            }
        }
        build3ds_end(&file);
        lrcs_mesh mesh = read_file();
        assert_int_equal(mesh.facet[1].corner[2], 3);
        assert_int_equal(mesh.facet_smooth[1], 2);
    }
}

static void sections_come_in_any_order_and_number(void **state)
{
    (void)state;
    file.size = 0;
    build3ds_open(&file, 0x4d4d);
    build3ds_open(&file, 0xb000);
    build3ds_close(&file);
    build3ds_open(&file, 0x3d3d);
    build3ds_panel(&file, "p", 0.0f, "m");
    build3ds_close(&file);
    build3ds_open(&file, 0x3d3d);
    build3ds_material(&file, "m", 1, 2, 3);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_material[1], 0);
    assert_int_equal(mesh.notices, 0); /* a keyframer without nodes is none */
}

/* A chunk with an unknown id, with bytes that look like a chunk of no length. */
static void unknown_chunk(void)
{
    build3ds_open(&file, 0x7777);
    build3ds_u32(&file, 0x41004100);
    build3ds_u32(&file, 0);
    build3ds_close(&file);
}

static void unknown_chunks_are_skipped_at_every_level(void **state)
{
    (void)state;
    file.size = 0;
    build3ds_open(&file, 0x4d4d);
    unknown_chunk();
    build3ds_open(&file, 0x3d3d);
    unknown_chunk();
    build3ds_open(&file, 0xafff);
    unknown_chunk();
    build3ds_open(&file, 0xa020);
    unknown_chunk();
    build3ds_colour24(&file, 0x0011, 9, 8, 7);
    build3ds_close(&file);
    build3ds_open(&file, 0xa000); /* the name last */
    build3ds_name(&file, "m");
    build3ds_close(&file);
    build3ds_close(&file);
    build3ds_open(&file, 0x4000);
    build3ds_name(&file, "o");
    unknown_chunk();
    build3ds_open(&file, 0x4100);
    unknown_chunk();
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    unknown_chunk();
    build3ds_group(&file, "m", 0, 2);
    unknown_chunk();
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_count, 2);
    assert_int_equal(mesh.facet_material[1], 0);
    assert_int_equal(mesh.material[0].rgb[0], 9);
    assert_int_equal(mesh.notices, 0);
}

static void stray_bytes_behind_the_root_are_noticed(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_panel(&file, "p", 0.0f, "m");
    build3ds_end(&file);
    for (unsigned i = 0; i < 9; i++) {
        build3ds_u8(&file, 0xee);
        lrcs_mesh mesh = read_file();
        assert_int_equal(mesh.facet_count, 2);
        assert_true(mesh.notices & LRCS_MESH_TRAILING_BYTES);
    }
}

static void a_root_length_beyond_the_file_is_noticed_if_all_else_fits(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_panel(&file, "p", 0.0f, "m");
    build3ds_end(&file);
    build3ds_put(&file, 2, (uint32_t)file.size + 100);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_count, 2);
    assert_true(mesh.notices & LRCS_MESH_TRAILING_BYTES);
    build3ds_put(&file, 2, 0xffffffffu);
    assert_int_equal(read_file().facet_count, 2);
}

static void a_few_bytes_too_many_in_a_chunk_are_noticed(void **state)
{
    (void)state;
    for (int count = 1; count < 6; count++) {
        build3ds_begin(&file);
        build3ds_mesh(&file, "m");
        build3ds_square(&file, 0.0f);
        for (int i = 0; i < count; i++) {
            build3ds_u8(&file, 0);
        }
        build3ds_end(&file);
        lrcs_mesh mesh = read_file();
        assert_int_equal(mesh.vertex_count, 4);
        assert_true(mesh.notices & LRCS_MESH_TRAILING_BYTES);
    }
}

static void a_length_below_six_is_refused(void **state)
{
    (void)state;
    for (uint32_t length = 0; length < 6; length++) {
        build3ds_begin(&file);
        unknown_chunk();
        build3ds_end(&file);
        build3ds_put(&file, 14, length);
        refuse_file(LRCS_E_SYNTAX, 14);
        build3ds_put(&file, 2, length);
        refuse_file(LRCS_E_SYNTAX, 2);
    }
}

static void a_length_beyond_the_parent_is_refused(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_open(&file, 0x4000);
    build3ds_name(&file, "o");
    unknown_chunk(); /* at 20 */
    build3ds_close(&file);
    build3ds_panel(&file, "p", 0.0f, "m");
    build3ds_end(&file);
    build3ds_put(&file, 22, 15);
    refuse_file(LRCS_E_SYNTAX, 22);
    build3ds_put(&file, 22, (uint32_t)file.size);
    refuse_file(LRCS_E_TRUNCATED, 22);
    build3ds_put(&file, 22, 0xffffffffu);
    refuse_file(LRCS_E_TRUNCATED, 22);
}

static void a_file_cut_short_is_said_to_be(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_panel(&file, "p", 0.0f, "m");
    build3ds_end(&file);
    file.size -= 3;
    refuse_file(LRCS_E_TRUNCATED, 8);
    file.size = 3;
    refuse_file(LRCS_E_TRUNCATED, 0);
    file.size = 9;
    refuse_file(LRCS_E_TRUNCATED, 6);
}

static void no_bytes_and_other_files_are_refused(void **state)
{
    (void)state;
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(lrcs_3ds_count(NULL, 0, &counts, &where), LRCS_E_EMPTY);
    assert_int_equal(lrcs_3ds_count("solid cube\n", 11, &counts, &where), LRCS_E_SYNTAX);
    assert_string_equal(where.found, "so");
}

/* --- objects ----------------------------------------------------------------------------------*/

static void objects_without_a_mesh_are_no_parts(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_open(&file, 0x4000); /* empty */
    build3ds_name(&file, "empty");
    build3ds_close(&file);
    build3ds_open(&file, 0x4000);
    build3ds_name(&file, "light");
    build3ds_open(&file, 0x4600);
    build3ds_matrix(&file, 3.0f);
    build3ds_close(&file);
    build3ds_close(&file);
    build3ds_open(&file, 0x4000);
    build3ds_name(&file, "camera");
    build3ds_open(&file, 0x4700);
    build3ds_close(&file);
    build3ds_close(&file);
    build3ds_panel(&file, "panel", 0.0f, "m");
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.part_count, 1);
    assert_string_equal(mesh.part[0], "panel");
    assert_int_equal(mesh.notices & LRCS_MESH_LOCAL_MATRIX, 0);
}

static void meshes_without_faces_or_vertices_are_parts(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "bare");
    build3ds_mesh_end(&file);
    build3ds_mesh(&file, "vertices only");
    build3ds_square(&file, 1e9f);
    build3ds_mesh_end(&file);
    build3ds_mesh(&file, "empty lists");
    build3ds_open(&file, 0x4110);
    build3ds_u16(&file, 0);
    build3ds_close(&file);
    build3ds_open(&file, 0x4120);
    build3ds_u16(&file, 0);
    build3ds_close(&file);
    build3ds_mesh_end(&file);
    build3ds_panel(&file, "panel", 0.0f, "m");
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.part_count, 4);
    assert_int_equal(mesh.vertex_count, 8);
    assert_int_equal(mesh.facet_count, 2);
    assert_int_equal(mesh.facet_part[0], 3);
    assert_int_equal(mesh.facet[0].corner[0], 4);
}

static void a_file_without_meshes_is_an_empty_mesh(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_count + mesh.vertex_count + mesh.part_count, 0);
}

static void names_are_kept_whatever_their_bytes(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, " -- default --", 1, 1, 1);
    build3ds_material(&file, "\x94\x92 white", 2, 2, 2);
    build3ds_panel(&file, "longer than ten characters", 0.0f, "\x94\x92 white");
    build3ds_panel(&file, "", 0.0f, " -- default --");
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_string_equal(mesh.material[0].name, " -- default --");
    assert_string_equal(mesh.material[1].name, "\xc2\x94\xc2\x92 white");
    assert_string_equal(mesh.part[0], "longer than ten characters");
    assert_string_equal(mesh.part[1], "");
    assert_int_equal(mesh.facet_material[0], 1);
    assert_int_equal(mesh.facet_material[2], 0);
    assert_true(mesh.notices & LRCS_MESH_LATIN1_NAMES);
}

static void utf8_names_need_no_notice(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "or\xc3\xa9", 1, 1, 1);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_string_equal(mesh.material[0].name, "or\xc3\xa9");
    assert_int_equal(mesh.notices, 0);
}

static void a_name_must_end_inside_its_chunk(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_open(&file, 0x4000);
    build3ds_u8(&file, 'n');
    build3ds_close(&file);
    build3ds_open(&file, 0x0000); /* the zero that is there belongs to another chunk */
    build3ds_end(&file);
    refuse_file(LRCS_E_SYNTAX, 18);
}

/* --- faces ------------------------------------------------------------------------------------*/

static void a_face_index_out_of_range_is_refused_where_it_stands(void **state)
{
    (void)state;
    for (unsigned corner = 4; corner < 0x10000; corner += 0x4ffb) {
        build3ds_begin(&file);
        build3ds_mesh(&file, "m");
        build3ds_square(&file, 0.0f);
        build3ds_faces(&file);
        size_t at = file.size - 4; /* the last corner of the second face */
        file.bytes[at] = (unsigned char)corner;
        file.bytes[at + 1] = (unsigned char)(corner >> 8);
        build3ds_end(&file);
        refuse_file(LRCS_E_INDEX, at);
    }
}

static void faces_without_vertices_are_refused(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_faces(&file);
    size_t at = file.open[file.depth - 1] + 8;
    build3ds_end(&file);
    refuse_file(LRCS_E_INDEX, at);
}

static void faces_on_repeated_corners_are_kept(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    memset(file.bytes + file.size - 8, 0, 6);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_count, 2);
    assert_int_equal(mesh.facet[1].corner[2], 0);
}

static void face_counts_above_32767_are_read(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_open(&file, 0x4120);
    build3ds_u16(&file, 65535);
    for (unsigned i = 0; i < 65535; i++) {
        build3ds_u32(&file, 1u << 16);
        build3ds_u32(&file, 2);
    }
    build3ds_group(&file, "m", 65534, 1);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_count, 65535);
    assert_int_equal(mesh.facet[65534].corner[1], 1);
    assert_int_equal(mesh.facet[65534].corner[2], 2);
}

static void vertices_that_are_not_finite_are_refused_where_they_stand(void **state)
{
    (void)state;
    static const uint32_t bits[] = {0x7f800000u, 0xff800000u, 0x7fc00000u, 0xffffffffu,
                                    0x7f800001u};
    for (size_t i = 0; i < sizeof bits / sizeof *bits; i++) {
        build3ds_begin(&file);
        build3ds_mesh(&file, "m");
        build3ds_square(&file, 0.0f);
        build3ds_put(&file, file.size - 8, bits[i]);
        size_t at = file.size - 8;
        build3ds_end(&file);
        refuse_file(LRCS_E_NUMBER, at);
    }
}

static void lists_shorter_than_their_count_are_refused(void **state)
{
    (void)state;
    for (unsigned id = 0x4110; id <= 0x4120; id += 0x10) {
        build3ds_begin(&file);
        build3ds_mesh(&file, "m");
        build3ds_open(&file, id);
        size_t at = file.size + 2;
        build3ds_u16(&file, 2);
        build3ds_float(&file, 0.0f);
        build3ds_end(&file);
        refuse_file(LRCS_E_SYNTAX, at);
    }
}

static void a_second_list_in_a_mesh_is_refused(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_square(&file, 1.0f);
    size_t at = file.size - 50;
    build3ds_end(&file);
    refuse_file(LRCS_E_SYNTAX, at);
}

static void smoothing_keeps_all_32_bits_and_0_is_hard(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_smooth(&file, 0x80000005u, 0);
    build3ds_close(&file);
    build3ds_mesh_end(&file);
    build3ds_mesh(&file, "no smoothing");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_smooth[0], 0x80000005u);
    assert_int_equal(mesh.facet_smooth[1], 0);
    assert_int_equal(mesh.facet_smooth[2], 0);
}

static void groups_and_smoothing_beside_the_faces_are_read(void **state)
{
    (void)state;
    for (int before = 0; before < 2; before++) {
        build3ds_begin(&file);
        build3ds_material(&file, "m", 1, 2, 3);
        build3ds_mesh(&file, "o");
        build3ds_square(&file, 0.0f);
        if (!before) {
            build3ds_faces(&file);
            build3ds_close(&file);
        }
        build3ds_group(&file, "m", 1, 1);
        build3ds_smooth(&file, 3, 4);
        if (before) {
            build3ds_faces(&file);
        }
        build3ds_end(&file);
        lrcs_mesh mesh = read_file();
        assert_int_equal(mesh.facet_material[0], LRCS_NONE);
        assert_int_equal(mesh.facet_material[1], 0);
        assert_int_equal(mesh.facet_smooth[1], 4);
    }
}

static void smoothing_must_cover_all_faces(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_open(&file, 0x4150);
    build3ds_u32(&file, 1);
    size_t at = file.size - 4;
    build3ds_end(&file);
    refuse_file(LRCS_E_SYNTAX, at);
}

static void a_matrix_is_noticed_and_moves_nothing(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        build3ds_begin(&file);
        build3ds_mesh(&file, "m");
        build3ds_square(&file, 3.0f);
        build3ds_matrix(&file, i == 0 ? 1.0f : -2.0f);
        build3ds_end(&file);
        lrcs_mesh mesh = read_file();
        check_same(mesh.vertex[1].x[0], 1.0);
        check_same(mesh.vertex[1].x[2], 3.0);
        assert_int_equal(mesh.notices, i == 0 ? 0 : LRCS_MESH_LOCAL_MATRIX);
    }
}

static void animation_nodes_are_noticed(void **state)
{
    (void)state;
    for (unsigned id = 0xb001; id <= 0xb00a; id++) {
        build3ds_begin(&file);
        build3ds_close(&file);
        build3ds_open(&file, 0xb000);
        build3ds_open(&file, id);
        build3ds_end(&file);
        assert_int_equal(read_file().notices, id <= 0xb007 ? LRCS_MESH_KEYFRAMER : 0);
    }
}

/* --- materials --------------------------------------------------------------------------------*/

static void the_last_of_overlapping_groups_wins_with_a_notice(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "a", 1, 2, 3);
    build3ds_material(&file, "b", 4, 5, 6);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_group(&file, "a", 0, 2);
    build3ds_group(&file, "b", 1, 1);
    build3ds_group(&file, "b", 0, 0); /* an empty group takes nothing */
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_material[0], 0);
    assert_int_equal(mesh.facet_material[1], 1);
    assert_int_equal(mesh.notices, LRCS_MESH_OVERLAPPING_GROUPS);
}

static void a_face_twice_in_one_group_overlaps_nothing(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "a", 1, 2, 3);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_group(&file, "a", 0, 2);
    build3ds_group(&file, "a", 0, 1);
    build3ds_end(&file);
    assert_int_equal(read_file().notices, 0);
}

static void a_group_of_no_defined_material_is_noticed(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "a", 1, 2, 3);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_group(&file, "nowhere", 0, 1);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_material[0], LRCS_NONE);
    assert_int_equal(mesh.facet_material[1], LRCS_NONE); /* in no group: nothing to notice */
    assert_int_equal(mesh.notices, LRCS_MESH_UNDEFINED_MATERIAL);
}

static void a_face_taken_from_an_undefined_material_overlaps_only(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "a", 1, 2, 3);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_group(&file, "nowhere", 0, 2);
    build3ds_group(&file, "a", 0, 2);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.facet_material[0], 0);
    assert_int_equal(mesh.notices, LRCS_MESH_OVERLAPPING_GROUPS);
}

static void a_group_naming_no_face_of_the_mesh_is_refused(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "m");
    build3ds_square(&file, 0.0f);
    build3ds_faces(&file);
    build3ds_group(&file, "a", 1, 2);
    size_t at = file.size - 2;
    build3ds_end(&file);
    refuse_file(LRCS_E_INDEX, at);
}

static void of_equal_material_names_the_first_is_bound(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_material(&file, "x", 0, 0, 0);
    build3ds_material(&file, "a", 1, 2, 3);
    build3ds_material(&file, "a", 4, 5, 6);
    build3ds_panel(&file, "m", 0.0f, "a");
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.material_count, 3);
    assert_int_equal(mesh.material[2].rgb[0], 4);
    assert_int_equal(mesh.facet_material[0], 1);
    assert_int_equal(mesh.facet_material[1], 1);
}

static void many_materials_are_distinguished(void **state)
{
    (void)state;
    char name[16];
    build3ds_begin(&file);
    for (unsigned i = 0; i < 1000; i++) {
        snprintf(name, sizeof name, "m%u", i);
        build3ds_material(&file, name, i & 255, i >> 8, 0);
    }
    for (unsigned i = 0; i < 1000; i++) {
        snprintf(name, sizeof name, "m%u", 999 - i);
        build3ds_panel(&file, "p", 0.0f, name);
    }
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    for (uint32_t i = 0; i < 1000; i++) {
        assert_int_equal(mesh.facet_material[2 * i], 999 - i);
    }
}

/* The colours 0x0010..0x0013 whose bits are set, each recognisable by its red, in a given order. */
static void colour_material(unsigned set, int backwards)
{
    build3ds_begin(&file);
    build3ds_open(&file, 0xafff);
    build3ds_open(&file, 0xa020);
    for (unsigned i = 0; i < 4; i++) {
        unsigned k = backwards ? 3 - i : i;
        if (set & 1u << k && (k == 1 || k == 2)) {
            build3ds_colour24(&file, 0x10 + k, 51 * k, 0, 0);
        } else if (set & 1u << k) {
            build3ds_colour_float(&file, 0x10 + k, k == 0 ? 0.0f : 0.6f, 0.0f, 0.0f);
        }
    }
    build3ds_end(&file);
}

static void byte_colours_beat_linear_ones_beat_floats(void **state)
{
    (void)state;
    for (unsigned set = 0; set < 16; set++) {
        unsigned best = set & 2 ? 51 : set & 4 ? 102 : set & 1 ? 0 : set & 8 ? 153 : 0;
        for (int backwards = 0; backwards < 2; backwards++) {
            colour_material(set, backwards);
            lrcs_mesh mesh = read_file();
            assert_int_equal(mesh.material[0].has_colour, set != 0);
            assert_int_equal(mesh.material[0].rgb[0], best);
            assert_string_equal(mesh.material[0].name, "");
        }
    }
}

static void float_colours_are_clamped_and_rounded(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_open(&file, 0xafff);
    build3ds_open(&file, 0xa020);
    build3ds_colour_float(&file, 0x0010, -3.0f, 1e30f, 0.752941191f);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.material[0].rgb[0], 0);
    assert_int_equal(mesh.material[0].rgb[1], 255);
    assert_int_equal(mesh.material[0].rgb[2], 192);
}

static void numbers_of_materials_must_be_finite(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_open(&file, 0xafff);
    build3ds_open(&file, 0xa020);
    build3ds_colour_float(&file, 0x0010, 0.0f, 0.0f, 0.0f);
    size_t at = file.size - 8;
    build3ds_put(&file, at, 0x7fc00000u);
    build3ds_end(&file);
    refuse_file(LRCS_E_NUMBER, at);
    build3ds_begin(&file);
    build3ds_open(&file, 0xafff);
    build3ds_open(&file, 0xa050);
    build3ds_open(&file, 0x0031);
    at = file.size;
    build3ds_u32(&file, 0xff800000u);
    build3ds_end(&file);
    refuse_file(LRCS_E_NUMBER, at);
}

static void transparency_is_percent_in_both_forms(void **state)
{
    (void)state;
    static const struct {
        unsigned id;
        float percent;
        double want;
    } form[] = {{0x0030, 0.0f, 0.0},   {0x0030, 100.0f, 1.0}, {0x0030, 25.0f, 0.25},
                {0x0030, -5.0f, 0.0},  {0x0030, 300.0f, 1.0}, {0x0031, 86.0f, 0.86},
                {0x0031, 100.0f, 1.0}, {0x0031, -1.0f, 0.0},  {0x0031, 1e30f, 1.0}};
    for (size_t i = 0; i < sizeof form / sizeof *form; i++) {
        build3ds_begin(&file);
        build3ds_open(&file, 0xafff);
        build3ds_open(&file, 0xa050);
        build3ds_open(&file, form[i].id);
        if (form[i].id == 0x0030) {
            build3ds_u16(&file, (unsigned)(int)form[i].percent & 0xffff);
        } else {
            build3ds_float(&file, form[i].percent);
        }
        build3ds_end(&file);
        check_same(read_file().material[0].transparency, form[i].want);
    }
}

static void the_two_sided_flag_is_its_presence(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_open(&file, 0xafff);
    build3ds_open(&file, 0xa081);
    build3ds_end(&file);
    lrcs_mesh mesh = read_file();
    assert_int_equal(mesh.material[0].two_sided, 1);
    check_same(mesh.material[0].transparency, 0.0);
}

/* --- attacks ----------------------------------------------------------------------------------*/

/* A small file with one of everything. */
static void build_all(void)
{
    file.size = 0;
    build3ds_open(&file, 0x4d4d);
    build3ds_open(&file, 0x0002);
    build3ds_u32(&file, 3);
    build3ds_close(&file);
    build3ds_open(&file, 0x3d3d);
    build3ds_material(&file, "gold", 255, 204, 0);
    build3ds_open(&file, 0xafff);
    build3ds_open(&file, 0xa000);
    build3ds_name(&file, "d\xe9");
    build3ds_close(&file);
    build3ds_open(&file, 0xa020);
    build3ds_colour_float(&file, 0x0010, 0.1f, 0.2f, 0.3f);
    build3ds_close(&file);
    build3ds_open(&file, 0xa050);
    build3ds_open(&file, 0x0030);
    build3ds_u16(&file, 50);
    build3ds_close(&file);
    build3ds_close(&file);
    build3ds_open(&file, 0xa081);
    build3ds_close(&file);
    build3ds_close(&file);
    build3ds_panel(&file, "panel", 1.0f, "gold");
    build3ds_mesh(&file, "body");
    build3ds_matrix(&file, 2.0f);
    build3ds_faces(&file);
    build3ds_group(&file, "nowhere", 1, 1);
    build3ds_close(&file);
    build3ds_square(&file, -1.0f);
    build3ds_group(&file, "d\xe9", 0, 2);
    build3ds_mesh_end(&file);
    build3ds_close(&file);
    build3ds_open(&file, 0xb000);
    build3ds_open(&file, 0xb002);
    build3ds_end(&file);
}

static void cut_files_give_a_status_or_a_sound_mesh(void **state)
{
    (void)state;
    build_all();
    attack_by_cutting(&reader_3ds, file.bytes, file.size);
}

static void flipped_bits_give_a_status_or_a_sound_mesh(void **state)
{
    (void)state;
    build_all();
    attack_by_bits(&reader_3ds, file.bytes, file.size);
    attack_by_bytes(&reader_3ds, file.bytes, file.size, 5000);
}

static void inflated_counts_give_a_status_or_a_sound_mesh(void **state)
{
    (void)state;
    build_all();
    attack_by_inflation(&reader_3ds, file.bytes, file.size);
}

static void a_read_in_too_little_memory_takes_and_touches_nothing(void **state)
{
    (void)state;
    build_all();
    attack_by_too_little_memory(&reader_3ds, file.bytes, file.size);
}

static void chunks_nested_without_end_are_read_without_descent(void **state)
{
    (void)state;
    static const unsigned id[] = {0x4d4d, 0x3d3d, 0x4000, 0x4100, 0x4120, 0xb002};
    for (size_t k = 0; k < sizeof id / sizeof *id; k++) {
        build3ds_begin(&file);
        size_t start = file.size;
        while (file.size + 6 <= sizeof file.bytes) { /* each holds all that follow */
            build3ds_u16(&file, id[k]);
            build3ds_u32(&file, 0);
        }
        size_t end = file.size;
        for (size_t at = start; at < end; at += 6) {
            build3ds_put(&file, at + 2, (uint32_t)(end - at));
        }
        build3ds_end(&file);
        check_read(&reader_3ds, file.bytes, file.size);
    }
}

/* A file with more than that in all would have some 2^36 bytes: so many are said to be read. */
static void counts_end_where_indices_do(void **state)
{
    (void)state;
    build3ds_begin(&file);
    build3ds_mesh(&file, "square");
    size_t at = file.open[file.depth - 1] + 6;
    build3ds_square(&file, 0);
    build3ds_faces(&file);
    build3ds_end(&file);
    static const char *const item[] = {"vertices", "faces", "mesh"};
    for (int i = 0; i < 4; i++) {
        lrcs_where where = {0};
        lrcsi_tds_walk walk = {.bytes = file.bytes, .size = file.size, .where = &where};
        uint32_t *count[] = {&walk.counts.vertices, &walk.counts.facets, &walk.counts.parts};
        lrcsi_tds_chunk chunk = {LRCSI_TDS_TRIMESH, at, file.size};
        if (i < 3) {
            *count[i] = LRCS_NONE - 2;
        }
        int status = lrcsi_tds_read_trimesh(&walk, chunk, NULL);
        assert_int_equal(status, i < 3 ? LRCS_E_LIMIT : LRCS_OK);
        assert_true(i == 3 ? !where.item : strcmp(where.item, item[i]) == 0);
        assert_true(i == 3 || *count[i] == LRCS_NONE - 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_is_read_as_stored),
        cmocka_unit_test(several_meshes_lie_behind_each_other),
        cmocka_unit_test(two_meshes_in_one_object_are_two_parts),
        cmocka_unit_test(a_long_name_of_many_meshes_is_stored_once),
        cmocka_unit_test(materials_may_stand_behind_and_between_objects),
        cmocka_unit_test(chunks_of_a_mesh_come_in_any_order),
        cmocka_unit_test(sections_come_in_any_order_and_number),
        cmocka_unit_test(unknown_chunks_are_skipped_at_every_level),
        cmocka_unit_test(stray_bytes_behind_the_root_are_noticed),
        cmocka_unit_test(a_root_length_beyond_the_file_is_noticed_if_all_else_fits),
        cmocka_unit_test(a_few_bytes_too_many_in_a_chunk_are_noticed),
        cmocka_unit_test(a_length_below_six_is_refused),
        cmocka_unit_test(a_length_beyond_the_parent_is_refused),
        cmocka_unit_test(a_file_cut_short_is_said_to_be),
        cmocka_unit_test(no_bytes_and_other_files_are_refused),
        cmocka_unit_test(objects_without_a_mesh_are_no_parts),
        cmocka_unit_test(meshes_without_faces_or_vertices_are_parts),
        cmocka_unit_test(a_file_without_meshes_is_an_empty_mesh),
        cmocka_unit_test(names_are_kept_whatever_their_bytes),
        cmocka_unit_test(utf8_names_need_no_notice),
        cmocka_unit_test(a_name_must_end_inside_its_chunk),
        cmocka_unit_test(a_face_index_out_of_range_is_refused_where_it_stands),
        cmocka_unit_test(faces_without_vertices_are_refused),
        cmocka_unit_test(faces_on_repeated_corners_are_kept),
        cmocka_unit_test(face_counts_above_32767_are_read),
        cmocka_unit_test(vertices_that_are_not_finite_are_refused_where_they_stand),
        cmocka_unit_test(lists_shorter_than_their_count_are_refused),
        cmocka_unit_test(a_second_list_in_a_mesh_is_refused),
        cmocka_unit_test(smoothing_keeps_all_32_bits_and_0_is_hard),
        cmocka_unit_test(groups_and_smoothing_beside_the_faces_are_read),
        cmocka_unit_test(smoothing_must_cover_all_faces),
        cmocka_unit_test(a_matrix_is_noticed_and_moves_nothing),
        cmocka_unit_test(animation_nodes_are_noticed),
        cmocka_unit_test(the_last_of_overlapping_groups_wins_with_a_notice),
        cmocka_unit_test(a_face_twice_in_one_group_overlaps_nothing),
        cmocka_unit_test(a_group_of_no_defined_material_is_noticed),
        cmocka_unit_test(a_face_taken_from_an_undefined_material_overlaps_only),
        cmocka_unit_test(a_group_naming_no_face_of_the_mesh_is_refused),
        cmocka_unit_test(of_equal_material_names_the_first_is_bound),
        cmocka_unit_test(many_materials_are_distinguished),
        cmocka_unit_test(byte_colours_beat_linear_ones_beat_floats),
        cmocka_unit_test(float_colours_are_clamped_and_rounded),
        cmocka_unit_test(numbers_of_materials_must_be_finite),
        cmocka_unit_test(transparency_is_percent_in_both_forms),
        cmocka_unit_test(the_two_sided_flag_is_its_presence),
        cmocka_unit_test(cut_files_give_a_status_or_a_sound_mesh),
        cmocka_unit_test(flipped_bits_give_a_status_or_a_sound_mesh),
        cmocka_unit_test(inflated_counts_give_a_status_or_a_sound_mesh),
        cmocka_unit_test(a_read_in_too_little_memory_takes_and_touches_nothing),
        cmocka_unit_test(chunks_nested_without_end_are_read_without_descent),
        cmocka_unit_test(counts_end_where_indices_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
