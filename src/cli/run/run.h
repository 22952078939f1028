/* SPDX-License-Identifier: MIT */
/* A run between its command and its report. */
#ifndef LRCS_CLI_RUN_H
#define LRCS_CLI_RUN_H

#include "cli/shares.h"

#include <lrcs/picture.h>

/* What flipping an effect told of it: an effect that is on was left out, one that is off was
   simulated. All zero where a run cannot switch it. */
typedef struct run_explained_effect {
    double seconds;  /* what it takes, or would take */
    double scatter;  /* how far single measurements lie from that */
    double sigma_m2; /* flipped */
} run_explained_effect;

typedef struct run_explained {
    double pose;                         /* seconds of the pose as planned */
    double stage[LRCS_HOST_POSE_STAGES]; /* of a pose by the method and raster that answered */
    double stage_scatter[LRCS_HOST_POSE_STAGES];
    uint32_t rounds;
    run_explained_effect effect[LRCS_EFFECTS];
} run_explained;

/* --time-budget: what was asked for and what came of it. */
typedef struct run_budget {
    double asked_ms; /* 0: no budget */
    double start;    /* of the command, by the clock that does not jump */
    double spent_ms; /* until the answer stood */
    int answered;
    char same[128]; /* the options that give the same answer again */
} run_budget;

/* --precision, --depth-bits: hardware emulated, and what its answer is off by. */
typedef struct run_emulation {
    int asked;
    lrcs_emulation_options options;
    lrcs_emulation sampled; /* by double arithmetic with a depth of 64 bits */
    lrcs_emulation deep;    /* at the precision asked for, with all the depth that it has */
    lrcs_emulation answer;
    double reference_m2, reference_bound_m2; /* by method exact */
    int reference_method;
} run_emulation;

/* What the bound does not hold, and how much that is. */
typedef struct run_open {
    double back_area_m2, back_share; /* one-sided backs that show; of the silhouette */
    double back_sigma_m2;            /* sigma if they reflected; NAN: not known */
    uint32_t coarse;                 /* curved parts whose facets are too coarse for their glint */
    double glint_m2, glint_error_m2; /* their part of sigma, and an estimate of its error */
    double glint_most_m2;            /* of one facet */
    uint32_t glint_facet;
} run_open;

/* All that a run is made of, and all that it makes. */
typedef struct run_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_run_options options;
    lrcs_host_options load;
    const char *facets, *polygons_path, *image_path;
    uint32_t image_size;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_facet_record *records;
    lrcs_image image;
    lrcs_host_polygons polygons;
    double seconds;
    double asked; /* tolerance; 0: none, a time budget in its place */
    int met;
    int explain; /* asked for */
    run_explained explained;
    run_budget budget;
    run_emulation emulation;
    int shares_asked;
    cli_shares shares;
    run_open open;
    int sensitivity_asked;
    lrcs_uncertainty_options sampling;
    lrcs_uncertainty uncertainty;  /* not stated: no material has errors */
    lrcs_sensitivity *sensitivity; /* by material; NULL: not wanted */
    lrcs_attitude_slope attitude;  /* where asked for */
} run_job;

/* The options of output files, as 0 or CLI_USAGE; once the scene is read, that none of them would
   replace a file that it was read from, likewise; and their writing, as 0 or CLI_FAILED. */
int cli_run_outputs_read(run_job *job);
int cli_run_outputs_check(const run_job *job);
int cli_run_outputs_write(const run_job *job);

/* The picture that --image draws. */
lrcs_host_picture cli_run_picture(const run_job *job);

/* Does a file's table take the place of the one for people? */
int cli_run_outputs_stdout(const run_job *job);

/* --explain: runs the pose again and again, each effect flipped in turn, and up to each stage; 0 or
   CLI_FAILED. Then as keys of an effect's JSON object and of "seconds", and as a table after the
   result's. */
int cli_run_explain(run_job *job);
void cli_run_explain_json(const run_job *job, int effect, lrcs_host_json *json);
void cli_run_explain_stages_json(const run_job *job, lrcs_host_json *json);
void cli_run_explain_table(const run_job *job);

/* Is a result as good as a tolerance, by its bound and by the estimate of what curved normals add?
   None, 0, is never met. */
int cli_run_meets(const lrcs_result *result, double tolerance);

/* --time-budget: its value, as 0 or CLI_USAGE; and on a scene just read for the coarsest tolerance,
   the search: then result and seconds stand, and options and scene are those that give them again.
   0, CLI_FAILED or CLI_USAGE. */
int cli_run_budget_read(run_job *job);
int cli_run_budget(run_job *job);

/* --precision and --depth-bits: their values, as 0 or CLI_USAGE; the run, which makes the result
   that of the hardware with a bound proved by the reference, 0 or CLI_FAILED; then as a JSON object
   of its own, and as part of the table. */
int cli_run_emulation_read(run_job *job);
int cli_run_emulate(run_job *job);
void cli_run_emulation_json(const run_job *job, lrcs_host_json *json);
void cli_run_emulation_table(const run_job *job);

/* Finds what the bound does not hold, 0 or CLI_FAILED; as keys of an open object; and the verdict
   in words, the last lines of a table. */
int cli_run_open(run_job *job);
void cli_run_open_json(const run_job *job, lrcs_host_json *json);
void cli_run_verdict(const run_job *job, FILE *out);

/* --sensitivity, --draws and --seed: their values, as 0 or CLI_USAGE; the material uncertainty and
   the derivatives, where they are wanted, 0 or CLI_FAILED; as keys of an open object; as lines of
   the table; and of the verdict. */
int cli_run_materials_read(run_job *job);
int cli_run_materials(run_job *job);
void cli_run_materials_json(const run_job *job, lrcs_host_json *json);
void cli_run_materials_table(const run_job *job);
void cli_run_materials_verdict(const run_job *job, FILE *out);

/* The result on stdout: as JSON with the contract's keys in the contract's order, or as a table
   for people. */
void cli_run_json(const run_job *job);
void cli_run_table(const run_job *job);

/* The notices on stderr, which go with the table. */
void cli_run_notices(const run_job *job);

#endif
