/* SPDX-License-Identifier: MIT */
/* Writes a scene of the kit as OBJ with its MTL, as STL and as JSON: the same facets in the same
   order in each, with all digits of the numbers. STL has no materials; JSON contains everything. */
#include "cli/vectors/vectors.h"

#include <stdarg.h>

typedef struct files_scene {
    const vectors_scene *scene;
    const vectors_mesh *mesh;
} files_scene;

static void point_print(FILE *out, const lrcs_point *point)
{
    for (int k = 0; k < 3; k++) {
        lrcs_host_number_put(out, " ", point->x[k]);
    }
    putc('\n', out);
}

static void obj_write(FILE *out, const void *context)
{
    const files_scene *file = context;
    const vectors_mesh *mesh = file->mesh;
    fprintf(out, "# %s: %s; metres\nmtllib %s.mtl\no %s\n", file->scene->name, file->scene->about,
            file->scene->name, file->scene->name);
    for (uint32_t i = 0; i < mesh->vertices; i++) {
        putc('v', out);
        point_print(out, &mesh->vertex[i]);
    }
    for (uint32_t i = 0; i < mesh->facets; i++) {
        const uint32_t *v = mesh->facet[i].corner;
        if (i == 0 || mesh->material[i] != mesh->material[i - 1]) {
            fprintf(out, "usemtl %s\n", cli_vectors_materials[mesh->material[i]].name);
        }
        fprintf(out, "f %lu %lu %lu\n", v[0] + 1UL, v[1] + 1UL, v[2] + 1UL);
    }
}

int cli_kit_path(char path[KIT_PATH], const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int size = vsnprintf(path, KIT_PATH, format, list);
    va_end(list);
    if (size < 0 || (unsigned)size >= KIT_PATH) {
        return cli_fail("a path of more than %u bytes", KIT_PATH);
    }
    return 0;
}

int cli_vectors_write(const char *prefix, const vectors_file *file, int count, const void *context)
{
    int code = 0;
    for (int i = 0; i < count && code == 0; i++) {
        char path[KIT_PATH];
        code = cli_kit_path(path, "%s%s", prefix, file[i].name);
        code = code            ? code
               : file[i].write ? cli_text_write(path, file[i].write, context)
                               : cli_output_write(path, file[i].picture, context);
    }
    return code;
}

static int mesh_uses(const vectors_mesh *mesh, uint32_t material)
{
    uint32_t i = 0;
    while (i < mesh->facets && mesh->material[i] != material) {
        i++;
    }
    return i < mesh->facets;
}

static void mtl_write(FILE *out, const void *context)
{
    const files_scene *file = context;
    fputs("# colours for viewers; how a material reflects is in materials.csv\n", out);
    for (uint32_t i = 0; cli_vectors_materials[i].name; i++) {
        const vectors_material *material = &cli_vectors_materials[i];
        if (mesh_uses(file->mesh, i)) {
            fprintf(out, "newmtl %s\nKd", material->name);
            for (int k = 0; k < 3; k++) {
                lrcs_host_number_put(out, " ", material->rgb[k] / 255.0);
            }
            putc('\n', out);
        }
    }
}

/* Normals are zero: in this format the reader then computes them. */
static void stl_write(FILE *out, const void *context)
{
    const files_scene *file = context;
    fprintf(out, "solid %s\n", file->scene->name);
    for (uint32_t i = 0; i < file->mesh->facets; i++) {
        fputs("facet normal 0 0 0\nouter loop\n", out);
        for (int k = 0; k < 3; k++) {
            fputs("vertex", out);
            point_print(out, &file->mesh->vertex[file->mesh->facet[i].corner[k]]);
        }
        fputs("endloop\nendfacet\n", out);
    }
    fprintf(out, "endsolid %s\n", file->scene->name);
}

static void json_write(FILE *out, const void *context)
{
    const files_scene *file = context;
    const vectors_mesh *mesh = file->mesh;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\nschema=%u name=%s tier=%u about=%s materials=[\n", CLI_SCHEMA,
                       file->scene->name, file->scene->tier, file->scene->about);
    for (const vectors_material *one = cli_vectors_materials; one->name; one++) {
        lrcs_host_json_put(&json, "{name=%s", one->name);
        cli_brdf_json(&one->brdf, &json);
        lrcs_host_json_put(&json, "two_sided=%d}", one->two_sided);
    }
    lrcs_host_json_put(&json, "] vertices_m=[\n");
    for (uint32_t i = 0; i < mesh->vertices; i++) {
        lrcs_host_json_numbers(&json, NULL, mesh->vertex[i].x, 3);
    }
    lrcs_host_json_put(&json, "] facets=[\n");
    for (uint32_t i = 0; i < mesh->facets; i++) {
        const uint32_t *v = mesh->facet[i].corner;
        lrcs_host_json_put(&json, "[%u %u %u]", v[0], v[1], v[2]);
    }
    lrcs_host_json_put(&json, "] facet_material=[");
    for (uint32_t i = 0; i < mesh->facets; i++) {
        lrcs_host_json_count(&json, NULL, mesh->material[i]);
    }
    lrcs_host_json_put(&json, "]}");
}

int cli_vectors_files(const vectors_job *job, const vectors_scene *scene, const vectors_mesh *mesh)
{
    static const vectors_file file[] = {{"obj", obj_write, NULL},
                                        {"mtl", mtl_write, NULL},
                                        {"stl", stl_write, NULL},
                                        {"json", json_write, NULL}};
    const files_scene context = {scene, mesh};
    char prefix[KIT_PATH];
    int code = cli_kit_path(prefix, "%s/scenes/%s.", job->folder, scene->name);
    return code ? code : cli_vectors_write(prefix, file, 4, &context);
}
