/* SPDX-License-Identifier: MIT */
/* Reading rows back, to go on with them, to join them, to make a map of them. It reads what
   sweep_rows writes and takes nothing else; a row cut short is no row. */
#include "cli/sweep.h"

#include <stdlib.h>
#include <string.h>

#define TEXT_LINE 4096u /* longer than any row */

/* ---- the head ---- */

/* The first lines as a string, for their keys; NULL where there is none. */
static char *head_copy(const sweep_text *text)
{
    char *copy = malloc(text->head_size + 1);
    if (copy) {
        memcpy(copy, text->head, text->head_size);
        copy[text->head_size] = '\0';
    }
    return copy;
}

/* What follows a key; rows and shape stand before anything that a user wrote. */
static const char *head_value(const char *head, const char *csv, const char *json)
{
    const char *key = head[0] == '#' ? csv : json;
    const char *at = strstr(head, key);
    return at ? at + strlen(key) : NULL;
}

/* N x M .. or [N, M, ..]; their product must be the number of rows. */
static int head_shape(const char *at, sweep_text *text)
{
    uint64_t product = 1;
    for (;;) {
        char *end;
        uint64_t size = strtoull(at, &end, 10);
        if (end == at || size == 0 || text->dimensions == SWEEP_AXES + 1 ||
            size > UINT64_MAX / product) {
            return -1;
        }
        text->shape[text->dimensions++] = size;
        product *= size;
        if (*end != 'x' && *end != ',') {
            return product == text->rows ? 0 : -1;
        }
        at = end + 1;
    }
}

static int head_read(const char *head, sweep_text *text)
{
    const char *rows = head_value(head, "; rows=", "\"rows\": ");
    const char *shape = head_value(head, "; shape=", "\"shape\": [");
    const char *sphere = head_value(head, "; sphere=", "\"sphere\": \"");
    text->rows = rows ? strtoull(rows, NULL, 10) : 0;
    text->has_mean = sphere && strtoull(sphere, NULL, 10) == text->rows;
    text->flagged = head_value(head, "; accept=", "\"accept\": \"") != NULL;
    return rows && shape && text->rows > 0 ? head_shape(shape, text) : -1;
}

int cli_text_open(const char *bytes, size_t size, sweep_text *text)
{
    static const char csv[] = "# lrcs ";
    static const char json[] = "{\"lrcs\": \"sweep\"";
    const char *end = bytes + size;
    const char *at = memchr(bytes, '\n', size);
    int is_csv = size > sizeof csv && memcmp(bytes, csv, sizeof csv - 1) == 0;
    int is_json = size > sizeof json && memcmp(bytes, json, sizeof json - 1) == 0;
    memset(text, 0, sizeof *text);
    at = at && is_csv ? memchr(at + 1, '\n', (size_t)(end - at - 1)) : at;
    if (!at || (!is_csv && !is_json)) {
        return -1;
    }
    *text = (sweep_text){.format = is_csv ? SWEEP_CSV : SWEEP_JSONL,
                         .head = bytes,
                         .head_size = (size_t)(at + 1 - bytes),
                         .at = at + 1,
                         .end = end};
    char *head = head_copy(text);
    int fault = head ? head_read(head, text) : -1;
    free(head);
    return fault;
}

/* ---- rows ---- */

/* A number up to one of the bytes `stop`; -1 where none stands there. Moves *at past it. */
static int text_number(const char **at, const char *stop, double *value)
{
    size_t size = strcspn(*at, stop);
    int status = lrcs_host_number_read(*at, size, value);
    *at += size;
    return status == LRCS_OK ? 0 : -1;
}

/* Flags in words, whatever stands between them. */
static int text_flags(const char *at, uint32_t *flags)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz_";
    *flags = 0;
    for (at += strcspn(at, letters); *at; at += strcspn(at, letters)) {
        size_t size = strspn(at, letters);
        uint32_t found = 0;
        for (uint32_t bit = 1; bit <= LRCS_FLAG_ACCEPTED_UNJUDGED; bit *= 2) {
            const char *name = lrcs_flag_text((int)bit);
            found |= strlen(name) == size && memcmp(name, at, size) == 0 ? bit : 0;
        }
        if (!found) {
            return -1;
        }
        *flags |= found;
        at += size;
    }
    return 0;
}

static int csv_read(const char *line, sweep_row *row)
{
    const char *field[4]; /* the last four */
    const char *comma = line + strlen(line);
    for (int i = 3; i >= 0; i--) {
        do {
            if (comma == line) {
                return -1;
            }
            comma--;
        } while (*comma != ',');
        field[i] = comma + 1;
    }
    return text_number(&field[0], ",", &row->sigma_m2) != 0 ||
                   text_number(&field[2], ",", &row->bound_m2) != 0
               ? -1
               : text_flags(field[3], &row->flags);
}

static int jsonl_read(const char *line, sweep_row *row)
{
    static const char *const key[] = {", \"sigma_m2\": ", ", \"bound_m2\": ", ", \"flags\": ["};
    const char *at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = strstr(line, key[i]);
        if (!at[i]) {
            return -1;
        }
        at[i] += strlen(key[i]);
    }
    return text_number(&at[0], ",", &row->sigma_m2) != 0 ||
                   text_number(&at[1], ",", &row->bound_m2) != 0
               ? -1
               : text_flags(at[2], &row->flags);
}

int cli_text_next(sweep_text *text, sweep_row *row, const char **line, size_t *line_size)
{
    static const char lead[] = "{\"index\": ";
    char copy[TEXT_LINE];
    const char *newline =
        text->at < text->end ? memchr(text->at, '\n', (size_t)(text->end - text->at)) : NULL;
    size_t size = newline ? (size_t)(newline - text->at) : 0;
    size_t skip = text->format == SWEEP_JSONL ? sizeof lead - 1 : 0;
    if (!newline || size >= sizeof copy || size <= skip || memcmp(text->at, lead, skip) != 0) {
        return 0;
    }
    memcpy(copy, text->at, size);
    copy[size] = '\0';
    char *end;
    row->index = strtoull(copy + skip, &end, 10);
    if (copy[skip] < '0' || copy[skip] > '9' || *end != ',' ||
        (text->format == SWEEP_JSONL ? jsonl_read(copy, row) : csv_read(copy, row)) != 0) {
        return 0;
    }
    *line = text->at;
    *line_size = size + 1;
    text->at = newline + 1;
    return 1;
}

/* ---- maps ---- */

static void npy_double(FILE *out, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++) {
        putc((int)(bits >> (8 * i) & 0xff), out);
    }
}

/* The format: numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0. */
void cli_npy_head(FILE *out, const sweep_text *text)
{
    char head[512];
    int used = snprintf(head, sizeof head, "{'descr': '<f8', 'fortran_order': False, 'shape': (");
    for (uint32_t i = 0; i < text->dimensions; i++) {
        used += snprintf(head + used, sizeof head - (size_t)used, "%llu, ",
                         (unsigned long long)text->shape[i]);
    }
    used += snprintf(head + used, sizeof head - (size_t)used, "%d), }", text->flagged ? 3 : 2);
    int whole = (10 + used + 1 + 63) / 64 * 64;
    fprintf(out, "%cNUMPY%c%c%c%c%s%*s\n", 0x93, 1, 0, (whole - 10) & 0xff, (whole - 10) >> 8, head,
            whole - 11 - used, "");
}

void cli_npy_row(FILE *out, const sweep_text *text, const sweep_row *row)
{
    npy_double(out, row->sigma_m2);
    npy_double(out, row->bound_m2);
    if (text->flagged) {
        npy_double(out, row->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE ? 1.0
                        : row->flags & LRCS_FLAG_ACCEPTED_UNJUDGED  ? 2.0
                        : row->flags & LRCS_FLAG_TOLERANCE_NOT_MET  ? -1.0
                                                                    : 0.0);
    }
}
