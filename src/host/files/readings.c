/* SPDX-License-Identifier: MIT */
/* Tables of readings, as goniometers and spreadsheets write them. It decides the role of each
   column and refuses ambiguous tables. The fit interprets the readings. */
#include <lrcs/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/fail.h"

enum readings_role {
    ROLE_ANGLE,
    ROLE_VALUE,
    ROLE_SIGMA,
    ROLE_WEIGHT,
    ROLE_MATERIAL,
    ROLES,
    ROLE_NONE = ROLES
};

/* The names of columns of each role: a column's name begins with one of these, ignoring case. */
static const char *const role_names[ROLES][5] = {
    [ROLE_ANGLE] = {"angle", "theta", "incidence"},
    [ROLE_VALUE] = {"brdf", "reading", "value", "f_r", "ratio"},
    [ROLE_SIGMA] = {"sigma", "error", "std", "uncertainty"},
    [ROLE_WEIGHT] = {"weight"},
    [ROLE_MATERIAL] = {"material", "sample"}};

typedef struct readings_table {
    lrcs_host_table text;
    uint32_t role[ROLES];              /* its column, LRCS_NONE for none */
    uint64_t left_out, first_left_out; /* lines without a value */
    uint32_t room;
    lrcs_host_readings *out;
    lrcs_host_error *error;
} readings_table;

/* ---- columns ---- */

static int column_refuse(const readings_table *table, int status, uint32_t column,
                         const char *expected)
{
    return lrcs_host_field_refuse(&table->text, status, column, expected, table->error);
}

/* 1 if the name of a column begins with one of the names of a role. */
static int field_is_of(const lrcs_host_field *field, int role)
{
    int found = 0;
    for (int k = 0; k < 5 && role_names[role][k]; k++) {
        found |= lrcs_host_field_begins(field, role_names[role][k]);
    }
    return found;
}

static int field_has(const lrcs_host_field *field, const char *word)
{
    for (size_t i = 0; i < field->size; i++) {
        lrcs_host_field rest = {field->text + i, field->size - i};
        if (lrcs_host_field_begins(&rest, word)) {
            return 1;
        }
    }
    return 0;
}

/* The first line as names of columns. */
static int header_read(readings_table *table)
{
    uint32_t twice = LRCS_NONE; /* the first column whose role another one has already */
    for (uint32_t i = 0; i < table->text.columns; i++) {
        const lrcs_host_field *field = &table->text.field[i];
        int role = 0;
        while (role < ROLES && !field_is_of(field, role)) {
            role++;
        }
        if (role == ROLE_NONE) {
            lrcsi_host_note(&table->out->notices, "%s: column '%.*s' is not used", table->text.path,
                            field->size < 64 ? (int)field->size : 64, field->text);
            continue;
        }
        if (table->role[role] != LRCS_NONE) {
            twice = twice == LRCS_NONE ? i : twice;
            continue;
        }
        if (role == ROLE_ANGLE && field_has(field, "rad")) {
            return column_refuse(table, LRCS_E_NAME, i, "angles in degrees");
        }
        table->role[role] = i;
    }
    int no_angle = table->role[ROLE_ANGLE] == LRCS_NONE;
    int no_value = table->role[ROLE_VALUE] == LRCS_NONE;
    if (no_angle || no_value) {
        return lrcsi_host_fail(
            table->error, LRCS_E_NAME,
            "%s: line %lu: no column of %s: not a table of BRDF readings; expected columns "
            "angle_deg and brdf, and sigma, weight and material where there are any",
            table->text.path, (unsigned long)table->text.line,
            !no_value   ? "angles"
            : !no_angle ? "readings"
                        : "angles and none of readings");
    }
    if (twice != LRCS_NONE) {
        return column_refuse(table, LRCS_E_NAME, twice,
                             field_is_of(&table->text.field[twice], ROLE_ANGLE)
                                 ? "one column of angles (monostatic readings: laser and "
                                   "detector at the same angle)"
                                 : "only one column of its kind");
    }
    return LRCS_OK;
}

/* Decides the roles of the columns from the first line, and whether it holds their names. */
static int columns_read(readings_table *table, int *named)
{
    double number;
    for (int role = 0; role < ROLES; role++) {
        table->role[role] = LRCS_NONE;
    }
    *named = lrcs_host_number_read(table->text.field[0].text, table->text.field[0].size, &number) !=
             LRCS_OK;
    if (*named) {
        int status = header_read(table);
        lrcs_host_table_names(&table->text);
        return status;
    }
    if (table->text.columns < 2 || table->text.columns > 3) {
        return lrcsi_host_fail(table->error, LRCS_E_SYNTAX,
                               "%s: line %lu: found %lu columns without names, expected angle_deg, "
                               "brdf and perhaps sigma, or a first line of names",
                               table->text.path, (unsigned long)table->text.line,
                               (unsigned long)table->text.columns);
    }
    for (uint32_t i = 0; i < table->text.columns; i++) {
        table->role[i] = i; /* ROLE_ANGLE, ROLE_VALUE, ROLE_SIGMA */
    }
    return LRCS_OK;
}

/* ---- readings ---- */

static int role_read(const readings_table *table, int role, const char *expected, double *value)
{
    return lrcs_host_field_read(&table->text, table->role[role], expected, value, table->error);
}

/* No reading: an empty field or a word for it. */
static int value_is_missing(const lrcs_host_field *field)
{
    static const char *const word[] = {"", "nan", "na", "n/a", "null"};
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++) {
        if (lrcs_host_field_is(field, word[i])) {
            return 1;
        }
    }
    return 0;
}

/* Fills a reading from the fields. *kept is 0 for a line to leave out: without a value, or with the
   weight 0. */
static int reading_read(readings_table *table, lrcs_fit_reading *reading, int *kept)
{
    double weight = 1.0;
    *reading = (lrcs_fit_reading){0.0, 0.0, 0.0};
    *kept = !value_is_missing(&table->text.field[table->role[ROLE_VALUE]]);
    if (!*kept) {
        table->first_left_out = table->left_out++ ? table->first_left_out : table->text.line;
        return LRCS_OK;
    }
    int status = role_read(table, ROLE_ANGLE, "an angle in degrees", &reading->angle_deg);
    if (status == LRCS_OK && !(fabs(reading->angle_deg) < 90.0)) {
        status = column_refuse(table, LRCS_E_NUMBER, table->role[ROLE_ANGLE],
                               "an angle between -90 and 90 degrees");
    }
    if (status == LRCS_OK) {
        status = role_read(table, ROLE_VALUE, "a reading", &reading->value);
    }
    if (status == LRCS_OK && table->role[ROLE_SIGMA] != LRCS_NONE) {
        status = role_read(table, ROLE_SIGMA, "a standard error above 0", &reading->sigma);
        if (status == LRCS_OK && !(reading->sigma > 0.0)) {
            status = column_refuse(table, LRCS_E_NUMBER, table->role[ROLE_SIGMA],
                                   "a standard error above 0");
        }
    } else if (status == LRCS_OK && table->role[ROLE_WEIGHT] != LRCS_NONE) {
        status = role_read(table, ROLE_WEIGHT, "a weight, 0 or more", &weight);
        if (status == LRCS_OK && !(weight >= 0.0)) {
            status = column_refuse(table, LRCS_E_NUMBER, table->role[ROLE_WEIGHT],
                                   "a weight, 0 or more");
        }
        reading->sigma = weight > 0.0 ? 1.0 / sqrt(weight) : 0.0;
    }
    *kept = weight > 0.0;
    return status;
}

/* The index of a material's name, entered if it is new; LRCS_NONE without memory. */
static uint32_t name_index(lrcs_host_readings *out, const char *text, size_t size)
{
    for (uint32_t i = 0; i < out->name_count; i++) {
        if (strlen(out->name[i]) == size && memcmp(out->name[i], text, size) == 0) {
            return i;
        }
    }
    char *copy = malloc(size + 1);
    char **grown = realloc(out->name, (out->name_count + (size_t)1) * sizeof *grown);
    out->name = grown ? grown : out->name;
    if (!copy || !grown) {
        free(copy);
        return LRCS_NONE;
    }
    memcpy(copy, text, size);
    copy[size] = '\0';
    out->name[out->name_count] = copy;
    return out->name_count++;
}

/* Adds the reading of a line, unless it is left out. */
static int reading_add(readings_table *table)
{
    lrcs_host_reading reading = {.line = (uint32_t)table->text.line};
    lrcs_host_readings *out = table->out;
    int kept;
    int status = reading_read(table, &reading.fit, &kept);
    if (status != LRCS_OK || !kept) {
        return status;
    }
    if (out->count == table->room) {
        if (table->room >= UINT32_MAX / 2) {
            return lrcsi_host_fail(table->error, LRCS_E_LIMIT, "%s: too many readings",
                                   table->text.path);
        }
        table->room = table->room ? 2 * table->room : 256;
        size_t bytes = table->room * sizeof *out->reading;
        lrcs_host_reading *grown = realloc(out->reading, bytes);
        if (!grown) {
            return lrcsi_host_fail_memory(table->error, bytes);
        }
        out->reading = grown;
    }
    uint32_t column = table->role[ROLE_MATERIAL];
    lrcs_host_field name =
        column == LRCS_NONE ? (lrcs_host_field){"", 0} : table->text.field[column];
    reading.material = name_index(out, name.text, name.size);
    if (reading.material == LRCS_NONE) {
        return lrcsi_host_fail_memory(table->error, sizeof *out->name);
    }
    out->reading[out->count++] = reading;
    return LRCS_OK;
}

static int table_read(readings_table *table)
{
    int more = lrcs_host_table_read(&table->text, table->error);
    for (int first = 1; more == 1; first = 0) {
        int named = 0;
        int status = first ? columns_read(table, &named) : LRCS_OK;
        status = status == LRCS_OK && !named ? reading_add(table) : status;
        if (status != LRCS_OK) {
            return status;
        }
        more = lrcs_host_table_read(&table->text, table->error);
    }
    if (more < 0) {
        return more;
    }
    if (table->out->count == 0) {
        return lrcsi_host_fail(table->error, LRCS_E_EMPTY, "%s: contains no readings",
                               table->text.path);
    }
    if (table->left_out > 0) {
        lrcsi_host_note(&table->out->notices,
                        "%s: lines without a reading left out: %lu, the first is line %lu",
                        table->text.path, (unsigned long)table->left_out,
                        (unsigned long)table->first_left_out);
    }
    table->out->noise = table->role[ROLE_SIGMA] != LRCS_NONE    ? LRCS_FIT_GIVEN
                        : table->role[ROLE_WEIGHT] != LRCS_NONE ? LRCS_FIT_WEIGHTED
                                                                : LRCS_FIT_ABSOLUTE;
    return LRCS_OK;
}

int lrcs_host_readings_read(const char *path, lrcs_host_readings *readings, lrcs_host_error *error)
{
    lrcs_host_file file;
    lrcs_host_readings out;
    memset(&out, 0, sizeof out);
    int status = lrcs_host_file_read(path, &file, error);
    if (status != LRCS_OK) {
        return status;
    }
    readings_table table = {.text = lrcs_host_table_make(path, &file), .out = &out, .error = error};
    status = table_read(&table);
    lrcs_host_file_free(&file);
    if (status != LRCS_OK) {
        lrcs_host_readings_free(&out);
        return status;
    }
    *readings = out;
    return LRCS_OK;
}

void lrcs_host_readings_free(lrcs_host_readings *readings)
{
    for (uint32_t i = 0; i < readings->name_count; i++) {
        free(readings->name[i]);
    }
    for (uint32_t i = 0; i < readings->notices.count; i++) {
        free(readings->notices.text[i]);
    }
    free(readings->notices.text);
    free(readings->name);
    free(readings->reading);
    memset(readings, 0, sizeof *readings);
}
