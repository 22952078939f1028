/* SPDX-License-Identifier: MIT */
/* Tables with named columns, as other programs write them: which columns they have, and what a
   valid name and a valid answer are. Faults are reported with line and column. */
#include "host/kit/table.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "host/fail.h"

int lrcsi_kit_table_refuse(const lrcsi_kit_table *table, int name, const char *format, ...)
{
    char expected[256];
    va_list list;
    va_start(list, format);
    vsnprintf(expected, sizeof expected, format, list);
    va_end(list);
    return lrcs_host_field_refuse(&table->text, LRCS_E_SYNTAX, table->column[name], expected,
                                  table->error);
}

int lrcsi_kit_table_missing(const lrcsi_kit_table *table, const char *name)
{
    char list[256] = "";
    for (uint32_t i = 0; i < table->text.columns; i++) {
        const lrcs_host_field *field = &table->text.field[i];
        lrcs_host_append(list, sizeof list, "%s%.*s", i > 0 ? ", " : "",
                         field->size < 40 ? (int)field->size : 40, field->text);
    }
    return lrcsi_host_fail(table->error, LRCS_E_NAME,
                           "%s: line %llu: no column is named %s; expected a line of column names, "
                           "found %s",
                           table->text.path, (unsigned long long)table->text.line, name, list);
}

int lrcsi_kit_table_open(const char *path, const char *const *name, int count, int needed,
                         lrcsi_kit_table *table, lrcs_host_error *error)
{
    memset(table, 0, sizeof *table);
    table->error = error;
    int status = lrcs_host_file_read(path, &table->file, error);
    if (status != LRCS_OK) {
        return status;
    }
    for (size_t i = 0; i < table->file.size; i++) {
        table->lines += table->file.bytes[i] == '\n' || table->file.bytes[i] == '\r';
    }
    table->text = lrcs_host_table_make(path, &table->file);
    status = lrcs_host_table_read(&table->text, error);
    if (status < 0) {
        return status;
    }
    if (status == 0) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX,
                               "%s: expected a line that names the columns, found nothing", path);
    }
    lrcs_host_table_names(&table->text);
    for (int i = 0; i < count; i++) {
        table->column[i] = lrcs_host_table_column(&table->text, name[i]);
        if (i < needed && !lrcsi_kit_table_has(table, i)) {
            return lrcsi_kit_table_missing(table, name[i]);
        }
    }
    return 0;
}

void lrcsi_kit_table_close(lrcsi_kit_table *table)
{
    lrcs_host_file_free(&table->file);
}

int lrcsi_kit_table_has(const lrcsi_kit_table *table, int name)
{
    return table->column[name] != LRCS_NONE;
}

int lrcsi_kit_table_next(lrcsi_kit_table *table, int *status)
{
    int more = *status == LRCS_OK ? lrcs_host_table_read(&table->text, table->error) : 0;
    *status = more < 0 ? more : *status;
    return more > 0;
}

const lrcs_host_field *lrcsi_kit_table_field(const lrcsi_kit_table *table, int name)
{
    return &table->text.field[table->column[name]];
}

int lrcsi_kit_table_name(const lrcsi_kit_table *table, int name, char text[LRCS_HOST_KIT_NAME])
{
    const lrcs_host_field *field = lrcsi_kit_table_field(table, name);
    if (field->size == 0 || field->size >= LRCS_HOST_KIT_NAME) {
        return lrcsi_kit_table_refuse(table, name, "a name of 1 .. %u bytes",
                                      LRCS_HOST_KIT_NAME - 1);
    }
    for (size_t i = 0; i < field->size; i++) {
        char c = field->text[i];
        if (!(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9') && c != '-') {
            return lrcsi_kit_table_refuse(table, name, "a name of a-z, 0-9 and '-'");
        }
    }
    memcpy(text, field->text, field->size);
    text[field->size] = '\0';
    return LRCS_OK;
}

int lrcsi_kit_table_number(const lrcsi_kit_table *table, int name, double *value)
{
    return lrcs_host_field_read(&table->text, table->column[name], "a number", value, table->error);
}

/* Accepts what printf writes for nan and inf. */
int lrcsi_kit_table_answer(const lrcsi_kit_table *table, int name, double *value)
{
    lrcs_host_field field = *lrcsi_kit_table_field(table, name);
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
    return lrcsi_kit_table_number(table, name, value);
}
