/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs report: the command, its measurements and its page. */
#ifndef LRCS_CLI_REPORT_H
#define LRCS_CLI_REPORT_H

#include "cli/converge/converge.h"
#include "cli/info/info.h"
#include "cli/run/run.h"
#include "cli/sweep/sweep.h"

#include <lrcs/picture.h>

#define REPORT_PEAKS 6u /* number of peaks of the map that are listed */
/* number of materials or curved parts that are listed; the others are counted */
#define REPORT_ROWS 40u

/* The sweeps that are drawn: three cuts through the axes, and the sphere of all directions. */
enum report_sweep_kind { REPORT_CUT_XY, REPORT_CUT_XZ, REPORT_CUT_YZ, REPORT_MAP, REPORT_SWEEPS };

/* What the laser sees, coloured by sigma and by material, each on a white and on a dark
   background. */
enum report_picture_kind { REPORT_BY_SIGMA, REPORT_BY_MATERIAL, REPORT_PICTURES };

typedef struct report_bytes {
    char *bytes; /* NULL for none */
    size_t size;
} report_bytes;

/* A sweep. */
typedef struct report_sweep {
    char az[40], el[40]; /* what varies, as lrcs sweep takes it */
    lrcs_host_plan plan;
    lrcs_host_sweep_chart plot;
    double (*row)[2];  /* sigma and bound, m2 */
    double (*band)[2]; /* the interval of the material uncertainty, m2; NULL if none is stated */
    double part[2];    /* as of lrcs_host_sweep_chart_band */
    report_bytes svg;  /* none if sigma is 0 everywhere */
} report_sweep;

typedef struct report_job {
    const cli_args *args;
    const char *path;
    double seconds;              /* approximate time for sweeps and comparisons */
    uint32_t cut_step, map_step; /* deg; 0 if chosen by the available time */
    uint32_t threads;            /* 0 for one per processor */
    run_job run;                 /* as lrcs run computes it, with shares */
    lrcs_host_scene info_scene;  /* as lrcs info reads it, with the normals of its files */
    lrcs_host_inventory info;
    report_bytes picture[REPORT_PICTURES][2];
    lrcs_run_options sweep_options;
    lrcs_host_options sweep_load;
    lrcs_host_scene sweep_scene; /* for the tolerance of the sweeps; empty if that of the run
                                    serves */
    report_sweep sweep[REPORT_SWEEPS];
    uint64_t peak[REPORT_PEAKS];
    cli_shares peak_shares[REPORT_PEAKS];
    uint32_t peaks;
    converge_job converge;
    report_bytes chart;
    report_bytes summary; /* the verdict that lrcs run prints */
} report_job;

/* ---- what it measures: 0 or an exit code with the message printed ---- */

/* Reads and runs the scene, and makes pictures and shares. */
int cli_report_run(report_job *job);

/* Computes the sweeps, their drawings and peaks. */
int cli_report_sweeps(report_job *job);

/* Computes the map alone, with all of the time, for a prepared scene. */
int cli_report_map(report_job *job);

/* Writes into memory: begin, write to the stream, end. NULL and -1 if out of memory. */
FILE *cli_report_bytes_begin(report_bytes *bytes);
int cli_report_bytes_end(FILE *out);

/* ---- the page ---- */

/* Writes the whole page: a cli_writer. */
cli_writer cli_report_page;

/* Writes the interactive page: a cli_writer. */
cli_writer cli_report_explore_page;

/* The beginning of a page, to the scene's title inside <header>: an attribute of <html>, more of
   its title, of its head and of its style (style.css). */
void cli_report_head(FILE *out, const report_job *job, const char *attribute, const char *more,
                     const char *meta, const char *style);

/* Writes markup with values in it. The format is the markup; the conversions are %s (a text, which
   is escaped), %u (a count), %.6g (a number for people, with so many digits and its full value for
   scripts; a dash if it is not finite), %.2e (the same for a bound, rounded up; a dash if it is
   negative) and %f (a share as a percentage). The compiler checks the arguments as those of
   printf. */
__attribute__((format(printf, 2, 3))) void cli_page(FILE *out, const char *format, ...);

/* Writes formatted text, which is escaped as a whole; a name, or a replacement if there is none; a
   number and a bound as above, which a script finds by the id. */
__attribute__((format(printf, 2, 3))) void cli_page_text(FILE *out, const char *format, ...);
void cli_page_name(FILE *out, const char *name, const char *nameless);
void cli_page_number(FILE *out, const char *id, double value, int digits);
void cli_page_bound(FILE *out, const char *id, double bound, int digits);

/* Begins a section with its heading, and a folded section with its title; the caller closes the
   elements <section> and <details>. */
void cli_page_section(FILE *out, const char *id, const char *title);
void cli_page_fold(FILE *out, const char *title);

/* A fact: its name, and its value as markup with values. */
__attribute__((format(printf, 3, 4))) void cli_page_fact(FILE *out, const char *name,
                                                         const char *format, ...);

/* A table that scrolls by itself if it is wide: columns as "name|name|#number", where '#' marks
   those of numbers. Rows and cells have a format of conversions as above, one for each cell: "%s"
   is a name, followed by the replacement of an empty one, and "%f" a share in percent and, in a
   cell of its own, as a bar. */
void cli_page_table(FILE *out, const char *label, const char *columns);
__attribute__((format(printf, 2, 3))) void cli_page_row(FILE *out, const char *format, ...);
__attribute__((format(printf, 2, 3))) void cli_page_cells(FILE *out, const char *format, ...);
void cli_page_table_end(FILE *out);

/* A drawing with a description, showing the given box of it: left, top, width, height; a caption
   follows; ends it. */
void cli_page_figure(FILE *out, const report_bytes *svg, const char *label, const double box[4]);
void cli_page_picture(FILE *out, const report_bytes picture[2], const char *label);
void cli_page_figure_end(FILE *out);

/* Makes the verdict of lrcs run for the run of the page, 0 or an exit code; writes it as
   markup. */
int cli_report_summary_make(report_job *job);
void cli_report_summary(FILE *out, const report_job *job);

/* The sections. */
void cli_report_notices(FILE *out, const report_job *job);
void cli_report_scene(FILE *out, const report_job *job);
void cli_report_sigma(FILE *out, const report_job *job);
void cli_report_effects(FILE *out, const report_job *job);
void cli_report_shares(FILE *out, const report_job *job);
void cli_report_charts(FILE *out, const report_job *job);
void cli_report_accuracy(FILE *out, const report_job *job);
void cli_report_reproduce(FILE *out, const report_job *job);

#endif
