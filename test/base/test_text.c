/* SPDX-License-Identifier: MIT */
/* Names as UTF-8: what is valid stays, what is not is read as Latin-1. */
#include "base/text.h"

#include <string.h>

#include "check.h"

static void reads_as(const char *bytes, size_t size, const char *want)
{
    char out[64];
    memset(out, 'x', sizeof out);
    assert_int_equal(lrcsi_text_utf8(bytes, size, NULL), strlen(want) + 1);
    assert_int_equal(lrcsi_text_utf8(bytes, size, out), strlen(want) + 1);
    assert_string_equal(out, want);
    assert_int_equal(out[strlen(want) + 1], 'x');
}

static void utf8_and_ascii_stay_as_they_are(void **state)
{
    (void)state;
    reads_as("", 0, "");
    reads_as(" -- default --", 14, " -- default --");
    reads_as("d\xc3\xa9", 3, "d\xc3\xa9");
    reads_as("\xe2\x82\xac\xf0\x9f\x9b\xb0", 7, "\xe2\x82\xac\xf0\x9f\x9b\xb0");
}

static void other_bytes_are_latin1(void **state)
{
    (void)state;
    reads_as("Folie d\xe9or\xe9"
             "e",
             12,
             "Folie d\xc3\xa9or\xc3\xa9"
             "e");
    reads_as("\x94\x92 white", 8, "\xc2\x94\xc2\x92 white");
    reads_as("\xff", 1, "\xc3\xbf");
    /* one bad byte makes the whole name Latin-1 */
    reads_as("\xc3\xa9\xe9", 3, "\xc3\x83\xc2\xa9\xc3\xa9");
}

static void ill_formed_utf8_is_not_utf8(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "\x80",
        "\xc0\xaf",
        "\xc1\xbf",
        "\xc3",
        "\xe0\x9f\xbf",
        "\xed\xa0\x80",
        "\xe2\x82",
        "\xe2\x28\xa1",
        "\xf0\x8f\x80",
        "\xf0\x8f\x80\x80",
        "\xf4\x90\x80\x80",
        "\xf5\x80\x80\x80",
        "\xf0\x9f\x9b",
        "\xf0\x9f\x9b\x28",
        "\xff",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(lrcsi_text_is_utf8(bad[i], strlen(bad[i])), 0);
    }
    static const char *const good[] = {
        "",
        "a",
        "\xc2\x80",
        "\xdf\xbf",
        "\xe0\xa0\x80",
        "\xed\x9f\xbf",
        "\xef\xbf\xbf",
        "\xf0\x90\x80\x80",
        "\xf4\x8f\xbf\xbf",
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        assert_int_equal(lrcsi_text_is_utf8(good[i], strlen(good[i])), 1);
    }
}

static void control_characters_become_question_marks(void **state)
{
    (void)state;
    reads_as("a\tb\x1b[31m\x7f", 9, "a?b?[31m?");
    reads_as("a\0b", 3, "a?b");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(utf8_and_ascii_stay_as_they_are),
        cmocka_unit_test(other_bytes_are_latin1),
        cmocka_unit_test(ill_formed_utf8_is_not_utf8),
        cmocka_unit_test(control_characters_become_question_marks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
