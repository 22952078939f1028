/* SPDX-License-Identifier: MIT */
/* What a result was made from, as outputs state it: the scene's title, its files with their hashes,
   the unit, the assigned materials and the origin of their numbers, the options given. */
#include "cli/cli.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char *cli_scene_title(const cli_args *args, const lrcs_host_scene *scene)
{
    return scene->recipe.name && scene->recipe.name[0] ? scene->recipe.name : args->operand;
}

const char *cli_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

const char *cli_scene_name(const cli_args *args, const lrcs_host_scene *scene)
{
    const char *title = cli_scene_title(args, scene);
    return title == args->operand ? cli_base_name(title) : title;
}

void cli_scene_print(const cli_args *args, const lrcs_host_scene *scene)
{
    const char *title = cli_scene_title(args, scene);
    cli_column(title, 0);
    if (strcmp(title, args->operand) != 0) {
        printf(" (");
        cli_column(cli_base_name(args->operand), 0);
        putchar(')');
    }
}

static int brdf_same(const lrcs_brdf *a, const lrcs_brdf *b)
{
    return a->A == b->A && a->B == b->B && a->s == b->s && a->m == b->m;
}

const lrcs_brdf_entry *cli_brdf_entry(const lrcs_brdf *brdf)
{
    const lrcs_brdf_entry *entry = lrcs_brdf_library(0);
    for (uint32_t i = 1; entry && !brdf_same(brdf, &entry->brdf); i++) {
        entry = lrcs_brdf_library(i);
    }
    return entry;
}

const char *cli_material_source(const lrcs_material *material)
{
    const lrcs_brdf other = lrcs_brdf_default();
    if (!material->brdf_given) {
        return brdf_same(&material->brdf, &other) ? "default" : "assumed";
    }
    const lrcs_brdf_entry *entry = cli_brdf_entry(&material->brdf);
    return !entry ? "given" : entry->source ? "published" : "illustrative";
}

int cli_material_guessed(const lrcs_material *material)
{
    return !material->brdf_given && material->source != 0;
}

static int error_stated(const lrcs_brdf_error *e)
{
    return e->A > 0.0 || e->B > 0.0 || e->s > 0.0 || e->m > 0.0;
}

int cli_errors_stated(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (error_stated(&scene->material[i].error)) {
            return 1;
        }
    }
    return 0;
}

int cli_materials_assumed(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const lrcs_material *material = &scene->material[scene->facet_material[i]];
        if (!material->omitted && strcmp(cli_material_source(material), "given") != 0) {
            return 1;
        }
    }
    return 0;
}

/* The hash of a file; that of no bytes if it cannot be read. */
static uint64_t file_hash(const char *path)
{
    lrcs_host_file file;
    uint64_t hash = LRCS_HOST_HASH_START;
    if (lrcs_host_file_read(path, &file, NULL) == LRCS_OK) {
        hash = lrcs_host_hash(hash, file.bytes, file.size);
        lrcs_host_file_free(&file);
    }
    return hash;
}

void cli_line_put(FILE *out, const char *before, const char *text)
{
    fputs(before, out);
    cli_column_to(out, text, 0);
}

void cli_file_text(const lrcs_host_input *input, char text[CLI_FILE_TEXT])
{
    char words[CLI_UNIT_TEXT];
    const char *unit = cli_unit_text(input->unit_m, words);
    snprintf(text, CLI_FILE_TEXT, "%.300s fnv1a:%016llx%s%s", cli_base_name(input->path),
             (unsigned long long)input->hash, unit ? " unit=" : "", unit ? unit : "");
}

/* The operand as a file that holds no lengths. */
static lrcs_host_input operand_input(const cli_args *args)
{
    return (lrcs_host_input){.path = args->operand, .hash = file_hash(args->operand)};
}

/* "; key=text" for the scene, or if that is NULL for the operand as a file; options; files. */
static void source_put(FILE *out, const cli_args *args, const char *title,
                       const lrcs_host_scene *scene)
{
    char text[CLI_FILE_TEXT];
    if (scene) {
        fprintf(out, "; scene_hash=%016llx", (unsigned long long)lrcs_scene_hash(&scene->scene));
        cli_line_put(out, "; title=", cli_base_name(title));
    }
    const char *before =
        "; options="; /* not files: a result does not depend on where it is written */
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        if (!cli_is_output(args->command, given->name)) {
            fprintf(out, "%s%s%s", before, cli_dashes(given->name), given->name);
            cli_line_put(out, given->value ? "=" : "", given->value ? given->value : "");
            before = " ";
        }
    }
    if (!scene) {
        const lrcs_host_input input = operand_input(args);
        cli_file_text(&input, text);
        cli_line_put(out, "; file=", text);
    }
    for (const lrcs_host_input *input = scene ? scene->input : NULL; input; input = input->next) {
        cli_file_text(input, text);
        cli_line_put(out, "; file=", text);
    }
}

void cli_table_head(FILE *out, const cli_args *args, const char *title,
                    const lrcs_host_scene *scene, const double direction[3])
{
    fprintf(out, "lrcs %s %s", lrcs_version(), args->command->name);
    source_put(out, args, title, scene);
    for (int k = 0; k < 3; k++) {
        lrcs_host_number_put(out, k == 0 ? "; direction=" : ",", direction[k]);
    }
}

void cli_version_json(lrcs_host_json *json)
{
    lrcs_host_json_put(json, "schema=%u version=%s", CLI_SCHEMA, lrcs_version());
}

void cli_hash_json(uint64_t hash, lrcs_host_json *json)
{
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    lrcs_host_json_text(json, "scene_hash", text);
}

/* The members of a file, which an object is open for. */
static void file_json(const char *name, uint64_t hash, lrcs_host_json *json)
{
    char text[32];
    snprintf(text, sizeof text, "fnv1a:%016llx", (unsigned long long)hash);
    lrcs_host_json_put(json, "name=%s hash=%s", name, text);
}

static void input_json(const lrcs_host_input *input, lrcs_host_json *json)
{
    char words[CLI_UNIT_TEXT];
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    file_json(input->path, input->hash, json);
    lrcs_host_json_put(json, "unit=%s}", cli_unit_text(input->unit_m, words));
}

void cli_files_json(const lrcs_host_scene *scene, lrcs_host_json *json)
{
    lrcs_host_json_put(json, "files=[\n");
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        input_json(input, json);
    }
    lrcs_host_json_put(json, "]");
}

void cli_operand_json(const cli_args *args, lrcs_host_json *json)
{
    const lrcs_host_input input = operand_input(args);
    lrcs_host_json_put(json, "files=[\n");
    input_json(&input, json);
    lrcs_host_json_put(json, "]");
}

void cli_direction_json(const lrcs_pose *pose, lrcs_host_json *json)
{
    double s_hat[3];
    cli_pose_unit(pose, s_hat);
    lrcs_host_json_numbers(json, "direction", s_hat, 3);
}

void cli_brdf_json(const lrcs_brdf *brdf, lrcs_host_json *json)
{
    lrcs_host_json_put(json, "A=%g B=%g s=%g m=%g", brdf->A, brdf->B, brdf->s, brdf->m);
}

void cli_options_json(const cli_args *args, lrcs_host_json *json)
{
    char word[1200];
    lrcs_host_json_put(json, "options=[");
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        snprintf(word, sizeof word, "%s%s%s%s", cli_dashes(given->name), given->name,
                 given->value ? "=" : "", given->value ? given->value : "");
        lrcs_host_json_text(json, NULL, word);
    }
    lrcs_host_json_put(json, "]");
}

void cli_provenance_json(const cli_args *args, const lrcs_host_scene *host, lrcs_host_json *json)
{
    const lrcs_scene *scene = &host->scene;
    lrcs_host_json_put(json, "title=%s materials=[\n", cli_scene_title(args, host));
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *material = &scene->material[i];
        uint32_t facets = 0;
        for (uint32_t f = 0; f < scene->facet_count; f++) {
            facets += scene->facet_material[f] == i;
        }
        if (facets > 0 && !material->omitted) {
            lrcs_host_json_put(json, "{name=%s", material->name);
            cli_brdf_json(&material->brdf, json);
            const lrcs_brdf_error *error = &material->error;
            if (error_stated(error)) {
                lrcs_host_json_put(json, "A_error=%g B_error=%g s_error=%g m_error=%g", error->A,
                                   error->B, error->s, error->m);
                lrcs_host_json_numbers(json, "correlation", error->correlation, 6);
            }
            lrcs_host_json_put(json, "two_sided=%d source=%s facets=%u}", material->two_sided,
                               cli_material_source(material), facets);
        }
    }
    lrcs_host_json_put(json, "]");
    cli_options_json(args, json);
}

/* ---- beside a file of numbers ---- */

typedef struct provenance {
    const cli_args *args;
    const char *path;
    const lrcs_host_scene *scene; /* NULL: made from the operand alone */
    const lrcs_pose *pose;        /* or NULL */
    const char *about;            /* or NULL */
} provenance;

static void beside_write(FILE *out, const void *context)
{
    const provenance *from = context;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\nlrcs=%s", from->args->command->name);
    cli_version_json(&json);
    lrcs_host_json_begin(&json, "file", LRCS_HOST_ROW_OBJECT);
    file_json(cli_base_name(from->path), file_hash(from->path), &json);
    lrcs_host_json_put(&json, "}");
    if (from->about) {
        lrcs_host_json_put(&json, CLI_ABOUT "=%s", from->about);
    }
    if (from->scene) {
        cli_hash_json(lrcs_scene_hash(&from->scene->scene), &json);
        cli_files_json(from->scene, &json);
        lrcs_host_json_put(&json, "unit=%s", cli_scene_unit(from->args, from->scene));
    } else {
        cli_operand_json(from->args, &json);
    }
    if (from->pose) {
        cli_direction_json(from->pose, &json);
    }
    if (from->scene) {
        cli_provenance_json(from->args, from->scene, &json);
    } else {
        cli_options_json(from->args, &json);
    }
    lrcs_host_json_put(&json, "}");
}

char *cli_beside_name(const char *path)
{
    size_t room = strlen(path) + sizeof CLI_BESIDE;
    char *name = malloc(room);
    if (name) {
        snprintf(name, room, "%s" CLI_BESIDE, path);
    }
    return name;
}

int cli_provenance_beside(const cli_args *args, const char *path, const lrcs_host_scene *scene,
                          const lrcs_pose *pose, const char *about)
{
    const provenance from = {args, path, scene, pose, about};
    struct stat kind;
    if (strcmp(path, "-") == 0 || stat(path, &kind) != 0 || !S_ISREG(kind.st_mode)) {
        return 0; /* nothing stands beside standard output or a device */
    }
    char *name = cli_beside_name(path);
    if (!name) {
        return cli_out_of_memory();
    }
    lrcs_host_error error;
    int code = scene && lrcs_host_output_check(name, scene, &error) != LRCS_OK
                   ? cli_failed(&error)
                   : cli_text_write(name, beside_write, &from);
    free(name);
    return code;
}

/* ---- in one line ---- */

static void picture_put(FILE *out, const void *context)
{
    const provenance *from = context;
    const lrcs_host_scene *scene = from->scene;
    fprintf(out, "lrcs %s", lrcs_version());
    source_put(out, from->args, scene ? cli_scene_title(from->args, scene) : "", scene);
    for (uint32_t i = 0; scene && i < scene->scene.material_count; i++) {
        const lrcs_material *material = &scene->scene.material[i];
        const lrcs_brdf *brdf = &material->brdf;
        cli_line_put(out, "; material=", cli_material_name(material));
        fprintf(out, " %.6g,%.6g,%.6g,%.6g %s", brdf->A, brdf->B, brdf->s, brdf->m,
                cli_material_source(material));
    }
}

char *cli_provenance_text(const cli_args *args, const lrcs_host_scene *scene)
{
    const provenance from = {.args = args, .scene = scene};
    return cli_text_of(picture_put, &from);
}

char *cli_text_of(cli_text_writer *write, const void *context)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        write(out, context);
        if (fclose(out) != 0) {
            free(text);
            return NULL;
        }
    }
    return text;
}
