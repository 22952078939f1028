/* SPDX-License-Identifier: MIT */
/* Causes recognized without a mistake of the catalogue. Some are visible in the table itself: only
   zeros, another unit than the column states, rows shifted by one, too few digits. Others follow
   from which cases fail, and by how much: depths that are too coarse, single precision, a raster,
   or a factor that all answers share. */
#include "host/kit/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST            0.9   /* share of the failing cases that a cause must explain */
#define LEAST           5u    /* number of failing cases; fewer prove nothing */
#define DIGITS          9     /* with this many digits rounding is harmless */
#define SAME_DIGIT      1e-11 /* relative: a number so near to one of few digits is taken for it */
#define Z_FIGHTING_MOST 256u  /* scenes with more facets are not searched for coplanar facets */
#define COINCIDENT      60    /* a distance of 2^-60 m counts as none */
#define COARSEST        16.0  /* pixels per side of the coarsest raster considered, */
#define COARSE_SHARE    0.012 /* and the median share of the allowed difference: 0.02 is usual */
#define BIAS_CASES      20u   /* a factor that all share: at least this many cases */
#define BIAS_SHARE      0.75  /* of which this share lies nearer to the factor than to the truth, */
#define BIAS_SPREADS    4.0   /* more than half by so many deviations of a fair coin, */
#define BIAS_LEAST      1e-4  /* and the factor differs from 1 by this much */

/* Another meaning of the submitted numbers: `decade` times log10 of m2 instead of what their column
   states (0: m2), in a line so many lines below. */
static const struct symptom_reading {
    const char *name, *text;
    double decade;
    int lines;
    int column; /* of sigma_m2 (1), of sigma_dbsm (2), of either (3) */
} symptom_readings[] = {{"m2-as-dbsm", "the column sigma_dbsm holds m2, not dBsm", 0.0, 0, 2},
                        {"dbsm-as-m2", "the column sigma_m2 holds dBsm, not m2", 10.0, 0, 1},
                        {"20-log10", "decibels: 20 log10 in place of 10 log10", 20.0, 0, 3},
                        {"row-before", "rows: every answer is one line too early", 0.0, -1, 3},
                        {"row-after", "rows: every answer is one line too late", 0.0, 1, 3}};

/* ---- findings ---- */

/* 1 if a case's answer, read in another way, is within what the case is allowed. */
static int reading_matches(const lrcs_host_judgement *job, const lrcs_host_kit_case *one,
                           const struct symptom_reading *reading)
{
    double sigma_m2 = reading->decade > 0.0 ? pow(10.0, one->answer_printed / reading->decade)
                                            : one->answer_printed;
    if (reading->lines != 0) {
        double line = (double)(one - job->kit.list) + reading->lines;
        int inside = line >= 0.0 && line < job->kit.cases;
        const lrcs_host_kit_case *other = inside ? &job->kit.list[(uint32_t)line] : NULL;
        sigma_m2 = other && other->given ? other->answer_m2 : (double)NAN;
    }
    return fabs(sigma_m2 - one->sigma_m2) <= lrcs_host_judge_allowed(one, job->grade, job->pixels);
}

/* 1 if a cause explains most of the failures; explains: as for lrcsi_search_explained_cases. */
static int explains_most(const lrcsi_search *search, const unsigned char *explains)
{
    uint32_t right = lrcsi_search_explained_cases(search, explains);
    return right >= LEAST && right >= MOST * search->failing_count;
}

/* Makes a finding if most answers are right when read in another way. Answers that are no numbers
   may become numbers then. */
static void reading_try(lrcsi_search *search, const struct symptom_reading *reading)
{
    lrcs_host_judgement *job = search->job;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        search->explains[i] = (unsigned char)reading_matches(job, search->failing[i], reading);
    }
    lrcs_host_finding *finding =
        explains_most(search, search->explains)
            ? lrcsi_search_finding_add(search, search->explains, reading->name, "%s", reading->text)
            : NULL;
    for (uint32_t i = 0; finding && i < job->kit.cases; i++) {
        lrcs_host_kit_case *one = &job->kit.list[i];
        if (one->given && !isfinite(one->answer_m2) && one->explained == 0 &&
            lrcs_host_judge_failed(job, one) && reading_matches(job, one, reading)) {
            one->explained = (int)job->findings;
            finding->explained++;
        }
    }
}

/* ---- digits ---- */

/* The step at a number of the numbers with so many digits, significant or after the decimal
   point. */
static double digit_step(double value, int digits, int significant)
{
    double whole = significant && value != 0.0 ? floor(log10(fabs(value))) + 1.0 : 0.0;
    return pow(10.0, whole - digits);
}

/* 1 if no answer has more digits than these. */
static int digits_all(const lrcs_host_judgement *job, int digits, int significant)
{
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const lrcs_host_kit_case *one = &job->kit.list[i];
        double value = one->given ? one->answer_printed : 0.0;
        double step = digit_step(value, digits, significant);
        double steps = floor(value / step + 0.5);
        if (isfinite(value) && fabs(value - steps * step) > SAME_DIGIT * fabs(value)) {
            return 0;
        }
    }
    return 1;
}

/* Finds the smallest number of digits, of decimals or significant ones, that suffices for all
   answers. Makes a finding if rounding, by half a unit of the last digit, explains most failures.
 */
static void digits_try(lrcsi_search *search)
{
    const lrcs_host_judgement *job = search->job;
    for (int significant = 0; significant < 2; significant++) {
        int digits = significant;
        while (digits < DIGITS && !digits_all(job, digits, significant)) {
            digits++;
        }
        for (uint32_t i = 0; i < search->failing_count; i++) {
            const lrcs_host_kit_case *one = search->failing[i];
            double value = job->decibels ? 10.0 * log10(one->sigma_m2) : one->sigma_m2;
            double half = 0.5 * digit_step(value, digits, significant);
            double room = job->decibels ? one->sigma_m2 * (pow(10.0, half / 10.0) - 1.0) : half;
            search->explains[i] = fabs(one->answer_m2 - one->sigma_m2) <=
                                  room + lrcs_host_judge_allowed(one, job->grade, job->pixels);
        }
        if (digits < DIGITS && explains_most(search, search->explains) &&
            lrcsi_search_finding_add(
                search, search->explains, "few-digits",
                "few digits: every answer is rounded to %d %s%s: print %%.9g or more", digits,
                significant ? "digit" : "decimal", digits == 1 ? "" : "s")) {
            return;
        }
    }
}

void lrcsi_symptoms_format(lrcsi_search *search)
{
    const lrcs_host_judgement *job = search->job;
    uint32_t given = 0;
    int blank = search->failing_count > 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const lrcs_host_kit_case *one = &job->kit.list[i];
        int counts = one->given && lrcs_host_judge_asked(job, one);
        given += (uint32_t)counts;
        blank &= !counts || one->answer_m2 == 0.0;
    }
    if (given > 0 && blank) {
        memset(search->explains, 1, search->failing_count);
        lrcsi_search_finding_add(
            search, search->explains, "blank",
            "every answer is 0: nothing drawn, everything culled or outside the "
            "window, or the buffer never read back");
        return;
    }
    for (size_t i = 0; i < sizeof symptom_readings / sizeof symptom_readings[0]; i++) {
        if (symptom_readings[i].column & (job->decibels ? 2 : 1)) {
            reading_try(search, &symptom_readings[i]);
        }
    }
    digits_try(search);
}

/* ---- a coarser raster ---- */

/* The pixels per side at which a case is within what a raster is allowed; 0 if it never is. */
static double case_pixels(const lrcs_host_kit_case *one)
{
    double off = fabs(one->answer_m2 - one->sigma_m2);
    double rest = off - lrcs_host_judge_allowed(one, LRCS_HOST_GRADE_FLOAT, 1);
    return rest > 0.0 ? one->edge_m2 / rest : HUGE_VAL;
}

/* Makes a finding if all failing cases would pass with fewer pixels, and the other cases are
   consistent with that: the median share of what such a raster is allowed, over the answers that
   are no better than a raster's and have no other cause, is one that rasters usually need. */
static void coarse_try(lrcsi_search *search)
{
    const lrcs_host_judgement *job = search->job;
    double pixels =
        job->grade == LRCS_HOST_GRADE_RASTER && search->failing_count > 0 ? job->pixels : 0.0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        pixels = fmin(pixels, floor(case_pixels(search->failing[i])));
    }
    for (uint32_t i = 0; i < job->kit.cases && pixels >= COARSEST; i++) {
        const lrcs_host_kit_case *one = &job->kit.list[i];
        if (one->given && lrcs_host_judge_asked(job, one) && one->grade >= LRCS_HOST_GRADE_RASTER &&
            one->explained == 0 && isfinite(one->answer_m2)) {
            search->room[count++] = pixels / case_pixels(one);
        }
    }
    if (2 * count > job->given && lrcsi_search_upper_median(search->room, count) >= COARSE_SHARE) {
        memset(search->explains, 1, search->failing_count);
        lrcsi_search_finding_add(
            search, search->explains, "coarse-raster",
            "a raster of fewer than %lu x %lu pixels: all these pass as one of %.0f x "
            "%.0f or fewer: give --pixels N, or render finer",
            (unsigned long)job->pixels, (unsigned long)job->pixels, pixels, pixels);
    }
}

/* ---- depths ---- */

/* K if two surfaces of the case's scene, which is 8 m deep, are 2^-K m apart (the scenes skins-K),
   COINCIDENT if they coincide, 0 if it has no such surfaces. */
static int separation_of(const lrcs_host_judgement *job, const lrcs_host_kit_case *one)
{
    const char *name = job->kit.scene[one->scene].name;
    int coincident = strcmp(name, "twins") == 0 || strcmp(name, "two-faced") == 0;
    int exponent = strncmp(name, "skins-", 6) == 0 ? (int)strtol(name + 6, NULL, 10) : 0;
    return coincident || exponent > COINCIDENT ? COINCIDENT : exponent;
}

/* If most of the failing cases have surfaces close to each other, the depths are too coarse. */
static void depth_try(lrcsi_search *search)
{
    int coarsest = COINCIDENT;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        int exponent = separation_of(search->job, search->failing[i]);
        coarsest = exponent > 0 && exponent < coarsest ? exponent : coarsest;
        search->explains[i] = exponent > 0;
    }
    if (coarsest < COINCIDENT &&
        2 * lrcsi_search_explained_cases(search, search->explains) > search->failing_count) {
        lrcsi_search_finding_add(
            search, search->explains, "depth-precision",
            "depth precision: surfaces 2^-%d m apart in a scene 8 m deep are not "
            "distinguished: a depth of some %d bits or fewer",
            coarsest, coarsest + 3);
    }
}

/* ---- facets in one plane ---- */

/* Decides whether an answer lies between the truth and the answer in which the wrong one of
   coplanar facets is seen. Status: as lrcs_host_judge. */
static int case_is_z_fighting(const lrcsi_search *search, lrcs_host_kit_case *one,
                              unsigned char *z_fighting)
{
    static const lrcsi_mistake wrong = {.name = "coplanar", .text = "", .wrong_coplanar = 1};
    const lrcs_host_judgement *job = search->job;
    double allowed = lrcs_host_judge_allowed(one, job->grade, job->pixels);
    double other = 0.0;
    *z_fighting = 0;
    int status = lrcsi_kit_records(&job->kit, one, search->error);
    if (status != LRCS_OK || job->kit.scene[one->scene].host.scene.facet_count > Z_FIGHTING_MOST) {
        return status;
    }
    status = lrcsi_mistake_answer(&job->kit, one, &wrong, &other, search->error);
    if (status != LRCS_OK) {
        return status;
    }
    double difference = one->answer_m2 - one->sigma_m2;
    double most = other - one->sigma_m2;
    *z_fighting =
        fabs(most) > allowed && difference / most > 0.0 && fabs(difference) <= fabs(most) + allowed;
    return LRCS_OK;
}

/* Makes a finding of such cases. Status: as lrcs_host_judge. */
static int z_fighting_try(lrcsi_search *search)
{
    if (search->job->findings == LRCS_HOST_FINDINGS) {
        return LRCS_OK;
    }
    for (uint32_t i = 0; i < search->failing_count; i++) {
        int status = case_is_z_fighting(search, search->failing[i], &search->explains[i]);
        if (status != LRCS_OK) {
            return status;
        }
    }
    if (lrcsi_search_explained_cases(search, search->explains) > 0) {
        lrcsi_search_finding_add(
            search, search->explains, "coincident-skins",
            "coincident surfaces, decided by rounding or by order (z-fighting): of facets "
            "in one plane a front has precedence over a back, then the lower index; push backs "
            "away by some roundings of the scene's size");
    }
    return LRCS_OK;
}

/* ---- a factor ---- */

/* Finds a factor that all answers share although each of them is within its class: the median ratio
   of the answers that are not exact. Most ratios must lie nearer to it than to 1, more of them than
   could be due to chance. */
static void bias_try(lrcsi_search *search)
{
    lrcs_host_judgement *job = search->job;
    double *ratio = search->room;
    uint32_t count = 0;
    uint32_t nearer = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const lrcs_host_kit_case *one = &job->kit.list[i];
        if (one->given && lrcs_host_judge_asked(job, one) && one->sigma_m2 > 0.0 &&
            one->grade > LRCS_HOST_GRADE_EXACT && isfinite(one->answer_m2)) {
            ratio[count++] = one->answer_m2 / one->sigma_m2;
        }
    }
    double median = lrcsi_search_upper_median(ratio, count);
    for (uint32_t i = 0; i < count; i++) {
        nearer += fabs(ratio[i] - median) < fabs(ratio[i] - 1.0);
    }
    double least = fmax(BIAS_SHARE, 0.5 + 0.5 * BIAS_SPREADS / sqrt(fmax(count, 1.0)));
    if (count < BIAS_CASES || nearer < least * count || fabs(median - 1.0) < BIAS_LEAST) {
        return;
    }
    for (uint32_t i = 0; i < search->failing_count; i++) {
        const lrcs_host_kit_case *one = search->failing[i];
        search->explains[i] =
            (unsigned char)lrcsi_search_explained(search, one, median * one->sigma_m2);
    }
    lrcs_host_finding *finding = lrcsi_search_finding_add(
        search, search->explains, lrcsi_factor_name(median),
        "all answers are %.6g times the truth: most are within their allowance, but %.0f %% differ "
        "in the same direction, which errors of a raster do not: %s",
        median, 100.0 * nearer / count, lrcsi_factor_text(median, job->pixels));
    if (finding) {
        job->biased = 1;
        finding->factor = median;
    }
}

int lrcsi_symptoms_rest(lrcsi_search *search)
{
    static const struct {
        int grade;
        const char *name, *text;
    } class[] = {{LRCS_HOST_GRADE_FLOAT, "single-precision",
                  "single precision: off by no more than some of its roundings"},
                 {LRCS_HOST_GRADE_RASTER, "raster",
                  "a raster's pixels: off by no more than half a pixel along the outlines"}};
    if (search->job->findings == 0) {
        bias_try(search);
    }
    coarse_try(search);
    depth_try(search);
    int status = z_fighting_try(search);
    if (status != LRCS_OK) {
        return status;
    }
    coarse_try(search);
    for (int k = 0; k < 2; k++) {
        for (uint32_t i = 0; i < search->failing_count; i++) {
            search->explains[i] = search->failing[i]->grade == class[k].grade;
        }
        if (lrcsi_search_explained_cases(search, search->explains) > 0) {
            lrcsi_search_finding_add(search, search->explains, class[k].name, "%s", class[k].text);
        }
    }
    return 0;
}
