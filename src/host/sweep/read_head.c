/* SPDX-License-Identifier: MIT */
/* The first lines of the rows of a sweep, read back from CSV or JSON lines: the options of the
   sweep, its shape, and the names of the columns. read.c reads the rows. */
#include "host/sweep/read.h"

#include <lrcs/table.h>

#include <stdlib.h>
#include <string.h>

#include "host/sweep/rows.h"

/* Adds a key and its text. Hash, rows and shape have their own fields; they precede everything that
   a user wrote. 0, or -1 if it is not valid. */
static int word_put(lrcs_host_rows_head *head, const char *key, const char *text)
{
    const uint32_t at = head->options;
    if (strcmp(key, "lrcs") == 0 || strcmp(key, "version") == 0 || strcmp(key, "schema") == 0) {
        return 0;
    }
    if (strcmp(key, "scene_hash") == 0) {
        head->scene_hash = strtoull(text, NULL, 16);
        return 0;
    }
    if (strcmp(key, "rows") == 0) {
        head->rows = head->rows ? head->rows : strtoull(text, NULL, 10);
        return 0;
    }
    if (strcmp(key, "shape") == 0 && head->dimensions > 0) {
        return 0;
    }
    if (strcmp(key, "shape") == 0) {
        uint64_t product = 1; /* N x M .. or N, M, ..]; the product is the number of rows */
        for (;; text++) {
            char *end;
            uint64_t size = strtoull(text, &end, 10);
            if (end == text || size == 0 || head->dimensions == LRCS_HOST_PLAN_AXES + 1 ||
                size > UINT64_MAX / product) {
                return -1;
            }
            head->shape[head->dimensions++] = size;
            product *= size;
            if (*end != 'x' && *end != ',') {
                return product == head->rows ? 0 : -1;
            }
            text = end;
        }
    }
    if (at == LRCS_HOST_HEAD_OPTIONS || strlen(text) >= sizeof head->option[0].text) {
        return -1;
    }
    head->option[at].key = key;
    snprintf(head->option[at].text, sizeof head->option[0].text, "%s", text);
    head->options++;
    return 0;
}

/* A CSV field of the line of column names; returns the next field, or NULL. */
static char *csv_name(char *at, const char **name)
{
    char *end = at;
    *name = at;
    if (*at == '"') {
        char *to = at;
        for (end = at + 1; *end && (*end != '"' || end[1] == '"'); end++) {
            end += *end == '"';
            *to++ = *end;
        }
        end += *end == '"';
        char next = *end;
        *to = '\0';
        return next == ',' ? end + 1 : NULL;
    }
    end += strcspn(at, ",");
    if (*end == '\0') {
        return NULL;
    }
    *end = '\0';
    return end + 1;
}

/* "# lrcs VERSION sweep; key=text; ..", and the line of names. The words of a head are texts in
   `line`. Returns the number of names, or 0 if a line is damaged. */
static uint32_t csv_words(char *line, lrcs_host_rows_head *head, const char *name[LRCSI_ROW_NAMES])
{
    uint32_t names = 0;
    char *next = strchr(line, '\n');
    *next++ = '\0';
    next[strcspn(next, "\n")] = '\0';
    for (char *at = lrcs_host_key_next(line); at;) {
        char *key = at + 2;
        char *text = strchr(key, '=');
        at = lrcs_host_key_next(text);
        if (at) {
            *at = '\0';
        }
        *text++ = '\0';
        if (word_put(head, key, text) != 0) {
            return 0;
        }
    }
    while (next && names < LRCSI_ROW_NAMES) {
        next = csv_name(next, &name[names++]);
    }
    return next ? 0 : names;
}

/* {"key": "text", "key": number, "key": [..], ..}, likewise; the names are those of the list
   "columns". */
static uint32_t json_words(char *line, lrcs_host_rows_head *head, const char *name[LRCSI_ROW_NAMES])
{
    uint32_t names = 0;
    for (char *at = strchr(line, '"'); at; at = strchr(at, '"')) {
        const char *key = at + 1;
        at = lrcs_host_json_unquote(at + 1);
        at += strspn(at, ": ");
        int quoted = *at == '"';
        int list = *at == '[';
        if (strcmp(key, "columns") == 0 && list) {
            for (at++; *at == '"' && names < LRCSI_ROW_NAMES; at += strspn(at, ", ")) {
                name[names++] = at + 1;
                at = lrcs_host_json_unquote(at + 1);
            }
            continue;
        }
        const char *text = at + (quoted || list);
        at = quoted ? lrcs_host_json_unquote(at + 1) : at;
        if (word_put(head, key, text) != 0) {
            return 0;
        }
    }
    return names;
}

int lrcsi_rows_head_read(lrcs_host_rows *rows, char **words, lrcs_host_rows_head *head,
                         const char *column[LRCS_HOST_PLAN_COLUMNS])
{
    const char *name[LRCSI_ROW_NAMES];
    memset(head, 0, sizeof *head);
    *words = strndup(rows->head, rows->head_size);
    if (!*words) {
        return LRCS_E_SYSTEM;
    }
    int csv = rows->format == LRCS_HOST_ROWS_CSV;
    uint32_t names = csv ? csv_words(*words, head, name) : json_words(*words, head, name);
    const char *sphere = lrcs_host_rows_head_text(head, "sphere");
    rows->fields = head->fields =
        lrcsi_row_fields(lrcs_host_rows_head_text(head, LRCSI_ROWS_UNCERTAINTY) != NULL,
                         lrcs_host_rows_head_text(head, LRCSI_ROWS_COARSE_GLINT) != NULL);
    rows->rows = head->rows;
    rows->dimensions = head->dimensions;
    memcpy(rows->shape, head->shape, sizeof rows->shape);
    rows->is_sphere = sphere && strtoull(sphere, NULL, 10) == rows->rows;
    rows->flagged = lrcs_host_rows_head_text(head, "accept") != NULL;
    uint32_t others = csv ? 2 + rows->fields.count : 0; /* index, fields and flags */
    rows->columns = names > others ? names - others : 0;
    if (rows->rows == 0 || rows->dimensions == 0 || rows->columns == 0 ||
        rows->columns > LRCS_HOST_PLAN_COLUMNS) {
        return LRCS_E_SYNTAX;
    }
    memcpy(column, name + csv, rows->columns * sizeof *column);
    return LRCS_OK;
}

int lrcs_host_rows_open(const char *bytes, size_t size, lrcs_host_rows *rows)
{
    static const char csv[] = "# lrcs ";
    static const char json[] = "{\"lrcs\": \"sweep\"";
    const char *end = bytes + size;
    const char *at = memchr(bytes, '\n', size);
    int is_csv = size > sizeof csv && memcmp(bytes, csv, sizeof csv - 1) == 0;
    int is_json = size > sizeof json && memcmp(bytes, json, sizeof json - 1) == 0;
    memset(rows, 0, sizeof *rows);
    at = at && is_csv ? memchr(at + 1, '\n', (size_t)(end - at - 1)) : at;
    if (!at || (!is_csv && !is_json)) {
        return LRCS_E_SYNTAX;
    }
    *rows = (lrcs_host_rows){.format = is_csv ? LRCS_HOST_ROWS_CSV : LRCS_HOST_ROWS_JSONL,
                             .head = bytes,
                             .head_size = (size_t)(at + 1 - bytes),
                             .at = at + 1,
                             .end = end,
                             .number = is_csv ? 3 : 2};
    lrcs_host_rows_head head;
    const char *column[LRCS_HOST_PLAN_COLUMNS];
    char *words;
    int status = lrcsi_rows_head_read(rows, &words, &head, column);
    free(words);
    return status;
}
