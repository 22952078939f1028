/* SPDX-License-Identifier: MIT */
/* The verdict as text: a line for each scene, a line for each tier, and the causes. */
#include "cli/compare/compare.h"

#include <math.h>
#include <string.h>

#define NAMES_MOST 8u /* number of unexplained cases that are named */

/* A line of the table: how many cases of a scene are in each class, and the case with the largest
   difference as a share of what it is allowed, with that difference as a share of sigma. */
static void scene_print(const lrcs_host_judgement *job, const lrcs_host_kit_scene *scene)
{
    uint32_t count[LRCS_HOST_GRADE_MISSING + 1] = {0};
    const compare_case *worst = NULL;
    double most = -1.0;
    for (uint32_t i = scene->first; i < scene->first + scene->count; i++) {
        const compare_case *one = &job->kit.list[i];
        double off = fabs(one->answer_m2 - one->sigma_m2);
        double allowed = lrcs_host_judge_allowed(one, job->grade, job->pixels);
        double share = off == 0.0 ? 0.0 : allowed > 0.0 && isfinite(off) ? off / allowed : HUGE_VAL;
        count[one->grade]++;
        if (one->given && share > most) {
            most = share;
            worst = one;
        }
    }
    printf("%4d  ", scene->tier);
    cli_column(scene->name, 16);
    for (int k = LRCS_HOST_GRADE_EXACT; k <= LRCS_HOST_GRADE_MISSING; k++) {
        if (count[k] > 0) {
            printf(" %6lu", (unsigned long)count[k]);
        } else {
            printf("      .");
        }
    }
    double off = worst ? fabs(worst->answer_m2 - worst->sigma_m2) : 0.0;
    if (worst && (off == 0.0 || (worst->sigma_m2 > 0.0 && isfinite(off)))) {
        printf("   %8.1e  %s", off == 0.0 ? 0.0 : off / worst->sigma_m2, worst->attitude);
    } else if (worst) {
        printf("   %8s  %s", "-", worst->attitude);
    }
    putchar('\n');
}

static const char *plural(uint32_t count)
{
    return count == 1 ? "" : "s";
}

static void findings_print(const lrcs_host_judgement *job)
{
    for (uint32_t i = 0; i < job->findings; i++) {
        const lrcs_host_finding *finding = &job->finding[i];
        uint32_t failed = job->failed - (job->asked - job->given) - job->not_numbers;
        printf("why          %s\n", finding->text);
        if (finding->explained == 0) {
            continue;
        }
        printf("             explains %lu of %lu failing case%s, in tiers",
               (unsigned long)finding->explained, (unsigned long)failed, plural(failed));
        for (int tier = 1; tier <= LRCS_HOST_KIT_TIERS; tier++) {
            int concerned = 0;
            for (uint32_t k = 0; k < job->kit.cases; k++) {
                const compare_case *one = &job->kit.list[k];
                concerned |= one->tier == tier && one->explained == (int)i + 1 &&
                             lrcs_host_judge_failed(job, one);
            }
            if (concerned) {
                printf(" %d", tier);
            }
        }
        if (finding->residual_share < 1.0) {
            printf("; leaves %.2g %% of their differences", 100.0 * finding->residual_share);
        }
        putchar('\n');
    }
}

/* Prints how many cases have a fault, and the first of them: "box nose, box a, ..". */
static void reason_print(const lrcs_host_judgement *job, int reason, uint32_t count,
                         const char *title, const char *what)
{
    uint32_t named = 0;
    if (count == 0) {
        return;
    }
    printf("%-12s %lu %s: ", title, (unsigned long)count, what);
    for (uint32_t i = 0; i < job->kit.cases && named <= NAMES_MOST; i++) {
        const compare_case *one = &job->kit.list[i];
        if (lrcs_host_judge_unexplained(job, one) == reason && named++ < NAMES_MOST) {
            printf("%s%s %s", named > 1 ? ", " : "", job->kit.scene[one->scene].name,
                   one->attitude);
        }
    }
    puts(named > NAMES_MOST ? ", .." : "");
}

static void unexplained_print(const lrcs_host_judgement *job)
{
    uint32_t named = 0;
    if (job->unexplained == 0) {
        return;
    }
    printf("unexplained  %lu failing case%s\n", (unsigned long)job->unexplained,
           plural(job->unexplained));
    for (uint32_t i = 0; i < job->kit.cases && named < NAMES_MOST; i++) {
        const compare_case *one = &job->kit.list[i];
        if (lrcs_host_judge_unexplained(job, one) != LRCS_HOST_UNEXPLAINED_UNKNOWN) {
            continue;
        }
        printf("             %s %s: %.4g m2, truth %.4g", job->kit.scene[one->scene].name,
               one->attitude, one->answer_m2, one->sigma_m2);
        if (one->sigma_m2 > 0.0) {
            printf(" (%.3g of it)", one->answer_m2 / one->sigma_m2);
        }
        printf(", allowed %.2g\n", lrcs_host_judge_allowed(one, job->grade, job->pixels));
        named++;
    }
    if (named < job->unexplained) {
        printf("             and %lu more\n", (unsigned long)(job->unexplained - named));
    }
}

/* ---- facets and images ---- */

static const char *material_of(const lrcs_host_judgement *job, const compare_case *one,
                               uint32_t facet)
{
    const lrcs_scene *scene = &job->kit.scene[one->scene].host.scene;
    return scene->material[scene->facet_material[facet]].name;
}

static void facets_table(const lrcs_host_judgement *job, const lrcs_host_kit_facets *facets)
{
    const char *cosines = lrcs_host_cosines_text(facets);
    printf("facets       of %lu case%s%s\n", (unsigned long)facets->cases, plural(facets->cases),
           facets->worst_count == 0 ? ": none differs by more than it is allowed" : "");
    for (int kind = 0; kind < LRCS_HOST_FACET_KINDS; kind++) {
        if (facets->kind_count[kind] > 0) {
            printf("             %lu facet%s %s\n", (unsigned long)facets->kind_count[kind],
                   plural(facets->kind_count[kind]), lrcs_host_facet_kind_text(kind));
        }
    }
    if (cosines) {
        printf("             cos theta: %s (off by at most %.1e, turned signs aside)\n", cosines,
               facets->cosine_error_max);
    }
    for (uint32_t i = 0; i < facets->worst_count; i++) {
        const lrcs_host_kit_facet *off = &facets->worst[i];
        printf("             %s %s, facet %lu (%s%s): %.6g m2, in truth %.6g m2; %.3g m2 of "
               "sigma\n",
               job->kit.scene[off->kit_case->scene].name, off->kit_case->attitude,
               (unsigned long)off->facet, material_of(job, off->kit_case, off->facet),
               off->kit_case->records[off->facet].cos_theta < 0.0 ? ", its back" : "",
               off->answer_m2, off->truth_m2, off->sigma_m2);
    }
}

static void items_print(const lrcs_host_judgement *job, const lrcs_host_kit_items *items,
                        const char *folder)
{
    printf("items        in %s: %lu of %lu images found; %lu differ\n", folder,
           (unsigned long)items->images_found, (unsigned long)items->images,
           (unsigned long)items->images_differ);
    for (int i = 0; i < (int)LRCS_HOST_IMAGE_CONVENTIONS; i++) {
        if (items->convention_count[i] > 0) {
            printf("             %lu %s\n", (unsigned long)items->convention_count[i],
                   lrcs_host_image_convention_text(i));
        }
    }
    for (uint32_t i = 0; i < items->named; i++) {
        const lrcs_host_kit_image *image = &items->image[i];
        printf("             %s %s: %.1f %% of the pixels agree\n",
               job->kit.scene[image->kit_case->scene].name, image->kit_case->attitude,
               100.0 * image->agree_share);
        for (uint32_t n = 0; n < LRCS_HOST_KIT_TOP && image->lost[n] > 0; n++) {
            printf("             facet %lu (%s): %lu of its pixels show something else\n",
                   (unsigned long)image->facet[n],
                   material_of(job, image->kit_case, image->facet[n]),
                   (unsigned long)image->lost[n]);
        }
    }
}

/* ---- all of it ---- */

void cli_compare_table(const compare_job *asked)
{
    const lrcs_host_judgement *job = &asked->judgement;
    printf("kit          %s: %lu scenes, %lu cases\n", job->kit.folder,
           (unsigned long)job->kit.scenes, (unsigned long)job->kit.cases);
    printf("answers      %s: %lu of %lu cases of tiers 1 .. %lu\n", asked->theirs,
           (unsigned long)job->given, (unsigned long)job->asked, (unsigned long)job->tier);
    printf("asked        class %s or better; a raster of %lu x %lu pixels\n\n",
           lrcs_host_grade_text(job->grade), (unsigned long)job->pixels,
           (unsigned long)job->pixels);
    printf("tier  scene             exact  float raster   fail missing   worst of sigma\n");
    for (uint32_t i = 0; i < job->kit.scenes; i++) {
        if ((uint32_t)job->kit.scene[i].tier <= job->tier) {
            scene_print(job, &job->kit.scene[i]);
        }
    }
    putchar('\n');
    for (uint32_t tier = 1; tier <= job->tier; tier++) {
        unsigned long cases;
        unsigned long failed;
        cli_compare_tier(job, tier, &cases, &failed);
        if (cases > 0 && failed == 0) {
            printf("tier %lu       passed, %lu cases\n", (unsigned long)tier, cases);
        } else if (cases > 0) {
            printf("tier %lu       FAILED, %lu of %lu cases\n", (unsigned long)tier, failed, cases);
        }
    }
    uint32_t missing = job->asked - job->given;
    reason_print(job, LRCS_HOST_UNEXPLAINED_MISSING, missing, "missing",
                 missing == 1 ? "case" : "cases");
    reason_print(job, LRCS_HOST_UNEXPLAINED_NOT_A_NUMBER, job->not_numbers, "why",
                 job->not_numbers == 1 ? "answer is not numbers" : "answers are not numbers");
    reason_print(job, LRCS_HOST_UNEXPLAINED_NEGATIVE, job->negatives, "why",
                 job->negatives == 1 ? "answer is negative" : "answers are negative");
    findings_print(job);
    unexplained_print(job);
    if (asked->facets) {
        facets_table(job, &job->by_facet);
    }
    if (asked->items) {
        items_print(job, &job->by_item, asked->items);
    }
    printf("verdict      %s\n", lrcs_host_judge_passed(job) ? "passed" : "FAILED");
}
