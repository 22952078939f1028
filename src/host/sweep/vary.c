/* SPDX-License-Identifier: MIT */
/* What a sweep changes in a scene: joint angles, material parameters, dimensions of shapes. This
   file decides which parts or materials a text means and which values are valid; the scene is then
   built anew and tessellated for itself. */
#include "host/sweep/vary.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "host/fail.h"
#include "host/sweep/axis.h"

enum vary_kind { VARY_JOINT, VARY_MATERIAL, VARY_SHAPE };

/* The parameters that --vary can change, and the kinds of shapes that have them (bits). */
#define VARY_KIND(kind) (1u << LRCS_SHAPE_##kind)
static const struct {
    const char *name;
    size_t offset;
    int key;
    unsigned kinds;
} vary_keys[] = {
    {"joint_deg", 0, VARY_JOINT, 0},
    {"A", offsetof(lrcs_brdf, A), VARY_MATERIAL, 0},
    {"B", offsetof(lrcs_brdf, B), VARY_MATERIAL, 0},
    {"s", offsetof(lrcs_brdf, s), VARY_MATERIAL, 0},
    {"m", offsetof(lrcs_brdf, m), VARY_MATERIAL, 0},
    {"size_x", offsetof(lrcs_shape, size), VARY_SHAPE, VARY_KIND(PLATE) | VARY_KIND(BOX)},
    {"size_y", offsetof(lrcs_shape, size) + sizeof(double), VARY_SHAPE,
     VARY_KIND(PLATE) | VARY_KIND(BOX)},
    {"size_z", offsetof(lrcs_shape, size) + 2 * sizeof(double), VARY_SHAPE, VARY_KIND(BOX)},
    {"radius", offsetof(lrcs_shape, radius), VARY_SHAPE,
     VARY_KIND(DISC) | VARY_KIND(SPHERE) | VARY_KIND(DOME) | VARY_KIND(CYLINDER) | VARY_KIND(CONE) |
         VARY_KIND(FRUSTUM) | VARY_KIND(PARABOLOID)},
    {"radius2", offsetof(lrcs_shape, radius2), VARY_SHAPE, VARY_KIND(FRUSTUM)},
    {"length", offsetof(lrcs_shape, length), VARY_SHAPE,
     VARY_KIND(CYLINDER) | VARY_KIND(CONE) | VARY_KIND(FRUSTUM) | VARY_KIND(PARABOLOID)},
    {"half_angle_deg", offsetof(lrcs_shape, half_angle_deg), VARY_SHAPE, VARY_KIND(CONE)}};

#define VARY_KEYS (int)(sizeof vary_keys / sizeof vary_keys[0])

/* ---- from texts ---- */

/* Splits "NAME.KEY", which begins the text of `vary`, and sets the parameter. */
static int whom_split(const char *text, lrcs_host_plan_axis *axis, lrcs_host_error *error)
{
    char *dot = strrchr(axis->subject, '.');
    const char *best = NULL;
    axis->parameter = -1;
    for (int i = 1; dot && i < VARY_KEYS; i++) {
        axis->parameter =
            dot > axis->subject && strcmp(vary_keys[i].name, dot + 1) == 0 ? i : axis->parameter;
        best = lrcs_host_name_nearer(dot + 1, best, vary_keys[i].name);
    }
    if (axis->parameter < 0) {
        int near = best && lrcs_host_name_is_near(dot + 1, best);
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "vary: expected MATERIAL.A, .B, .s or .m, or PART.radius, .length, "
                               ".. , then :A:B:STEP; found '%s'%s%s",
                               text, near ? "; the nearest is ." : "", near ? best : "");
    }
    *dot = '\0';
    return LRCS_OK;
}

/* Reads NAME:A:B:STEP or NAME:A; names may contain colons. */
static int vary_axis_read(const lrcs_host_plan_text *one, lrcs_host_plan *plan,
                          lrcs_host_error *error)
{
    lrcs_host_plan_axis axis = {.parameter = VARY_JOINT};
    char column[128];
    const char *range = NULL;
    const int joint = one->key[0] == 'j';
    for (const char *at = strchr(one->text, ':'); at && !range; at = strchr(at + 1, ':')) {
        int found = at > one->text && !lrcsi_range_read(at + 1, strlen(at + 1), &axis.range);
        range = found ? at + 1 : NULL;
    }
    size_t size = range ? (size_t)(range - 1 - one->text) : 0;
    if (!range || size >= sizeof axis.subject) {
        return lrcsi_text_refuse(error, one->key, joint ? "PART:A:B:STEP" : "NAME.KEY:A:B:STEP",
                                 one->text);
    }
    memcpy(axis.subject, one->text, size);
    int status = joint ? LRCS_OK : whom_split(one->text, &axis, error);
    if (status != LRCS_OK) {
        return status;
    }
    snprintf(column, sizeof column, "%s.%s", axis.subject, vary_keys[axis.parameter].name);
    status = lrcsi_axis_add(plan, one->key, column, range, strlen(range), error);
    if (status == LRCS_OK) {
        lrcs_host_plan_axis *added = &plan->axis[plan->axes - 1];
        memcpy(added->subject, axis.subject, sizeof axis.subject);
        added->parameter = axis.parameter;
        plan->scene_axes = plan->axes;
    }
    return status;
}

int lrcsi_vary_read(const lrcs_host_plan_text *given, int count, lrcs_host_plan *plan,
                    lrcs_host_error *error)
{
    int status = LRCS_OK;
    for (int i = 0; i < count && status == LRCS_OK; i++) {
        if (given[i].text &&
            (strcmp(given[i].key, "joint") == 0 || strcmp(given[i].key, "vary") == 0)) {
            status = vary_axis_read(&given[i], plan, error);
        }
    }
    return status;
}

/* ---- the part or material that is meant ---- */

/* 1 if a part is selected: by '*' (all), by its name, or by one of several names separated by
   commas. */
static int part_is_meant(const char *subject, const char *name)
{
    size_t size = strlen(name);
    if (strcmp(subject, "*") == 0 || strcmp(subject, name) == 0) {
        return 1;
    }
    for (const char *at = subject; at; at = strchr(at, ',')) {
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
    if (vary_keys[key].key == VARY_JOINT) {
        return part->joint.used;
    }
    int other = part->shape.kind == LRCS_SHAPE_CONE &&
                ((strcmp(vary_keys[key].name, "length") == 0 && part->shape.half_angle_deg > 0.0) ||
                 (strcmp(vary_keys[key].name, "half_angle_deg") == 0 &&
                  !(part->shape.half_angle_deg > 0.0)));
    return !part->file && !other && (vary_keys[key].kinds >> part->shape.kind & 1u);
}

static double *part_value(lrcs_recipe_part *part, int key)
{
    return vary_keys[key].key == VARY_JOINT
               ? &part->joint.angle_deg
               : (double *)(void *)((char *)&part->shape + vary_keys[key].offset);
}

static int part_axis_check(const lrcs_host_plan_axis *axis, const lrcs_recipe *recipe,
                           lrcs_host_error *error)
{
    const char *what =
        vary_keys[axis->parameter].key == VARY_JOINT ? "a joint" : vary_keys[axis->parameter].name;
    const char *best = NULL;
    int found = 0;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        lrcs_recipe_part part = recipe->part[i];
        int fits = part_fits(&part, axis->parameter);
        best = fits ? lrcs_host_name_nearer(axis->subject, best, part.name) : best;
        if (!fits || !part_is_meant(axis->subject, part.name)) {
            continue;
        }
        found++;
        for (uint64_t k = 0; k < 2 && vary_keys[axis->parameter].key == VARY_SHAPE; k++) {
            lrcs_where where;
            *part_value(&part, axis->parameter) =
                lrcs_host_range_at(&axis->range, k * (axis->range.count - 1));
            if (lrcs_shape_check(&part.shape, &where) != LRCS_OK) {
                return lrcsi_host_fail(
                    error, LRCS_E_ARGUMENT, "%s: %s of '%s' cannot be %g: expected %s", axis->key,
                    what, part.name, lrcs_host_range_at(&axis->range, k * (axis->range.count - 1)),
                    where.expected);
            }
        }
    }
    if (!found && !best) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT, "%s: no part of the scene has %s", axis->key,
                               what);
    }
    return found ? LRCS_OK
                 : lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                                   "%s: no part '%s' has %s; the nearest is '%s'", axis->key,
                                   axis->subject, what, best);
}

/* The material of that name, or NULL. */
static const lrcs_material *material_named(const lrcs_scene *scene, const char *name)
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
    return (double *)(void *)((char *)brdf + vary_keys[key].offset);
}

static int material_axis_check(const lrcs_host_plan_axis *axis, const lrcs_scene *scene,
                               lrcs_host_error *error)
{
    const lrcs_material *material = material_named(scene, axis->subject);
    const char *best = NULL;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *other = &scene->material[i];
        best = other->name[0] ? lrcs_host_name_nearer(axis->subject, best, other->name) : best;
        if (material && strcmp(other->name, axis->subject) == 0 &&
            memcmp(&other->brdf, &material->brdf, sizeof other->brdf) != 0) {
            return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                                   "vary: two materials of the scene are named '%s'",
                                   axis->subject);
        }
    }
    if (!material) {
        char list[200] = "";
        for (uint32_t i = 0; i < scene->material_count; i++) {
            const char *name = scene->material[i].name;
            lrcs_host_append(list, sizeof list, "%s%s%s%s", name[0] && list[0] ? ", " : "",
                             name[0] ? "'" : "", name, name[0] ? "'" : "");
        }
        int near = best && lrcs_host_name_is_near(axis->subject, best);
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT, "vary: no material '%s'%s%s%s",
                               axis->subject,
                               near   ? "; the nearest is '"
                               : best ? "; the scene has "
                                      : "",
                               near ? best : list, near ? "'" : "");
    }
    for (uint64_t k = 0; k < 2; k++) {
        lrcs_brdf brdf = material->brdf;
        *brdf_value(&brdf, axis->parameter) =
            lrcs_host_range_at(&axis->range, k * (axis->range.count - 1));
        if (lrcs_brdf_check(&brdf) < 0) {
            return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                                   "vary: %s cannot be %g (A, B, m >= 0 and s > 0)", axis->name,
                                   *brdf_value(&brdf, axis->parameter));
        }
    }
    return LRCS_OK;
}

/* The joint of a column of a track, as an axis. */
static lrcs_host_plan_axis joint_axis(const lrcs_host_track *track, uint32_t joint)
{
    lrcs_host_plan_axis axis = {.key = "poses", .parameter = VARY_JOINT};
    snprintf(axis.subject, sizeof axis.subject, "%.99s",
             track->joint_name[joint] + sizeof LRCS_HOST_TRACK_JOINT_TEXT - 1);
    return axis;
}

int lrcs_host_plan_check(const lrcs_host_plan *plan, const lrcs_host_scene *base,
                         lrcs_host_error *error)
{
    int status = LRCS_OK;
    for (uint32_t i = 0; i < plan->scene_axes && status == LRCS_OK; i++) {
        const lrcs_host_plan_axis *axis = &plan->axis[i];
        status = vary_keys[axis->parameter].key == VARY_MATERIAL
                     ? material_axis_check(axis, &base->scene, error)
                     : part_axis_check(axis, &base->recipe, error);
    }
    for (uint32_t i = 0; i < plan->track.joints && status == LRCS_OK; i++) {
        const lrcs_host_plan_axis axis = joint_axis(&plan->track, i);
        status = part_axis_check(&axis, &base->recipe, error);
    }
    return status;
}

/* ---- the scene of a row ---- */

/* Sets a material's parameter by a binding to the material's name, after all other bindings. */
static void material_set(lrcs_recipe *recipe, uint32_t bound, const lrcs_host_plan_axis *axis,
                         double value, const lrcs_scene *scene)
{
    uint32_t at = bound;
    while (at < recipe->binding_count && strcmp(recipe->binding[at].name, axis->subject) != 0) {
        at++;
    }
    if (at == recipe->binding_count) {
        const lrcs_material *material = material_named(scene, axis->subject);
        recipe->binding[recipe->binding_count++] = (lrcs_binding){.kind = LRCS_BIND_NAME,
                                                                  .name = axis->subject,
                                                                  .brdf = material->brdf,
                                                                  .two_sided = -1,
                                                                  .error = material->error,
                                                                  .source = material->source};
    }
    *brdf_value(&recipe->binding[at].brdf, axis->parameter) = value;
}

static void recipe_set(lrcs_recipe *recipe, uint32_t bound, const lrcs_host_plan_axis *axis,
                       double value, const lrcs_scene *scene)
{
    if (vary_keys[axis->parameter].key == VARY_MATERIAL) {
        material_set(recipe, bound, axis, value, scene);
        return;
    }
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        lrcs_recipe_part *part = &recipe->part[i];
        if (part_fits(part, axis->parameter) && part_is_meant(axis->subject, part->name)) {
            *part_value(part, axis->parameter) = value;
        }
    }
}

int lrcs_host_plan_scene(const lrcs_host_plan *plan, uint64_t row, const lrcs_host_scene *base,
                         const lrcs_build_options *build, lrcs_host_scene *scene,
                         lrcs_host_error *error)
{
    lrcs_recipe recipe = base->recipe;
    uint32_t bound = recipe.binding_count;
    recipe.part = calloc((size_t)recipe.part_count + 1, sizeof *recipe.part);
    recipe.binding = calloc((size_t)bound + LRCS_HOST_PLAN_AXES, sizeof *recipe.binding);
    int status = lrcsi_host_out_of_memory(error);
    if (recipe.part && recipe.binding) {
        memcpy(recipe.part, base->recipe.part, recipe.part_count * sizeof *recipe.part);
        if (bound > 0) {
            memcpy(recipe.binding, base->recipe.binding, bound * sizeof *recipe.binding);
        }
        for (uint32_t i = 0; i < plan->scene_axes; i++) {
            double value =
                lrcs_host_range_at(&plan->axis[i].range, lrcs_host_plan_place(plan, row, i));
            recipe_set(&recipe, bound, &plan->axis[i], value, &base->scene);
        }
        for (uint32_t i = 0; i < plan->track.joints; i++) {
            const lrcs_host_plan_axis axis = joint_axis(&plan->track, i);
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
