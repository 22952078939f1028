/* SPDX-License-Identifier: MIT */
/* The scene with its records as a surface in the two formats of VTK and ParaView. It decides how
   numbers become bytes; the numbers are those of the run. */
#include <lrcs/picture.h>

#include <math.h>

#include "base/bits.h"

/* What the numbers of an array are. */
enum vtk_kind {
    VTK_VERTEX,
    VTK_CORNER,
    VTK_OFFSET,
    VTK_DIRECTION,
    VTK_COSINE,
    VTK_AREA,
    VTK_VISIBLE,
    VTK_FRACTION,
    VTK_SIGMA,
    VTK_MATERIAL,
    VTK_PART
};

/* An array of one number, or three, for each of its items. */
typedef struct vtk_array {
    const char *name;
    size_t count;
    uint32_t each;
    int whole; /* integers instead of doubles */
    enum vtk_kind kind;
} vtk_array;

/* Number i of an array. */
static double vtk_number(const lrcs_host_picture *picture, const vtk_array *array, size_t i)
{
    const lrcs_scene *scene = picture->scene;
    const lrcs_facet_record *records = picture->records;
    switch (array->kind) {
    case VTK_VERTEX: {
        const lrcs_point *point = &scene->vertex[i / 3];
        return point->x[i % 3];
    }
    case VTK_CORNER: {
        const lrcs_facet *facet = &scene->facet[i / 3];
        return facet->corner[i % 3];
    }
    case VTK_OFFSET:
        return 3.0 * (double)(i + 1);
    case VTK_DIRECTION:
        return picture->pose->R[2][i];
    case VTK_COSINE:
        return records[i].cos_theta;
    case VTK_AREA:
        return records[i].area_m2;
    case VTK_VISIBLE:
        return records[i].visible_area_m2;
    case VTK_FRACTION: {
        double projected = records[i].area_m2 * fabs(records[i].cos_theta);
        return projected > 0.0 ? fmin(records[i].visible_area_m2 / projected, 1.0) : 0.0;
    }
    case VTK_SIGMA:
        return records[i].sigma_m2;
    case VTK_MATERIAL:
        return scene->facet_material[i];
    case VTK_PART:
    default:
        return scene->facet_part[i];
    }
}

#define VTK_CELL_ARRAYS 7 /* numbers of a facet */

static void cell_arrays(const lrcs_host_picture *picture, vtk_array array[VTK_CELL_ARRAYS])
{
    uint32_t facets = picture->scene->facet_count;
    array[0] = (vtk_array){"cos_theta", facets, 1, 0, VTK_COSINE};
    array[1] = (vtk_array){"area_m2", facets, 1, 0, VTK_AREA};
    array[2] = (vtk_array){"visible_area_m2", facets, 1, 0, VTK_VISIBLE};
    array[3] = (vtk_array){"visible_fraction", facets, 1, 0, VTK_FRACTION};
    array[4] = (vtk_array){"sigma_m2", facets, 1, 0, VTK_SIGMA};
    array[5] = (vtk_array){"material", facets, 1, 1, VTK_MATERIAL};
    array[6] = (vtk_array){"part", facets, 1, 1, VTK_PART};
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
        double value = vtk_number(picture, array, i);
        bytes_write(out, array->whole ? (uint64_t)value : lrcsi_bits_of(value),
                    array->whole ? 4 : 8);
    }
    putc('\n', out);
}

static void legacy_write(FILE *out, const lrcs_host_picture *picture)
{
    const lrcs_scene *scene = picture->scene;
    const vtk_array direction = {"direction", 1, 3, 0, VTK_DIRECTION};
    const vtk_array point = {"points", scene->vertex_count, 3, 0, VTK_VERTEX};
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
            array->kind == VTK_DIRECTION ? " NumberOfTuples=\"1\"" : "");
    for (size_t i = 0; i < array->count * array->each; i++) {
        lrcs_host_number_put(out, "", vtk_number(picture, array, i));
        putc(i % 3 == 2 ? '\n' : ' ', out);
    }
    fputs("</DataArray>\n", out);
}

static void xml_write(FILE *out, const lrcs_host_picture *picture)
{
    const lrcs_scene *scene = picture->scene;
    const vtk_array direction = {"direction", 1, 3, 0, VTK_DIRECTION};
    const vtk_array point = {"points", scene->vertex_count, 3, 0, VTK_VERTEX};
    const vtk_array corner = {"connectivity", 3 * (size_t)scene->facet_count, 1, 1, VTK_CORNER};
    const vtk_array offset = {"offsets", scene->facet_count, 1, 1, VTK_OFFSET};
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
