/* SPDX-License-Identifier: MIT */
/* What a comparison of settings measures, between its command and its reports. */
#ifndef LRCS_CLI_CONVERGE_H
#define LRCS_CLI_CONVERGE_H

#include "cli/cli.h"

#define CONVERGE_SETTINGS 32
#define CONVERGE_MESHES   6
#define CONVERGE_REPEATS  25

/* The dials that can be turned. One more way to run (other normals, say) is one more dial: a row
   here, its settings in converge_measure.c, its look in converge_chart.c. */
enum converge_dial {
    CONVERGE_ZBUFFER, /* its resolution */
    CONVERGE_MESH,    /* how finely shapes are tessellated */
    CONVERGE_PREVIEW, /* the tolerance, met by an estimate: --accept estimate */
    CONVERGE_FACET,   /* no self-shadowing */
    CONVERGE_EXACT,
    CONVERGE_CLOSED, /* no facets: closed forms of shapes that nothing hides */
    CONVERGE_DIALS
};

/* The scene with its shapes tessellated for a tolerance of 10^-digits; digits 0: a mesh that does
   not depend on it. */
typedef struct converge_mesh {
    int digits;
    lrcs_host_scene scene;
} converge_mesh;

/* One setting, measured. */
typedef struct converge_setting {
    int dial;
    char name[48];
    int method;
    uint32_t resolution; /* 0: no raster */
    int digits;          /* of the tolerance 10^-digits that an estimate is to meet; 0: none is */
    uint32_t mesh;       /* index */
    uint32_t runs;
    double seconds[CONVERGE_REPEATS]; /* of each run */
    double spent_s, pose_s;           /* their sum and their median */
    double sigma_m2;
    double error_m2;         /* |sigma - truth| */
    double estimate_m2;      /* negative: none */
    double bound_m2;         /* of |sigma - truth| but for the truth's own; negative: not known */
    int whole;               /* the bound is against the true shapes, not against the facets */
    int short_of_memory;     /* a coarser raster than asked */
    const char *accepted_by; /* of a preview: "estimate", "bound", or NULL where it is missed */
} converge_setting;

typedef struct converge_truth {
    double sigma_m2, bound_m2;
    int whole;     /* the bound is against the true shapes, not against the facets */
    char text[96]; /* where it comes from */
} converge_truth;

typedef struct converge_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_host_options load;
    const char *csv;
    int digits;            /* no finer mesh than for 10^-digits; 0: all of them */
    double seconds, spent; /* for all runs, and spent on them */
    double processor;      /* s of a processor's time that they had */
    converge_mesh mesh[CONVERGE_MESHES];
    uint32_t meshes; /* coarse to fine: the last one is the finest */
    converge_setting setting[CONVERGE_SETTINGS];
    uint32_t settings;
    converge_truth truth;
    char left_out[160]; /* what time or size did not allow, or "" */
    char busy[120];     /* how little of a processor the runs had, or "" */
} converge_job;

/* Reads the scene with every mesh. 0, or an exit code with the message printed. */
int cli_converge_meshes(converge_job *job);

/* Measures all settings and finds the truth. As above. */
int cli_converge_measure(converge_job *job);

/* The finest mesh. */
const converge_mesh *cli_converge_finest(const converge_job *job);

/* A value relative to the true sigma; as it is (m2) where that is 0. */
double cli_converge_relative(const converge_job *job, double value_m2);

/* What is known of a value: itself; negative, which is not known, as NAN. The scene that a setting
   ran on. */
double cli_converge_known(double value);
const lrcs_host_scene *cli_converge_scene(const converge_job *job, const converge_setting *one);

/* The sentence that sums up. */
typedef struct converge_sentence {
    char text[960];
} converge_sentence;
converge_sentence cli_converge_sentence(const converge_job *job);

/* The reports: the table or JSON on stdout, both with a sentence that sums up; CSV; a chart. */
void cli_converge_table(const converge_job *job);
void cli_converge_json(const converge_job *job);
void cli_converge_csv(const converge_job *job, FILE *out);
int cli_converge_chart(const converge_job *job, int png, FILE *out, lrcs_host_error *error);

#endif
