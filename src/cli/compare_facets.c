/* SPDX-License-Identifier: MIT */
/* Their visible areas, facet by facet, against the truth's: how facets differ, and which ones cost
   most. It explains; the verdict is by sigma alone. */
#include "cli/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FACETS_PI    3.14159265358979323846
#define FACETS_NAMED 8u
#define SEEN         0.02 /* of a facet's projected area: less is a pixel's worth */
#define COSINE_WRONG 1e-3
#define COSINE_FLOAT 1e-9

enum facets_way { SHOWN, LOST, WHOLE, OFF, FACETS_WAYS };

static const char *const way_text[FACETS_WAYS] = {
    "seen by them, hidden in truth (missing shadow)",
    "not seen by them, visible in truth (lost, culled or behind)",
    "seen whole by them, partly hidden in truth (missing shadow)",
    "seen in another part than in truth"};

/* A facet that differs. */
typedef struct facets_off {
    const compare_case *one;
    uint32_t facet;
    double theirs_m2, truth_m2;
    double sigma_m2; /* what it changes */
    int way;
} facets_off;

typedef struct facets_read {
    compare_job *job;
    double **visible; /* by case: their areas, by facet; NULL: not handed in */
    uint32_t ways[FACETS_WAYS];
    uint32_t cosines, turned;
    double cosine_most;             /* |difference| of cosines that are not turned round */
    facets_off worst[FACETS_NAMED]; /* the largest first */
    uint32_t worsts;
} facets_read;

/* ---- reading ---- */

static double *facets_room(facets_read *facets, compare_case *one)
{
    const compare_kit *kit = &facets->job->kit;
    double **visible = &facets->visible[one - kit->list];
    if (!*visible && cli_compare_records(kit, one) == 0) {
        size_t count = kit->scene[one->scene].host.scene.facet_count;
        *visible = calloc(count + 1, sizeof **visible);
        if (!*visible) {
            cli_out_of_memory();
        }
    }
    return *visible;
}

static void cosine_take(facets_read *facets, double theirs, double truth)
{
    double off = fabs(theirs - truth);
    facets->cosines++;
    if (off > COSINE_WRONG && fabs(theirs + truth) < COSINE_WRONG) {
        facets->turned++;
    } else {
        facets->cosine_most = fmax(facets->cosine_most, off);
    }
}

static int facet_line(facets_read *facets, const compare_table *table, const int *column)
{
    double index;
    double area;
    double cosine;
    compare_case *one = cli_compare_find(&facets->job->kit, table, column);
    double *visible = one ? facets_room(facets, one) : NULL;
    if (!visible || cli_table_number(table, column[2], &index) != 0 ||
        cli_table_number(table, column[3], &area) != 0) {
        return CLI_FAILED;
    }
    uint32_t count = facets->job->kit.scene[one->scene].host.scene.facet_count;
    if (!(index >= 0.0 && index < count) || index != floor(index)) {
        return cli_table_refuse(table, column[2], "a facet 0 .. %lu", (unsigned long)count - 1);
    }
    if (column[4] >= 0 && cli_table_number(table, column[4], &cosine) != 0) {
        return CLI_FAILED;
    }
    if (column[4] >= 0) {
        cosine_take(facets, cosine, one->records[(uint32_t)index].cos_theta);
    }
    visible[(uint32_t)index] = area;
    return 0;
}

static int facets_file(facets_read *facets)
{
    static const char *const name[] = {"scene", "attitude", "facet", "visible_area_m2"};
    compare_table table;
    int column[5];
    int more = 1;
    int code = cli_table_open(facets->job->facets, &table);
    for (int i = 0; i < 4 && code == 0; i++) {
        code = cli_table_require(&table, name[i], &column[i]);
    }
    column[4] = cli_table_column(&table, "cos_theta");
    while (code == 0 && (more = cli_table_next(&table)) > 0) {
        code = facet_line(facets, &table, column);
    }
    cli_table_close(&table);
    return more < 0 ? CLI_FAILED : code;
}

/* ---- differing ---- */

/* Keeps the facets that change sigma most. */
static void worst_take(facets_read *facets, const facets_off *off)
{
    uint32_t at = facets->worsts;
    while (at > 0 && facets->worst[at - 1].sigma_m2 < off->sigma_m2) {
        at--;
    }
    if (at < FACETS_NAMED) {
        facets->worsts += facets->worsts < FACETS_NAMED;
        memmove(&facets->worst[at + 1], &facets->worst[at],
                (facets->worsts - at - 1) * sizeof *facets->worst);
        facets->worst[at] = *off;
    }
}

static void facet_compare(facets_read *facets, const compare_case *one, uint32_t facet,
                          double theirs)
{
    const lrcs_scene *scene = &facets->job->kit.scene[one->scene].host.scene;
    const lrcs_facet_record *record = &one->records[facet];
    const lrcs_brdf *brdf = &scene->material[scene->facet_material[facet]].brdf;
    double c = fabs(record->cos_theta);
    double whole = record->area_m2 * c;
    double truth = record->visible_area_m2;
    double least = SEEN * whole;
    facets_off off = {one, facet, theirs, truth, 0.0, OFF};
    off.sigma_m2 = 4.0 * FACETS_PI * lrcs_brdf_eval(brdf, c) * c * fabs(theirs - truth);
    if (!(fabs(theirs - truth) > least)) {
        return;
    }
    off.way = truth <= least            ? SHOWN
              : theirs <= least         ? LOST
              : theirs >= whole - least ? WHOLE
                                        : OFF;
    facets->ways[off.way]++;
    worst_take(facets, &off);
}

/* ---- what is said ---- */

static void cosines_print(const facets_read *facets)
{
    if (facets->cosines == 0) {
        return;
    }
    if (2 * facets->turned > facets->cosines) {
        printf("             cos theta has the other sign: normals point inward, or to the wrong "
               "side\n");
        return;
    }
    printf("             cos theta is off by at most %.1e: %s\n", facets->cosine_most,
           facets->cosine_most > COSINE_WRONG   ? "wrong frame or normals"
           : facets->cosine_most > COSINE_FLOAT ? "single precision"
                                                : "double precision");
}

static void facets_print(const facets_read *facets, uint32_t cases)
{
    printf("facets       of %lu cases\n", (unsigned long)cases);
    for (int way = 0; way < FACETS_WAYS; way++) {
        if (facets->ways[way] > 0) {
            printf("             %lu facets %s\n", (unsigned long)facets->ways[way], way_text[way]);
        }
    }
    cosines_print(facets);
    for (uint32_t i = 0; i < facets->worsts; i++) {
        const facets_off *off = &facets->worst[i];
        const compare_scene *scene = &facets->job->kit.scene[off->one->scene];
        const lrcs_scene *mesh = &scene->host.scene;
        printf("             %s %s, facet %lu (%s%s): %.6g m2, in truth %.6g m2; %.3g m2 of "
               "sigma\n",
               scene->name, off->one->attitude, (unsigned long)off->facet,
               mesh->material[mesh->facet_material[off->facet]].name,
               off->one->records[off->facet].cos_theta < 0.0 ? ", its back" : "", off->theirs_m2,
               off->truth_m2, off->sigma_m2);
    }
}

static void facets_all(facets_read *facets)
{
    const compare_kit *kit = &facets->job->kit;
    uint32_t cases = 0;
    for (uint32_t i = 0; i < kit->cases; i++) {
        const compare_case *one = &kit->list[i];
        uint32_t count = kit->scene[one->scene].host.scene.facet_count;
        cases += facets->visible[i] != NULL;
        for (uint32_t k = 0; facets->visible[i] && k < count; k++) {
            facet_compare(facets, one, k, facets->visible[i][k]);
        }
    }
    facets_print(facets, cases);
}

int cli_compare_facets(compare_job *job)
{
    facets_read facets = {.job = job};
    facets.visible = calloc((size_t)job->kit.cases + 1, sizeof *facets.visible);
    if (!facets.visible) {
        return cli_out_of_memory();
    }
    int code = facets_file(&facets);
    if (code == 0) {
        facets_all(&facets);
    }
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        free(facets.visible[i]);
    }
    free(facets.visible);
    return code;
}
