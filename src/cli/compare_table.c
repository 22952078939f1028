/* SPDX-License-Identifier: MIT */
/* CSV files with named columns, as spreadsheets and other programs write them: commas, semicolons
   or tabs, any line ends, quotes around a field. What it refuses, it refuses with line and column.
 */
#include "cli/compare.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <strings.h>

#define FOUND_MOST 40 /* bytes of a field that a message shows */

static int table_fail(const compare_table *table, const char *what)
{
    fprintf(stderr, "lrcs: %s: line %lu: %s\n", table->path, (unsigned long)table->line, what);
    return CLI_FAILED;
}

int cli_table_refuse(const compare_table *table, int column, const char *format, ...)
{
    const compare_field *name = &table->name[column];
    const compare_field *found = &table->field[column];
    va_list list;
    va_start(list, format);
    fprintf(stderr, "lrcs: %s: line %lu, column %.*s: ", table->path, (unsigned long)table->line,
            name->size, name->text);
    vfprintf(stderr, format, list);
    va_end(list);
    fputs(", found '", stderr);
    for (int i = 0; i < found->size && i < FOUND_MOST; i++) {
        unsigned char byte = (unsigned char)found->text[i];
        putc(byte < 0x20 || byte >= 0x7f ? '?' : byte, stderr);
    }
    fprintf(stderr, "%s'\n", found->size > FOUND_MOST ? ".." : "");
    return CLI_FAILED;
}

/* The next line that holds something; 0 where the file ends. */
static int line_next(compare_table *table, const char **line, const char **end)
{
    while (table->at < table->end) {
        const char *stop = memchr(table->at, '\n', (size_t)(table->end - table->at));
        *line = table->at;
        *end = stop ? stop : table->end;
        table->at = stop ? stop + 1 : table->end;
        table->line++;
        if (*end > *line && (*end)[-1] == '\r') {
            (*end)--;
        }
        if (*end > *line && **line != '#') {
            return 1;
        }
    }
    return 0;
}

static compare_field field_trim(const char *at, const char *end)
{
    while (at < end && *at == ' ') {
        at++;
    }
    while (end > at && end[-1] == ' ') {
        end--;
    }
    if (end - at >= 2 && *at == '"' && end[-1] == '"') {
        at++;
        end--;
    }
    return (compare_field){at, (int)(end - at)};
}

/* The fields of a line and how many there are; -1 for too many. */
static int table_split(const compare_table *table, const char *line, const char *end,
                       compare_field *field)
{
    for (uint32_t count = 0; count < COMPARE_FIELDS; count++) {
        const char *stop = memchr(line, table->separator, (size_t)(end - line));
        field[count] = field_trim(line, stop ? stop : end);
        if (!stop) {
            return (int)count + 1;
        }
        line = stop + 1;
    }
    return -1;
}

int cli_table_open(const char *path, compare_table *table)
{
    lrcs_host_error error;
    const char *line;
    const char *end;
    *table = (compare_table){.path = path};
    if (lrcs_host_file_read(path, &table->file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    table->at = (const char *)table->file.bytes;
    table->end = table->at + table->file.size;
    if (table->file.size >= 3 && memcmp(table->at, "\xef\xbb\xbf", 3) == 0) {
        table->at += 3; /* what some spreadsheets begin with */
    }
    if (!line_next(table, &line, &end)) {
        return table_fail(table, "expected a line that names the columns, found nothing");
    }
    size_t size = (size_t)(end - line);
    table->separator = memchr(line, ';', size) ? ';' : memchr(line, '\t', size) ? '\t' : ',';
    int columns = table_split(table, line, end, table->name);
    table->columns = columns > 0 ? (uint32_t)columns : 0;
    return columns > 0 ? 0 : table_fail(table, "expected at most 64 columns");
}

size_t cli_table_lines(const compare_table *table)
{
    size_t lines = 1;
    for (const char *at = table->at; at < table->end; at++) {
        lines += *at == '\n';
    }
    return lines;
}

void cli_table_close(compare_table *table)
{
    lrcs_host_file_free(&table->file);
}

int cli_table_column(const compare_table *table, const char *name)
{
    for (uint32_t i = 0; i < table->columns; i++) {
        const compare_field *field = &table->name[i];
        if ((size_t)field->size == strlen(name) &&
            strncasecmp(field->text, name, strlen(name)) == 0) {
            return (int)i;
        }
    }
    return -1;
}

int cli_table_require(const compare_table *table, const char *name, int *column)
{
    *column = cli_table_column(table, name);
    if (*column < 0) {
        fprintf(stderr, "lrcs: %s: line %lu: no column is named %s\n", table->path,
                (unsigned long)table->line, name);
        return CLI_FAILED;
    }
    return 0;
}

int cli_table_next(compare_table *table)
{
    const char *line;
    const char *end;
    if (!line_next(table, &line, &end)) {
        return 0;
    }
    int fields = table_split(table, line, end, table->field);
    if (fields != (int)table->columns) {
        fprintf(stderr, "lrcs: %s: line %lu: expected %lu fields, as in the first line, found ",
                table->path, (unsigned long)table->line, (unsigned long)table->columns);
        fprintf(stderr, fields < 0 ? "more\n" : "%d\n", fields);
        return -1;
    }
    return 1;
}

int cli_table_name(const compare_table *table, int column, char name[KIT_NAME])
{
    const compare_field *field = &table->field[column];
    if (field->size == 0 || (unsigned)field->size >= KIT_NAME) {
        return cli_table_refuse(table, column, "expected a name of 1 .. %u bytes", KIT_NAME - 1);
    }
    for (int i = 0; i < field->size; i++) {
        char c = field->text[i];
        if (!(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9') && c != '-') {
            return cli_table_refuse(table, column, "expected a name of a-z, 0-9 and '-'");
        }
    }
    memcpy(name, field->text, (size_t)field->size);
    name[field->size] = '\0';
    return 0;
}

int cli_table_number(const compare_table *table, int column, double *value)
{
    const compare_field *field = &table->field[column];
    if (lrcs_host_number_read(field->text, (size_t)field->size, value) != LRCS_OK) {
        return cli_table_refuse(table, column, "expected a number");
    }
    return 0;
}

/* What printf makes of numbers that are none. */
int cli_table_answer(const compare_table *table, int column, double *value)
{
    const compare_field *field = &table->field[column];
    int negative = field->size > 0 && field->text[0] == '-';
    int skip = negative || (field->size > 0 && field->text[0] == '+');
    const char *text = field->text + skip;
    int size = field->size - skip;
    if ((size == 3 && strncasecmp(text, "inf", 3) == 0) ||
        (size == 8 && strncasecmp(text, "infinity", 8) == 0)) {
        *value = negative ? -HUGE_VAL : HUGE_VAL;
        return 0;
    }
    if (size >= 3 && strncasecmp(text, "nan", 3) == 0) {
        *value = (double)NAN;
        return 0;
    }
    return cli_table_number(table, column, value);
}
