/* SPDX-License-Identifier: MIT */
/* Decides the format of a file from its bytes, or from its name if the bytes do not show it. The
   file may still be unreadable. */
#include <lrcs/read.h>

#include <string.h>

#include "base/bytes.h"
#include "base/text.h"
#include "mesh/read/3ds.h"
#include "mesh/read/stl.h"

/* 1 if the bytes start with the root chunk of a 3DS file: its id, and a length that is either
   within the file or, in a truncated file, followed by the header of a chunk that may occur
   there. */
static int format_is_3ds(const unsigned char *bytes, size_t size)
{
    if (size < 6 || lrcsi_bytes_u16(bytes) != LRCSI_TDS_ROOT) {
        return 0;
    }
    uint32_t length = lrcsi_bytes_u32(bytes + 2);
    unsigned first = size >= 8 ? lrcsi_bytes_u16(bytes + 6) : 0;
    return length >= 6 && (length <= size || first == LRCSI_TDS_VERSION ||
                           first == LRCSI_TDS_EDITOR || first == LRCSI_TDS_KEYFRAMER);
}

static int format_is_blank(unsigned char byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

/* 1 if the first line that is neither blank nor a comment starts with a keyword of OBJ. */
static int format_is_obj(const unsigned char *bytes, size_t size)
{
    static const char *const word[] = {"v", "vn", "vt", "vp", "f",      "o",
                                       "g", "s",  "l",  "p",  "mtllib", "usemtl"};
    size_t at = lrcsi_text_mark((const char *)bytes, size);
    while (at < size && (format_is_blank(bytes[at]) || bytes[at] == '#')) {
        if (bytes[at] == '#') {
            while (at < size && bytes[at] != '\n' && bytes[at] != '\r') {
                at++;
            }
        } else {
            at++;
        }
    }
    size_t end = at;
    while (end < size && !format_is_blank(bytes[end])) {
        end++;
    }
    for (size_t i = 0; end < size && i < sizeof word / sizeof *word; i++) {
        if (strlen(word[i]) == end - at && memcmp(word[i], bytes + at, end - at) == 0) {
            return 1;
        }
    }
    return 0;
}

/* 1 if the name has this ending (given in lower case). */
static int format_ends(const char *name, const char *ending)
{
    size_t size = strlen(name);
    size_t count = strlen(ending);
    if (size < count) {
        return 0;
    }
    for (size_t i = 0; i < count; i++) {
        unsigned char letter = (unsigned char)name[size - count + i];
        letter = letter >= 'A' && letter <= 'Z' ? (unsigned char)(letter + 32) : letter;
        if (letter != (unsigned char)ending[i]) {
            return 0;
        }
    }
    return 1;
}

int lrcs_format_check(const void *bytes, size_t size, const char *name)
{
    if (lrcsi_stl_is_binary(bytes, size)) {
        return LRCS_FORMAT_STL;
    }
    if (format_is_3ds(bytes, size)) {
        return LRCS_FORMAT_3DS;
    }
    if (lrcsi_stl_is_text(bytes, size)) {
        return LRCS_FORMAT_STL;
    }
    if (format_is_obj(bytes, size)) {
        return LRCS_FORMAT_OBJ;
    }
    if (name && format_ends(name, ".3ds")) {
        return LRCS_FORMAT_3DS;
    }
    if (name && format_ends(name, ".obj")) {
        return LRCS_FORMAT_OBJ;
    }
    return name && format_ends(name, ".stl") ? LRCS_FORMAT_STL : LRCS_FORMAT_UNKNOWN;
}
