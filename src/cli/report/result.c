/* SPDX-License-Identifier: MIT */
/* The part of a report on sigma from its pose: the value with its certificate, the effects that
   were simulated and those left out, and what contributes to it. */
#include "cli/report/report.h"

#include <math.h>

/* ---- the certificate ---- */

/* A fact whose number a script finds by its id. */
static void fact_put(FILE *out, const char *name, const char *id, double value, int digits,
                     const char *unit)
{
    cli_page(out, "<div><dt>%s</dt><dd>", name);
    cli_page_number(out, id, value, digits);
    cli_page(out, " %s</dd></div>\n", unit);
}

static void budget_row(FILE *out, const report_job *job, const char *name, const char *id,
                       double value, const char *why)
{
    cli_page(out, "\n<tr><td>%s</td><td class=\"n\">", name);
    cli_page_bound(out, id, value, 3);
    cli_page(out, "</td><td class=\"n\">%.2e</td><td class=\"why\">%s</td></tr>",
             job->run.result.sigma_m2 > 0.0 ? value / job->run.result.sigma_m2 : -1.0, why);
}

/* The value with its parts, the method, and the bound by cause. */
void cli_report_sigma(FILE *out, const report_job *job)
{
    static const char m2[] = "m\xc2\xb2";
    const lrcs_result *r = &job->run.result;
    const lrcs_budget *budget = &r->budget;
    cli_page_section(out, "sigma", "\xcf\x83 and its certificate");
    fputs("<dl class=\"facts\">\n", out);
    fact_put(out, "\xcf\x83", "sigma_m2", r->sigma_m2, 10, m2);
    if (r->sigma_m2 > 0.0) {
        fact_put(out, "in decibels", "sigma_dbsm", cli_dbsm(r->sigma_m2), 8, "dBsm");
    }
    fact_put(out, "glint part", "sigma_glint_m2", r->sigma_glint_m2, 7, m2);
    fact_put(out, "diffuse part", "sigma_diffuse_m2", r->sigma_diffuse_m2, 7, m2);
    fputs("<div><dt>Bound, proved</dt><dd>", out);
    cli_page_bound(out, "bound_m2", r->bound_m2, 3);
    fputs(" m\xc2\xb2</dd></div>\n", out);
    if (job->run.uncertainty.stated) {
        fact_put(out, "Materials, one standard deviation", "material_deviation_m2",
                 job->run.uncertainty.deviation_m2, 3, m2);
    }
    if (r->estimate_m2 >= 0.0) {
        fact_put(out, "Likely error, an estimate", "estimate_m2", r->estimate_m2, 3, m2);
    }
    if (r->curvature_estimate_m2 >= 0.0) {
        fact_put(out, "Cubature over curved normals, an estimate beside the bound",
                 "curvature_estimate_m2", r->curvature_estimate_m2, 3, m2);
    }
    fact_put(out, "Silhouette", "projected_area_m2", r->projected_area_m2, 8, m2);
    fputs("</dl>\n", out);
    cli_page(out, "<p>Method <b id=\"method\">%s</b>", lrcs_method_text(r->method));
    if (r->resolution != 0) {
        cli_page(out, " on a raster of %u x %u", r->resolution, r->resolution);
    }
    cli_page(out, "%s%s", job->run.options.method == LRCS_METHOD_AUTO ? ", chosen by auto: " : ": ",
             r->method_reason);
    cli_page_text(
        out,
        ". Normals are %s. Of %lu facets %lu face the laser; of those that could reflect %lu "
        "are hidden and %lu partly hidden. The pose took %.3g ms, preparing the scene %.3g "
        "ms, loading it %.3g ms.",
        lrcs_normals_text(job->run.scene.scene.normals), (unsigned long)r->facets_total,
        (unsigned long)r->facets_front, (unsigned long)r->facets_hidden,
        (unsigned long)r->facets_partial, 1e3 * job->run.seconds,
        1e3 * job->run.scene.seconds_prepare, 1e3 * job->run.scene.seconds_load);
    fputs("</p>\n", out);
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
    fputs("</details>\n", out);
    fputs("</section>\n", out);
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
        const lrcs_effect *effect = &job->run.result.effect[i];
        fputs("\n<tr><td class=\"name\">", out);
        for (const char *at = lrcs_effect_text(i); *at; at++) {
            putc(*at == '_' ? ' ' : *at, out);
        }
        fprintf(out, "</td><td class=\"%s</td>", effect->on ? "on\">simulated" : "off\">left out");
        cli_page_cells(out, "%s", effect->reason);
        fputs("</tr>", out);
    }
    cli_page_table_end(out);
    fputs("</details>\n</section>\n", out);
}

/* ---- shares ---- */

static void share_cells(FILE *out, const cli_shares *shares, const shares_row *row)
{
    cli_page_cells(out, "%u%.5g%f%.3g%.3g", row->facets, row->sigma_m2,
                   cli_share_of(shares, row->sigma_m2), row->glint_m2, row->diffuse_m2);
    fputs("</tr>", out);
}

static void share_table(FILE *out, const cli_shares *shares, const char *label, const char *columns,
                        const shares_row *row, uint32_t count, const char *nameless)
{
    uint32_t shown = cli_shares_shown(row, count);
    cli_page_table(out, label, columns);
    for (uint32_t i = 0; i < shown; i++) {
        fputs("\n<tr><td class=\"name\">", out);
        cli_page_name(out, row[i].name, nameless);
        fputs("</td>", out);
        share_cells(out, shares, &row[i]);
    }
    if (shown < count) {
        shares_row others = lrcs_host_shares_sum(row, shown, count);
        cli_page(out, "\n<tr class=\"others\"><td class=\"name\">%u other%s</td>", count - shown,
                 count - shown > 1 ? "s" : "");
        share_cells(out, shares, &others);
    }
    cli_page_table_end(out);
}

void cli_report_shares(FILE *out, const report_job *job)
{
    const cli_shares *shares = &job->run.shares;
    cli_page_section(out, "shares", "What contributes to \xcf\x83");
    fputs("<h3>Parts</h3>\n", out);
    share_table(out, shares, "Shares of parts",
                "Part|#Facets|#\xcf\x83, m\xc2\xb2|#Share||#Glint, m\xc2\xb2|#Diffuse, m\xc2\xb2",
                shares->part, shares->parts, "(no name)");
    cli_page_fold(out, "Materials");
    share_table(
        out, shares, "Shares of materials",
        "Material|#Facets|#\xcf\x83, m\xc2\xb2|#Share||#Glint, m\xc2\xb2|#Diffuse, m\xc2\xb2",
        shares->material, shares->materials, "(default)");
    fputs("</details>\n", out);
    if (shares->facets > 0) {
        cli_page_fold(out, "The brightest facets");
        cli_page_table(
            out, "The brightest facets",
            "#Facet|Part|Material|#\xce\xb8, deg|#Seen, m\xc2\xb2|#\xcf\x83, m\xc2\xb2|#Share|");
        for (uint32_t i = 0; i < shares->facets; i++) {
            const shares_facet *facet = &shares->facet[i];
            cli_page_row(out, "%u%s(no name)%s(default)%.4g%.3g%.5g%f", facet->facet, facet->part,
                         facet->material, facet->theta_deg, facet->visible_area_m2, facet->sigma_m2,
                         cli_share_of(shares, facet->sigma_m2));
        }
        cli_page_table_end(out);
        fputs("</details>\n", out);
    }
    fputs("</section>\n", out);
}
