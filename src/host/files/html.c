/* SPDX-License-Identifier: MIT */
/* Text and bytes for an HTML page that is well-formed XML too. It replaces characters that are
   markup or not allowed in a page; the caller decides the page. */
#include <lrcs/host.h>

#include "base/text.h"

#include <string.h>

void lrcs_host_html_text(FILE *out, const char *text)
{
    while (*text) {
        unsigned char byte = (unsigned char)*text;
        size_t count = lrcsi_text_sequence(text, LRCSI_TEXT_SEQUENCE_MAX);
        /* U+FFFE and U+FFFF, which XML excludes */
        int excluded =
            count == 3 && memcmp(text, "\xef\xbf", 2) == 0 && (unsigned char)text[2] >= 0xbe;
        if (byte == '<' || byte == '>') {
            fputs(byte == '<' ? "&lt;" : "&gt;", out);
        } else if (byte == '&' || byte == '"') {
            fputs(byte == '&' ? "&amp;" : "&quot;", out);
        } else if (count == 0 || (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f ||
                   excluded) {
            fputs("\xef\xbf\xbd", out);
        } else {
            fwrite(text, 1, count, out);
        }
        text += count > 0 ? count : 1;
    }
}

void lrcs_host_html_base64(FILE *out, const unsigned char *bytes, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned long three = (unsigned long)bytes[i] << 16 |
                              (left > 1 ? (unsigned long)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? bytes[i + 2] : 0);
        putc(digit[three >> 18], out);
        putc(digit[three >> 12 & 63], out);
        putc(left > 1 ? digit[three >> 6 & 63] : '=', out);
        putc(left > 2 ? digit[three & 63] : '=', out);
    }
}
