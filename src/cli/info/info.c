/* SPDX-License-Identifier: MIT */
/* lrcs info: the content of a scene, and its defects and peculiarities. */
#include "cli/info/info.h"

#include <stdlib.h>
#include <string.h>

static const char info_help[] =
    "usage: lrcs info SCENE [--unit U] [--material [WHAT=]BRDF] [--two-sided WHAT]\n"
    "                 [--keep-transparent] [--json]\n"
    "\n"
    "Lists what SCENE holds: parts, materials, area (m2), volume (m3), box (m) and defects of\n"
    "the mesh; whether its facets are fine enough for the glint of their materials; and which\n"
    "facets of a model are proved to lie on a plane, cylinder, sphere or cone, and how close\n"
    "(m). Counts are those of the file; notices say what a run leaves out.\n"
    "\n"
    "  --unit U              unit of a model: mm, cm, m (default), in, ft or metres per unit\n"
    "  --material [WHAT=]BRDF  as in lrcs run: shows which material each facet would have\n"
    "  --two-sided WHAT      likewise: all, open, a part or a material\n"
    "  --keep-transparent    keeps facets that the file declares fully transparent\n"
    "  --json                the same as JSON\n"
    "\n"
    "examples\n"
    "  lrcs info demo\n"
    "  lrcs info aura.3ds --unit in --json\n";

static const cli_option info_options[] = {
    {"unit", 1, 0}, {"material", 1, 1},         {"two-sided", 1, 0},
    {"json", 0, 0}, {"keep-transparent", 0, 0}, {"help", 0, 0},
    {NULL, 0, 0}};

typedef struct info_job {
    lrcs_host_scene scene;
    lrcs_host_inventory all;
    lrcs_host_surfaces surfaces;
} info_job;

int cli_inventory_make(const cli_args *args, const lrcs_host_scene *base, const lrcs_scene *scene,
                       lrcs_host_inventory *inventory)
{
    lrcs_host_error error;
    return lrcs_host_inventory_make(base, scene, inventory, &error) == LRCS_OK
               ? 0
               : cli_fail("%s: %s", args->operand, error.text);
}

int cli_material_listed(const lrcs_host_inventory *inventory, const lrcs_scene *scene,
                        uint32_t material)
{
    return inventory->material[material].facets > 0 || scene->material[material].name[0];
}

/* ---- JSON ---- */

static void info_json(const cli_args *args, const info_job *info)
{
    const lrcs_scene *scene = &info->scene.scene;
    const lrcs_host_inventory *all = &info->all;
    const lrcs_mesh_report *report = &all->report;
    char text[LRCS_HOST_INVENTORY_NOTICE], colour[CLI_COLOUR_TEXT];
    lrcs_host_json json = lrcs_host_json_make(stdout);
    lrcs_host_json_put(&json, "{\n");
    cli_version_json(&json);
    cli_files_json(&info->scene, &json);
    lrcs_host_json_put(&json, "unit=%s parts=%u vertices=%u facets=%u area_m2=%g volume_m3=%g",
                       cli_scene_unit(args, &info->scene), all->parts, scene->vertex_count,
                       scene->facet_count, report->area, report->volume);
    lrcs_host_json_numbers(&json, "box_min_m", report->box_min, 3);
    lrcs_host_json_numbers(&json, "box_max_m", report->box_max, 3);
    lrcs_host_json_put(&json, "closed=%d convex=%d", report->closed, report->convex);
    lrcs_host_json_put(&json, "materials=[\n");
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *material = &scene->material[i];
        if (!cli_material_listed(all, scene, i)) {
            continue;
        }
        cli_colour_text(material->rgb, colour);
        lrcs_host_json_put(&json, "{name=%s colour=%s facets=%u area_m2=%g brdf={", material->name,
                           material->has_colour ? colour : NULL, all->material[i].facets,
                           all->material[i].area_m2);
        cli_brdf_json(&material->brdf, &json);
        lrcs_host_json_put(&json, "}}");
    }
    lrcs_host_json_put(&json,
                       "] defects={degenerate=%u duplicate=%u opposite_pairs=%u boundary_edges=%u "
                       "nonmanifold_edges=%u} glint=[\n",
                       report->degenerate, report->duplicate, report->opposite_pairs,
                       report->boundary_edges, report->nonmanifold_edges);
    for (uint32_t i = 0; i < all->glint_count; i++) {
        const lrcs_host_glint *glint = &all->glint[i];
        lrcs_host_json_put(
            &json, "{part=%s material=%s s=%g turn_estimate_deg=%g relative_error_estimate=%g",
            scene->part[glint->part].name, scene->material[glint->material].name, glint->s,
            glint->turn * LRCS_DEGREES_PER_RADIAN, glint->error);
        lrcs_host_json_put(&json, "facets_around_for_1e-2=%g facets_around_for_1e-3=%g}",
                           glint->around_1_percent, glint->around_01_percent);
    }
    lrcs_host_json_put(&json, "]");
    cli_surfaces_json(&info->surfaces, scene, &json);
    lrcs_host_json_put(&json, "notices=[\n");
    cli_notices_json(&info->scene.notices, &json);
    for (int i = 0; i < LRCS_HOST_INVENTORY_NOTICES; i++) {
        const char *notice = lrcs_host_inventory_notice(all, scene, i, text);
        if (notice) {
            lrcs_host_json_text(&json, NULL, notice);
        }
    }
    lrcs_host_json_put(&json, "] title=%s", cli_scene_title(args, &info->scene));
    cli_options_json(args, &json);
    lrcs_host_json_put(&json, "}");
}

/* ---- the table ---- */

static void table_materials(const lrcs_host_inventory *all, const lrcs_scene *scene)
{
    printf("materials\n  %-24s %-8s %9s %12s  %s\n", "name", "colour", "facets", "area m2",
           "A,B,s,m");
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *material = &scene->material[i];
        char colour[CLI_COLOUR_TEXT];
        if (!cli_material_listed(all, scene, i)) {
            continue;
        }
        printf("  ");
        cli_column(cli_material_name(material), 24);
        printf(" %-8s %9lu %12.6g  %g,%g,%g,%g%s%s%s\n",
               material->has_colour ? cli_colour_text(material->rgb, colour) : "-",
               (unsigned long)all->material[i].facets, all->material[i].area_m2, material->brdf.A,
               material->brdf.B, material->brdf.s, material->brdf.m,
               material->brdf_given             ? ""
               : cli_material_guessed(material) ? "  (assumed)"
                                                : "  (unassigned)",
               material->two_sided ? "  two-sided" : "", material->omitted ? "  left out" : "");
    }
}

static void table_glint(const lrcs_host_inventory *all, const lrcs_scene *scene)
{
    if (all->glint_count == 0) {
        printf("glint        no curved part with smoothing groups or vertex normals\n");
        return;
    }
    printf("glint        estimates for curved parts\n"
           "  %-20s %-20s %6s %9s %9s %8s %8s\n",
           "part", "material", "s", "turn deg", "error", "N 1 %", "N 0.1 %");
    for (uint32_t i = 0; i < all->glint_count; i++) {
        const lrcs_host_glint *glint = &all->glint[i];
        printf("  ");
        cli_column(scene->part[glint->part].name, 20);
        printf(" ");
        cli_column(cli_material_name(&scene->material[glint->material]), 20);
        printf(" %6g %9.3g %8.2g%s %8.0f %8.0f\n", glint->s, glint->turn * LRCS_DEGREES_PER_RADIAN,
               glint->error, glint->error > LRCS_HOST_GLINT_COARSE ? "!" : " ",
               glint->around_1_percent, glint->around_01_percent);
    }
    printf("  turn: the angle between the normals of neighbouring facets; error: relative, of the "
           "glint, at\n  the worst aspect (!: above %g, too coarse); N: facets around a full turn "
           "for an error of 1 %%, 0.1 %%\n",
           LRCS_HOST_GLINT_COARSE);
}

static void info_table(const info_job *info, const cli_args *args)
{
    const lrcs_scene *scene = &info->scene.scene;
    const lrcs_host_inventory *all = &info->all;
    const lrcs_mesh_report *r = &all->report;
    char text[LRCS_HOST_INVENTORY_NOTICE];
    int tessellated = lrcs_host_scene_tessellated(scene);
    printf("scene        ");
    cli_scene_print(args, &info->scene);
    printf("\nparts        %lu\nvertices     %lu\nfacets       %lu%s\n", (unsigned long)all->parts,
           (unsigned long)scene->vertex_count, (unsigned long)scene->facet_count,
           tessellated ? "   curved shapes divided for a tolerance of 1e-4; a run begins with fewer"
                       : "");
    printf("area         %.10g m2\nvolume       %.10g m3%s\n", r->area, r->volume,
           r->closed ? "" : "   (not closed)");
    printf("box          %.9g, %.9g, %.9g .. %.9g, %.9g, %.9g m%s\n", r->box_min[0], r->box_min[1],
           r->box_min[2], r->box_max[0], r->box_max[1], r->box_max[2],
           tessellated ? "   of the facets" : "");
    printf("closed       %s\nconvex       %s\n", r->closed ? "yes" : "no",
           r->convex ? "yes" : "no");
    table_materials(all, scene);
    printf("defects      %lu degenerate, %lu duplicate (%lu facing the other way), "
           "%lu boundary edges, %lu non-manifold edges\n",
           (unsigned long)r->degenerate, (unsigned long)r->duplicate,
           (unsigned long)r->opposite_pairs, (unsigned long)r->boundary_edges,
           (unsigned long)r->nonmanifold_edges);
    table_glint(all, scene);
    cli_surfaces_table(&info->surfaces, scene);
    cli_notices_print(stdout, &info->scene.notices);
    for (int i = 0; i < LRCS_HOST_INVENTORY_NOTICES; i++) {
        const char *notice = lrcs_host_inventory_notice(all, scene, i, text);
        if (notice) {
            printf("notice: %s\n", notice);
        }
    }
}

static int info_command(const cli_args *args)
{
    info_job info;
    lrcs_host_options options;
    lrcs_host_error error;
    memset(&info, 0, sizeof info);
    int code = cli_scene_options_read(args, &options);
    options.build.normals = LRCS_NORMALS_SMOOTH;
    code = code ? code : cli_scene_read(args, &options, &info.scene);
    code = code ? code : cli_inventory_make(args, &info.scene, &info.scene.scene, &info.all);
    cli_watch_stage("looking for planes, cylinders, spheres, cones", NULL);
    if (code == 0 &&
        lrcs_host_surfaces_find(&info.scene.scene, &info.surfaces, &error) != LRCS_OK) {
        code = cli_failed(&error);
    }
    cli_watch_end();
    if (code == 0 && cli_value(args, "json")) {
        info_json(args, &info);
    } else if (code == 0) {
        info_table(&info, args);
    }
    lrcs_host_surfaces_free(&info.surfaces);
    lrcs_host_inventory_free(&info.all);
    lrcs_host_scene_free(&info.scene);
    cli_scene_options_free(&options);
    return code;
}

const cli_command cli_info_command = {
    "info",    "SCENE",      "give a .3ds, .obj or .stl model, a scene file, or demo",
    info_help, info_options, info_command,
    NULL};
