/* SPDX-License-Identifier: MIT */
/* SVG 1.1 as text. It decides how a plotter's strokes are written; text remains text, in the
   viewer's sans serif font. Bytes that are not UTF-8 and control characters become '?', so that
   every XML parser accepts the text. */
#include "host/chart/svg.h"

#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A number in hundredths, with a decimal point in every locale. */
static void svg_number(FILE *out, double value)
{
    long hundredths = lround(value * 100.0);
    fprintf(out, "%s%ld", hundredths < 0 ? "-" : "", labs(hundredths) / 100);
    if (hundredths % 100 != 0) {
        fprintf(out, ".%02ld", labs(hundredths) % 100);
    }
}

static void svg_attribute(FILE *out, const char *name, double value)
{
    fprintf(out, " %s=\"", name);
    svg_number(out, value);
    putc('"', out);
}

static void svg_escape(FILE *out, const char *text)
{
    int utf8 = lrcsi_text_is_utf8(text, strlen(text));
    for (; *text; text++) {
        unsigned char byte = (unsigned char)*text;
        if (byte == '<' || byte == '>' || byte == '&') {
            fputs(byte == '<' ? "&lt;" : byte == '>' ? "&gt;" : "&amp;", out);
        } else {
            putc(byte < 0x20 || byte == 0x7f || (byte >= 0x80 && !utf8) ? '?' : byte, out);
        }
    }
}

static void svg_points(FILE *out, const lrcsi_plot_point *point, uint32_t count)
{
    fputs(" points=\"", out);
    for (uint32_t i = 0; i < count; i++) {
        fputs(i == 0 ? "" : " ", out);
        svg_number(out, point[i].x);
        putc(',', out);
        svg_number(out, point[i].y);
    }
    putc('"', out);
}

static void svg_line(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                     const lrcsi_line_style *style)
{
    FILE *out = ((lrcsi_svg *)plotter)->out;
    fprintf(out, "<polyline fill=\"none\" stroke=\"#%06lx\"", (unsigned long)style->colour);
    svg_attribute(out, "stroke-width", style->width);
    if (style->dash[0] > 0.0) {
        fputs(" stroke-dasharray=\"", out);
        svg_number(out, style->dash[0]);
        putc(' ', out);
        svg_number(out, style->dash[1]);
        putc('"', out);
    }
    svg_points(out, point, count);
    fputs("/>\n", out);
}

static void svg_area(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                     uint32_t colour)
{
    FILE *out = ((lrcsi_svg *)plotter)->out;
    fprintf(out, "<polygon fill=\"#%06lx\"", (unsigned long)colour);
    svg_points(out, point, count);
    fputs("/>\n", out);
}

static void svg_text(lrcsi_plotter *plotter, const lrcsi_plot_text *label)
{
    static const char *const anchor[] = {"start", "middle", "end"};
    FILE *out = ((lrcsi_svg *)plotter)->out;
    fprintf(out, "<text text-anchor=\"%s\" fill=\"#%06lx\"", anchor[label->anchor],
            (unsigned long)label->colour);
    svg_attribute(out, "font-size", label->size);
    svg_attribute(out, "x", label->at.x);
    svg_attribute(out, "y", label->at.y);
    fputs(label->bold ? " font-weight=\"bold\"" : "", out);
    if (label->upwards) {
        fputs(" transform=\"rotate(-90 ", out);
        svg_number(out, label->at.x);
        putc(' ', out);
        svg_number(out, label->at.y);
        fputs(")\"", out);
    }
    putc('>', out);
    svg_escape(out, label->text);
    if (label->raised) {
        fputs("<tspan dy=\"-0.45em\" font-size=\"75%\">", out);
        svg_escape(out, label->raised);
        fputs("</tspan>", out);
    }
    fputs("</text>\n", out);
}

lrcsi_svg lrcsi_svg_begin(FILE *out, double width, double height, const char *title,
                          const char *about)
{
    lrcsi_svg svg = {{svg_line, svg_area, svg_text}, out};
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\""
          " xmlns:xlink=\"http://www.w3.org/1999/xlink\"",
          out);
    svg_attribute(out, "width", width);
    svg_attribute(out, "height", height);
    fputs(" viewBox=\"0 0 ", out);
    svg_number(out, width);
    putc(' ', out);
    svg_number(out, height);
    fputs("\" font-family=\"Helvetica, Arial, sans-serif\" stroke-linecap=\"round\""
          " stroke-linejoin=\"round\">\n<title>",
          out);
    svg_escape(out, title);
    fputs("</title>\n", out);
    if (about) {
        fputs("<metadata>", out);
        svg_escape(out, about);
        fputs("</metadata>\n", out);
    }
    fputs("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n", out);
    return svg;
}

void lrcsi_svg_end(lrcsi_svg *svg)
{
    fputs("</svg>\n", svg->out);
}
