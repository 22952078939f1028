/* SPDX-License-Identifier: MIT */
/* The content of a kit as tables: materials.csv and cases.csv, which suffice for taking part, and
   kit.json, the same in one file for programs that prefer it; and README.md, which is readme.md
   with the list of scenes. */
#include "cli/vectors/vectors.h"

static const char readme_text[] = {
#include "readme.inc"
};

static const char *const tier_text[KIT_TIERS] = {
    "one plate: the angle, 4 pi, the cosines, the BRDF",
    "convex bodies: frames, handedness, materials, back faces", "bodies that shadow themselves",
    "satellites: many facets, narrow glints",
    "hard cases: skins, slivers, far and tiny and huge, edge-on, piercing"};

static void numbers_print(FILE *out, const double *value, int count)
{
    for (int i = 0; i < count; i++) {
        cli_number_put(out, ",", value[i]);
    }
}

static int materials_write(FILE *out, const void *context, lrcs_host_error *error)
{
    (void)context;
    (void)error;
    fputs(KIT_MATERIALS_HEAD "\n", out);
    for (uint32_t i = 0; cli_vectors_materials[i].name; i++) {
        const vectors_material *material = &cli_vectors_materials[i];
        const double value[4] = {material->brdf.A, material->brdf.B, material->brdf.s,
                                 material->brdf.m};
        fputs(material->name, out);
        numbers_print(out, value, 4);
        fprintf(out, ",%d\n", material->two_sided);
    }
    return LRCS_OK;
}

static int cases_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const vectors_job *job = context;
    (void)error;
    fputs(KIT_CASES_HEAD "\n", out);
    for (uint32_t i = 0; i < job->cases; i++) {
        const vectors_case *one = &job->list[i];
        const lrcs_result *r = &one->result;
        const double sum[7] = {r->sigma_m2,         r->bound_m2,          r->sigma_glint_m2,
                               r->sigma_diffuse_m2, r->projected_area_m2, one->float_m2,
                               one->edge_m2};
        fprintf(out, "%s,%s,%d", one->scene->name, one->attitude->name, one->scene->tier);
        numbers_print(out, one->quaternion, 4);
        numbers_print(out, one->direction, 3);
        numbers_print(out, one->azel_deg, 2);
        numbers_print(out, sum, 7);
        numbers_print(out, one->window, 3);
        fprintf(out, ",%lu\n", one->image ? (unsigned long)job->resolution : 0UL);
    }
    return LRCS_OK;
}

static void json_list(lrcs_host_json *json, const char *key, const double *value, int count)
{
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_ARRAY);
    for (int i = 0; i < count; i++) {
        lrcs_host_json_number(json, NULL, value[i]);
    }
    lrcs_host_json_end(json);
}

static void case_json(lrcs_host_json *json, const vectors_job *job, const vectors_case *one)
{
    const lrcs_result *r = &one->result;
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_text(json, "scene", one->scene->name);
    lrcs_host_json_text(json, "attitude", one->attitude->name);
    lrcs_host_json_count(json, "tier", (uint64_t)one->scene->tier);
    json_list(json, "quaternion", one->quaternion, 4);
    json_list(json, "s_hat", one->direction, 3);
    json_list(json, "azel_deg", one->azel_deg, 2);
    lrcs_host_json_number(json, "sigma_m2", r->sigma_m2);
    lrcs_host_json_number(json, "bound_m2", r->bound_m2);
    lrcs_host_json_number(json, "glint_m2", r->sigma_glint_m2);
    lrcs_host_json_number(json, "diffuse_m2", r->sigma_diffuse_m2);
    lrcs_host_json_number(json, "silhouette_m2", r->projected_area_m2);
    lrcs_host_json_number(json, "float_m2", one->float_m2);
    lrcs_host_json_number(json, "edge_m2", one->edge_m2);
    json_list(json, "window_m", one->window, 3);
    lrcs_host_json_count(json, "image", one->image ? job->resolution : 0);
    lrcs_host_json_end(json);
}

static void tiers_json(lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "tiers", LRCS_HOST_ARRAY);
    for (int i = 0; i < KIT_TIERS; i++) {
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_count(json, "tier", (uint64_t)i + 1);
        lrcs_host_json_text(json, "about", tier_text[i]);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
}

static void materials_list(lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "materials", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; cli_vectors_materials[i].name; i++) {
        const vectors_material *material = &cli_vectors_materials[i];
        const double brdf[4] = {material->brdf.A, material->brdf.B, material->brdf.s,
                                material->brdf.m};
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "name", material->name);
        json_list(json, "A_B_s_m", brdf, 4);
        lrcs_host_json_bool(json, "two_sided", material->two_sided);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
}

static int kit_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const vectors_job *job = context;
    lrcs_host_json json = lrcs_host_json_make(out);
    (void)error;
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    lrcs_host_json_count(&json, "schema", CLI_SCHEMA);
    lrcs_host_json_count(&json, "kit", KIT_VERSION);
    lrcs_host_json_text(&json, "lrcs", lrcs_version());
    tiers_json(&json);
    materials_list(&json);
    lrcs_host_json_begin(&json, "scenes", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; cli_vectors_scenes[i].name; i++) {
        lrcs_host_json_begin(&json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(&json, "name", cli_vectors_scenes[i].name);
        lrcs_host_json_count(&json, "tier", (uint64_t)cli_vectors_scenes[i].tier);
        lrcs_host_json_text(&json, "about", cli_vectors_scenes[i].about);
        lrcs_host_json_end(&json);
    }
    lrcs_host_json_end(&json);
    lrcs_host_json_begin(&json, "cases", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < job->cases; i++) {
        case_json(&json, job, &job->list[i]);
    }
    lrcs_host_json_end(&json);
    lrcs_host_json_end(&json);
    return LRCS_OK;
}

static int readme_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const vectors_job *job = context;
    (void)error;
    fwrite(readme_text, 1, sizeof readme_text, out);
    fprintf(out,
            "## Scenes (kit %d, %lu cases)\n\n| tier | scene | what it tries |\n|---|---|---|\n",
            KIT_VERSION, (unsigned long)job->cases);
    for (uint32_t i = 0; i < job->cases; i++) {
        const vectors_scene *scene = job->list[i].scene;
        if (i == 0 || scene != job->list[i - 1].scene) {
            fprintf(out, "| %d | `%s` | %s |\n", scene->tier, scene->name, scene->about);
        }
    }
    return LRCS_OK;
}

int cli_vectors_index(const vectors_job *job)
{
    static const struct {
        const char *name;
        cli_writer *write;
    } file[] = {{KIT_MATERIALS_FILE, materials_write},
                {KIT_CASES_FILE, cases_write},
                {"README.md", readme_write},
                {"kit.json", kit_write}};
    int code = 0;
    for (size_t i = 0; i < sizeof file / sizeof file[0] && code == 0; i++) {
        char path[KIT_PATH];
        code = cli_kit_path(path, "%s/%s", job->folder, file[i].name);
        code = code ? code : cli_output_write(path, file[i].write, job);
    }
    return code;
}
