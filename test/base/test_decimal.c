/* SPDX-License-Identifier: MIT */
/* Decimal text to double: against CPython's reader (test/vectors/make_decimal.py), by the rules
   of its grammar, and under whatever locale writes decimal commas. */
#include "base/decimal.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

static const struct {
    const char *text;
    uint64_t bits;
} table[] = {
#include "vectors/decimal.inc"
};
enum { TABLE_SIZE = sizeof table / sizeof table[0] };

static uint64_t bits_of(double x)
{
    uint64_t bits = 0;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* The value of `text`, all of which must be read, from a block of exactly its size. */
static double read_whole(const char *text)
{
    size_t size = strlen(text);
    char *block = malloc(size ? size : 1);
    assert_non_null(block);
    memcpy(block, text, size);
    double value = 0.0;
    assert_ptr_equal(lrcsi_decimal_read(block, block + size, &value), block + size);
    free(block);
    return value;
}

/* How many bytes of `text` are read as a number; -1 if it does not begin with one. */
static int length_read(const char *text)
{
    double value = 42.0;
    const char *next = lrcsi_decimal_read(text, text + strlen(text), &value);
    if (!next) {
        assert_true(bits_of(value) == bits_of(42.0));
        return -1;
    }
    return (int)(next - text);
}

static void check_table(void)
{
    for (size_t i = 0; i < TABLE_SIZE; i++) {
        uint64_t got = bits_of(read_whole(table[i].text));
        if (got != table[i].bits) {
            fail_msg("%s: bits %016llx, want %016llx", table[i].text, (unsigned long long)got,
                     (unsigned long long)table[i].bits);
        }
    }
}

static void every_number_of_the_table_is_correctly_rounded(void **state)
{
    (void)state;
    assert_true(TABLE_SIZE >= 3000);
    check_table();
}

static void negative_numbers_mirror_positive_ones(void **state)
{
    (void)state;
    char text[2048] = "-";
    for (size_t i = 0; i < TABLE_SIZE; i++) {
        assert_true(strlen(table[i].text) < sizeof text - 1);
        strcpy(text + 1, table[i].text);
        assert_true(bits_of(read_whole(text)) == (table[i].bits | UINT64_C(1) << 63));
    }
}

static void the_locale_does_not_matter(void **state)
{
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8",
                                        "de_DE",       "fr_FR",      "nl_NL.UTF-8", "ru_RU.UTF-8"};
    const char *found = NULL;
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !found; i++) {
        found = setlocale(LC_ALL, names[i]);
    }
    if (!found) {
        print_message("no locale with a decimal comma is installed\n");
        skip();
    }
    assert_string_equal(localeconv()->decimal_point, ",");
    check_table();
    assert_int_equal(length_read("1,5"), 1);
    setlocale(LC_ALL, "C");
}

static void reading_stops_where_the_number_ends(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int length;
    } row[] = {{"1.5 2", 3}, {"1e", 1},    {"1e+", 1},  {"1e5x", 3},  {"2.", 2},   {"2.e1", 4},
               {".5.5", 2},  {"+7", 2},    {"-7-7", 2}, {"1E-2,", 4}, {"0x10", 1}, {"1_0", 1},
               {"1e5.5", 3}, {"00012", 5}, {"1,5", 1},  {"+.5", 3},   {"3/4", 1},  {"1e--5", 1}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        assert_int_equal(length_read(row[i].text), row[i].length);
    }
}

static void what_is_no_number_is_refused_and_value_untouched(void **state)
{
    (void)state;
    static const char *const text[] = {"",    ".",   "+",   "-",    "e5",           ".e5",
                                       "nan", "NaN", "inf", "-inf", "infinity",     "+-1",
                                       "--1", " 1",  "x",   "-.",   "\xef\xbc\x91", "-e1"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        assert_int_equal(length_read(text[i]), -1);
    }
}

static void nothing_is_read_beyond_the_end(void **state)
{
    (void)state;
    static const char text[] = "-1234.5678e-12";
    for (size_t size = 0; size < sizeof text; size++) {
        char *block = malloc(size ? size : 1);
        assert_non_null(block);
        memcpy(block, text, size);
        double value = 0.0;
        const char *next = lrcsi_decimal_read(block, block + size, &value);
        assert_true(!next || next <= block + size);
        free(block);
    }
}

static void exponents_beyond_any_integer_are_bounded(void **state)
{
    (void)state;
    assert_true(isinf(read_whole("1e9223372036854775807")));
    assert_true(isinf(read_whole("1e18446744073709551616")));
    check_same(read_whole("1e-9223372036854775809"), 0.0);
    check_same(read_whole("1e-340282366920938463463374607431768211456"), 0.0);
    check_same(read_whole("0e340282366920938463463374607431768211456"), 0.0);
    assert_true(read_whole("-1e400") < 0.0);
}

static void a_megabyte_of_digits_is_read(void **state)
{
    (void)state;
    enum { SIZE = 1 << 20 };
    char *text = malloc(SIZE + 32);
    assert_non_null(text);
    memset(text, '0', SIZE);
    text[0] = '1';
    strcpy(text + SIZE, "e-1048575");
    check_same(read_whole(text), 1.0);
    text[SIZE - 1] = '1';
    check_same(read_whole(text), 1.0);
    memset(text, '0', SIZE);
    text[1] = '.';
    strcpy(text + SIZE, "25e1048575");
    check_same(read_whole(text), 2.5);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_number_of_the_table_is_correctly_rounded),
        cmocka_unit_test(negative_numbers_mirror_positive_ones),
        cmocka_unit_test(the_locale_does_not_matter),
        cmocka_unit_test(reading_stops_where_the_number_ends),
        cmocka_unit_test(what_is_no_number_is_refused_and_value_untouched),
        cmocka_unit_test(nothing_is_read_beyond_the_end),
        cmocka_unit_test(exponents_beyond_any_integer_are_bounded),
        cmocka_unit_test(a_megabyte_of_digits_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
