/* SPDX-License-Identifier: MIT */
/* An attitude time series from CSV: a time and a quaternion or a direction in every row. It decides
   which column is which, by the names in the first line or by their number; what a pose is made of
   them is the plan's. */
#include "cli/sweep.h"

#include <stdlib.h>
#include <string.h>

#define TRACK_FIELDS 32

/* What a column is: index into a track's row, by its name. */
typedef struct track_name {
    const char *name;
    int place, quaternion;
} track_name;

static const track_name track_names[] = {
    {"time", 0, -1}, {"time_s", 0, -1}, {"t", 0, -1}, {"w", 1, 1}, {"qw", 1, 1}, {"qx", 2, 1},
    {"qy", 3, 1},    {"qz", 4, 1},      {"x", 1, 0},  {"y", 2, 0}, {"z", 3, 0}};

typedef struct track_reader {
    const cli_command *command;
    const char *path;
    uint64_t line;
    int place[TRACK_FIELDS]; /* of each column; -1: not looked at */
    int fields;              /* 0: not known yet */
} track_reader;

typedef struct track_field {
    const char *text;
    size_t size;
} track_field;

/* Fields between commas, blanks around them dropped; -1 for too many. */
static int fields_split(const char *text, size_t size, track_field *field)
{
    const char *end = text + size;
    int count = 0;
    while (count < TRACK_FIELDS) {
        const char *comma = memchr(text, ',', (size_t)(end - text));
        const char *stop = comma ? comma : end;
        const char *last = stop;
        while (text < last && *text == ' ') {
            text++;
        }
        while (last > text && (last[-1] == ' ' || last[-1] == '\r')) {
            last--;
        }
        field[count++] = (track_field){text, (size_t)(last - text)};
        if (!comma) {
            return count;
        }
        text = comma + 1;
    }
    return -1;
}

static int track_fault(const track_reader *reader, const char *what)
{
    fprintf(stderr, "lrcs: %s: line %llu: %s\n", reader->path, (unsigned long long)reader->line,
            what);
    return CLI_FAILED;
}

static const track_name *name_find(const track_field *field)
{
    for (size_t i = 0; i < sizeof track_names / sizeof track_names[0]; i++) {
        if (strlen(track_names[i].name) == field->size &&
            memcmp(track_names[i].name, field->text, field->size) == 0) {
            return &track_names[i];
        }
    }
    return NULL;
}

/* The first line's names. x, y, z are a direction's, but a quaternion's beside a w. */
static int header_read(track_reader *reader, const track_field *field, int count,
                       sweep_track *track)
{
    int seen[5] = {0};
    for (int i = 0; i < count; i++) {
        const track_name *name = name_find(&field[i]);
        track->quaternions |= name && name->quaternion == 1;
    }
    for (int i = 0; i < count; i++) {
        const track_name *name = name_find(&field[i]);
        int shift = name && name->quaternion == 0 && track->quaternions;
        reader->place[i] = name ? name->place + shift : -1;
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
    reader->fields = count;
    return 0;
}

/* Without names: four columns are time and direction, five time and quaternion. */
static int columns_assume(track_reader *reader, int count, sweep_track *track)
{
    if (count != 4 && count != 5) {
        return track_fault(reader, "expected time,w,x,y,z (quaternion, body to observation) or "
                                   "time,x,y,z (direction to the laser)");
    }
    track->quaternions = count == 5;
    for (int i = 0; i < count; i++) {
        reader->place[i] = i;
    }
    reader->fields = count;
    return 0;
}

static int row_read(const track_reader *reader, const track_field *field, int count,
                    sweep_track *track)
{
    double *row = track->row[track->count];
    lrcs_pose pose;
    if (count != reader->fields) {
        return track_fault(reader, "not as many fields as above");
    }
    memset(row, 0, sizeof track->row[0]);
    for (int i = 0; i < count; i++) {
        if (reader->place[i] >= 0 && lrcs_host_number_read(field[i].text, field[i].size,
                                                           &row[reader->place[i]]) != LRCS_OK) {
            return track_fault(reader, "expected finite numbers");
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

static int line_read(track_reader *reader, const char *text, size_t size, sweep_track *track)
{
    track_field field[TRACK_FIELDS];
    double number;
    int count = fields_split(text, size, field);
    if (count < 0) {
        return track_fault(reader, "more than 32 fields");
    }
    if ((count == 1 && field[0].size == 0) || (field[0].size > 0 && *field[0].text == '#')) {
        return 0;
    }
    if (reader->fields == 0 &&
        lrcs_host_number_read(field[0].text, field[0].size, &number) == LRCS_E_SYNTAX) {
        return header_read(reader, field, count, track);
    }
    int code = reader->fields == 0 ? columns_assume(reader, count, track) : 0;
    return code ? code : row_read(reader, field, count, track);
}

static uint64_t bytes_hash(const unsigned char *bytes, size_t size)
{
    uint64_t hash = 0xcbf29ce484222325u; /* FNV-1a, as scene hashes */
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    }
    return hash;
}

static int track_parse(track_reader *reader, const lrcs_host_file *file, sweep_track *track)
{
    const char *at = (const char *)file->bytes;
    const char *end = at + file->size;
    size_t lines = 1;
    for (size_t i = 0; i < file->size; i++) {
        lines += at[i] == '\n';
    }
    track->row = calloc(lines, sizeof *track->row);
    if (!track->row) {
        return cli_out_of_memory();
    }
    int code = 0;
    while (at < end && code == 0) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        const char *stop = newline ? newline : end;
        reader->line++;
        code = line_read(reader, at, (size_t)(stop - at), track);
        at = stop + (newline != NULL);
    }
    return code == 0 && track->count == 0 ? track_fault(reader, "no attitude in the file") : code;
}

int cli_track_read(const cli_command *command, const char *path, sweep_track *track)
{
    lrcs_host_error error;
    lrcs_host_file file;
    track_reader reader = {.command = command, .path = path};
    if (lrcs_host_file_read(path, &file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    track->hash = bytes_hash(file.bytes, file.size);
    int code = track_parse(&reader, &file, track);
    lrcs_host_file_free(&file);
    return code;
}
