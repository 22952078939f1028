/* SPDX-License-Identifier: MIT */
/* A whole sweep from its file, with the plan of its rows, which is made again from the first lines;
   for that, parts of sweeps and incomplete files are refused. */
#include <lrcs/sweep_file.h>

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "host/fail.h"
#include "host/sweep/read.h"

/* ---- what varies, as it was given ---- */

#define DATA_TEXTS (LRCS_HOST_PLAN_COLUMNS + LRCS_HOST_HEAD_OPTIONS)

typedef struct data_texts {
    lrcs_host_plan_text given[DATA_TEXTS];
    int count;
    char scene[LRCS_HOST_PLAN_COLUMNS][320]; /* those that change the scene, by column */
} data_texts;

/* The texts that define the plan, `joint` and `vary` first, in the order of their columns. Texts of
   one key are joined by " and ", which a name may also contain: the text that follows decides where
   each ends. Those of a track are not among them, because its rows are the poses. */
static void texts_take(const lrcs_host_rows_head *head, const char *const *column, uint32_t columns,
                       data_texts *texts)
{
    static const char *const name[2] = {"joint", "vary"};
    texts->count = 0;
    for (uint32_t i = 0; i < columns; i++) {
        char begin[160];
        for (int k = 0; k < 2; k++) {
            const char *text = lrcs_host_rows_head_text(head, name[k]);
            size_t size = strlen(column[i]);
            size_t tail = k == 0 ? strlen(".joint_deg") : 0;
            if (!text || size <= tail || size - tail >= sizeof begin - 2 ||
                (k == 0 && strcmp(column[i] + size - tail, ".joint_deg") != 0)) {
                continue;
            }
            int length = snprintf(begin, sizeof begin, "%.*s:", (int)(size - tail), column[i]);
            const char *at = strstr(text, begin);
            while (at && at != text && (at - text < 5 || strncmp(at - 5, " and ", 5) != 0)) {
                at = strstr(at + 1, begin);
            }
            if (at) {
                size_t end = (size_t)length + strcspn(at + length, " ");
                snprintf(texts->scene[i], sizeof texts->scene[i], "%.*s", (int)end, at);
                texts->given[texts->count++] = (lrcs_host_plan_text){name[k], texts->scene[i]};
                break;
            }
        }
    }
    for (uint32_t i = 0; i < head->options; i++) {
        const char *key = head->option[i].key;
        if (lrcs_host_plan_takes(key) && strcmp(key, name[0]) != 0 && strcmp(key, name[1]) != 0) {
            texts->given[texts->count++] = (lrcs_host_plan_text){key, head->option[i].text};
        }
    }
}

/* ---- the plan ---- */

/* Makes the plan from the first lines; the rows of a track are filled in later. */
static int data_plan(const char *path, const lrcs_host_rows *rows, const char *const *column,
                     lrcs_host_sweep_data *data, lrcs_host_error *error)
{
    data_texts texts;
    lrcs_host_track track = {.row = NULL};
    const char *epoch = lrcs_host_rows_head_text(&data->head, "time_from");
    int poses = lrcs_host_rows_head_text(&data->head, "poses") != NULL;
    texts_take(&data->head, column, rows->columns, &texts);
    if (poses) {
        track.count = rows->shape[rows->dimensions - 1];
        track.row = rows->columns >= 4 ? calloc(track.count, sizeof *track.row) : NULL;
        track.joint = calloc(track.count, sizeof *track.joint);
        snprintf(track.epoch, sizeof track.epoch, "%s", epoch ? epoch : "");
        for (uint32_t i = 0; i < rows->columns && track.joints < LRCS_HOST_TRACK_JOINTS; i++) {
            if (strncmp(column[i], LRCS_HOST_TRACK_JOINT_TEXT,
                        strlen(LRCS_HOST_TRACK_JOINT_TEXT)) == 0) {
                snprintf(track.joint_name[track.joints++], sizeof track.joint_name[0], "%s",
                         column[i]);
            }
        }
        if (!track.row || !track.joint) {
            lrcs_host_track_free(&track);
            return lrcsi_host_out_of_memory(error);
        }
    }
    int status =
        lrcs_host_plan_make(texts.given, texts.count, poses ? &track : NULL, &data->plan, error);
    if (!data->plan.track.row) {
        lrcs_host_track_free(&track);
    }
    if (status != LRCS_OK) {
        return status;
    }
    int same = data->plan.rows == rows->rows && data->plan.columns == rows->columns;
    for (uint32_t i = 0; same && i < data->plan.columns; i++) {
        same = strcmp(data->plan.column[i], column[i]) == 0;
    }
    return same ? LRCS_OK
                : lrcsi_host_fail(
                      error, LRCS_E_SYNTAX,
                      "%s: its first lines do not state what varies from row to row: was "
                      "it written by another version of lrcs?",
                      path);
}

/* ---- the rows ---- */

static void data_row_take(void *context, const lrcs_host_row *row)
{
    lrcs_host_sweep_data *data = context;
    lrcs_host_plan *plan = &data->plan;
    if (row->index >= data->head.rows) {
        return;
    }
    lrcs_host_tally_add(&data->tally, row);
    data->row[row->index][0] = row->field[LRCS_HOST_ROW_SIGMA];
    data->row[row->index][1] = row->field[LRCS_HOST_ROW_BOUND];
    if (data->band) {
        data->band[row->index][0] = row->field[LRCS_HOST_ROW_LOW];
        data->band[row->index][1] = row->field[LRCS_HOST_ROW_HIGH];
    }
    uint64_t poses = plan->track.row ? plan->track.count : 0;
    for (int k = 0; k < 4 && row->index < poses; k++) {
        plan->track.row[row->index][k] = row->value[plan->columns - 4 + (uint32_t)k];
    }
    for (uint32_t k = 0; k < plan->track.joints && row->index < poses; k++) {
        plan->track.joint[row->index][k] = row->value[plan->axes + k];
    }
}

/* From opened rows: the plan, then the rows of a map, or of a text from the first one to the
   checksum. */
static int data_read(const char *path, lrcs_host_rows *rows, const lrcs_host_sweep_map *map,
                     lrcs_host_sweep_data *data, lrcs_host_error *error)
{
    const char *column[LRCS_HOST_PLAN_COLUMNS];
    uint64_t first, count;
    int banded = rows->fields.materials && !map;
    data->row = calloc(rows->rows + 1, sizeof *data->row);
    data->band = banded ? calloc(rows->rows + 1, sizeof *data->band) : NULL;
    if (!data->row || (banded && !data->band) ||
        lrcsi_rows_head_read(rows, &data->words, &data->head, column) != LRCS_OK) {
        return lrcsi_host_out_of_memory(error);
    }
    int status = data_plan(path, rows, column, data, error);
    if (status != LRCS_OK) {
        return status;
    }
    int track = data->plan.track.row != NULL;
    if (map && track) {
        return lrcsi_host_fail(error, LRCS_E_UNSUPPORTED,
                               "%s: a .npy holds no times: give the .csv or .jsonl of these poses",
                               path);
    }
    for (uint64_t i = 0; map && i < rows->rows; i++) {
        lrcs_host_row row;
        lrcs_host_sweep_map_row(map, i, &row);
        data_row_take(data, &row);
    }
    if (map) {
        return LRCS_OK;
    }
    status = lrcsi_rows_read(path, rows, track ? NULL : &data->plan, data_row_take, data, &first,
                             &count, error);
    return status != LRCS_OK || count == rows->rows
               ? status
               : lrcsi_host_fail(error, LRCS_E_INDEX,
                                 "%s: holds %llu of %llu rows: join the shards with lrcs merge",
                                 path, (unsigned long long)count, (unsigned long long)rows->rows);
}

int lrcs_host_sweep_read(const char *path, lrcs_host_sweep_data *data, lrcs_host_error *error)
{
    lrcs_host_sweep_map map;
    lrcs_host_file file;
    lrcs_host_rows rows;
    size_t size = strlen(path);
    int status;
    memset(data, 0, sizeof *data);
    if (size > 4 && strcasecmp(path + size - 4, ".npy") == 0) {
        status = lrcs_host_sweep_map_open(path, &map);
        status = status == LRCS_OK
                     ? data_read(path, &map.rows, &map, data, error)
                     : lrcsi_host_fail(error, status,
                                       "%s: expected a map of lrcs sweep with its FILE.npy.head, "
                                       "both as they were written",
                                       path);
        lrcs_host_sweep_map_close(&map);
        return status;
    }
    status = lrcs_host_file_read(path, &file, error);
    if (status != LRCS_OK) {
        return status;
    }
    if (lrcs_host_rows_open((const char *)file.bytes, file.size, &rows) != LRCS_OK ||
        rows.rows > file.size) {
        status = lrcsi_host_fail(error, LRCS_E_SYNTAX,
                                 "%s: expected what lrcs sweep writes (CSV, JSON lines, .npy), or "
                                 "a CSV file of lrcs profile or lrcs converge",
                                 path);
    } else {
        status = data_read(path, &rows, NULL, data, error);
    }
    lrcs_host_file_free(&file);
    return status;
}

void lrcs_host_sweep_data_free(lrcs_host_sweep_data *data)
{
    lrcs_host_plan_free(&data->plan);
    free(data->words);
    free(data->row);
    free(data->band);
}
