/* SPDX-License-Identifier: MIT */
/* A sweep between its command line, its rows and its files. */
#ifndef LRCS_CLI_SWEEP_H
#define LRCS_CLI_SWEEP_H

#include "cli/shares.h"

#include <lrcs/sweep.h>

#define SWEEP_AXES    8
#define SWEEP_COLUMNS 12
#define SWEEP_FIELDS  6 /* of a row after its values: sigma to flags */

/* ---- ranges ---- */

/* A, A + STEP, .. as whole multiples of a power of ten: value i is the double nearest to the
   decimal number, and no step drifts. */
typedef struct sweep_range {
    int64_t first, step; /* (first + i step) / 10^decimals */
    uint64_t count;
    int decimals;
} sweep_range;

/* Reads "A:B:STEP", both ends included where the steps meet them, or "A" alone. NULL, or what is
   wrong with it. */
const char *cli_range_read(const char *text, size_t size, sweep_range *range);
double cli_range_at(const sweep_range *range, uint64_t i);

/* ---- tracks ---- */

/* Attitudes from a CSV file. */
typedef struct sweep_track {
    double (*row)[5]; /* time; direction x, y, z, or quaternion w, x, y, z */
    uint64_t count;
    int quaternions;
    uint64_t hash; /* of the file's bytes */
} sweep_track;

/* 0, CLI_FAILED or CLI_USAGE with the message printed. */
int cli_track_read(const char *path, sweep_track *track);

/* ---- the plan: which rows there are ---- */

enum sweep_kind {
    SWEEP_FIXED, /* one pose: the scene varies */
    SWEEP_AZEL,
    SWEEP_EULER,
    SWEEP_ROTATE,
    SWEEP_SPHERE,
    SWEEP_TRACK
};

/* One thing that varies: the last axis fastest, what changes the scene before what changes the
   pose. */
typedef struct sweep_axis {
    const char *option; /* "az", ... */
    char name[128];     /* its column */
    sweep_range range;
    char whom[100]; /* of a scene's axis: part or material */
    int key;        /* what of it */
} sweep_axis;

typedef struct sweep_plan {
    sweep_axis axis[SWEEP_AXES];
    uint32_t axes, scene_axes;
    int kind;
    lrcs_pose base;
    char sequence[4];    /* SWEEP_EULER */
    double about[3];     /* SWEEP_ROTATE */
    sweep_track track;   /* SWEEP_TRACK */
    uint64_t poses;      /* of each scene */
    uint64_t rows;       /* of all scenes */
    uint64_t first, end; /* those of this shard */
    uint32_t columns;    /* values of a row */
    const char *column[SWEEP_COLUMNS];
} sweep_plan;

/* 0, CLI_FAILED or CLI_USAGE with the message printed. The caller frees it in any case. */
int cli_plan_read(const cli_args *args, sweep_plan *plan);
void cli_plan_free(sweep_plan *plan);

/* The values of a row, and its pose. */
void cli_plan_values(const sweep_plan *plan, uint64_t row, double value[SWEEP_COLUMNS]);
int cli_plan_pose(const sweep_plan *plan, uint64_t row, lrcs_pose *pose);

/* ---- what changes the scene ---- */

/* --joint and --vary, before what changes the pose. 0 or CLI_USAGE. */
int cli_scene_axes_read(const cli_args *args, sweep_plan *plan);

/* Do parts, materials and values fit the scene? 0 or CLI_USAGE. */
int cli_scene_axes_check(const cli_args *args, const sweep_plan *plan, const lrcs_host_scene *base);

/* The scene of a row, prepared, from the one that was read, which must outlive it; in any thread.
   Status: as lrcs_host_scene_vary and lrcs_host_scene_prepare. */
int cli_scene_of_row(const sweep_plan *plan, uint64_t row, const lrcs_host_scene *base,
                     const lrcs_build_options *build, lrcs_host_scene *scene,
                     lrcs_host_error *error);

/* Adds an axis, NULL-terminated or not. 0 or CLI_USAGE. */
int cli_axis_add(const cli_args *args, sweep_plan *plan, const char *option, const char *name,
                 const char *text, size_t size);

/* Do all rows together have a mean: one --sphere of one scene? */
int cli_plan_has_mean(const sweep_plan *plan);

/* Position of a row along an axis. */
uint64_t cli_plan_place(const sweep_plan *plan, uint64_t row, uint32_t axis);

/* ---- rows ---- */

enum sweep_format { SWEEP_CSV, SWEEP_JSONL, SWEEP_NPY };

typedef struct sweep_row {
    uint64_t index;
    double value[SWEEP_COLUMNS];
    double sigma_m2, bound_m2, sigma_glint_m2, sigma_diffuse_m2;
    uint32_t flags;
} sweep_row;

/* What the first line says: nothing in it depends on the machine, the number of threads or the
   shard. */
typedef struct sweep_head {
    uint64_t scene_hash, rows;
    uint64_t shape[SWEEP_AXES + 1]; /* of a map */
    uint32_t dimensions;
    struct {
        const char *key;
        char text[1200];
    } option[24];
    uint32_t options;
} sweep_head;

/* 0 or CLI_USAGE. */
int cli_head_make(const cli_args *args, const sweep_plan *plan, const lrcs_run_options *options,
                  const lrcs_host_scene *scene, sweep_head *head);

/* What all rows say together. */
typedef struct sweep_tally {
    uint64_t rows, missed, starved; /* missed: the tolerance; starved: short of memory */
    uint64_t estimated, unjudged;   /* accepted by estimate; accepted whatever they are */
    double mean, square, bound;     /* of sigma; sum of squared deviations; sum of bounds */
} sweep_tally;

void cli_tally_add(sweep_tally *tally, const sweep_row *row);
/* sigma's standard error, as if directions were drawn at random. */
double cli_tally_error(const sweep_tally *tally);

/* The first lines, one row, and for --sphere a line after the rows. */
void cli_rows_head(FILE *out, int format, const sweep_head *head, const sweep_plan *plan);
void cli_rows_put(FILE *out, int format, const sweep_plan *plan, const sweep_row *row);
void cli_rows_mean(FILE *out, int format, const sweep_tally *tally);

/* The last line: FNV-1a of all bytes before it. The sum of no bytes, of more bytes, and the line,
   which always has the same length in a format. */
#define SWEEP_SUM_BEGIN 0xcbf29ce484222325u
uint64_t cli_sum_more(uint64_t sum, const void *bytes, size_t size);
void cli_rows_sum(FILE *out, int format, uint64_t sum);

/* ---- rows that were written ---- */

/* A file of rows in memory. */
typedef struct sweep_text {
    int format;       /* SWEEP_CSV or SWEEP_JSONL, by its first byte */
    const char *head; /* its first lines */
    size_t head_size;
    const char *at, *end; /* what follows */
    uint64_t line;        /* that `at` stands at, from 1 */
    uint64_t rows;        /* of the whole sweep */
    uint64_t shape[SWEEP_AXES + 1];
    uint32_t dimensions;
    uint32_t columns; /* values of a row */
    int has_mean;     /* one --sphere */
    int flagged;      /* rows may be accepted unproved: a map of them shows their flags */
    char fault[200];  /* what is wrong with the line at `at` */
} sweep_text;

/* 0, or -1 where the bytes are no rows of a sweep. */
int cli_text_open(const char *bytes, size_t size, sweep_text *text);

/* The next row; line and line_size say where it stands. Every field is held against what it must
   be: as many as the head names, finite, dBsm that of sigma, bound >= 0, glint and diffuse adding
   up, flags known, and with a plan (or NULL) the values of that row. 1; 0 after the last row, whose
   line may be cut short; -1 where a whole line is no such row: text->fault says why. */
int cli_text_next(sweep_text *text, const sweep_plan *plan, sweep_row *row, const char **line,
                  size_t *line_size);

/* After the last row: 1 where nothing follows but the mean of a sphere and a checksum that agrees;
   0 where there is no checksum, or one cut short; -1, with text->fault, where it does not agree or
   something else follows. */
int cli_text_end(sweep_text *text);

/* ---- maps ---- */

/* Writes FILE.npy, a NumPy array of shape (.., 2), sigma and bound, or (.., 3), where
   text->flagged: 0 in the third place where the bound meets the tolerance, 1 where the estimate was
   accepted, 2 where any answer was, -1 where the tolerance is missed. And FILE.npy.head, the first
   lines of its rows with a checksum of the map. The rows are those that `next` gives in order (1: a
   row; 0: the end; else it has failed and said so). 0 or CLI_FAILED. */
typedef int sweep_next(void *context, sweep_row *row);
int cli_map_write(const char *path, const sweep_text *text, sweep_next *next, void *context);

/* ---- files ---- */

/* Where rows go: to standard output, or to FILE.partial, which becomes FILE when it is whole and is
   valid at every line before. */
typedef struct sweep_file {
    int format;                       /* of the rows: SWEEP_CSV or SWEEP_JSONL */
    int npy;                          /* they become a map at the end */
    char *path, *partial, *lock_path; /* NULL: standard output */
    int lock;                         /* descriptor of FILE.lock; 0: not locked */
    int descriptor;                   /* of FILE.partial; 0: not open */
    FILE *stream;                     /* rows not yet handed to the system, in memory */
    char *waiting;                    /* those bytes */
    size_t waiting_size;
    uint64_t size, sum; /* bytes in FILE.partial before its checksum, and that */
    uint64_t next;      /* the first row that is still to come */
    sweep_tally tally;
    double flushed;   /* when rows were last handed to the system, s */
    double (*row)[2]; /* sigma and bound of every row, or NULL; whoever made it frees it */
} sweep_file;

/* What -o and --json ask for; 0 or CLI_USAGE. */
int cli_file_read(const cli_args *args, sweep_file *file);

/* Locks the file; then begins, or goes on where --resume finds rows of the same head. A second
   process is told who holds the lock. 0 or CLI_FAILED. */
int cli_file_open(const cli_args *args, sweep_file *file, const sweep_head *head,
                  const sweep_plan *plan);

/* One more row. Status: LRCS_OK; LRCS_E_SYSTEM where it could not be written. */
int cli_file_put(sweep_file *file, const sweep_plan *plan, const sweep_row *row,
                 lrcs_host_error *error);

/* Ends: with all rows FILE.partial becomes FILE; with some it stays as it is, with none it goes.
   0 or CLI_FAILED. */
int cli_file_close(sweep_file *file, const sweep_plan *plan, int all);
void cli_file_free(sweep_file *file);

/* Takes up a row that is written, now or before. */
void cli_file_take(sweep_file *file, const sweep_row *row);

/* Takes up the rows of FILE.npy where FILE.npy.head begins with one of these heads and has the
   map's checksum. 0, or -1 with nothing taken. */
int cli_map_recover(sweep_file *file, const sweep_plan *plan, const char *const head[2],
                    const size_t head_size[2]);

/* FILE.lock: 0, or CLI_FAILED where another process holds it, with a message that says who. */
int cli_lock_take(sweep_file *file);
void cli_lock_drop(sweep_file *file);

/* ---- plots ---- */

/* One of the things that vary. */
typedef struct plot_axis {
    uint32_t column; /* of the plan; that after its axes: the time of a track */
    uint64_t count;
    const char *name;
} plot_axis;

/* --plot: curves along x, one for each value of y, or a map. */
typedef struct sweep_plot {
    int asked, dbsm, polar, map;
    int open;         /* materials are illustrative or assumed: no bound holds what that costs */
    plot_axis x, y;   /* y: one value where only one thing varies */
    int swapped;      /* x is the faster of two */
    double (*row)[2]; /* sigma and bound, m2 */
} sweep_plot;

/* What --plot, --dbsm and --polar ask for; that no plot replaces anything; 0 or CLI_USAGE. Then the
   drawing, as 0 or CLI_FAILED; and one drawing as SVG, titled after args->operand. */
int cli_plot_read(const cli_args *args, const sweep_plan *plan, sweep_plot *plot);
int cli_plot_spares(const cli_args *args, const sweep_file *file, const lrcs_host_scene *scene);
int cli_plot_write(const cli_args *args, const sweep_plot *plot, const sweep_plan *plan);
int cli_plot_svg(FILE *out, const cli_args *args, const sweep_plot *plot, const sweep_plan *plan);

/* ---- peaks ---- */

/* The brightest rows that outshine all their neighbours, at most `most` of them, the brightest
   first, from sigma and bound of every row. Returns how many; rows without a return are none. */
uint32_t cli_peaks_find(const sweep_plan *plan, const double (*row)[2], uint32_t most,
                        uint64_t *peak);

/* Who makes sigma of a row: it is run once more. `base` was read, and is prepared where it must be;
   shares are to be freed in any case. 0 or CLI_FAILED. */
int cli_row_shares(const sweep_plan *plan, uint64_t row, lrcs_host_scene *base,
                   const lrcs_run_options *options, const lrcs_build_options *build,
                   cli_shares *shares);

/* --brightest: how many, 0 where it was not given, as 0 or CLI_USAGE; then their table on stdout,
   as 0 or CLI_FAILED. Peaks that are the normal of a facet of a coarse curved part are marked:
   there flat facets glint where the body need not. */
int cli_brightest_read(const cli_args *args, const sweep_plan *plan, const sweep_file *file,
                       uint32_t *most);
int cli_brightest_print(const sweep_plan *plan, const double (*row)[2], uint32_t most,
                        lrcs_host_scene *base, const lrcs_run_options *options,
                        const lrcs_build_options *build, const lrcs_host_glint *coarse,
                        uint32_t coarse_count);

/* ---- statistics ---- */

/* --stats: mean, percentiles, least and most of sigma over all rows. 0 or CLI_FAILED. */
int cli_stats_print(FILE *out, const sweep_plan *plan, const double (*row)[2]);

/* ---- progress ---- */

/* A bar with the time left, on stderr where that is a terminal. */
typedef struct sweep_progress {
    int on;
    uint64_t first, total;
    double begun, shown; /* s */
} sweep_progress;

sweep_progress cli_progress_make(uint64_t first, uint64_t total);
void cli_progress_show(sweep_progress *progress, uint64_t done);
void cli_progress_clear(const sweep_progress *progress);

#endif
