/* SPDX-License-Identifier: MIT */
/* What contributes to sigma, as commands show it. */
#ifndef LRCS_CLI_SHARES_H
#define LRCS_CLI_SHARES_H

#include "cli/cli.h"

#include <lrcs/shares.h>

#define SHARES_ROWS 10u /* rows of a table that are shown; the others are summed up */

typedef lrcs_host_share shares_row;
typedef lrcs_host_share_facet shares_facet;
typedef lrcs_host_shares cli_shares;

/* lrcs_host_shares_make; the caller frees the shares in any case (lrcs_host_shares_free). 0, or
   CLI_FAILED with the message printed. */
int cli_shares_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                    const lrcs_facet_record *records, double sigma_m2, cli_shares *shares);

/* A part of sigma as a share of sigma; NAN if sigma is 0. */
double cli_share_of(const cli_shares *shares, double part_m2);

/* The glint of all parts together, m2. */
double cli_shares_glint(const cli_shares *shares);

/* The number of rows of a list that are shown: at most SHARES_ROWS, only those that contribute.
   The number named in one line: at most three, until they make 95 % of sigma. */
uint32_t cli_shares_shown(const shares_row *row, uint32_t count);
uint32_t cli_shares_named(const cli_shares *shares, const shares_row *row, uint32_t count);

/* Prints the shares on stdout as a table, and as the key "shares" of an open object. */
void cli_shares_table(const cli_shares *shares);
void cli_shares_json(const cli_shares *shares, lrcs_host_json *json);

#endif
