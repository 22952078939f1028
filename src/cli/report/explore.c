/* SPDX-License-Identifier: MIT */
/* The interactive page of lrcs report --explore: a body that can be rotated, the map of sigma over
   all directions, and the values for the current direction. This file decides what data the page
   gets: the map as it was computed, and a mesh for display, which is reduced if the scene has many
   facets. explore.js uses them. */
#include "cli/report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A mesh with more facets than this is reduced: a browser draws this many in a fraction of a
   second. */
#define EXPLORE_FACETS 20000u
#define EXPLORE_GRID   1024.0 /* initial number of cells along the longest side of the box */

/* The parts of the page that no scene changes. */
static const char explore_script[] = {
#include "explore.inc"
};
static const char explore_style[] = {
#include "explore_style.inc"
    '\0'};
static const char explore_controls[] = {
#include "explore_controls.inc"
};

/* ---- the mesh to look at ---- */

typedef struct explore_mesh {
    float (*point)[3]; /* m */
    uint32_t points;
    uint32_t (*facet)[3];
    uint32_t *material; /* material of each facet */
    uint32_t facets, all;
} explore_mesh;

/* A vertex, and its cell on a grid. */
typedef struct explore_cell {
    uint64_t key;
    uint32_t vertex;
} explore_cell;

static int cell_order(const void *a, const void *b)
{
    const explore_cell *p = a;
    const explore_cell *q = b;
    if (p->key != q->key) {
        return p->key < q->key ? -1 : 1;
    }
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* Merges all vertices of a cell into the first of them: place[v] replaces v. */
static void vertices_join(const lrcs_scene *scene, const double least[3], double cell,
                          explore_cell *order, uint32_t *place)
{
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        uint64_t key = 0;
        for (int k = 0; k < 3; k++) {
            double at = fmin(fmax(floor((scene->vertex[v].x[k] - least[k]) / cell), 0.0), 2e6);
            key = key << 21 | (uint64_t)at;
        }
        order[v] = (explore_cell){key, v};
    }
    qsort(order, scene->vertex_count, sizeof *order, cell_order);
    for (uint32_t i = 0, first = 0; i < scene->vertex_count; i++) {
        first = order[i].key == order[first].key ? first : i;
        place[order[i].vertex] = order[first].vertex;
    }
}

/* The facets that remain: those that are not left out and still have three different corners.
   Stores them in `mesh` unless it has no room. */
static uint32_t facets_keep(const lrcs_scene *scene, const uint32_t *place, explore_mesh *mesh)
{
    uint32_t used = 0;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        const uint32_t *corner = scene->facet[f].corner;
        uint32_t a = place[corner[0]];
        uint32_t b = place[corner[1]];
        uint32_t c = place[corner[2]];
        if (scene->material[scene->facet_material[f]].omitted || a == b || b == c || c == a) {
            continue;
        }
        if (mesh->facet) {
            memcpy(mesh->facet[used], (const uint32_t[3]){a, b, c}, sizeof *mesh->facet);
            mesh->material[used] = scene->facet_material[f];
        }
        used++;
    }
    return used;
}

/* Numbers the points that facets use, from 0. */
static void points_keep(const lrcs_scene *scene, uint32_t *place, explore_mesh *mesh)
{
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        place[v] = LRCS_NONE;
    }
    for (uint32_t f = 0; f < mesh->facets; f++) {
        for (int k = 0; k < 3; k++) {
            uint32_t *corner = &mesh->facet[f][k];
            if (place[*corner] == LRCS_NONE) {
                for (int i = 0; i < 3; i++) {
                    mesh->point[mesh->points][i] = (float)scene->vertex[*corner].x[i];
                }
                place[*corner] = mesh->points++;
            }
            *corner = place[*corner];
        }
    }
}

static int mesh_reduce(const lrcs_scene *scene, const double least[3], double side,
                       explore_mesh *mesh)
{
    explore_cell *order = calloc((size_t)scene->vertex_count + 1, sizeof *order);
    uint32_t *place = calloc((size_t)scene->vertex_count + 1, sizeof *place);
    int code = order && place ? 0 : -1;
    for (uint32_t v = 0; code == 0 && v < scene->vertex_count; v++) {
        place[v] = v;
    }
    if (code == 0) {
        mesh->facets = mesh->all = facets_keep(scene, place, mesh);
    }
    for (double cells = EXPLORE_GRID; code == 0 && mesh->facets > EXPLORE_FACETS; cells *= 0.8) {
        vertices_join(scene, least, side / cells, order, place);
        mesh->facets = facets_keep(scene, place, mesh);
    }
    if (code == 0) {
        mesh->facet = calloc((size_t)mesh->facets + 1, sizeof *mesh->facet);
        mesh->material = calloc((size_t)mesh->facets + 1, sizeof *mesh->material);
        mesh->point = calloc((size_t)3 * mesh->facets + 1, sizeof *mesh->point);
        code = mesh->facet && mesh->material && mesh->point ? 0 : -1;
    }
    if (code == 0) {
        facets_keep(scene, place, mesh);
        points_keep(scene, place, mesh);
    }
    free(order);
    free(place);
    return code == 0 ? 0 : cli_out_of_memory();
}

/* ---- as data ---- */

/* Writes "name":"...", the numbers as base64 of their bytes, little-endian, as browsers store
   them. */
static void words_put(FILE *out, const char *name, const void *item, size_t count, size_t size)
{
    unsigned char *bytes = malloc(count * size + 1);
    for (size_t i = 0; bytes && i < count; i++) {
        uint64_t bits = 0;
        uint32_t half = 0;
        if (size == 8) {
            memcpy(&bits, (const char *)item + 8 * i, 8);
        } else {
            memcpy(&half, (const char *)item + 4 * i, 4);
            bits = half;
        }
        for (size_t k = 0; k < size; k++) {
            bytes[size * i + k] = (unsigned char)(bits >> 8 * k & 255u);
        }
    }
    fprintf(out, ",\n\"%s\":\"", name);
    if (bytes) {
        lrcs_host_html_base64(out, bytes, count * size);
    }
    fputs("\"", out);
    free(bytes);
}

static void axis_put(FILE *out, const char *name, double least, uint32_t step, uint64_t count)
{
    fprintf(out, ",\n\"%s\":{\"least\":%g,\"step\":%lu,\"count\":%llu}", name, least,
            (unsigned long)step, (unsigned long long)count);
}

static void materials_put(FILE *out, const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *m = &scene->material[i];
        static const unsigned char plain[3] = {0xc8, 0xc8, 0xc8};
        const unsigned char *rgb = m->has_colour ? m->rgb : plain;
        fprintf(out, "%s{\"rgb\":[%u,%u,%u],\"two_sided\":%d}", i > 0 ? "," : ",\n\"materials\":[",
                rgb[0], rgb[1], rgb[2], m->two_sided != 0);
    }
    fputs(scene->material_count > 0 ? "]" : ",\n\"materials\":[]", out);
}

static int explore_data_put(FILE *out, const report_job *job, explore_mesh *mesh)
{
    const report_sweep *map = &job->sweep[REPORT_MAP];
    const lrcs_scene *scene = &job->run.scene.scene;
    double azel_deg[2];
    double least[3];
    double most[3];
    double side = 0.0;
    double radius = 0.0;
    uint64_t rows = map->plan.rows;
    double *value = malloc(4 * rows * sizeof *value); /* sigma, bound, low and high end */
    lrcs_host_scene_box(scene, least, most);
    for (int k = 0; k < 3; k++) {
        side = fmax(side, most[k] - least[k]);
        radius = hypot(radius, 0.5 * (most[k] - least[k]));
    }
    if (!value || mesh_reduce(scene, least, side, mesh) != 0) {
        free(value);
        return CLI_FAILED;
    }
    for (uint64_t i = 0; i < rows; i++) {
        for (uint64_t k = 0; k < (map->band ? 4u : 2u); k++) {
            value[k * rows + i] = k < 2 ? map->row[i][k] : map->band[i][k - 2];
        }
    }
    fputs("<script type=\"application/json\" id=\"data\">{", out);
    cli_pose_azel(&job->run.pose, azel_deg);
    lrcs_host_number_put(out, "\"start\":[", azel_deg[0]);
    lrcs_host_number_put(out, ",", azel_deg[1]);
    lrcs_host_number_put(out, "],\n\"radius\":", radius > 0.0 ? radius : 1.0);
    lrcs_host_number_put(out, ",\n\"centre\":[", 0.5 * (least[0] + most[0]));
    lrcs_host_number_put(out, ",", 0.5 * (least[1] + most[1]));
    lrcs_host_number_put(out, ",", 0.5 * (least[2] + most[2]));
    fputs("]", out);
    axis_put(out, "az", 0.0, job->map_step, map->plan.axis[0].range.count);
    axis_put(out, "el", -90.0, job->map_step, map->plan.axis[1].range.count);
    materials_put(out, scene);
    fprintf(out, ",\n\"open\":%d", map->plot.materials_assumed != 0);
    words_put(out, "sigma", value, rows, 8);
    words_put(out, "bound", value + rows, rows, 8);
    if (map->band) {
        words_put(out, "low", value + 2 * rows, rows, 8);
        words_put(out, "high", value + 3 * rows, rows, 8);
    }
    words_put(out, "points", mesh->point, (size_t)3 * mesh->points, 4);
    words_put(out, "facets", mesh->facet, (size_t)3 * mesh->facets, 4);
    words_put(out, "material", mesh->material, mesh->facets, 4);
    fputs("}</script>\n", out);
    free(value);
    return 0;
}

/* ---- the page ---- */

/* Nothing may be loaded. */
static const char explore_policy[] =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
    "'unsafe-inline'; script-src 'unsafe-inline'\" />\n";

static void page_notes(FILE *out, const report_job *job, const explore_mesh *mesh)
{
    const report_sweep *map = &job->sweep[REPORT_MAP];
    cli_page(out,
             "<p class=\"faint\">The map was computed in steps of %u\xc2\xb0 of azimuth and "
             "elevation; \xcf\x83 and its proved bound are read off at its nearest direction, and "
             "nothing is interpolated.%s ",
             job->map_step,
             map->plot.materials_assumed
                 ? " They hold for the materials given, which are illustrative or "
                   "assumed."
                 : "");
    if (mesh->facets < mesh->all) {
        cli_page(out,
                 "The body is drawn with %u of its %u facets, vertices close to each other "
                 "joined: the drawing is coarser than what was computed. ",
                 mesh->facets, mesh->all);
    } else {
        cli_page(out, "The body is drawn with all of its %u facets. ", mesh->all);
    }
    fprintf(out,
            "Dark grey: the back of a surface that reflects from its front only.</p>\n</main>\n"
            "<footer><p>Made by lrcs %s; scene hash <code>%016llx</code>. This page loads "
            "nothing.</p></footer>\n",
            lrcs_version(), (unsigned long long)lrcs_scene_hash(&job->run.scene.scene));
}

int cli_report_explore_page(FILE *out, const void *context, lrcs_host_error *error)
{
    const report_job *job = context;
    explore_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    cli_report_head(out, job, "", ", explorer", explore_policy, explore_style);
    fputs("</header>\n<main>\n", out);
    fwrite(explore_controls, 1, sizeof explore_controls, out);
    int code = explore_data_put(out, job, &mesh);
    page_notes(out, job, &mesh);
    fputs("<script>\n", out);
    fwrite(explore_script, 1, sizeof explore_script, out);
    fputs("</script>\n</body>\n</html>\n", out);
    free(mesh.point);
    free(mesh.facet);
    free(mesh.material);
    if (code != 0) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return LRCS_E_SYSTEM;
    }
    return LRCS_OK;
}
