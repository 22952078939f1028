/* SPDX-License-Identifier: MIT */
/* The TOML subset against Python's tomllib (test/vectors/toml.py): what we accept it accepts, with
   the same value. */
#include "scene/file/toml.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"

typedef struct number_row {
    const char *text;
    int good;
    double value;
} number_row;

typedef struct string_row {
    const char *text;
    size_t size;
    int good;
    const char *value;
    size_t value_size;
} string_row;

typedef struct document_row {
    const char *text;
    size_t size;
    int inside, good;
} document_row;

#include "vectors/toml.inc"

#define ROWS(table) (sizeof table / sizeof table[0])

/* Reads a whole document from a block of exactly its size; the first event goes to *first. */
static int read_all(const char *text, size_t size, lrcs_work *work, lrcsi_toml_event *first,
                    lrcs_where *where)
{
    char *copy = malloc(size + (size == 0));
    lrcsi_toml toml;
    lrcsi_toml_event event;
    assert_non_null(copy);
    memcpy(copy, text, size);
    int status = lrcsi_toml_start(&toml, copy, size, work, where);
    for (int i = 0; status == LRCS_OK; i++) {
        status = lrcsi_toml_next(&toml, &event);
        if (i == 0 && status == LRCS_OK) {
            *first = event;
        }
        if (event.kind == LRCSI_TOML_END) {
            break;
        }
    }
    free(copy);
    return status;
}

static void numbers_are_those_of_tomllib(void **state)
{
    (void)state;
    int good = 0;
    for (size_t i = 0; i < ROWS(number_rows); i++) {
        char text[80];
        unsigned char bytes[256];
        lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
        lrcsi_toml_event event;
        int size = snprintf(text, sizeof text, "x = %s\n", number_rows[i].text);
        int status = read_all(text, (size_t)size, &work, &event, NULL);
        if ((status == LRCS_OK) != number_rows[i].good) {
            fprintf(stderr, "%s", text);
        }
        assert_int_equal(status == LRCS_OK, number_rows[i].good);
        if (status == LRCS_OK) {
            assert_int_equal(event.type, LRCSI_TOML_NUMBER);
            check_same(event.number[0], number_rows[i].value);
            good++;
        }
    }
    assert_true(good > 100);
}

static void strings_are_those_of_tomllib(void **state)
{
    (void)state;
    int good = 0;
    for (size_t i = 0; i < ROWS(string_rows); i++) {
        char text[80];
        unsigned char bytes[256];
        lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
        lrcsi_toml_event event;
        memcpy(text, "x = ", 4);
        memcpy(text + 4, string_rows[i].text, string_rows[i].size);
        int status = read_all(text, string_rows[i].size + 4, &work, &event, NULL);
        if ((status == LRCS_OK) != string_rows[i].good) {
            fprintf(stderr, "%s\n", string_rows[i].text);
        }
        assert_int_equal(status == LRCS_OK, string_rows[i].good);
        if (status == LRCS_OK) {
            assert_int_equal(event.type, LRCSI_TOML_STRING);
            assert_int_equal(strlen(event.text), string_rows[i].value_size);
            assert_memory_equal(event.text, string_rows[i].value, string_rows[i].value_size);
            good++;
        }
    }
    assert_true(good > 100);
}

static void documents_that_tomllib_refuses_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(document_rows); i++) {
        const document_row *row = &document_rows[i];
        unsigned char bytes[256];
        lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
        lrcs_where where = {0};
        lrcsi_toml_event event;
        int status = read_all(row->text, row->size, &work, &event, &where);
        if ((status == LRCS_OK) != row->inside) {
            fprintf(stderr, "document: %s\n", row->text);
        }
        assert_int_equal(status == LRCS_OK, row->inside);
        assert_true(row->good || !row->inside);
        if (status != LRCS_OK) {
            assert_true(where.line >= 1 && where.item && where.expected);
        }
        if (row->good && !row->inside) { /* TOML, and not ours: not called a syntax error */
            assert_true(status == LRCS_E_UNSUPPORTED || status == LRCS_E_NUMBER);
        }
    }
}

static void a_byte_order_mark_is_passed_over_once(void **state)
{
    (void)state;
    static const char marked[] = "\xef\xbb\xbf# c\r\na = 7";
    static const char twice[] = "\xef\xbb\xbf\xef\xbb\xbfx = 7";
    unsigned char bytes[64];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    lrcsi_toml_event event;
    assert_int_equal(read_all(marked, sizeof marked - 1, &work, &event, NULL), LRCS_OK);
    assert_int_equal(event.line, 2);
    check_same(event.number[0], 7.0);
    assert_int_equal(read_all(twice, sizeof twice - 1, &work, &event, NULL), LRCS_E_SYNTAX);
}

static void arrays_count_beyond_what_they_keep(void **state)
{
    (void)state;
    static const char text[] = "a = [1, 2.5, -3,\n 4, 5, 6e0,]";
    unsigned char bytes[64];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    lrcsi_toml_event event;
    assert_int_equal(read_all(text, sizeof text - 1, &work, &event, NULL), LRCS_OK);
    assert_int_equal(event.count, 6);
    check_same(event.number[1], 2.5);
    check_same(event.number[3], 4.0);
}

static void errors_tell_line_offset_and_bytes(void **state)
{
    (void)state;
    static const char text[] = "a = 1\n# c\nb = 0x10 # hex\n";
    unsigned char bytes[64];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    lrcs_where where = {0};
    lrcsi_toml_event event;
    assert_int_equal(read_all(text, sizeof text - 1, &work, &event, &where), LRCS_E_UNSUPPORTED);
    assert_int_equal(where.line, 3);
    assert_int_equal(where.offset, 14);
    assert_string_equal(where.found, "0x10 # hex");
    assert_non_null(strstr(where.expected, "not in the subset"));
}

static void invalid_bytes_are_found_wherever_they_stand(void **state)
{
    (void)state;
    static const char *const bad[] = {"# \xff\n", "a = 1\n# \xc3",     "a = '\xe2\x82'",
                                      "\x80",     "a = 1\n\x0b",       "# \x7f",
                                      "a = 1 \r", "# \xf4\x90\x80\x80"};
    for (size_t i = 0; i < ROWS(bad); i++) {
        lrcs_where where = {0};
        lrcsi_toml_event event;
        assert_int_equal(read_all(bad[i], strlen(bad[i]), NULL, &event, &where), LRCS_E_SYNTAX);
        assert_string_equal(where.item, "text");
    }
}

static void lines_beyond_the_text_begin_at_its_end(void **state)
{
    (void)state;
    static const char text[] = "a\nbc\nd";
    static const size_t at[] = {0, 0, 2, 5, 6, 6};
    for (uint32_t line = 0; line < 6; line++) {
        assert_int_equal(lrcsi_toml_offset(text, sizeof text - 1, line), at[line]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_those_of_tomllib),
        cmocka_unit_test(strings_are_those_of_tomllib),
        cmocka_unit_test(documents_that_tomllib_refuses_are_refused),
        cmocka_unit_test(a_byte_order_mark_is_passed_over_once),
        cmocka_unit_test(arrays_count_beyond_what_they_keep),
        cmocka_unit_test(errors_tell_line_offset_and_bytes),
        cmocka_unit_test(invalid_bytes_are_found_wherever_they_stand),
        cmocka_unit_test(lines_beyond_the_text_begin_at_its_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
