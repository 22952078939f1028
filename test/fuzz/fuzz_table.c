/* SPDX-License-Identifier: MIT */
/* Tables of text from arbitrary bytes: rows, fields, numbers (against strtod), names of columns,
   and readings to fit. */
#include "fuzz.h"

#include <lrcs/table.h>

#include <math.h>
#include <unistd.h>

#define MOST_TEXT 512u

static const double pattern = -0x1.5a5a5p-100;

/* The line a byte stands in, from 1. */
static uint64_t line_of(const char *text, const char *at)
{
    uint64_t line = 1;
    for (; text < at; text++) {
        line += *text == '\n' || (*text == '\r' && text[1] != '\n');
    }
    return line;
}

static void require_refused(const lrcs_host_error *error, uint64_t line)
{
    char place[64];
    snprintf(place, sizeof place, "t.csv: line %llu", (unsigned long long)line);
    require(memchr(error->text, '\0', sizeof error->text) != NULL);
    require(strncmp(error->text, place, strlen(place)) == 0);
}

/* A field as text that ends, in room of its own size. */
static char *field_copy(const lrcs_host_field *field)
{
    char *copy = malloc(field->size + 1);
    require(copy != NULL);
    memcpy(copy, field->text, field->size);
    copy[field->size] = '\0';
    return copy;
}

/* A number has the bits that strtod reads, or is refused. */
static void require_number(const lrcs_host_table *table, uint32_t column)
{
    lrcs_host_error error;
    double value = pattern;
    int status = lrcs_host_field_read(table, column, "a number", &value, &error);
    if (status != LRCS_OK) {
        require(status == LRCS_E_SYNTAX || status == LRCS_E_NUMBER);
        require(value == pattern);
        require_refused(&error, table->line);
        return;
    }
    char *copy = field_copy(&table->field[column]);
    char *end;
    double other = strtod(copy, &end);
    while (*end == ' ') {
        end++;
    }
    require(isfinite(value) && memcmp(&value, &other, sizeof value) == 0 && *end == '\0');
    free(copy);
}

/* A name finds its own column, or an earlier one of that name. */
static void require_name(const lrcs_host_table *table, uint32_t column)
{
    char *copy = field_copy(&table->name[column]);
    if (strlen(copy) == table->name[column].size) {
        uint32_t found = lrcs_host_table_column(table, copy);
        require(found <= column && lrcs_host_field_is(&table->name[found], copy));
        require(lrcs_host_field_begins(&table->name[column], copy));
    }
    free(copy);
}

/* Fields lie within the row's line, in order, and contain neither separators nor line ends. */
static void require_row(const lrcs_host_table *table, const char *text, const char *end)
{
    const char *last = text;
    require(table->columns >= 1 && table->columns <= LRCS_HOST_FIELDS);
    for (uint32_t i = 0; i < table->columns; i++) {
        const lrcs_host_field *field = &table->field[i];
        require(field->text >= last && field->size <= (size_t)(end - field->text));
        require(line_of(text, field->text) == table->line);
        last = field->text + field->size;
        int quoted = last < end && *last == '"';
        for (size_t k = 0; k < field->size; k++) {
            require(field->text[k] != '\n' && field->text[k] != '\r');
            require(quoted || field->text[k] != table->separator || field->text[0] == '"');
        }
        require_number(table, i);
    }
}

static void fuzz_rows(const lrcs_host_file *file)
{
    const char *text = (const char *)file->bytes;
    lrcs_host_error error;
    lrcs_host_table table = lrcs_host_table_make("t.csv", file);
    uint64_t line = 0;
    uint32_t columns = 0;
    int status;
    while ((status = lrcs_host_table_read(&table, &error)) == 1) {
        require(table.line > line && (columns == 0 || table.columns == columns));
        require_row(&table, text, text + file->size);
        if (columns == 0) {
            lrcs_host_table_names(&table);
        }
        line = table.line;
        columns = table.columns;
        for (uint32_t i = 0; i < columns && line == 1; i++) {
            require_name(&table, i);
        }
    }
    if (status == 0) {
        require(table.at == table.end && lrcs_host_table_read(&table, &error) == 0);
    } else {
        require(status == LRCS_E_LIMIT || status == LRCS_E_SYNTAX);
        require(table.line > line && table.columns == columns);
        require_refused(&error, table.line);
    }
}

static void require_readings(const lrcs_host_readings *r, uint64_t lines)
{
    require(r->count > 0 && r->name_count > 0);
    require(r->noise == LRCS_FIT_ABSOLUTE || r->noise == LRCS_FIT_GIVEN ||
            r->noise == LRCS_FIT_WEIGHTED);
    for (uint32_t i = 0; i < r->count; i++) {
        const lrcs_host_reading *reading = &r->reading[i];
        require(fabs(reading->fit.angle_deg) < 90 && isfinite(reading->fit.value));
        require(isfinite(reading->fit.sigma));
        require(reading->fit.sigma > 0 || r->noise == LRCS_FIT_ABSOLUTE);
        require(reading->material < r->name_count);
        require(reading->line <= lines && (i == 0 || reading->line > r->reading[i - 1].line));
    }
}

/* The same bytes as a file, in one that is written anew every time. */
static void fuzz_readings(const lrcs_host_file *file)
{
    static FILE *stream;
    char path[64];
    lrcs_host_readings readings;
    lrcs_host_error error;
    stream = stream ? stream : tmpfile();
    require(stream != NULL);
    int at = fileno(stream);
    require(pwrite(at, file->bytes, file->size, 0) == (ssize_t)file->size);
    require(ftruncate(at, (off_t)file->size) == 0);
    snprintf(path, sizeof path, "/dev/fd/%d", at);
    memset(&readings, FUZZ_PATTERN, sizeof readings);
    int status = lrcs_host_readings_read(path, &readings, &error);
    if (status == LRCS_OK) {
        const char *text = (const char *)file->bytes;
        require_readings(&readings, line_of(text, text + file->size));
        lrcs_host_readings_free(&readings);
    } else {
        require(status < 0 && strncmp(error.text, path, strlen(path)) == 0);
        require(fuzz_untouched(&readings, sizeof readings));
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    unsigned char bytes[MOST_TEXT + 1]; /* one more: line_of looks behind the last */
    if (size > MOST_TEXT) {
        return 0;
    }
    memcpy(bytes, data, size);
    bytes[size] = 0;
    lrcs_host_file file = {bytes, size};
    fuzz_rows(&file);
    fuzz_readings(&file);
    return 0;
}
