/* SPDX-License-Identifier: MIT */
/* lrcs info: what a scene holds, and what is wrong or remarkable in it. */
#include "cli/cli.h"

#include <math.h>
#include <stdlib.h>

static const char info_help[] =
    "usage: lrcs info SCENE [--unit U] [--material [WHAT=]BRDF] [--keep-transparent] [--json]\n"
    "\n"
    "What SCENE holds: parts, materials, area (m2), volume (m3), box (m), defects of the mesh,\n"
    "and whether its facets are fine enough for the glint of what they wear. Counts are of what\n"
    "the file stores; notices say what a run leaves out.\n"
    "\n"
    "  --unit U              of a model file: mm, cm, m (default), in, ft or metres per unit\n"
    "  --material [WHAT=]BRDF  as in lrcs run: shows what would wear what\n"
    "  --keep-transparent    keep facets that the file calls fully transparent\n"
    "  --json                the same as JSON\n"
    "\n"
    "examples\n"
    "  lrcs info demo\n"
    "  lrcs info aura.3ds --unit in --json\n";

static const cli_option info_options[] = {{"unit", 1, 0}, {"material", 1, 1},
                                          {"json", 0, 0}, {"keep-transparent", 0, 0},
                                          {"help", 0, 0}, {NULL, 0, 0}};

/* Where the glint error passes this, a run is warned about. */
#define GLINT_WARN 1e-2

#define DEGREES (180.0 / 3.14159265358979323846)

typedef struct info_material {
    uint32_t facets;
    cli_sum area;
} info_material;

typedef struct info_job {
    const cli_args *args;
    lrcs_host_scene scene;
    uint32_t parts;
    lrcs_mesh_report report;
    info_material *material;
    lrcs_host_glint *glint;
    uint32_t glint_count;
} info_job;

static double facet_area(const lrcs_scene *scene, uint32_t facet)
{
    const uint32_t *corner = scene->facet[facet].corner;
    const double *a = scene->vertex[corner[0]].x;
    const double *b = scene->vertex[corner[1]].x;
    const double *c = scene->vertex[corner[2]].x;
    double n[3];
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    return 0.5 * hypot(hypot(n[0], n[1]), n[2]);
}

static int materials_count(info_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    job->material = calloc((size_t)scene->material_count + 1, sizeof *job->material);
    if (!job->material) {
        return -1;
    }
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        info_material *material = &job->material[scene->facet_material[i]];
        material->facets++;
        cli_sum_add(&material->area, facet_area(scene, i));
    }
    return 0;
}

/* Parts as files and shapes count them. */
static uint32_t parts_count(const lrcs_host_scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->recipe.part_count; i++) {
        count += scene->recipe.part[i].file ? scene->model[i].part_count : 1;
    }
    return count;
}

static int mesh_examine(info_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    size_t need = lrcs_mesh_check_need(scene->vertex_count, scene->facet_count);
    void *bytes = malloc(need);
    lrcs_work work = lrcs_work_make(bytes, need);
    int status = bytes ? lrcs_mesh_check(scene->vertex, scene->vertex_count, scene->facet,
                                         scene->facet_count, &work, &job->report)
                       : LRCS_E_MEMORY;
    free(bytes);
    return status;
}

static int info_gather(info_job *job)
{
    lrcs_host_error error;
    int status = mesh_examine(job);
    if (status != LRCS_OK || materials_count(job) != 0) {
        fprintf(stderr, "lrcs: %s: %s\n", job->args->operand,
                status == LRCS_OK || status == LRCS_E_MEMORY ? "out of memory"
                                                             : lrcs_status_text(status));
        return CLI_FAILED;
    }
    if (lrcs_host_glint_check(&job->scene.scene, &job->glint, &job->glint_count, &error) !=
        LRCS_OK) {
        return cli_failed(&error);
    }
    job->parts = parts_count(&job->scene);
    return 0;
}

/* Whether a material is worth a line: the default is not when nothing wears it. */
static int material_shown(const info_job *job, uint32_t i)
{
    return job->material[i].facets > 0 || job->scene.scene.material[i].name[0];
}

/* ---- what the mesh itself gives notice of ---- */

/* Sentence `i` about the mesh, or NULL; of the glint, the worst only. */
static const char *mesh_notice(const info_job *job, int i, char *text, size_t size)
{
    const lrcs_mesh_report *report = &job->report;
    uint32_t poor = 0;
    uint32_t silent = 0;
    switch (i) {
    case 0:
        return report->closed || job->scene.scene.facet_count == 0
                   ? NULL
                   : "the mesh is not closed: its back sides may show, and its volume has no "
                     "meaning";
    case 1:
        return report->closed && report->volume < 0.0
                   ? "the mesh is closed but inverted (negative volume): its fronts face inwards"
                   : NULL;
    case 2:
        for (uint32_t k = 0; k < job->scene.scene.part_count; k++) {
            const lrcs_part *part = &job->scene.scene.part[k];
            silent += part->kind < 0 && !part->smoothed && part->facet_count > 0;
        }
        return silent > 0 ? "a model has no smoothing groups or vertex normals: whether its facets "
                            "stand for curves is not known"
                          : NULL;
    default:
        for (uint32_t k = 0; k < job->glint_count; k++) {
            poor += job->glint[k].error > GLINT_WARN;
        }
        snprintf(text, size,
                 "glint: %lu of %lu curved parts are too coarse for their material's slope "
                 "(estimated error above 1 %%); lrcs run --normals auto curves them",
                 (unsigned long)poor, (unsigned long)job->glint_count);
        return poor > 0 ? text : NULL;
    }
}

#define MESH_NOTICES 4

/* ---- JSON ---- */

static void json_point(lrcs_host_json *json, const char *key, const double x[3])
{
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_ARRAY);
    for (int k = 0; k < 3; k++) {
        lrcs_host_json_number(json, NULL, x[k]);
    }
    lrcs_host_json_end(json);
}

static void json_materials(const info_job *job, lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "materials", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < job->scene.scene.material_count; i++) {
        const lrcs_material *material = &job->scene.scene.material[i];
        char colour[8];
        if (!material_shown(job, i)) {
            continue;
        }
        snprintf(colour, sizeof colour, "#%02X%02X%02X", material->rgb[0], material->rgb[1],
                 material->rgb[2]);
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "name", material->name);
        lrcs_host_json_text(json, "colour", material->has_colour ? colour : NULL);
        lrcs_host_json_count(json, "facets", job->material[i].facets);
        lrcs_host_json_number(json, "area_m2", cli_sum_value(&job->material[i].area));
        lrcs_host_json_begin(json, "brdf", LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_number(json, "A", material->brdf.A);
        lrcs_host_json_number(json, "B", material->brdf.B);
        lrcs_host_json_number(json, "s", material->brdf.s);
        lrcs_host_json_number(json, "m", material->brdf.m);
        lrcs_host_json_end(json);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
}

static void json_glint(const info_job *job, lrcs_host_json *json)
{
    const lrcs_scene *scene = &job->scene.scene;
    lrcs_host_json_begin(json, "glint", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < job->glint_count; i++) {
        const lrcs_host_glint *glint = &job->glint[i];
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "part", scene->part[glint->part].name);
        lrcs_host_json_text(json, "material", scene->material[glint->material].name);
        lrcs_host_json_number(json, "s", glint->s);
        lrcs_host_json_number(json, "turn_estimate_deg", glint->turn * DEGREES);
        lrcs_host_json_number(json, "relative_error_estimate", glint->error);
        lrcs_host_json_number(json, "facets_around_for_1e-2", glint->around_1_percent);
        lrcs_host_json_number(json, "facets_around_for_1e-3", glint->around_01_percent);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
}

static void json_notices(const info_job *job, lrcs_host_json *json)
{
    const lrcs_host_notices *notices = &job->scene.notices;
    char text[160];
    lrcs_host_json_begin(json, "notices", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < notices->count; i++) {
        lrcs_host_json_text(json, NULL, notices->text[i]);
    }
    for (int i = 0; i < MESH_NOTICES; i++) {
        const char *notice = mesh_notice(job, i, text, sizeof text);
        if (notice) {
            lrcs_host_json_text(json, NULL, notice);
        }
    }
    lrcs_host_json_end(json);
}

static void info_json(const info_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    const lrcs_mesh_report *report = &job->report;
    lrcs_host_json json = lrcs_host_json_make(stdout);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    lrcs_host_json_count(&json, "parts", job->parts);
    lrcs_host_json_count(&json, "vertices", scene->vertex_count);
    lrcs_host_json_count(&json, "facets", scene->facet_count);
    lrcs_host_json_number(&json, "area_m2", report->area);
    lrcs_host_json_number(&json, "volume_m3", report->volume);
    json_point(&json, "box_min_m", report->box_min);
    json_point(&json, "box_max_m", report->box_max);
    lrcs_host_json_bool(&json, "closed", report->closed);
    lrcs_host_json_bool(&json, "convex", report->convex);
    json_materials(job, &json);
    lrcs_host_json_begin(&json, "defects", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_count(&json, "degenerate", report->degenerate);
    lrcs_host_json_count(&json, "duplicate", report->duplicate);
    lrcs_host_json_count(&json, "opposite_pairs", report->opposite_pairs);
    lrcs_host_json_count(&json, "boundary_edges", report->boundary_edges);
    lrcs_host_json_count(&json, "nonmanifold_edges", report->nonmanifold_edges);
    lrcs_host_json_end(&json);
    json_glint(job, &json);
    json_notices(job, &json);
    lrcs_host_json_end(&json);
}

/* ---- the table ---- */

static void table_materials(const info_job *job)
{
    printf("materials\n  %-24s %-8s %9s %12s  %s\n", "name", "colour", "facets", "area m2",
           "A,B,s,m");
    for (uint32_t i = 0; i < job->scene.scene.material_count; i++) {
        const lrcs_material *material = &job->scene.scene.material[i];
        char colour[8] = "-";
        if (!material_shown(job, i)) {
            continue;
        }
        if (material->has_colour) {
            snprintf(colour, sizeof colour, "#%02X%02X%02X", material->rgb[0], material->rgb[1],
                     material->rgb[2]);
        }
        printf("  ");
        cli_column(cli_material_name(material), 24);
        printf(" %-8s %9lu %12.6g  %g,%g,%g,%g%s%s%s\n", colour,
               (unsigned long)job->material[i].facets, cli_sum_value(&job->material[i].area),
               material->brdf.A, material->brdf.B, material->brdf.s, material->brdf.m,
               material->bound ? "" : "  (unbound)", material->two_sided ? "  two-sided" : "",
               material->omitted ? "  left out" : "");
    }
}

static void table_glint(const info_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    if (job->glint_count == 0) {
        printf("glint        no curved part with smoothing groups or vertex normals\n");
        return;
    }
    printf("glint        estimates for curved parts; N: facets around a full turn\n"
           "  %-20s %-20s %6s %9s %9s %8s %8s\n",
           "part", "material", "s", "turn deg", "error", "N 1 %", "N 0.1 %");
    for (uint32_t i = 0; i < job->glint_count; i++) {
        const lrcs_host_glint *glint = &job->glint[i];
        printf("  ");
        cli_column(scene->part[glint->part].name, 20);
        printf(" ");
        cli_column(cli_material_name(&scene->material[glint->material]), 20);
        printf(" %6g %9.3g %8.2g%s %8.0f %8.0f\n", glint->s, glint->turn * DEGREES, glint->error,
               glint->error > GLINT_WARN ? "!" : " ", glint->around_1_percent,
               glint->around_01_percent);
    }
}

static void info_table(const info_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    const lrcs_mesh_report *r = &job->report;
    char text[160];
    printf("scene        %s\nparts        %lu\nvertices     %lu\nfacets       %lu\n",
           job->args->operand, (unsigned long)job->parts, (unsigned long)scene->vertex_count,
           (unsigned long)scene->facet_count);
    printf("area         %.10g m2\nvolume       %.10g m3%s\n", r->area, r->volume,
           r->closed ? "" : "   (not closed)");
    printf("box          %.9g, %.9g, %.9g .. %.9g, %.9g, %.9g m\n", r->box_min[0], r->box_min[1],
           r->box_min[2], r->box_max[0], r->box_max[1], r->box_max[2]);
    printf("closed       %s\nconvex       %s\n", r->closed ? "yes" : "no",
           r->convex ? "yes" : "no");
    table_materials(job);
    printf("defects      %lu degenerate, %lu duplicate (%lu facing the other way), "
           "%lu boundary edges, %lu non-manifold edges\n",
           (unsigned long)r->degenerate, (unsigned long)r->duplicate,
           (unsigned long)r->opposite_pairs, (unsigned long)r->boundary_edges,
           (unsigned long)r->nonmanifold_edges);
    table_glint(job);
    cli_notices_print(stdout, &job->scene.notices);
    for (int i = 0; i < MESH_NOTICES; i++) {
        const char *notice = mesh_notice(job, i, text, sizeof text);
        if (notice) {
            printf("notice: %s\n", notice);
        }
    }
}

static int info_command(const cli_args *args)
{
    info_job job = {.args = args};
    lrcs_host_options options;
    int code = cli_scene_options_read(args, &options);
    options.build.normals = LRCS_NORMALS_SMOOTH; /* to see what the files say of them */
    code = code ? code : cli_scene_read(args, &options, &job.scene);
    code = code ? code : info_gather(&job);
    if (code == 0 && cli_value(args, "json")) {
        info_json(&job);
    } else if (code == 0) {
        info_table(&job);
    }
    free(job.material);
    free(job.glint);
    lrcs_host_scene_free(&job.scene);
    cli_scene_options_free(&options);
    return code;
}

const cli_command cli_info_command = {
    "info",    "SCENE",      "give a .3ds, .obj or .stl model, a scene file, or demo",
    info_help, info_options, info_command};
