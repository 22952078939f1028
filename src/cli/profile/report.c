/* SPDX-License-Identifier: MIT */
/* The output of lrcs profile: a table for people, JSON, CSV. */
#include "cli/profile/profile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* If there are more rows than this, bins and those that only a pulse reaches, the table shows only
   the strongest; --csv and --json contain all of them. */
#define TABLE_ROWS 40u

static double total_sigma(const profile_job *job)
{
    return job->profile.list.sigma_glint_m2 + job->profile.list.sigma_diffuse_m2;
}

/* 1 if some normals are curved: then the error of their integral is estimated. */
static int is_curved(const profile_job *job)
{
    return job->profile.list.curvature_estimate_m2 >= 0.0;
}

/* ---- CSV ---- */

/* What CSV and JSON hold of a row, in the order of CSV; some only if there is a pulse, or if
   normals are curved. */
enum { NEEDS_PULSE = 1, NEEDS_CURVES = 2, ROW_FIELDS = 11 };
static const struct {
    const char *name;
    int needs;
    int json; /* the field that is the key at this place of JSON */
} row_field[ROW_FIELDS] = {{"near_m", 0, 0},
                           {"far_m", 0, 1},
                           {"sigma_m2", 0, 2},
                           {"bound_m2", 0, 3},
                           {"sigma_glint_m2", 0, 4},
                           {"sigma_diffuse_m2", 0, 5},
                           {"density_m", 0, 6},
                           {"pulse_m", NEEDS_PULSE, 9},
                           {"pulse_bound_m", NEEDS_PULSE, 7},
                           {"curvature_estimate_m2", NEEDS_CURVES, 8},
                           {"pulse_estimate_m", NEEDS_PULSE | NEEDS_CURVES, 10}};

static int field_holds(const profile_job *job, int k)
{
    int has = (job->fwhm_m > 0.0 ? NEEDS_PULSE : 0) | (is_curved(job) ? NEEDS_CURVES : 0);
    return (row_field[k].needs & ~has) == 0;
}

static void row_values(const profile_job *job, const profile_row *row, double value[ROW_FIELDS])
{
    double sigma = cli_profile_sigma(&row->bin);
    const double all[ROW_FIELDS] = {row->near_m,
                                    row->far_m,
                                    sigma,
                                    row->bin.bound_m2,
                                    row->bin.sigma_glint_m2,
                                    row->bin.sigma_diffuse_m2,
                                    sigma / job->bin_m,
                                    row->pulse_m,
                                    row->pulse_bound_m,
                                    row->bin.curvature_estimate_m2,
                                    row->pulse_estimate_m};
    memcpy(value, all, sizeof all);
}

void cli_profile_about(FILE *out, const void *context)
{
    const profile_job *job = context;
    double s_hat[3];
    cli_pose_unit(&job->pose, s_hat);
    cli_table_head(out, job->args, job->title, &job->scene, s_hat);
    lrcs_host_number_put(out, "; sigma_m2=", total_sigma(job));
    if (job->fwhm_m > 0.0) {
        lrcs_host_number_put(out, "; pulse_fwhm_m=", job->fwhm_m);
    }
    lrcs_host_number_put(out, "; bound_of_the_sum_m2=", job->profile.list.bound_m2);
    fputs(job->materials_assumed ? "; materials=illustrative or assumed" : "", out);
}

void cli_profile_csv(FILE *out, const void *context)
{
    const profile_job *job = context;
    fputs("# ", out);
    cli_profile_about(out, job);
    putc('\n', out);
    for (int k = 0; k < ROW_FIELDS; k++) {
        if (field_holds(job, k)) {
            fprintf(out, "%s%s", k > 0 ? "," : "", row_field[k].name);
        }
    }
    putc('\n', out);
    for (uint32_t i = 0; i < job->rows; i++) {
        double value[ROW_FIELDS];
        row_values(job, &job->row[i], value);
        for (int k = 0; k < ROW_FIELDS; k++) {
            if (field_holds(job, k)) {
                lrcs_host_number_put(out, k > 0 ? "," : "", value[k]);
            }
        }
        putc('\n', out);
    }
}

/* ---- JSON ---- */

void cli_profile_json(const profile_job *job)
{
    const lrcs_profile *p = &job->profile.list;
    lrcs_host_json json = lrcs_host_json_make(stdout);
    lrcs_host_json_put(&json, "{\n");
    cli_version_json(&json);
    cli_hash_json(lrcs_scene_hash(&job->scene.scene), &json);
    cli_files_json(&job->scene, &json);
    lrcs_host_json_put(&json, "unit=%s", cli_scene_unit(job->args, &job->scene));
    cli_direction_json(&job->pose, &json);
    lrcs_host_json_put(
        &json,
        "bin_m=%g pulse_fwhm_m=%g sigma_m2=%g sigma_glint_m2=%g sigma_diffuse_m2=%g bound_m2=%g "
        "normals=%s curvature_estimate_m2=%g bound_refers_to=%s",
        job->bin_m, job->fwhm_m > 0.0 ? job->fwhm_m : (double)NAN, total_sigma(job),
        p->sigma_glint_m2, p->sigma_diffuse_m2, p->bound_m2,
        lrcs_normals_text(job->scene.scene.normals),
        is_curved(job) ? p->curvature_estimate_m2 : (double)NAN,
        p->tessellation_known ? "the facets of models, and true curved shapes"
                              : "the facets, also those that stand for curved shapes");
    if (job->asked > 0.0) {
        lrcs_host_json_put(&json, "tolerance={asked=%g met=%d}", job->asked, job->met);
    } else {
        lrcs_host_json_put(&json, "tolerance={asked=null met=null}");
    }
    lrcs_host_json_put(&json, "notices=[\n");
    cli_notices_json(&job->scene.notices, &json);
    lrcs_host_json_put(&json, "]");
    cli_provenance_json(job->args, &job->scene, &json);
    lrcs_host_json_put(&json, "bins=[\n");
    for (uint32_t i = 0; i < job->rows; i++) {
        double value[ROW_FIELDS];
        row_values(job, &job->row[i], value);
        lrcs_host_json_put(&json, "{");
        for (int k = 0; k < ROW_FIELDS; k++) {
            int field = row_field[k].json;
            if (field_holds(job, field)) {
                lrcs_host_json_number(&json, row_field[field].name, value[field]);
            }
        }
        lrcs_host_json_put(&json, "}");
    }
    lrcs_host_json_put(&json, "]}");
}

/* ---- the table ---- */

static int by_falling_sigma(const void *a, const void *b)
{
    double left = cli_profile_sigma(&((const profile_row *)a)->bin);
    double right = cli_profile_sigma(&((const profile_row *)b)->bin);
    return left < right ? 1 : left > right ? -1 : 0;
}

static int by_range(const void *a, const void *b)
{
    double left = ((const profile_row *)a)->near_m;
    double right = ((const profile_row *)b)->near_m;
    return left > right ? 1 : left < right ? -1 : 0;
}

static void row_print(const profile_job *job, const profile_row *row)
{
    char bound[LRCS_HOST_BOUND_SIZE];
    double sigma = cli_profile_sigma(&row->bin);
    lrcs_host_bound_text(row->bin.bound_m2, 2, bound);
    printf("  %12.6g %12.6g %14.8g %9s %12.6g", row->near_m, row->far_m, sigma, bound,
           sigma / job->bin_m);
    if (job->fwhm_m > 0.0) {
        lrcs_host_bound_text(row->pulse_bound_m, 2, bound);
        printf(" %14.8g %9s", row->pulse_m, bound);
    }
    putchar('\n');
}

/* Prints all bins, or, if there are many, the strongest, by range. */
static void bins_print(const profile_job *job)
{
    profile_row *sorted = calloc((size_t)job->rows + 1, sizeof *sorted);
    printf("  %12s %12s %14s %9s %12s%s\n", "from (m)", "to (m)", "sigma (m2)", "bound", "m2 per m",
           job->fwhm_m > 0.0 ? "   pulse (m2/m)     bound" : "");
    for (uint32_t i = 0; i < job->rows; i++) {
        if (job->rows <= TABLE_ROWS || !sorted) {
            row_print(job, &job->row[i]);
        } else {
            sorted[i] = job->row[i];
        }
    }
    if (job->rows > TABLE_ROWS && sorted) {
        qsort(sorted, job->rows, sizeof *sorted, by_falling_sigma);
        qsort(sorted, TABLE_ROWS / 2, sizeof *sorted, by_range);
        for (uint32_t i = 0; i < TABLE_ROWS / 2; i++) {
            row_print(job, &sorted[i]);
        }
        printf("  the strongest %lu of %lu rows, by range; --csv and --json give all\n",
               (unsigned long)(TABLE_ROWS / 2), (unsigned long)job->rows);
        if (job->rows > job->profile.list.count) {
            printf("  (%lu bins, and %lu rows before and after them that the pulse reaches)\n",
                   (unsigned long)job->profile.list.count,
                   (unsigned long)(job->rows - job->profile.list.count));
        }
    }
    free(sorted);
}

static void summary_print(const profile_job *job)
{
    const lrcs_profile *p = &job->profile.list;
    char bin[LRCS_HOST_BOUND_SIZE];
    char all[LRCS_HOST_BOUND_SIZE];
    double worst = 0.0;
    for (uint32_t i = 0; i < p->count; i++) {
        worst = fmax(worst, p->bin[i].bound_m2);
    }
    lrcs_host_bound_text(total_sigma(job) > 0.0 ? worst / total_sigma(job) : worst, 2, bin);
    lrcs_host_bound_text(total_sigma(job) > 0.0 ? p->bound_m2 / total_sigma(job) : p->bound_m2, 2,
                         all);
    printf("verdict      each bin is proved to %s of sigma or better, their sum to %s.\n", bin,
           all);
    if (worst > 1e-6 * total_sigma(job) && !lrcs_host_scene_tessellated(&job->scene.scene)) {
        printf("             A face within rounding of a bin's edge may be on either side of it\n");
    }
    if (is_curved(job)) {
        lrcs_host_bound_text(
            total_sigma(job) > 0.0 ? p->curvature_estimate_m2 / total_sigma(job) : 0.0, 2, all);
        printf("             Estimated, not proved: the integral over curved normals, to %s of "
               "sigma\n",
               all);
    }
    if (!p->tessellation_known) {
        printf("             Left open: how far curved shapes are from the facets that stand for "
               "them\n");
    }
    if (job->materials_assumed) {
        printf("             Left open: materials, which are illustrative or default ones\n");
    }
}

void cli_profile_table(const profile_job *job)
{
    const lrcs_profile *p = &job->profile.list;
    double s_hat[3];
    char bound[LRCS_HOST_BOUND_SIZE];
    cli_pose_unit(&job->pose, s_hat);
    printf("scene        ");
    cli_scene_print(job->args, &job->scene);
    printf(", hash %016llx\n", (unsigned long long)lrcs_scene_hash(&job->scene.scene));
    printf("direction    %.10g, %.10g, %.10g   to the laser, body frame\n", s_hat[0], s_hat[1],
           s_hat[2]);
    lrcs_host_bound_text(p->bound_m2, 3, bound);
    printf("sigma        %.10g m2, the sum of all bins; bound %s m2", total_sigma(job), bound);
    if (job->asked > 0.0) {
        printf("; tolerance %g %s", job->asked, job->met ? "met" : "NOT met");
    }
    printf("\nrange        m from the body's origin, away from the laser; %lu bin%s of %g m\n",
           (unsigned long)p->count, p->count == 1 ? "" : "s", job->bin_m);
    if (job->fwhm_m > 0.0) {
        printf("pulse        Gaussian, %g m wide at half maximum in range\n", job->fwhm_m);
    }
    bins_print(job);
    if (job->csv) {
        printf("rows         %s\n", job->csv);
    }
    for (int i = 0; i < job->args->given_count; i++) {
        if (strcmp(job->args->given[i].name, "plot") == 0) {
            printf("chart        %s\n", job->args->given[i].value);
        }
    }
    summary_print(job);
}
