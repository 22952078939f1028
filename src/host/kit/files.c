/* SPDX-License-Identifier: MIT */
/* The content of a kit's files. Each scene as OBJ with its MTL, as STL and as JSON: the same facets
   in the same order in each, with all digits of the numbers; STL has no materials, JSON contains
   everything. Then the tables materials.csv and cases.csv, which suffice for taking part; kit.json,
   the same in one file for programs that prefer it; and README.md, which is readme.md with the list
   of scenes. */
#include "host/kit/vectors.h"

#include <string.h>

#define KIT_SCHEMA 1 /* of the keys in JSON files */

/* ---- a scene ---- */

typedef struct files_scene {
    const lrcsi_vectors_scene *scene;
    const lrcsi_vectors_mesh *mesh;
} files_scene;

static void point_print(FILE *out, const lrcs_point *point)
{
    for (int k = 0; k < 3; k++) {
        lrcs_host_number_put(out, " ", point->x[k]);
    }
    putc('\n', out);
}

static int obj_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const files_scene *file = context;
    (void)error;
    const lrcsi_vectors_mesh *mesh = file->mesh;
    fprintf(out, "# %s: %s; metres\nmtllib %s.mtl\no %s\n", file->scene->name, file->scene->about,
            file->scene->name, file->scene->name);
    for (uint32_t i = 0; i < mesh->vertices; i++) {
        putc('v', out);
        point_print(out, &mesh->vertex[i]);
    }
    for (uint32_t i = 0; i < mesh->facets; i++) {
        const uint32_t *v = mesh->facet[i].corner;
        if (i == 0 || mesh->material[i] != mesh->material[i - 1]) {
            fprintf(out, "usemtl %s\n", lrcsi_vectors_materials[mesh->material[i]].name);
        }
        fprintf(out, "f %lu %lu %lu\n", v[0] + 1UL, v[1] + 1UL, v[2] + 1UL);
    }
    return LRCS_OK;
}

static int mesh_uses(const lrcsi_vectors_mesh *mesh, uint32_t material)
{
    uint32_t i = 0;
    while (i < mesh->facets && mesh->material[i] != material) {
        i++;
    }
    return i < mesh->facets;
}

static int mtl_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const files_scene *file = context;
    (void)error;
    fputs("# colours for viewers; how a material reflects is in materials.csv\n", out);
    for (uint32_t i = 0; lrcsi_vectors_materials[i].name; i++) {
        const lrcsi_vectors_material *material = &lrcsi_vectors_materials[i];
        if (mesh_uses(file->mesh, i)) {
            fprintf(out, "newmtl %s\nKd", material->name);
            for (int k = 0; k < 3; k++) {
                lrcs_host_number_put(out, " ", material->rgb[k] / 255.0);
            }
            putc('\n', out);
        }
    }
    return LRCS_OK;
}

/* Normals are zero: in this format the reader then computes them. */
static int stl_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const files_scene *file = context;
    (void)error;
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
    return LRCS_OK;
}

static int json_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const files_scene *file = context;
    (void)error;
    const lrcsi_vectors_mesh *mesh = file->mesh;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\nschema=%u name=%s tier=%u about=%s materials=[\n", KIT_SCHEMA,
                       file->scene->name, file->scene->tier, file->scene->about);
    for (const lrcsi_vectors_material *one = lrcsi_vectors_materials; one->name; one++) {
        lrcs_host_json_put(&json, "{name=%s A=%g B=%g s=%g m=%g two_sided=%d}", one->name,
                           one->brdf.A, one->brdf.B, one->brdf.s, one->brdf.m, one->two_sided);
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
    return LRCS_OK;
}

int lrcsi_vectors_scene_write(const lrcsi_vectors_job *job, const lrcsi_vectors_scene *scene,
                              const lrcsi_vectors_mesh *mesh, lrcs_host_error *error)
{
    static const lrcsi_vectors_file file[] = {
        {"obj", obj_write}, {"mtl", mtl_write}, {"stl", stl_write}, {"json", json_write}};
    const files_scene context = {scene, mesh};
    char prefix[LRCSI_KIT_PATH];
    int status = lrcsi_kit_path(prefix, error, "%s/scenes/%s.", job->folder, scene->name);
    return status == LRCS_OK ? lrcsi_vectors_write(prefix, file, 4, &context, error) : status;
}

/* ---- the index ---- */

static const char readme_text[] = {
#include "readme.inc"
};

static const char *const tier_text[LRCS_HOST_KIT_TIERS] = {
    "one plate: the angle, 4 pi, the cosines, the BRDF",
    "convex bodies: frames, handedness, materials, back faces", "bodies that shadow themselves",
    "satellites: many facets, narrow glints",
    "hard cases: close surfaces, slivers, far and tiny and huge, edge-on, piercing"};

static void numbers_print(FILE *out, const double *value, int count)
{
    for (int i = 0; i < count; i++) {
        lrcs_host_number_put(out, ",", value[i]);
    }
}

static int materials_write(FILE *out, const void *context, lrcs_host_error *error)
{
    (void)error;
    (void)context;
    fputs("material,A,B,s,m,two_sided\n", out);
    for (uint32_t i = 0; lrcsi_vectors_materials[i].name; i++) {
        const lrcsi_vectors_material *material = &lrcsi_vectors_materials[i];
        const double value[4] = {material->brdf.A, material->brdf.B, material->brdf.s,
                                 material->brdf.m};
        fputs(material->name, out);
        numbers_print(out, value, 4);
        fprintf(out, ",%d\n", material->two_sided);
    }
    return LRCS_OK;
}

/* ---- cases, the same numbers as columns and as JSON ---- */

enum { CASE_NUMBERS = 11 };

/* The numbers of a case: their columns, and their key, with an array if they are several. */
static const struct {
    const char *columns, *key;
    int count;
} case_numbers[CASE_NUMBERS] = {
    {"qw,qx,qy,qz", "quaternion", 4},      {"sx,sy,sz", "s_hat", 3},
    {"az_deg,el_deg", "azel_deg", 2},      {"sigma_m2", "sigma_m2", 1},
    {"bound_m2", "bound_m2", 1},           {"glint_m2", "glint_m2", 1},
    {"diffuse_m2", "diffuse_m2", 1},       {"silhouette_m2", "silhouette_m2", 1},
    {"float_m2", "float_m2", 1},           {"edge_m2", "edge_m2", 1},
    {"left_m,top_m,side_m", "window_m", 3}};

/* Where they are. */
static void case_values(const lrcsi_vectors_case *one, const double *value[CASE_NUMBERS])
{
    const lrcs_result *r = &one->result;
    const double *const all[CASE_NUMBERS] = {
        one->quaternion, one->direction,     one->azel_deg,        &r->sigma_m2,
        &r->bound_m2,    &r->sigma_glint_m2, &r->sigma_diffuse_m2, &r->projected_area_m2,
        &one->float_m2,  &one->edge_m2,      one->window};
    memcpy(value, all, sizeof all);
}

static int cases_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const lrcsi_vectors_job *job = context;
    (void)error;
    const double *value[CASE_NUMBERS];
    fputs("scene,attitude,tier", out);
    for (int k = 0; k < CASE_NUMBERS; k++) {
        fprintf(out, ",%s", case_numbers[k].columns);
    }
    fputs(",image\n", out);
    for (uint32_t i = 0; i < job->cases; i++) {
        const lrcsi_vectors_case *one = &job->list[i];
        case_values(one, value);
        fprintf(out, "%s,%s,%d", one->scene->name, one->attitude->name, one->scene->tier);
        for (int k = 0; k < CASE_NUMBERS; k++) {
            numbers_print(out, value[k], case_numbers[k].count);
        }
        fprintf(out, ",%lu\n", one->image ? (unsigned long)job->resolution : 0UL);
    }
    return LRCS_OK;
}

/* ---- kit.json ---- */

static int kit_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const lrcsi_vectors_job *job = context;
    (void)error;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\nschema=%u kit=%u lrcs=%s tiers=[\n", KIT_SCHEMA,
                       LRCS_HOST_KIT_VERSION, lrcs_version());
    for (int i = 0; i < LRCS_HOST_KIT_TIERS; i++) {
        lrcs_host_json_put(&json, "{tier=%u about=%s}", i + 1, tier_text[i]);
    }
    lrcs_host_json_put(&json, "] materials=[\n");
    for (const lrcsi_vectors_material *one = lrcsi_vectors_materials; one->name; one++) {
        lrcs_host_json_put(&json, "{name=%s A_B_s_m=[%g %g %g %g] two_sided=%d}", one->name,
                           one->brdf.A, one->brdf.B, one->brdf.s, one->brdf.m, one->two_sided);
    }
    lrcs_host_json_put(&json, "] scenes=[\n");
    for (const lrcsi_vectors_scene *one = lrcsi_vectors_scenes; one->name; one++) {
        lrcs_host_json_put(&json, "{name=%s tier=%u about=%s}", one->name, one->tier, one->about);
    }
    lrcs_host_json_put(&json, "] cases=[\n");
    for (uint32_t i = 0; i < job->cases; i++) {
        const lrcsi_vectors_case *one = &job->list[i];
        const double *value[CASE_NUMBERS];
        case_values(one, value);
        lrcs_host_json_put(&json, "{scene=%s attitude=%s tier=%u", one->scene->name,
                           one->attitude->name, one->scene->tier);
        for (int k = 0; k < CASE_NUMBERS; k++) {
            if (case_numbers[k].count == 1) {
                lrcs_host_json_number(&json, case_numbers[k].key, *value[k]);
            } else {
                lrcs_host_json_numbers(&json, case_numbers[k].key, value[k],
                                       (uint32_t)case_numbers[k].count);
            }
        }
        lrcs_host_json_put(&json, "image=%u}", one->image ? job->resolution : 0);
    }
    lrcs_host_json_put(&json, "]}");
    return LRCS_OK;
}

static int readme_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const lrcsi_vectors_job *job = context;
    (void)error;
    fwrite(readme_text, 1, sizeof readme_text, out);
    fprintf(out,
            "## Scenes (kit %d, %lu cases)\n\n| tier | scene | what it tries |\n|---|---|---|\n",
            LRCS_HOST_KIT_VERSION, (unsigned long)job->cases);
    for (uint32_t i = 0; i < job->cases; i++) {
        const lrcsi_vectors_scene *scene = job->list[i].scene;
        if (i == 0 || scene != job->list[i - 1].scene) {
            fprintf(out, "| %d | `%s` | %s |\n", scene->tier, scene->name, scene->about);
        }
    }
    return LRCS_OK;
}

int lrcsi_vectors_index_write(const lrcsi_vectors_job *job, lrcs_host_error *error)
{
    static const lrcsi_vectors_file file[] = {{LRCS_HOST_KIT_MATERIALS_TEXT, materials_write},
                                              {LRCS_HOST_KIT_CASES_TEXT, cases_write},
                                              {"README.md", readme_write},
                                              {"kit.json", kit_write}};
    char prefix[LRCSI_KIT_PATH];
    int status = lrcsi_kit_path(prefix, error, "%s/", job->folder);
    return status == LRCS_OK ? lrcsi_vectors_write(prefix, file, 4, job, error) : status;
}
