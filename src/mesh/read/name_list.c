/* SPDX-License-Identifier: MIT */
/* Numbers distinct names. The caller owns the list and the text. Two names are equal if and only if
   their UTF-8 texts are equal. */
#include "mesh/read/name_list.h"

#include "base/text.h"

int lrcsi_name_list_make(const char **name, uint32_t capacity, lrcs_work *work,
                         lrcsi_name_list *list)
{
    list->name = name;
    return lrcsi_index_make(work, capacity, &list->index);
}

uint32_t lrcsi_name_list_add(lrcsi_name_list *list, const char *bytes, size_t size, char **text)
{
    size_t written = lrcsi_text_utf8(bytes, size, *text);
    uint32_t number = lrcsi_index_find(&list->index, 0, *text, written);
    if (number == LRCS_NONE) {
        number = list->index.count;
        lrcsi_index_put(&list->index, 0, *text, written, number);
        list->name[number] = *text;
        *text += written;
    }
    return number;
}
