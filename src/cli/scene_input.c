/* SPDX-License-Identifier: MIT */
/* The scene of a command: the materials and the unit that the command line gives it, and how it is
   read, prepared and run, with the messages about failures. */
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>

/* Reads four numbers separated by commas, each with or without its "+-" deviation; 0, or -1. */
static int brdf_numbers(const char *text, double value[4], double deviation[4])
{
    for (int i = 0; i < 4; i++) {
        size_t size = strcspn(text, ",");
        const char *error = strstr(text, "+-");
        int has_error = error && error < text + size;
        size_t own = has_error ? (size_t)(error - text) : size;
        deviation[i] = 0.0;
        if ((text[size] == '\0') != (i == 3) ||
            lrcs_host_number_read(text, own, &value[i]) != LRCS_OK ||
            (has_error &&
             lrcs_host_number_read(error + 2, size - own - 2, &deviation[i]) != LRCS_OK)) {
            return -1;
        }
        text += size + 1;
    }
    return 0;
}

/* Reads four numbers, A+-DA,B+-DB,s+-DS,m+-DM, or the name of a library material. Each +- is one
   standard deviation; any may be omitted. */
static int brdf_error_read(const cli_command *command, const char *text, const char *option,
                           lrcs_brdf *brdf, lrcs_brdf_error *error)
{
    double v[4];
    double d[4];
    memset(error, 0, sizeof *error);
    if (brdf_numbers(text, v, d) == 0) {
        lrcs_brdf read = {v[0], v[1], v[2], v[3]};
        lrcs_brdf_error off = {.A = d[0], .B = d[1], .s = d[2], .m = d[3]};
        if (lrcs_brdf_check(&read) < 0) {
            return cli_usage(command,
                             "%s: %s: found '%s', expected A, B, m >= 0 and s > 0 (s = 0 only with "
                             "A = 0)",
                             option,
                             v[0] < 0.0   ? "A is negative"
                             : v[1] < 0.0 ? "B is negative"
                             : v[2] < 0.0 ? "s is negative"
                             : v[3] < 0.0 ? "m is negative"
                                          : "s is 0",
                             text);
        }
        if (lrcs_brdf_error_check(&read, &off) != LRCS_OK) {
            return cli_usage(command, "%s: an error (+-) is %s, found '%s'", option,
                             read.s == 0.0 ? "given for A or s, where s is 0" : "negative", text);
        }
        *brdf = read;
        *error = off;
        return 0;
    }
    const lrcs_brdf_entry *entry = lrcs_brdf_find(text);
    if (!entry) {
        const char *best = NULL;
        if (strchr(text, ',')) {
            return cli_usage(command, "%s: expected A,B,s,m (four finite numbers), found '%s'",
                             option, text);
        }
        for (uint32_t i = 0; (entry = lrcs_brdf_library(i)) != NULL; i++) {
            best = lrcs_host_name_nearer(text, best, entry->name);
        }
        int near = best && lrcs_host_name_is_near(text, best);
        return cli_usage(command,
                         "%s: expected A,B,s,m (four finite numbers) or a library material, found "
                         "'%s'; %s%s",
                         option, text, near ? "the nearest in the library is " : "'lrcs ",
                         near ? best : "run --help' lists the library");
    }
    *brdf = entry->brdf;
    *error = entry->error;
    return 0;
}

int cli_brdf_read(const cli_command *command, const char *text, const char *option, lrcs_brdf *brdf)
{
    lrcs_brdf_error error;
    int code = brdf_error_read(command, text, option, brdf, &error);
    if (code == 0 && !lrcs_brdf_find(text) &&
        (error.A > 0.0 || error.B > 0.0 || error.s > 0.0 || error.m > 0.0)) {
        return cli_usage(command, "%s: no errors (+-) here, found '%s'", option, text);
    }
    return code;
}

void cli_brdf_warnings_print(const char *name, const lrcs_brdf *brdf)
{
    int warnings = lrcs_brdf_check(brdf);
    for (int bit = 1; warnings > 0 && bit <= warnings; bit *= 2) {
        if (warnings & bit) {
            fprintf(stderr, "notice: %s: %s\n", name, lrcs_brdf_warning_text(bit));
        }
    }
}

const char *cli_colour_text(const unsigned char rgb[3], char text[CLI_COLOUR_TEXT])
{
    snprintf(text, CLI_COLOUR_TEXT, "#%02X%02X%02X", rgb[0], rgb[1], rgb[2]);
    return text;
}

/* '#RRGGBB' exactly. */
static int colour_read(const char *text, size_t size, unsigned char rgb[3])
{
    static const char digit[] = "0123456789abcdef";
    if (size != 7 || text[0] != '#') {
        return -1;
    }
    for (int i = 0; i < 6; i++) {
        int c = (unsigned char)text[1 + i];
        const char *at = strchr(digit, c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c);
        if (!at || !*at) {
            return -1;
        }
        rgb[i / 2] = (unsigned char)(i % 2 ? rgb[i / 2] + (at - digit) : 16 * (at - digit));
    }
    return 0;
}

/* Reads one --material: a colour or a name is what precedes the last '=', since no number contains
   one. */
static int material_option_read(const cli_command *command, const char *text, lrcs_binding *binding)
{
    const char *equals = strrchr(text, '=');
    *binding = (lrcs_binding){.kind = LRCS_BIND_DEFAULT, .two_sided = -1};
    if (equals) {
        size_t size = (size_t)(equals - text);
        if (size == 0) {
            return cli_usage(command, "--material: expected NAME=A,B,s,m, found '%s'", text);
        }
        binding->kind = text[0] == '#' ? LRCS_BIND_COLOUR : LRCS_BIND_NAME;
        if (text[0] == '#' && colour_read(text, size, binding->rgb) != 0) {
            return cli_usage(command, "--material: expected '#RRGGBB', found '%.*s'", (int)size,
                             text);
        }
        char *name = malloc(size + 1);
        if (!name) {
            return cli_out_of_memory();
        }
        memcpy(name, text, size);
        name[size] = '\0';
        binding->name = name;
    }
    const char *value = equals ? equals + 1 : text;
    const lrcs_brdf_entry *entry;
    for (uint32_t i = 0; (entry = lrcs_brdf_library(i)) != NULL; i++) {
        binding->source =
            strcmp(entry->name, value) == 0 ? LRCS_SOURCE_LIBRARY + i : binding->source;
    }
    return brdf_error_read(command, value, "--material", &binding->brdf, &binding->error);
}

static const struct {
    const char *name;
    double m;
} units[] = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}};

#define UNITS (sizeof units / sizeof units[0])

const char *cli_unit_text(double unit_m, char text[CLI_UNIT_TEXT])
{
    if (!(unit_m > 0.0)) {
        return unit_m < 0.0 ? "m assumed" : NULL;
    }
    for (size_t i = 0; i < UNITS; i++) {
        if (unit_m == units[i].m) {
            return units[i].name;
        }
    }
    snprintf(text, CLI_UNIT_TEXT, "%.17g", unit_m);
    return text;
}

const char *cli_scene_unit(const cli_args *args, const lrcs_host_scene *scene)
{
    const lrcs_recipe *recipe = &scene->recipe;
    int model = recipe->part_count == 1 && recipe->part[0].file &&
                strcmp(recipe->part[0].file, args->operand) == 0;
    return model ? cli_value(args, "unit") : "m";
}

int cli_scene_options_read(const cli_args *args, lrcs_host_options *options)
{
    const char *text = cli_value(args, "unit");
    int code = 0;
    *options = lrcs_host_options_default();
    options->keep_transparent = cli_value(args, "keep-transparent") != NULL;
    options->two_sided = cli_value(args, "two-sided");
    int known = text == NULL;
    for (size_t i = 0; i < UNITS && !known; i++) {
        known = strcmp(text, units[i].name) == 0;
        options->unit_m = known ? units[i].m : options->unit_m;
    }
    if (!known && (lrcs_host_number_read(text, strlen(text), &options->unit_m) != LRCS_OK ||
                   !(options->unit_m > 0.0))) {
        code = cli_expected(args, "unit", "mm, cm, m, in, ft or metres per unit (> 0)");
    }
    lrcs_binding *all = calloc((size_t)args->given_count + 1, sizeof *all);
    options->binding = all;
    if (!all) {
        return cli_out_of_memory();
    }
    for (int i = 0; i < args->given_count && code == 0; i++) {
        if (strcmp(args->given[i].name, "material") == 0) {
            code = material_option_read(args->command, args->given[i].value,
                                        &all[options->binding_count++]);
        }
    }
    return code;
}

void cli_scene_options_free(lrcs_host_options *options)
{
    for (uint32_t i = 0; i < options->binding_count; i++) {
        free((void *)(uintptr_t)options->binding[i].name);
    }
    free((void *)(uintptr_t)options->binding);
    options->binding = NULL;
    options->binding_count = 0;
}

const char *cli_material_name(const lrcs_material *material)
{
    return material->name[0] ? material->name : "(default)";
}

#define NEAR_MOST ((size_t)5) /* names that an error lists */

/* The colours of the scene nearest to a colour, by the sum of squares of the channels'
   differences, as "#RRGGBB". Returns their number. */
static uint32_t colours_near(const lrcs_scene *scene, const unsigned char rgb[3],
                             char text[NEAR_MOST][CLI_COLOUR_TEXT])
{
    uint32_t found = 0;
    for (; found < NEAR_MOST; found++) {
        const lrcs_material *best = NULL;
        long least = 0;
        for (uint32_t i = 0; i < scene->material_count; i++) {
            const lrcs_material *one = &scene->material[i];
            char own[CLI_COLOUR_TEXT];
            long sum = 0;
            int known = !one->has_colour;
            cli_colour_text(one->rgb, own);
            for (int k = 0; k < 3; k++) {
                sum += (long)(one->rgb[k] - rgb[k]) * (one->rgb[k] - rgb[k]);
            }
            for (uint32_t k = 0; k < found && !known; k++) {
                known = strcmp(text[k], own) == 0;
            }
            if (!known && (!best || sum < least)) {
                best = one;
                least = sum;
                memcpy(text[found], own, sizeof own);
            }
        }
        if (!best) {
            break;
        }
    }
    return found;
}

/* Appends a name to a list, "a, then b, c". */
static void list_add(char *list, size_t size, uint32_t index, const char *quote, const char *name)
{
    static const char *const before[] = {"", ", then ", ", "};
    lrcs_host_append(list, size, "%s%s%.60s%s", before[index < 2 ? index : 2], quote, name, quote);
}

/* Reports a --material that matches no facet: the message lists the names or colours most like
   it. */
static int unmatched_binding(const cli_command *command, const lrcs_host_scene *host)
{
    const lrcs_scene *scene = &host->scene;
    const lrcs_binding *binding = &host->recipe.binding[scene->unmatched];
    const char *near[NEAR_MOST];
    char list[NEAR_MOST * 80] = "";
    if (binding->kind != LRCS_BIND_NAME) {
        char colour[NEAR_MOST][CLI_COLOUR_TEXT];
        uint32_t found = colours_near(scene, binding->rgb, colour);
        for (uint32_t i = 0; i < found; i++) {
            list_add(list, sizeof list, i, "", colour[i]);
        }
        return cli_usage(command, "--material: no material of the scene has the colour %s; %s%s",
                         cli_colour_text(binding->rgb, colour[0]),
                         list[0] ? "the nearest is " : "none has a colour", list);
    }
    const char **name = calloc((size_t)scene->material_count + 1, sizeof *name);
    if (!name) {
        return cli_out_of_memory();
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        name[i] = scene->material[i].name;
    }
    uint32_t found =
        lrcs_host_names_near(binding->name, name, scene->material_count, near, (uint32_t)NEAR_MOST);
    free(name);
    int is_near = found > 0 && lrcs_host_name_is_near(binding->name, near[0]);
    for (uint32_t i = 0; i < found; i++) {
        list_add(list, sizeof list, is_near || i == 0 ? i : 2, "'", near[i]);
    }
    return cli_usage(command, "--material: the scene has no material named '%s'%s%s", binding->name,
                     is_near             ? "; the nearest is "
                     : found == 0        ? ", nor any other"
                     : found < NEAR_MOST ? "; it has "
                                         : "; it has, among others, ",
                     list);
}

int cli_scene_code(const cli_args *args, const lrcs_host_options *options, int status,
                   const lrcs_host_error *error, const lrcs_host_scene *scene)
{
    if (status == LRCS_E_ARGUMENT && options->unit_m > 0.0) {
        return cli_usage(args->command, "--unit: %s", error->text);
    }
    if (status == LRCS_E_NAME && strncmp(error->text, "two-sided:", 10) == 0) {
        return cli_usage(args->command, "--%s", error->text);
    }
    if (status != LRCS_OK) {
        return cli_failed(error);
    }
    return scene->scene.unmatched == LRCS_NONE ? 0 : unmatched_binding(args->command, scene);
}

int cli_scene_read(const cli_args *args, const lrcs_host_options *options, lrcs_host_scene *scene)
{
    lrcs_host_error error;
    int status = lrcs_host_scene_read(args->operand, options, scene, &error);
    return cli_scene_code(args, options, status, &error, scene);
}

int cli_scene_prepare(lrcs_host_scene *scene)
{
    lrcs_host_error error;
    return lrcs_host_scene_prepare(scene, &error) == LRCS_OK ? 0 : cli_failed(&error);
}

int cli_scene_run(const lrcs_host_scene *scene, const lrcs_pose *pose,
                  const lrcs_run_options *options, lrcs_result *result, lrcs_facet_record *records,
                  lrcs_image *image, double *seconds)
{
    lrcs_host_error error;
    int status = lrcs_host_scene_run(scene, pose, options, result, records, image, seconds, &error);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}
