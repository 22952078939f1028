/* SPDX-License-Identifier: MIT */
/* The output of lrcs converge in numbers and words: the table, JSON, CSV, and the summary sentence.
   This file decides which setting is cheapest: the one with the least pose time among those whose
   bounds suffice. */
#include "cli/converge/converge.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static const struct {
    double value;
    const char *text;
} report_tolerance[] = {{1e-2, "1e-2"}, {1e-3, "1e-3"}, {1e-4, "1e-4"}, {1e-6, "1e-6"}};

#define REPORT_TOLERANCES (sizeof report_tolerance / sizeof report_tolerance[0])

const lrcs_host_scene *cli_converge_scene(const converge_job *job, const converge_setting *one)
{
    return &job->mesh[one->mesh].scene;
}

double cli_converge_relative(const converge_job *job, double value_m2)
{
    double truth = job->truth.sigma_m2;
    return truth > 0.0 ? value_m2 / truth : value_m2;
}

/* A known value is not negative and is unchanged; NaN, which no writer shows as a number, if not
   known. */
double cli_converge_known(double value)
{
    return value >= 0.0 ? value : (double)NAN;
}

/* ---- the sentence ---- */

/* As for --tolerance: bound <= tolerance * sigma. */
static const converge_setting *setting_cheapest(const converge_job *job, double tolerance)
{
    const converge_setting *best = NULL;
    for (uint32_t i = 0; i < job->settings; i++) {
        const converge_setting *one = &job->setting[i];
        int meets = one->bound_m2 >= 0.0 && one->bound_m2 <= tolerance * one->sigma_m2;
        if (meets && (!best || one->pose_s < best->pose_s)) {
            best = one;
        }
    }
    return best;
}

static const converge_setting *setting_best(const converge_job *job)
{
    const converge_setting *best = NULL;
    for (uint32_t i = 0; i < job->settings; i++) {
        const converge_setting *one = &job->setting[i];
        int better = !best || one->bound_m2 < best->bound_m2 ||
                     (one->bound_m2 == best->bound_m2 && one->pose_s < best->pose_s);
        if (one->bound_m2 >= 0.0 && better) {
            best = one;
        }
    }
    return best;
}

__attribute__((format(printf, 2, 3))) static void sentence_add(converge_sentence *sentence,
                                                               const char *format, ...)
{
    size_t used = strlen(sentence->text);
    va_list list;
    va_start(list, format);
    vsnprintf(sentence->text + used, sizeof sentence->text - used, format, list);
    va_end(list);
}

converge_sentence cli_converge_sentence(const converge_job *job)
{
    converge_sentence sentence = {"The cheapest setting by pose time for a bound of "};
    const converge_setting *best = setting_best(job);
    const char *verb = " is";
    for (size_t i = 0; i < REPORT_TOLERANCES; i++) {
        const converge_setting *one = setting_cheapest(job, report_tolerance[i].value);
        sentence_add(&sentence, "%s", report_tolerance[i].text);
        if (i + 1 < REPORT_TOLERANCES &&
            one == setting_cheapest(job, report_tolerance[i + 1].value)) {
            sentence_add(&sentence, ", ");
            continue;
        }
        sentence_add(&sentence, "%s %s", verb, one ? one->name : "none of these");
        if (one) {
            sentence_add(&sentence, " (%.3g ms)", 1e3 * one->pose_s);
        }
        sentence_add(&sentence, i + 1 < REPORT_TOLERANCES ? ", for " : "; ");
        verb = "";
    }
    if (best) {
        sentence_add(&sentence, "the best bound, %.2g%s, is that of %s (%.3g ms).",
                     cli_converge_relative(job, best->bound_m2),
                     job->truth.sigma_m2 > 0.0 ? " of sigma" : " m2", best->name,
                     1e3 * best->pose_s);
    } else {
        sentence_add(&sentence, "no bound is known.");
    }
    const char *before = " By estimate, unproved, a tolerance of ";
    for (uint32_t i = 0; i < job->settings; i++) {
        const converge_setting *one = &job->setting[i];
        if (one->dial == CONVERGE_PREVIEW) {
            int estimated = one->accepted_by && strcmp(one->accepted_by, "estimate") == 0;
            sentence_add(&sentence, "%s1e-%d takes %.3g ms%s", before, one->digits,
                         1e3 * one->pose_s,
                         estimated          ? ""
                         : one->accepted_by ? " (and is proved)"
                                            : " (and is missed)");
            before = ", ";
        }
    }
    sentence_add(&sentence, before[0] == ',' ? "." : "");
    return sentence;
}

/* ---- the table ---- */

static void number_cell(int width, double value)
{
    if (value >= 0.0) {
        printf(" %*.3g", width, value);
    } else {
        printf(" %*s", width, "-");
    }
}

void cli_converge_table(const converge_job *job)
{
    converge_sentence sentence = cli_converge_sentence(job);
    const char *unit = job->truth.sigma_m2 > 0.0 ? "relative" : "m2";
    printf("scene  %s, hash %016llx\n", job->args->operand,
           (unsigned long long)lrcs_scene_hash(&cli_converge_finest(job)->scene.scene));
    printf("truth  %.15g m2, known to %.2g m2%s: %s\n\n", job->truth.sigma_m2, job->truth.bound_m2,
           job->truth.whole ? "" : " for its facets", job->truth.text);
    printf("%-22s %8s %4s %10s %10s %16s %10s %10s %10s\n", "", "", "", "prepare", "pose", "sigma",
           "error", "bound", "estimate");
    printf("%-22s %8s %4s %10s %10s %16s %10s %10s %10s\n", "setting", "facets", "runs", "ms",
           "median ms", "m2", unit, unit, unit);
    for (uint32_t i = 0; i < job->settings; i++) {
        const converge_setting *one = &job->setting[i];
        printf("%-22s %8lu %4lu %10.4g %10.4g %16.12g", one->name,
               (unsigned long)cli_converge_scene(job, one)->scene.facet_count,
               (unsigned long)one->runs, 1e3 * cli_converge_scene(job, one)->seconds_prepare,
               1e3 * one->pose_s, one->sigma_m2);
        number_cell(10, cli_converge_relative(job, one->error_m2));
        number_cell(10, cli_converge_relative(job, one->bound_m2));
        number_cell(10, cli_converge_relative(job, one->estimate_m2));
        putchar('\n');
    }
    printf("\n%s\n", sentence.text);
}

/* ---- CSV ---- */

void cli_converge_about(FILE *out, const void *context)
{
    const converge_job *job = context;
    double s_hat[3];
    cli_pose_unit(&job->pose, s_hat);
    cli_table_head(out, job->args, job->title, &cli_converge_finest(job)->scene, s_hat);
    cli_number_put(out, "; truth_m2=", job->truth.sigma_m2);
    cli_number_put(out, "; truth_bound_m2=", job->truth.bound_m2);
    fprintf(out, "; truth_of=%s; truth=%s", job->truth.whole ? "shapes" : "facets",
            job->truth.text);
}

void cli_converge_csv(const converge_job *job, FILE *out)
{
    fputs("# ", out);
    cli_converge_about(out, job);
    fputs("\nsetting,method,resolution,mesh_tolerance,facets,repetitions,prepare_ms,pose_ms,"
          "sigma_m2,error_m2,bound_m2,estimate_m2,relative_error,relative_bound,"
          "relative_estimate,accepted_by\n",
          out);
    for (uint32_t i = 0; i < job->settings; i++) {
        const converge_setting *one = &job->setting[i];
        const double value[] = {1e3 * cli_converge_scene(job, one)->seconds_prepare,
                                1e3 * one->pose_s,
                                one->sigma_m2,
                                one->error_m2,
                                one->bound_m2,
                                one->estimate_m2,
                                cli_converge_relative(job, one->error_m2),
                                cli_converge_relative(job, one->bound_m2),
                                cli_converge_relative(job, one->estimate_m2)};
        char text[LRCS_HOST_NUMBER_SIZE] = "";
        fprintf(out, "%s,%s,", one->name, lrcs_method_text(one->method));
        fprintf(out, one->resolution ? "%lu," : ",", (unsigned long)one->resolution);
        if (job->mesh[one->mesh].digits > 0) {
            snprintf(text, sizeof text, "1e-%d", job->mesh[one->mesh].digits);
        }
        fprintf(out, "%s,%lu,%lu", text,
                (unsigned long)cli_converge_scene(job, one)->scene.facet_count,
                (unsigned long)one->runs);
        for (size_t k = 0; k < sizeof value / sizeof value[0]; k++) {
            lrcs_host_number_text(value[k], text);
            fprintf(out, ",%s", value[k] >= 0.0 ? text : "");
        }
        fprintf(out, ",%s\n", one->accepted_by ? one->accepted_by : "");
    }
}

/* ---- JSON ---- */

static void setting_json(const converge_job *job, const converge_setting *one, lrcs_host_json *json)
{
    int digits = job->mesh[one->mesh].digits;
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_text(json, "setting", one->name);
    lrcs_host_json_text(json, "method", lrcs_method_text(one->method));
    lrcs_host_json_number(json, "resolution", one->resolution ? one->resolution : (double)NAN);
    lrcs_host_json_number(json, "mesh_tolerance", digits > 0 ? pow(10.0, -digits) : (double)NAN);
    lrcs_host_json_count(json, "facets", cli_converge_scene(job, one)->scene.facet_count);
    lrcs_host_json_count(json, "repetitions", one->runs);
    lrcs_host_json_number(json, "prepare_ms", 1e3 * cli_converge_scene(job, one)->seconds_prepare);
    lrcs_host_json_number(json, "pose_ms", 1e3 * one->pose_s);
    lrcs_host_json_number(json, "sigma_m2", one->sigma_m2);
    lrcs_host_json_number(json, "error_m2", one->error_m2);
    lrcs_host_json_number(json, "bound_m2", cli_converge_known(one->bound_m2));
    lrcs_host_json_number(json, "estimate_m2", cli_converge_known(one->estimate_m2));
    lrcs_host_json_number(json, "relative_error", cli_converge_relative(job, one->error_m2));
    lrcs_host_json_number(json, "relative_bound",
                          cli_converge_known(cli_converge_relative(job, one->bound_m2)));
    lrcs_host_json_number(json, "relative_estimate",
                          cli_converge_known(cli_converge_relative(job, one->estimate_m2)));
    if (one->digits > 0) {
        lrcs_host_json_number(json, "tolerance", pow(10.0, -one->digits));
        lrcs_host_json_text(json, "accepted_by", one->accepted_by);
    }
    lrcs_host_json_end(json);
}

static void cheapest_json(const char *key, double tolerance, const converge_setting *one,
                          lrcs_host_json *json)
{
    lrcs_host_json_begin(json, key, LRCS_HOST_ROW_OBJECT);
    if (!key) {
        lrcs_host_json_number(json, "tolerance", tolerance);
    }
    lrcs_host_json_text(json, "setting", one ? one->name : NULL);
    lrcs_host_json_number(json, "pose_ms", one ? 1e3 * one->pose_s : (double)NAN);
    lrcs_host_json_number(json, "bound_m2", one ? one->bound_m2 : (double)NAN);
    lrcs_host_json_end(json);
}

static void notices_json(const converge_job *job, lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "notices", LRCS_HOST_ARRAY);
    const lrcs_host_notices *notices = &cli_converge_finest(job)->scene.notices;
    for (uint32_t i = 0; i < notices->count; i++) {
        lrcs_host_json_text(json, NULL, notices->text[i]);
    }
    if (job->left_out[0]) {
        lrcs_host_json_text(json, NULL, job->left_out);
    }
    if (job->busy[0]) {
        lrcs_host_json_text(json, NULL, job->busy);
    }
    lrcs_host_json_end(json);
}

void cli_converge_json(const converge_job *job)
{
    const lrcs_host_scene *scene = &cli_converge_finest(job)->scene;
    lrcs_host_json json = lrcs_host_json_make(stdout);
    converge_sentence sentence = cli_converge_sentence(job);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    cli_version_json(&json);
    cli_hash_json(lrcs_scene_hash(&scene->scene), &json);
    cli_files_json(scene, &json);
    lrcs_host_json_text(&json, "unit", cli_value(job->args, "unit"));
    cli_direction_json(&job->pose, &json);
    lrcs_host_json_begin(&json, "truth", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_text(&json, "from", job->truth.text);
    lrcs_host_json_number(&json, "sigma_m2", job->truth.sigma_m2);
    lrcs_host_json_number(&json, "bound_m2", job->truth.bound_m2);
    lrcs_host_json_bool(&json, "of_facets", !job->truth.whole);
    lrcs_host_json_end(&json);
    lrcs_host_json_begin(&json, "settings", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < job->settings; i++) {
        setting_json(job, &job->setting[i], &json);
    }
    lrcs_host_json_end(&json);
    lrcs_host_json_begin(&json, "cheapest", LRCS_HOST_ARRAY);
    for (size_t i = 0; i < REPORT_TOLERANCES; i++) {
        cheapest_json(NULL, report_tolerance[i].value,
                      setting_cheapest(job, report_tolerance[i].value), &json);
    }
    lrcs_host_json_end(&json);
    cheapest_json("best", 0.0, setting_best(job), &json);
    notices_json(job, &json);
    lrcs_host_json_text(&json, "sentence", sentence.text);
    cli_provenance_json(job->args, scene, &json);
    lrcs_host_json_end(&json);
}
