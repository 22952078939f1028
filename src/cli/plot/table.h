/* SPDX-License-Identifier: MIT */
/* The CSV files of other commands than sweep that lrcs plot draws again. */
#ifndef LRCS_CLI_PLOT_TABLE_H
#define LRCS_CLI_PLOT_TABLE_H

#include "cli/cli.h"

/* The kind of a file by its first line; TABLE_NONE for any other file. */
enum table_kind { TABLE_NONE, TABLE_PROFILE, TABLE_CONVERGE, TABLE_STATISTICS };

int cli_table_kind(const char *path);

/* Draws a range profile or a comparison of lrcs converge, to every file named by -o. 0, or
   CLI_FAILED with the message printed. */
int cli_table_draw(const cli_args *args, const char *path, int kind);

#endif
