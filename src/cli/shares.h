/* SPDX-License-Identifier: MIT */
/* Who makes a sigma: parts, materials, single facets. */
#ifndef LRCS_CLI_SHARES_H
#define LRCS_CLI_SHARES_H

#include "cli/cli.h"

#define SHARES_FACETS 10u /* the brightest */
#define SHARES_ROWS   10u /* of a list for people; the others are summed up */

/* A part or a material. */
typedef struct shares_row {
    char *name;      /* owned; "name #3" for the third object of a model where others share it */
    uint32_t facets; /* that it has */
    double sigma_m2, glint_m2, diffuse_m2;
} shares_row;

typedef struct shares_facet {
    uint32_t facet;
    uint32_t scene_part, scene_material; /* of the scene */
    const char *part, *material;
    double theta_deg; /* between the laser and the side of the facet that it sees */
    double visible_area_m2, sigma_m2, glint_m2;
} shares_facet;

/* Lists have the brightest first. */
typedef struct cli_shares {
    double sigma_m2;             /* of the run */
    shares_row *part, *material; /* those that have facets */
    uint32_t parts, materials;
    shares_facet facet[SHARES_FACETS]; /* that return something */
    uint32_t facets;
} cli_shares;

/* The shares of a run.
   Given: scene and records, of the run, and its sigma; base, which was read and has the names: the
   scene's own, or the one that it was varied from.
   Returned: shares, to be freed in any case. 0 or CLI_FAILED with the message printed. */
int cli_shares_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                    const lrcs_facet_record *records, double sigma_m2, cli_shares *shares);
void cli_shares_free(cli_shares *shares);

/* A part of sigma as a share of all of it; NAN where that is 0. */
double cli_share_of(const cli_shares *shares, double part_m2);

/* How many rows of a list are worth a line: at most SHARES_ROWS, that return something. What the
   others add up to, and how many facets they have. */
uint32_t cli_shares_shown(const shares_row *row, uint32_t count);
shares_row cli_shares_others(const shares_row *row, uint32_t from, uint32_t count);

/* On stdout for people, and as the key "shares" of an open object. */
void cli_shares_table(const cli_shares *shares);
void cli_shares_json(const cli_shares *shares, lrcs_host_json *json);

#endif
