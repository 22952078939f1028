/* SPDX-License-Identifier: MIT */
/* Names from files, whatever bytes they are, as UTF-8 text. */
#ifndef LRCSI_TEXT_H
#define LRCSI_TEXT_H

#include <stddef.h>

/* Bytes of the well-formed UTF-8 sequence that begins the text, 0 if there is none. A terminator
   ends a sequence too early: of such text, 4 bytes may be claimed whatever there are. */
size_t lrcsi_text_sequence(const char *bytes, size_t size);

/* 1 if the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, surrogates or code points
   above U+10FFFF), else 0. Plain ASCII and no bytes at all are. */
int lrcsi_text_is_utf8(const char *bytes, size_t size);

/* Writes a name as UTF-8 with a terminator: unchanged if it is UTF-8, else each byte as
   Latin-1. Control characters (below U+0020, and U+007F) become '?'.
   Returned: bytes written with the terminator, at most 2 size + 1; `out` may be NULL to count.
   Notes: 1. U+0080..U+009F stay: Latin-1 turns bytes of other code pages into them, and names are
   to be distinguished. */
size_t lrcsi_text_utf8(const char *bytes, size_t size, char *out);

#endif
