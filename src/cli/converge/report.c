/* SPDX-License-Identifier: MIT */
/* The output of lrcs converge in numbers and words: the table, JSON, CSV, and the summary sentence.
   This file decides which setting is cheapest: the one with the least pose time among those whose
   bounds suffice. */
#include "cli/converge/converge.h"

#include <math.h>
#include <string.h>

static const struct {
    double value;
    const char *text;
} report_tolerance[] = {{1e-2, "1e-2"}, {1e-3, "1e-3"}, {1e-4, "1e-4"}, {1e-6, "1e-6"}};

#define REPORT_TOLERANCES (sizeof report_tolerance / sizeof report_tolerance[0])

/* By what a preview was accepted: NULL for other settings, and if the tolerance is missed. */
static const char *accepted_by(const lrcs_host_convergence_setting *setting)
{
    return setting->digits > 0 ? cli_accepted_by(setting->flags) : NULL;
}

/* ---- the sentence ---- */

/* As for --tolerance: bound <= tolerance * sigma. */
static const lrcs_host_convergence_setting *setting_cheapest(const lrcs_host_convergence *all,
                                                             double tolerance)
{
    const lrcs_host_convergence_setting *best = NULL;
    for (uint32_t i = 0; i < all->settings; i++) {
        const lrcs_host_convergence_setting *one = &all->setting[i];
        int meets = one->bound_m2 >= 0.0 && one->bound_m2 <= tolerance * one->sigma_m2;
        if (meets && (!best || one->pose_s < best->pose_s)) {
            best = one;
        }
    }
    return best;
}

static const lrcs_host_convergence_setting *setting_best(const lrcs_host_convergence *all)
{
    const lrcs_host_convergence_setting *best = NULL;
    for (uint32_t i = 0; i < all->settings; i++) {
        const lrcs_host_convergence_setting *one = &all->setting[i];
        int better = !best || one->bound_m2 < best->bound_m2 ||
                     (one->bound_m2 == best->bound_m2 && one->pose_s < best->pose_s);
        if (one->bound_m2 >= 0.0 && better) {
            best = one;
        }
    }
    return best;
}

converge_sentence cli_converge_sentence(const lrcs_host_convergence *all)
{
    converge_sentence sentence = {"The cheapest setting by pose time for a proved bound of "};
    const lrcs_host_convergence_setting *best = setting_best(all);
    const char *verb = " is";
    for (size_t i = 0; i < REPORT_TOLERANCES; i++) {
        const lrcs_host_convergence_setting *one = setting_cheapest(all, report_tolerance[i].value);
        lrcs_host_append(sentence.text, sizeof sentence.text, "%s", report_tolerance[i].text);
        if (i + 1 < REPORT_TOLERANCES &&
            one == setting_cheapest(all, report_tolerance[i + 1].value)) {
            lrcs_host_append(sentence.text, sizeof sentence.text, ", ");
            continue;
        }
        lrcs_host_append(sentence.text, sizeof sentence.text, "%s %s", verb,
                         one ? one->name : "none of these");
        if (one) {
            lrcs_host_append(
                sentence.text, sizeof sentence.text, " (%.3g ms%s)", 1e3 * one->pose_s,
                one->kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW ? "; its bound suffices here" : "");
        }
        lrcs_host_append(sentence.text, sizeof sentence.text,
                         i + 1 < REPORT_TOLERANCES ? ", for " : "; ");
        verb = "";
    }
    if (best) {
        lrcs_host_append(
            sentence.text, sizeof sentence.text, "the best bound, %.2g%s, is that of %s (%.3g ms).",
            lrcs_host_convergence_relative(all, best->bound_m2),
            all->truth.sigma_m2 > 0.0 ? " of sigma" : " m2", best->name, 1e3 * best->pose_s);
    } else {
        lrcs_host_append(sentence.text, sizeof sentence.text, "no bound is known.");
    }
    const char *before = " Accepted by estimate, a tolerance of ";
    for (uint32_t i = 0; i < all->settings; i++) {
        const lrcs_host_convergence_setting *one = &all->setting[i];
        if (one->kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW) {
            const char *by = accepted_by(one);
            lrcs_host_append(sentence.text, sizeof sentence.text, "%s1e-%d takes %.3g ms%s", before,
                             one->digits, 1e3 * one->pose_s,
                             by && strcmp(by, "estimate") == 0 ? ""
                             : by                              ? " (its bound meets it, too)"
                                                               : " (it is missed)");
            before = ", ";
        }
    }
    lrcs_host_append(sentence.text, sizeof sentence.text, before[0] == ',' ? "." : "");
    return sentence;
}

/* ---- the table of tolerances ---- */

/* A setting and its time in two columns. */
static void setting_cells(const char *name, double pose_s)
{
    if (name) {
        printf("  %-22s %10.4g", name, 1e3 * pose_s);
    } else {
        printf("  %-22s %10s", "none of these", "-");
    }
}

/* Prints for each tolerance the cheapest setting whose bound meets it, and what the tolerance costs
   if it is accepted by estimate. */
static void tolerances_table(const lrcs_host_convergence *all)
{
    int previews = 0;
    int suffices = 0; /* is the bound of a preview the cheapest proof? */
    for (uint32_t i = 0; i < all->settings; i++) {
        previews += all->setting[i].kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW;
    }
    printf("\n%-10s  %-22s %10s", "tolerance", "cheapest, proved", "ms");
    printf(previews > 0 ? "  %-22s %10s\n" : "\n", "accepted by estimate", "ms");
    for (int digits = 1; digits <= 6; digits++) {
        const lrcs_host_convergence_setting *preview = NULL;
        double tolerance = pow(10.0, -digits);
        for (uint32_t i = 0; i < all->settings; i++) {
            const lrcs_host_convergence_setting *one = &all->setting[i];
            int asked = one->kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW && one->digits == digits;
            preview = asked ? one : preview;
        }
        const lrcs_host_convergence_setting *proved = setting_cheapest(all, tolerance);
        suffices |= proved && proved->kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW;
        printf("1e-%-7d", digits);
        setting_cells(proved ? proved->name : NULL, proved ? proved->pose_s : 0.0);
        if (preview) {
            const char *by = accepted_by(preview);
            setting_cells(preview->name, preview->pose_s);
            printf("%s", !by                           ? "   missed"
                         : strcmp(by, "estimate") == 0 ? ""
                                                       : "   its bound meets it, too");
        }
        putchar('\n');
    }
    if (suffices) {
        printf("what is accepted by estimate counts as proved where its bound suffices\n");
    }
}

/* ---- a setting's numbers, which every form shows ---- */

enum {
    NUMBER_RESOLUTION,
    NUMBER_MESH,
    NUMBER_FACETS,
    NUMBER_RUNS,
    NUMBER_PREPARE,
    NUMBER_POSE,
    NUMBER_SIGMA,
    NUMBER_ERROR,
    NUMBER_BOUND,
    NUMBER_ESTIMATE,
    NUMBER_RELATIVE_ERROR,
    NUMBER_RELATIVE_BOUND,
    NUMBER_RELATIVE_ESTIMATE,
    NUMBERS
};

/* Their names in CSV and JSON. */
static const char *const number_name[NUMBERS] = {
    "resolution",     "mesh_tolerance", "facets",           "repetitions", "prepare_ms",
    "pose_ms",        "sigma_m2",       "error_m2",         "bound_m2",    "estimate_m2",
    "relative_error", "relative_bound", "relative_estimate"};

/* A number that is not known, or that a setting does not have, is NaN. */
static void numbers_make(const lrcs_host_convergence *all, const lrcs_host_convergence_setting *one,
                         double number[NUMBERS])
{
    const lrcs_host_convergence_mesh *mesh = &all->mesh[one->mesh];
    double bound = cli_known(one->bound_m2);
    double estimate = cli_known(one->estimate_m2);
    const double list[NUMBERS] = {one->resolution ? one->resolution : (double)NAN,
                                  mesh->digits > 0 ? pow(10.0, -mesh->digits) : (double)NAN,
                                  mesh->scene.scene.facet_count,
                                  one->runs,
                                  1e3 * mesh->scene.seconds_prepare,
                                  1e3 * one->pose_s,
                                  one->sigma_m2,
                                  one->error_m2,
                                  bound,
                                  estimate,
                                  lrcs_host_convergence_relative(all, one->error_m2),
                                  lrcs_host_convergence_relative(all, bound),
                                  lrcs_host_convergence_relative(all, estimate)};
    memcpy(number, list, sizeof list);
}

void cli_converge_table(const converge_job *job)
{
    converge_sentence sentence = cli_converge_sentence(&job->all);
    const char *unit = job->all.truth.sigma_m2 > 0.0 ? "relative" : "m2";
    const lrcs_host_scene *scene = &lrcs_host_convergence_finest(&job->all)->scene;
    printf("scene  ");
    cli_scene_print(job->args, scene);
    printf(", hash %016llx\n", (unsigned long long)lrcs_scene_hash(&scene->scene));
    printf("truth  %.15g m2, known to %.2g m2%s: %s\n\n", job->all.truth.sigma_m2,
           job->all.truth.bound_m2, job->all.truth.true_shapes ? "" : " for its facets",
           job->all.truth.text);
    printf("%-22s %8s %4s %10s %10s %16s %10s %10s %10s\n", "", "", "", "prepare", "pose", "sigma",
           "error", "bound", "estimate");
    printf("%-22s %8s %4s %10s %10s %16s %10s %10s %10s\n", "setting", "facets", "runs", "ms",
           "median ms", "m2", unit, unit, unit);
    for (uint32_t i = 0; i < job->all.settings; i++) {
        double number[NUMBERS];
        numbers_make(&job->all, &job->all.setting[i], number);
        printf("%-22s %8.0f %4.0f %10.4g %10.4g %16.12g", job->all.setting[i].name,
               number[NUMBER_FACETS], number[NUMBER_RUNS], number[NUMBER_PREPARE],
               number[NUMBER_POSE], number[NUMBER_SIGMA]);
        for (int k = NUMBER_RELATIVE_ERROR; k <= NUMBER_RELATIVE_ESTIMATE; k++) {
            if (isnan(number[k])) {
                printf(" %10s", "-");
            } else {
                printf(" %10.3g", number[k]);
            }
        }
        putchar('\n');
    }
    tolerances_table(&job->all);
    printf("\n%s\n", sentence.text);
}

/* ---- CSV ---- */

void cli_converge_about(FILE *out, const void *context)
{
    const converge_job *job = context;
    double s_hat[3];
    cli_pose_unit(&job->all.pose, s_hat);
    cli_table_head(out, job->args, job->title, &lrcs_host_convergence_finest(&job->all)->scene,
                   s_hat);
    lrcs_host_number_put(out, "; truth_m2=", job->all.truth.sigma_m2);
    lrcs_host_number_put(out, "; truth_bound_m2=", job->all.truth.bound_m2);
    fprintf(out, "; truth_of=%s; truth=%s", job->all.truth.true_shapes ? "shapes" : "facets",
            job->all.truth.text);
}

void cli_converge_csv(FILE *out, const void *context)
{
    const converge_job *job = context;
    fputs("setting,method", out);
    for (int k = 0; k < NUMBERS; k++) {
        fprintf(out, ",%s", number_name[k]);
    }
    fputs(",accepted_by\n", out);
    for (uint32_t i = 0; i < job->all.settings; i++) {
        const lrcs_host_convergence_setting *one = &job->all.setting[i];
        double number[NUMBERS];
        numbers_make(&job->all, one, number);
        fprintf(out, "%s,%s", one->name, lrcs_method_text(one->method));
        for (int k = 0; k < NUMBERS; k++) {
            if (isnan(number[k])) {
                putc(',', out);
            } else if (k == NUMBER_MESH) {
                fprintf(out, ",1e-%d", job->all.mesh[one->mesh].digits);
            } else {
                lrcs_host_number_put(out, ",", number[k]);
            }
        }
        const char *by = accepted_by(one);
        fprintf(out, ",%s\n", by ? by : "");
    }
}

/* ---- JSON ---- */

/* The setting, in an open object, which it ends. */
static void cheapest_json(const lrcs_host_convergence_setting *one, lrcs_host_json *json)
{
    lrcs_host_json_put(json, "setting=%s pose_ms=%g bound_m2=%g}", one ? one->name : NULL,
                       one ? 1e3 * one->pose_s : (double)NAN, one ? one->bound_m2 : (double)NAN);
}

void cli_converge_json(const converge_job *job)
{
    const lrcs_host_scene *scene = &lrcs_host_convergence_finest(&job->all)->scene;
    lrcs_host_json json = lrcs_host_json_make(stdout);
    converge_sentence sentence = cli_converge_sentence(&job->all);
    lrcs_host_json_put(&json, "{\n");
    cli_version_json(&json);
    cli_hash_json(lrcs_scene_hash(&scene->scene), &json);
    cli_files_json(scene, &json);
    lrcs_host_json_put(&json, "unit=%s", cli_scene_unit(job->args, scene));
    cli_direction_json(&job->all.pose, &json);
    lrcs_host_json_put(&json, "truth={from=%s sigma_m2=%g bound_m2=%g of_facets=%d} settings=[\n",
                       job->all.truth.text, job->all.truth.sigma_m2, job->all.truth.bound_m2,
                       !job->all.truth.true_shapes);
    for (uint32_t i = 0; i < job->all.settings; i++) {
        const lrcs_host_convergence_setting *one = &job->all.setting[i];
        double number[NUMBERS];
        numbers_make(&job->all, one, number);
        lrcs_host_json_put(&json, "{setting=%s method=%s", one->name,
                           lrcs_method_text(one->method));
        for (int k = 0; k < NUMBERS; k++) {
            lrcs_host_json_number(&json, number_name[k], number[k]);
        }
        if (one->digits > 0) {
            lrcs_host_json_put(&json, "tolerance=%g accepted_by=%s", pow(10.0, -one->digits),
                               accepted_by(one));
        }
        lrcs_host_json_put(&json, "}");
    }
    lrcs_host_json_put(&json, "] cheapest=[\n");
    for (size_t i = 0; i < REPORT_TOLERANCES; i++) {
        lrcs_host_json_put(&json, "{tolerance=%g", report_tolerance[i].value);
        cheapest_json(setting_cheapest(&job->all, report_tolerance[i].value), &json);
    }
    lrcs_host_json_put(&json, "] best={");
    cheapest_json(setting_best(&job->all), &json);
    lrcs_host_json_put(&json, "notices=[\n");
    cli_notices_json(&scene->notices, &json);
    if (job->all.left_out[0]) {
        lrcs_host_json_put(&json, "%s", job->all.left_out);
    }
    if (job->all.busy[0]) {
        lrcs_host_json_put(&json, "%s", job->all.busy);
    }
    lrcs_host_json_put(&json, "] sentence=%s", sentence.text);
    cli_provenance_json(job->args, scene, &json);
    lrcs_host_json_put(&json, "}");
}
