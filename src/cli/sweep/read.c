/* SPDX-License-Identifier: MIT */
/* Reads rows back, to continue, join, map, draw or summarize them. It accepts only what rows.c
   writes: every field of a row is checked, and a checksum is compared with the preceding bytes. A
   truncated last line is not a row. A whole sweep is read with the plan of its rows, which is made
   again from the first lines; for that, shards and incomplete files are refused. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_LINE  4096u                               /* longer than any row */
#define TEXT_NAMES (SWEEP_COLUMNS + SWEEP_FIELDS + 2u) /* with index and flags */

/* ---- the first lines ---- */

/* Adds a key and its text. Hash, rows and shape have their own fields; they precede everything that
   a user wrote. 0, or -1 if it is not valid. */
static int word_put(sweep_head *head, const char *key, const char *text)
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
            if (end == text || size == 0 || head->dimensions == SWEEP_AXES + 1 ||
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
    if (at == SWEEP_OPTIONS || strlen(text) >= sizeof head->option[0].text) {
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
static uint32_t csv_words(char *line, sweep_head *head, const char *name[TEXT_NAMES])
{
    uint32_t names = 0;
    char *next = strchr(line, '\n');
    *next++ = '\0';
    next[strcspn(next, "\n")] = '\0';
    for (char *at = cli_key_next(line); at;) {
        char *key = at + 2;
        char *text = strchr(key, '=');
        at = cli_key_next(text);
        if (at) {
            *at = '\0';
        }
        *text++ = '\0';
        if (word_put(head, key, text) != 0) {
            return 0;
        }
    }
    while (next && names < TEXT_NAMES) {
        next = csv_name(next, &name[names++]);
    }
    return next ? 0 : names;
}

/* {"key": "text", "key": number, "key": [..], ..}, likewise; the names are those of the list
   "columns". */
static uint32_t json_words(char *line, sweep_head *head, const char *name[TEXT_NAMES])
{
    uint32_t names = 0;
    for (char *at = strchr(line, '"'); at; at = strchr(at, '"')) {
        const char *key = at + 1;
        at = cli_json_unquote(at + 1);
        at += strspn(at, ": ");
        int quoted = *at == '"';
        int list = *at == '[';
        if (strcmp(key, "columns") == 0 && list) {
            for (at++; *at == '"' && names < TEXT_NAMES; at += strspn(at, ", ")) {
                name[names++] = at + 1;
                at = cli_json_unquote(at + 1);
            }
            continue;
        }
        const char *text = at + (quoted || list);
        at = quoted ? cli_json_unquote(at + 1) : at;
        if (word_put(head, key, text) != 0) {
            return 0;
        }
    }
    return names;
}

/* Reads the words of the first lines; keys and names of columns are texts in `words`, a copy that
   the caller frees. 0, or -1. */
static int head_read(sweep_text *text, char **words, sweep_head *head,
                     const char *column[SWEEP_COLUMNS])
{
    const char *name[TEXT_NAMES];
    memset(head, 0, sizeof *head);
    *words = strndup(text->head, text->head_size);
    if (!*words) {
        return -1;
    }
    int csv = text->format == SWEEP_CSV;
    uint32_t names = csv ? csv_words(*words, head, name) : json_words(*words, head, name);
    const char *sphere = cli_head_text(head, "sphere");
    text->fields = cli_fields_make(cli_head_text(head, SWEEP_UNCERTAINTY) != NULL,
                                   cli_head_text(head, SWEEP_COARSE_GLINT) != NULL);
    text->rows = head->rows;
    text->dimensions = head->dimensions;
    memcpy(text->shape, head->shape, sizeof text->shape);
    text->has_mean = sphere && strtoull(sphere, NULL, 10) == text->rows;
    text->flagged = cli_head_text(head, "accept") != NULL;
    uint32_t others = csv ? 2 + text->fields.count : 0; /* index, fields and flags */
    text->columns = names > others ? names - others : 0;
    if (text->rows == 0 || text->dimensions == 0 || text->columns == 0 ||
        text->columns > SWEEP_COLUMNS) {
        return -1;
    }
    memcpy(column, name + csv, text->columns * sizeof *column);
    return 0;
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
    sweep_head head;
    const char *column[SWEEP_COLUMNS];
    char *words;
    int fault = head_read(text, &words, &head, column);
    free(words);
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

/* Splits {"key": value, ..., "flags": [..]} into index, values and fields, in place. Returns their
   number; fields beyond `room` are only counted; 0 if the line does not have this form. The keys of
   fields must be the known ones; those of values are the names that the user chose, in the order of
   the head. */
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

/* Reads the fields: numbers of at least 0 (dBsm may be negative, or none), of which yes or no is 1
   or 0. */
static int numbers_read(sweep_text *text, const char *const *field, sweep_row *row)
{
    for (uint32_t i = 0; i < text->fields.count; i++) {
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

/* Reads the fields and checks that they fit together. dBsm is that of sigma; glint and diffuse are
   separate sums and are rounded. To first order the interval of the material uncertainty ends one
   deviation below sigma, but not below 0, and one above. The error of a glint is at most that
   glint. */
static int fields_read(sweep_text *text, const char *const *field, sweep_row *row)
{
    memset(row->field, 0, sizeof row->field);
    if (numbers_read(text, field, row) != 0) {
        return -1;
    }
    const double *f = row->field;
    char dbsm_text[LRCS_HOST_NUMBER_SIZE + 16];
    double sigma = f[FIELD_SIGMA];
    double dbsm = sigma > 0.0 ? cli_dbsm(sigma) : (double)NAN;
    double end[2] = {fmax(0.0, sigma - f[FIELD_DEVIATION]), sigma + f[FIELD_DEVIATION]};
    int sampled = !text->fields.materials || f[FIELD_SAMPLED] != 0.0;
    lrcs_host_number_text(dbsm, dbsm_text);
    const struct {
        int good, field;
        const char *expected;
    } rule[] = {
        {sigma > 0.0 ? fabs(f[FIELD_DBSM] - dbsm) <= 1e-12 * (1.0 + fabs(dbsm))
                     : isnan(f[FIELD_DBSM]),
         FIELD_DBSM, sigma > 0.0 ? dbsm_text : "none, for a sigma of 0"},
        {about_equal(f[FIELD_GLINT] + f[FIELD_DIFFUSE], sigma, 1e-9), FIELD_GLINT,
         "what adds up to sigma_m2"},
        {sampled || (f[FIELD_LOW] <= f[FIELD_HIGH] && fabs(f[FIELD_LOW] - end[0]) <= 1e-9 * end[1]),
         FIELD_LOW, "sigma less a deviation"},
        {f[FIELD_LOW] <= f[FIELD_HIGH], FIELD_LOW, "at most material_high_m2"},
        {sampled || about_equal(f[FIELD_HIGH], end[1], 1e-9), FIELD_HIGH, "sigma and a deviation"},
        {f[FIELD_GLINT_ERROR] <= (1.0 + 1e-9) * f[FIELD_GLINT], FIELD_GLINT_ERROR,
         "at most sigma_glint_m2"}};
    for (size_t k = 0; k < sizeof rule / sizeof rule[0]; k++) {
        for (uint32_t i = 0; i < text->fields.count && !rule[k].good; i++) {
            if (text->fields.kind[i] == rule[k].field) {
                return text_refuse(text,
                                   rule[k].field == FIELD_GLINT
                                       ? "sigma_glint_m2 and sigma_diffuse_m2"
                                       : cli_field_name[rule[k].field],
                                   field[i], rule[k].expected);
            }
        }
    }
    const char *flags = field[text->fields.count];
    return flags_read(flags, &row->flags) == 0
               ? 0
               : text_refuse(text, "flags", flags, "names of flags");
}

/* Reads a row from a copy of a complete line. */
static int row_read(sweep_text *text, const sweep_plan *plan, char *line, sweep_row *row)
{
    const char *field[TEXT_NAMES];
    for (size_t i = 0; i < TEXT_NAMES; i++) {
        field[i] = "";
    }
    const uint32_t room = 2 + text->columns + text->fields.count; /* with index and flags */
    char begun[41];
    snprintf(begun, sizeof begun, "%.40s", line);
    uint32_t count = 0;
    if (text->format == SWEEP_JSONL) {
        count = jsonl_split(line, field, room, text->columns, &text->fields);
    }
    for (char *at = text->format == SWEEP_CSV ? line : NULL; at; count++) {
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
            return cli_fail("%s: its rows are not in order", path);
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
/* ---- the options that vary, as they were given ---- */

static void given_put(sweep_data *data, const char *name, const char *value)
{
    if (data->args.given_count < (int)(sizeof data->given / sizeof data->given[0])) {
        data->given[data->args.given_count++] = (cli_given){name, value};
    }
}

/* The options that define the plan, --joint and --vary first, in the order of their columns. Texts
   of one option are joined by " and ", which a name may also contain: the text that follows decides
   where each ends. Options of a file of poses are not among them, because its rows are the
   poses. */
static void plan_given(sweep_data *data)
{
    static const char *const name[2] = {"joint", "vary"};
    static const char *const pose[] = {"az",        "el",   "rotate", "sphere",
                                       "direction", "azel", "euler",  "quaternion"};
    for (uint32_t i = 0; i < data->text.columns; i++) {
        char begin[160];
        for (int k = 0; k < 2; k++) {
            const char *text = cli_head_text(&data->head, name[k]);
            size_t size = strlen(data->column[i]);
            size_t tail = k == 0 ? strlen(".joint_deg") : 0;
            if (!text || size <= tail || size - tail >= sizeof begin - 2 ||
                (k == 0 && strcmp(data->column[i] + size - tail, ".joint_deg") != 0)) {
                continue;
            }
            int length =
                snprintf(begin, sizeof begin, "%.*s:", (int)(size - tail), data->column[i]);
            const char *at = strstr(text, begin);
            while (at && at != text && (at - text < 5 || strncmp(at - 5, " and ", 5) != 0)) {
                at = strstr(at + 1, begin);
            }
            if (at) {
                size_t end = (size_t)length + strcspn(at + length, " ");
                char *copy = data->scene_text[i];
                snprintf(copy, sizeof data->scene_text[i], "%.*s", (int)end, at);
                given_put(data, name[k], copy);
                break;
            }
        }
    }
    for (uint32_t i = 0; i < data->head.options; i++) {
        for (size_t k = 0; k < sizeof pose / sizeof pose[0]; k++) {
            if (strcmp(data->head.option[i].key, pose[k]) == 0) {
                given_put(data, pose[k], data->head.option[i].text);
            }
        }
    }
}

/* ---- a whole sweep ---- */

static void data_take(void *context, const sweep_row *row)
{
    sweep_data *data = context;
    if (row->index >= data->text.rows) {
        return;
    }
    cli_tally_add(&data->tally, row);
    data->row[row->index][0] = row->field[FIELD_SIGMA];
    data->row[row->index][1] = row->field[FIELD_BOUND];
    if (data->band) {
        data->band[row->index][0] = row->field[FIELD_LOW];
        data->band[row->index][1] = row->field[FIELD_HIGH];
    }
    uint64_t poses = data->plan.track.row ? data->plan.track.count : 0;
    for (int k = 0; k < 4 && row->index < poses; k++) {
        data->plan.track.row[row->index][k] = row->value[data->text.columns - 4 + (uint32_t)k];
    }
    for (uint32_t k = 0; k < data->plan.track.joints && row->index < poses; k++) {
        data->plan.track.joint[row->index][k] = row->value[data->plan.axes + k];
    }
}

/* Makes the plan from the first lines; the rows of a file of poses are filled in later. */
static int data_plan(sweep_data *data, const cli_command *command)
{
    sweep_track track = {.row = NULL};
    const char *epoch = cli_head_text(&data->head, "time_from");
    int poses = cli_head_text(&data->head, "poses") != NULL;
    plan_given(data);
    if (poses) {
        track.count = data->text.shape[data->text.dimensions - 1];
        track.row = data->text.columns >= 4 ? calloc(track.count, sizeof *track.row) : NULL;
        track.joint = calloc(track.count, sizeof *track.joint);
        snprintf(track.epoch, sizeof track.epoch, "%s", epoch ? epoch : "");
        for (uint32_t i = 0; i < data->text.columns && track.joints < SWEEP_JOINTS; i++) {
            if (strncmp(data->column[i], SWEEP_JOINT, strlen(SWEEP_JOINT)) == 0) {
                snprintf(track.joint_name[track.joints++], sizeof track.joint_name[0], "%s",
                         data->column[i]);
            }
        }
        if (!track.row || !track.joint) {
            free(track.row);
            free(track.joint);
            return cli_out_of_memory();
        }
    }
    data->args.command = command;
    int code = cli_plan_read(&data->args, poses ? &track : NULL, &data->plan);
    if (!data->plan.track.row) {
        free(track.row);
        free(track.joint);
    }
    int same =
        code == 0 && data->plan.rows == data->text.rows && data->plan.columns == data->text.columns;
    for (uint32_t i = 0; same && i < data->plan.columns; i++) {
        same = strcmp(data->plan.column[i], data->column[i]) == 0;
    }
    return same ? 0
                : cli_fail("%s: its first lines do not tell what varies in its rows: was it "
                           "written by another version of lrcs?",
                           data->path);
}

int cli_data_read(const char *path, const cli_command *command, sweep_data *data)
{
    lrcs_host_error error;
    int npy = cli_extension(path, ".npy");
    uint64_t first;
    uint64_t rows;
    memset(data, 0, sizeof *data);
    data->path = path;
    data->args.given = data->given;
    /* 1. FILE: its text, or its map with the head. */
    if (npy) {
        if (cli_map_open(path, &data->map) != 0) {
            return cli_fail("%s: expected a map of lrcs sweep with its FILE.npy.head, both as "
                            "they were written",
                            path);
        }
        data->text = data->map.text;
    } else if (lrcs_host_file_read(path, &data->file, &error) != LRCS_OK) {
        return cli_failed(&error);
    } else if (cli_text_open((const char *)data->file.bytes, data->file.size, &data->text) != 0 ||
               data->text.rows > data->file.size) {
        return cli_fail("%s: expected what lrcs sweep writes (CSV, JSON lines, .npy), or a CSV "
                        "file of lrcs profile or lrcs converge",
                        path);
    }
    /* 2. The plan, from the first lines. */
    int banded = data->text.fields.materials && !npy;
    data->row = calloc(data->text.rows + 1, sizeof *data->row);
    data->band = banded ? calloc(data->text.rows + 1, sizeof *data->band) : NULL;
    if (!data->row || (banded && !data->band) ||
        head_read(&data->text, &data->words, &data->head, data->column) != 0) {
        return cli_out_of_memory();
    }
    int code = data_plan(data, command);
    int track = data->plan.track.row != NULL;
    /* 3. All rows: of the map, or from the first one to the checksum. */
    if (code == 0 && npy && track) {
        return cli_fail("%s: a .npy holds no times: give the .csv or .jsonl of these poses", path);
    }
    for (uint64_t i = 0; code == 0 && npy && i < data->text.rows; i++) {
        sweep_row row;
        cli_map_row(&data->map, i, &row);
        data_take(data, &row);
    }
    if (code != 0 || npy) {
        return code;
    }
    code = cli_text_rows(path, &data->text, track ? NULL : &data->plan, data_take, data, &first,
                         &rows);
    return code != 0 || rows == data->text.rows
               ? code
               : cli_fail("%s: holds %llu of %llu rows: lrcs merge makes shards whole", path,
                          (unsigned long long)rows, (unsigned long long)data->text.rows);
}

void cli_data_free(sweep_data *data)
{
    cli_plan_free(&data->plan);
    cli_map_close(&data->map);
    lrcs_host_file_free(&data->file);
    free(data->words);
    free(data->row);
    free(data->band);
}
