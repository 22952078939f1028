/* SPDX-License-Identifier: MIT */
/* Readings of BRDFs from tables of text, to be fitted (lrcs/fit.h). */
#ifndef LRCS_READINGS_H
#define LRCS_READINGS_H

#include <lrcs/file.h>
#include <lrcs/fit.h>

typedef struct lrcs_host_reading {
    lrcs_fit_reading fit; /* sigma is 0 if the file has none */
    uint32_t material;    /* an index of lrcs_host_readings' names */
    uint32_t line;        /* in the file, from 1 */
} lrcs_host_reading;

/* Readings from a table of text, several materials in one file allowed. */
typedef struct lrcs_host_readings {
    lrcs_host_reading *reading; /* in the file's order */
    uint32_t count;
    char **name; /* in the order of their first reading; one "" where the file names none */
    uint32_t name_count;
    int noise; /* LRCS_FIT_GIVEN: the file has sigmas; _WEIGHTED: it has weights, and sigma is
                  weight^(-1/2); else LRCS_FIT_ABSOLUTE */
    lrcs_host_notices notices; /* unused columns, skipped lines */
} lrcs_host_readings;

/* Reads a table (lrcs/table.h) with one line per reading. If the first field of the first line is
   not a number, that line names the columns, in any order: angle or theta (deg); brdf, reading or
   value; optionally sigma (or error, std), weight (proportional to 1/sigma^2; a line with 0 is
   skipped), material (or sample); other columns are not used. Without such a line the columns are
   angle, brdf and, if there is a third, sigma. A line whose value is empty, "nan" or "NA" is
   skipped. Status: LRCS_OK;
   LRCS_E_SYSTEM; LRCS_E_SYNTAX, _NUMBER, _NAME, _EMPTY, _LIMIT: the sentence names the line, what
   was found there and what was expected. On failure there is nothing to free. */
int lrcs_host_readings_read(const char *path, lrcs_host_readings *readings, lrcs_host_error *error);
void lrcs_host_readings_free(lrcs_host_readings *readings);

#endif
