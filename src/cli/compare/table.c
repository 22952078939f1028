/* SPDX-License-Identifier: MIT */
/* Tables with named columns, as other programs write them: which columns they have, and what a
   valid name and a valid answer are. Faults are reported with line and column. */
#include "cli/compare/compare.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

int cli_table_refuse(const compare_table *table, int name, const char *format, ...)
{
    lrcs_host_error error;
    char expected[256];
    va_list list;
    va_start(list, format);
    vsnprintf(expected, sizeof expected, format, list);
    va_end(list);
    lrcs_host_field_refuse(&table->text, LRCS_E_SYNTAX, table->column[name], expected, &error);
    return cli_failed(&error);
}

int cli_table_missing(const compare_table *table, const char *name)
{
    return cli_fail("%s: line %llu: no column is named %s", table->text.path,
                    (unsigned long long)table->text.line, name);
}

int cli_table_open(const char *path, const char *const *name, int count, int needed,
                   compare_table *table)
{
    lrcs_host_error error;
    memset(table, 0, sizeof *table);
    if (lrcs_host_file_read(path, &table->file, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    for (size_t i = 0; i < table->file.size; i++) {
        table->lines += table->file.bytes[i] == '\n' || table->file.bytes[i] == '\r';
    }
    table->text = lrcs_host_table_make(path, &table->file);
    int status = lrcs_host_table_read(&table->text, &error);
    if (status < 0) {
        return cli_failed(&error);
    }
    if (status == 0) {
        return cli_fail("%s: expected a line that names the columns, found nothing", path);
    }
    lrcs_host_table_names(&table->text);
    for (int i = 0; i < count; i++) {
        table->column[i] = lrcs_host_table_column(&table->text, name[i]);
        if (i < needed && !cli_table_has(table, i)) {
            return cli_table_missing(table, name[i]);
        }
    }
    return 0;
}

void cli_table_close(compare_table *table)
{
    lrcs_host_file_free(&table->file);
}

int cli_table_has(const compare_table *table, int name)
{
    return table->column[name] != LRCS_NONE;
}

int cli_table_next(compare_table *table, int *code)
{
    lrcs_host_error error;
    int status = *code == 0 ? lrcs_host_table_read(&table->text, &error) : 0;
    *code = status < 0 ? cli_failed(&error) : *code;
    return status > 0;
}

const lrcs_host_field *cli_table_field(const compare_table *table, int name)
{
    return &table->text.field[table->column[name]];
}

int cli_table_name(const compare_table *table, int name, char text[KIT_NAME])
{
    const lrcs_host_field *field = cli_table_field(table, name);
    if (field->size == 0 || field->size >= KIT_NAME) {
        return cli_table_refuse(table, name, "a name of 1 .. %u bytes", KIT_NAME - 1);
    }
    for (size_t i = 0; i < field->size; i++) {
        char c = field->text[i];
        if (!(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9') && c != '-') {
            return cli_table_refuse(table, name, "a name of a-z, 0-9 and '-'");
        }
    }
    memcpy(text, field->text, field->size);
    text[field->size] = '\0';
    return 0;
}

int cli_table_number(const compare_table *table, int name, double *value)
{
    lrcs_host_error error;
    int status = lrcs_host_field_read(&table->text, table->column[name], "a number", value, &error);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* Accepts what printf writes for nan and inf. */
int cli_table_answer(const compare_table *table, int name, double *value)
{
    lrcs_host_field field = *cli_table_field(table, name);
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
    return cli_table_number(table, name, value);
}
