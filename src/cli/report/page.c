/* SPDX-License-Identifier: MIT */
/* The page as a whole: its head, the summary, the navigation between sections, its foot. */
#include "cli/report/report.h"

#include <math.h>

static const struct {
    const char *id, *name;
} page_places[] = {{"sigma", "Certificate"}, {"notices", "Notices"},     {"map", "Map"},
                   {"peaks", "Peaks"},       {"cuts", "Cuts"},           {"shares", "Shares"},
                   {"model", "Model"},       {"materials", "Materials"}, {"effects", "Effects"},
                   {"accuracy", "Accuracy"}, {"again", "Reproduce"}};

void cli_report_head(FILE *out, const report_job *job, const char *attribute, const char *more,
                     const char *meta, const char *style)
{
    fprintf(out,
            "<!DOCTYPE html>\n<html lang=\"en\"%s>\n<head>\n"
            "<meta charset=\"utf-8\" />\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
            "<meta name=\"color-scheme\" content=\"light dark\" />\n%s<title>",
            attribute, meta);
    cli_page_text(out, cli_report_title(job));
    fprintf(out, ": laser radar cross-section%s</title>\n<style>\n", more);
    cli_report_style(out);
    fprintf(out,
            "%s</style>\n</head>\n<body>\n<header>\n"
            "<p class=\"kind\">Laser radar cross-section</p>\n<h1>",
            style);
    cli_page_text(out, cli_report_title(job));
    fputs("</h1>\n", out);
}

static void page_way(FILE *out)
{
    fputs("<nav aria-label=\"Contents\"><ul>\n", out);
    for (size_t i = 0; i < sizeof page_places / sizeof page_places[0]; i++) {
        fprintf(out, "<li><a href=\"#%s\">%s</a></li>\n", page_places[i].id, page_places[i].name);
    }
    fputs("</ul></nav>\n", out);
}

/* sigma and its accuracy in one sentence. */
static void lead_sigma(FILE *out, const report_job *job)
{
    const lrcs_result *r = &job->result;
    fputs("<p class=\"lead\"><b>\xcf\x83 = ", out);
    cli_page_number(out, NULL, r->sigma_m2, 6);
    fputs(" m\xc2\xb2</b>", out);
    if (r->sigma_m2 > 0.0) {
        fputs(" <span>", out);
        cli_page_number(out, NULL, cli_dbsm(r->sigma_m2), 6);
        fputs(" dBsm</span>", out);
    }
    fputs("</p>\n<p>Proved to within ", out);
    cli_page_bound(out, NULL, r->bound_m2, 2);
    fputs(" m\xc2\xb2", out);
    if (r->sigma_m2 > 0.0) {
        fputs(", which is ", out);
        cli_page_bound(out, NULL, r->bound_m2 / r->sigma_m2, 2);
        fputs(" of \xcf\x83", out);
    }
    if (!cli_tolerance_judged(job->args, &job->options)) {
        fputs(".", out);
        return;
    }
    fputs("; the tolerance of ", out);
    cli_page_number(out, NULL, job->options.tolerance, 3);
    fputs(r->flags & LRCS_FLAG_TOLERANCE_NOT_MET ? " is <b>not met</b>."
          : r->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE
              ? " is met by the likely error, <b>an estimate</b>, alone."
          : r->flags & LRCS_FLAG_ACCEPTED_UNJUDGED
              ? " is <b>not judged</b>: any answer was accepted."
              : " is met.",
          out);
}

static void lead_materials(FILE *out, const report_job *job)
{
    double deviation = job->uncertainty.deviation_m2;
    if (!job->uncertainty.stated) {
        return;
    }
    fputs(" The stated errors of materials leave it uncertain by <b>", out);
    cli_page_number(out, NULL, deviation, 3);
    fputs(" m\xc2\xb2", out);
    if (job->result.sigma_m2 > 0.0) {
        fputs(", ", out);
        cli_page_number(out, NULL, 100.0 * deviation / job->result.sigma_m2, 3);
        fputs(" %", out);
    }
    fputs("</b> (one standard deviation).", out);
}

static void lead_direction(FILE *out, const report_job *job)
{
    const double *d = job->pose.direction;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    fputs(" The laser stands at azimuth ", out);
    cli_page_number(out, NULL, atan2(d[1], d[0]) * CLI_DEGREES, 6);
    fputs("\xc2\xb0, elevation ", out);
    cli_page_number(out, NULL, atan2(d[2], hypot(d[0], d[1])) * CLI_DEGREES, 6);
    fputs("\xc2\xb0 of the body frame, in the direction (", out);
    for (int k = 0; k < 3; k++) {
        fputs(k > 0 ? ", " : "", out);
        cli_page_number(out, NULL, d[k] / length, 6);
    }
    fputs(").</p>\n", out);
}

static void page_lead(FILE *out, const report_job *job)
{
    lead_sigma(out, job);
    lead_materials(out, job);
    lead_direction(out, job);
    cli_report_verdict(out, job);
    fputs("</header>\n", out);
}

static void page_pictures(FILE *out, const report_job *job)
{
    fputs("<div class=\"pair\">\n", out);
    cli_page_picture(out, job->picture[REPORT_BY_SIGMA],
                     "What the laser sees, coloured by sigma per projected area in dB");
    fputs("What the laser sees: brighter colours return more per projected area.", out);
    cli_page_figure_end(out);
    cli_page_picture(out, job->picture[REPORT_BY_MATERIAL],
                     "What the laser sees, coloured by material");
    fputs("The same by material, in false colours.", out);
    cli_page_figure_end(out);
    fputs("</div>\n", out);
}

int cli_report_page(FILE *out, const void *context, lrcs_host_error *error)
{
    const report_job *job = context;
    (void)error;
    cli_report_head(out, job, " xmlns=\"http://www.w3.org/1999/xhtml\"", "", "", "");
    page_lead(out, job);
    page_way(out);
    fputs("<main>\n", out);
    page_pictures(out, job);
    cli_report_sigma(out, job);
    cli_report_notices(out, job);
    cli_report_curves(out, job);
    cli_report_shares(out, job);
    cli_report_scene(out, job);
    cli_report_effects(out, job);
    cli_report_accuracy(out, job);
    cli_report_again(out, job);
    fputs("</main>\n<footer><p>Made by lrcs ", out);
    cli_page_text(out, lrcs_version());
    fputs(". A <em>bound</em> is proved: the error is no larger. An <em>estimate</em> says what is "
          "likely. Neither knows whether A, B, s and m are those of the paint.</p></footer>\n"
          "</body>\n</html>\n",
          out);
    return LRCS_OK;
}
