/* SPDX-License-Identifier: MIT */
/* The caveats of a run, which its bound does not include: the unit that was assumed, back sides
   that reflect nothing, glints of facets that are too coarse for them, the origin of the materials.
   The verdict, the last lines of a run, states what is proved, and then the caveats. */
#include "cli/run/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what is found ---- */

/* Finds visible backs of materials that are not two-sided, and what they would contribute. */
static void backs_find(const run_job *job, run_caveats *caveats)
{
    const lrcs_scene *scene = &job->scene.scene;
    double more = 0.0;
    for (uint32_t i = 0; job->records && i < scene->facet_count; i++) {
        const lrcs_facet_record *record = &job->records[i];
        const lrcs_material *material = &scene->material[scene->facet_material[i]];
        if (record->cos_theta < 0.0 && !material->two_sided && record->visible_area_m2 > 0.0) {
            double f = lrcs_brdf_eval(&material->brdf, -record->cos_theta);
            more += LRCS_FOUR_PI * f * -record->cos_theta * record->visible_area_m2;
        }
    }
    caveats->back_area_m2 = job->result.back_side_area_m2;
    caveats->back_share = job->result.projected_area_m2 > 0.0
                              ? caveats->back_area_m2 / job->result.projected_area_m2
                              : 0.0;
    int known = job->records || !(job->result.back_side_area_m2 > 0.0);
    caveats->back_sigma_m2 = known ? job->result.sigma_m2 + more : (double)NAN;
}

int cli_run_caveats(run_job *job)
{
    run_caveats *caveats = &job->caveats;
    lrcs_host_glint *list = NULL;
    memset(caveats, 0, sizeof *caveats);
    backs_find(job, caveats);
    lrcs_host_error error;
    int status =
        lrcs_host_glint_coarse(&job->scene, &job->load.build, 0, &list, &caveats->coarse, &error);
    caveats->glint.facet = LRCS_NONE;
    if (job->records) {
        lrcs_host_glint_sum_make(&job->scene.scene, job->records, list, caveats->coarse,
                                 &caveats->glint);
    } else if (caveats->coarse > 0) {
        caveats->glint.glint_m2 = caveats->glint.error_m2 = (double)NAN; /* not known */
    }
    free(list);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* ---- as JSON ---- */

void cli_run_caveats_json(const run_job *job, lrcs_host_json *json)
{
    const run_caveats *caveats = &job->caveats;
    lrcs_host_json_put(json,
                       "back_sides={area_m2=%g share_of_silhouette=%g sigma_two_sided_m2=%g} "
                       "coarse_glint={parts=%u sigma_glint_m2=%g error_estimate_m2=%g",
                       caveats->back_area_m2, caveats->back_share, caveats->back_sigma_m2,
                       caveats->coarse, caveats->glint.glint_m2, caveats->glint.error_m2);
    if (job->records || caveats->coarse == 0) {
        lrcs_host_json_put(json, "one_facet_dominates=%d}",
                           lrcs_host_glint_dominates(&caveats->glint, job->result.sigma_m2));
    } else {
        lrcs_host_json_put(json, "one_facet_dominates=null}"); /* not known */
    }
}

/* ---- in words ---- */

static void unit_caveat(const run_job *job, FILE *out)
{
    for (uint32_t i = 0; i < job->scene.recipe.part_count; i++) {
        const lrcs_recipe_part *part = &job->scene.recipe.part[i];
        if (part->file && !(part->unit_m > 0.0)) {
            fprintf(out, "  unit       metres are assumed: no unit is stated for ");
            cli_column_to(out, part->name, 0);
            putc('\n', out);
            return;
        }
    }
}

static void backs_caveat(const run_job *job, FILE *out)
{
    const run_caveats *caveats = &job->caveats;
    if (!(job->result.notices & LRCS_NOTICE_BACK_SIDES_VISIBLE)) {
        return; /* or not known to be visible */
    }
    fprintf(out, "  back sides %.3g m2, %.3g %% of the silhouette, return nothing",
            caveats->back_area_m2, 100.0 * caveats->back_share);
    if (!isnan(caveats->back_sigma_m2)) {
        fprintf(out, "; if they reflected, sigma would be\n             %.6g m2",
                caveats->back_sigma_m2);
        if (job->result.sigma_m2 > 0.0) {
            fprintf(
                out, " (%+.3g %%)",
                cli_percent(caveats->back_sigma_m2 - job->result.sigma_m2, job->result.sigma_m2));
        }
        fprintf(out, ": --two-sided open, or all");
    }
    putc('\n', out);
}

static void glint_caveat(const run_job *job, FILE *out)
{
    const run_caveats *caveats = &job->caveats;
    if (caveats->coarse > 0 && !job->records) {
        fprintf(out,
                "  glint      %lu curved part%s too coarse for the slope of their material: "
                "--normals auto\n",
                (unsigned long)caveats->coarse, caveats->coarse == 1 ? " is" : "s are");
        return;
    }
    if (caveats->coarse == 0 || !(caveats->glint.error_m2 > job->result.bound_m2)) {
        return;
    }
    fprintf(out,
            "  glint      %.3g %% of sigma from facets too coarse for it: flat or curved differ by "
            "some "
            "%.2g %%\n             (an estimate): --normals auto\n",
            cli_percent(caveats->glint.glint_m2, job->result.sigma_m2),
            cli_percent(caveats->glint.error_m2, job->result.sigma_m2));
    if (lrcs_host_glint_dominates(&caveats->glint, job->result.sigma_m2)) {
        fprintf(out,
                "             facet %lu and what lies in its plane make %.3g %% of sigma: its "
                "normal is "
                "the mesh's,\n             not the surface's\n",
                (unsigned long)caveats->glint.facet,
                cli_percent(caveats->glint.most_m2, job->result.sigma_m2));
    }
}

static void materials_caveat(const run_job *job, FILE *out)
{
    static const char *const source[] = {"illustrative", "published", "default", "assumed",
                                         "given"};
    static const char *const words[] = {"illustrative, of the library: not measured",
                                        "published reflectance; Lambert's law assumed",
                                        "none bound, A=1, B=0.25, s=0.2, m=0.5 taken",
                                        "GUESSED: assumed, as the scene file says", "as given"};
    const lrcs_scene *scene = &job->scene.scene;
    uint32_t facets[5] = {0, 0, 0, 0, 0};
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const lrcs_material *material = &scene->material[scene->facet_material[i]];
        const char *found =
            cli_material_guessed(material) ? "assumed" : cli_material_source(material);
        for (int k = 0; k < 5 && !material->omitted; k++) {
            facets[k] += strcmp(found, source[k]) == 0;
        }
    }
    for (int k = 0; k < 5; k++) {
        if (facets[k] > 0) {
            fprintf(out, "  %-10s %lu facets: %s\n", "materials", (unsigned long)facets[k],
                    words[k]);
        }
    }
}

void cli_run_verdict(const run_job *job, FILE *out)
{
    const lrcs_result *r = &job->result;
    char bound[LRCS_HOST_BOUND_SIZE];
    if (r->budget.tessellation_m2 < 0.0) {
        fprintf(
            out,
            "verdict      shadows are proved, but not how far curved shapes are from their facets");
    } else if (r->sigma_m2 > 0.0) {
        lrcs_host_bound_text(r->bound_m2 / r->sigma_m2, 2, bound);
        fprintf(out, "verdict      %sgeometry and shadows are proved to %s of sigma%s",
                r->bound_m2 > r->sigma_m2 ? "NOT USABLE as a proved answer: " : "", bound,
                r->bound_m2 > r->sigma_m2         ? ", a bound that exceeds it"
                : r->bound_m2 > 0.1 * r->sigma_m2 ? ": coarse"
                                                  : "");
    } else {
        lrcs_host_bound_text(r->bound_m2, 2, bound);
        fprintf(out, "verdict      geometry and shadows are proved: sigma is at most %s m2", bound);
    }
    if (r->estimate_m2 >= 0.0 && r->bound_m2 > 0.1 * r->sigma_m2) {
        fprintf(out, "; likely error\n             %.2g m2, an estimate", r->estimate_m2);
    }
    fprintf(out, ".\n             Left open by the model:\n");
    unit_caveat(job, out);
    backs_caveat(job, out);
    glint_caveat(job, out);
    materials_caveat(job, out);
    cli_run_materials_verdict(job, out);
}
