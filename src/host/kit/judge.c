/* SPDX-License-Identifier: MIT */
/* The allowed error in each class, and the class of each case. explain.c decides why answers
   differ. */
#include "host/kit/kit.h"

#include <math.h>

#define EXACT_SHARE 1e-9 /* share of sigma */
#define FLOAT_SHARE 1e-6

const char *lrcs_host_grade_text(int grade)
{
    static const char *const name[] = {"exact", "float", "raster", "fail", "missing"};
    return name[grade];
}

double lrcs_host_judge_allowed(const lrcs_host_kit_case *one, int grade, uint32_t pixels)
{
    double share = grade == LRCS_HOST_GRADE_EXACT ? EXACT_SHARE : FLOAT_SHARE;
    double allowed = one->bound_m2 + share * one->sigma_m2;
    allowed += grade >= LRCS_HOST_GRADE_FLOAT ? one->float_m2 : 0.0;
    return allowed + (grade >= LRCS_HOST_GRADE_RASTER ? one->edge_m2 / pixels : 0.0);
}

int lrcs_host_judge_passed(const lrcs_host_judgement *judgement)
{
    return judgement->failed == 0 && !judgement->biased;
}

int lrcs_host_judge_asked(const lrcs_host_judgement *judgement, const lrcs_host_kit_case *one)
{
    return (uint32_t)one->tier <= judgement->tier;
}

int lrcs_host_judge_failed(const lrcs_host_judgement *judgement, const lrcs_host_kit_case *one)
{
    return lrcs_host_judge_asked(judgement, one) && one->grade > judgement->grade;
}

int lrcs_host_judge_unexplained(const lrcs_host_judgement *judgement, const lrcs_host_kit_case *one)
{
    return !lrcs_host_judge_failed(judgement, one) || one->explained ? LRCS_HOST_UNEXPLAINED_NONE
           : !one->given                                             ? LRCS_HOST_UNEXPLAINED_MISSING
           : !isfinite(one->answer_m2) ? LRCS_HOST_UNEXPLAINED_NOT_A_NUMBER
           : one->answer_m2 < 0.0      ? LRCS_HOST_UNEXPLAINED_NEGATIVE
                                       : LRCS_HOST_UNEXPLAINED_UNKNOWN;
}

enum { ANSWER_SCENE, ANSWER_ATTITUDE, ANSWER_SIGMA, ANSWER_DBSM, ANSWER_COLUMNS };

/* Reads the submitted lines: sigma, or dBsm, where an empty field stands for sigma = 0. */
static int answers_read(lrcs_host_judgement *job, const char *path, lrcs_host_error *error)
{
    static const char *const name[ANSWER_COLUMNS] = {"scene", "attitude", "sigma_m2", "sigma_dbsm"};
    lrcsi_kit_table table;
    int status = lrcsi_kit_table_open(path, name, ANSWER_COLUMNS, ANSWER_SIGMA, &table, error);
    job->decibels = status == LRCS_OK && !lrcsi_kit_table_has(&table, ANSWER_SIGMA);
    if (job->decibels && !lrcsi_kit_table_has(&table, ANSWER_DBSM)) {
        status = lrcsi_kit_table_missing(&table, "sigma_m2 or sigma_dbsm");
    }
    int at = job->decibels ? ANSWER_DBSM : ANSWER_SIGMA;
    while (lrcsi_kit_table_next(&table, &status)) {
        lrcs_host_kit_case *one = NULL;
        double value = -HUGE_VAL;
        status = lrcsi_kit_find(&job->kit, &table, &one);
        if (one && one->given) {
            status = lrcsi_kit_table_refuse(&table, ANSWER_ATTITUDE, "every case once");
        } else if (one && (!job->decibels || lrcsi_kit_table_field(&table, at)->size > 0)) {
            status = lrcsi_kit_table_answer(&table, at, &value);
        }
        if (one && status == LRCS_OK) {
            one->answer_printed = value;
            one->answer_m2 = job->decibels ? pow(10.0, value / 10.0) : value;
            one->given = 1;
        }
    }
    lrcsi_kit_table_close(&table);
    return status;
}

int lrcs_host_judge(lrcs_host_judgement *judgement, const char *path, lrcs_host_error *error)
{
    lrcs_host_judgement *job = judgement;
    int status = answers_read(job, path, error);
    for (uint32_t i = 0; i < job->kit.cases && status == LRCS_OK; i++) {
        lrcs_host_kit_case *one = &job->kit.list[i];
        double off = fabs(one->answer_m2 - one->sigma_m2);
        one->grade = one->given ? LRCS_HOST_GRADE_EXACT : LRCS_HOST_GRADE_MISSING;
        while (one->grade < LRCS_HOST_GRADE_FAIL &&
               !(off <= lrcs_host_judge_allowed(one, one->grade, job->pixels))) {
            one->grade++;
        }
        if (lrcs_host_judge_asked(job, one)) {
            job->asked++;
            job->given += (uint32_t)one->given;
            job->failed += (uint32_t)lrcs_host_judge_failed(job, one);
        }
    }
    return status;
}
