/* SPDX-License-Identifier: MIT */
/* The dependence of sigma on materials: --sensitivity, and the material uncertainty if materials
   state errors. It is not part of the bound. */
#include "cli/run/run.h"

#include <math.h>
#include <stdlib.h>

#define DRAWS_MOST 1048576.0 /* as lrcs_uncertainty_options.draws */
#define SEED_MOST  4294967295.0

int cli_run_materials_read(run_job *job)
{
    uint32_t seed = 1;
    job->sampling = lrcs_uncertainty_options_default();
    job->sensitivity_asked = cli_value(job->args, "sensitivity") != NULL;
    int code = cli_whole(job->args, "draws", 0.0, DRAWS_MOST, &job->sampling.draws);
    code = code ? code : cli_whole(job->args, "seed", 0.0, SEED_MOST, &seed);
    job->sampling.seed = seed;
    if (code == 0 && job->sampling.draws == 1) {
        return cli_usage(job->args->command, "--draws: one draw has no deviation");
    }
    return code;
}

int cli_run_materials(run_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    lrcs_host_error error;
    lrcs_result again;
    if (!job->sensitivity_asked && !cli_errors_stated(scene)) {
        return 0;
    }
    int code =
        job->scene.prepared ? 0 : cli_scene_prepare(&job->scene); /* not after a time budget */
    if (code != 0) {
        return code;
    }
    cli_watch_stage("material uncertainty", NULL);
    job->sensitivity = calloc((size_t)scene->material_count + 1, sizeof *job->sensitivity);
    if (!job->sensitivity) {
        return cli_out_of_memory();
    }
    int status = lrcs_host_scene_uncertainty(&job->scene, &job->pose, &job->options, &job->sampling,
                                             &again, job->sensitivity, &job->uncertainty, &error);
    if (status == LRCS_OK && job->sensitivity_asked) {
        cli_watch_stage("derivatives in attitude", NULL);
        status = lrcs_host_scene_attitude_slope(&job->scene, &job->pose, &job->options,
                                                &job->attitude, &error);
    }
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* 1 if a material is assigned to a facet that is not left out. */
static int is_assigned(const lrcs_scene *scene, uint32_t material)
{
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        if (scene->facet_material[f] == material) {
            return !scene->material[material].omitted;
        }
    }
    return 0;
}

/* ---- as JSON ---- */

static void sensitivity_json(const run_job *job, lrcs_host_json *json)
{
    const lrcs_scene *scene = &job->scene.scene;
    lrcs_host_json_put(json, "sensitivity={\nmaterials=[\n");
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_sensitivity *d = &job->sensitivity[i];
        if (is_assigned(scene, i)) {
            lrcs_host_json_put(json, "{name=%s dA_m2_sr=%g dB_m2_sr=%g ds_m2=%g dm_m2=%g}",
                               scene->material[i].name, d->dA, d->dB, d->ds, d->dm);
        }
    }
    lrcs_host_json_put(json, "] attitude={\n");
    for (int i = 0; i < 2; i++) {
        lrcs_host_json_begin(json, i == 0 ? "about_x" : "about_y", LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_put(json, "m2_per_deg=%g bound_m2_per_deg=%g estimate_m2_per_deg=%g}",
                           job->attitude.per_deg_m2[i], job->attitude.bound_m2[i],
                           job->attitude.estimate_m2[i]);
    }
    lrcs_host_json_put(json, "}}");
}

void cli_run_materials_json(const run_job *job, lrcs_host_json *json)
{
    const lrcs_uncertainty *u = &job->uncertainty;
    if (u->stated) {
        double none = (double)NAN;
        lrcs_host_json_put(json, "material_uncertainty={deviation_m2=%g low_m2=%g high_m2=%g by=%s",
                           u->deviation_m2, u->low_m2, u->high_m2,
                           u->sampled ? "sample" : "first_order");
        lrcs_host_json_put(json,
                           "first_order_m2=%g sample_m2=%g sample_mean_m2=%g draws=%u seed=%llu}",
                           u->first_order_m2, u->draws > 0 ? u->sample_m2 : none,
                           u->draws > 0 ? u->sample_mean_m2 : none, u->draws,
                           (unsigned long long)job->sampling.seed);
    } else {
        lrcs_host_json_put(json, "material_uncertainty=null");
    }
    if (job->sensitivity_asked) {
        sensitivity_json(job, json);
    }
}

/* ---- in words ---- */

void cli_run_materials_table(const run_job *job)
{
    static const char axis[2] = {'x', 'y'};
    const lrcs_scene *scene = &job->scene.scene;
    const lrcs_uncertainty *u = &job->uncertainty;
    if (u->stated) {
        printf("materials    +- %.4g m2   %.3g %% of sigma: one standard deviation, %s; not in the "
               "bound\n  68 %%       %.6g .. %.6g m2\n",
               u->deviation_m2, cli_percent(u->deviation_m2, job->result.sigma_m2),
               u->sampled ? "from a sample" : "by first order", u->low_m2, u->high_m2);
        if (u->draws > 0) {
            printf("  sample     %lu draws, seed %lu: +- %.4g m2 about %.6g; first order +- %.4g\n",
                   (unsigned long)u->draws, (unsigned long)job->sampling.seed, u->sample_m2,
                   u->sample_mean_m2, u->first_order_m2);
        }
    }
    if (!job->sensitivity_asked) {
        return;
    }
    printf("derivatives  of sigma, by the numbers of each material and by attitude\n"
           "  %-10s %12s %12s %12s %12s\n",
           "material", "d/dA (m2 sr)", "d/dB (m2 sr)", "d/ds (m2)", "d/dm (m2)");
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_sensitivity *d = &job->sensitivity[i];
        if (is_assigned(scene, i)) {
            printf("  ");
            cli_column(cli_material_name(&scene->material[i]), 10);
            printf(" %12.5g %12.5g %12.5g %12.5g\n", cli_shown(d->dA), cli_shown(d->dB),
                   cli_shown(d->ds), cli_shown(d->dm));
        }
    }
    for (int i = 0; i < 2; i++) {
        printf("  rotation about %c of the observation frame: %.6g m2 per degree; proved to %.2g, "
               "step error\n             some %.2g\n",
               axis[i], job->attitude.per_deg_m2[i], job->attitude.bound_m2[i],
               job->attitude.estimate_m2[i]);
    }
}

void cli_run_materials_verdict(const run_job *job, FILE *out)
{
    const lrcs_uncertainty *u = &job->uncertainty;
    if (u->stated) {
        fprintf(out,
                "  materials  their stated errors leave sigma uncertain by %.3g %% (one standard "
                "deviation)\n",
                cli_percent(u->deviation_m2, job->result.sigma_m2));
    }
}
