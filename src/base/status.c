/* SPDX-License-Identifier: MIT */
/* Texts for status codes, the version, and the position at which a reader stopped. */
#include "base/where.h"

#include <string.h>

const char *lrcs_version(void)
{
    return LRCS_VERSION_TEXT;
}

const char *lrcs_status_text(int status)
{
    switch (status) {
    case LRCS_OK:
        return "done";
    case LRCS_E_ARGUMENT:
        return "an argument is outside its domain";
    case LRCS_E_MEMORY:
        return "the work area is too small";
    case LRCS_E_SYNTAX:
        return "the bytes do not follow the format";
    case LRCS_E_TRUNCATED:
        return "the bytes end inside an item";
    case LRCS_E_INDEX:
        return "an index points outside its list";
    case LRCS_E_NUMBER:
        return "a number is not finite or outside its range";
    case LRCS_E_NAME:
        return "a name is unknown or given twice";
    case LRCS_E_LIMIT:
        return "more items than the library can hold";
    case LRCS_E_UNSUPPORTED:
        return "well formed, but not supported by this version";
    case LRCS_E_EMPTY:
        return "there is nothing to read";
    default:
        return "unknown status code";
    }
}

/* Appends one byte of an excerpt, escaped if it cannot be printed. Returns the new length, or
   `used` if it no longer fits. */
static size_t append_printable(char *out, size_t used, size_t size, unsigned char byte)
{
    static const char digit[] = "0123456789abcdef";
    int plain = byte >= 0x20 && byte < 0x7f;
    if (used + (plain ? 1u : 4u) >= size) {
        return used;
    }
    if (plain) {
        out[used++] = (char)byte;
    } else {
        out[used++] = '\\';
        out[used++] = 'x';
        out[used++] = digit[byte >> 4];
        out[used++] = digit[byte & 15];
    }
    out[used] = '\0';
    return used;
}

/* Appends an excerpt to `found`, up to the first byte for which there is no room. */
static void append_text(lrcs_where *where, const char *text, size_t size)
{
    size_t used = strlen(where->found);
    for (size_t i = 0; i < size; i++) {
        size_t next =
            append_printable(where->found, used, sizeof where->found, (unsigned char)text[i]);
        if (next == used) {
            break;
        }
        used = next;
    }
}

int lrcsi_where_text(lrcs_where *where, int status, uint64_t offset, uint32_t line,
                     const char *item, const char *expected, const char *found, size_t size)
{
    if (!where) {
        return status;
    }
    *where = (lrcs_where){.offset = offset, .line = line, .item = item, .expected = expected};
    append_text(where, found, size);
    return status;
}

void lrcsi_where_add(lrcs_where *where, const char *text)
{
    if (where) {
        append_text(where, text, strlen(text));
    }
}

void lrcsi_where_add_number(lrcs_where *where, uint64_t number)
{
    char digits[20];
    size_t count = 0;
    do {
        digits[sizeof digits - ++count] = (char)('0' + number % 10);
        number /= 10;
    } while (number != 0);
    if (where) {
        append_text(where, digits + sizeof digits - count, count);
    }
}

int lrcsi_where_number(lrcs_where *where, int status, uint64_t offset, uint32_t line,
                       const char *item, const char *expected, uint64_t found)
{
    lrcsi_where_text(where, status, offset, line, item, expected, "", 0);
    lrcsi_where_add_number(where, found);
    return status;
}
