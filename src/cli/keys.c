/* SPDX-License-Identifier: MIT */
/* The first line of a table, "lrcs VERSION COMMAND; key=text; ..", read back. A text may contain
   "; " too: it ends where the next "; key=" begins. */
#include "cli/cli.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

char *cli_key_next(const char *line)
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

int cli_key_text(const char *line, const char *key, char *text, size_t size)
{
    size_t length = strlen(key);
    for (const char *at = cli_key_next(line); at; at = cli_key_next(at + 2)) {
        if (strncmp(at + 2, key, length) == 0 && at[2 + length] == '=') {
            const char *begin = at + 3 + length;
            const char *end = cli_key_next(begin);
            int whole = (int)(end ? end - begin : (ptrdiff_t)strlen(begin));
            snprintf(text, size, "%.*s", whole, begin);
            return 1;
        }
    }
    return 0;
}

double cli_key_number(const char *line, const char *key)
{
    char text[64];
    double value;
    return cli_key_text(line, key, text, sizeof text) &&
                   lrcs_host_number_read(text, strlen(text), &value) == LRCS_OK
               ? value
               : (double)NAN;
}

char *cli_json_unquote(char *at)
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
