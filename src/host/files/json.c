/* SPDX-License-Identifier: MIT */
/* JSON, RFC 8259, as a stream of items. It decides commas, lines and escapes; the caller decides
   the keys. Bytes that are not UTF-8 become U+FFFD, so that every reader accepts it. */
#include <lrcs/host.h>

#include "base/text.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static void json_quote(FILE *out, const char *text)
{
    putc('"', out);
    while (*text) {
        unsigned char byte = (unsigned char)*text;
        size_t count = lrcsi_text_sequence(text, LRCSI_TEXT_SEQUENCE_MAX);
        if (count == 0) {
            fputs("\\ufffd", out);
            count = 1;
        } else if (byte == '"' || byte == '\\') {
            fprintf(out, "\\%c", byte);
        } else if (byte < 0x20 || byte == 0x7f) {
            fprintf(out, "\\u%04x", byte);
        } else {
            fwrite(text, 1, count, out);
        }
        text += count;
    }
    putc('"', out);
}

/* The comma, the line and the key before a value. */
static void json_lead(lrcs_host_json *json, const char *key)
{
    if (json->depth > 0) {
        if (json->level[json->depth - 1].filled) {
            putc(',', json->out);
        }
        if (!json->level[json->depth - 1].row) {
            fprintf(json->out, "\n%*s", (int)(2 * json->depth), "");
        } else if (json->level[json->depth - 1].filled) {
            putc(' ', json->out);
        }
        json->level[json->depth - 1].filled = 1;
    }
    if (key) {
        json_quote(json->out, key);
        fputs(": ", json->out);
    }
}

lrcs_host_json lrcs_host_json_make(FILE *out)
{
    lrcs_host_json json = {.out = out, .depth = 0};
    return json;
}

void lrcs_host_json_begin(lrcs_host_json *json, const char *key, int kind)
{
    int row = kind == LRCS_HOST_ROW_OBJECT || kind == LRCS_HOST_ROW_ARRAY;
    int object = kind == LRCS_HOST_OBJECT || kind == LRCS_HOST_ROW_OBJECT;
    json_lead(json, key);
    putc(object ? '{' : '[', json->out);
    uint32_t depth = json->depth;
    if (depth < sizeof json->level / sizeof json->level[0]) {
        json->level[depth].close = object ? '}' : ']';
        json->level[depth].row = (unsigned char)(row || (depth > 0 && json->level[depth - 1].row));
        json->level[depth].filled = 0;
        json->depth = depth + 1;
    }
}

void lrcs_host_json_end(lrcs_host_json *json)
{
    if (json->depth == 0) {
        return;
    }
    json->depth--;
    if (json->level[json->depth].filled && !json->level[json->depth].row) {
        fprintf(json->out, "\n%*s", (int)(2 * json->depth), "");
    }
    putc(json->level[json->depth].close, json->out);
    if (json->depth == 0) {
        putc('\n', json->out);
    }
}

void lrcs_host_json_text(lrcs_host_json *json, const char *key, const char *text)
{
    json_lead(json, key);
    if (text) {
        json_quote(json->out, text);
    } else {
        fputs("null", json->out);
    }
}

void lrcs_host_json_number(lrcs_host_json *json, const char *key, double value)
{
    char text[LRCS_HOST_NUMBER_SIZE];
    json_lead(json, key);
    lrcs_host_number_text(value, text);
    fputs(isfinite(value) ? text : "null", json->out);
}

void lrcs_host_json_count(lrcs_host_json *json, const char *key, uint64_t value)
{
    json_lead(json, key);
    fprintf(json->out, "%llu", (unsigned long long)value);
}

void lrcs_host_json_bool(lrcs_host_json *json, const char *key, int value)
{
    json_lead(json, key);
    fputs(value ? "true" : "false", json->out);
}

void lrcs_host_json_numbers(lrcs_host_json *json, const char *key, const double *value,
                            uint32_t count)
{
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_ARRAY);
    for (uint32_t i = 0; i < count; i++) {
        lrcs_host_json_number(json, NULL, value[i]);
    }
    lrcs_host_json_end(json);
}

/* One value of lrcs_host_json_put, of the conversion after its '%'. Returns the length of the
   conversion. */
static size_t json_conversion(lrcs_host_json *json, const char *key, const char *conversion,
                              va_list *list)
{
    size_t size = strspn(conversion, "l") + 1;
    switch (conversion[size - 1]) {
    case 's':
        lrcs_host_json_text(json, key, va_arg(*list, const char *));
        break;
    case 'g':
        lrcs_host_json_number(json, key, va_arg(*list, double));
        break;
    case 'd':
        lrcs_host_json_bool(json, key, va_arg(*list, int));
        break;
    default:
        lrcs_host_json_count(
            json, key, size > 1 ? va_arg(*list, unsigned long long) : va_arg(*list, unsigned));
        break;
    }
    return size;
}

void lrcs_host_json_put(lrcs_host_json *json, const char *format, ...)
{
    char name[40];
    va_list list;
    va_start(list, format);
    for (const char *at = format; *at;) {
        size_t size =
            strspn(at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-");
        const char *key = NULL;
        if (at[size] == '=') {
            snprintf(name, sizeof name, "%.*s", (int)size, at);
            key = name;
            at += size + 1;
        }
        int lines = at[0] != '\0' && at[1] == '\n';
        if (*at == '{') {
            lrcs_host_json_begin(json, key, lines ? LRCS_HOST_OBJECT : LRCS_HOST_ROW_OBJECT);
        } else if (*at == '[') {
            lrcs_host_json_begin(json, key, lines ? LRCS_HOST_ARRAY : LRCS_HOST_ROW_ARRAY);
        } else if (*at == '}' || *at == ']') {
            lrcs_host_json_end(json);
        } else if (*at == '%') {
            at += json_conversion(json, key, at + 1, &list);
        } else if (*at == 'n') {
            lrcs_host_json_text(json, key, NULL);
            at += strlen("null") - 1;
        }
        at++;
    }
    va_end(list);
}
