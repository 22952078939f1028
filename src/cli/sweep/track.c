/* SPDX-License-Identifier: MIT */
/* An attitude time series from CSV: a time and a quaternion or a direction in every row. It decides
   which column is which, by the names in the first line or by their number; what a pose is made of
   them is the plan's. */
#include "cli/sweep/sweep.h"

#include <lrcs/table.h>

#include <stdlib.h>
#include <string.h>

/* What a column is: index into a track's row, by its name. */
typedef struct track_name {
    const char *name;
    int place, quaternion;
} track_name;

static const track_name track_names[] = {
    {"time", 0, -1}, {"time_s", 0, -1}, {"t", 0, -1}, {"w", 1, 1}, {"qw", 1, 1}, {"qx", 2, 1},
    {"qy", 3, 1},    {"qz", 4, 1},      {"x", 1, 0},  {"y", 2, 0}, {"z", 3, 0}};

typedef struct track_reader {
    lrcs_host_table table;
    lrcs_host_error error;
    int place[LRCS_HOST_FIELDS]; /* of each column; -1: not looked at */
} track_reader;

static int track_fault(const track_reader *reader, const char *what)
{
    fprintf(stderr, "lrcs: %s: line %llu: %s\n", reader->table.path,
            (unsigned long long)reader->table.line, what);
    return CLI_FAILED;
}

static const track_name *name_find(const lrcs_host_field *field)
{
    for (size_t i = 0; i < sizeof track_names / sizeof track_names[0]; i++) {
        if (lrcs_host_field_is(field, track_names[i].name)) {
            return &track_names[i];
        }
    }
    return NULL;
}

/* The first line's names. x, y, z are a direction's, but a quaternion's beside a w. */
static int names_read(track_reader *reader, sweep_track *track)
{
    const lrcs_host_table *table = &reader->table;
    int seen[5] = {0};
    lrcs_host_table_names(&reader->table);
    for (uint32_t i = 0; i < table->columns; i++) {
        const track_name *name = name_find(&table->field[i]);
        track->quaternions |= name && name->quaternion == 1;
    }
    for (uint32_t i = 0; i < table->columns; i++) {
        const track_name *name = name_find(&table->field[i]);
        int shift = name && name->quaternion == 0 && track->quaternions;
        reader->place[i] = name ? name->place + shift : -1;
        if (!name) {
            fprintf(stderr, "notice: %s: column '%.*s' is not used\n", table->path,
                    (int)table->field[i].size, table->field[i].text);
        }
        if (name && seen[reader->place[i]]++) {
            return track_fault(reader, "two columns are the same");
        }
    }
    for (int k = 0; k < 4 + track->quaternions; k++) {
        if (!seen[k]) {
            return track_fault(reader, "expected columns time,w,x,y,z (quaternion, body to "
                                       "observation) or time,x,y,z (direction to the laser)");
        }
    }
    return 0;
}

/* Without names: four columns are time and direction, five time and quaternion. */
static int columns_assume(track_reader *reader, sweep_track *track)
{
    uint32_t count = reader->table.columns;
    if (count != 4 && count != 5) {
        return track_fault(reader, "expected time,w,x,y,z (quaternion, body to observation) or "
                                   "time,x,y,z (direction to the laser)");
    }
    track->quaternions = count == 5;
    for (int i = 0; i < (int)count; i++) {
        reader->place[i] = i;
    }
    return 0;
}

static int row_read(track_reader *reader, sweep_track *track)
{
    double *row = track->row[track->count];
    lrcs_pose pose;
    memset(row, 0, sizeof track->row[0]);
    for (uint32_t i = 0; i < reader->table.columns; i++) {
        if (reader->place[i] >= 0 &&
            lrcs_host_field_read(&reader->table, i, "a finite number", &row[reader->place[i]],
                                 &reader->error) != LRCS_OK) {
            return cli_failed(&reader->error);
        }
    }
    int status = track->quaternions ? lrcs_pose_from_quaternion(row + 1, &pose)
                                    : lrcs_pose_from_direction(row + 1, &pose);
    if (status != LRCS_OK) {
        return track_fault(reader, "expected a quaternion or direction that is not zero");
    }
    track->count++;
    return 0;
}

/* The first row: names, or what tells by its number of fields. */
static int first_read(track_reader *reader, sweep_track *track)
{
    const lrcs_host_field *field = reader->table.field;
    double number;
    if (lrcs_host_number_read(field->text, field->size, &number) == LRCS_E_SYNTAX) {
        return names_read(reader, track);
    }
    int code = columns_assume(reader, track);
    return code ? code : row_read(reader, track);
}

static int track_parse(track_reader *reader, const lrcs_host_file *file, sweep_track *track)
{
    size_t lines = 1;
    for (size_t i = 0; i < file->size; i++) {
        lines += file->bytes[i] == '\n' || file->bytes[i] == '\r';
    }
    track->row = calloc(lines, sizeof *track->row);
    if (!track->row) {
        return cli_out_of_memory();
    }
    int code = 0;
    int status = lrcs_host_table_read(&reader->table, &reader->error);
    for (int first = 1; status == 1 && code == 0; first = 0) {
        code = first ? first_read(reader, track) : row_read(reader, track);
        status = lrcs_host_table_read(&reader->table, &reader->error);
    }
    if (code == 0 && status < 0) {
        return cli_failed(&reader->error);
    }
    return code == 0 && track->count == 0 ? track_fault(reader, "no attitude in the file") : code;
}

int cli_track_read(const char *path, sweep_track *track)
{
    lrcs_host_error error;
    lrcs_host_file file;
    track_reader reader;
    if (lrcs_host_file_read(path, &file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    track->hash = cli_sum_more(SWEEP_SUM_BEGIN, file.bytes, file.size);
    reader.table = lrcs_host_table_make(path, &file);
    int code = track_parse(&reader, &file, track);
    lrcs_host_file_free(&file);
    return code;
}
