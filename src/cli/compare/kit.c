/* SPDX-License-Identifier: MIT */
/* Reads a kit from its files: materials and cases from their tables, scenes through the engine when
   they are needed. Nothing of the kit is taken from this program, so that an older kit gives the
   same verdict as before. */
#include "cli/compare/compare.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- materials ---- */

static int material_read(const compare_table *table, compare_kit *kit)
{
    double value[5];
    uint32_t i = kit->bindings;
    int code = cli_table_name(table, 0, kit->material[i]);
    for (int k = 0; k < 5 && code == 0; k++) {
        code = cli_table_number(table, k + 1, &value[k]);
    }
    if (code != 0) {
        return code;
    }
    lrcs_brdf brdf = {value[0], value[1], value[2], value[3]};
    if (lrcs_brdf_check(&brdf) < 0) {
        return cli_table_refuse(table, 0, "A, B, m >= 0 and s > 0");
    }
    kit->binding[kit->bindings++] = (lrcs_binding){.kind = LRCS_BIND_NAME,
                                                   .name = kit->material[i],
                                                   .brdf = brdf,
                                                   .two_sided = value[4] != 0.0};
    return 0;
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

static int case_read(const compare_table *table, compare_kit *kit)
{
    double value[CASE_COLUMNS] = {0.0};
    char name[KIT_NAME];
    compare_case *one = &kit->list[kit->cases];
    int code = cli_table_name(table, CASE_SCENE, name);
    code = code ? code : cli_table_name(table, CASE_ATTITUDE, one->attitude);
    for (int k = CASE_TIER; k < CASE_COLUMNS && code == 0; k++) {
        code = cli_table_number(table, k, &value[k]);
    }
    if (code != 0) {
        return code;
    }
    memcpy(one->quaternion, &value[CASE_QUATERNION], sizeof one->quaternion);
    memcpy(one->direction, &value[CASE_DIRECTION], sizeof one->direction);
    memcpy(one->azel_deg, &value[CASE_AZEL], sizeof one->azel_deg);
    one->sigma_m2 = value[CASE_SIGMA];
    one->bound_m2 = value[CASE_BOUND];
    one->float_m2 = value[CASE_FLOAT];
    one->edge_m2 = value[CASE_EDGE];
    one->side_m = value[CASE_SIDE];
    if (!(value[CASE_TIER] >= 1.0 && value[CASE_TIER] <= KIT_TIERS)) {
        return cli_table_refuse(table, CASE_TIER, "1 .. %d", KIT_TIERS);
    }
    if (!(value[CASE_IMAGE] >= 0.0 && value[CASE_IMAGE] <= 16384.0)) {
        return cli_table_refuse(table, CASE_IMAGE, "0 .. 16384");
    }
    if (cli_kit_pose(one->quaternion, one->direction, &one->pose) != LRCS_OK) {
        return cli_table_refuse(table, CASE_QUATERNION, "an attitude");
    }
    one->tier = (int)value[CASE_TIER];
    one->image = (uint32_t)value[CASE_IMAGE];
    if (kit->scenes == 0 || strcmp(kit->scene[kit->scenes - 1].name, name) != 0) {
        compare_scene *next = &kit->scene[kit->scenes++]; /* a scene's lines are consecutive */
        memcpy(next->name, name, KIT_NAME);
        next->tier = one->tier;
        next->first = kit->cases;
    }
    one->scene = kit->scenes - 1;
    kit->scene[one->scene].count++;
    kit->cases++;
    return 0;
}

/* Reads a table of the kit: room for a material or a case on every line, then line by line. */
static int kit_table(const char *folder, int materials, compare_kit *kit)
{
    static const char *const names[] = {"material", "A", "B", "s", "m", "two_sided"};
    char path[KIT_PATH];
    compare_table table;
    int columns = materials ? 6 : CASE_COLUMNS;
    if (cli_kit_path(path, "%s/%s", folder, materials ? KIT_MATERIALS_FILE : KIT_CASES_FILE) != 0) {
        return CLI_FAILED;
    }
    int code = cli_table_open(path, materials ? names : case_names, columns, columns, &table);
    size_t room = table.lines + 1;
    if (materials) {
        kit->binding = calloc(room, sizeof *kit->binding);
        kit->material = calloc(room, sizeof *kit->material);
    } else {
        kit->list = calloc(room, sizeof *kit->list);
        kit->scene = calloc(room, sizeof *kit->scene);
    }
    int full = materials ? kit->binding && kit->material : kit->list && kit->scene;
    code = code == 0 && !full ? cli_out_of_memory() : code;
    while (cli_table_next(&table, &code)) {
        code = materials ? material_read(&table, kit) : case_read(&table, kit);
    }
    cli_table_close(&table);
    return code;
}

int cli_compare_kit(const char *folder, compare_kit *kit)
{
    char path[KIT_PATH];
    memset(kit, 0, sizeof *kit);
    kit->folder = folder;
    if (cli_kit_path(path, "%s/" KIT_CASES_FILE, folder) != 0) {
        return CLI_FAILED;
    }
    if (access(path, F_OK) != 0) {
        return cli_fail("%s: not a kit's folder (lrcs vectors DIR makes one)", folder);
    }
    int code = kit_table(folder, 0, kit);
    return code ? code : kit_table(folder, 1, kit);
}

void cli_compare_kit_free(compare_kit *kit)
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

int cli_compare_scene(const compare_kit *kit, compare_scene *scene)
{
    const lrcs_scene *mesh = &scene->host.scene;
    if (scene->loaded) {
        return 0;
    }
    scene->loaded = 1;
    int code = cli_kit_scene(kit->folder, scene->name, kit->binding, kit->bindings, &scene->host);
    if (code != 0) {
        return code;
    }
    scene->normal = calloc((size_t)mesh->vertex_count + 1, sizeof *scene->normal);
    if (!scene->normal) {
        return cli_out_of_memory();
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
    return 0;
}

int cli_compare_run(const lrcs_host_scene *host, const lrcs_pose *pose, uint32_t without,
                    lrcs_facet_record *records)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    options.method = LRCS_METHOD_EXACT;
    options.without = without;
    return cli_scene_run(host, pose, &options, &result, records, NULL, NULL);
}

int cli_compare_records(const compare_kit *kit, compare_case *one)
{
    compare_scene *scene = &kit->scene[one->scene];
    if (one->records) {
        return 0;
    }
    if (cli_compare_scene(kit, scene) != 0) {
        return CLI_FAILED;
    }
    one->records = calloc((size_t)scene->host.scene.facet_count + 1, sizeof *one->records);
    return one->records ? cli_compare_run(&scene->host, &one->pose, 0, one->records)
                        : cli_out_of_memory();
}

/* ---- lines of others ---- */

compare_case *cli_compare_find(const compare_kit *kit, const compare_table *table)
{
    char name[KIT_NAME];
    const char *best = NULL;
    const compare_scene *scene = NULL;
    int tiers = 0;
    if (cli_table_name(table, 0, name) != 0) {
        return NULL;
    }
    for (uint32_t i = 0; i < kit->scenes && !scene; i++) {
        scene = strcmp(kit->scene[i].name, name) == 0 ? &kit->scene[i] : NULL;
        best = lrcs_host_name_nearer(name, best, kit->scene[i].name);
        tiers = kit->scene[i].tier > tiers ? kit->scene[i].tier : tiers;
    }
    if (!scene) {
        cli_table_refuse(table, 0,
                         "a scene of the kit, which has tiers 1 .. %d (the nearest is %s)", tiers,
                         best ? best : "none");
        return NULL;
    }
    if (cli_table_name(table, 1, name) != 0) {
        return NULL;
    }
    best = NULL;
    for (uint32_t i = scene->first; i < scene->first + scene->count; i++) {
        if (strcmp(kit->list[i].attitude, name) == 0) {
            return &kit->list[i];
        }
        best = lrcs_host_name_nearer(name, best, kit->list[i].attitude);
    }
    cli_table_refuse(table, 1, "an attitude of %s (the nearest is %s)", scene->name,
                     best ? best : "none");
    return NULL;
}
