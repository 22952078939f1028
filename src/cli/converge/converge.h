/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs converge: the measured settings. */
#ifndef LRCS_CLI_CONVERGE_H
#define LRCS_CLI_CONVERGE_H

#include "cli/cli.h"

#define CONVERGE_SETTINGS 32
#define CONVERGE_MESHES   6
#define CONVERGE_REPEATS  25

/* The kinds of settings ("dials"). Another way to run (other normals, for example) is one more
   dial: a row here, its settings in measure.c, its look in chart.c. */
enum converge_dial {
    CONVERGE_ZBUFFER, /* its resolution */
    CONVERGE_MESH,    /* how finely shapes are tessellated */
    CONVERGE_PREVIEW, /* the tolerance, met by an estimate: --accept estimate */
    CONVERGE_FACET,   /* no self-shadowing */
    CONVERGE_EXACT,
    CONVERGE_CLOSED, /* no facets: closed forms of shapes that nothing hides */
    CONVERGE_DIALS
};
#define CONVERGE_PREVIEW_NAME "by estimate" /* its settings' names begin so */

/* The scene with its shapes tessellated for a tolerance of 10^-digits; digits is 0 for a mesh that
   does not depend on it. */
typedef struct converge_mesh {
    int digits;
    lrcs_host_scene scene;
} converge_mesh;

/* One setting, measured. */
typedef struct converge_setting {
    int dial;
    char name[48];
    int method;
    uint32_t resolution; /* 0 for no raster */
    int digits;          /* of the tolerance 10^-digits that an estimate must meet; 0 for none */
    uint32_t mesh;       /* index of its mesh */
    uint32_t runs;
    double seconds[CONVERGE_REPEATS]; /* of each run */
    double spent_s, pose_s;           /* their sum and their median */
    double sigma_m2;
    double error_m2;    /* |sigma - truth| */
    double estimate_m2; /* negative if there is none */
    double bound_m2; /* bound of |sigma - truth|, without that of the truth itself; negative if not
                        known */
    int whole;       /* 1 if the bound is against the true shapes, not against the facets */
    int short_of_memory; /* 1 if the raster is coarser than asked for */
    const char
        *accepted_by; /* of a preview: "estimate", "bound", or NULL if the tolerance is missed */
} converge_setting;

typedef struct converge_truth {
    double sigma_m2, bound_m2;
    int whole;     /* 1 if the bound is against the true shapes, not against the facets */
    char text[96]; /* its origin */
} converge_truth;

typedef struct converge_job {
    const cli_args *args;
    const char *title; /* the name of the scene's file */
    const char *about; /* in the chart: what it was made from */
    lrcs_pose pose;
    lrcs_host_options load;
    const char *csv;
    int digits;            /* finest mesh, for 10^-digits; 0 for all meshes */
    double seconds, spent; /* time limit for all runs, and time spent on them */
    double processor;      /* processor time that they used, s */
    converge_mesh mesh[CONVERGE_MESHES];
    uint32_t meshes; /* from coarse to fine */
    converge_setting setting[CONVERGE_SETTINGS];
    uint32_t settings;
    converge_truth truth;
    char left_out[160]; /* what was left out because of time or size, or "" */
    char busy[120];     /* the share of a processor that the runs had, if small, or "" */
} converge_job;

/* Reads the scene with every mesh. 0, or an exit code with the message printed. */
int cli_converge_meshes(converge_job *job);

/* Measures all settings and finds the truth. Returns as above. */
int cli_converge_measure(converge_job *job);

/* The finest mesh. */
const converge_mesh *cli_converge_finest(const converge_job *job);

/* A value relative to the true sigma; in m2 if that is 0. */
double cli_converge_relative(const converge_job *job, double value_m2);

/* The sentence that summarizes the comparison. */
typedef struct converge_sentence {
    char text[960];
} converge_sentence;
converge_sentence cli_converge_sentence(const converge_job *job);

/* The reports: the table or JSON on stdout, both with the summary sentence; CSV; a chart. */
void cli_converge_table(const converge_job *job);
void cli_converge_json(const converge_job *job);
cli_text_writer cli_converge_csv; /* its context is the job */

/* What it was made from: the first line of the table without "# ". The context is the job. */
cli_text_writer cli_converge_about;

/* The chart, from the title, about, the pose's direction, the truth, the settings and the digits of
   their meshes. The context is the job. */
cli_chart_writer cli_converge_chart;

#endif
