/* SPDX-License-Identifier: MIT */
/* Reads a whole sweep back from its file, to draw or summarize it without computing. The first
   lines state what varied, and the plan of the rows is made again from them; the rows are checked
   as --resume and merge check them. Shards and incomplete files are refused. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>
#include <string.h>

/* ---- the first lines as keys and texts ---- */

/* Adds a key; the texts of a repeated option are joined as head.c has written them. The hash has
   its own field; keys that the text already has are left out. */
static int word_put(sweep_data *data, const char *key, const char *text)
{
    static const char *const known[] = {"lrcs", "version", "rows", "shape"};
    sweep_head *head = &data->head;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(key, known[i]) == 0) {
            return 0;
        }
    }
    if (strcmp(key, "scene_hash") == 0) {
        head->scene_hash = strtoull(text, NULL, 16);
        return 0;
    }
    if (head->options == sizeof head->option / sizeof head->option[0] ||
        strlen(text) >= sizeof head->option[0].text) {
        return -1;
    }
    head->option[head->options].key = key;
    snprintf(head->option[head->options++].text, sizeof head->option[0].text, "%s", text);
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

/* "# lrcs VERSION sweep; key=text; ..", and the line of names. */
static int csv_words(sweep_data *data, char *line)
{
    char *names = strchr(line, '\n');
    *names++ = '\0';
    names[strcspn(names, "\n")] = '\0';
    for (char *at = cli_key_next(line); at;) {
        char *key = at + 2;
        char *text = strchr(key, '=');
        at = cli_key_next(text);
        if (at) {
            *at = '\0';
        }
        *text++ = '\0';
        if (word_put(data, key, text) != 0) {
            return -1;
        }
    }
    const char *name;
    char *next = csv_name(names, &name); /* the index */
    for (uint32_t i = 0; i < data->text.columns && next; i++) {
        next = csv_name(next, &data->column[i]);
    }
    return next ? 0 : -1;
}

/* {"key": "text", "key": number, "key": [..], ..}. */
static int json_words(sweep_data *data, char *line)
{
    uint32_t columns = 0;
    for (char *at = strchr(line, '"'); at;) {
        const char *key = at + 1;
        at = cli_json_unquote(at + 1);
        at += strspn(at, ": ");
        if (*at == '"') {
            const char *text = at + 1;
            at = cli_json_unquote(at + 1);
            if (word_put(data, key, text) != 0) {
                return -1;
            }
        } else if (strcmp(key, "columns") == 0) {
            for (at++; *at == '"' && columns < data->text.columns; at += strspn(at, ", ")) {
                data->column[columns++] = at + 1;
                at = cli_json_unquote(at + 1);
            }
        }
        at = strchr(at, '"');
    }
    return columns == data->text.columns ? 0 : -1;
}

const char *cli_head_text(const sweep_head *head, const char *key)
{
    for (uint32_t i = 0; i < head->options; i++) {
        if (strcmp(head->option[i].key, key) == 0) {
            return head->option[i].text;
        }
    }
    return NULL;
}

/* ---- the options that vary, as they were given ---- */

static void given_put(sweep_data *data, const char *name, const char *value)
{
    if (data->args.given_count < (int)(sizeof data->given / sizeof data->given[0])) {
        data->given[data->args.given_count++] = (cli_given){name, value};
    }
}

/* The options --joint and --vary, in the order of their columns. Texts of one option are joined by
   " and ", which a name may also contain: the text that follows decides where each ends. */
static void scene_given(sweep_data *data)
{
    static const char *const name[2] = {"joint", "vary"};
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
}

/* The options that define the plan. Those of a file of poses are not among them, because its rows
   are the poses. */
static void plan_given(sweep_data *data)
{
    static const char *const pose[] = {"az",        "el",   "rotate", "sphere",
                                       "direction", "azel", "euler",  "quaternion"};
    scene_given(data);
    for (uint32_t i = 0; i < data->head.options; i++) {
        for (size_t k = 0; k < sizeof pose / sizeof pose[0]; k++) {
            if (strcmp(data->head.option[i].key, pose[k]) == 0) {
                given_put(data, pose[k], data->head.option[i].text);
            }
        }
    }
}

/* ---- the rows ---- */

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

static int data_refuse(const sweep_data *data, const char *what)
{
    fprintf(stderr, "lrcs: %s: %s\n", data->path, what);
    return CLI_FAILED;
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
                : data_refuse(data, "its first lines do not tell what varies in its rows: was it "
                                    "written by another version of lrcs?");
}

/* Reads all rows of CSV or JSON lines, from the first to the checksum. */
static int text_read(sweep_data *data)
{
    uint64_t first;
    uint64_t rows;
    const sweep_plan *plan = data->plan.track.row ? NULL : &data->plan;
    int code = cli_text_rows(data->path, &data->text, plan, data_take, data, &first, &rows);
    if (code == 0 && rows != data->text.rows) {
        fprintf(stderr, "lrcs: %s: holds %llu of %llu rows: lrcs merge makes shards whole\n",
                data->path, (unsigned long long)rows, (unsigned long long)data->text.rows);
        return CLI_FAILED;
    }
    return code;
}

static int map_read(sweep_data *data)
{
    if (data->plan.track.row) {
        return data_refuse(data, "a .npy holds no times: give the .csv or .jsonl of these poses");
    }
    for (uint64_t i = 0; i < data->text.rows; i++) {
        sweep_row row;
        cli_map_row(&data->map, i, &row);
        data_take(data, &row);
    }
    return 0;
}

/* Opens FILE: its text, or its map with the head. 0 or CLI_FAILED. */
static int data_open(sweep_data *data)
{
    lrcs_host_error error;
    if (cli_extension(data->path, ".npy")) {
        if (cli_map_open(data->path, &data->map) != 0) {
            return data_refuse(data, "expected a map of lrcs sweep with its FILE.npy.head, both as "
                                     "they were written");
        }
        data->text = data->map.text;
        return 0;
    }
    if (lrcs_host_file_read(data->path, &data->file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    if (cli_text_open((const char *)data->file.bytes, data->file.size, &data->text) != 0 ||
        data->text.rows > data->file.size) {
        return data_refuse(
            data, "expected what lrcs sweep writes (CSV, JSON lines, .npy), or a CSV file of "
                  "lrcs profile or lrcs converge");
    }
    return 0;
}

int cli_data_read(const char *path, const cli_command *command, sweep_data *data)
{
    memset(data, 0, sizeof *data);
    data->path = path;
    data->args.given = data->given;
    int code = data_open(data);
    if (code != 0) {
        return code;
    }
    data->words = malloc(data->text.head_size + 1);
    data->row = calloc(data->text.rows, sizeof *data->row);
    int banded = data->text.fields.materials && !cli_extension(data->path, ".npy");
    data->band = banded ? calloc(data->text.rows, sizeof *data->band) : NULL;
    if (!data->words || !data->row || (banded && !data->band)) {
        return cli_out_of_memory();
    }
    data->head.rows = data->text.rows;
    memcpy(data->words, data->text.head, data->text.head_size);
    data->words[data->text.head_size] = '\0';
    int fault = data->text.format == SWEEP_JSONL ? json_words(data, data->words)
                                                 : csv_words(data, data->words);
    if (fault) {
        return data_refuse(data, "expected what lrcs sweep writes: its first line is damaged");
    }
    code = data_plan(data, command);
    code = code ? code : data->map.value ? map_read(data) : text_read(data);
    return code;
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
