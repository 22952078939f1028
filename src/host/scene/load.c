/* SPDX-License-Identifier: MIT */
/* From a path to a scene, and on to sigma. It decides the kind of a file, the folders of the files
   that it names, and which notices to issue. The core computes the geometry. */
#include "host/files/input.h"
#include "host/run/levels.h"
#include "host/scene/binding.h"
#include "host/scene/demo.h"
#include "host/scene/model.h"
#include "host/scene/notes.h"
#include "host/scene/sides.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

lrcs_host_options lrcs_host_options_default(void)
{
    lrcs_host_options options = {0};
    options.build = lrcs_build_options_default();
    return options;
}

/* ---- the recipe ---- */

static int names_scene_file(const char *path)
{
    const char *dot = strrchr(lrcsi_host_basename(path), '.');
    return dot && strcasecmp(dot, ".toml") == 0;
}

/* Appends to an error the material of the library, or the kind of shape, that an unknown name may
   mean. Materials of the file itself are not known when it could not be read. */
static void nearest_append(lrcs_host_error *error, int status, const lrcs_where *where)
{
    int shape = where->item && strcmp(where->item, "shape") == 0;
    int material =
        where->item && (strcmp(where->item, "material") == 0 || strcmp(where->item, "like") == 0);
    char text[sizeof where->found];
    size_t quote = strspn(where->found, "\"'"); /* a value is quoted as it stands in the file */
    size_t size = strcspn(where->found + quote, "\"'");
    const char *best = NULL;
    if (!error || status != LRCS_E_NAME || (!shape && !material)) {
        return;
    }
    memcpy(text, where->found + quote, size);
    text[size] = '\0';
    const lrcs_brdf_entry *entry;
    for (uint32_t i = 0; material && (entry = lrcs_brdf_library(i)) != NULL; i++) {
        best = lrcs_host_name_nearer(text, best, entry->name);
    }
    for (int i = 0; shape && i < LRCS_SHAPE_KINDS; i++) {
        best = lrcs_host_name_nearer(text, best, lrcs_shape_text(i));
    }
    if (best && lrcs_host_name_is_near(text, best)) {
        lrcs_host_append(error->text, sizeof error->text, "; the nearest%s is %s",
                         material ? " in the library" : "", best);
    }
}

/* The recipe's texts may point into the file's: the scene keeps those bytes. */
static int recipe_from_text(lrcs_host_scene *scene, const char *path, const char *text, size_t size,
                            lrcs_host_error *error)
{
    const char *kept = lrcsi_host_copy(scene, text, size);
    if (!kept) {
        return lrcsi_host_fail_memory(error, size);
    }
    lrcs_where where = {0};
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt = lrcsi_host_attempt_make(&area, lrcs_recipe_need(size));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = lrcs_recipe_read(kept, size, &attempt.work, &scene->recipe, &where);
    }
    int status = lrcsi_host_attempt_keep(&attempt, &scene->blocks);
    if (status == LRCS_OK || status == LRCS_E_SYSTEM) {
        return status;
    }
    lrcsi_host_fail_where(error, status, path, &where);
    nearest_append(error, status, &where);
    if (error && strcmp(path, "demo") != 0 && !names_scene_file(path)) {
        size_t used = strlen(error->text);
        snprintf(error->text + used, sizeof error->text - used,
                 "; it is not a 3DS, OBJ or STL model and was read as a scene file");
    }
    return status;
}

/* A recipe for a single model file: one part, converted to metres by its unit. */
static int recipe_from_model(lrcs_host_scene *scene, const char *path, double unit_m,
                             lrcs_host_error *error)
{
    lrcs_recipe_part *part = lrcsi_host_take(scene, 1, sizeof *part);
    char *file = lrcsi_host_copy(scene, path, strlen(path));
    if (!part || !file) {
        return lrcsi_host_fail_memory(error, sizeof *part);
    }
    part->name = lrcsi_host_basename(file);
    part->file = file;
    part->place = lrcs_place_default();
    part->material_index = -1;
    for (int k = 0; k < 3; k++) {
        part->place.scale[k] = unit_m > 0.0 ? unit_m : 1.0;
    }
    part->unit_m = unit_m;
    scene->recipe.part = part;
    scene->recipe.part_count = 1;
    return LRCS_OK;
}

/* Bindings of the command line before those of the scene file. */
static int bindings_add(lrcs_host_scene *scene, const lrcs_host_options *options,
                        lrcs_host_error *error)
{
    lrcs_recipe *recipe = &scene->recipe;
    size_t count = (size_t)options->binding_count + recipe->binding_count;
    if (options->binding_count == 0) {
        return LRCS_OK;
    }
    lrcs_binding *all = lrcsi_host_take(scene, count, sizeof *all);
    if (!all) {
        return lrcsi_host_fail_memory(error, count * sizeof *all);
    }
    uint32_t used = 0;
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        all[used++] = recipe->binding[i];
    }
    for (uint32_t i = 0; i < options->binding_count; i++) {
        all[used] = options->binding[i];
        if (all[used].source == 0) {
            all[used].source = 1 + recipe->material_count + used; /* a pattern's names share it */
        }
        used++;
    }
    recipe->binding = all;
    recipe->binding_count = used;
    return LRCS_OK;
}

static int recipe_from_file(lrcs_host_scene *scene, const char *path, const lrcs_host_file *file,
                            const lrcs_host_options *options, lrcs_host_error *error)
{
    int toml = names_scene_file(path);
    if (!toml && lrcs_format_check(file->bytes, file->size, lrcsi_host_basename(path)) !=
                     LRCS_FORMAT_UNKNOWN) {
        return recipe_from_model(scene, path, options->unit_m, error);
    }
    if (!toml && memchr(file->bytes, 0, file->size)) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX,
                               "%s: not a 3DS, OBJ or STL model, and not a scene file: expected one"
                               " of these, found binary data",
                               path);
    }
    if (options->unit_m > 0.0) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT, "%s: a scene file states its own units",
                               path);
    }
    return recipe_from_text(scene, path, (const char *)file->bytes, file->size, error);
}

/* ---- the scene ---- */

static int scene_from_recipe(lrcs_host_scene *scene, const char *path,
                             const lrcs_build_options *options, lrcs_host_error *error)
{
    lrcs_where where = {0};
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(&area, lrcs_scene_need(&scene->recipe, scene->model, options));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = lrcs_scene_build(&scene->recipe, scene->model, options, &attempt.work,
                                          &scene->scene, &where);
    }
    int status = lrcsi_host_attempt_keep(&attempt, &scene->blocks);
    if (status == LRCS_OK && scene->two_sided) {
        return lrcsi_host_sides(scene, scene->two_sided, error);
    }
    return status == LRCS_OK || status == LRCS_E_SYSTEM
               ? status
               : lrcsi_host_fail_where(error, status, path, &where);
}

/* The line of the key `file` of the part that begins at a line of a scene file. */
static uint32_t file_key_line(const lrcs_host_file *scene_file, uint32_t first)
{
    const char *at = (const char *)scene_file->bytes;
    const char *end = at ? at + scene_file->size : at;
    for (uint32_t line = 1; at < end; line++) {
        const char *next = memchr(at, '\n', (size_t)(end - at));
        while (at < end && (*at == ' ' || *at == '\t')) {
            at++;
        }
        if (line >= first && end - at > 4 && memcmp(at, "file", 4) == 0 &&
            strchr(" \t=", at[4]) != NULL) {
            return line;
        }
        at = next ? next + 1 : end;
    }
    return first;
}

/* Puts before an error about a part's model the line that names the file, and after it where a
   relative name was looked for. */
static void model_error_locate(lrcs_host_error *error, int status, const char *path,
                               const lrcs_host_file *scene_file, const lrcs_recipe_part *part)
{
    char cause[sizeof error->text];
    char here[256] = ".";
    int folder = (int)(lrcsi_host_basename(path) - path);
    int relative = part->file[0] != '/';
    strcpy(cause, error->text);
    cause[sizeof cause / 2] = '\0';
    if (folder == 0 && !getcwd(here, sizeof here)) {
        strcpy(here, ".");
    }
    lrcsi_host_fail(error, status, "%s: line %lu: %s%s%.*s", path,
                    (unsigned long)file_key_line(scene_file, part->line), cause,
                    relative ? "; looked for in the scene file's folder, " : "",
                    relative ? (folder > 0 ? folder : (int)strlen(here)) : 0,
                    folder > 0 ? path : here);
}

/* Every part's model; a file named twice is read twice, because that is rare and the code is
   simpler. */
static int models_read(lrcs_host_scene *scene, const char *path, const lrcs_host_file *given,
                       lrcs_host_error *error)
{
    lrcs_recipe *recipe = &scene->recipe;
    scene->model = lrcsi_host_take(scene, recipe->part_count, sizeof *scene->model);
    if (!scene->model) {
        return lrcsi_host_fail_memory(error, recipe->part_count * sizeof *scene->model);
    }
    int status = LRCS_OK;
    for (uint32_t i = 0; i < recipe->part_count && status == LRCS_OK; i++) {
        if (!recipe->part[i].file) {
            continue;
        }
        const double unit_m = recipe->part[i].unit_m > 0.0 ? recipe->part[i].unit_m : -1.0;
        if (strcmp(recipe->part[i].file, path) == 0) { /* the given model is already in memory */
            scene->input->unit_m = unit_m;
            status = lrcsi_host_model_read(scene, path, given, &scene->model[i], error);
            continue;
        }
        lrcs_host_file file = {NULL, 0};
        const char *name = lrcsi_host_beside(scene, path, recipe->part[i].file);
        status = name ? lrcsi_host_input_read(scene, name, &file, error)
                      : lrcsi_host_fail_memory(error, 1);
        if (status == LRCS_OK) {
            scene->input->unit_m = unit_m;
            status = lrcsi_host_model_read(scene, name, &file, &scene->model[i], error);
            lrcs_host_file_free(&file);
        } else if (error && recipe->part[i].line != 0) {
            model_error_locate(error, status, path, given, &recipe->part[i]);
        }
    }
    return status;
}

/* ---- in public ---- */

int lrcs_host_scene_read(const char *path, const lrcs_host_options *options, lrcs_host_scene *scene,
                         lrcs_host_error *error)
{
    double start = lrcsi_host_seconds();
    lrcs_host_file file = {NULL, 0};
    memset(scene, 0, sizeof *scene);
    int status = LRCS_OK;
    if (strcmp(path, "demo") == 0) {
        size_t size = 0;
        const char *text = lrcsi_host_demo(&size);
        status = options->unit_m > 0.0
                     ? lrcsi_host_fail(error, LRCS_E_ARGUMENT, "demo states its own units")
                     : recipe_from_text(scene, path, text, size, error);
    } else {
        status = lrcsi_host_input_read(scene, path, &file, error);
        if (status == LRCS_OK) {
            scene->input->unit_m = 1.0; /* of a scene file; a model's own is set where it is read */
            status = recipe_from_file(scene, path, &file, options, error);
        }
    }
    if (status == LRCS_OK) {
        scene->recipe.keep_transparent |= options->keep_transparent;
        scene->two_sided = options->two_sided;
        status = bindings_add(scene, options, error);
    }
    if (status == LRCS_OK) {
        status = models_read(scene, path, &file, error);
    }
    lrcs_host_file_free(&file);
    if (status == LRCS_OK) {
        status = lrcsi_host_bindings_expand(scene, error);
    }
    if (status == LRCS_OK) {
        status = scene_from_recipe(scene, path, &options->build, error);
    }
    if (status != LRCS_OK) {
        lrcs_host_scene_free(scene);
        return status;
    }
    scene->levels = lrcsi_host_levels_make(scene, &options->build);
    lrcsi_host_scene_notes(scene, scene->notices.count);
    scene->seconds_load = lrcsi_host_seconds() - start;
    return LRCS_OK;
}

/* A copy of an array, owned by the scene; NULL if there is no memory. */
static void *array_copy(lrcs_host_scene *scene, const void *array, size_t count, size_t size)
{
    void *copy = lrcsi_host_take(scene, count + 1, size);
    if (copy && count > 0) {
        memcpy(copy, array, count * size);
    }
    return copy;
}

/* Finer divisions of a scene of the caller's recipe, of which the scene keeps a copy for them.
   There are none if there is no memory. */
static void levels_add(lrcs_host_scene *scene, const lrcs_recipe *recipe,
                       const lrcs_build_options *build)
{
    lrcs_recipe own = *recipe;
    own.part = array_copy(scene, recipe->part, recipe->part_count, sizeof *own.part);
    own.material =
        array_copy(scene, recipe->material, recipe->material_count, sizeof *own.material);
    own.binding = array_copy(scene, recipe->binding, recipe->binding_count, sizeof *own.binding);
    if (own.part && own.material && own.binding) {
        scene->recipe = own;
        scene->levels = lrcsi_host_levels_make(scene, build);
    }
}

/* A scene of the caller's recipe and of the caller's models (or NULL). */
static int scene_from(const lrcs_recipe *recipe, lrcs_mesh *model, const char *two_sided,
                      const lrcs_build_options *build, lrcs_host_scene *scene,
                      lrcs_host_error *error)
{
    double start = lrcsi_host_seconds();
    memset(scene, 0, sizeof *scene);
    scene->recipe = *recipe;
    scene->two_sided = two_sided;
    scene->model =
        model ? model : lrcsi_host_take(scene, (size_t)recipe->part_count + 1, sizeof *model);
    int status = scene->model ? scene_from_recipe(scene, "scene", build, error)
                              : lrcsi_host_fail_memory(error, sizeof *scene->model);
    if (status != LRCS_OK) {
        lrcs_host_scene_free(scene);
        return status;
    }
    memset(&scene->recipe, 0, sizeof scene->recipe);
    if (build->division > 0.0) {
        levels_add(scene, recipe, build);
    }
    scene->seconds_load = lrcsi_host_seconds() - start;
    return LRCS_OK;
}

int lrcs_host_scene_make(const lrcs_recipe *recipe, const lrcs_build_options *build,
                         lrcs_host_scene *scene, lrcs_host_error *error)
{
    return scene_from(recipe, NULL, NULL, build, scene, error);
}

int lrcs_host_scene_vary(const lrcs_host_scene *base, const lrcs_recipe *recipe,
                         const lrcs_build_options *build, lrcs_host_scene *scene,
                         lrcs_host_error *error)
{
    return scene_from(recipe, base->model, base->two_sided, build, scene, error);
}

int lrcs_host_scene_refine(lrcs_host_scene *scene, const lrcs_run_options *options,
                           const lrcs_result *result, const double *part_error_m2,
                           lrcs_build_options *build)
{
    const lrcsi_host_level *level = lrcsi_host_finer(scene, options, result, part_error_m2, NULL);
    if (!level) {
        return 0;
    }
    uint32_t kept = lrcsi_host_level_adopt(scene, level, &build->halvings);
    if (scene->notices.count > kept) {
        lrcsi_host_scene_notes(scene, kept);
    }
    return 1;
}
