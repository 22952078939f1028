/* SPDX-License-Identifier: MIT */
/* JSON, RFC 8259, as a stream of items. It decides commas, lines and escapes; what the keys are
   is the caller's. Bytes that are not UTF-8 become U+FFFD, so that every reader accepts it. */
#include <lrcs/host.h>

#include <math.h>

/* Bytes of the well-formed UTF-8 sequence at text (Unicode 15, table 3-7), 0 for none. */
static int json_sequence(const unsigned char *text)
{
    unsigned a = text[0];
    unsigned low = 0x80;
    unsigned high = 0xbf;
    int more = a < 0x80 ? 0 : a < 0xe0 ? 1 : a < 0xf0 ? 2 : 3;
    if ((a >= 0x80 && a < 0xc2) || a > 0xf4) {
        return 0;
    }
    low = a == 0xe0 ? 0xa0 : a == 0xf0 ? 0x90 : low;
    high = a == 0xed ? 0x9f : a == 0xf4 ? 0x8f : high;
    for (int i = 1; i <= more; i++) {
        if (text[i] < low || text[i] > high) {
            return 0;
        }
        low = 0x80;
        high = 0xbf;
    }
    return more + 1;
}

static void json_quote(FILE *out, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    putc('"', out);
    while (*at) {
        int count = json_sequence(at);
        if (count == 0) {
            fputs("\\ufffd", out);
            count = 1;
        } else if (*at == '"' || *at == '\\') {
            fprintf(out, "\\%c", *at);
        } else if (*at < 0x20 || *at == 0x7f) {
            fprintf(out, "\\u%04x", *at);
        } else {
            fwrite(at, 1, (size_t)count, out);
        }
        at += count;
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
