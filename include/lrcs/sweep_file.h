/* SPDX-License-Identifier: MIT */
/* Whole sweeps in files: read back with their plan, written as maps, joined from parts. The lines
   of a file are those of lrcs/rows.h. */
#ifndef LRCS_SWEEP_FILE_H
#define LRCS_SWEEP_FILE_H

#include <lrcs/rows.h>

/* ---- maps ---- */

/* Callback: returns the rows in order. Returned: 1: a row; 0: the end. Status: any other, with its
   sentence. */
typedef int lrcs_host_sweep_next(void *context, lrcs_host_row *row, lrcs_host_error *error);

/* Writes FILE.npy, a NumPy array of shape (.., 2), sigma and bound, or, if rows->flagged, (.., 3),
   whose third item is 0 if the bound meets the tolerance, 1 if the estimate was accepted, 2 if any
   answer was, -1 if the tolerance is missed. Also writes FILE.npy.head, the first lines of its rows
   with a checksum of the map and the counts of its tally.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT (above 16 GiB); as `next`. */
int lrcs_host_sweep_map_write(const char *path, const lrcs_host_rows *rows,
                              lrcs_host_sweep_next *next, void *context, lrcs_host_error *error);

/* FILE.npy and FILE.npy.head in memory. */
typedef struct lrcs_host_sweep_map {
    lrcs_host_file file, beside;
    lrcs_host_rows rows; /* the first lines */
    lrcs_host_tally tally;
    const unsigned char *value;
    uint32_t numbers; /* of each row, from `value` on */
} lrcs_host_sweep_map;

/* Status: LRCS_OK; LRCS_E_SYNTAX: a file is missing, or the map does not have the checksum in its
   head. The caller closes it in any case. */
int lrcs_host_sweep_map_open(const char *path, lrcs_host_sweep_map *map);
void lrcs_host_sweep_map_row(const lrcs_host_sweep_map *map, uint64_t index, lrcs_host_row *row);
void lrcs_host_sweep_map_close(lrcs_host_sweep_map *map);

/* ---- a sweep read back ---- */

typedef struct lrcs_host_sweep_data {
    lrcs_host_plan plan;
    lrcs_host_rows_head head;
    double (*row)[2];  /* sigma and bound of every row, m2 */
    double (*band)[2]; /* the interval of its material uncertainty, m2; NULL if rows have none */
    lrcs_host_tally tally;
    char *words; /* memory to which the head points */
} lrcs_host_sweep_data;

/* Reads FILE.csv, FILE.jsonl or FILE.npy with its FILE.npy.head: the plan is made again from the
   first lines, and all rows are checked against it.
   Returned: data, to be freed in any case.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT; LRCS_E_SYNTAX, LRCS_E_TRUNCATED (no sweep, or
   damaged); LRCS_E_UNSUPPORTED (a map of a track, whose times it does not hold); LRCS_E_INDEX (a
   part of a sweep); as lrcs_host_plan_make. */
int lrcs_host_sweep_read(const char *path, lrcs_host_sweep_data *data, lrcs_host_error *error);
void lrcs_host_sweep_data_free(lrcs_host_sweep_data *data);

/* ---- parts of a sweep ---- */

/* A file with consecutive rows. */
typedef struct lrcs_host_sweep_part {
    const char *path;
    lrcs_host_file file;
    lrcs_host_rows rows;
    uint64_t first, count;
} lrcs_host_sweep_part;

/* Reads a part and checks its rows; `other`, unless NULL, is another part of the same sweep.
   Returned: part, to be freed in any case. Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT;
   LRCS_E_SYNTAX; LRCS_E_TRUNCATED. */
int lrcs_host_sweep_part_read(const char *path, const lrcs_host_sweep_part *other,
                              lrcs_host_sweep_part *part, lrcs_host_error *error);
void lrcs_host_sweep_part_free(lrcs_host_sweep_part *part);

/* Joins parts, which are sorted by their rows, into the file that one sweep would have written,
   byte for byte: a map, or a text in the format of the parts ("-": standard output); count > 0.
   Status: LRCS_OK; LRCS_E_INDEX: not every row is present exactly once; LRCS_E_SYSTEM;
   LRCS_E_LIMIT (a map above 16 GiB). */
int lrcs_host_sweep_join(lrcs_host_sweep_part *part, uint32_t count, const char *path, int map,
                         lrcs_host_error *error);

#endif
