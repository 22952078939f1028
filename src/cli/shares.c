/* SPDX-License-Identifier: MIT */
/* What contributes to sigma (lrcs/shares.h): a table of the largest, and all as JSON. */
#include "cli/shares.h"

#include <math.h>

#define NAME_WIDTH 24 /* of the column of names */

int cli_shares_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                    const lrcs_facet_record *records, double sigma_m2, cli_shares *shares)
{
    lrcs_host_error error;
    int status = lrcs_host_shares_make(base, scene, records, sigma_m2, shares, &error);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

double cli_share_of(const cli_shares *shares, double part_m2)
{
    return shares->sigma_m2 > 0.0 ? part_m2 / shares->sigma_m2 : (double)NAN;
}

double cli_shares_glint(const cli_shares *shares)
{
    double glint = 0.0;
    for (uint32_t i = 0; i < shares->parts; i++) {
        glint += shares->part[i].glint_m2;
    }
    return glint;
}

uint32_t cli_shares_shown(const shares_row *row, uint32_t count)
{
    uint32_t shown = 0;
    while (shown < count && shown < SHARES_ROWS && row[shown].sigma_m2 > 0.0) {
        shown++;
    }
    return shown;
}

uint32_t cli_shares_named(const cli_shares *shares, const shares_row *row, uint32_t count)
{
    double share = 0.0;
    uint32_t named = 0;
    while (named < count && named < 3 && share < 0.95 && row[named].sigma_m2 > 0.0) {
        share += cli_share_of(shares, row[named++].sigma_m2);
    }
    return named;
}

/* ---- the table ---- */

/* Prints a share in percent; "-" if it is not defined. */
static void percent_cell(double share)
{
    if (isfinite(share)) {
        printf(" %7.2f %%", 100.0 * share);
    } else {
        printf(" %9s", "-");
    }
}

static void row_line(const cli_shares *shares, const shares_row *row)
{
    printf(" %12.6g", cli_shown(row->sigma_m2));
    percent_cell(cli_share_of(shares, row->sigma_m2));
    printf(" %12.4g %12.4g\n", cli_shown(row->glint_m2), cli_shown(row->diffuse_m2));
}

static void rows_table(const cli_shares *shares, const char *what, const shares_row *row,
                       uint32_t count)
{
    uint32_t shown = cli_shares_shown(row, count);
    printf("  %-*s %12s %9s %12s %12s\n", NAME_WIDTH, what, "sigma m2", "share", "glint m2",
           "diffuse m2");
    for (uint32_t i = 0; i < shown; i++) {
        printf("  ");
        cli_column(row[i].name[0] ? row[i].name : "(no name)", NAME_WIDTH);
        row_line(shares, &row[i]);
    }
    if (shown < count) {
        char text[32];
        shares_row others = lrcs_host_shares_sum(row, shown, count);
        snprintf(text, sizeof text, "%lu other%s", (unsigned long)(count - shown),
                 count - shown > 1 ? "s" : "");
        printf("  %-*s", NAME_WIDTH, text);
        row_line(shares, &others);
    }
}

void cli_shares_table(const cli_shares *shares)
{
    printf("shares       what contributes to sigma; the largest first\n");
    rows_table(shares, "part", shares->part, shares->parts);
    rows_table(shares, "material", shares->material, shares->materials);
    if (shares->facets > 0) {
        printf("  %-10s %-*s %-20s %9s %12s %12s %9s\n", "facet", NAME_WIDTH, "part", "material",
               "theta deg", "visible m2", "sigma m2", "share");
    }
    for (uint32_t i = 0; i < shares->facets; i++) {
        const shares_facet *facet = &shares->facet[i];
        printf("  %-10lu ", (unsigned long)facet->facet);
        cli_column(facet->part, NAME_WIDTH);
        putchar(' ');
        cli_column(facet->material[0] ? facet->material : "(default)", 20);
        printf(" %9.3f %12.4g %12.6g", facet->theta_deg, facet->visible_area_m2,
               cli_shown(facet->sigma_m2));
        percent_cell(cli_share_of(shares, facet->sigma_m2));
        putchar('\n');
    }
}

/* ---- JSON ---- */

static void rows_json(const cli_shares *shares, const char *key, const shares_row *row,
                      uint32_t count, lrcs_host_json *json)
{
    lrcs_host_json_begin(json, key, LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < count; i++) {
        lrcs_host_json_put(
            json, "{name=%s sigma_m2=%g share=%g sigma_glint_m2=%g sigma_diffuse_m2=%g facets=%u}",
            row[i].name, row[i].sigma_m2, cli_share_of(shares, row[i].sigma_m2), row[i].glint_m2,
            row[i].diffuse_m2, row[i].facets);
    }
    lrcs_host_json_put(json, "]");
}

void cli_shares_json(const cli_shares *shares, lrcs_host_json *json)
{
    lrcs_host_json_put(json, "shares={\n");
    rows_json(shares, "parts", shares->part, shares->parts, json);
    rows_json(shares, "materials", shares->material, shares->materials, json);
    lrcs_host_json_put(json, "facets=[\n");
    for (uint32_t i = 0; i < shares->facets; i++) {
        const shares_facet *facet = &shares->facet[i];
        lrcs_host_json_put(
            json,
            "{facet=%u part=%s material=%s theta_deg=%g visible_area_m2=%g sigma_m2=%g "
            "sigma_glint_m2=%g share=%g}",
            facet->facet, facet->part, facet->material, facet->theta_deg, facet->visible_area_m2,
            facet->sigma_m2, facet->glint_m2, cli_share_of(shares, facet->sigma_m2));
    }
    lrcs_host_json_put(json, "]}");
}
