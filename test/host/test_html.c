/* SPDX-License-Identifier: MIT */
/* Text and bytes in an HTML page. */
#include <lrcs/host.h>

#include <stdlib.h>

#include "file_text.h"

static void check_text(const char *text, const char *want)
{
    FILE *file = tmpfile();
    lrcs_host_html_text(file, text);
    char *got = file_text(file);
    assert_string_equal(got, want);
    free(got);
}

static void markup_is_escaped(void **state)
{
    (void)state;
    check_text("<script>alert(\"1\")</script>",
               "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;");
    check_text("a & b ' c\n\td", "a &amp; b ' c\n\td");
    check_text("", "");
}

static void utf8_stays_as_it_is(void **state)
{
    (void)state;
    check_text("d\xc3\xa9or\xe2\x82\xac\xf0\x9f\x9b\xb0",
               "d\xc3\xa9or\xe2\x82\xac\xf0\x9f\x9b\xb0");
}

static void what_no_page_may_hold_is_replaced(void **state)
{
    (void)state;
    check_text("\x01\x7f", "\xef\xbf\xbd\xef\xbf\xbd");
    check_text("a\xe2\x82", "a\xef\xbf\xbd\xef\xbf\xbd"); /* a sequence that its end cuts off */
    check_text("\xff<", "\xef\xbf\xbd&lt;");
    check_text("\xef\xbf\xbe\xef\xbf\xbf\xef\xbf\xbd", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
    check_text("\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"); /* a surrogate */
}

/* The vectors of RFC 4648, section 10. */
static void base64_is_that_of_the_rfc(void **state)
{
    static const char *const want[] = {"",         "Zg==",     "Zm8=",    "Zm9v",
                                       "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    (void)state;
    for (size_t size = 0; size < sizeof want / sizeof want[0]; size++) {
        FILE *file = tmpfile();
        lrcs_host_html_base64(file, (const unsigned char *)"foobar", size);
        char *got = file_text(file);
        assert_string_equal(got, want[size]);
        free(got);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(markup_is_escaped),
                                       cmocka_unit_test(utf8_stays_as_it_is),
                                       cmocka_unit_test(what_no_page_may_hold_is_replaced),
                                       cmocka_unit_test(base64_is_that_of_the_rfc)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
