/* SPDX-License-Identifier: MIT */
/* Reads a kit from its files: materials and cases from their tables, scenes through the engine when
   they are needed. Nothing of the kit is taken from this program, so that an older kit gives the
   same verdict as before. */
#include "host/kit/kit.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host/fail.h"

int lrcsi_kit_path(char path[LRCSI_KIT_PATH], lrcs_host_error *error, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int size = vsnprintf(path, LRCSI_KIT_PATH, format, list);
    va_end(list);
    return size >= 0 && (unsigned)size < LRCSI_KIT_PATH
               ? LRCS_OK
               : lrcsi_host_fail(error, LRCS_E_LIMIT, "a path of more than %u bytes",
                                 LRCSI_KIT_PATH);
}

/* ---- materials ---- */

static int kit_material_read(const lrcsi_kit_table *table, lrcs_host_kit *kit)
{
    double value[5];
    uint32_t i = kit->bindings;
    int status = lrcsi_kit_table_name(table, 0, kit->material[i]);
    for (int k = 0; k < 5 && status == LRCS_OK; k++) {
        status = lrcsi_kit_table_number(table, k + 1, &value[k]);
    }
    if (status != LRCS_OK) {
        return status;
    }
    lrcs_brdf brdf = {value[0], value[1], value[2], value[3]};
    if (lrcs_brdf_check(&brdf) < 0) {
        return lrcsi_kit_table_refuse(table, 0, "A, B, m >= 0 and s > 0");
    }
    kit->binding[kit->bindings++] = (lrcs_binding){.kind = LRCS_BIND_NAME,
                                                   .name = kit->material[i],
                                                   .brdf = brdf,
                                                   .two_sided = value[4] != 0.0};
    return LRCS_OK;
}

/* ---- cases ---- */

enum {
    CASE_SCENE,
    CASE_ATTITUDE,
    CASE_TIER,
    CASE_QUATERNION,
    CASE_DIRECTION = CASE_QUATERNION + 4,
    CASE_AZEL = CASE_DIRECTION + 3,
    CASE_SIGMA = CASE_AZEL + 2,
    CASE_BOUND,
    CASE_FLOAT,
    CASE_EDGE,
    CASE_SIDE,
    CASE_IMAGE,
    CASE_COLUMNS
};

static const char *const case_names[CASE_COLUMNS] = {
    "scene",    "attitude", "tier",     "qw",      "qx",     "qy",
    "qz",       "sx",       "sy",       "sz",      "az_deg", "el_deg",
    "sigma_m2", "bound_m2", "float_m2", "edge_m2", "side_m", "image"};

static int kit_case_read(const lrcsi_kit_table *table, lrcs_host_kit *kit)
{
    double value[CASE_COLUMNS] = {0.0};
    char name[LRCS_HOST_KIT_NAME];
    lrcs_host_kit_case *one = &kit->list[kit->cases];
    int status = lrcsi_kit_table_name(table, CASE_SCENE, name);
    status = status != LRCS_OK ? status : lrcsi_kit_table_name(table, CASE_ATTITUDE, one->attitude);
    for (int k = CASE_TIER; k < CASE_COLUMNS && status == LRCS_OK; k++) {
        status = lrcsi_kit_table_number(table, k, &value[k]);
    }
    if (status != LRCS_OK) {
        return status;
    }
    memcpy(one->quaternion, &value[CASE_QUATERNION], sizeof one->quaternion);
    memcpy(one->direction, &value[CASE_DIRECTION], sizeof one->direction);
    memcpy(one->azel_deg, &value[CASE_AZEL], sizeof one->azel_deg);
    one->sigma_m2 = value[CASE_SIGMA];
    one->bound_m2 = value[CASE_BOUND];
    one->float_m2 = value[CASE_FLOAT];
    one->edge_m2 = value[CASE_EDGE];
    one->side_m = value[CASE_SIDE];
    if (!(value[CASE_TIER] >= 1.0 && value[CASE_TIER] <= LRCS_HOST_KIT_TIERS)) {
        return lrcsi_kit_table_refuse(table, CASE_TIER, "1 .. %d", LRCS_HOST_KIT_TIERS);
    }
    if (!(value[CASE_IMAGE] >= 0.0 && value[CASE_IMAGE] <= 16384.0)) {
        return lrcsi_kit_table_refuse(table, CASE_IMAGE, "0 .. 16384");
    }
    if (lrcsi_kit_pose(one->quaternion, one->direction, &one->pose) != LRCS_OK) {
        return lrcsi_kit_table_refuse(table, CASE_QUATERNION, "an attitude");
    }
    one->tier = (int)value[CASE_TIER];
    one->image = (uint32_t)value[CASE_IMAGE];
    if (kit->scenes == 0 || strcmp(kit->scene[kit->scenes - 1].name, name) != 0) {
        lrcs_host_kit_scene *next =
            &kit->scene[kit->scenes++]; /* a scene's lines are consecutive */
        memcpy(next->name, name, LRCS_HOST_KIT_NAME);
        next->tier = one->tier;
        next->first = kit->cases;
    }
    one->scene = kit->scenes - 1;
    kit->scene[one->scene].count++;
    kit->cases++;
    return LRCS_OK;
}

/* Reads a table of the kit: room for a material or a case on every line, then line by line. */
static int kit_table_read(const char *folder, int materials, lrcs_host_kit *kit,
                          lrcs_host_error *error)
{
    static const char *const names[] = {"material", "A", "B", "s", "m", "two_sided"};
    char path[LRCSI_KIT_PATH];
    lrcsi_kit_table table;
    int columns = materials ? 6 : CASE_COLUMNS;
    int status =
        lrcsi_kit_path(path, error, "%s/%s", folder,
                       materials ? LRCS_HOST_KIT_MATERIALS_TEXT : LRCS_HOST_KIT_CASES_TEXT);
    if (status != LRCS_OK) {
        return status;
    }
    status =
        lrcsi_kit_table_open(path, materials ? names : case_names, columns, columns, &table, error);
    size_t room = table.lines + 1;
    if (materials) {
        kit->binding = calloc(room, sizeof *kit->binding);
        kit->material = calloc(room, sizeof *kit->material);
    } else {
        kit->list = calloc(room, sizeof *kit->list);
        kit->scene = calloc(room, sizeof *kit->scene);
    }
    int full = materials ? kit->binding && kit->material : kit->list && kit->scene;
    status = status == LRCS_OK && !full ? lrcsi_host_out_of_memory(error) : status;
    while (lrcsi_kit_table_next(&table, &status)) {
        status = materials ? kit_material_read(&table, kit) : kit_case_read(&table, kit);
    }
    lrcsi_kit_table_close(&table);
    return status;
}

int lrcs_host_kit_read(const char *folder, lrcs_host_kit *kit, lrcs_host_error *error)
{
    char path[LRCSI_KIT_PATH];
    memset(kit, 0, sizeof *kit);
    kit->folder = folder;
    int status = lrcsi_kit_path(path, error, "%s/" LRCS_HOST_KIT_CASES_TEXT, folder);
    if (status != LRCS_OK) {
        return status;
    }
    if (access(path, F_OK) != 0) {
        return lrcsi_host_fail(error, LRCS_E_SYSTEM,
                               "%s: not the folder of a kit (lrcs vectors DIR makes one)", folder);
    }
    status = kit_table_read(folder, 0, kit, error);
    return status != LRCS_OK ? status : kit_table_read(folder, 1, kit, error);
}

void lrcs_host_kit_free(lrcs_host_kit *kit)
{
    for (uint32_t i = 0; i < kit->cases; i++) {
        free(kit->list[i].records);
    }
    for (uint32_t i = 0; i < kit->scenes; i++) {
        free(kit->scene[i].normal);
        lrcs_host_scene_free(&kit->scene[i].host);
    }
    free(kit->binding);
    free(kit->material);
    free(kit->list);
    free(kit->scene);
}

/* ---- scenes ---- */

int lrcsi_kit_pose(const double quaternion[4], const double direction[3], lrcs_pose *pose)
{
    lrcs_pose turned;
    lrcs_pose aimed;
    int status = lrcs_pose_from_quaternion(quaternion, &turned);
    status = status == LRCS_OK ? lrcs_pose_from_direction(direction, &aimed) : status;
    if (status == LRCS_OK) {
        memcpy(pose->direction, aimed.direction, sizeof pose->direction);
        memcpy(pose->R, turned.R, sizeof pose->R);
    }
    return status;
}

double lrcsi_kit_outline(const lrcs_scene *scene, uint32_t facet, const lrcs_pose *pose)
{
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        const double *a = scene->vertex[scene->facet[facet].corner[k]].x;
        const double *b = scene->vertex[scene->facet[facet].corner[(k + 1) % 3]].x;
        double side[2] = {0.0, 0.0};
        for (int i = 0; i < 3; i++) {
            side[0] += pose->R[0][i] * (b[i] - a[i]);
            side[1] += pose->R[1][i] * (b[i] - a[i]);
        }
        length += hypot(side[0], side[1]);
    }
    return length;
}

int lrcsi_kit_scene_read(const char *folder, const char *name, const lrcs_binding *binding,
                         uint32_t count, lrcs_host_scene *scene, lrcs_host_error *error)
{
    lrcs_host_options options = lrcs_host_options_default();
    char path[LRCSI_KIT_PATH];
    memset(scene, 0, sizeof *scene);
    options.binding = binding;
    options.binding_count = count;
    int status = lrcsi_kit_path(path, error, "%s/scenes/%s.obj", folder, name);
    status = status == LRCS_OK ? lrcs_host_scene_read(path, &options, scene, error) : status;
    return status == LRCS_OK ? lrcs_host_scene_prepare(scene, error) : status;
}

int lrcsi_kit_scene(const lrcs_host_kit *kit, lrcs_host_kit_scene *scene, lrcs_host_error *error)
{
    const lrcs_scene *mesh = &scene->host.scene;
    if (scene->loaded) {
        return LRCS_OK;
    }
    scene->loaded = 1;
    int status = lrcsi_kit_scene_read(kit->folder, scene->name, kit->binding, kit->bindings,
                                      &scene->host, error);
    if (status != LRCS_OK) {
        return status;
    }
    scene->normal = calloc((size_t)mesh->vertex_count + 1, sizeof *scene->normal);
    if (!scene->normal) {
        return lrcsi_host_out_of_memory(error);
    }
    for (uint32_t i = 0; i < mesh->facet_count; i++) { /* means weighted by area */
        const uint32_t *v = mesh->facet[i].corner;
        const double *p[3] = {mesh->vertex[v[0]].x, mesh->vertex[v[1]].x, mesh->vertex[v[2]].x};
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3;
            int b = (k + 2) % 3;
            double n = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) -
                       (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
            for (int corner = 0; corner < 3; corner++) {
                scene->normal[v[corner]].x[k] += n;
            }
        }
    }
    return LRCS_OK;
}

int lrcsi_kit_run(const lrcs_host_scene *host, const lrcs_pose *pose, uint32_t without,
                  lrcs_facet_record *records, lrcs_host_error *error)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    options.method = LRCS_METHOD_EXACT;
    options.without = without;
    return lrcs_host_scene_run(host, pose, &options, &result, records, NULL, NULL, error);
}

int lrcsi_kit_records(const lrcs_host_kit *kit, lrcs_host_kit_case *one, lrcs_host_error *error)
{
    lrcs_host_kit_scene *scene = &kit->scene[one->scene];
    if (one->records) {
        return LRCS_OK;
    }
    int status = lrcsi_kit_scene(kit, scene, error);
    if (status != LRCS_OK) {
        return status;
    }
    one->records = calloc((size_t)scene->host.scene.facet_count + 1, sizeof *one->records);
    return one->records ? lrcsi_kit_run(&scene->host, &one->pose, 0, one->records, error)
                        : lrcsi_host_out_of_memory(error);
}

/* ---- lines of others ---- */

int lrcsi_kit_find(const lrcs_host_kit *kit, const lrcsi_kit_table *table, lrcs_host_kit_case **one)
{
    char name[LRCS_HOST_KIT_NAME];
    const char *best = NULL;
    const lrcs_host_kit_scene *scene = NULL;
    int tiers = 0;
    int status = lrcsi_kit_table_name(table, 0, name);
    if (status != LRCS_OK) {
        return status;
    }
    for (uint32_t i = 0; i < kit->scenes && !scene; i++) {
        scene = strcmp(kit->scene[i].name, name) == 0 ? &kit->scene[i] : NULL;
        best = lrcs_host_name_nearer(name, best, kit->scene[i].name);
        tiers = kit->scene[i].tier > tiers ? kit->scene[i].tier : tiers;
    }
    if (!scene) {
        return lrcsi_kit_table_refuse(
            table, 0, "a scene of the kit, which has tiers 1 .. %d (the nearest is %s)", tiers,
            best ? best : "none");
    }
    status = lrcsi_kit_table_name(table, 1, name);
    if (status != LRCS_OK) {
        return status;
    }
    best = NULL;
    for (uint32_t i = scene->first; i < scene->first + scene->count; i++) {
        if (strcmp(kit->list[i].attitude, name) == 0) {
            *one = &kit->list[i];
            return LRCS_OK;
        }
        best = lrcs_host_name_nearer(name, best, kit->list[i].attitude);
    }
    return lrcsi_kit_table_refuse(table, 1, "an attitude of %s (the nearest is %s)", scene->name,
                                  best ? best : "none");
}
