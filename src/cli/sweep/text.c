/* SPDX-License-Identifier: MIT */
/* Reads rows back, to continue, join or map them. It accepts only what rows.c writes: every field
   of a row is checked, and a checksum is compared with the preceding bytes. A truncated last line
   is not a row. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_LINE 4096u /* longer than any row */

/* ---- the head ---- */

/* The text after a key; rows and shape precede everything that a user wrote. */
static const char *head_value(const char *head, const char *csv, const char *json)
{
    const char *key = head[0] == '#' ? csv : json;
    const char *at = strstr(head, key);
    return at ? at + strlen(key) : NULL;
}

/* Reads N x M .. or [N, M, ..]; the product must be the number of rows. */
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

/* The number of names between index and sigma_m2: in the second line, where commas in quotes do not
   separate, or in the list of the first line. */
static uint32_t head_columns(const char *head, uint32_t fields)
{
    const char *at = head[0] == '#' ? strchr(head, '\n') + 1 : strstr(head, "\"columns\": [");
    uint32_t count = 0;
    int quoted = 0;
    if (head[0] == '#') {
        for (; *at && *at != '\n'; at++) {
            quoted ^= *at == '"';
            count += *at == ',' && !quoted;
        }
        return count > fields + 1 ? count - fields - 1 : 0; /* the flags are one more */
    }
    for (at = at ? strchr(at, '[') + 1 : ""; *at && (*at != ']' || quoted); at++) {
        int escaped = *at == '\\' && at[1] != '\0';
        at += escaped;
        quoted ^= *at == '"' && !escaped;
        count += *at == '"' && quoted && !escaped;
    }
    return count;
}

static int head_read(const char *head, sweep_text *text)
{
    const char *rows = head_value(head, "; rows=", "\"rows\": ");
    const char *shape = head_value(head, "; shape=", "\"shape\": [");
    const char *sphere = head_value(head, "; sphere=", "\"sphere\": \"");
    text->rows = rows ? strtoull(rows, NULL, 10) : 0;
    text->has_mean = sphere && strtoull(sphere, NULL, 10) == text->rows;
    text->flagged = head_value(head, "; accept=", "\"accept\": \"") != NULL;
    text->fields = cli_fields_make(
        head_value(head, "; " SWEEP_UNCERTAINTY "=", "\"" SWEEP_UNCERTAINTY "\": \"") != NULL,
        head_value(head, "; " SWEEP_COARSE_GLINT "=", "\"" SWEEP_COARSE_GLINT "\": \"") != NULL);
    text->columns = head_columns(head, text->fields.count);
    return rows && shape && text->rows > 0 && text->columns > 0 && text->columns <= SWEEP_COLUMNS
               ? head_shape(shape, text)
               : -1;
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
                         .end = end,
                         .line = is_csv ? 3 : 2};
    char *head = strndup(text->head, text->head_size); /* a string, to search for keys */
    int fault = head ? head_read(head, text) : -1;
    free(head);
    return fault;
}

/* ---- rows ---- */

static int text_refuse(sweep_text *text, const char *name, const char *found, const char *expected)
{
    snprintf(text->fault, sizeof text->fault, "line %llu, %s: found '%.40s', expected %.80s",
             (unsigned long long)text->line, name, found, expected);
    return -1;
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

/* Splits a row into index, values and fields, in place. Returns their number; fields beyond `room`
   are only counted. */
static uint32_t csv_split(char *line, const char **field, uint32_t room)
{
    uint32_t count = 0;
    for (char *at = line; at; count++) {
        char *comma = strchr(at, ',');
        if (comma) {
            *comma++ = '\0';
        }
        if (count < room) {
            field[count] = at;
        }
        at = comma;
    }
    return count;
}

/* The same for {"key": value, ..., "flags": [..]}; 0 if the line does not have this form. The keys
   of fields must be the known ones; those of values are the names that the user chose, in the order
   of the head. */
static uint32_t jsonl_split(char *line, const char **field, uint32_t room, uint32_t columns,
                            const sweep_fields *fields)
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
                           : i < fields->count  ? cli_field_name[fields->kind[i]]
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
static int field_number(const sweep_text *text, const char *field, double *value)
{
    *value = (double)NAN;
    return field[0] == '\0' || (text->format == SWEEP_JSONL && strcmp(field, "null") == 0)
               ? 0
               : lrcs_host_number_read(field, strlen(field), value);
}

/* 1 if two doubles are as close as the results of two different libms. */
static int about_equal(double a, double b, double relative)
{
    return fabs(a - b) <= relative * fmax(fabs(a), fabs(b));
}

static int values_read(sweep_text *text, const sweep_plan *plan, const char *const *field,
                       sweep_row *row)
{
    double want[SWEEP_COLUMNS] = {0.0};
    char name[40];
    if (plan) {
        cli_plan_values(plan, row->index, want);
    }
    for (uint32_t i = 0; i < text->columns; i++) {
        snprintf(name, sizeof name, "value %lu", (unsigned long)i + 1);
        if (field_number(text, field[i], &row->value[i]) != 0 || !isfinite(row->value[i])) {
            return text_refuse(text, plan ? plan->column[i] : name, field[i], "a finite number");
        }
        /* directions of a sphere come from libm */
        int close = !plan || row->value[i] == want[i] ||
                    (plan->kind == SWEEP_SPHERE && i >= plan->axes &&
                     fabs(row->value[i] - want[i]) <= 1e-14);
        if (!close) {
            char expected[LRCS_HOST_NUMBER_SIZE];
            lrcs_host_number_text(want[i], expected);
            return text_refuse(text, plan->column[i], field[i], expected);
        }
    }
    return 0;
}

/* Reads the fields from `first` to before `end`: numbers of at least 0 (dBsm may be negative, or
   none), of which yes or no is 1 or 0. */
static int numbers_read(sweep_text *text, const char *const *field, uint32_t first, uint32_t end,
                        sweep_row *row)
{
    for (uint32_t i = first; i < end; i++) {
        int kind = text->fields.kind[i];
        int extra = kind >= FIELD_DEVIATION; /* of some sweeps only */
        double *value = &row->field[kind];
        if (field_number(text, field[i], value) != 0 || (kind != FIELD_DBSM && !(*value >= 0.0)) ||
            (extra && !isfinite(*value))) {
            return text_refuse(text, cli_field_name[kind], field[i],
                               kind == FIELD_DBSM ? "a number"
                               : extra            ? "a finite number of at least 0"
                                                  : "a number of at least 0");
        }
        if ((kind == FIELD_SAMPLED || kind == FIELD_DOMINATED) && *value != 0.0 && *value != 1.0) {
            return text_refuse(text, cli_field_name[kind], field[i], "0 or 1");
        }
    }
    return 0;
}

/* Checks the fields that only some sweeps have. To first order the interval of the material
   uncertainty ends one deviation below sigma, but not below 0, and one above. The error of a glint
   is at most that glint. */
static int extras_check(sweep_text *text, const char *const *field, const sweep_row *row)
{
    const double *f = row->field;
    double sigma = f[FIELD_SIGMA];
    double deviation = f[FIELD_DEVIATION];
    double low = fmax(0.0, sigma - deviation);
    int plain = text->fields.materials && f[FIELD_SAMPLED] == 0.0;
    int fault = FIELD_SIGMA; /* none */
    const char *expected = NULL;
    if (!(f[FIELD_LOW] <= f[FIELD_HIGH]) ||
        (plain && !(fabs(f[FIELD_LOW] - low) <= 1e-9 * (sigma + deviation)))) {
        fault = FIELD_LOW;
        expected = plain ? "sigma less a deviation" : "at most material_high_m2";
    } else if (plain && !about_equal(f[FIELD_HIGH], sigma + deviation, 1e-9)) {
        fault = FIELD_HIGH;
        expected = "sigma and a deviation";
    } else if (!(f[FIELD_GLINT_ERROR] <= (1.0 + 1e-9) * f[FIELD_GLINT])) {
        fault = FIELD_GLINT_ERROR;
        expected = "at most sigma_glint_m2";
    }
    for (uint32_t i = 0; i < text->fields.count && expected; i++) {
        if (text->fields.kind[i] == fault) {
            return text_refuse(text, cli_field_name[fault], field[i], expected);
        }
    }
    return 0;
}

static int fields_read(sweep_text *text, const char *const *field, sweep_row *row)
{
    memset(row->field, 0, sizeof row->field);
    if (numbers_read(text, field, 0, FIELD_DEVIATION, row) != 0) {
        return -1;
    }
    double sigma = row->field[FIELD_SIGMA];
    double dbsm = sigma > 0.0 ? cli_dbsm(sigma) : (double)NAN;
    if (sigma > 0.0 ? !(fabs(row->field[FIELD_DBSM] - dbsm) <= 1e-12 * (1.0 + fabs(dbsm)))
                    : !isnan(row->field[FIELD_DBSM])) {
        char expected[LRCS_HOST_NUMBER_SIZE + 16];
        lrcs_host_number_text(dbsm, expected);
        return text_refuse(text, "sigma_dbsm", field[FIELD_DBSM],
                           sigma > 0.0 ? expected : "none, for a sigma of 0");
    }
    /* both are separate sums and are rounded */
    if (!about_equal(row->field[FIELD_GLINT] + row->field[FIELD_DIFFUSE], sigma, 1e-9)) {
        return text_refuse(text, "sigma_glint_m2 and sigma_diffuse_m2", field[FIELD_GLINT],
                           "what adds up to sigma_m2");
    }
    if (numbers_read(text, field, FIELD_DEVIATION, text->fields.count, row) != 0 ||
        extras_check(text, field, row) != 0) {
        return -1;
    }
    const char *flags = field[text->fields.count];
    return flags_read(flags, &row->flags) == 0
               ? 0
               : text_refuse(text, "flags", flags, "names of flags");
}

/* Reads a row from a copy of a complete line. */
static int row_read(sweep_text *text, const sweep_plan *plan, char *line, sweep_row *row)
{
    const char *field[2 + SWEEP_COLUMNS + SWEEP_FIELDS];
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++) {
        field[i] = "";
    }
    const uint32_t room = 2 + text->columns + text->fields.count; /* with index and flags */
    char begun[41];
    snprintf(begun, sizeof begun, "%.40s", line);
    uint32_t count = text->format == SWEEP_JSONL
                         ? jsonl_split(line, field, room, text->columns, &text->fields)
                         : csv_split(line, field, room);
    if (count != room) {
        char expected[60];
        snprintf(expected, sizeof expected, "a row of %lu fields", (unsigned long)room);
        return text_refuse(text, "the row", begun, expected);
    }
    char *end;
    row->index = strtoull(field[0], &end, 10);
    if (field[0][0] < '0' || field[0][0] > '9' || *end != '\0' || row->index >= text->rows) {
        return text_refuse(text, "index", field[0], "the number of a row of the sweep");
    }
    int fault = values_read(text, plan, field + 1, row);
    return fault ? fault : fields_read(text, field + 1 + text->columns, row);
}

/* The beginnings of the lines after the rows. */
static const char *const mean_lead[] = {"# mean_sigma_m2=", "{\"mean_sigma_m2\": "};
static const char *const sum_lead[] = {"# checksum=fnv1a:", "{\"checksum\": \"fnv1a:"};

static int text_begins(const sweep_text *text, const char *lead)
{
    size_t size = strlen(lead);
    return (size_t)(text->end - text->at) >= size && memcmp(text->at, lead, size) == 0;
}

int cli_text_next(sweep_text *text, const sweep_plan *plan, sweep_row *row, const char **line,
                  size_t *line_size)
{
    char copy[TEXT_LINE];
    const char *newline =
        text->at < text->end ? memchr(text->at, '\n', (size_t)(text->end - text->at)) : NULL;
    if (!newline || text_begins(text, mean_lead[text->format]) ||
        text_begins(text, sum_lead[text->format])) {
        return 0;
    }
    size_t size = (size_t)(newline - text->at);
    size = size < sizeof copy ? size : sizeof copy - 1;
    memcpy(copy, text->at, size);
    copy[size] = '\0';
    if (row_read(text, plan, copy, row) != 0) {
        return -1;
    }
    *line = text->at;
    *line_size = size + 1;
    text->at = newline + 1;
    text->line++;
    return 1;
}

int cli_text_end(sweep_text *text)
{
    if (text_begins(text, mean_lead[text->format])) {
        const char *newline = memchr(text->at, '\n', (size_t)(text->end - text->at));
        if (!newline) {
            return 0;
        }
        text->at = newline + 1;
        text->line++;
    }
    if (!memchr(text->at, '\n', (size_t)(text->end - text->at))) {
        return 0; /* the end, or a truncated line */
    }
    uint64_t sum = cli_sum_more(CLI_SUM_BEGIN, text->head, (size_t)(text->at - text->head));
    char expected[80];
    FILE *out = fmemopen(expected, sizeof expected, "w");
    if (!out) {
        return text_refuse(text, "the checksum", "", "memory to compute it");
    }
    cli_rows_sum(out, text->format, sum);
    fclose(out);
    size_t size = strlen(expected);
    if ((size_t)(text->end - text->at) == size && memcmp(text->at, expected, size) == 0) {
        return 1;
    }
    char found[41];
    snprintf(found, sizeof found, "%.*s", (int)strcspn(text->at, "\n"), text->at);
    expected[size - 1] = '\0';
    return text_refuse(text, "the last line", found, expected);
}

int cli_text_rows(const char *path, const sweep_text *text, const sweep_plan *plan,
                  sweep_take *take, void *context, uint64_t *first, uint64_t *rows)
{
    sweep_text left = *text;
    sweep_row row;
    const char *line;
    size_t size;
    int more;
    *first = *rows = 0;
    while ((more = cli_text_next(&left, plan, &row, &line, &size)) == 1) {
        *first = *rows == 0 ? row.index : *first;
        if (row.index != *first + *rows) {
            fprintf(stderr, "lrcs: %s: its rows are not in order\n", path);
            return CLI_FAILED;
        }
        if (take) {
            take(context, &row);
        }
        ++*rows;
    }
    int end = more == 0 ? cli_text_end(&left) : -1;
    if (end < 0) {
        fprintf(stderr, "lrcs: %s: is damaged: %s\n", path, left.fault);
    } else if (end == 0) {
        fprintf(stderr,
                "lrcs: %s: ends without its checksum: was its sweep stopped? --resume goes on with "
                "it\n",
                path);
    }
    return end == 1 ? 0 : CLI_FAILED;
}
