/* SPDX-License-Identifier: MIT */
/* Shared by the files of a sweep: its plan, its rows and its files. */
#ifndef LRCS_CLI_SWEEP_H
#define LRCS_CLI_SWEEP_H

#include "cli/shares.h"

#include <lrcs/sweep.h>

#define SWEEP_AXES    8
#define SWEEP_OPTIONS 24 /* that the head of a file may hold */
#define SWEEP_JOINTS  8  /* joints whose angles a file of poses states */
#define SWEEP_COLUMNS 20

/* ---- ranges ---- */

/* A, A + STEP, .. as integer multiples of a power of ten: value i is the double nearest to the
   decimal number, so that no error accumulates. */
typedef struct sweep_range {
    int64_t first, step; /* (first + i step) / 10^decimals */
    uint64_t count;
    int decimals;
} sweep_range;

/* Reads "A:B:STEP", including B if a step reaches it, or "A" alone. Returns NULL, or what is wrong
   with it. */
const char *cli_range_read(const char *text, size_t size, sweep_range *range);
double cli_range_at(const sweep_range *range, uint64_t i);

/* ---- tracks ---- */

/* Attitudes from a CSV file, and the angles of joints at each of them. */
typedef struct sweep_track {
    double (*row)[5]; /* time, s; direction x, y, z, or quaternion w, x, y, z */
    uint64_t count;
    int quaternions;
    uint64_t hash;  /* of the file's bytes */
    char epoch[40]; /* the date, ISO 8601, from which times are counted; "" if times are as given */
    uint32_t joints;
    char joint_name[SWEEP_JOINTS][112]; /* their columns: "joint:PART" */
    double (*joint)[SWEEP_JOINTS];      /* of each row, deg; NULL without joints */
} sweep_track;
#define SWEEP_JOINT "joint:"

/* 0, CLI_FAILED or CLI_USAGE with the message printed. */
int cli_track_read(const char *path, sweep_track *track);

/* ---- the quantities of a row ---- */

/* In the order of their columns, which precede the flags. Only some sweeps have the uncertainty (if
   materials state errors) and the error of the glint (if curved parts are too coarse for it). */
enum sweep_field {
    FIELD_SIGMA,
    FIELD_DBSM, /* NAN if sigma is 0 */
    FIELD_BOUND,
    FIELD_GLINT,
    FIELD_DIFFUSE,
    FIELD_DEVIATION, /* of the material uncertainty, m2 */
    FIELD_LOW,       /* lower and upper end of its interval, m2 */
    FIELD_HIGH,
    FIELD_SAMPLED,     /* 1 if they are from a sample, else 0 */
    FIELD_GLINT_ERROR, /* estimated error of the glint of coarse facets, m2 */
    FIELD_DOMINATED,   /* 1 if the glint of one coarse facet makes most of sigma, else 0 */
    SWEEP_FIELDS
};
extern const char *const cli_field_name[SWEEP_FIELDS];

/* Those that a sweep has. */
typedef struct sweep_fields {
    int materials, glint; /* 1 if it has those of this group */
    uint32_t count;
    int kind[SWEEP_FIELDS];
} sweep_fields;

sweep_fields cli_fields_make(int materials, int glint);

/* The keys in the first lines which state that rows have them. */
#define SWEEP_UNCERTAINTY  "uncertainty"
#define SWEEP_COARSE_GLINT "coarse_glint"

/* ---- the plan: which rows there are ---- */

enum sweep_kind {
    SWEEP_FIXED, /* one pose: only the scene varies */
    SWEEP_AZEL,
    SWEEP_EULER,
    SWEEP_ROTATE,
    SWEEP_SPHERE,
    SWEEP_TRACK
};

/* A quantity that varies. The last axis varies fastest; axes that change the scene come before
   those that change the pose. */
typedef struct sweep_axis {
    const char *option; /* "az", ... */
    char name[128];     /* name of its column */
    sweep_range range;
    char whom[100]; /* of an axis of the scene: part or material */
    int key;        /* the parameter */
} sweep_axis;

typedef struct sweep_plan {
    sweep_axis axis[SWEEP_AXES];
    uint32_t axes, scene_axes; /* scene_axes: without the joints of a track */
    int kind;
    lrcs_pose base;
    char sequence[4];    /* SWEEP_EULER */
    double about[3];     /* SWEEP_ROTATE */
    sweep_track track;   /* SWEEP_TRACK */
    uint64_t poses;      /* number of poses of each scene */
    uint64_t rows;       /* number of rows of all scenes */
    uint64_t first, end; /* the rows of this shard */
    sweep_fields fields;
    uint32_t columns; /* number of values of a row */
    const char *column[SWEEP_COLUMNS];
} sweep_plan;

/* The plan that options specify. With `track` (or NULL) the plan takes its poses, and owns them,
   instead of those that options specify. 0, CLI_FAILED or CLI_USAGE with the message printed. The
   caller frees the plan in any case. */
int cli_plan_read(const cli_args *args, const sweep_track *track, sweep_plan *plan);
void cli_plan_free(sweep_plan *plan);

/* The values of a row, and its pose. */
void cli_plan_values(const sweep_plan *plan, uint64_t row, double value[SWEEP_COLUMNS]);
int cli_plan_pose(const sweep_plan *plan, uint64_t row, lrcs_pose *pose);

/* ---- what changes the scene ---- */

/* Reads --joint and --vary; call before the axes of the pose are added. 0 or CLI_USAGE. */
int cli_scene_axes_read(const cli_args *args, sweep_plan *plan);

/* Checks that parts, materials and values fit the scene. 0 or CLI_USAGE. */
int cli_scene_axes_check(const cli_args *args, const sweep_plan *plan, const lrcs_host_scene *base);

/* The prepared scene of a row, made from the one that was read, which must outlive it; may be
   called in any thread. Status: as lrcs_host_scene_vary and lrcs_host_scene_prepare. */
int cli_scene_of_row(const sweep_plan *plan, uint64_t row, const lrcs_host_scene *base,
                     const lrcs_build_options *build, lrcs_host_scene *scene,
                     lrcs_host_error *error);

/* Adds an axis; the text need not be NUL-terminated. 0 or CLI_USAGE. */
int cli_axis_add(const cli_args *args, sweep_plan *plan, const char *option, const char *name,
                 const char *text, size_t size);

/* 1 if the mean of all rows is meaningful: one --sphere of one scene. */
int cli_plan_has_mean(const sweep_plan *plan);

/* Position of a row along an axis. */
uint64_t cli_plan_place(const sweep_plan *plan, uint64_t row, uint32_t axis);

/* ---- rows ---- */

enum sweep_format { SWEEP_CSV, SWEEP_JSONL, SWEEP_NPY };

typedef struct sweep_row {
    uint64_t index;
    double value[SWEEP_COLUMNS];
    double field[SWEEP_FIELDS]; /* 0 where the sweep has none */
    uint32_t flags;
} sweep_row;

/* The content of the first line: nothing in it depends on the machine, the number of threads or the
   shard. */
typedef struct sweep_head {
    uint64_t scene_hash, rows;
    uint64_t shape[SWEEP_AXES + 1]; /* of a map */
    uint32_t dimensions;
    struct {
        const char *key;
        char text[1200];
    } option[SWEEP_OPTIONS];
    uint32_t options;
} sweep_head;

/* Writes "; key=text" for each option; the text of a key, or NULL. */
void cli_head_put(FILE *out, const sweep_head *head);
const char *cli_head_text(const sweep_head *head, const char *key);

/* 0 or CLI_USAGE. */
int cli_head_make(const cli_args *args, const sweep_plan *plan, const lrcs_run_options *options,
                  const lrcs_host_scene *scene, sweep_head *head);

/* Statistics of all rows. The first counts are those of a map's head. */
enum tally_count {
    TALLY_MISSED,    /* the tolerance is missed */
    TALLY_STARVED,   /* short of memory */
    TALLY_ESTIMATED, /* accepted by estimate */
    TALLY_UNJUDGED,  /* accepted without a condition */
    TALLY_FLAGS,
    TALLY_DOMINATED = TALLY_FLAGS, /* most of sigma is the glint of one coarse facet */
    TALLY_COUNTS
};
typedef struct sweep_tally {
    uint64_t rows, count[TALLY_COUNTS];
    double mean, square, bound; /* mean of sigma; sum of squared deviations; sum of bounds */
} sweep_tally;

void cli_tally_add(sweep_tally *tally, const sweep_row *row);
/* The standard error of sigma, as if directions were drawn at random. */
double cli_tally_error(const sweep_tally *tally);

/* The first lines, one row, and for --sphere a line after the rows. */
void cli_rows_head(FILE *out, int format, const sweep_head *head, const sweep_plan *plan);
void cli_rows_put(FILE *out, int format, const sweep_plan *plan, const sweep_row *row);
void cli_rows_mean(FILE *out, int format, const sweep_tally *tally);

/* The last line: FNV-1a of all bytes before it (cli_sum_more); it always has the same length in a
   format. */
void cli_rows_sum(FILE *out, int format, uint64_t sum);

/* ---- rows that were written ---- */

/* A file of rows in memory. */
typedef struct sweep_text {
    int format;       /* SWEEP_CSV or SWEEP_JSONL, by its first byte */
    const char *head; /* its first lines */
    size_t head_size;
    const char *at, *end; /* the text that follows */
    uint64_t line;        /* number of the line at `at`, from 1 */
    uint64_t rows;        /* number of rows of the whole sweep */
    uint64_t shape[SWEEP_AXES + 1];
    uint32_t dimensions;
    uint32_t columns; /* number of values of a row */
    sweep_fields fields;
    int has_mean; /* one --sphere */
    int flagged; /* 1 if rows may be accepted without a proof: a map of them contains their flags */
    char fault[200]; /* what is wrong with the line at `at` */
} sweep_text;

/* Returns 0, or -1 if the bytes are not rows of a sweep. */
int cli_text_open(const char *bytes, size_t size, sweep_text *text);

/* Reads the next row; line and line_size give its place. Every field is checked: there are as many
   as the head names, numbers are finite, dBsm is that of sigma, bound >= 0, glint and diffuse add
   up, flags are known, and with a plan (or NULL) the values are those of that row. Returns 1; 0
   after the last row, whose line may be truncated; -1 if a complete line is not a valid row:
   text->fault states why. */
int cli_text_next(sweep_text *text, const sweep_plan *plan, sweep_row *row, const char **line,
                  size_t *line_size);

/* Call after the last row: 1 if nothing follows except the mean of a sphere and a checksum that
   agrees; 0 if there is no checksum, or a truncated one; -1, with text->fault, if it does not agree
   or something else follows. */
int cli_text_end(sweep_text *text);

/* Reads all consecutive rows of a text up to the checksum; `path` is for messages; the plan may be
   NULL, and so may `take`, which is called for each row. Returns the first row and the number of
   rows. 0, or CLI_FAILED with the message printed. */
typedef void sweep_take(void *context, const sweep_row *row);
int cli_text_rows(const char *path, const sweep_text *text, const sweep_plan *plan,
                  sweep_take *take, void *context, uint64_t *first, uint64_t *rows);

/* ---- maps ---- */

/* Writes FILE.npy, a NumPy array of shape (.., 2), sigma and bound, or, if text->flagged, (.., 3),
   whose third item is 0 if the bound meets the tolerance, 1 if the estimate was accepted, 2 if any
   answer was, -1 if the tolerance is missed. Also writes FILE.npy.head, the first lines of its rows
   with a checksum of the map. `next` returns the rows in order (1: a row; 0: the end; else it has
   failed and printed a message). 0 or CLI_FAILED. */
typedef int sweep_next(void *context, sweep_row *row);
int cli_map_write(const char *path, const sweep_text *text, sweep_next *next, void *context);

/* FILE.npy and FILE.npy.head in memory: the first lines, the statistics of all rows, and the start
   of the numbers of the rows, `numbers` for each row. */
typedef struct sweep_map {
    lrcs_host_file file, beside;
    sweep_text text;
    sweep_tally tally;
    const unsigned char *value;
    uint32_t numbers;
} sweep_map;

/* Returns 0; -1 if a file is missing, or the map does not have the checksum in its head. The caller
   closes it in any case. */
int cli_map_open(const char *path, sweep_map *map);
void cli_map_row(const sweep_map *map, uint64_t index, sweep_row *row);
void cli_map_close(sweep_map *map);

/* ---- files ---- */

/* The destination of rows: standard output, or FILE.partial, which becomes FILE when it is complete
   and is valid after every line before that. */
typedef struct sweep_file {
    int format;                       /* of the rows: SWEEP_CSV or SWEEP_JSONL */
    int npy;                          /* 1 if the rows become a map at the end */
    char *path, *partial, *lock_path; /* NULL: standard output */
    int lock;                         /* descriptor of FILE.lock; 0 if not locked */
    int descriptor;                   /* descriptor of FILE.partial; 0 if not open */
    FILE *stream;                     /* rows not yet written, in memory */
    char *waiting;                    /* those bytes */
    size_t waiting_size;
    uint64_t size, sum; /* number of bytes in FILE.partial before its checksum, and that checksum */
    uint64_t next;      /* the next row to be written */
    sweep_tally tally;
    double flushed;    /* time of the last write, s */
    double (*row)[2];  /* sigma and bound of every row, or NULL; freed by its creator */
    double (*band)[2]; /* the interval of its material uncertainty, likewise */
} sweep_file;

/* Reads -o and --json; 0 or CLI_USAGE. */
int cli_file_read(const cli_args *args, sweep_file *file);

/* Locks the file; then begins, or continues if --resume finds rows with the same head. A second
   process is refused with a message that names the holder of the lock. 0 or CLI_FAILED. */
int cli_file_open(const cli_args *args, sweep_file *file, const sweep_head *head,
                  const sweep_plan *plan);

/* Writes one row. Status: LRCS_OK; LRCS_E_SYSTEM if it could not be written. */
int cli_file_put(sweep_file *file, const sweep_plan *plan, const sweep_row *row,
                 lrcs_host_error *error);

/* Ends the output: with all rows FILE.partial becomes FILE; with some it is kept, with none it is
   removed. 0 or CLI_FAILED. */
int cli_file_close(sweep_file *file, const sweep_plan *plan, int all);
void cli_file_free(sweep_file *file);

/* Adds a row that is in the file, now or from before, to the statistics. */
void cli_file_take(sweep_file *file, const sweep_row *row);

/* Adds the rows of FILE.npy if FILE.npy.head begins with one of these heads and has the map's
   checksum. 0, or -1 with nothing added. */
int cli_map_recover(sweep_file *file, const sweep_plan *plan, const char *const head[2],
                    const size_t head_size[2]);

/* ---- a sweep read back ---- */

/* A whole sweep from its file: plan, first lines, sigma and bound of every row. */
typedef struct sweep_data {
    const char *path;
    sweep_plan plan;
    sweep_head head; /* its options; the text holds the hash and the number of rows */
    double (*row)[2];
    double (*band)[2]; /* as in sweep_plot */
    sweep_tally tally;
    sweep_text text;
    /* memory to which the members above point */
    lrcs_host_file file;
    sweep_map map;
    char *words;
    const char *column[SWEEP_COLUMNS];
    char scene_text[SWEEP_COLUMNS][320];
    cli_given given[SWEEP_COLUMNS + 16];
    cli_args args;
} sweep_data;

/* 0, or CLI_FAILED or CLI_USAGE with the message printed. The caller frees it in any case. */
int cli_data_read(const char *path, const cli_command *command, sweep_data *data);
void cli_data_free(sweep_data *data);

/* ---- plots ---- */

/* One of the quantities that vary. */
typedef struct plot_axis {
    uint32_t column; /* column of the plan; the one after its axes is the time of a track */
    uint64_t count;
    const char *name;
} plot_axis;

/* What is drawn of a sweep: curves along x, one for each value of y, or a map. */
typedef struct sweep_plot {
    const char *option; /* the option that names the files: "plot", "o" */
    int asked, dbsm, polar, map, mollweide;
    int open; /* 1 if materials are illustrative or assumed: no bound includes their error */
    const char *accept;     /* as --accept, or NULL */
    const char *title;      /* the scene's, or the name of its file */
    const sweep_head *head; /* what it was made from; NULL: not stated */
    const char *name;       /* in the legend, of all curves, or NULL */
    plot_axis x, y;         /* y: a single value if only one quantity varies */
    int swapped;            /* 1 if x is the faster of two axes */
    const sweep_plan *plan;
    double (*row)[2];  /* sigma and bound, m2 */
    double (*band)[2]; /* the interval of its material uncertainty, m2; NULL if none */
} sweep_plot;

#define PLOT_CURVES 7u /* more values than this along both axes make a map */

/* Reads --plot (or -o of lrcs plot), --dbsm, --polar and --projection, and checks that no plot
   replaces a file; 0 or CLI_USAGE. Then draws one sweep, or the curves of several along the same
   axis; 0 or CLI_FAILED. Also one drawing as SVG. The caller sets title and row. */
int cli_plot_read(const cli_args *args, const sweep_plan *plan, sweep_plot *plot);
int cli_plot_write(const cli_args *args, const sweep_plot *plot, uint32_t count);
int cli_plot_svg(FILE *out, const sweep_plot *plot);

/* The material uncertainty of a sweep that has bands: the median and the largest half width of its
   band relative to sigma, over the rows with sigma > 0 (0 if there is none). 0 or CLI_FAILED. */
int cli_plot_uncertainty(const sweep_plot *plot, double part[2]);

/* ---- peaks ---- */

/* Finds the brightest rows that are brighter than all their neighbours, at most `most` of them, the
   brightest first, from sigma and bound of every row. Returns their number; rows with sigma = 0 are
   not counted. */
uint32_t cli_peaks_find(const sweep_plan *plan, const double (*row)[2], uint32_t most,
                        uint64_t *peak);

/* The contributions to sigma of a row, which is run once more. `base` was read, and is prepared if
   necessary; the caller frees the shares in any case. 0 or CLI_FAILED. */
int cli_row_shares(const sweep_plan *plan, uint64_t row, lrcs_host_scene *base,
                   const lrcs_run_options *options, const lrcs_build_options *build,
                   cli_shares *shares);

/* --brightest: reads the number of peaks, 0 if it was not given; 0 or CLI_USAGE. Then prints their
   table on stdout; 0 or CLI_FAILED. Peaks that are the normal of a facet of a coarse curved part
   are marked: flat facets glint there although the curved body need not. */
int cli_brightest_read(const cli_args *args, const sweep_plan *plan, const sweep_file *file,
                       uint32_t *most);
int cli_brightest_print(const sweep_plan *plan, const double (*row)[2], uint32_t most,
                        lrcs_host_scene *base, const lrcs_run_options *options,
                        const lrcs_build_options *build, const lrcs_host_glint *coarse,
                        uint32_t coarse_count);

/* ---- statistics ---- */

#define STATS_PERCENTS 9
#define STATS_BINS     30

/* A row and its weight. */
typedef struct stats_row {
    double sigma, bound, weight;
    double low, high; /* 68 % by the errors of materials; NAN if none are given */
    uint64_t index;
} stats_row;

/* A number with the interval that contains it for every sigma within the bounds of the rows, and
   the band of its material uncertainty (NAN if no material has an error): that of stats.c. The
   same names stand for the rows that it is taken from: sigma, sigma at one end of its bound, or at
   one end of its material band. */
enum stats_end { END_LEAST, END_VALUE, END_MOST, END_LOW, END_HIGH, STATS_ENDS };
typedef struct stats_value {
    double at[STATS_ENDS];
} stats_value;

/* The distribution of sigma over the rows. Shares are of the weight of all rows. */
typedef struct sweep_stats {
    const sweep_plan *plan;
    const sweep_head *head;
    uint64_t rows;
    stats_row *row;      /* sorted by ascending sigma */
    double whole;        /* the weight of all rows */
    const char *weights; /* how rows are weighted, in words */
    int banded;          /* 1 if materials have errors */
    stats_value mean;
    double standard_error; /* of --sphere, an estimate; else NAN */
    stats_value percentile[STATS_PERCENTS];
    uint32_t bins; /* of equal width in dB; bin i is (edge[i], edge[i + 1]] */
    double edge_dbsm[STATS_BINS + 1], edge_m2[STATS_BINS + 1];
    double cdf[STATS_ENDS][STATS_BINS + 1]; /* share of rows with sigma of at most edge_m2 */
    double share[STATS_BINS], fullest;      /* of each bin, and the largest */
} sweep_stats;

/* --stats and --stats-file: whether statistics are asked for; checks the files' names. 0 or
   CLI_USAGE. */
int cli_stats_read(const cli_args *args, int *asked);

/* Computes the statistics from sigma and bound of every row, and the ends of its material band
   (NULL: none); the caller frees them in any case. 0 or CLI_FAILED. */
int cli_stats_make(const sweep_plan *plan, const sweep_head *head, const double (*row)[2],
                   const double (*band)[2], sweep_stats *stats);
void cli_stats_free(sweep_stats *stats);

/* Writes the table for people, if --stats is given, and every --stats-file. 0 or CLI_FAILED. */
int cli_stats_write(const cli_args *args, FILE *out, const sweep_stats *stats);

#endif
