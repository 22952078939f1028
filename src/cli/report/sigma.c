/* SPDX-License-Identifier: MIT */
/* The part of a report on sigma from its pose: the value with its certificate, the effects that
   were simulated and those left out, and what contributes to it. */
#include "cli/report/report.h"

#include <math.h>

/* ---- the certificate ---- */

static void sigma_facts(FILE *out, const report_job *job)
{
    const lrcs_result *r = &job->result;
    fputs("<dl class=\"facts\">\n", out);
    cli_page_fact_number(out, "\xcf\x83", "sigma_m2", r->sigma_m2, 10, "m\xc2\xb2");
    if (r->sigma_m2 > 0.0) {
        cli_page_fact_number(out, "in decibels", "sigma_dbsm", cli_dbsm(r->sigma_m2), 8, "dBsm");
    }
    cli_page_fact_number(out, "of it, glint", "sigma_glint_m2", r->sigma_glint_m2, 7, "m\xc2\xb2");
    cli_page_fact_number(out, "of it, diffuse", "sigma_diffuse_m2", r->sigma_diffuse_m2, 7,
                         "m\xc2\xb2");
    cli_page_fact(out, "Bound, proved");
    cli_page_bound(out, "bound_m2", r->bound_m2, 3);
    fputs(" m\xc2\xb2", out);
    cli_page_fact_end(out);
    if (job->uncertainty.stated) {
        cli_page_fact_number(out, "Materials, one standard deviation", "material_deviation_m2",
                             job->uncertainty.deviation_m2, 3, "m\xc2\xb2");
    }
    if (r->estimate_m2 >= 0.0) {
        cli_page_fact_number(out, "Likely error, an estimate", "estimate_m2", r->estimate_m2, 3,
                             "m\xc2\xb2");
    }
    if (r->curvature_estimate_m2 >= 0.0) {
        cli_page_fact_number(out, "Cubature over curved normals, an estimate beside the bound",
                             "curvature_estimate_m2", r->curvature_estimate_m2, 3, "m\xc2\xb2");
    }
    cli_page_fact_number(out, "Silhouette", "projected_area_m2", r->projected_area_m2, 8,
                         "m\xc2\xb2");
    fputs("</dl>\n", out);
}

static void budget_row(FILE *out, const report_job *job, const char *name, const char *id,
                       double value, const char *why)
{
    cli_page_row(out);
    fprintf(out, "<td>%s</td><td class=\"n\">", name);
    cli_page_bound(out, id, value, 3);
    fputs("</td>", out);
    cli_page_bound_cell(out, job->result.sigma_m2 > 0.0 ? value / job->result.sigma_m2 : -1.0, 2);
    fprintf(out, "<td class=\"why\">%s</td>", why);
    cli_page_row_end(out);
}

static void budget_table(FILE *out, const report_job *job)
{
    const lrcs_budget *budget = &job->result.budget;
    cli_page_fold(out, "Where the bound comes from");
    cli_page_table(out, "The bound by cause", "Cause|#Bound, m\xc2\xb2|#of \xcf\x83|What it holds");
    budget_row(out, job, "Visibility", "visibility_m2", budget->visibility_m2,
               "what of each facet is seen, by the raster or by clipping");
    budget_row(out, job, "Tessellation", "tessellation_m2", budget->tessellation_m2,
               budget->tessellation_m2 < 0.0    ? "not known for this scene: the bound refers to "
                                                  "its facets"
               : budget->tessellation_m2 == 0.0 ? "none: the facets are the truth"
                                                : "flat facets in the place of true shapes");
    budget_row(out, job, "Rounding", "rounding_m2", budget->rounding_m2,
               "every step of the arithmetic");
    cli_page_table_end(out);
    cli_page_fold_end(out);
}

static void method_words(FILE *out, const report_job *job)
{
    const lrcs_result *r = &job->result;
    fputs("<p>Method <b id=\"method\">", out);
    cli_page_text(out, lrcs_method_text(r->method));
    fputs("</b>", out);
    if (r->resolution != 0) {
        cli_page_say(out, " on a raster of %lu x %lu", (unsigned long)r->resolution,
                     (unsigned long)r->resolution);
    }
    fputs(job->options.method == LRCS_METHOD_AUTO ? ", chosen by auto: " : ": ", out);
    cli_page_text(out, r->method_reason);
    cli_page_say(
        out,
        ". Normals are %s. Of %lu facets %lu face the laser; of those that could reflect %lu "
        "are hidden and %lu partly hidden. The pose took %.3g ms, preparing the scene %.3g "
        "ms, loading it %.3g ms.",
        lrcs_normals_text(job->scene.scene.normals), (unsigned long)r->facets_total,
        (unsigned long)r->facets_front, (unsigned long)r->facets_hidden,
        (unsigned long)r->facets_partial, 1e3 * job->pose_s, 1e3 * job->scene.seconds_prepare,
        1e3 * job->scene.seconds_load);
    fputs("</p>\n", out);
}

void cli_report_effects(FILE *out, const report_job *job)
{
    cli_page_section(out, "effects", "What was simulated, and what was left out");
    fputs("<p>An effect that cannot matter is left out; the answer is provably the same without "
          "it.</p>\n",
          out);
    cli_page_fold(out, "Effects, and why");
    cli_page_table(out, "Effects", "Effect||Why");
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        const lrcs_effect *effect = &job->result.effect[i];
        cli_page_row(out);
        cli_page_cell(out);
        for (const char *at = lrcs_effect_text(i); *at; at++) {
            putc(*at == '_' ? ' ' : *at, out);
        }
        cli_page_cell_end(out);
        fputs(effect->on ? "<td class=\"on\">simulated</td>" : "<td class=\"off\">left out</td>",
              out);
        cli_page_name_cell(out, effect->reason, "");
        cli_page_row_end(out);
    }
    cli_page_table_end(out);
    cli_page_fold_end(out);
    cli_page_section_end(out);
}

void cli_report_sigma(FILE *out, const report_job *job)
{
    cli_page_section(out, "sigma", "\xcf\x83 and its certificate");
    sigma_facts(out, job);
    method_words(out, job);
    budget_table(out, job);
    cli_page_section_end(out);
}

/* ---- shares ---- */

static void share_row(FILE *out, const cli_shares *shares, const shares_row *row)
{
    cli_page_count_cell(out, row->facets);
    cli_page_number_cell(out, row->sigma_m2, 5);
    cli_page_share_cells(out, cli_share_of(shares, row->sigma_m2));
    cli_page_number_cell(out, row->glint_m2, 3);
    cli_page_number_cell(out, row->diffuse_m2, 3);
    cli_page_row_end(out);
}

static void share_table(FILE *out, const cli_shares *shares, const char *label, const char *columns,
                        const shares_row *row, uint32_t count, const char *nameless)
{
    uint32_t shown = cli_shares_shown(row, count);
    cli_page_table(out, label, columns);
    for (uint32_t i = 0; i < shown; i++) {
        cli_page_row(out);
        cli_page_name_cell(out, row[i].name, nameless);
        share_row(out, shares, &row[i]);
    }
    if (shown < count) {
        shares_row others = cli_shares_others(row, shown, count);
        cli_page_row_others(out);
        cli_page_cell(out);
        cli_page_say(out, "%lu other%s", (unsigned long)(count - shown),
                     count - shown > 1 ? "s" : "");
        cli_page_cell_end(out);
        share_row(out, shares, &others);
    }
    cli_page_table_end(out);
}

static void share_facets(FILE *out, const cli_shares *shares)
{
    cli_page_table(
        out, "The brightest facets",
        "#Facet|Part|Material|#\xce\xb8, deg|#Seen, m\xc2\xb2|#\xcf\x83, m\xc2\xb2|#Share|");
    for (uint32_t i = 0; i < shares->facets; i++) {
        const shares_facet *facet = &shares->facet[i];
        cli_page_row(out);
        cli_page_count_cell(out, facet->facet);
        cli_page_name_cell(out, facet->part, "(no name)");
        cli_page_name_cell(out, facet->material, "(default)");
        cli_page_number_cell(out, facet->theta_deg, 4);
        cli_page_number_cell(out, facet->visible_area_m2, 3);
        cli_page_number_cell(out, facet->sigma_m2, 5);
        cli_page_share_cells(out, cli_share_of(shares, facet->sigma_m2));
        cli_page_row_end(out);
    }
    cli_page_table_end(out);
}

void cli_report_shares(FILE *out, const report_job *job)
{
    const cli_shares *shares = &job->shares;
    cli_page_section(out, "shares", "Who makes \xcf\x83");
    fputs("<h3>Parts</h3>\n", out);
    share_table(out, shares, "Shares of parts",
                "Part|#Facets|#\xcf\x83, m\xc2\xb2|#Share||#Glint, m\xc2\xb2|#Diffuse, m\xc2\xb2",
                shares->part, shares->parts, "(no name)");
    cli_page_fold(out, "Materials");
    share_table(
        out, shares, "Shares of materials",
        "Material|#Facets|#\xcf\x83, m\xc2\xb2|#Share||#Glint, m\xc2\xb2|#Diffuse, m\xc2\xb2",
        shares->material, shares->materials, "(default)");
    cli_page_fold_end(out);
    if (shares->facets > 0) {
        cli_page_fold(out, "The brightest facets");
        share_facets(out, shares);
        cli_page_fold_end(out);
    }
    cli_page_section_end(out);
}
