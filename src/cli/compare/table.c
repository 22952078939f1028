/* SPDX-License-Identifier: MIT */
/* Tables with named columns, as other programs write them: which columns they have, and what a
   valid name and a valid answer are. Faults are reported with line and column. */
#include "cli/compare/compare.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

int cli_table_refuse(const compare_table *table, int column, const char *format, ...)
{
    lrcs_host_error error;
    char expected[256];
    va_list list;
    va_start(list, format);
    vsnprintf(expected, sizeof expected, format, list);
    va_end(list);
    lrcs_host_field_refuse(&table->text, LRCS_E_SYNTAX, (uint32_t)column, expected, &error);
    return cli_failed(&error);
}

int cli_table_open(const char *path, compare_table *table)
{
    lrcs_host_error error;
    memset(table, 0, sizeof *table);
    if (lrcs_host_file_read(path, &table->file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    table->text = lrcs_host_table_make(path, &table->file);
    int status = lrcs_host_table_read(&table->text, &error);
    if (status < 0) {
        return cli_failed(&error);
    }
    if (status == 0) {
        fprintf(stderr, "lrcs: %s: expected a line that names the columns, found nothing\n", path);
        return CLI_FAILED;
    }
    lrcs_host_table_names(&table->text);
    return 0;
}

size_t cli_table_lines(const compare_table *table)
{
    size_t lines = 1;
    for (const char *at = table->text.at; at < table->text.end; at++) {
        lines += *at == '\n' || *at == '\r';
    }
    return lines;
}

void cli_table_close(compare_table *table)
{
    lrcs_host_file_free(&table->file);
}

int cli_table_column(const compare_table *table, const char *name)
{
    uint32_t column = lrcs_host_table_column(&table->text, name);
    return column == LRCS_NONE ? -1 : (int)column;
}

int cli_table_require(const compare_table *table, const char *name, int *column)
{
    *column = cli_table_column(table, name);
    if (*column < 0) {
        fprintf(stderr, "lrcs: %s: line %llu: no column is named %s\n", table->text.path,
                (unsigned long long)table->text.line, name);
        return CLI_FAILED;
    }
    return 0;
}

int cli_table_next(compare_table *table)
{
    lrcs_host_error error;
    int status = lrcs_host_table_read(&table->text, &error);
    if (status < 0) {
        cli_failed(&error);
        return -1;
    }
    return status;
}

int cli_table_name(const compare_table *table, int column, char name[KIT_NAME])
{
    const lrcs_host_field *field = &table->text.field[column];
    if (field->size == 0 || field->size >= KIT_NAME) {
        return cli_table_refuse(table, column, "a name of 1 .. %u bytes", KIT_NAME - 1);
    }
    for (size_t i = 0; i < field->size; i++) {
        char c = field->text[i];
        if (!(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9') && c != '-') {
            return cli_table_refuse(table, column, "a name of a-z, 0-9 and '-'");
        }
    }
    memcpy(name, field->text, field->size);
    name[field->size] = '\0';
    return 0;
}

int cli_table_number(const compare_table *table, int column, double *value)
{
    lrcs_host_error error;
    int status = lrcs_host_field_read(&table->text, (uint32_t)column, "a number", value, &error);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* Accepts what printf writes for nan and inf. */
int cli_table_answer(const compare_table *table, int column, double *value)
{
    lrcs_host_field field = table->text.field[column];
    int negative = field.size > 0 && field.text[0] == '-';
    size_t sign = negative || (field.size > 0 && field.text[0] == '+');
    field.text += sign;
    field.size -= sign;
    if (lrcs_host_field_is(&field, "inf") || lrcs_host_field_is(&field, "infinity")) {
        *value = negative ? -HUGE_VAL : HUGE_VAL;
        return 0;
    }
    if (lrcs_host_field_begins(&field, "nan")) {
        *value = (double)NAN;
        return 0;
    }
    return cli_table_number(table, column, value);
}
