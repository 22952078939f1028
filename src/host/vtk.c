/* SPDX-License-Identifier: MIT */
/* The scene with its records as a surface in the two formats of VTK and ParaView. It decides how
   numbers become bytes; the numbers are those of the run. */
#include <lrcs/picture.h>

#include <math.h>

#include "base/bits.h"

/* An array of one number, or three, for each of its items. */
typedef struct vtk_array {
    const char *name;
    size_t count;
    uint32_t each;
    int whole; /* integers instead of doubles */
    double (*value)(const lrcs_host_picture *picture, size_t i);
} vtk_array;

/* ---- the numbers ---- */

static double vtk_vertex(const lrcs_host_picture *picture, size_t i)
{
    const lrcs_point *point = &picture->scene->vertex[i / 3];
    return point->x[i % 3];
}

static double vtk_corner(const lrcs_host_picture *picture, size_t i)
{
    const lrcs_facet *facet = &picture->scene->facet[i / 3];
    return facet->corner[i % 3];
}

static double vtk_offset(const lrcs_host_picture *picture, size_t i)
{
    (void)picture;
    return 3.0 * (double)(i + 1);
}

static double vtk_direction(const lrcs_host_picture *picture, size_t i)
{
    return picture->pose->R[2][i];
}

static double vtk_cosine(const lrcs_host_picture *picture, size_t i)
{
    return picture->records[i].cos_theta;
}

static double vtk_area(const lrcs_host_picture *picture, size_t i)
{
    return picture->records[i].area_m2;
}

static double vtk_visible(const lrcs_host_picture *picture, size_t i)
{
    return picture->records[i].visible_area_m2;
}

static double vtk_fraction(const lrcs_host_picture *picture, size_t i)
{
    const lrcs_facet_record *record = &picture->records[i];
    double projected = record->area_m2 * fabs(record->cos_theta);
    return projected > 0.0 ? fmin(record->visible_area_m2 / projected, 1.0) : 0.0;
}

static double vtk_sigma(const lrcs_host_picture *picture, size_t i)
{
    return picture->records[i].sigma_m2;
}

static double vtk_material(const lrcs_host_picture *picture, size_t i)
{
    return picture->scene->facet_material[i];
}

static double vtk_part(const lrcs_host_picture *picture, size_t i)
{
    return picture->scene->facet_part[i];
}

#define VTK_CELL_ARRAYS 7

static void cell_arrays(const lrcs_host_picture *picture, vtk_array array[VTK_CELL_ARRAYS])
{
    uint32_t facets = picture->scene->facet_count;
    array[0] = (vtk_array){"cos_theta", facets, 1, 0, vtk_cosine};
    array[1] = (vtk_array){"area_m2", facets, 1, 0, vtk_area};
    array[2] = (vtk_array){"visible_area_m2", facets, 1, 0, vtk_visible};
    array[3] = (vtk_array){"visible_fraction", facets, 1, 0, vtk_fraction};
    array[4] = (vtk_array){"sigma_m2", facets, 1, 0, vtk_sigma};
    array[5] = (vtk_array){"material", facets, 1, 1, vtk_material};
    array[6] = (vtk_array){"part", facets, 1, 1, vtk_part};
}

/* ---- legacy, binary: the high byte first ---- */

static void bytes_write(FILE *out, uint64_t bits, int count)
{
    for (int k = count - 1; k >= 0; k--) {
        putc((int)(bits >> 8 * k & 255u), out);
    }
}

static void legacy_numbers(FILE *out, const lrcs_host_picture *picture, const vtk_array *array)
{
    for (size_t i = 0; i < array->count * array->each; i++) {
        double value = array->value(picture, i);
        bytes_write(out, array->whole ? (uint64_t)value : lrcsi_bits_of(value),
                    array->whole ? 4 : 8);
    }
    putc('\n', out);
}

static void legacy_write(FILE *out, const lrcs_host_picture *picture)
{
    const lrcs_scene *scene = picture->scene;
    const vtk_array direction = {"direction", 1, 3, 0, vtk_direction};
    const vtk_array point = {"points", scene->vertex_count, 3, 0, vtk_vertex};
    unsigned long facets = scene->facet_count;
    vtk_array cell[VTK_CELL_ARRAYS];
    cell_arrays(picture, cell);
    fputs("# vtk DataFile Version 3.0\nlrcs: facets in metres, body frame, and what the laser sees "
          "of them\nBINARY\nDATASET POLYDATA\nFIELD FieldData 1\ndirection 3 1 double\n",
          out);
    legacy_numbers(out, picture, &direction);
    fprintf(out, "POINTS %lu double\n", (unsigned long)scene->vertex_count);
    legacy_numbers(out, picture, &point);
    fprintf(out, "POLYGONS %lu %llu\n", facets, 4ull * facets);
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        bytes_write(out, 3, 4);
        for (int k = 0; k < 3; k++) {
            bytes_write(out, scene->facet[f].corner[k], 4);
        }
    }
    fprintf(out, "\nCELL_DATA %lu\nFIELD FieldData %d\n", facets, VTK_CELL_ARRAYS);
    for (int i = 0; i < VTK_CELL_ARRAYS; i++) {
        fprintf(out, "%s 1 %lu %s\n", cell[i].name, facets, cell[i].whole ? "int" : "double");
        legacy_numbers(out, picture, &cell[i]);
    }
}

/* ---- XML, text ---- */

static void xml_array(FILE *out, const lrcs_host_picture *picture, const vtk_array *array)
{
    fprintf(out,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%lu\"%s format=\"ascii\">\n",
            array->whole ? "Int64" : "Float64", array->name, (unsigned long)array->each,
            array->value == vtk_direction ? " NumberOfTuples=\"1\"" : "");
    for (size_t i = 0; i < array->count * array->each; i++) {
        char text[LRCS_HOST_NUMBER_SIZE];
        lrcs_host_number_text(array->value(picture, i), text);
        fputs(text, out);
        putc(i % 3 == 2 ? '\n' : ' ', out);
    }
    fputs("</DataArray>\n", out);
}

static void xml_write(FILE *out, const lrcs_host_picture *picture)
{
    const lrcs_scene *scene = picture->scene;
    const vtk_array direction = {"direction", 1, 3, 0, vtk_direction};
    const vtk_array point = {"points", scene->vertex_count, 3, 0, vtk_vertex};
    const vtk_array corner = {"connectivity", 3 * (size_t)scene->facet_count, 1, 1, vtk_corner};
    const vtk_array offset = {"offsets", scene->facet_count, 1, 1, vtk_offset};
    vtk_array cell[VTK_CELL_ARRAYS];
    cell_arrays(picture, cell);
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n<PolyData>\n<FieldData>\n",
          out);
    xml_array(out, picture, &direction);
    fprintf(out, "</FieldData>\n<Piece NumberOfPoints=\"%lu\" NumberOfPolys=\"%lu\">\n<Points>\n",
            (unsigned long)scene->vertex_count, (unsigned long)scene->facet_count);
    xml_array(out, picture, &point);
    fputs("</Points>\n<Polys>\n", out);
    xml_array(out, picture, &corner);
    xml_array(out, picture, &offset);
    fputs("</Polys>\n<CellData Scalars=\"sigma_m2\">\n", out);
    for (int i = 0; i < VTK_CELL_ARRAYS; i++) {
        xml_array(out, picture, &cell[i]);
    }
    fputs("</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n", out);
}

void lrcs_host_vtk_write(FILE *out, const lrcs_host_picture *picture, int xml)
{
    if (xml) {
        xml_write(out, picture);
    } else {
        legacy_write(out, picture);
    }
}
