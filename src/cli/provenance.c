/* SPDX-License-Identifier: MIT */
/* What a result was made from, as outputs state it: the scene's title, its files with their hashes,
   the unit, the assigned materials and the origin of their numbers, the options given. */
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>

const char *cli_scene_title(const cli_args *args, const lrcs_host_scene *scene)
{
    return scene->recipe.name && scene->recipe.name[0] ? scene->recipe.name : args->operand;
}

static int brdf_same(const lrcs_brdf *a, const lrcs_brdf *b)
{
    return a->A == b->A && a->B == b->B && a->s == b->s && a->m == b->m;
}

const char *cli_material_source(const lrcs_material *material)
{
    const lrcs_brdf_entry *entry;
    const lrcs_brdf other = lrcs_brdf_default();
    if (!material->bound) {
        return brdf_same(&material->brdf, &other) ? "default" : "assumed";
    }
    for (uint32_t i = 0; (entry = lrcs_brdf_library(i)) != NULL; i++) {
        if (brdf_same(&material->brdf, &entry->brdf)) {
            return entry->source ? "published" : "illustrative";
        }
    }
    return "given";
}

int cli_errors_stated(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_brdf_error *e = &scene->material[i].error;
        if (e->A > 0.0 || e->B > 0.0 || e->s > 0.0 || e->m > 0.0) {
            return 1;
        }
    }
    return 0;
}

int cli_materials_open(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const lrcs_material *material = &scene->material[scene->facet_material[i]];
        if (!material->omitted && strcmp(cli_material_source(material), "given") != 0) {
            return 1;
        }
    }
    return 0;
}

const char *cli_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

void cli_table_head(FILE *out, const char *command, const char *title, const lrcs_host_scene *scene,
                    const double direction[3])
{
    fprintf(out, "# lrcs %s %s; scene_hash=%016llx; title=%s", lrcs_version(), command,
            (unsigned long long)lrcs_scene_hash(&scene->scene), cli_base_name(title));
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        fprintf(out, "; file=%s fnv1a:%016llx", cli_base_name(input->path),
                (unsigned long long)input->hash);
    }
    for (int k = 0; k < 3; k++) {
        cli_number_put(out, k == 0 ? "; direction=" : ",", direction[k]);
    }
}

void cli_version_json(lrcs_host_json *json)
{
    lrcs_host_json_count(json, "schema", CLI_SCHEMA);
    lrcs_host_json_text(json, "version", lrcs_version());
}

void cli_hash_json(uint64_t hash, lrcs_host_json *json)
{
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    lrcs_host_json_text(json, "scene_hash", text);
}

void cli_files_json(const lrcs_host_scene *scene, lrcs_host_json *json)
{
    char hash[32];
    lrcs_host_json_begin(json, "files", LRCS_HOST_ARRAY);
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        snprintf(hash, sizeof hash, "fnv1a:%016llx", (unsigned long long)input->hash);
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "name", input->path);
        lrcs_host_json_text(json, "hash", hash);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
}

void cli_brdf_json(const lrcs_brdf *brdf, lrcs_host_json *json)
{
    lrcs_host_json_number(json, "A", brdf->A);
    lrcs_host_json_number(json, "B", brdf->B);
    lrcs_host_json_number(json, "s", brdf->s);
    lrcs_host_json_number(json, "m", brdf->m);
}

void cli_brdf_error_json(const lrcs_brdf_error *error, lrcs_host_json *json)
{
    if (!(error->A > 0.0 || error->B > 0.0 || error->s > 0.0 || error->m > 0.0)) {
        return;
    }
    lrcs_host_json_number(json, "A_error", error->A);
    lrcs_host_json_number(json, "B_error", error->B);
    lrcs_host_json_number(json, "s_error", error->s);
    lrcs_host_json_number(json, "m_error", error->m);
    lrcs_host_json_begin(json, "correlation", LRCS_HOST_ROW_ARRAY);
    for (int i = 0; i < 6; i++) {
        lrcs_host_json_number(json, NULL, error->correlation[i]);
    }
    lrcs_host_json_end(json);
}

static void materials_json(const lrcs_scene *scene, lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "materials", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *material = &scene->material[i];
        uint32_t facets = 0;
        for (uint32_t f = 0; f < scene->facet_count; f++) {
            facets += scene->facet_material[f] == i;
        }
        if (facets == 0 || material->omitted) {
            continue;
        }
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "name", material->name);
        cli_brdf_json(&material->brdf, json);
        cli_brdf_error_json(&material->error, json);
        lrcs_host_json_bool(json, "two_sided", material->two_sided);
        lrcs_host_json_text(json, "source", cli_material_source(material));
        lrcs_host_json_count(json, "facets", facets);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
}

void cli_provenance_json(const cli_args *args, const lrcs_host_scene *scene, lrcs_host_json *json)
{
    char word[1200];
    lrcs_host_json_text(json, "title", cli_scene_title(args, scene));
    materials_json(&scene->scene, json);
    lrcs_host_json_begin(json, "options", LRCS_HOST_ROW_ARRAY);
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        snprintf(word, sizeof word, "%s%s%s%s", cli_dashes(given->name), given->name,
                 given->value ? "=" : "", given->value ? given->value : "");
        lrcs_host_json_text(json, NULL, word);
    }
    lrcs_host_json_end(json);
}

char *cli_provenance_text(const cli_args *args, const lrcs_host_scene *scene)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        return NULL;
    }
    fprintf(out, "lrcs %s; scene=%s; scene_hash=%016llx", lrcs_version(),
            cli_base_name(args->operand), (unsigned long long)lrcs_scene_hash(&scene->scene));
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        fprintf(out, "; file=%s fnv1a:%016llx", cli_base_name(input->path),
                (unsigned long long)input->hash);
    }
    const char *before = "; options: ";
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        if (cli_is_output(args->command, given->name)) {
            continue; /* a result does not depend on where it is written */
        }
        fprintf(out, "%s%s%s%s%s", before, cli_dashes(given->name), given->name,
                given->value ? "=" : "", given->value ? given->value : "");
        before = " ";
    }
    for (uint32_t i = 0; i < scene->scene.material_count; i++) {
        const lrcs_material *material = &scene->scene.material[i];
        const lrcs_brdf *brdf = &material->brdf;
        fprintf(out, "; material %s=%.6g,%.6g,%.6g,%.6g %s", cli_material_name(material), brdf->A,
                brdf->B, brdf->s, brdf->m, cli_material_source(material));
    }
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}
