/* SPDX-License-Identifier: MIT */
/* What a sweep changes in a scene: joint angles, material parameters, dimensions of shapes. This
   file decides which parts or materials an option means and which values are valid; the scene is
   then built anew and tessellated for itself. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum scene_key { SCENE_JOINT, SCENE_MATERIAL, SCENE_SHAPE };

/* The parameters that --vary can change, and the kinds of shapes that have them (bits). */
#define KIND(kind) (1u << LRCS_SHAPE_##kind)
static const struct {
    const char *name;
    size_t offset;
    int key;
    unsigned kinds;
} scene_keys[] = {
    {"joint_deg", 0, SCENE_JOINT, 0},
    {"A", offsetof(lrcs_brdf, A), SCENE_MATERIAL, 0},
    {"B", offsetof(lrcs_brdf, B), SCENE_MATERIAL, 0},
    {"s", offsetof(lrcs_brdf, s), SCENE_MATERIAL, 0},
    {"m", offsetof(lrcs_brdf, m), SCENE_MATERIAL, 0},
    {"size_x", offsetof(lrcs_shape, size), SCENE_SHAPE, KIND(PLATE) | KIND(BOX)},
    {"size_y", offsetof(lrcs_shape, size) + sizeof(double), SCENE_SHAPE, KIND(PLATE) | KIND(BOX)},
    {"size_z", offsetof(lrcs_shape, size) + 2 * sizeof(double), SCENE_SHAPE, KIND(BOX)},
    {"radius", offsetof(lrcs_shape, radius), SCENE_SHAPE,
     KIND(DISC) | KIND(SPHERE) | KIND(DOME) | KIND(CYLINDER) | KIND(CONE) | KIND(FRUSTUM) |
         KIND(PARABOLOID)},
    {"radius2", offsetof(lrcs_shape, radius2), SCENE_SHAPE, KIND(FRUSTUM)},
    {"length", offsetof(lrcs_shape, length), SCENE_SHAPE,
     KIND(CYLINDER) | KIND(CONE) | KIND(FRUSTUM) | KIND(PARABOLOID)},
    {"half_angle_deg", offsetof(lrcs_shape, half_angle_deg), SCENE_SHAPE, KIND(CONE)}};

#define SCENE_KEYS (int)(sizeof scene_keys / sizeof scene_keys[0])

/* ---- the command line ---- */

/* Splits "NAME.KEY", which begins the `value` of --vary; returns the key, or -1 with the message
   printed. */
static int whom_split(const cli_args *args, const char *value, char *whom)
{
    char *dot = strrchr(whom, '.');
    const char *best = NULL;
    int key = -1;
    for (int i = 1; dot && i < SCENE_KEYS; i++) {
        key = dot > whom && strcmp(scene_keys[i].name, dot + 1) == 0 ? i : key;
        best = cli_nearest(dot + 1, best, scene_keys[i].name);
    }
    if (key < 0) {
        cli_usage(args->command,
                  "--vary: expected MATERIAL.A, .B, .s or .m, or PART.radius, .length, .. , then "
                  ":A:B:STEP; found '%s'%s%s",
                  value, best ? "; the nearest is ." : "", best ? best : "");
        return -1;
    }
    *dot = '\0';
    return key;
}

/* Reads NAME:A:B:STEP or NAME:A; names may contain colons. */
static int scene_axis_read(const cli_args *args, const cli_given *one, sweep_plan *plan)
{
    sweep_axis axis = {.key = 0};
    char column[128];
    const char *range = NULL;
    for (const char *at = strchr(one->value, ':'); at && !range; at = strchr(at + 1, ':')) {
        int found = at > one->value && !cli_range_read(at + 1, strlen(at + 1), &axis.range);
        range = found ? at + 1 : NULL;
    }
    size_t size = range ? (size_t)(range - 1 - one->value) : 0;
    if (!range || size >= sizeof axis.whom) {
        return cli_usage(args->command, "--%s: expected %s:A:B:STEP, found '%s'", one->name,
                         one->name[0] == 'j' ? "PART" : "NAME.KEY", one->value);
    }
    memcpy(axis.whom, one->value, size);
    axis.key = one->name[0] == 'j' ? 0 : whom_split(args, one->value, axis.whom);
    if (axis.key < 0) {
        return CLI_USAGE;
    }
    snprintf(column, sizeof column, "%s.%s", axis.whom, scene_keys[axis.key].name);
    int code = cli_axis_add(args, plan, one->name, column, range, strlen(range));
    if (code == 0) {
        sweep_axis *added = &plan->axis[plan->axes - 1];
        memcpy(added->whom, axis.whom, sizeof axis.whom);
        added->key = axis.key;
        plan->scene_axes = plan->axes;
    }
    return code;
}

int cli_scene_axes_read(const cli_args *args, sweep_plan *plan)
{
    int code = 0;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const char *name = args->given[i].name;
        if (strcmp(name, "joint") == 0 || strcmp(name, "vary") == 0) {
            code = scene_axis_read(args, &args->given[i], plan);
        }
    }
    return code;
}

/* ---- whom it means ---- */

/* 1 if a part is selected: by '*' (all), by its name, or by one of several names separated by
   commas. */
static int part_is_meant(const char *whom, const char *name)
{
    size_t size = strlen(name);
    if (strcmp(whom, "*") == 0 || strcmp(whom, name) == 0) {
        return 1;
    }
    for (const char *at = whom; at; at = strchr(at, ',')) {
        at += *at == ',';
        if (strncmp(at, name, size) == 0 && (at[size] == ',' || at[size] == '\0')) {
            return 1;
        }
    }
    return 0;
}

/* 1 if this part has the dimension or the joint. A cone has a length or a half angle. */
static int part_fits(const lrcs_recipe_part *part, int key)
{
    if (scene_keys[key].key == SCENE_JOINT) {
        return part->joint.used;
    }
    int other =
        part->shape.kind == LRCS_SHAPE_CONE &&
        ((strcmp(scene_keys[key].name, "length") == 0 && part->shape.half_angle_deg > 0.0) ||
         (strcmp(scene_keys[key].name, "half_angle_deg") == 0 &&
          !(part->shape.half_angle_deg > 0.0)));
    return !part->file && !other && (scene_keys[key].kinds >> part->shape.kind & 1u);
}

static double *part_value(lrcs_recipe_part *part, int key)
{
    return scene_keys[key].key == SCENE_JOINT
               ? &part->joint.angle_deg
               : (double *)(void *)((char *)&part->shape + scene_keys[key].offset);
}

static int part_axis_check(const cli_args *args, const sweep_axis *axis, const lrcs_recipe *recipe)
{
    const char *what =
        scene_keys[axis->key].key == SCENE_JOINT ? "a joint" : scene_keys[axis->key].name;
    const char *best = NULL;
    int found = 0;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        lrcs_recipe_part part = recipe->part[i];
        int fits = part_fits(&part, axis->key);
        best = fits ? cli_nearest(axis->whom, best, part.name) : best;
        if (!fits || !part_is_meant(axis->whom, part.name)) {
            continue;
        }
        found++;
        for (uint64_t k = 0; k < 2 && scene_keys[axis->key].key == SCENE_SHAPE; k++) {
            lrcs_where where;
            *part_value(&part, axis->key) = cli_range_at(&axis->range, k * (axis->range.count - 1));
            if (lrcs_shape_check(&part.shape, &where) != LRCS_OK) {
                return cli_usage(args->command, "--%s: %s of '%s' cannot be %g: expected %s",
                                 axis->option, what, part.name,
                                 cli_range_at(&axis->range, k * (axis->range.count - 1)),
                                 where.expected);
            }
        }
    }
    if (!found && !best) {
        return cli_usage(args->command, "--%s: no part of the scene has %s", axis->option, what);
    }
    return found ? 0
                 : cli_usage(args->command, "--%s: no part '%s' has %s; the nearest is '%s'",
                             axis->option, axis->whom, what, best);
}

/* The material of that name, or NULL. */
static const lrcs_material *material_of(const lrcs_scene *scene, const char *name)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (strcmp(scene->material[i].name, name) == 0 && name[0]) {
            return &scene->material[i];
        }
    }
    return NULL;
}

static double *brdf_value(lrcs_brdf *brdf, int key)
{
    return (double *)(void *)((char *)brdf + scene_keys[key].offset);
}

static int material_axis_check(const cli_args *args, const sweep_axis *axis,
                               const lrcs_scene *scene)
{
    const lrcs_material *material = material_of(scene, axis->whom);
    const char *best = NULL;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *other = &scene->material[i];
        best = other->name[0] ? cli_nearest(axis->whom, best, other->name) : best;
        if (material && strcmp(other->name, axis->whom) == 0 &&
            memcmp(&other->brdf, &material->brdf, sizeof other->brdf) != 0) {
            return cli_usage(args->command, "--vary: two materials of the scene are named '%s'",
                             axis->whom);
        }
    }
    if (!material) {
        return cli_usage(args->command, "--vary: no material '%s'%s%s%s", axis->whom,
                         best ? "; the nearest is '" : "", best ? best : "", best ? "'" : "");
    }
    for (uint64_t k = 0; k < 2; k++) {
        lrcs_brdf brdf = material->brdf;
        *brdf_value(&brdf, axis->key) = cli_range_at(&axis->range, k * (axis->range.count - 1));
        if (lrcs_brdf_check(&brdf) < 0) {
            return cli_usage(args->command, "--vary: %s cannot be %g (A, B, m >= 0 and s > 0)",
                             axis->name, *brdf_value(&brdf, axis->key));
        }
    }
    return 0;
}

/* The joint of a column of a track, as an axis. */
static sweep_axis joint_axis(const sweep_track *track, uint32_t joint)
{
    sweep_axis axis = {.option = "poses", .key = SCENE_JOINT};
    snprintf(axis.whom, sizeof axis.whom, "%.99s",
             track->joint_name[joint] + sizeof SWEEP_JOINT - 1);
    return axis;
}

int cli_scene_axes_check(const cli_args *args, const sweep_plan *plan, const lrcs_host_scene *base)
{
    int code = 0;
    for (uint32_t i = 0; i < plan->scene_axes && code == 0; i++) {
        const sweep_axis *axis = &plan->axis[i];
        code = scene_keys[axis->key].key == SCENE_MATERIAL
                   ? material_axis_check(args, axis, &base->scene)
                   : part_axis_check(args, axis, &base->recipe);
        if (code == 0 && scene_keys[axis->key].key == SCENE_JOINT && plan->track.joints > 0) {
            code = cli_usage(args->command, "--joint and the joint columns of --poses both turn "
                                            "joints: give one");
        }
    }
    for (uint32_t i = 0; i < plan->track.joints && code == 0; i++) {
        const sweep_axis axis = joint_axis(&plan->track, i);
        code = part_axis_check(args, &axis, &base->recipe);
    }
    return code;
}

/* ---- the scene of a row ---- */

/* Sets a material's parameter by a binding to the material's name, after all other bindings. */
static void material_set(lrcs_recipe *recipe, uint32_t bound, const sweep_axis *axis, double value,
                         const lrcs_scene *scene)
{
    uint32_t at = bound;
    while (at < recipe->binding_count && strcmp(recipe->binding[at].name, axis->whom) != 0) {
        at++;
    }
    if (at == recipe->binding_count) {
        const lrcs_material *material = material_of(scene, axis->whom);
        recipe->binding[recipe->binding_count++] = (lrcs_binding){.kind = LRCS_BIND_NAME,
                                                                  .name = axis->whom,
                                                                  .brdf = material->brdf,
                                                                  .two_sided = -1,
                                                                  .error = material->error,
                                                                  .source = material->source};
    }
    *brdf_value(&recipe->binding[at].brdf, axis->key) = value;
}

static void recipe_set(lrcs_recipe *recipe, uint32_t bound, const sweep_axis *axis, double value,
                       const lrcs_scene *scene)
{
    if (scene_keys[axis->key].key == SCENE_MATERIAL) {
        material_set(recipe, bound, axis, value, scene);
        return;
    }
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        lrcs_recipe_part *part = &recipe->part[i];
        if (part_fits(part, axis->key) && part_is_meant(axis->whom, part->name)) {
            *part_value(part, axis->key) = value;
        }
    }
}

int cli_scene_of_row(const sweep_plan *plan, uint64_t row, const lrcs_host_scene *base,
                     const lrcs_build_options *build, lrcs_host_scene *scene,
                     lrcs_host_error *error)
{
    lrcs_recipe recipe = base->recipe;
    uint32_t bound = recipe.binding_count;
    recipe.part = calloc((size_t)recipe.part_count + 1, sizeof *recipe.part);
    recipe.binding = calloc((size_t)bound + SWEEP_AXES, sizeof *recipe.binding);
    snprintf(error->text, sizeof error->text, "out of memory");
    int status = LRCS_E_SYSTEM;
    if (recipe.part && recipe.binding) {
        memcpy(recipe.part, base->recipe.part, recipe.part_count * sizeof *recipe.part);
        if (bound > 0) {
            memcpy(recipe.binding, base->recipe.binding, bound * sizeof *recipe.binding);
        }
        for (uint32_t i = 0; i < plan->scene_axes; i++) {
            double value = cli_range_at(&plan->axis[i].range, cli_plan_place(plan, row, i));
            recipe_set(&recipe, bound, &plan->axis[i], value, &base->scene);
        }
        for (uint32_t i = 0; i < plan->track.joints; i++) {
            const sweep_axis axis = joint_axis(&plan->track, i);
            recipe_set(&recipe, bound, &axis, plan->track.joint[row % plan->poses][i],
                       &base->scene);
        }
        status = lrcs_host_scene_vary(base, &recipe, build, scene, error);
    }
    if (status == LRCS_OK) {
        status = lrcs_host_scene_prepare(scene, error);
        if (status != LRCS_OK) {
            lrcs_host_scene_free(scene);
        }
    }
    free(recipe.binding);
    free(recipe.part);
    return status;
}
