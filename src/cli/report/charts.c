/* SPDX-License-Identifier: MIT */
/* The part of a report on other directions and on accuracy: cuts, the map, its peaks and what
   contributes to them, error against time. */
#include "cli/report/report.h"

#include <math.h>
#include <string.h>

/* ---- what is drawn ---- */

static const double polar_box[4] = {LRCS_HOST_CHART_POLAR_LEFT, LRCS_HOST_CHART_TITLE,
                                    LRCS_HOST_CHART_POLAR_SIDE, LRCS_HOST_CHART_POLAR_SIDE};
static const double chart_box[4] = {0.0, LRCS_HOST_CHART_TITLE, LRCS_HOST_CHART_WIDTH,
                                    LRCS_HOST_CHART_HEIGHT - LRCS_HOST_CHART_TITLE};

/* The smallest and largest sigma, and the largest bound, of a sweep. */
static void extremes_write(FILE *out, const report_sweep *sweep)
{
    double least = HUGE_VAL;
    double most = 0.0;
    double bound = 0.0;
    for (uint64_t i = 0; i < sweep->plan.rows; i++) {
        least = fmin(least, sweep->row[i][0]);
        most = fmax(most, sweep->row[i][0]);
        bound = fmax(bound, sweep->row[i][1]);
    }
    if (most > 0.0 && least > 0.0) {
        cli_page(out, " From %.4g to %.4g dBsm; each", cli_dbsm(least), cli_dbsm(most));
    } else if (most > 0.0) {
        cli_page(out, " From nothing to %.4g dBsm; each", cli_dbsm(most));
    } else {
        fputs(" Nothing returns; each", out);
    }
    cli_page(out, " \xcf\x83 is proved to within %.2e m\xc2\xb2 or better%s.", bound,
             sweep->plot.materials_assumed ? " for its materials, which are illustrative" : "");
    if (sweep->band && most > 0.0) {
        cli_page_text(
            out,
            " Errors of its materials (68\xc2\xa0%%%s): %s%.2g\xc2\xa0%% of \xcf\x83 in the "
            "median, \xc2\xb1%.2g\xc2\xa0%% at most.",
            sweep->plot.map ? "" : ", shaded", sweep->part[0] < 5e-4 ? "below " : "\xc2\xb1",
            100.0 * fmax(sweep->part[0], 5e-4), 100.0 * sweep->part[1]);
    }
}

/* A sweep's drawing; nothing is drawn where sigma is 0 everywhere. */
static void figure_begin(FILE *out, const report_sweep *sweep, const char *label,
                         const double box[4])
{
    if (sweep->svg.bytes) {
        cli_page_figure(out, &sweep->svg, label, box);
    } else {
        fputs("<figure><figcaption>", out);
    }
}

static void cuts_section(FILE *out, const report_job *job)
{
    static const struct {
        int kind;
        const char *plane, *angle;
    } cut[] = {{REPORT_CUT_XY, "x and y", "the angle is the azimuth, at elevation 0"},
               {REPORT_CUT_XZ, "x and z", "the angle is the elevation, from +x over +z"},
               {REPORT_CUT_YZ, "y and z", "the angle is the elevation, from +y over +z"}};
    cli_page_section(out, "cuts", "Cuts through three planes");
    cli_page(out,
             "<p>The distance from the centre is \xcf\x83 in dBsm, by the numbers on the rings; "
             "angles are in degrees. The laser circles the body in steps of %u\xc2\xb0: a peak "
             "that is narrower may be missed.</p>\n<div class=\"pair\">\n",
             job->cut_step);
    for (int i = 0; i < 3; i++) {
        const report_sweep *sweep = &job->sweep[cut[i].kind];
        char label[160];
        snprintf(label, sizeof label, "Polar chart of sigma in dBsm in the plane of %s",
                 cut[i].plane);
        figure_begin(out, sweep, label, polar_box);
        fprintf(out, "<b>Plane of %s</b>; %s.", cut[i].plane, cut[i].angle);
        extremes_write(out, sweep);
        cli_page_figure_end(out);
    }
    fputs("</div>\n</section>\n", out);
}

/* ---- peaks ---- */

/* The few rows that contribute most to a peak. */
static void most_cell(FILE *out, const cli_shares *shares, const shares_row *row, uint32_t count,
                      const char *nameless)
{
    uint32_t named = cli_shares_named(shares, row, count);
    fputs("<td class=\"why\">", out);
    for (uint32_t i = 0; i < named; i++) {
        fputs(i > 0 ? ", " : "", out);
        cli_page_name(out, row[i].name, nameless);
        cli_page(out, "\xc2\xa0%f", cli_share_of(shares, row[i].sigma_m2));
    }
    shares_row others = lrcs_host_shares_sum(row, named, count);
    if (others.sigma_m2 > 0.0) {
        cli_page(out, ", %u other%s\xc2\xa0%f", count - named, count - named > 1 ? "s" : "",
                 cli_share_of(shares, others.sigma_m2));
    }
    fputs("</td>", out);
}

static void peaks_section(FILE *out, const report_job *job)
{
    const report_sweep *map = &job->sweep[REPORT_MAP];
    cli_page_section(out, "peaks", "The brightest directions, and what contributes to them");
    fputs("<p>Peaks of the map: directions brighter than all their neighbours.", out);
    if (job->peaks == 0) {
        fputs(" There are none: nothing returns.</p>\n</section>\n", out);
        return;
    }
    fputs("</p>\n", out);
    cli_page_table(out, "Peaks of the map",
                   "#Az, deg|#El, deg|#\xcf\x83, m\xc2\xb2|#dBsm|#Glint|Parts|Materials");
    for (uint32_t i = 0; i < job->peaks; i++) {
        const cli_shares *shares = &job->peak_shares[i];
        double value[LRCS_HOST_PLAN_COLUMNS];
        lrcs_host_plan_values(&map->plan, job->peak[i], value);
        double sigma_m2 = map->row[job->peak[i]][0];
        fputs("\n<tr>", out);
        cli_page_cells(out, "%.6g%.6g%.5g%.4g", value[0], value[1], sigma_m2, cli_dbsm(sigma_m2));
        cli_page(out, "<td class=\"n\">%f</td>", cli_share_of(shares, cli_shares_glint(shares)));
        most_cell(out, shares, shares->part, shares->parts, "(no name)");
        most_cell(out, shares, shares->material, shares->materials, "(default)");
        fputs("</tr>", out);
    }
    cli_page_table_end(out);
    fputs("</section>\n", out);
}

void cli_report_charts(FILE *out, const report_job *job)
{
    const report_sweep *map = &job->sweep[REPORT_MAP];
    cli_page_section(out, "map", "All directions");
    figure_begin(out, map, "Map of sigma in dBsm over azimuth and elevation", chart_box);
    cli_page(out, "Steps of %u\xc2\xb0.", job->map_step);
    extremes_write(out, map);
    cli_page_figure_end(out);
    fputs("</section>\n", out);
    peaks_section(out, job);
    cuts_section(out, job);
}

/* ---- accuracy ---- */

void cli_report_accuracy(FILE *out, const report_job *job)
{
    const lrcs_host_convergence *compare = &job->converge.all;
    converge_sentence sentence = cli_converge_sentence(compare);
    cli_page_section(out, "accuracy", "What accuracy costs in time");
    cli_page(out, "<p>%s</p>\n", sentence.text);
    cli_page_figure(out, &job->chart, "Chart of error and bound against the time of a pose",
                    chart_box);
    cli_page_text(out, "Against %s: \xcf\x83 = %.9g m\xc2\xb2%s%s%s%s.", compare->truth.text,
                  compare->truth.sigma_m2, compare->left_out[0] ? "; " : "", compare->left_out,
                  compare->busy[0] ? "; " : "", compare->busy);
    cli_page_figure_end(out);
    cli_page_fold(out, "All settings");
    cli_page_table(out, "Accuracy against time",
                   compare->truth.sigma_m2 > 0.0
                       ? "Setting|#Facets|#Pose, ms|#\xcf\x83, m\xc2\xb2|#Error|#Bound|#Estimate"
                       : "Setting|#Facets|#Pose, ms|#\xcf\x83, m\xc2\xb2|#Error, m\xc2\xb2|#Bound, "
                         "m\xc2\xb2|#Estimate, m\xc2\xb2");
    for (uint32_t i = 0; i < compare->settings; i++) {
        const lrcs_host_convergence_setting *one = &compare->setting[i];
        cli_page_row(out, "%s%u%.3g%.8g%.2g%.2e%.2g", one->name,
                     compare->mesh[one->mesh].scene.scene.facet_count, 1e3 * one->pose_s,
                     one->sigma_m2, lrcs_host_convergence_relative(compare, one->error_m2),
                     lrcs_host_convergence_relative(compare, one->bound_m2),
                     cli_known(lrcs_host_convergence_relative(compare, one->estimate_m2)));
    }
    cli_page_table_end(out);
    fputs("</details>\n</section>\n", out);
}
