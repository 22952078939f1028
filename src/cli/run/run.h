/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs run: the run and its report. */
#ifndef LRCS_CLI_RUN_H
#define LRCS_CLI_RUN_H

#include "cli/shares.h"

#include <lrcs/explain.h>
#include <lrcs/picture.h>

/* --time-budget: the time asked for, and the outcome. */
typedef struct run_budget {
    double asked_ms; /* 0 for no budget */
    double start;    /* start of the command on the monotonic clock */
    double spent_ms; /* time until the answer was known */
    char same[128];  /* the options that reproduce the answer */
} run_budget;

/* --precision, --depth-bits: emulated hardware, and the error of its answer. */
typedef struct run_emulation {
    int asked;
    lrcs_emulation_options options;
    lrcs_emulation sampled; /* with double arithmetic and a depth of 64 bits */
    lrcs_emulation deep;    /* at the precision asked for, with its full depth resolution */
    lrcs_emulation answer;
    double reference_m2, reference_bound_m2; /* by method exact */
    int reference_method;
} run_emulation;

/* What the bound does not include, and the size of it. */
typedef struct run_caveats {
    double back_area_m2,
        back_share; /* area of one-sided backs that are visible; their share of the silhouette */
    double back_sigma_m2; /* sigma if they reflected; NAN if not known */
    uint32_t coarse;      /* number of curved parts whose facets are too coarse for their glint */
    lrcs_host_glint_sum glint; /* their glint, and an estimate of its error */
} run_caveats;

/* A search for the best settings keeps the division of a scene of up to this many parts; one of
   more parts is divided again for the answer. */
#define RUN_BUDGET_PARTS 1024u

/* The inputs and results of a run. */
typedef struct run_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_run_options options;
    lrcs_host_options load;
    const char *facets_path, *polygons_path, *image_path;
    uint32_t image_size;
    lrcs_host_scene scene;
    lrcs_result result;
    unsigned char halvings[RUN_BUDGET_PARTS]; /* of load.build, after such a search */
    lrcs_facet_record *records;
    int announced; /* that it takes long */
    int divided;   /* 1: cli_run_divide has run the pose */
    lrcs_image image;
    lrcs_host_polygons polygons;
    double seconds;
    double asked; /* tolerance; 0 if none, because a time budget replaces it */
    int met;
    int explain; /* 1 if asked for */
    lrcs_host_explained explained;
    run_budget budget;
    run_emulation emulation;
    int shares_asked;
    cli_shares shares;
    run_caveats caveats;
    int sensitivity_asked;
    lrcs_uncertainty_options sampling;
    lrcs_uncertainty uncertainty;  /* not stated if no material has errors */
    lrcs_sensitivity *sensitivity; /* by material; NULL if not asked for */
    lrcs_attitude_slope attitude;  /* if asked for */
} run_job;

/* Reads the scene and runs it from the pose, by the options of the job: result, records, shares,
   image, material uncertainty. 0, CLI_FAILED or CLI_USAGE. */
int cli_run_scene(run_job *job);
void cli_run_free(run_job *job);

/* Reads the options of output files, 0 or CLI_USAGE; writes them, 0 or CLI_FAILED. */
int cli_run_outputs_read(run_job *job);
int cli_run_outputs_write(const run_job *job);

/* The picture that --image draws. */
lrcs_host_picture cli_run_picture(const run_job *job);

/* 1 if a file goes to standard output and replaces the table for people. */
int cli_run_outputs_stdout(const run_job *job);

/* --explain: runs the pose repeatedly, with each effect flipped in turn, and up to each stage; 0 or
   CLI_FAILED. Then writes keys of an effect's JSON object and of "seconds", and a table after the
   result's. */
int cli_run_explain(run_job *job);
void cli_run_explain_json(const run_job *job, int effect, lrcs_host_json *json);
void cli_run_explain_stages_json(const run_job *job, lrcs_host_json *json);
void cli_run_explain_table(const run_job *job);

/* Runs the pose with curved shapes divided as finely as it needs, if they can be divided:
   job->scene becomes the scene of that division, and job->divided 1. 0 or CLI_FAILED. */
int cli_run_divide(run_job *job);

/* 1 if a result meets a tolerance, by its bound and by the estimate of what curved normals add. A
   tolerance of 0 means none and is never met. */
int cli_run_meets(const lrcs_result *result, double tolerance);

/* --time-budget: reads its value, 0 or CLI_USAGE; then searches, on a scene just read: result and
   seconds are set, and options and scene are those that reproduce them. 0, CLI_FAILED or
   CLI_USAGE. */
int cli_run_budget_read(run_job *job);
int cli_run_budget(run_job *job);

/* --precision and --depth-bits: reads their values, 0 or CLI_USAGE; runs the emulation, which makes
   the result that of the hardware with a bound proved by the reference, 0 or CLI_FAILED; then
   writes it as a JSON object of its own, and as part of the table. */
int cli_run_emulation_read(run_job *job);
int cli_run_emulate(run_job *job);
void cli_run_emulation_json(const run_job *job, lrcs_host_json *json);
void cli_run_emulation_table(const run_job *job);

/* Finds what the bound does not include, 0 or CLI_FAILED; writes it as keys of an open object; and,
   with what is proved, as the verdict, the last lines of a table. */
int cli_run_caveats(run_job *job);
void cli_run_caveats_json(const run_job *job, lrcs_host_json *json);
void cli_run_verdict(const run_job *job, FILE *out);

/* --sensitivity, --draws and --seed: reads their values, 0 or CLI_USAGE; computes the material
   uncertainty and the derivatives, if asked for, 0 or CLI_FAILED; writes them as keys of an open
   object, as lines of the table, and as lines of the verdict. */
int cli_run_materials_read(run_job *job);
int cli_run_materials(run_job *job);
void cli_run_materials_json(const run_job *job, lrcs_host_json *json);
void cli_run_materials_table(const run_job *job);
void cli_run_materials_verdict(const run_job *job, FILE *out);

/* Prints the result on stdout: as JSON with the keys and the order of the contract, or as a table
   for people. */
void cli_run_json(const run_job *job);
void cli_run_table(const run_job *job);

/* Writes every notice of a run: those of the scene, of the result, and of options that had no
   effect. They go to the open JSON array, or, if json is NULL, to stderr. */
void cli_run_notices(const run_job *job, lrcs_host_json *json);

#endif
