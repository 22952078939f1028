/* SPDX-License-Identifier: MIT */
/* Reads an attitude time series: each row has a time, a quaternion or a direction, and the angles
   of joints. This file decides which column is which, by the names in the first line or by their
   number; host/sweep/plan.c makes poses from them. */
#include <lrcs/table.h>
#include <lrcs/track.h>

#include <stdlib.h>
#include <string.h>

#include "host/fail.h"

/* The meaning of a column: an index into a track's row, by name. */
typedef struct track_name {
    const char *name;
    int place, quaternion;
} track_name;

static const track_name track_names[] = {
    {"time", 0, -1}, {"time_s", 0, -1}, {"t", 0, -1}, {"w", 1, 1}, {"qw", 1, 1}, {"qx", 2, 1},
    {"qy", 3, 1},    {"qz", 4, 1},      {"x", 1, 0},  {"y", 2, 0}, {"z", 3, 0}};

#define PLACE_JOINT 5 /* follows the places of the names above */

#define NOTICE_MOST 64u /* bytes of the name of a column in a notice */

#define TRACK_COLUMNS                                                                              \
    "time,w,x,y,z (quaternion, body to observation) or time,x,y,z (direction to the laser)"

typedef struct track_reader {
    lrcs_host_table table;
    lrcs_host_error *error;
    int place[LRCS_HOST_FIELDS]; /* by column; that of a joint from PLACE_JOINT on; -1 if the column
                                    is ignored */
    int dates;                   /* times are ISO 8601 */
    int64_t epoch;               /* the first time in whole seconds, and the fraction */
    double epoch_part;
} track_reader;

static int track_fault(const track_reader *reader, int status, const char *what)
{
    return lrcsi_host_fail(reader->error, status, "%s: line %llu: %s", reader->table.path,
                           (unsigned long long)reader->table.line, what);
}

static const track_name *track_name_find(const lrcs_host_field *field)
{
    for (size_t i = 0; i < sizeof track_names / sizeof track_names[0]; i++) {
        if (lrcs_host_field_is(field, track_names[i].name)) {
            return &track_names[i];
        }
    }
    return NULL;
}

/* A column "joint:PART". */
static int track_joint_read(track_reader *reader, lrcs_host_track *track, uint32_t column)
{
    const lrcs_host_field *field = &reader->table.field[column];
    const size_t begin = sizeof LRCS_HOST_TRACK_JOINT_TEXT - 1;
    if (track->joints >= LRCS_HOST_TRACK_JOINTS) {
        return track_fault(reader, LRCS_E_LIMIT, "at most 8 columns may turn joints");
    }
    if (field->size <= begin || field->size - begin >= 100) {
        return track_fault(reader, LRCS_E_NAME, "expected joint:PART with the name of a part");
    }
    char *name = track->joint_name[track->joints];
    snprintf(name, sizeof track->joint_name[0], "%s%.*s", LRCS_HOST_TRACK_JOINT_TEXT,
             (int)(field->size - begin), field->text + begin);
    for (uint32_t i = 0; i < track->joints; i++) {
        if (strcmp(track->joint_name[i], name) == 0) {
            return track_fault(reader, LRCS_E_NAME, "two columns are the same");
        }
    }
    reader->place[column] = PLACE_JOINT + (int)track->joints++;
    return LRCS_OK;
}

/* Reads the names in the first line. x, y, z are a direction's, or a quaternion's if there is a
   w. */
static int track_names_read(track_reader *reader, lrcs_host_track *track)
{
    const lrcs_host_table *table = &reader->table;
    int seen[PLACE_JOINT] = {0};
    lrcs_host_table_names(&reader->table);
    for (uint32_t i = 0; i < table->columns; i++) {
        const track_name *name = track_name_find(&table->field[i]);
        track->quaternions |= name && name->quaternion == 1;
    }
    for (uint32_t i = 0; i < table->columns; i++) {
        const track_name *name = track_name_find(&table->field[i]);
        int shift = name && name->quaternion == 0 && track->quaternions;
        reader->place[i] = name ? name->place + shift : -1;
        if (lrcs_host_field_begins(&table->field[i], LRCS_HOST_TRACK_JOINT_TEXT)) {
            int status = track_joint_read(reader, track, i);
            if (status != LRCS_OK) {
                return status;
            }
        }
        if (name && seen[reader->place[i]]++) {
            return track_fault(reader, LRCS_E_NAME, "two columns are the same");
        }
    }
    for (int k = 0; k < 4 + track->quaternions; k++) {
        if (!seen[k]) {
            return track_fault(reader, LRCS_E_NAME, "expected columns " TRACK_COLUMNS);
        }
    }
    for (uint32_t i = 0; i < table->columns; i++) {
        if (reader->place[i] < 0) {
            size_t size = table->field[i].size;
            lrcsi_host_note(&track->notices, "%s: column '%.*s' is not used", table->path,
                            (int)(size < NOTICE_MOST ? size : NOTICE_MOST), table->field[i].text);
        }
    }
    return LRCS_OK;
}

/* Reads digits as a number from `least` to `most`; -1 if they are not such a number. */
static int date_digits_read(const char *text, int count, int least, int most)
{
    int number = 0;
    for (int i = 0; i < count; i++) {
        if (text[i] < '0' || text[i] > '9') {
            return -1;
        }
        number = 10 * number + (text[i] - '0');
    }
    return number >= least && number <= most ? number : -1;
}

/* The number of days since 1970-01-01 of a date of the Gregorian calendar. Years are counted from
   March, so that the leap day is at their end. */
static int64_t date_days(int year, int month, int day)
{
    int64_t y = month > 2 ? year : year - 1;
    int64_t from_march = (month + 9) % 12;
    return 365 * y + y / 4 - y / 100 + y / 400 + (153 * from_march + 2) / 5 + day - 719469;
}

/* Reads an ISO 8601 date in UTC, YYYY-MM-DDThh:mm:ss[.fraction]Z, as seconds since 1970 without
   leap seconds: whole seconds and the fraction. 0, or -1. */
static int date_read(const lrcs_host_field *field, int64_t *seconds, double *part)
{
    static const signed char month_days[12] = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    static const char shape[] = "dddd-dd-ddTdd:dd:dd";
    const char *t = field->text;
    const size_t size = sizeof shape - 1;
    if (field->size < size + 1 || (t[field->size - 1] != 'Z' && t[field->size - 1] != 'z')) {
        return -1;
    }
    for (size_t i = 0; i < size; i++) {
        if (shape[i] != 'd' && t[i] != shape[i] && !(shape[i] == 'T' && t[i] == ' ')) {
            return -1;
        }
    }
    int year = date_digits_read(t, 4, 1, 9999);
    int month = date_digits_read(t + 5, 2, 1, 12);
    int day = date_digits_read(t + 8, 2, 1, month > 0 ? month_days[month - 1] : 0);
    int hour = date_digits_read(t + 11, 2, 0, 23);
    int minute = date_digits_read(t + 14, 2, 0, 59);
    int second = date_digits_read(t + 17, 2, 0, 59);
    int leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    if (year < 0 || month < 0 || day < 0 || hour < 0 || minute < 0 || second < 0 ||
        (month == 2 && day == 29 && !leap)) {
        return -1;
    }
    *part = 0.0;
    if (field->size > size + 1 &&
        (t[size] != '.' || field->size == size + 2 ||
         strspn(t + size + 1, "0123456789") != field->size - size - 2 ||
         lrcs_host_number_read(t + size, field->size - size - 1, part) != LRCS_OK)) {
        return -1;
    }
    *seconds = 86400 * date_days(year, month, day) +
               (INT64_C(3600) * hour + INT64_C(60) * minute + second);
    return 0;
}

/* Reads a time: seconds, or a date, counted from that of the first row. */
static int track_time_read(track_reader *reader, lrcs_host_track *track, uint32_t column,
                           double *value)
{
    const lrcs_host_field *field = &reader->table.field[column];
    int64_t seconds;
    double part;
    int date = date_read(field, &seconds, &part) == 0;
    if (track->count == 0 && date) {
        reader->dates = 1;
        reader->epoch = seconds;
        reader->epoch_part = part;
        snprintf(track->epoch, sizeof track->epoch, "%.*s", (int)field->size, field->text);
    }
    if (date && reader->dates) {
        *value = (double)(seconds - reader->epoch) + (part - reader->epoch_part);
        return LRCS_OK;
    }
    return reader->dates
               ? lrcs_host_field_refuse(&reader->table, LRCS_E_SYNTAX, column,
                                        "a date as in the first row, 2026-11-22T20:15:30.5Z",
                                        reader->error)
               : lrcs_host_field_read(&reader->table, column,
                                      track->count == 0
                                          ? "seconds, or a date as 2026-11-22T20:15:30.5Z"
                                          : "a finite number",
                                      value, reader->error);
}

static int track_row_read(track_reader *reader, lrcs_host_track *track)
{
    double *row = track->row[track->count];
    lrcs_pose pose;
    memset(row, 0, sizeof track->row[0]);
    for (uint32_t i = 0; i < reader->table.columns; i++) {
        int place = reader->place[i];
        double *value = place < PLACE_JOINT ? &row[place < 0 ? 0 : place]
                                            : &track->joint[track->count][place - PLACE_JOINT];
        int status = place < 0    ? LRCS_OK
                     : place == 0 ? track_time_read(reader, track, i, value)
                                  : lrcs_host_field_read(&reader->table, i, "a finite number",
                                                         value, reader->error);
        if (status != LRCS_OK) {
            return status;
        }
    }
    int status = track->quaternions ? lrcs_pose_from_quaternion(row + 1, &pose)
                                    : lrcs_pose_from_direction(row + 1, &pose);
    if (status != LRCS_OK) {
        return track_fault(reader, status, "expected a quaternion or direction that is not zero");
    }
    track->count++;
    return LRCS_OK;
}

/* The first row: reads names. If it has none, four columns are time and direction, five are time
   and quaternion. */
static int track_first_read(track_reader *reader, lrcs_host_track *track)
{
    const lrcs_host_field *field = reader->table.field;
    const uint32_t count = reader->table.columns;
    int64_t seconds;
    double number;
    if (lrcs_host_number_read(field->text, field->size, &number) == LRCS_E_SYNTAX &&
        date_read(field, &seconds, &number) != 0) {
        return track_names_read(reader, track);
    }
    if (count != 4 && count != 5) {
        return track_fault(reader, LRCS_E_SYNTAX, "expected " TRACK_COLUMNS);
    }
    track->quaternions = count == 5;
    for (int i = 0; i < (int)count; i++) {
        reader->place[i] = i;
    }
    return track_row_read(reader, track);
}

int lrcs_host_track_read(const char *path, lrcs_host_track *track, lrcs_host_error *error)
{
    lrcs_host_file file;
    track_reader reader = {.error = error};
    size_t lines = 1;
    memset(track, 0, sizeof *track);
    int status = lrcs_host_file_read(path, &file, error);
    if (status != LRCS_OK) {
        return status;
    }
    for (size_t i = 0; i < file.size; i++) {
        lines += file.bytes[i] == '\n' || file.bytes[i] == '\r';
    }
    track->hash = lrcs_host_hash(LRCS_HOST_HASH_START, file.bytes, file.size);
    track->row = calloc(lines, sizeof *track->row);
    track->joint = calloc(lines, sizeof *track->joint);
    reader.table = lrcs_host_table_make(path, &file);
    int more = 0;
    if (!track->row || !track->joint) {
        status = lrcsi_host_out_of_memory(error);
    } else {
        more = lrcs_host_table_read(&reader.table, error);
    }
    for (int first = 1; more == 1 && status == LRCS_OK; first = 0) {
        status = first ? track_first_read(&reader, track) : track_row_read(&reader, track);
        more = status == LRCS_OK ? lrcs_host_table_read(&reader.table, error) : 0;
    }
    status = more < 0 ? more : status;
    if (status == LRCS_OK && track->count == 0) {
        status =
            lrcsi_host_fail(error, LRCS_E_EMPTY,
                            "%s: no attitude in the file; expected rows of " TRACK_COLUMNS, path);
    }
    lrcs_host_file_free(&file);
    return status;
}

void lrcs_host_track_free(lrcs_host_track *track)
{
    free(track->row);
    free(track->joint);
    for (uint32_t i = 0; i < track->notices.count; i++) {
        free(track->notices.text[i]);
    }
    free(track->notices.text);
    memset(track, 0, sizeof *track);
}
