/* SPDX-License-Identifier: MIT */
/* The page as a whole: its head, the summary, the navigation between sections, its foot. */
#include "cli/report/report.h"

static const char page_style[] = {
#include "style.inc"
};

void cli_report_head(FILE *out, const report_job *job, const char *attribute, const char *more,
                     const char *meta, const char *style)
{
    fprintf(out,
            "<!DOCTYPE html>\n<html lang=\"en\"%s>\n<head>\n"
            "<meta charset=\"utf-8\" />\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
            "<meta name=\"color-scheme\" content=\"light dark\" />\n%s",
            attribute, meta);
    cli_page(out, "<title>%s: laser radar cross-section%s</title>\n<style>\n",
             cli_scene_name(job->args, &job->run.scene), more);
    fwrite(page_style, 1, sizeof page_style, out);
    fputs(style, out);
    cli_page(out,
             "</style>\n</head>\n<body>\n<header>\n"
             "<p class=\"kind\">Laser radar cross-section</p>\n<h1>%s</h1>\n",
             cli_scene_name(job->args, &job->run.scene));
}

/* sigma and its accuracy, what its materials leave open, where the laser stands, the verdict. */
static void page_lead(FILE *out, const report_job *job)
{
    const lrcs_result *r = &job->run.result;
    double s_hat[3];
    double azel_deg[2];
    cli_pose_unit(&job->run.pose, s_hat);
    cli_pose_azel(&job->run.pose, azel_deg);
    cli_page(out, "<p class=\"lead\"><b>\xcf\x83 = %.6g m\xc2\xb2</b>", r->sigma_m2);
    if (r->sigma_m2 > 0.0) {
        cli_page(out, " <span>%.6g dBsm</span>", cli_dbsm(r->sigma_m2));
    }
    cli_page(out, "</p>\n<p>Proved to within %.2e m\xc2\xb2", r->bound_m2);
    if (r->sigma_m2 > 0.0) {
        cli_page(out, ", which is %.2e of \xcf\x83", r->bound_m2 / r->sigma_m2);
    }
    if (cli_tolerance_judged(job->args, &job->run.options)) {
        cli_page(out, "; the tolerance of %.3g", job->run.options.tolerance);
        fputs(r->flags & LRCS_FLAG_TOLERANCE_NOT_MET ? " is <b>not met</b>"
              : r->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE
                  ? " is met by the likely error, <b>an estimate</b>, alone"
              : r->flags & LRCS_FLAG_ACCEPTED_UNJUDGED
                  ? " is <b>not judged</b>: any answer was accepted"
                  : " is met",
              out);
    }
    putc('.', out);
    if (job->run.uncertainty.stated) {
        double deviation = job->run.uncertainty.deviation_m2;
        cli_page(out, " The stated errors of materials leave it uncertain by <b>%.3g m\xc2\xb2",
                 deviation);
        if (r->sigma_m2 > 0.0) {
            cli_page(out, ", %.3g %%", 100.0 * deviation / r->sigma_m2);
        }
        fputs("</b> (one standard deviation).", out);
    }
    cli_page(out,
             " The laser stands at azimuth %.6g\xc2\xb0, elevation %.6g\xc2\xb0 of the body frame, "
             "in the direction (%.6g, %.6g, %.6g).</p>\n",
             azel_deg[0], azel_deg[1], s_hat[0], s_hat[1], s_hat[2]);
    cli_report_summary(out, job);
    fputs("</header>\n", out);
}

int cli_report_page(FILE *out, const void *context, lrcs_host_error *error)
{
    static const char *const place[][2] = {
        {"sigma", "Certificate"}, {"notices", "Notices"},     {"map", "Map"},
        {"peaks", "Peaks"},       {"cuts", "Cuts"},           {"shares", "Shares"},
        {"model", "Model"},       {"materials", "Materials"}, {"effects", "Effects"},
        {"accuracy", "Accuracy"}, {"again", "Reproduce"}};
    const report_job *job = context;
    (void)error;
    cli_report_head(out, job, " xmlns=\"http://www.w3.org/1999/xhtml\"", "", "", "");
    page_lead(out, job);
    fputs("<nav aria-label=\"Contents\"><ul>\n", out);
    for (size_t i = 0; i < sizeof place / sizeof place[0]; i++) {
        fprintf(out, "<li><a href=\"#%s\">%s</a></li>\n", place[i][0], place[i][1]);
    }
    fputs("</ul></nav>\n<main>\n<div class=\"pair\">\n", out);
    cli_page_picture(out, job->picture[REPORT_BY_SIGMA],
                     "What the laser sees, coloured by sigma per projected area in dB");
    fputs("What the laser sees: brighter colours return more per projected area.", out);
    cli_page_figure_end(out);
    cli_page_picture(out, job->picture[REPORT_BY_MATERIAL],
                     "What the laser sees, coloured by material");
    fputs("The same by material, in false colours.", out);
    cli_page_figure_end(out);
    fputs("</div>\n", out);
    cli_report_sigma(out, job);
    cli_report_notices(out, job);
    cli_report_charts(out, job);
    cli_report_shares(out, job);
    cli_report_scene(out, job);
    cli_report_effects(out, job);
    cli_report_accuracy(out, job);
    cli_report_reproduce(out, job);
    cli_page(out,
             "</main>\n<footer><p>Made by lrcs %s. A <em>bound</em> is proved: the error is no "
             "larger. An <em>estimate</em> says what is "
             "likely. Neither knows whether A, B, s and m are those of the paint.</p></footer>\n"
             "</body>\n</html>\n",
             lrcs_version());
    return LRCS_OK;
}
