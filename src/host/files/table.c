/* SPDX-License-Identifier: MIT */
/* Tables of text. It decides what a line and a field are, and refuses ambiguous text. Its callers
   interpret the columns. */
#include <lrcs/table.h>

#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "base/where.h"
#include "host/fail.h"

static int byte_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/* The next line that is not empty; 0 at the end of the text. */
static int text_line_next(lrcs_host_table *table, const char **line, const char **end)
{
    while (table->at < table->end) {
        const char *at = table->at;
        while (table->at < table->end && *table->at != '\n' && *table->at != '\r') {
            table->at++;
        }
        *end = table->at;
        int cr_lf = table->end - table->at > 1 && table->at[0] == '\r' && table->at[1] == '\n';
        table->at += table->at < table->end ? 1 + cr_lf : 0;
        table->line++;
        while (at < *end && byte_is_blank(*at)) {
            at++;
        }
        if (at < *end && *at != '#') {
            *line = at;
            return 1;
        }
    }
    return 0;
}

/* One field from *line on, which is moved to its separator. */
static lrcs_host_field field_cut(const lrcs_host_table *table, const char **line, const char *end)
{
    const char *at = *line;
    while (at < end && byte_is_blank(*at) && *at != table->separator) {
        at++;
    }
    const char *quote = at < end && *at == '"' ? memchr(at + 1, '"', (size_t)(end - at - 1)) : NULL;
    const char *last = quote ? quote + 1 : at;
    while (last < end && *last != table->separator &&
           !(table->separator == ' ' && byte_is_blank(*last))) {
        last++;
    }
    *line = last;
    while (last > at && byte_is_blank(last[-1])) {
        last--;
    }
    if (quote && last == quote + 1) {
        at++;
        last--;
    }
    return (lrcs_host_field){at, (size_t)(last - at)};
}

lrcs_host_table lrcs_host_table_make(const char *path, const lrcs_host_file *file)
{
    lrcs_host_table table = {.path = path, .at = (const char *)file->bytes};
    table.end = table.at + file->size;
    table.at += lrcsi_text_mark(table.at, file->size);
    return table;
}

/* 1. The next line. 2. The separator, by the first line: some countries use commas in numbers, so
   semicolons and tabs have precedence. 3. The fields. 4. Every line has as many as the first. */
int lrcs_host_table_read(lrcs_host_table *table, lrcs_host_error *error)
{
    const char *line;
    const char *end;
    if (!text_line_next(table, &line, &end)) { /* 1 */
        return 0;
    }
    if (table->columns == 0) { /* 2 */
        size_t size = (size_t)(end - line);
        table->separator = memchr(line, ';', size)    ? ';'
                           : memchr(line, '\t', size) ? '\t'
                           : memchr(line, ',', size)  ? ','
                                                      : ' ';
    }
    uint32_t fields = 0; /* 3 */
    for (;;) {
        if (fields == LRCS_HOST_FIELDS) {
            return lrcsi_host_fail(error, LRCS_E_LIMIT, "%s: line %llu: more than %u columns",
                                   table->path, (unsigned long long)table->line, LRCS_HOST_FIELDS);
        }
        table->field[fields++] = field_cut(table, &line, end);
        while (table->separator == ' ' && line < end && byte_is_blank(*line)) {
            line++;
        }
        if (line == end) {
            break;
        }
        line += table->separator != ' ';
    }
    if (table->columns && fields != table->columns) { /* 4 */
        return lrcsi_host_fail(
            error, LRCS_E_SYNTAX,
            "%s: line %llu: found %lu field%s, expected %lu as in the first line", table->path,
            (unsigned long long)table->line, (unsigned long)fields, fields == 1 ? "" : "s",
            (unsigned long)table->columns);
    }
    table->columns = fields;
    return 1;
}

int lrcs_host_field_begins(const lrcs_host_field *field, const char *name)
{
    size_t size = strlen(name);
    return field->size >= size && strncasecmp(field->text, name, size) == 0;
}

int lrcs_host_field_is(const lrcs_host_field *field, const char *name)
{
    return field->size == strlen(name) && lrcs_host_field_begins(field, name);
}

void lrcs_host_table_names(lrcs_host_table *table)
{
    memcpy(table->name, table->field, sizeof table->name);
    table->named = 1;
}

uint32_t lrcs_host_table_column(const lrcs_host_table *table, const char *name)
{
    for (uint32_t i = 0; table->named && i < table->columns; i++) {
        if (lrcs_host_field_is(&table->name[i], name)) {
            return i;
        }
    }
    return LRCS_NONE;
}

int lrcs_host_field_refuse(const lrcs_host_table *table, int status, uint32_t column,
                           const char *expected, lrcs_host_error *error)
{
    const lrcs_host_field *field = &table->field[column];
    const lrcs_host_field *name = &table->name[column];
    lrcs_where found; /* what can be printed of the bytes */
    lrcs_where label;
    snprintf(label.found, sizeof label.found, "%lu", (unsigned long)column + 1);
    if (table->named) {
        lrcsi_where_text(&label, status, 0, 0, "", "", name->text, name->size);
    }
    lrcsi_where_text(&found, status, 0, 0, "", "", field->text, field->size);
    return lrcsi_host_fail(error, status, "%s: line %llu, column %s: found '%s', expected %s",
                           table->path, (unsigned long long)table->line, label.found, found.found,
                           expected);
}

int lrcs_host_field_read(const lrcs_host_table *table, uint32_t column, const char *expected,
                         double *value, lrcs_host_error *error)
{
    const lrcs_host_field *field = &table->field[column];
    int status = lrcs_host_number_read(field->text, field->size, value);
    if (status == LRCS_E_SYNTAX && memchr(field->text, ',', field->size)) {
        return lrcs_host_field_refuse(table, status, column, "a number with a decimal point",
                                      error);
    }
    return status == LRCS_OK ? LRCS_OK
                             : lrcs_host_field_refuse(table, status, column, expected, error);
}
