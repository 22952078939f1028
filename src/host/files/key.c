/* SPDX-License-Identifier: MIT */
/* Lines of keys, "WORDS; key=text; ..", as tables begin with them, and texts of JSON, read back.
   This file decides where a text ends. */
#include <lrcs/table.h>

#include <math.h>
#include <stddef.h>
#include <string.h>

char *lrcs_host_key_next(const char *line)
{
    char *at = strstr(line, "; ");
    for (; at; at = strstr(at + 1, "; ")) {
        size_t size = strspn(at + 2, "abcdefghijklmnopqrstuvwxyz0123456789_-");
        if (size > 0 && at[2 + size] == '=') {
            break;
        }
    }
    return at;
}

int lrcs_host_key_text(const char *line, const char *key, char *text, size_t size)
{
    size_t length = strlen(key);
    for (const char *at = lrcs_host_key_next(line); at; at = lrcs_host_key_next(at + 2)) {
        if (strncmp(at + 2, key, length) == 0 && at[2 + length] == '=') {
            const char *begin = at + 3 + length;
            const char *end = lrcs_host_key_next(begin);
            int whole = (int)(end ? end - begin : (ptrdiff_t)strlen(begin));
            snprintf(text, size, "%.*s", whole, begin);
            return 1;
        }
    }
    return 0;
}

double lrcs_host_key_number(const char *line, const char *key)
{
    char text[64];
    double value;
    return lrcs_host_key_text(line, key, text, sizeof text) &&
                   lrcs_host_number_read(text, strlen(text), &value) == LRCS_OK
               ? value
               : (double)NAN;
}

char *lrcs_host_json_unquote(char *at)
{
    char *to = at;
    for (; *at && *at != '"'; at++) {
        if (*at == '\\' && at[1]) {
            at++;
        }
        *to++ = *at;
    }
    char *next = *at ? at + 1 : at;
    *to = '\0';
    return next;
}
