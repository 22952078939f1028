/* SPDX-License-Identifier: MIT */
/* Reasons that show without a mistake of the catalogue: which cases fail and by how much tells of
   depths that are too coarse, of single precision, of a raster, of a factor that all share. */
#include "cli/compare_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SKINS_TOUCH  60   /* a distance of 2^-60 m stands for none */
#define BIAS_CASES   20u  /* a factor that all share: of so many cases */
#define BIAS_SHARE   0.75 /* this share is nearer to it than to the truth, and */
#define BIAS_SPREADS 4.0  /* more than half by so many spreads of a fair coin */
#define BIAS_LEAST   1e-4 /* and it is this far from 1 */

/* ---- classes ---- */

/* The failing cases of a class. */
static void class_say(compare_search *search, int grade, const char *name, const char *text)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        count += search->failing[i]->grade == grade;
    }
    compare_finding *finding = count > 0 ? cli_search_finding(search->job, name) : NULL;
    if (!finding) {
        return;
    }
    for (uint32_t i = 0; i < search->failings; i++) {
        if (search->failing[i]->grade == grade) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = count;
    snprintf(finding->text, sizeof finding->text, "%s", text);
    cli_search_part(search);
}

/* ---- depths ---- */

/* Skins 2^-K m apart in a scene 8 m deep are called skins-K, those in one place by other names; 0
   for scenes without. */
static int skins_of(const compare_job *job, const compare_case *one)
{
    const char *name = job->kit.scene[one->scene].name;
    int coincident = strcmp(name, "twins") == 0 || strcmp(name, "two-faced") == 0;
    int skins = strncmp(name, "skins-", 6) == 0 ? (int)strtol(name + 6, NULL, 10) : 0;
    return coincident || skins > SKINS_TOUCH ? SKINS_TOUCH : skins;
}

static void depth_text(int coarsest, compare_finding *finding)
{
    if (coarsest == SKINS_TOUCH) {
        finding->name = "coincident-skins";
        snprintf(finding->text, sizeof finding->text,
                 "coincident skins: of facets in one place the wrong one is seen (a front beats a "
                 "back, then the lower index wins)");
    } else {
        snprintf(finding->text, sizeof finding->text,
                 "depth precision: skins 2^-%d m apart in a scene 8 m deep are not told apart: a "
                 "depth of some %d bits or fewer",
                 coarsest, coarsest + 3);
    }
}

/* Where most of what fails are skins close to each other, the depths are too coarse. */
static void depth_say(compare_search *search)
{
    int coarsest = SKINS_TOUCH;
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        int skins = skins_of(search->job, search->failing[i]);
        coarsest = skins > 0 && skins < coarsest ? skins : coarsest;
        count += skins > 0;
    }
    int most = 2 * count > search->failings;
    compare_finding *finding = most ? cli_search_finding(search->job, "depth-precision") : NULL;
    if (!finding) {
        return;
    }
    for (uint32_t i = 0; i < search->failings; i++) {
        if (skins_of(search->job, search->failing[i]) > 0) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = count;
    depth_text(coarsest, finding);
    cli_search_part(search);
}

/* ---- a factor ---- */

/* The ratios of the answers that are not exact; how many there are. */
static uint32_t bias_ratios(const compare_job *job, double *ratio)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (one->given && cli_compare_asked(job, one) && one->sigma_m2 > 0.0 &&
            one->grade > COMPARE_EXACT && isfinite(one->theirs_m2)) {
            ratio[count++] = one->theirs_m2 / one->sigma_m2;
        }
    }
    return count;
}

/* The share of the ratios that lie nearer to the median than to 1, where that is no chance. */
static double bias_share(const double *ratio, uint32_t count, double median)
{
    uint32_t nearer = 0;
    for (uint32_t i = 0; i < count; i++) {
        nearer += fabs(ratio[i] - median) < fabs(ratio[i] - 1.0);
    }
    double least = fmax(BIAS_SHARE, 0.5 + 0.5 * BIAS_SPREADS / sqrt(fmax(count, 1.0)));
    return count >= BIAS_CASES && nearer >= least * count && fabs(median - 1.0) >= BIAS_LEAST
               ? (double)nearer / count
               : 0.0;
}

/* A factor that all answers share, though each by itself is within its class. */
static void bias_say(compare_search *search)
{
    compare_job *job = search->job;
    uint32_t count = bias_ratios(job, search->room);
    double median = cli_search_median(search->room, count);
    double share = bias_share(search->room, count, median);
    compare_finding *finding = share > 0.0 ? cli_search_finding(job, "pixel-area") : NULL;
    if (!finding) {
        return;
    }
    job->biased = 1;
    finding->factor = median;
    finding->name = cli_factor_name(median);
    for (uint32_t i = 0; i < search->failings; i++) {
        compare_case *one = search->failing[i];
        if (cli_search_explained(search, one, median * one->sigma_m2)) {
            one->explained = (int)job->findings;
            finding->explained++;
        }
    }
    snprintf(finding->text, sizeof finding->text,
             "a constant factor of %.6g, within what most cases are allowed but in %.0f %% of "
             "them: %s",
             median, 100.0 * share, cli_factor_text(job, median));
    cli_search_part(search);
}

void cli_compare_signs(compare_search *search)
{
    depth_say(search);
    class_say(search, COMPARE_FLOAT, "single-precision",
              "single precision: off by no more than some of its roundings");
    class_say(search, COMPARE_RASTER, "raster",
              "a raster's pixels: off by no more than half a pixel along the outlines");
    if (search->job->findings == 0) {
        bias_say(search);
    }
}
