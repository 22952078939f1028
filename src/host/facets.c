/* SPDX-License-Identifier: MIT */
/* The per-facet table of a run, CSV as in RFC 4180, but with line ends of LF. */
#include <lrcs/host.h>

#include <string.h>

void lrcs_host_csv_text(FILE *out, const char *text, const char *special)
{
    const char *quote = strpbrk(text, special) ? "\"" : "";
    fputs(quote, out);
    for (; *text; text++) {
        if (*text == '"') {
            putc('"', out);
        }
        putc(*text, out);
    }
    fputs(quote, out);
}

void lrcs_host_facets_write(FILE *out, const lrcs_scene *scene, const lrcs_facet_record *records)
{
    fputs("facet,material,area_m2,cos_theta,visible_area_m2,sigma_m2\n", out);
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const double value[4] = {records[i].area_m2, records[i].cos_theta,
                                 records[i].visible_area_m2, records[i].sigma_m2};
        fprintf(out, "%lu,", (unsigned long)i);
        lrcs_host_csv_text(out, scene->material[scene->facet_material[i]].name, ",\"\r\n");
        for (int k = 0; k < 4; k++) {
            char text[LRCS_HOST_NUMBER_SIZE];
            lrcs_host_number_text(value[k], text);
            fprintf(out, ",%s", text);
        }
        putc('\n', out);
    }
}
