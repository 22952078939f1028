/* SPDX-License-Identifier: MIT */
/* Contributions to sigma: of parts, of materials, of single facets. */
#ifndef LRCS_CLI_SHARES_H
#define LRCS_CLI_SHARES_H

#include "cli/cli.h"

#define SHARES_FACETS 10u /* the brightest facets that are kept */
#define SHARES_ROWS   10u /* rows of a table that are shown; the others are summed up */

/* A part or a material. */
typedef struct shares_row {
    char *name;      /* owned; "name #3" for the third of several objects that share a name */
    uint32_t facets; /* number of facets */
    double sigma_m2, glint_m2, diffuse_m2;
} shares_row;

typedef struct shares_facet {
    uint32_t facet;
    uint32_t scene_part, scene_material; /* indices in the scene */
    const char *part, *material;
    double theta_deg; /* between the laser and the normal of the visible side */
    double visible_area_m2, sigma_m2, glint_m2;
} shares_facet;

/* Each list is sorted, the brightest first. */
typedef struct cli_shares {
    double sigma_m2;             /* sigma of the run */
    shares_row *part, *material; /* only those that have facets */
    uint32_t parts, materials;
    shares_facet facet[SHARES_FACETS]; /* only facets that contribute */
    uint32_t facets;
} cli_shares;

/* The shares of a run.
   Given: scene and records of the run, and its sigma; base, which was read and has the names: the
   scene itself, or the one that it was varied from.
   Returned: shares, which the caller frees in any case. 0 or CLI_FAILED with the message printed.
 */
int cli_shares_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                    const lrcs_facet_record *records, double sigma_m2, cli_shares *shares);
void cli_shares_free(cli_shares *shares);

/* A part of sigma as a share of sigma; NAN if sigma is 0. */
double cli_share_of(const cli_shares *shares, double part_m2);

/* The number of rows of a list that are shown: at most SHARES_ROWS, only those that contribute.
   Also the sum of the others, and how many facets they have. */
uint32_t cli_shares_shown(const shares_row *row, uint32_t count);
shares_row cli_shares_others(const shares_row *row, uint32_t from, uint32_t count);

/* Prints the shares on stdout as a table, and as the key "shares" of an open object. */
void cli_shares_table(const cli_shares *shares);
void cli_shares_json(const cli_shares *shares, lrcs_host_json *json);

#endif
