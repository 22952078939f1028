/* SPDX-License-Identifier: MIT */
/* The verdict for programs: JSON, and JUnit XML for continuous integration. */
#include "cli/compare/compare.h"

#include <math.h>

/* How many facets or images differ, and in which way: those that do. */
static void count_json(lrcs_host_json *json, const char *text, uint32_t count)
{
    if (count > 0) {
        lrcs_host_json_put(json, "{text=%s count=%u}", text, count);
    }
}

static void facets_json(lrcs_host_json *json, const lrcs_host_judgement *job)
{
    const lrcs_host_kit_facets *facets = &job->by_facet;
    lrcs_host_json_put(json, "facets={\ncases=%u differ=[\n", facets->cases);
    for (int kind = 0; kind < LRCS_HOST_FACET_KINDS; kind++) {
        count_json(json, lrcs_host_facet_kind_text(kind), facets->kind_count[kind]);
    }
    lrcs_host_json_put(json, "] cos_theta=%s cos_theta_off=%g worst=[\n",
                       lrcs_host_cosines_text(facets),
                       facets->cosines > 0 ? facets->cosine_error_max : (double)NAN);
    for (uint32_t i = 0; i < facets->worst_count; i++) {
        const lrcs_host_kit_facet *off = &facets->worst[i];
        lrcs_host_json_put(json, "{scene=%s attitude=%s facet=%u way=%s",
                           job->kit.scene[off->kit_case->scene].name, off->kit_case->attitude,
                           off->facet, lrcs_host_facet_kind_text(off->kind));
        lrcs_host_json_put(json, "visible_area_m2=%g theirs_m2=%g sigma_m2=%g}", off->truth_m2,
                           off->answer_m2, off->sigma_m2);
    }
    lrcs_host_json_put(json, "]}");
}

static void items_json(lrcs_host_json *json, const lrcs_host_judgement *job)
{
    const lrcs_host_kit_items *items = &job->by_item;
    lrcs_host_json_put(json, "items={\nasked=%u given=%u differ=%u ways=[\n", items->images,
                       items->images_found, items->images_differ);
    for (int i = 0; i < (int)LRCS_HOST_IMAGE_CONVENTIONS; i++) {
        count_json(json, lrcs_host_image_convention_text(i), items->convention_count[i]);
    }
    lrcs_host_json_put(json, "] worst=[\n");
    for (uint32_t i = 0; i < items->named; i++) {
        const lrcs_host_kit_image *image = &items->image[i];
        lrcs_host_json_put(json, "{scene=%s attitude=%s agree=%g lost=[\n",
                           job->kit.scene[image->kit_case->scene].name, image->kit_case->attitude,
                           image->agree_share);
        for (uint32_t n = 0; n < LRCS_HOST_KIT_TOP && image->lost[n] > 0; n++) {
            lrcs_host_json_put(json, "{facet=%u pixels=%u}", image->facet[n], image->lost[n]);
        }
        lrcs_host_json_put(json, "]}");
    }
    lrcs_host_json_put(json, "]}");
}

void cli_compare_json(FILE *out, const void *context)
{
    const compare_job *asked = context;
    const lrcs_host_judgement *job = &asked->judgement;
    lrcs_host_json json = lrcs_host_json_make(out);
    lrcs_host_json_put(&json, "{\n");
    cli_version_json(&json);
    lrcs_host_json_put(&json, "passed=%d tier=%u class=%s pixels=%u asked=%u given=%u failed=%u",
                       lrcs_host_judge_passed(job), job->tier, lrcs_host_grade_text(job->grade),
                       job->pixels, job->asked, job->given, job->failed);
    lrcs_host_json_put(&json, "not_numbers=%u negatives=%u unexplained=%u findings=[\n",
                       job->not_numbers, job->negatives, job->unexplained);
    for (uint32_t i = 0; i < job->findings; i++) {
        const lrcs_host_finding *finding = &job->finding[i];
        lrcs_host_json_put(&json, "{name=%s text=%s factor=%g explains=%u leaves=%g}",
                           finding->name, finding->text, finding->factor, finding->explained,
                           finding->residual_share);
    }
    lrcs_host_json_put(&json, "]");
    if (asked->facets) {
        facets_json(&json, job);
    }
    if (asked->items) {
        items_json(&json, job);
    }
    lrcs_host_json_put(&json, "cases=[\n");
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (!lrcs_host_judge_asked(job, one)) {
            continue;
        }
        lrcs_host_json_put(&json,
                           "{scene=%s attitude=%s tier=%u sigma_m2=%g theirs_m2=%g allowed_m2=%g",
                           job->kit.scene[one->scene].name, one->attitude, one->tier, one->sigma_m2,
                           one->given ? one->answer_m2 : (double)NAN,
                           lrcs_host_judge_allowed(one, job->grade, job->pixels));
        lrcs_host_json_put(&json, "class=%s passed=%d finding=%s}",
                           lrcs_host_grade_text(one->grade), !lrcs_host_judge_failed(job, one),
                           one->explained ? job->finding[one->explained - 1].name : NULL);
    }
    lrcs_host_json_put(&json, "]}");
}

/* Text inside an attribute. It needs no escapes: names of a kit are letters, digits and '-', and
   the findings are texts of this program. */
static void xml_text(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '<' || *text == '>' || *text == '&' || *text == '"') {
            fprintf(out, "&#%d;", *text);
        } else {
            putc(*text, out);
        }
    }
}

static void tier_junit(FILE *out, const lrcs_host_judgement *job, uint32_t tier)
{
    unsigned long cases;
    unsigned long failed;
    cli_compare_tier(job, tier, &cases, &failed);
    fprintf(out, "<testsuite name=\"tier %lu\" tests=\"%lu\" failures=\"%lu\">\n",
            (unsigned long)tier, cases, failed);
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if ((uint32_t)one->tier != tier) {
            continue;
        }
        fprintf(out, "<testcase classname=\"%s\" name=\"%s\">", job->kit.scene[one->scene].name,
                one->attitude);
        if (lrcs_host_judge_failed(job, one) && one->given) {
            lrcs_host_number_put(out, "<failure message=\"expected ", one->sigma_m2);
            lrcs_host_number_put(out, " m2, found ", one->answer_m2);
            fputs("; ", out);
            xml_text(out, one->explained ? job->finding[one->explained - 1].text : "unexplained");
            fputs("\"/>", out);
        } else if (lrcs_host_judge_failed(job, one)) {
            fputs("<failure message=\"not answered\"/>", out);
        }
        fputs("</testcase>\n", out);
    }
    fputs("</testsuite>\n", out);
}

void cli_compare_junit(FILE *out, const void *context)
{
    const lrcs_host_judgement *job = &((const compare_job *)context)->judgement;
    fprintf(out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"%lu\" "
            "failures=\"%lu\">\n",
            (unsigned long)job->asked + (job->biased ? 1 : 0),
            (unsigned long)job->failed + (job->biased ? 1 : 0));
    for (uint32_t tier = 1; tier <= job->tier; tier++) {
        tier_junit(out, job, tier);
    }
    if (job->biased) { /* a test case that stands for all cases together */
        fputs("<testsuite name=\"all tiers\" tests=\"1\" failures=\"1\">\n"
              "<testcase classname=\"all\" name=\"factor\"><failure message=\"",
              out);
        xml_text(out, job->finding[0].text);
        fputs("\"/></testcase>\n</testsuite>\n", out);
    }
    fputs("</testsuites>\n", out);
}
