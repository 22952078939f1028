/* SPDX-License-Identifier: MIT */
/* Whole sweeps in files: written row by row and continued, read back with their plan, written as
   maps, joined from parts. The lines of a file are those of lrcs/rows.h. */
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

/* ---- a sweep being computed ---- */

/* The destination of rows: standard output; or FILE.partial, which becomes FILE when it is complete
   and is valid after every line before that. */
typedef struct lrcs_host_sweep_output {
    /* given before it is opened, and when rows are put */
    const lrcs_host_plan *plan;
    const lrcs_host_rows_head *head;
    uint64_t first, end; /* the rows of this part: first .. end - 1 */
    double (*row)[2];    /* sigma and bound of every row are stored here; NULL: not wanted */
    double (*band)[2];   /* the interval of its material uncertainty, likewise */
    /* what it has */
    int format;                       /* of the rows, lrcs_host_rows_format */
    int npy;                          /* 1: the rows become a map at the end */
    char *path, *partial, *lock_path; /* NULL: standard output */
    int lock, descriptor;             /* of FILE.lock and FILE.partial; -1: not open */
    FILE *stream;                     /* rows not yet written, in memory */
    char *waiting;                    /* those bytes */
    size_t waiting_size;
    uint64_t size, sum; /* of FILE.partial without its checksum: bytes, and that checksum */
    uint64_t next;      /* the next row to be written */
    double flushed;     /* time of the last write, s */
    lrcs_host_tally tally;
} lrcs_host_sweep_output;

/* Makes an output: path is FILE, or NULL for standard output. Nothing is written yet; the caller
   frees it in any case. Status: LRCS_OK; LRCS_E_SYSTEM (memory). */
int lrcs_host_sweep_output_make(const char *path, int format, int npy,
                                lrcs_host_sweep_output *output, lrcs_host_error *error);

/* Locks the file, by FILE.lock; then begins, or, with `resume`, goes on with the rows that are
   there if they begin with the same head: output->next is the first row that is missing. A second
   process is refused with a sentence that names the holder of the lock. Status: LRCS_OK;
   LRCS_E_SYSTEM (a file, its lock, memory; or rows are there and are not resumed); LRCS_E_LIMIT (a
   file above 16 GiB); LRCS_E_SYNTAX: the rows that are there are damaged, or of another sweep;
   LRCS_E_TRUNCATED: FILE is not complete. */
int lrcs_host_sweep_output_open(lrcs_host_sweep_output *output, int resume, lrcs_host_error *error);

/* Writes row number output->next. Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcs_host_sweep_output_put(lrcs_host_sweep_output *output, const lrcs_host_row *row,
                               lrcs_host_error *error);

/* Ends the output: with `all` rows FILE.partial becomes FILE; with some it is kept, with none it is
   removed. Status: LRCS_OK; LRCS_E_SYSTEM; of a map LRCS_E_SYNTAX (its rows were changed meanwhile)
   and LRCS_E_LIMIT (above 16 GiB). */
int lrcs_host_sweep_output_close(lrcs_host_sweep_output *output, int all, lrcs_host_error *error);
void lrcs_host_sweep_output_free(lrcs_host_sweep_output *output);

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
