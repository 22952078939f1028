/* SPDX-License-Identifier: MIT */
/* The content of a kit as tables: materials.csv and cases.csv, which suffice for taking part, and
   kit.json, the same in one file for programs that prefer it; and README.md, which is readme.md
   with the list of scenes. */
#include "cli/vectors/vectors.h"

#include <string.h>

static const char readme_text[] = {
#include "readme.inc"
};

static const char *const tier_text[LRCS_HOST_KIT_TIERS] = {
    "one plate: the angle, 4 pi, the cosines, the BRDF",
    "convex bodies: frames, handedness, materials, back faces", "bodies that shadow themselves",
    "satellites: many facets, narrow glints",
    "hard cases: skins, slivers, far and tiny and huge, edge-on, piercing"};

static void numbers_print(FILE *out, const double *value, int count)
{
    for (int i = 0; i < count; i++) {
        lrcs_host_number_put(out, ",", value[i]);
    }
}

static void materials_write(FILE *out, const void *context)
{
    (void)context;
    fputs("material,A,B,s,m,two_sided\n", out);
    for (uint32_t i = 0; cli_vectors_materials[i].name; i++) {
        const vectors_material *material = &cli_vectors_materials[i];
        const double value[4] = {material->brdf.A, material->brdf.B, material->brdf.s,
                                 material->brdf.m};
        fputs(material->name, out);
        numbers_print(out, value, 4);
        fprintf(out, ",%d\n", material->two_sided);
    }
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
static void case_values(const vectors_case *one, const double *value[CASE_NUMBERS])
{
    const lrcs_result *r = &one->result;
    const double *const all[CASE_NUMBERS] = {
        one->quaternion, one->direction,     one->azel_deg,        &r->sigma_m2,
        &r->bound_m2,    &r->sigma_glint_m2, &r->sigma_diffuse_m2, &r->projected_area_m2,
        &one->float_m2,  &one->edge_m2,      one->window};
    memcpy(value, all, sizeof all);
}

static void cases_write(FILE *out, const void *context)
{
    const vectors_job *job = context;
    const double *value[CASE_NUMBERS];
    fputs("scene,attitude,tier", out);
    for (int k = 0; k < CASE_NUMBERS; k++) {
        fprintf(out, ",%s", case_numbers[k].columns);
    }
    fputs(",image\n", out);
    for (uint32_t i = 0; i < job->cases; i++) {
        const vectors_case *one = &job->list[i];
        case_values(one, value);
        fprintf(out, "%s,%s,%d", one->scene->name, one->attitude->name, one->scene->tier);
        for (int k = 0; k < CASE_NUMBERS; k++) {
            numbers_print(out, value[k], case_numbers[k].count);
        }
        fprintf(out, ",%lu\n", one->image ? (unsigned long)job->resolution : 0UL);
    }
}

/* ---- kit.json ---- */

static void kit_write(FILE *out, const void *context)
{
    const vectors_job *job = context;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\nschema=%u kit=%u lrcs=%s tiers=[\n", CLI_SCHEMA,
                       LRCS_HOST_KIT_VERSION, lrcs_version());
    for (int i = 0; i < LRCS_HOST_KIT_TIERS; i++) {
        lrcs_host_json_put(&json, "{tier=%u about=%s}", i + 1, tier_text[i]);
    }
    lrcs_host_json_put(&json, "] materials=[\n");
    for (const vectors_material *one = cli_vectors_materials; one->name; one++) {
        lrcs_host_json_put(&json, "{name=%s A_B_s_m=[%g %g %g %g] two_sided=%d}", one->name,
                           one->brdf.A, one->brdf.B, one->brdf.s, one->brdf.m, one->two_sided);
    }
    lrcs_host_json_put(&json, "] scenes=[\n");
    for (const vectors_scene *one = cli_vectors_scenes; one->name; one++) {
        lrcs_host_json_put(&json, "{name=%s tier=%u about=%s}", one->name, one->tier, one->about);
    }
    lrcs_host_json_put(&json, "] cases=[\n");
    for (uint32_t i = 0; i < job->cases; i++) {
        const vectors_case *one = &job->list[i];
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
}

static void readme_write(FILE *out, const void *context)
{
    const vectors_job *job = context;
    fwrite(readme_text, 1, sizeof readme_text, out);
    fprintf(out,
            "## Scenes (kit %d, %lu cases)\n\n| tier | scene | what it tries |\n|---|---|---|\n",
            LRCS_HOST_KIT_VERSION, (unsigned long)job->cases);
    for (uint32_t i = 0; i < job->cases; i++) {
        const vectors_scene *scene = job->list[i].scene;
        if (i == 0 || scene != job->list[i - 1].scene) {
            fprintf(out, "| %d | `%s` | %s |\n", scene->tier, scene->name, scene->about);
        }
    }
}

int cli_vectors_index(const vectors_job *job)
{
    static const vectors_file file[] = {{LRCS_HOST_KIT_MATERIALS_TEXT, materials_write, NULL},
                                        {LRCS_HOST_KIT_CASES_TEXT, cases_write, NULL},
                                        {"README.md", readme_write, NULL},
                                        {"kit.json", kit_write, NULL}};
    char prefix[KIT_PATH];
    int code = cli_kit_path(prefix, "%s/", job->folder);
    return code ? code : cli_vectors_write(prefix, file, 4, job);
}
