/* SPDX-License-Identifier: MIT */
/* The elements of pages: sections, facts, tables, figures, numbers. This file decides the markup of
   each, which is also well-formed XML; the sections decide the content, and the style sheet the
   appearance. */
#include "cli/report/report.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define PLAIN_BELOW 1e7 /* whole numbers below this are written without a power of ten */

/* ---- memory to write to ---- */

FILE *cli_report_bytes_begin(report_bytes *bytes)
{
    FILE *out = open_memstream(&bytes->bytes, &bytes->size);
    if (!out) {
        cli_out_of_memory();
    }
    return out;
}

int cli_report_bytes_end(FILE *out)
{
    int failed = ferror(out);
    return fclose(out) != 0 || failed ? cli_out_of_memory() : 0;
}

/* ---- words and numbers ---- */

void cli_page_text(FILE *out, const char *format, ...)
{
    char text[2048];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    lrcs_host_html_text(out, text);
}

void cli_page_name(FILE *out, const char *name, const char *nameless)
{
    cli_page(out, name[0] ? "%s" : "<i>%s</i>", name[0] ? name : nameless);
}

/* Writes a number for scripts and, as its text "-2.5e-06" with a minus sign and a power of ten, for
   people. */
static void data_put(FILE *out, const char *id, double value, const char *text)
{
    char exact[LRCS_HOST_NUMBER_SIZE];
    lrcs_host_number_text(value, exact);
    fputs("<data", out);
    if (id) {
        fprintf(out, " id=\"%s\"", id);
    }
    fprintf(out, " value=\"%s\">", exact);
    for (; *text && *text != 'e'; text++) {
        fputs(*text == '-' ? "\xe2\x88\x92" : (const char[2]){*text, '\0'}, out);
    }
    if (*text == 'e') {
        long power = strtol(text + 1, NULL, 10);
        fprintf(out,
                "\xc2\xb7"
                "10<sup>%s%ld</sup>",
                power < 0 ? "\xe2\x88\x92" : "", labs(power));
    }
    fputs("</data>", out);
}

void cli_page_number(FILE *out, const char *id, double value, int digits)
{
    char text[64];
    if (cli_shown(value) == 0.0) {
        snprintf(text, sizeof text, "0");
    } else if (fabs(value) >= pow(10.0, digits) && fabs(value) < PLAIN_BELOW) {
        snprintf(text, sizeof text, "%.0f", value);
    } else {
        snprintf(text, sizeof text, "%.*g", digits, value);
    }
    if (isfinite(value)) {
        data_put(out, id, value, text);
    } else {
        fputs("\xe2\x80\x93", out);
    }
}

void cli_page_bound(FILE *out, const char *id, double bound, int digits)
{
    if (bound >= 0.0 && isfinite(bound)) {
        char text[LRCS_HOST_BOUND_SIZE];
        lrcs_host_bound_text(bound, digits, text);
        data_put(out, id, bound, text);
    } else {
        fputs("\xe2\x80\x93", out);
    }
}

/* ---- markup with values ---- */

/* Writes a value that is no text, of the conversion at `at` after its '%'. Returns the value of a
   share, otherwise 0. */
static double value_put(FILE *out, const char *at, va_list *list)
{
    int digits = at[0] == '.' ? at[1] - '0' : 0;
    at += at[0] == '.' ? 2 : 0;
    double share = 0.0;
    switch (*at) {
    case 'g':
        cli_page_number(out, NULL, va_arg(*list, double), digits);
        break;
    case 'e':
        cli_page_bound(out, NULL, va_arg(*list, double), digits);
        break;
    case 'f':
        share = va_arg(*list, double);
        if (share > 0.0 && share < 0.0005) {
            fputs("&lt;\xc2\xa0"
                  "0.1\xc2\xa0%",
                  out);
        } else if (isfinite(share)) {
            fprintf(out, "%.1f\xc2\xa0%%", 100.0 * share);
        } else {
            fputs("\xe2\x80\x93", out);
        }
        break;
    default:
        fprintf(out, "%u", va_arg(*list, unsigned));
        break;
    }
    return share;
}

/* The end of the conversion after its '%'. */
static const char *value_end(const char *at)
{
    return at + strspn(at, ".0123456789") + 1;
}

static void markup_put(FILE *out, const char *format, va_list *list)
{
    for (const char *at = format; *at;) {
        size_t plain = strcspn(at, "%");
        fwrite(at, 1, plain, out);
        at += plain;
        if (at[0] == '%' && at[1] == '%') {
            putc('%', out);
            at += 2;
        } else if (at[0] == '%' && at[1] == 's') {
            lrcs_host_html_text(out, va_arg(*list, const char *));
            at += 2;
        } else if (at[0] == '%') {
            value_put(out, at + 1, list);
            at = value_end(at + 1);
        }
    }
}

void cli_page(FILE *out, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    markup_put(out, format, &list);
    va_end(list);
}

/* ---- sections and facts ---- */

void cli_page_section(FILE *out, const char *id, const char *title)
{
    fprintf(out, "<section aria-labelledby=\"%s\">\n<h2 id=\"%s\">%s</h2>\n", id, id, title);
}

void cli_page_fact(FILE *out, const char *name, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    fprintf(out, "<div><dt>%s</dt><dd>", name);
    markup_put(out, format, &list);
    fputs("</dd></div>\n", out);
    va_end(list);
}

void cli_page_fold(FILE *out, const char *title)
{
    fprintf(out, "<details>\n<summary>%s</summary>\n", title);
}

/* ---- tables ---- */

void cli_page_table(FILE *out, const char *label, const char *columns)
{
    fprintf(out,
            "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"%s\">\n<table>\n"
            "<thead><tr>",
            label);
    for (const char *at = columns; at; at = strchr(at, '|')) {
        at += at > columns; /* past the '|' */
        int number = *at == '#';
        fprintf(out, "<th scope=\"col\"%s>%.*s</th>", number ? " class=\"n\"" : "",
                (int)strcspn(at, "|") - number, at + number);
    }
    fputs("</tr></thead>\n<tbody>", out);
}

static void cells_put(FILE *out, const char *format, va_list *list)
{
    for (const char *at = format; *at == '%';) {
        if (at[1] == 's') {
            char nameless[16];
            const char *name = va_arg(*list, const char *);
            size_t size = strcspn(at + 2, "%");
            snprintf(nameless, sizeof nameless, "%.*s", (int)size, at + 2);
            fputs("<td class=\"name\">", out);
            cli_page_name(out, name, nameless);
            at += 2 + size;
        } else {
            fputs("<td class=\"n\">", out);
            double share = value_put(out, at + 1, list);
            if (at[1] == 'f') {
                fprintf(out, "</td><td class=\"bar\"><i style=\"width:%.1f%%\"></i>",
                        isfinite(share) ? fmin(fmax(100.0 * share, 0.0), 100.0) : 0.0);
            }
            at = value_end(at + 1);
        }
        fputs("</td>", out);
    }
}

void cli_page_cells(FILE *out, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    cells_put(out, format, &list);
    va_end(list);
}

void cli_page_row(FILE *out, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    fputs("\n<tr>", out);
    cells_put(out, format, &list);
    fputs("</tr>", out);
    va_end(list);
}

void cli_page_table_end(FILE *out)
{
    fputs("\n</tbody>\n</table>\n</div>\n", out);
}

/* ---- figures ---- */

/* The value of an attribute within a tag's bytes, or their end. */
static const char *svg_after(const char *at, const char *what)
{
    const char *found = strstr(at, what);
    return found ? found + strlen(what) : at + strlen(at);
}

/* Replaces the head of the drawing by one with a description and the box that is visible. */
void cli_page_figure(FILE *out, const report_bytes *svg, const char *label, const double box[4])
{
    const char *body = svg_after(svg_after(svg->bytes, "<svg "), ">");
    fprintf(out,
            "<figure>\n<div class=\"chart\"><svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"%g "
            "%g %g %g\" role=\"img\""
            " aria-label=\"",
            box[0], box[1], box[2], box[3]);
    lrcs_host_html_text(out, label);
    fputs("\" font-family=\"inherit\" stroke-linecap=\"round\" stroke-linejoin=\"round\">", out);
    fputs(body, out);
    fputs("</div>\n<figcaption>", out);
}

static void picture_data(FILE *out, const report_bytes *png)
{
    fputs("data:image/png;base64,", out);
    lrcs_host_html_base64(out, (const unsigned char *)png->bytes, png->size);
}

void cli_page_picture(FILE *out, const report_bytes picture[2], const char *label)
{
    fputs("<figure>\n<picture><source media=\"(prefers-color-scheme: dark)\" srcset=\"", out);
    picture_data(out, &picture[0]);
    fprintf(out, "\" />\n<img width=\"%u\" height=\"%u\" alt=\"", CLI_PICTURE_DEFAULT,
            CLI_PICTURE_DEFAULT);
    lrcs_host_html_text(out, label);
    fputs("\" src=\"", out);
    picture_data(out, &picture[1]);
    fputs("\" /></picture>\n<figcaption>", out);
}

void cli_page_figure_end(FILE *out)
{
    fputs("</figcaption>\n</figure>\n", out);
}
