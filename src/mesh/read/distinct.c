/* SPDX-License-Identifier: MIT */
/* Numbers distinct names. The caller owns the list and the text. Two names are equal if and only if
   their UTF-8 texts are equal. */
#include "mesh/read/distinct.h"

#include "base/text.h"

int lrcsi_distinct_make(const char **name, uint32_t capacity, lrcs_work *work,
                        lrcsi_distinct *distinct)
{
    distinct->name = name;
    return lrcsi_index_make(work, capacity, &distinct->index);
}

uint32_t lrcsi_distinct_add(lrcsi_distinct *distinct, const char *bytes, size_t size, char **text)
{
    size_t written = lrcsi_text_utf8(bytes, size, *text);
    uint32_t number = lrcsi_index_find(&distinct->index, 0, *text, written);
    if (number == LRCS_NONE) {
        number = distinct->index.count;
        lrcsi_index_put(&distinct->index, 0, *text, written, number);
        distinct->name[number] = *text;
        *text += written;
    }
    return number;
}
