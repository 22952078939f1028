/* SPDX-License-Identifier: MIT */
/* The rows of a sweep as text, CSV or JSON lines: written, and read back with every field checked.
   The first lines state everything that the rows depend on, and nothing that differs between
   machines, threads or parts of a sweep: files that begin alike belong together. The last line is a
   checksum of all bytes before it. */
#ifndef LRCS_ROWS_H
#define LRCS_ROWS_H

#include <lrcs/plan.h>

enum lrcs_host_rows_format { LRCS_HOST_ROWS_CSV, LRCS_HOST_ROWS_JSONL };

/* The version of the keys that the first line of JSON lines states. */
#define LRCS_HOST_ROWS_SCHEMA 1

/* ---- a row ---- */

/* The quantities of a row, in the order of their columns, which precede the flags. Only some sweeps
   have the uncertainty (if materials state errors) and the error of the glint (if curved parts are
   too coarse for it). */
enum lrcs_host_row_field {
    LRCS_HOST_ROW_SIGMA,
    LRCS_HOST_ROW_DBSM, /* NAN if sigma is 0 */
    LRCS_HOST_ROW_BOUND,
    LRCS_HOST_ROW_GLINT,
    LRCS_HOST_ROW_DIFFUSE,
    LRCS_HOST_ROW_DEVIATION, /* of the material uncertainty, m2 */
    LRCS_HOST_ROW_LOW,       /* lower and upper end of its interval, m2 */
    LRCS_HOST_ROW_HIGH,
    LRCS_HOST_ROW_SAMPLED,     /* 1 if they are from a sample, else 0 */
    LRCS_HOST_ROW_GLINT_ERROR, /* estimated error of the glint of coarse facets, m2 */
    LRCS_HOST_ROW_DOMINATED,   /* 1 if the glint of one coarse facet makes most of sigma, else 0 */
    LRCS_HOST_ROW_FIELDS
};

typedef struct lrcs_host_row {
    uint64_t index;
    double value[LRCS_HOST_PLAN_COLUMNS];
    double field[LRCS_HOST_ROW_FIELDS]; /* 0 where the sweep has none */
    uint32_t flags;                     /* lrcs_flag */
} lrcs_host_row;

/* Those that a sweep has. */
typedef struct lrcs_host_row_fields {
    int materials, glint; /* 1 if it has those of this group */
    uint32_t count;
    int kind[LRCS_HOST_ROW_FIELDS];
} lrcs_host_row_fields;

/* ---- the first lines ---- */

#define LRCS_HOST_HEAD_OPTIONS 24

typedef struct lrcs_host_rows_head {
    uint64_t scene_hash, rows;
    uint64_t shape[LRCS_HOST_PLAN_AXES + 1]; /* of a map */
    uint32_t dimensions;
    lrcs_host_row_fields fields;
    struct {
        const char *key;
        char text[1200];
    } option[LRCS_HOST_HEAD_OPTIONS];
    uint32_t options;
} lrcs_host_rows_head;

/* Starts the head of a plan's rows. materials, glint: 1 if the rows have the fields of materials'
   errors, and of coarse glints. */
void lrcs_host_rows_head_make(const lrcs_host_plan *plan, uint64_t scene_hash, int materials,
                              int glint, lrcs_host_rows_head *head);

/* Adds "key=text", for what else the rows depend on; a second text of the same key is appended
   after " and ". Returns 0 if the head is full. */
int lrcs_host_rows_head_add(lrcs_host_rows_head *head, const char *key, const char *text);

/* The text of a key, or NULL. */
const char *lrcs_host_rows_head_text(const lrcs_host_rows_head *head, const char *key);

/* ---- statistics of all rows, as they come ---- */

enum lrcs_host_tally_count {
    LRCS_HOST_TALLY_MISSED,    /* the tolerance is missed */
    LRCS_HOST_TALLY_STARVED,   /* short of memory */
    LRCS_HOST_TALLY_ESTIMATED, /* accepted by estimate */
    LRCS_HOST_TALLY_UNJUDGED,  /* accepted without a condition */
    LRCS_HOST_TALLY_FLAGS,     /* the counts above are those of flags */
    LRCS_HOST_TALLY_DOMINATED = LRCS_HOST_TALLY_FLAGS,
    LRCS_HOST_TALLY_COUNTS
};
typedef struct lrcs_host_tally {
    uint64_t rows, count[LRCS_HOST_TALLY_COUNTS];
    double sigma[2], bound[2]; /* sums over rows, each as the sum of two doubles */
    double mean, square;       /* approximate mean of sigma; sum of squared deviations from it */
} lrcs_host_tally;

/* Adds a row. */
void lrcs_host_tally_add(lrcs_host_tally *tally, const lrcs_host_row *row);

/* The mean of sigma, m²; a bound on its error, from the rows' bounds. */
double lrcs_host_tally_mean(const lrcs_host_tally *tally);
double lrcs_host_tally_bound(const lrcs_host_tally *tally);

/* The standard error of the mean, as if directions were drawn at random; NAN for fewer than two
   rows. */
double lrcs_host_tally_error(const lrcs_host_tally *tally);

/* ---- writing ---- */

/* The first lines. */
void lrcs_host_rows_head_write(FILE *out, int format, const lrcs_host_rows_head *head,
                               const lrcs_host_plan *plan);

/* "; key=text" for each option of a head. */
void lrcs_host_rows_options_write(FILE *out, const lrcs_host_rows_head *head);

void lrcs_host_row_write(FILE *out, int format, const lrcs_host_row_fields *fields,
                         const lrcs_host_plan *plan, const lrcs_host_row *row);

/* The line with the mean, after the rows of a single sphere. */
void lrcs_host_rows_mean_write(FILE *out, int format, const lrcs_host_tally *tally);

/* The last line: the hash (lrcs_host_hash) of all bytes before it. Its length depends on the format
   alone. */
void lrcs_host_rows_sum_write(FILE *out, int format, uint64_t sum);

/* ---- reading ---- */

/* Rows in memory, of which the next one is read. */
typedef struct lrcs_host_rows {
    int format;
    const char *head; /* the first lines */
    size_t head_size;
    const char *line; /* the line of the row that was read */
    size_t line_size;
    const char *at, *end; /* the text that follows */
    uint64_t number;      /* of the line at `at`, from 1 */
    uint64_t rows;        /* of the whole sweep */
    uint64_t shape[LRCS_HOST_PLAN_AXES + 1];
    uint32_t dimensions;
    uint32_t columns; /* number of values of a row */
    lrcs_host_row_fields fields;
    int is_sphere; /* 1: one sphere, whose mean follows the rows */
    int flagged; /* 1 if rows may be accepted without a proof: a map of them contains their flags */
} lrcs_host_rows;

/* Status: LRCS_OK; LRCS_E_SYNTAX: the bytes are not rows of a sweep; LRCS_E_SYSTEM (memory). */
int lrcs_host_rows_open(const char *bytes, size_t size, lrcs_host_rows *rows);

/* Reads the next row. Every field is checked: there are as many as the head names, numbers are
   finite, dBsm is that of sigma, bound >= 0, glint and diffuse add up, flags are known, and with a
   plan (or NULL) the values are those of that row.
   Returned: 1; 0 after the last row, whose line may be truncated.
   Status: LRCS_E_SYNTAX: a complete line is not a valid row; the sentence names the line. */
int lrcs_host_rows_next(lrcs_host_rows *rows, const lrcs_host_plan *plan, lrcs_host_row *row,
                        lrcs_host_error *error);

/* Call after the last row.
   Returned: 1 if nothing follows except the mean of a sphere and a checksum that agrees; 0 if there
   is no checksum, or a truncated one.
   Status: LRCS_E_SYNTAX: it does not agree, or something else follows. */
int lrcs_host_rows_end(lrcs_host_rows *rows, lrcs_host_error *error);

#endif
