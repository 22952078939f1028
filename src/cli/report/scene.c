/* SPDX-License-Identifier: MIT */
/* The part of a report on the scene: the model, its materials, and all notices. */
#include "cli/report/report.h"

#include <math.h>
#include <string.h>

/* Writes how many rows a table leaves out, and ends the fold around it. */
static void fold_end(FILE *out, uint32_t more)
{
    if (more > 0) {
        cli_page(out, "<p class=\"faint\">%u more are not listed; lrcs info has them.</p>\n", more);
    }
    fputs("</details>\n", out);
}

/* ---- the model ---- */

static void model_facts(FILE *out, const report_job *job)
{
    const lrcs_scene *scene = &job->info_scene.scene;
    const lrcs_mesh_report *r = &job->info.report;
    fputs("<dl class=\"facts\">\n", out);
    cli_page_fact(out, "Parts", "%u", job->info.parts);
    if (lrcs_host_scene_tessellated(scene)) {
        cli_page_fact(out, "Facets, curved shapes divided for a tolerance of 1e-4",
                      "%u; the run has %u", scene->facet_count, job->run.result.facets_total);
    } else {
        cli_page_fact(out, "Facets", "%u", scene->facet_count);
    }
    cli_page_fact(out, "Vertices", "%u", scene->vertex_count);
    cli_page_fact(out, "Box", "%.5g \xc3\x97 %.5g \xc3\x97 %.5g\xc2\xa0m",
                  r->box_max[0] - r->box_min[0], r->box_max[1] - r->box_min[1],
                  r->box_max[2] - r->box_min[2]);
    cli_page_fact(out, "Surface", "%.7g m\xc2\xb2", r->area);
    if (r->closed) {
        cli_page_fact(out, "Volume", "%.7g m\xc2\xb3", r->volume);
    } else {
        cli_page_fact(out, "Volume", "none: not closed");
    }
    cli_page_fact(out, "Closed", r->closed ? "yes" : "no");
    cli_page_fact(out, "Convex", r->convex ? "yes" : "no");
    fputs("</dl>\n", out);
    cli_page_fold(out, "Defects of the mesh");
    fputs("<dl class=\"facts\">\n", out);
    cli_page_fact(out, "Facets without area", "%u", r->degenerate);
    cli_page_fact(out, "Doubled facets", "%u", r->duplicate);
    cli_page_fact(out, "of these, facing the other way", "%u", r->opposite_pairs);
    cli_page_fact(out, "Open edges", "%u", r->boundary_edges);
    cli_page_fact(out, "Edges of three or more facets", "%u", r->nonmanifold_edges);
    fputs("</dl>\n</details>\n", out);
}

static void model_glint(FILE *out, const lrcs_host_inventory *info, const lrcs_scene *scene)
{
    if (info->glint_count == 0) {
        return;
    }
    cli_page_fold(out, "Is the mesh fine enough for its glint?");
    fputs("<p>Estimates for curved parts: how far flat facets may misjudge the glint at the worst "
          "aspect, and how many facets around a full turn would serve.</p>\n",
          out);
    cli_page_table(out, "Glint adequacy",
                   "Part|Material|#s|#Turn, deg|#Error|#N for 1 %|#N for 0.1 %");
    for (uint32_t i = 0; i < info->glint_count && i < REPORT_ROWS; i++) {
        const lrcs_host_glint *glint = &info->glint[i];
        cli_page_row(out, "%s(no name)%s(default)%.4g%.3g%.2g%.6g%.6g",
                     scene->part[glint->part].name, scene->material[glint->material].name, glint->s,
                     glint->turn * LRCS_DEGREES_PER_RADIAN, glint->error, glint->around_1_percent,
                     glint->around_01_percent);
    }
    cli_page_table_end(out);
    fold_end(out, info->glint_count > REPORT_ROWS ? info->glint_count - REPORT_ROWS : 0);
}

/* ---- materials ---- */

static void material_row(FILE *out, const lrcs_material *material, uint32_t facets, double area_m2)
{
    fputs("\n<tr><td class=\"name\">", out);
    if (material->has_colour) {
        fprintf(out, "<span class=\"dot\" style=\"background:#%02x%02x%02x\"></span>",
                material->rgb[0], material->rgb[1], material->rgb[2]);
    }
    cli_page_name(out, material->name, "(default)");
    fputs("</td>", out);
    cli_page_cells(out, "%u%.6g%.6g%.6g%.6g%.6g", facets, area_m2, material->brdf.A,
                   material->brdf.B, material->brdf.s, material->brdf.m);
    const char *source = cli_material_source(material);
    fprintf(out, "<td>%s",
            cli_material_guessed(material)   ? "GUESSED: assumed, as the scene file says"
            : strcmp(source, "default") == 0 ? "not bound: the default"
                                             : "");
    if (strcmp(source, "illustrative") == 0) {
        cli_page(out, "illustrative: the numbers of the library's %s",
                 cli_brdf_entry(&material->brdf)->name);
    } else if (strcmp(source, "published") == 0) {
        cli_page(out, "published reflectance: %s", cli_brdf_entry(&material->brdf)->name);
    }
    fprintf(out, "%s%s%s</td></tr>",
            strcmp(source, "given") != 0 && material->two_sided ? "; " : "",
            material->two_sided ? "two-sided" : "", material->omitted ? " left out" : "");
}

static void materials_section(FILE *out, const report_job *job)
{
    const lrcs_scene *scene = &job->info_scene.scene;
    uint32_t shown = 0;
    uint32_t more = 0;
    cli_page_section(out, "materials", "Materials");
    fputs("<p>f<sub>r</sub>(\xce\xb8) = A cos<sup>\xe2\x88\x92"
          "6</sup>\xce\xb8 "
          "exp(\xe2\x88\x92tan\xc2\xb2\xce\xb8 / s\xc2\xb2) + B cos<sup>m</sup>\xce\xb8: the "
          "glint, of "
          "rms slope s, and the diffuse part, of exponent m. A and B are per steradian.</p>\n",
          out);
    cli_page_fold(out, "Materials, their areas and numbers");
    cli_page_table(out, "Materials", "Material|#Facets|#Area, m\xc2\xb2|#A|#B|#s|#m|Remarks");
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (cli_material_listed(&job->info, scene, i) && shown < REPORT_ROWS) {
            material_row(out, &scene->material[i], job->info.material[i].facets,
                         job->info.material[i].area_m2);
            shown++;
        } else {
            more += cli_material_listed(&job->info, scene, i) ? 1 : 0;
        }
    }
    cli_page_table_end(out);
    fold_end(out, more);
    fputs("</section>\n", out);
}

/* ---- notices ---- */

void cli_report_notices(FILE *out, const report_job *job)
{
    const lrcs_host_notices *notices = &job->run.scene.notices;
    char text[LRCS_HOST_INVENTORY_NOTICE];
    uint32_t count = notices->count;
    cli_page_section(out, "notices", "Warnings and notices");
    fputs("<ul class=\"notices\">\n", out);
    uint32_t flags = cli_flags_in_force(job->args, &job->run.options, job->run.result.flags);
    for (uint32_t bits = flags; bits != 0; bits &= bits - 1) {
        cli_page(out, "<li><b>%s</b>: the answer is degraded, and its bound wider for it</li>\n",
                 lrcs_flag_text(CLI_LOWEST(bits)));
        count++;
    }
    for (uint32_t i = 0; i < notices->count; i++) {
        cli_page(out, "<li>%s</li>\n", notices->text[i]);
    }
    for (int i = 0; i < LRCS_HOST_INVENTORY_NOTICES; i++) {
        const char *notice =
            lrcs_host_inventory_notice(&job->info, &job->info_scene.scene, i, text);
        if (notice) {
            cli_page(out, "<li>%s</li>\n", notice);
            count++;
        }
    }
    for (uint32_t bits = job->run.result.notices; bits != 0; bits &= bits - 1) {
        cli_page(out, "<li>%s</li>\n", lrcs_notice_text(CLI_LOWEST(bits)));
        count++;
    }
    fputs(count > 0 ? "</ul>\n" : "<li>none</li>\n</ul>\n", out);
    fputs("</section>\n", out);
}

void cli_report_scene(FILE *out, const report_job *job)
{
    cli_page_section(out, "model", "Model");
    model_facts(out, job);
    model_glint(out, &job->info, &job->info_scene.scene);
    fputs("</section>\n", out);
    materials_section(out, job);
}
