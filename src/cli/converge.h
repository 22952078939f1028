/* SPDX-License-Identifier: MIT */
/* What a comparison of settings measures, between its command and its reports. */
#ifndef LRCS_CLI_CONVERGE_H
#define LRCS_CLI_CONVERGE_H

#include "cli/cli.h"

#define CONVERGE_MOST 64 /* settings */

/* The dials that can be turned. One more way to run (other normals, say) is one more dial: a row
   here, its measuring in converge_measure.c, its look in converge_chart.c. */
enum converge_dial {
    CONVERGE_MESH,  /* how finely shapes are tessellated */
    CONVERGE_FACET, /* no self-shadowing */
    CONVERGE_EXACT,
    CONVERGE_ZBUFFER, /* its resolution */
    CONVERGE_DIALS
};

/* One setting, measured. */
typedef struct converge_setting {
    int dial;
    char name[48];
    int method;
    uint32_t resolution; /* 0: no raster */
    double mesh;         /* tolerance that its mesh was built for; 0: a mesh as it is */
    uint32_t facets, repetitions;
    double prepare_s, pose_s; /* pose: the median of the repetitions */
    double sigma_m2;
    double error_m2;     /* |sigma - truth| */
    double estimate_m2;  /* negative: none */
    double bound_m2;     /* of |sigma - truth| but for the truth's own; negative: not known */
    int whole;           /* its bound is against the true shapes, not against its facets */
    int short_of_memory; /* a coarser raster than asked */
} converge_setting;

typedef struct converge_truth {
    int closed; /* from the closed form, else from exact */
    double sigma_m2, bound_m2;
    char text[80]; /* where it comes from */
} converge_truth;

typedef struct converge_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_host_options load;
    const char *csv;
    double seconds, spent; /* to spend in all, and spent */
    lrcs_host_scene scene; /* with the finest mesh so far */
    double mesh;           /* what that was built for; 0: a mesh as it is */
    uint64_t hash;
    converge_setting setting[CONVERGE_MOST];
    uint32_t count;
    converge_truth truth;
    char left_out[160]; /* what time or size did not allow, or "" */
} converge_job;

/* Measures all settings and finds the truth. 0, or an exit code with the message printed. */
int cli_converge_measure(converge_job *job);

/* A value relative to the true sigma; as it is (m2) where that is 0. */
double cli_converge_relative(const converge_job *job, double value_m2);

/* The reports: the table or JSON on stdout, both with a sentence that sums up; CSV; a chart. */
void cli_converge_table(const converge_job *job);
void cli_converge_json(const converge_job *job);
void cli_converge_csv(const converge_job *job, FILE *out);
int cli_converge_chart(const converge_job *job, int png, FILE *out, lrcs_host_error *error);

#endif
