/* SPDX-License-Identifier: MIT */
/* The tables of a run, facets and visible polygons: CSV as in RFC 4180, but with line ends of LF.
 */
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

/* The rest of a row. */
static void numbers_write(FILE *out, const double *value, int count)
{
    for (int k = 0; k < count; k++) {
        lrcs_host_number_put(out, ",", value[k]);
    }
    putc('\n', out);
}

void lrcs_host_facets_write(FILE *out, const lrcs_scene *scene, const lrcs_facet_record *records)
{
    fputs("facet,material,area_m2,cos_theta,visible_area_m2,sigma_m2\n", out);
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const double value[4] = {records[i].area_m2, records[i].cos_theta,
                                 records[i].visible_area_m2, records[i].sigma_m2};
        fprintf(out, "%lu,", (unsigned long)i);
        lrcs_host_csv_text(out, scene->material[scene->facet_material[i]].name, ",\"\r\n");
        numbers_write(out, value, 4);
    }
}

void lrcs_host_polygons_write(FILE *out, const lrcs_polygons *polygons)
{
    fputs("facet,ring,x_m,y_m,z_m,u_m,v_m\n", out);
    for (uint32_t r = 0; r < polygons->rings; r++) {
        const lrcs_ring *ring = &polygons->ring[r];
        for (uint32_t i = ring->first; i < ring->first + ring->count; i++) {
            const lrcs_ring_point *p = &polygons->point[i];
            const double value[5] = {p->body[0], p->body[1], p->body[2], p->view[0], p->view[1]};
            fprintf(out, "%lu,%lu", (unsigned long)ring->facet, (unsigned long)r);
            numbers_write(out, value, 5);
        }
    }
}
