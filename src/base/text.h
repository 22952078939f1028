/* SPDX-License-Identifier: MIT */
/* Text from files: UTF-8 sequences, and names of any bytes as UTF-8. */
#ifndef LRCSI_TEXT_H
#define LRCSI_TEXT_H

#include <stddef.h>

/* The largest number of bytes of a UTF-8 sequence. */
#define LRCSI_TEXT_SEQUENCE_MAX 4u

/* The length of the well-formed UTF-8 sequence at the beginning of the text, 0 if there is none.
   For terminated text `size` may be LRCSI_TEXT_SEQUENCE_MAX even if fewer bytes follow, because a
   terminator ends a sequence. */
size_t lrcsi_text_sequence(const char *bytes, size_t size);

/* The length of the UTF-8 byte order mark at the beginning of the bytes: 3, or 0 if there
   is none. */
size_t lrcsi_text_mark(const char *bytes, size_t size);

/* 1 if the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, surrogates or code points
   above U+10FFFF), else 0. Plain ASCII and no bytes at all are. */
int lrcsi_text_is_utf8(const char *bytes, size_t size);

/* Writes a name as UTF-8 with a terminator: unchanged if it is UTF-8, else each byte as
   Latin-1. Control characters (below U+0020, and U+007F) become '?'.
   Returned: bytes written with the terminator, at most 2 size + 1; `out` may be NULL to count.
   Notes: 1. U+0080..U+009F are kept: bytes of other code pages become these characters as Latin-1,
   and names that differ in such bytes stay different. */
size_t lrcsi_text_utf8(const char *bytes, size_t size, char *out);

#endif
