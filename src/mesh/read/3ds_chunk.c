/* SPDX-License-Identifier: MIT */
/* Steps through the chunks of a 3DS file and reads items from them. It never reads beyond the end
   of a chunk, and no chunk extends beyond its parent. It does not interpret chunks. */
#include "mesh/read/3ds.h"

#include <string.h>

#include "base/bytes.h"
#include "base/text.h"
#include "base/where.h"

#define TDS_HEADER 6u

int lrcsi_tds_fail(const lrcsi_tds_walk *walk, int status, size_t at, const char *item,
                   const char *expected, uint64_t found)
{
    return lrcsi_where_number(walk->where, status, at, 0, item, expected, found);
}

int lrcsi_tds_check(const lrcsi_tds_walk *walk, const lrcsi_tds_chunk *chunk, size_t count,
                    size_t size, const char *item)
{
    size_t left = chunk->end - chunk->at;
    if (left / size >= count) {
        return LRCS_OK;
    }
    return lrcsi_tds_fail(walk, LRCS_E_SYNTAX, chunk->at, item,
                          "as many bytes as its chunk must hold", left);
}

/* Reports a chunk that is longer than the bytes that are left. */
static int tds_fail_left(const lrcsi_tds_walk *walk, int status, size_t at, uint32_t length,
                         size_t left, const char *expected)
{
    lrcsi_tds_fail(walk, status, at, "chunk length", expected, length);
    lrcsi_where_add(walk->where, " with ");
    lrcsi_where_add_number(walk->where, left);
    lrcsi_where_add(walk->where, " bytes left");
    return status;
}

int lrcsi_tds_next(lrcsi_tds_walk *walk, lrcsi_tds_chunk *parent, lrcsi_tds_chunk *chunk)
{
    size_t at = parent->at;
    size_t left = parent->end - at;
    if (left == 0) {
        return 0;
    }
    if (left < TDS_HEADER) {
        if (walk->truncated && parent->end == walk->size) {
            return lrcsi_tds_fail(walk, LRCS_E_TRUNCATED, at, "chunk header", "6 bytes", left);
        }
        walk->notices |= LRCS_MESH_TRAILING_BYTES;
        return 0;
    }
    uint32_t length = lrcsi_bytes_u32(walk->bytes + at + 2);
    if (length < TDS_HEADER) {
        return lrcsi_tds_fail(walk, LRCS_E_SYNTAX, at + 2, "chunk length", "at least 6", length);
    }
    if (length > left) {
        if (length > walk->size - at) {
            return tds_fail_left(walk, LRCS_E_TRUNCATED, at + 2, length, walk->size - at,
                                 "no more than the bytes left in the file: it is cut off");
        }
        return tds_fail_left(walk, LRCS_E_SYNTAX, at + 2, length, left,
                             "no more than the bytes left in the enclosing chunk");
    }
    *chunk = (lrcsi_tds_chunk){lrcsi_bytes_u16(walk->bytes + at), at + TDS_HEADER, at + length};
    parent->at = at + length;
    return 1;
}

int lrcsi_tds_name(const lrcsi_tds_walk *walk, lrcsi_tds_chunk *chunk, lrcsi_span *name,
                   const char *item)
{
    size_t left = chunk->end - chunk->at;
    const unsigned char *start = walk->bytes + chunk->at;
    const unsigned char *end = left > 0 ? memchr(start, 0, left) : NULL;
    if (!end) {
        return lrcsi_where_text(walk->where, LRCS_E_SYNTAX, chunk->at, 0, item,
                                "a terminating zero inside the chunk", (const char *)start, left);
    }
    *name = (lrcsi_span){chunk->at, (size_t)(end - start)};
    chunk->at += name->size + 1;
    return LRCS_OK;
}

const char *lrcsi_tds_store_name(lrcsi_tds_walk *walk, lrcsi_span name)
{
    const char *bytes = (const char *)walk->bytes + name.at;
    char *text = walk->text;
    size_t size = lrcsi_text_utf8(bytes, name.size, text);
    walk->counts.text_bytes += size;
    if (!lrcsi_text_is_utf8(bytes, name.size)) {
        walk->notices |= LRCS_MESH_LATIN1_NAMES;
    }
    if (text) {
        walk->text += size;
    }
    return text;
}

int lrcsi_tds_add(const lrcsi_tds_walk *walk, uint32_t *sum, uint32_t count, size_t at,
                  const char *item)
{
    if (count > LRCS_NONE - 2 - *sum) {
        return lrcsi_tds_fail(walk, LRCS_E_LIMIT, at, item, "fewer than 2^32 - 2 in all", count);
    }
    *sum += count;
    return LRCS_OK;
}
