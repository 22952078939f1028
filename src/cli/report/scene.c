/* SPDX-License-Identifier: MIT */
/* The part of a report on the scene: the model, its materials, and all notices. */
#include "cli/report/report.h"

#include <math.h>
#include <string.h>

/* Writes how many rows a table leaves out. */
static void more_say(FILE *out, uint32_t more)
{
    if (more > 0) {
        fputs("<p class=\"faint\">", out);
        cli_page_say(out, "%lu more are not listed; lrcs info has them.", (unsigned long)more);
        fputs("</p>\n", out);
    }
}

/* ---- the model ---- */

static void fact_count(FILE *out, const char *name, uint64_t value)
{
    cli_page_fact(out, name);
    cli_page_count(out, value);
    cli_page_fact_end(out);
}

static void fact_text(FILE *out, const char *name, const char *text)
{
    cli_page_fact(out, name);
    cli_page_text(out, text);
    cli_page_fact_end(out);
}

static void fact_box(FILE *out, const lrcs_mesh_report *r)
{
    cli_page_fact(out, "Box");
    for (int k = 0; k < 3; k++) {
        fputs(k > 0 ? " \xc3\x97 " : "", out);
        cli_page_number(out, NULL, r->box_max[k] - r->box_min[k], 5);
    }
    fputs("\xc2\xa0m", out);
    cli_page_fact_end(out);
}

static void model_facts(FILE *out, const report_job *job)
{
    const lrcs_scene *scene = &job->info.scene.scene;
    const lrcs_mesh_report *r = &job->info.report;
    fputs("<dl class=\"facts\">\n", out);
    fact_count(out, "Parts", job->info.parts);
    fact_count(out, "Facets", scene->facet_count);
    fact_count(out, "Vertices", scene->vertex_count);
    fact_box(out, r);
    cli_page_fact_number(out, "Surface", NULL, r->area, 7, "m\xc2\xb2");
    if (r->closed) {
        cli_page_fact_number(out, "Volume", NULL, r->volume, 7, "m\xc2\xb3");
    } else {
        fact_text(out, "Volume", "none: not closed");
    }
    fact_text(out, "Closed", r->closed ? "yes" : "no");
    fact_text(out, "Convex", r->convex ? "yes" : "no");
    fputs("</dl>\n", out);
    cli_page_fold(out, "Defects of the mesh");
    fputs("<dl class=\"facts\">\n", out);
    fact_count(out, "Facets without area", r->degenerate);
    fact_count(out, "Doubled facets", r->duplicate);
    fact_count(out, "of these, facing the other way", r->opposite_pairs);
    fact_count(out, "Open edges", r->boundary_edges);
    fact_count(out, "Edges of three or more facets", r->nonmanifold_edges);
    fputs("</dl>\n", out);
    cli_page_fold_end(out);
}

static void model_glint(FILE *out, const cli_info *info)
{
    const lrcs_scene *scene = &info->scene.scene;
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
        cli_page_row(out);
        cli_page_name_cell(out, scene->part[glint->part].name, "(no name)");
        cli_page_name_cell(out, scene->material[glint->material].name, "(default)");
        cli_page_number_cell(out, glint->s, 4);
        cli_page_number_cell(out, glint->turn * CLI_DEGREES, 3);
        cli_page_number_cell(out, glint->error, 2);
        cli_page_number_cell(out, glint->around_1_percent, 6);
        cli_page_number_cell(out, glint->around_01_percent, 6);
        cli_page_row_end(out);
    }
    cli_page_table_end(out);
    more_say(out, info->glint_count > REPORT_ROWS ? info->glint_count - REPORT_ROWS : 0);
    cli_page_fold_end(out);
}

/* ---- materials ---- */

static void material_name_cell(FILE *out, const lrcs_material *material)
{
    cli_page_cell(out);
    if (material->has_colour) {
        fprintf(out, "<span class=\"dot\" style=\"background:#%02x%02x%02x\"></span>",
                material->rgb[0], material->rgb[1], material->rgb[2]);
    }
    cli_page_name(out, material->name, "(default)");
    cli_page_cell_end(out);
}

static void material_row(FILE *out, const lrcs_material *material, const info_material *found)
{
    cli_page_row(out);
    material_name_cell(out, material);
    cli_page_count_cell(out, found->facets);
    cli_page_number_cell(out, cli_sum_value(&found->area), 6);
    cli_page_number_cell(out, material->brdf.A, 6);
    cli_page_number_cell(out, material->brdf.B, 6);
    cli_page_number_cell(out, material->brdf.s, 6);
    cli_page_number_cell(out, material->brdf.m, 6);
    fprintf(out, "<td>%s%s%s</td>",
            material->bound                                    ? ""
            : strcmp(cli_material_source(material), "default") ? "assumed"
                                                               : "not bound: the default",
            material->two_sided ? " two-sided" : "", material->omitted ? " left out" : "");
    cli_page_row_end(out);
}

static void materials_section(FILE *out, const report_job *job)
{
    const lrcs_scene *scene = &job->info.scene.scene;
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
        if (cli_info_shows(&job->info, i) && shown < REPORT_ROWS) {
            material_row(out, &scene->material[i], &job->info.material[i]);
            shown++;
        } else {
            more += cli_info_shows(&job->info, i) ? 1 : 0;
        }
    }
    cli_page_table_end(out);
    more_say(out, more);
    cli_page_fold_end(out);
    cli_page_section_end(out);
}

/* ---- notices ---- */

static void notice_item(FILE *out, const char *text)
{
    fputs("<li>", out);
    cli_page_text(out, text);
    fputs("</li>\n", out);
}

void cli_report_notices(FILE *out, const report_job *job)
{
    const lrcs_host_notices *notices = &job->scene.notices;
    char text[INFO_NOTICE_SIZE];
    uint32_t count = notices->count;
    cli_page_section(out, "notices", "Warnings and notices");
    fputs("<ul class=\"notices\">\n", out);
    for (uint32_t bits = job->result.flags, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            fputs("<li><b>", out);
            cli_page_text(out, lrcs_flag_text((int)bit));
            fputs("</b>: the answer is degraded, and its bound wider for it</li>\n", out);
            count++;
        }
    }
    for (uint32_t i = 0; i < notices->count; i++) {
        notice_item(out, notices->text[i]);
    }
    for (int i = 0; i < INFO_NOTICES; i++) {
        const char *notice = cli_info_notice(&job->info, i, text);
        if (notice) {
            notice_item(out, notice);
            count++;
        }
    }
    for (uint32_t bits = job->result.notices, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            notice_item(out, lrcs_notice_text((int)bit));
            count++;
        }
    }
    fputs(count > 0 ? "</ul>\n" : "<li>none</li>\n</ul>\n", out);
    cli_page_section_end(out);
}

void cli_report_scene(FILE *out, const report_job *job)
{
    cli_page_section(out, "model", "Model");
    model_facts(out, job);
    model_glint(out, &job->info);
    cli_page_section_end(out);
    materials_section(out, job);
}
