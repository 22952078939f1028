/* SPDX-License-Identifier: MIT */
/* The allowed error in each class, and the class of each case. explain.c decides why answers
   differ. */
#include "cli/compare/compare.h"

#include <math.h>

#define EXACT_SHARE 1e-9 /* share of sigma */
#define FLOAT_SHARE 1e-6

const char *cli_compare_grade(int grade)
{
    static const char *const name[] = {"exact", "float", "raster", "fail", "missing"};
    return name[grade];
}

double cli_compare_allowed(const compare_case *one, int grade, uint32_t pixels)
{
    double share = grade == COMPARE_EXACT ? EXACT_SHARE : FLOAT_SHARE;
    double allowed = one->bound_m2 + share * one->sigma_m2;
    allowed += grade >= COMPARE_FLOAT ? one->float_m2 : 0.0;
    return allowed + (grade >= COMPARE_RASTER ? one->edge_m2 / pixels : 0.0);
}

int cli_compare_passed(const compare_job *job)
{
    return job->failed == 0 && !job->biased;
}

int cli_compare_asked(const compare_job *job, const compare_case *one)
{
    return (uint32_t)one->tier <= job->tier;
}

int cli_compare_failed(const compare_job *job, const compare_case *one)
{
    return cli_compare_asked(job, one) && one->grade > job->grade;
}

int cli_compare_lack(const compare_job *job, const compare_case *one)
{
    return !cli_compare_failed(job, one) || one->explained ? LACK_NONE
           : !one->given                                   ? LACK_ANSWER
           : !isfinite(one->theirs_m2)                     ? LACK_NUMBER
           : one->theirs_m2 < 0.0                          ? LACK_SIGN
                                                           : LACK_REASON;
}

enum { ANSWER_SCENE, ANSWER_ATTITUDE, ANSWER_SIGMA, ANSWER_DBSM, ANSWER_COLUMNS };

/* Reads the submitted lines: sigma, or dBsm, where an empty field stands for sigma = 0. */
static int answers_read(compare_job *job)
{
    static const char *const name[ANSWER_COLUMNS] = {"scene", "attitude", "sigma_m2", "sigma_dbsm"};
    compare_table table;
    int code = cli_table_open(job->theirs, name, ANSWER_COLUMNS, ANSWER_SIGMA, &table);
    job->decibels = code == 0 && !cli_table_has(&table, ANSWER_SIGMA);
    if (job->decibels && !cli_table_has(&table, ANSWER_DBSM)) {
        code = cli_table_missing(&table, "sigma_m2 or sigma_dbsm");
    }
    int at = job->decibels ? ANSWER_DBSM : ANSWER_SIGMA;
    while (cli_table_next(&table, &code)) {
        compare_case *one = cli_compare_find(&job->kit, &table);
        double value = -HUGE_VAL;
        code = one ? 0 : CLI_FAILED;
        if (one && one->given) {
            code = cli_table_refuse(&table, ANSWER_ATTITUDE, "every case once");
        } else if (one && (!job->decibels || cli_table_field(&table, at)->size > 0)) {
            code = cli_table_answer(&table, at, &value);
        }
        if (code == 0) {
            one->printed = value;
            one->theirs_m2 = job->decibels ? pow(10.0, value / 10.0) : value;
            one->given = 1;
        }
    }
    cli_table_close(&table);
    return code;
}

int cli_compare_judge(compare_job *job)
{
    int code = answers_read(job);
    for (uint32_t i = 0; i < job->kit.cases && code == 0; i++) {
        compare_case *one = &job->kit.list[i];
        double off = fabs(one->theirs_m2 - one->sigma_m2);
        one->grade = one->given ? COMPARE_EXACT : COMPARE_MISSING;
        while (one->grade < COMPARE_FAIL &&
               !(off <= cli_compare_allowed(one, one->grade, job->pixels))) {
            one->grade++;
        }
        if (cli_compare_asked(job, one)) {
            job->asked++;
            job->given += (uint32_t)one->given;
            job->failed += (uint32_t)cli_compare_failed(job, one);
        }
    }
    return code;
}
