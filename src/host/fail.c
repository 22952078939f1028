/* SPDX-License-Identifier: MIT */
/* The sentences of the host layer: errors, with their place, and notices. It decides their form,
   not when they are issued. */
#include "host/fail.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* A name from a file may hold any bytes; control characters become '?', because they could move a
   terminal's cursor. */
static void text_sanitize(char *text)
{
    for (; *text; text++) {
        if ((unsigned char)*text < 0x20 || *text == 0x7f) {
            *text = '?';
        }
    }
}

int lrcsi_host_fail(lrcs_host_error *error, int status, const char *format, ...)
{
    if (error) {
        va_list list;
        va_start(list, format);
        vsnprintf(error->text, sizeof error->text, format, list);
        va_end(list);
        text_sanitize(error->text);
    }
    return status;
}

int lrcsi_host_fail_file(lrcs_host_error *error, const char *path, const char *what)
{
    return lrcsi_host_fail(error, LRCS_E_SYSTEM, "%s: cannot %s: %s", path, what, strerror(errno));
}

int lrcsi_host_fail_memory(lrcs_host_error *error, size_t bytes)
{
    return lrcsi_host_fail(error, LRCS_E_SYSTEM, "out of memory: no room for %zu bytes", bytes);
}

int lrcsi_host_out_of_memory(lrcs_host_error *error)
{
    return lrcsi_host_fail(error, LRCS_E_SYSTEM, "out of memory");
}

/* 1 if the text of a status says more than what was found and what was expected. */
static int adds_reason(int status)
{
    return status == LRCS_E_MEMORY || status == LRCS_E_TRUNCATED || status == LRCS_E_LIMIT ||
           status == LRCS_E_UNSUPPORTED || status == LRCS_E_EMPTY;
}

int lrcsi_host_fail_where(lrcs_host_error *error, int status, const char *path,
                          const lrcs_where *where)
{
    if (!where->item || !where->expected) {
        return lrcsi_host_fail(error, status, "%s: %s", path, lrcs_status_text(status));
    }
    char place[64];
    if (where->line != 0) {
        snprintf(place, sizeof place, "line %lu", (unsigned long)where->line);
    } else {
        snprintf(place, sizeof place, "byte %llu", (unsigned long long)where->offset);
    }
    const char *quote = where->found[0] ? "'" : "";
    int reason = adds_reason(status);
    return lrcsi_host_fail(error, status, "%s: %s: %s: found %s%s%s, expected %s%s%s%s", path,
                           place, where->item, quote, where->found[0] ? where->found : "nothing",
                           quote, where->expected, reason ? " (" : "",
                           reason ? lrcs_status_text(status) : "", reason ? ")" : "");
}

void lrcsi_host_note(lrcs_host_notices *notices, const char *format, ...)
{
    char text[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    text_sanitize(text);
    for (uint32_t i = 0; i < notices->count; i++) {
        if (strcmp(notices->text[i], text) == 0) {
            return;
        }
    }
    char **grown = realloc(notices->text, (notices->count + (size_t)1) * sizeof *grown);
    if (!grown) {
        return;
    }
    notices->text = grown;
    char *copy = malloc(strlen(text) + 1);
    if (copy) {
        strcpy(copy, text);
        notices->text[notices->count++] = copy;
    }
}
