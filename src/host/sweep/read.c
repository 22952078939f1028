/* SPDX-License-Identifier: MIT */
/* Reads the rows of a sweep back, after their first lines (read_head.c). It accepts only what
   rows.c writes: every field of a row is checked, and a checksum is compared with the preceding
   bytes. A truncated last line is not a row. */
#include "host/sweep/read.h"

#include <lrcs/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/fail.h"
#include "host/sweep/rows.h"

#define ROW_LINE 4096u /* longer than any row */

/* ---- rows ---- */

static int row_refuse(const lrcs_host_rows *rows, const char *name, const char *found,
                      const char *expected, lrcs_host_error *error)
{
    return lrcsi_host_fail(error, LRCS_E_SYNTAX, "line %llu, %s: found '%.40s', expected %.80s",
                           (unsigned long long)rows->number, name, found, expected);
}

/* Reads flags as words separated by blanks, or by commas and quotes. */
static int flags_read(const char *at, uint32_t *flags)
{
    *flags = 0;
    for (at += strspn(at, " ,\""); *at; at += strspn(at, " ,\"")) {
        size_t size = strcspn(at, " ,\"");
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

/* Splits {"key": value, ..., "flags": [..]} into index, values and fields, in place. Returns their
   number; fields beyond `room` are only counted; 0 if the line does not have this form. The keys of
   fields must be the known ones; those of values are the names that the user chose, in the order of
   the head. */
static uint32_t jsonl_split(char *line, const char **field, uint32_t room, uint32_t columns,
                            const lrcs_host_row_fields *fields)
{
    uint32_t count = 0;
    char *at = line;
    for (*at = ','; *at == ','; count++) {
        *at++ = '\0';
        at += strspn(at, " ");
        const char *key = at + 1;
        for (at += *at == '"'; *at && *at != '"'; at++) {
            at += *at == '\\' && at[1] != '\0';
        }
        uint32_t i = count - columns - 1; /* of the fields, which end with the flags */
        const char *want = count == 0           ? "index"
                           : count <= columns   ? NULL
                           : i < fields->count  ? lrcsi_row_field_text(fields->kind[i])
                           : i == fields->count ? "flags"
                                                : "";
        if (strncmp(at, "\": ", 3) != 0 || (want && (strlen(want) != (size_t)(at - key) ||
                                                     memcmp(want, key, strlen(want)) != 0))) {
            return 0;
        }
        at += 3;
        int list = *at == '[';
        at += list;
        if (count < room) {
            field[count] = at;
        }
        at += strcspn(at, list ? "]" : ",}");
        if (list && *at == ']') {
            *at++ = '\0';
        }
    }
    int whole = strcmp(at, "}") == 0;
    *at = '\0';
    return whole ? count : 0;
}

/* Reads a number; an empty field, or null, means that there is none. */
static int field_number(const lrcs_host_rows *rows, const char *field, double *value)
{
    *value = (double)NAN;
    return field[0] == '\0' || (rows->format == LRCS_HOST_ROWS_JSONL && strcmp(field, "null") == 0)
               ? LRCS_OK
               : lrcs_host_number_read(field, strlen(field), value);
}

/* 1 if two doubles are as close as the results of two different libms. */
static int about_equal(double a, double b, double relative)
{
    return fabs(a - b) <= relative * fmax(fabs(a), fabs(b));
}

static int row_values_read(const lrcs_host_rows *rows, const lrcs_host_plan *plan,
                           const char *const *field, lrcs_host_row *row, lrcs_host_error *error)
{
    double want[LRCS_HOST_PLAN_COLUMNS] = {0.0};
    char name[40];
    if (plan) {
        lrcs_host_plan_values(plan, row->index, want);
    }
    for (uint32_t i = 0; i < rows->columns; i++) {
        snprintf(name, sizeof name, "value %lu", (unsigned long)i + 1);
        if (field_number(rows, field[i], &row->value[i]) != LRCS_OK || !isfinite(row->value[i])) {
            return row_refuse(rows, plan ? plan->column[i] : name, field[i], "a finite number",
                              error);
        }
        /* directions of a sphere come from libm */
        int close = !plan || row->value[i] == want[i] ||
                    (plan->kind == LRCS_HOST_PLAN_SPHERE && i >= plan->axes &&
                     fabs(row->value[i] - want[i]) <= 1e-14);
        if (!close) {
            char expected[LRCS_HOST_NUMBER_SIZE];
            lrcs_host_number_text(want[i], expected);
            return row_refuse(rows, plan->column[i], field[i], expected, error);
        }
    }
    return LRCS_OK;
}

/* 1. Reads the fields: numbers of at least 0 (dBsm may be negative, or none), of which yes or no is
   1 or 0.
   2. Checks that they fit together. dBsm is that of sigma; glint and diffuse are separate sums and
      are rounded. To first order the interval of the material uncertainty ends one deviation below
      sigma, but not below 0, and one above. The error of a glint is at most that glint.
   3. Reads the flags. */
static int row_fields_read(const lrcs_host_rows *rows, const char *const *field, lrcs_host_row *row,
                           lrcs_host_error *error)
{
    memset(row->field, 0, sizeof row->field);
    for (uint32_t i = 0; i < rows->fields.count; i++) { /* 1 */
        int kind = rows->fields.kind[i];
        int extra = kind >= LRCS_HOST_ROW_DEVIATION; /* of some sweeps only */
        int dbsm = kind == LRCS_HOST_ROW_DBSM;
        int yes_or_no = kind == LRCS_HOST_ROW_SAMPLED || kind == LRCS_HOST_ROW_DOMINATED;
        double *value = &row->field[kind];
        if (field_number(rows, field[i], value) != LRCS_OK || (!dbsm && !(*value >= 0.0)) ||
            (extra && !isfinite(*value))) {
            return row_refuse(rows, lrcsi_row_field_text(kind), field[i],
                              dbsm    ? "a number"
                              : extra ? "a finite number of at least 0"
                                      : "a number of at least 0",
                              error);
        }
        if (yes_or_no && *value != 0.0 && *value != 1.0) {
            return row_refuse(rows, lrcsi_row_field_text(kind), field[i], "0 or 1", error);
        }
    }
    const double *f = row->field;
    char dbsm_text[LRCS_HOST_NUMBER_SIZE];
    double sigma = f[LRCS_HOST_ROW_SIGMA];
    double dbsm = sigma > 0.0 ? 10.0 * log10(sigma) : (double)NAN;
    double low = f[LRCS_HOST_ROW_LOW];
    double high = f[LRCS_HOST_ROW_HIGH];
    double end[2] = {fmax(0.0, sigma - f[LRCS_HOST_ROW_DEVIATION]),
                     sigma + f[LRCS_HOST_ROW_DEVIATION]};
    int sampled = !rows->fields.materials || f[LRCS_HOST_ROW_SAMPLED] != 0.0;
    lrcs_host_number_text(dbsm, dbsm_text);
    const struct {
        int good, field;
        const char *expected;
    } rule[] = {
        /* 2 */
        {sigma > 0.0 ? fabs(f[LRCS_HOST_ROW_DBSM] - dbsm) <= 1e-12 * (1.0 + fabs(dbsm))
                     : isnan(f[LRCS_HOST_ROW_DBSM]),
         LRCS_HOST_ROW_DBSM, sigma > 0.0 ? dbsm_text : "none, for a sigma of 0"},
        {about_equal(f[LRCS_HOST_ROW_GLINT] + f[LRCS_HOST_ROW_DIFFUSE], sigma, 1e-9),
         LRCS_HOST_ROW_GLINT, "what adds up to sigma_m2"},
        {sampled || (low <= high && fabs(low - end[0]) <= 1e-9 * end[1]), LRCS_HOST_ROW_LOW,
         "sigma less a deviation"},
        {low <= high, LRCS_HOST_ROW_LOW, "at most material_high_m2"},
        {sampled || about_equal(high, end[1], 1e-9), LRCS_HOST_ROW_HIGH, "sigma and a deviation"},
        {f[LRCS_HOST_ROW_GLINT_ERROR] <= (1.0 + 1e-9) * f[LRCS_HOST_ROW_GLINT],
         LRCS_HOST_ROW_GLINT_ERROR, "at most sigma_glint_m2"}};
    for (size_t k = 0; k < sizeof rule / sizeof rule[0]; k++) {
        for (uint32_t i = 0; i < rows->fields.count && !rule[k].good; i++) {
            if (rows->fields.kind[i] == rule[k].field) {
                return row_refuse(rows,
                                  rule[k].field == LRCS_HOST_ROW_GLINT
                                      ? "sigma_glint_m2 and sigma_diffuse_m2"
                                      : lrcsi_row_field_text(rule[k].field),
                                  field[i], rule[k].expected, error);
            }
        }
    }
    const char *flags = field[rows->fields.count]; /* 3 */
    return flags_read(flags, &row->flags) == 0
               ? LRCS_OK
               : row_refuse(rows, "flags", flags, "names of flags", error);
}

/* Reads a row from a copy of a complete line. */
static int row_line_read(const lrcs_host_rows *rows, const lrcs_host_plan *plan, char *line,
                         lrcs_host_row *row, lrcs_host_error *error)
{
    const char *field[LRCSI_ROW_NAMES];
    for (size_t i = 0; i < LRCSI_ROW_NAMES; i++) {
        field[i] = "";
    }
    const uint32_t room = 2 + rows->columns + rows->fields.count; /* with index and flags */
    char begun[41];
    snprintf(begun, sizeof begun, "%.40s", line);
    uint32_t count = 0;
    if (rows->format == LRCS_HOST_ROWS_JSONL) {
        count = jsonl_split(line, field, room, rows->columns, &rows->fields);
    }
    for (char *at = rows->format == LRCS_HOST_ROWS_CSV ? line : NULL; at; count++) {
        char *comma = strchr(at, ',');
        if (comma) {
            *comma++ = '\0';
        }
        if (count < room) {
            field[count] = at;
        }
        at = comma;
    }
    if (count != room) {
        char expected[60];
        snprintf(expected, sizeof expected, "a row of %lu fields", (unsigned long)room);
        return row_refuse(rows, "the row", begun, expected, error);
    }
    char *end;
    row->index = strtoull(field[0], &end, 10);
    if (field[0][0] < '0' || field[0][0] > '9' || *end != '\0' || row->index >= rows->rows) {
        return row_refuse(rows, "index", field[0], "the number of a row of the sweep", error);
    }
    int status = row_values_read(rows, plan, field + 1, row, error);
    return status != LRCS_OK ? status
                             : row_fields_read(rows, field + 1 + rows->columns, row, error);
}

/* The beginnings of the lines after the rows. */
static const char *const mean_lead[] = {"# mean_sigma_m2=", "{\"mean_sigma_m2\": "};
static const char *const sum_lead[] = {"# checksum=fnv1a:", "{\"checksum\": \"fnv1a:"};

static int rows_begin(const lrcs_host_rows *rows, const char *lead)
{
    size_t size = strlen(lead);
    return (size_t)(rows->end - rows->at) >= size && memcmp(rows->at, lead, size) == 0;
}

int lrcs_host_rows_next(lrcs_host_rows *rows, const lrcs_host_plan *plan, lrcs_host_row *row,
                        lrcs_host_error *error)
{
    char copy[ROW_LINE];
    const char *newline =
        rows->at < rows->end ? memchr(rows->at, '\n', (size_t)(rows->end - rows->at)) : NULL;
    if (!newline || rows_begin(rows, mean_lead[rows->format]) ||
        rows_begin(rows, sum_lead[rows->format])) {
        return 0;
    }
    size_t size = (size_t)(newline - rows->at);
    size = size < sizeof copy ? size : sizeof copy - 1;
    memcpy(copy, rows->at, size);
    copy[size] = '\0';
    int status = row_line_read(rows, plan, copy, row, error);
    if (status != LRCS_OK) {
        return status;
    }
    rows->line = rows->at;
    rows->line_size = size + 1;
    rows->at = newline + 1;
    rows->number++;
    return 1;
}

int lrcs_host_rows_end(lrcs_host_rows *rows, lrcs_host_error *error)
{
    char expected[LRCSI_ROWS_SUM_SIZE];
    char found[41];
    if (rows_begin(rows, mean_lead[rows->format])) {
        const char *newline = memchr(rows->at, '\n', (size_t)(rows->end - rows->at));
        if (!newline) {
            return 0;
        }
        rows->at = newline + 1;
        rows->number++;
    }
    if (!memchr(rows->at, '\n', (size_t)(rows->end - rows->at))) {
        return 0; /* the end, or a truncated line */
    }
    lrcsi_rows_sum_text(
        rows->format,
        lrcs_host_hash(LRCS_HOST_HASH_START, rows->head, (size_t)(rows->at - rows->head)),
        expected);
    size_t size = strlen(expected);
    if ((size_t)(rows->end - rows->at) == size && memcmp(rows->at, expected, size) == 0) {
        return 1;
    }
    snprintf(found, sizeof found, "%.*s", (int)strcspn(rows->at, "\n"), rows->at);
    expected[size - 1] = '\0';
    return row_refuse(rows, "the last line", found, expected, error);
}

int lrcsi_rows_read(const char *path, const lrcs_host_rows *rows, const lrcs_host_plan *plan,
                    lrcsi_rows_take *take, void *context, uint64_t *first, uint64_t *count,
                    lrcs_host_error *error)
{
    lrcs_host_rows left = *rows;
    lrcs_host_row row;
    lrcs_host_error fault = {""};
    int more;
    *first = *count = 0;
    while ((more = lrcs_host_rows_next(&left, plan, &row, &fault)) == 1) {
        *first = *count == 0 ? row.index : *first;
        if (row.index != *first + *count) {
            return lrcsi_host_fail(error, LRCS_E_SYNTAX, "%s: its rows are not in order", path);
        }
        if (take) {
            take(context, &row);
        }
        ++*count;
    }
    int end = more == 0 ? lrcs_host_rows_end(&left, &fault) : more;
    if (end < 0) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX, "%s: is damaged: %s", path, fault.text);
    }
    return end == 1 ? LRCS_OK
                    : lrcsi_host_fail(error, LRCS_E_TRUNCATED,
                                      "%s: ends without its checksum: was its sweep stopped? "
                                      "--resume continues it",
                                      path);
}
