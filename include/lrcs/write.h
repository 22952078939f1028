/* SPDX-License-Identifier: MIT */
/* Writers: tables, JSON, PNG and HTML. None checks for write errors; lrcs_host_output_close
   does. */
#ifndef LRCS_WRITE_H
#define LRCS_WRITE_H

#include <lrcs/file.h>

/* A number after some text, with all digits needed to read it back. */
void lrcs_host_number_put(FILE *out, const char *before, double value);

/* The per-facet table of a run: a header and one row per facet. */
void lrcs_host_facets_write(FILE *out, const lrcs_scene *scene, const lrcs_facet_record *records);
/* The table of visible polygons: a header and one row per point; rings are counted from 0. */
void lrcs_host_polygons_write(FILE *out, const lrcs_polygons *polygons);

/* A text as a field of CSV: in quotes if it contains one of the special characters. */
void lrcs_host_csv_text(FILE *out, const char *text, const char *special);

/* A JSON writer: containers nest; commas and escapes are written automatically. */
enum lrcs_host_json_kind {
    LRCS_HOST_OBJECT, /* one item per line */
    LRCS_HOST_ARRAY,
    LRCS_HOST_ROW_OBJECT, /* all in one line, including nested containers */
    LRCS_HOST_ROW_ARRAY
};
typedef struct lrcs_host_json {
    FILE *out;
    uint32_t depth;
    struct {
        char close;
        unsigned char row, filled;
    } level[16];
} lrcs_host_json;

lrcs_host_json lrcs_host_json_make(FILE *out);
/* key: NULL inside arrays and at the top level. At most 16 levels. */
void lrcs_host_json_begin(lrcs_host_json *json, const char *key, int kind);
void lrcs_host_json_end(lrcs_host_json *json);
void lrcs_host_json_text(lrcs_host_json *json, const char *key, const char *text); /* NULL: null */
void lrcs_host_json_number(lrcs_host_json *json, const char *key,
                           double value); /* not finite: null */
void lrcs_host_json_count(lrcs_host_json *json, const char *key, uint64_t value);
void lrcs_host_json_bool(lrcs_host_json *json, const char *key, int value);
/* An array of numbers in one line. */
void lrcs_host_json_numbers(lrcs_host_json *json, const char *key, const double *value,
                            uint32_t count);

/* Writes several items. The format is a sketch of them: blanks separate items, each is a value or
   key=value. A value is %s (a text; NULL: null), %g (a number; not finite: null), %u or %llu (a
   count), %d (a condition: true or false), null, or one of { } [ ], which open and close objects
   and arrays, also across calls. "{\n" and "[\n" open those with an item on each line. */
__attribute__((format(printf, 2, 3))) void lrcs_host_json_put(lrcs_host_json *json,
                                                              const char *format, ...);

/* Writes a PNG, 8 bits per channel; channels: 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha.
   about: what the picture was made from, a tEXt chunk named Comment (other characters than ASCII
   become '?'), or NULL.
   Status: LRCS_OK; LRCS_E_ARGUMENT; LRCS_E_LIMIT (2 GiB); LRCS_E_SYSTEM (memory). */
int lrcs_host_png_write(FILE *out, const unsigned char *pixels, uint32_t width, uint32_t height,
                        uint32_t channels, const char *about, lrcs_host_error *error);

/* Writes text into an HTML page, between tags or in quotes; bytes that are not UTF-8 and characters
   that HTML does not allow become U+FFFD. lrcs_host_html_base64 writes bytes as base64 (RFC 4648),
   for data: URLs. */
void lrcs_host_html_text(FILE *out, const char *text);
void lrcs_host_html_base64(FILE *out, const unsigned char *bytes, size_t size);

#endif
