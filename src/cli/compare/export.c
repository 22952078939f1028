/* SPDX-License-Identifier: MIT */
/* The verdict for programs: JSON, and JUnit XML for continuous integration. */
#include "cli/compare/compare.h"

#include <math.h>

static void finding_json(lrcs_host_json *json, const compare_finding *finding)
{
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_text(json, "name", finding->name);
    lrcs_host_json_text(json, "text", finding->text);
    lrcs_host_json_number(json, "factor", finding->factor);
    lrcs_host_json_count(json, "explains", finding->explained);
    lrcs_host_json_number(json, "leaves", finding->rest);
    lrcs_host_json_end(json);
}

static void place_json(lrcs_host_json *json, const compare_job *job, const compare_case *one)
{
    lrcs_host_json_text(json, "scene", job->kit.scene[one->scene].name);
    lrcs_host_json_text(json, "attitude", one->attitude);
}

static void case_json(lrcs_host_json *json, const compare_job *job, const compare_case *one)
{
    int finding = one->explained;
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    place_json(json, job, one);
    lrcs_host_json_count(json, "tier", (uint64_t)one->tier);
    lrcs_host_json_number(json, "sigma_m2", one->sigma_m2);
    lrcs_host_json_number(json, "theirs_m2", one->given ? one->theirs_m2 : (double)NAN);
    lrcs_host_json_number(json, "allowed_m2", cli_compare_allowed(one, job->grade, job->pixels));
    lrcs_host_json_text(json, "class", cli_compare_grade(one->grade));
    lrcs_host_json_bool(json, "passed", !cli_compare_failed(job, one));
    lrcs_host_json_text(json, "finding", finding > 0 ? job->finding[finding - 1].name : NULL);
    lrcs_host_json_end(json);
}

static void facet_json(lrcs_host_json *json, const compare_job *job, const compare_facet *off)
{
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    place_json(json, job, off->one);
    lrcs_host_json_count(json, "facet", off->facet);
    lrcs_host_json_text(json, "way", cli_compare_facet_way(off->way));
    lrcs_host_json_number(json, "visible_area_m2", off->truth_m2);
    lrcs_host_json_number(json, "theirs_m2", off->theirs_m2);
    lrcs_host_json_number(json, "sigma_m2", off->sigma_m2);
    lrcs_host_json_end(json);
}

static void way_json(lrcs_host_json *json, const char *text, uint32_t count)
{
    if (count > 0) {
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "text", text);
        lrcs_host_json_count(json, "count", count);
        lrcs_host_json_end(json);
    }
}

static void facets_json(lrcs_host_json *json, const compare_job *job)
{
    const compare_facets *facets = &job->by_facet;
    lrcs_host_json_begin(json, "facets", LRCS_HOST_OBJECT);
    lrcs_host_json_count(json, "cases", facets->cases);
    lrcs_host_json_begin(json, "differ", LRCS_HOST_ARRAY);
    for (int way = 0; way < FACET_WAYS; way++) {
        way_json(json, cli_compare_facet_way(way), facets->way[way]);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_text(json, "cos_theta", cli_compare_cosines(facets));
    lrcs_host_json_number(json, "cos_theta_off",
                          facets->cosines > 0 ? facets->cosine_most : (double)NAN);
    lrcs_host_json_begin(json, "worst", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < facets->worsts; i++) {
        facet_json(json, job, &facets->worst[i]);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_end(json);
}

static void image_json(lrcs_host_json *json, const compare_job *job, const compare_image *image)
{
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    place_json(json, job, image->one);
    lrcs_host_json_number(json, "agree", image->agree);
    lrcs_host_json_begin(json, "lost", LRCS_HOST_ARRAY);
    for (uint32_t n = 0; n < COMPARE_TOP && image->lost[n] > 0; n++) {
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_count(json, "facet", image->facet[n]);
        lrcs_host_json_count(json, "pixels", image->lost[n]);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_end(json);
}

static void items_json(lrcs_host_json *json, const compare_job *job)
{
    const compare_items *items = &job->by_item;
    lrcs_host_json_begin(json, "items", LRCS_HOST_OBJECT);
    lrcs_host_json_count(json, "asked", items->images);
    lrcs_host_json_count(json, "given", items->handed);
    lrcs_host_json_count(json, "differ", items->differ);
    lrcs_host_json_begin(json, "ways", LRCS_HOST_ARRAY);
    for (size_t way = 0; way < COMPARE_IMAGE_WAYS; way++) {
        way_json(json, cli_compare_image_way(way), items->way[way]);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_begin(json, "worst", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < items->named; i++) {
        image_json(json, job, &items->image[i]);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_end(json);
}

int cli_compare_json(FILE *out, const void *context, lrcs_host_error *error)
{
    const compare_job *job = context;
    lrcs_host_json json = lrcs_host_json_make(out);
    (void)error;
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    cli_version_json(&json);
    lrcs_host_json_bool(&json, "passed", cli_compare_passed(job));
    lrcs_host_json_count(&json, "tier", job->tier);
    lrcs_host_json_text(&json, "class", cli_compare_grade(job->grade));
    lrcs_host_json_count(&json, "pixels", job->pixels);
    lrcs_host_json_count(&json, "asked", job->asked);
    lrcs_host_json_count(&json, "given", job->given);
    lrcs_host_json_count(&json, "failed", job->failed);
    lrcs_host_json_count(&json, "not_numbers", job->not_numbers);
    lrcs_host_json_count(&json, "negatives", job->negatives);
    lrcs_host_json_count(&json, "unexplained", job->unexplained);
    lrcs_host_json_begin(&json, "findings", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < job->findings; i++) {
        finding_json(&json, &job->finding[i]);
    }
    lrcs_host_json_end(&json);
    if (job->facets) {
        facets_json(&json, job);
    }
    if (job->items) {
        items_json(&json, job);
    }
    lrcs_host_json_begin(&json, "cases", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        if (cli_compare_asked(job, &job->kit.list[i])) {
            case_json(&json, job, &job->kit.list[i]);
        }
    }
    lrcs_host_json_end(&json);
    lrcs_host_json_end(&json);
    return LRCS_OK;
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

static void tier_junit(FILE *out, const compare_job *job, int tier)
{
    unsigned long cases = 0;
    unsigned long failed = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        cases += one->tier == tier;
        failed += one->tier == tier && cli_compare_failed(job, one);
    }
    fprintf(out, "<testsuite name=\"tier %d\" tests=\"%lu\" failures=\"%lu\">\n", tier, cases,
            failed);
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (one->tier != tier) {
            continue;
        }
        fprintf(out, "<testcase classname=\"%s\" name=\"%s\">", job->kit.scene[one->scene].name,
                one->attitude);
        if (cli_compare_failed(job, one) && one->given) {
            cli_number_put(out, "<failure message=\"expected ", one->sigma_m2);
            cli_number_put(out, " m2, found ", one->theirs_m2);
            fputs("; ", out);
            xml_text(out, one->explained ? job->finding[one->explained - 1].text : "unexplained");
            fputs("\"/>", out);
        } else if (cli_compare_failed(job, one)) {
            fputs("<failure message=\"not handed in\"/>", out);
        }
        fputs("</testcase>\n", out);
    }
    fputs("</testsuite>\n", out);
}

int cli_compare_junit(FILE *out, const void *context, lrcs_host_error *error)
{
    const compare_job *job = context;
    (void)error;
    fprintf(out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"%lu\" "
            "failures=\"%lu\">\n",
            (unsigned long)job->asked + (job->biased ? 1 : 0),
            (unsigned long)job->failed + (job->biased ? 1 : 0));
    for (uint32_t tier = 1; tier <= job->tier; tier++) {
        tier_junit(out, job, (int)tier);
    }
    if (job->biased) { /* a test case that stands for all cases together */
        fputs("<testsuite name=\"all tiers\" tests=\"1\" failures=\"1\">\n"
              "<testcase classname=\"all\" name=\"factor\"><failure message=\"",
              out);
        xml_text(out, job->finding[0].text);
        fputs("\"/></testcase>\n</testsuite>\n", out);
    }
    fputs("</testsuites>\n", out);
    return LRCS_OK;
}
