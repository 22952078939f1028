/* SPDX-License-Identifier: MIT */
/* Rows of sweeps: what is written is read back to the bit, in both formats and as a map; every
   changed byte of a row is seen, parts join to the file of the whole, and a file that was cut while
   it was written goes on. */
#include <lrcs/sweep_file.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "random.h"

#define ROWS 12u

static char folder[64];
static lrcs_host_plan plan;
static lrcs_host_rows_head head;
static lrcs_host_row row[ROWS];
static lrcs_host_error error;

static int sweep_make(void **state)
{
    (void)state;
    const lrcs_host_plan_text given[] = {{"az", "0:90:30"}, {"el", "-0.5:0.5:0.5"}};
    uint64_t seed = 1;
    strcpy(folder, "/tmp/lrcs-test-XXXXXX");
    if (!mkdtemp(folder) || chdir(folder) != 0 ||
        lrcs_host_plan_make(given, 2, NULL, &plan, &error) != LRCS_OK) {
        return -1;
    }
    lrcs_host_rows_head_make(&plan, UINT64_C(0xfedcba9876543210), 1, 0, &head);
    lrcs_host_rows_head_add(&head, "az", "0:90:30");
    lrcs_host_rows_head_add(&head, "el", "-0.5:0.5:0.5");
    lrcs_host_rows_head_add(&head, "title", "a; b \"quoted\"");
    for (uint64_t i = 0; i < ROWS; i++) {
        double *f = row[i].field;
        double glint = random_unit(&seed);
        double diffuse = random_unit(&seed);
        row[i].index = i;
        row[i].flags = i % 3 == 0 ? LRCS_FLAG_TOLERANCE_NOT_MET | LRCS_FLAG_MEMORY_FALLBACK : 0;
        lrcs_host_plan_values(&plan, i, row[i].value);
        f[LRCS_HOST_ROW_SIGMA] = i == 5 ? 0.0 : glint + diffuse;
        f[LRCS_HOST_ROW_DBSM] = i == 5 ? (double)NAN : 10.0 * log10(glint + diffuse);
        f[LRCS_HOST_ROW_BOUND] = 1e-9 * random_unit(&seed);
        f[LRCS_HOST_ROW_GLINT] = i == 5 ? 0.0 : glint;
        f[LRCS_HOST_ROW_DIFFUSE] = i == 5 ? 0.0 : diffuse;
        f[LRCS_HOST_ROW_DEVIATION] = 0.25 * f[LRCS_HOST_ROW_SIGMA];
        f[LRCS_HOST_ROW_LOW] = 0.75 * f[LRCS_HOST_ROW_SIGMA];
        f[LRCS_HOST_ROW_HIGH] = 1.25 * f[LRCS_HOST_ROW_SIGMA];
    }
    return 0;
}

static int sweep_free(void **state)
{
    (void)state;
    return chdir("/") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

/* The text of rows first .. end - 1; the caller frees it. */
static char *text_make(int format, uint32_t first, uint32_t end, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    assert_non_null(out);
    lrcs_host_rows_head_write(out, format, &head, &plan);
    for (uint32_t i = first; i < end; i++) {
        lrcs_host_row_write(out, format, &head.fields, &plan, &row[i]);
    }
    fflush(out);
    lrcs_host_rows_sum_write(out, format, lrcs_host_hash(LRCS_HOST_HASH_START, text, *size));
    fclose(out);
    return text;
}

static void file_write(const char *path, const char *text, size_t size)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

static void rows_come_back_to_the_bit(void **state)
{
    (void)state;
    for (int format = LRCS_HOST_ROWS_CSV; format <= LRCS_HOST_ROWS_JSONL; format++) {
        size_t size;
        char *text = text_make(format, 0, ROWS, &size);
        lrcs_host_rows rows;
        lrcs_host_row back;
        assert_int_equal(lrcs_host_rows_open(text, size, &rows), LRCS_OK);
        assert_int_equal(rows.format, format);
        assert_int_equal(rows.rows, ROWS);
        assert_int_equal(rows.columns, 2);
        for (uint32_t i = 0; i < ROWS; i++) {
            assert_int_equal(lrcs_host_rows_next(&rows, &plan, &back, &error), 1);
            assert_int_equal(back.index, i);
            assert_int_equal(back.flags, row[i].flags);
            for (uint32_t k = 0; k < head.fields.count; k++) {
                int kind = head.fields.kind[k];
                int none = isnan(row[i].field[kind]);
                assert_true(none ? isnan(back.field[kind]) != 0
                                 : back.field[kind] == row[i].field[kind]);
            }
        }
        assert_int_equal(lrcs_host_rows_next(&rows, &plan, &back, &error), 0);
        assert_int_equal(lrcs_host_rows_end(&rows, &error), 1);
        free(text);
    }
}

/* No byte of the rows changes unnoticed: its line is refused, or the checksum disagrees. */
static void every_changed_byte_is_seen(void **state)
{
    (void)state;
    for (int format = LRCS_HOST_ROWS_CSV; format <= LRCS_HOST_ROWS_JSONL; format++) {
        size_t size;
        char *text = text_make(format, 0, ROWS, &size);
        lrcs_host_rows rows;
        assert_int_equal(lrcs_host_rows_open(text, size, &rows), LRCS_OK);
        for (size_t at = rows.head_size; at < size; at++) {
            lrcs_host_row back;
            char kept = text[at];
            text[at] = kept == '7' ? '8' : '7';
            assert_int_equal(lrcs_host_rows_open(text, size, &rows), LRCS_OK);
            int more;
            uint32_t count = 0;
            while ((more = lrcs_host_rows_next(&rows, NULL, &back, &error)) == 1) {
                count++;
            }
            int whole = more == 0 && count == ROWS && lrcs_host_rows_end(&rows, &error) == 1;
            assert_false(whole);
            text[at] = kept;
        }
        free(text);
    }
}

/* Wherever a text ends, the rows before are there, and no other. */
static void a_text_that_ends_early_has_its_complete_rows(void **state)
{
    (void)state;
    size_t size;
    char *text = text_make(LRCS_HOST_ROWS_CSV, 0, ROWS, &size);
    for (size_t end = 0; end < size; end++) {
        lrcs_host_rows rows;
        lrcs_host_row back;
        char *part = malloc(end + 1); /* of that size, so that reading on is seen */
        assert_non_null(part);
        memcpy(part, text, end);
        if (lrcs_host_rows_open(part, end, &rows) == LRCS_OK) {
            int more;
            uint32_t lines = 0;
            uint32_t count = 0;
            for (size_t i = rows.head_size; i < end; i++) {
                lines += part[i] == '\n';
            }
            while ((more = lrcs_host_rows_next(&rows, &plan, &back, &error)) == 1) {
                count++;
            }
            assert_int_equal(more, 0);
            assert_int_equal(count, lines);
            assert_int_equal(lrcs_host_rows_end(&rows, &error), 0);
        }
        free(part);
    }
    free(text);
}

static void rows_of_another_plan_are_refused(void **state)
{
    (void)state;
    const lrcs_host_plan_text given[] = {{"az", "0:90:30"}, {"el", "-0.5:0.6:0.5"}};
    lrcs_host_plan other;
    lrcs_host_rows rows;
    lrcs_host_row back;
    size_t size;
    char *text = text_make(LRCS_HOST_ROWS_CSV, 0, ROWS, &size);
    assert_int_equal(lrcs_host_plan_make(given, 2, NULL, &other, &error), LRCS_OK);
    other.axis[1].range.first += 1;
    assert_int_equal(lrcs_host_rows_open(text, size, &rows), LRCS_OK);
    assert_int_equal(lrcs_host_rows_next(&rows, &other, &back, &error), LRCS_E_SYNTAX);
    assert_non_null(strstr(error.text, "line 3, el_deg: found '-0.5', expected"));
    free(text);
}

static void whole_sweeps_come_back_with_their_plan(void **state)
{
    static const char *const name[] = {"all.csv", "all.jsonl"};
    (void)state;
    for (int format = LRCS_HOST_ROWS_CSV; format <= LRCS_HOST_ROWS_JSONL; format++) {
        lrcs_host_sweep_data data;
        size_t size;
        char *text = text_make(format, 0, ROWS, &size);
        file_write(name[format], text, size);
        assert_int_equal(lrcs_host_sweep_read(name[format], &data, &error), LRCS_OK);
        assert_int_equal(data.plan.rows, ROWS);
        assert_int_equal(data.head.scene_hash, head.scene_hash);
        assert_string_equal(lrcs_host_rows_head_text(&data.head, "title"), "a; b \"quoted\"");
        assert_int_equal(data.tally.count[LRCS_HOST_TALLY_MISSED], 4);
        for (uint32_t i = 0; i < ROWS; i++) {
            check_same(data.row[i][0], row[i].field[LRCS_HOST_ROW_SIGMA]);
            check_same(data.band[i][1], row[i].field[LRCS_HOST_ROW_HIGH]);
        }
        lrcs_host_sweep_data_free(&data);
        file_write(name[format], text, size - 70);
        assert_int_equal(lrcs_host_sweep_read(name[format], &data, &error), LRCS_E_TRUNCATED);
        lrcs_host_sweep_data_free(&data);
        free(text);
        assert_int_equal(remove(name[format]), 0);
    }
}

/* ---- parts ---- */

static void parts_join_to_the_file_of_the_whole(void **state)
{
    static const uint32_t cut[] = {0, 5, 5, 9, ROWS};
    static const char *const name[] = {"0.csv", "1.csv", "2.csv", "3.csv"};
    lrcs_host_sweep_part part[4];
    lrcs_host_file file;
    lrcs_host_sweep_data data;
    size_t size;
    (void)state;
    for (uint32_t i = 0; i < 4; i++) { /* the last one first */
        char *text = text_make(LRCS_HOST_ROWS_CSV, cut[3 - i], cut[4 - i], &size);
        file_write(name[i], text, size);
        free(text);
        assert_int_equal(lrcs_host_sweep_part_read(name[i], i > 0 ? part : NULL, &part[i], &error),
                         LRCS_OK);
    }
    assert_int_equal(lrcs_host_sweep_join(part, 4, "all.csv", 0, &error), LRCS_OK);
    assert_int_equal(lrcs_host_file_read("all.csv", &file, &error), LRCS_OK);
    char *whole = text_make(LRCS_HOST_ROWS_CSV, 0, ROWS, &size);
    assert_int_equal(file.size, size);
    assert_memory_equal(file.bytes, whole, size);
    lrcs_host_file_free(&file);
    free(whole);
    /* as a map, which has neither the uncertainty nor the other fields */
    assert_int_equal(lrcs_host_sweep_join(part, 4, "all.npy", 1, &error), LRCS_OK);
    assert_int_equal(lrcs_host_sweep_read("all.npy", &data, &error), LRCS_OK);
    for (uint32_t i = 0; i < ROWS; i++) {
        check_same(data.row[i][0], row[i].field[LRCS_HOST_ROW_SIGMA]);
        check_same(data.row[i][1], row[i].field[LRCS_HOST_ROW_BOUND]);
    }
    assert_null(data.band);
    lrcs_host_sweep_data_free(&data);
    /* one byte of the map changes */
    assert_int_equal(lrcs_host_file_read("all.npy", &file, &error), LRCS_OK);
    file.bytes[file.size - 1] ^= 1;
    file_write("all.npy", (const char *)file.bytes, file.size);
    lrcs_host_file_free(&file);
    assert_int_equal(lrcs_host_sweep_read("all.npy", &data, &error), LRCS_E_SYNTAX);
    lrcs_host_sweep_data_free(&data);
    /* one part is missing, or there twice */
    assert_int_equal(lrcs_host_sweep_join(part, 3, "few.csv", 0, &error), LRCS_E_INDEX);
    lrcs_host_sweep_part twice[2] = {part[3], part[3]};
    assert_int_equal(lrcs_host_sweep_join(twice, 2, "few.csv", 0, &error), LRCS_E_INDEX);
    assert_int_not_equal(access("few.csv", F_OK), 0);
    for (uint32_t i = 0; i < 4; i++) {
        lrcs_host_sweep_part_free(&part[i]);
        remove(name[i]);
    }
    remove("all.csv");
    remove("all.npy");
    assert_int_equal(remove("all.npy.head"), 0);
}

/* ---- files of sweeps that are being computed ---- */

static lrcs_host_sweep_output output_make(const char *path, int npy)
{
    lrcs_host_sweep_output output;
    assert_int_equal(lrcs_host_sweep_output_make(path, LRCS_HOST_ROWS_CSV, npy, &output, &error),
                     LRCS_OK);
    output.plan = &plan;
    output.head = &head;
    output.end = ROWS;
    return output;
}

/* Writes the rows that are missing, up to `end`, and closes the output. */
static void output_run(lrcs_host_sweep_output *output, uint64_t end)
{
    while (output->next < end) {
        assert_int_equal(lrcs_host_sweep_output_put(output, &row[output->next], &error), LRCS_OK);
    }
    assert_int_equal(lrcs_host_sweep_output_close(output, end == ROWS, &error), LRCS_OK);
    lrcs_host_sweep_output_free(output);
}

/* A process may end at any moment: FILE.partial, cut at every place, leads to the same file. */
static void an_output_that_was_cut_anywhere_goes_on(void **state)
{
    (void)state;
    size_t size;
    char *text = text_make(LRCS_HOST_ROWS_CSV, 0, ROWS, &size);
    for (size_t at = 0; at <= size; at += at + 1 < size ? 7 : 1) {
        lrcs_host_file whole;
        file_write("out.csv.partial", text, at);
        lrcs_host_sweep_output output = output_make("out.csv", 0);
        assert_int_equal(lrcs_host_sweep_output_open(&output, 1, &error), LRCS_OK);
        output_run(&output, ROWS);
        assert_int_equal(access("out.csv.partial", F_OK), -1);
        assert_int_equal(access("out.csv.lock", F_OK), -1);
        assert_int_equal(lrcs_host_file_read("out.csv", &whole, &error), LRCS_OK);
        assert_int_equal(whole.size, size);
        assert_memory_equal(whole.bytes, text, size);
        lrcs_host_file_free(&whole);
        remove("out.csv");
    }
    free(text);
}

static void rows_that_are_there_are_neither_lost_nor_mixed(void **state)
{
    (void)state;
    double value[ROWS][2];
    lrcs_host_sweep_output output = output_make("out.csv", 0);
    assert_int_equal(lrcs_host_sweep_output_open(&output, 0, &error), LRCS_OK);
    output_run(&output, 5);
    assert_int_equal(access("out.csv", F_OK), -1);
    output = output_make("out.csv", 0); /* not without being asked to go on */
    assert_int_equal(lrcs_host_sweep_output_open(&output, 0, &error), LRCS_E_SYSTEM);
    lrcs_host_sweep_output_free(&output);
    head.scene_hash++; /* nor with another sweep */
    output = output_make("out.csv", 0);
    assert_int_equal(lrcs_host_sweep_output_open(&output, 1, &error), LRCS_E_SYNTAX);
    lrcs_host_sweep_output_free(&output);
    head.scene_hash--;
    output = output_make("out.csv", 0);
    output.row = value;
    assert_int_equal(lrcs_host_sweep_output_open(&output, 1, &error), LRCS_OK);
    assert_int_equal(output.next, 5);
    output_run(&output, ROWS);
    for (uint32_t i = 0; i < ROWS; i++) {
        assert_true(value[i][0] == row[i].field[LRCS_HOST_ROW_SIGMA]);
        assert_true(value[i][1] == row[i].field[LRCS_HOST_ROW_BOUND]);
    }
    output = output_make("out.csv", 0); /* complete: nothing is left to do */
    assert_int_equal(lrcs_host_sweep_output_open(&output, 1, &error), LRCS_OK);
    assert_int_equal(output.next, ROWS);
    output_run(&output, ROWS);
    remove("out.csv");
}

static void of_no_rows_nothing_is_left_and_a_map_replaces_its_rows(void **state)
{
    (void)state;
    lrcs_host_sweep_map map;
    lrcs_host_sweep_output output = output_make("out.npy", 1);
    assert_int_equal(lrcs_host_sweep_output_open(&output, 0, &error), LRCS_OK);
    output_run(&output, 0);
    assert_int_equal(access("out.npy.partial", F_OK), -1);
    output = output_make("out.npy", 1);
    assert_int_equal(lrcs_host_sweep_output_open(&output, 0, &error), LRCS_OK);
    output_run(&output, ROWS);
    assert_int_equal(access("out.npy.partial", F_OK), -1);
    assert_int_equal(lrcs_host_sweep_map_open("out.npy", &map), LRCS_OK);
    assert_int_equal(map.tally.count[LRCS_HOST_TALLY_MISSED], ROWS / 3);
    lrcs_host_sweep_map_close(&map);
    remove("out.npy");
    remove("out.npy.head");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_come_back_to_the_bit),
        cmocka_unit_test(every_changed_byte_is_seen),
        cmocka_unit_test(a_text_that_ends_early_has_its_complete_rows),
        cmocka_unit_test(rows_of_another_plan_are_refused),
        cmocka_unit_test(whole_sweeps_come_back_with_their_plan),
        cmocka_unit_test(parts_join_to_the_file_of_the_whole),
        cmocka_unit_test(an_output_that_was_cut_anywhere_goes_on),
        cmocka_unit_test(rows_that_are_there_are_neither_lost_nor_mixed),
        cmocka_unit_test(of_no_rows_nothing_is_left_and_a_map_replaces_its_rows),
    };
    return cmocka_run_group_tests(tests, sweep_make, sweep_free);
}
