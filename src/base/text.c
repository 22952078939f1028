/* SPDX-License-Identifier: MIT */
/* Decides whether the bytes of a name are UTF-8 or Latin-1, and writes them as UTF-8. Its caller
   decides where a name ends. */
#include "base/text.h"

#include <string.h>

/* Unicode Standard 15, table 3-7: the second byte's range depends on the first. */
size_t lrcsi_text_sequence(const char *bytes, size_t size)
{
    const unsigned char *at = (const unsigned char *)bytes;
    unsigned char lead = at[0];
    if (lead < 0x80) {
        return 1;
    }
    size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (lead < 0xc2 || lead > 0xf4 || size < length) {
        return 0;
    }
    unsigned char low = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
    unsigned char high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
    if (at[1] < low || at[1] > high) {
        return 0;
    }
    for (size_t i = 2; i < length; i++) {
        if ((at[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    return length;
}

size_t lrcsi_text_mark(const char *bytes, size_t size)
{
    return size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

int lrcsi_text_is_utf8(const char *bytes, size_t size)
{
    size_t i = 0;
    while (i < size) {
        size_t length = lrcsi_text_sequence(bytes + i, size - i);
        if (length == 0) {
            return 0;
        }
        i += length;
    }
    return 1;
}

static void text_put(char *out, size_t *used, unsigned byte)
{
    if (out) {
        out[*used] = (char)(unsigned char)byte;
    }
    ++*used;
}

size_t lrcsi_text_utf8(const char *bytes, size_t size, char *out)
{
    int utf8 = lrcsi_text_is_utf8(bytes, size);
    size_t used = 0;
    for (size_t i = 0; i < size; i++) {
        unsigned byte = (unsigned char)bytes[i];
        if (byte < 0x20 || byte == 0x7f) {
            text_put(out, &used, '?');
        } else if (utf8 || byte < 0x80) {
            text_put(out, &used, byte);
        } else {
            text_put(out, &used, 0xc0 | byte >> 6);
            text_put(out, &used, 0x80 | (byte & 0x3f));
        }
    }
    text_put(out, &used, '\0');
    return used;
}
