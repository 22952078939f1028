/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs compare: the kit as it was read back, the submitted answers, the
   class of each case, and the mistakes that could explain it. */
#ifndef LRCS_CLI_COMPARE_H
#define LRCS_CLI_COMPARE_H

#include "cli/kit.h"

#include <lrcs/table.h>

/* ---- tables ---- */

#define COMPARE_COLUMNS 24

/* A table whose first line names the columns, with its file. */
typedef struct compare_table {
    lrcs_host_file file;
    lrcs_host_table text;
    size_t lines;                     /* an upper bound of the number of rows */
    uint32_t column[COMPARE_COLUMNS]; /* of each name asked for; LRCS_NONE if there is none */
} compare_table;

/* Opens a table and looks for the named columns, of which the first `needed` ones must exist. 0 or
   CLI_FAILED with the message printed; the caller closes it in any case. Below, a column is given
   by the index of its name. */
int cli_table_open(const char *path, const char *const *name, int count, int needed,
                   compare_table *table);
void cli_table_close(compare_table *table);

/* 1 if the table has the column. cli_table_missing reports that it is missing, and returns
   CLI_FAILED. */
int cli_table_has(const compare_table *table, int name);
int cli_table_missing(const compare_table *table, const char *name);

/* Reads the next line that is not empty: 1, or 0 at the end, if *code is not 0 already, and with
 *code = CLI_FAILED and the message printed if it is faulty. */
int cli_table_next(compare_table *table, int *code);

/* A field of the line: its text; a name, a number, or a number that may be nan or inf: 0, or
   CLI_FAILED with a message that states the line, the column, what was found and what was
   expected. */
const lrcs_host_field *cli_table_field(const compare_table *table, int name);
int cli_table_name(const compare_table *table, int name, char text[KIT_NAME]);
int cli_table_number(const compare_table *table, int name, double *value);
int cli_table_answer(const compare_table *table, int name, double *value);

/* Reports any other fault of a field in the same form. Returns CLI_FAILED. */
__attribute__((format(printf, 3, 4))) int cli_table_refuse(const compare_table *table, int name,
                                                           const char *format, ...);

/* ---- the kit ---- */

enum compare_grade { COMPARE_EXACT, COMPARE_FLOAT, COMPARE_RASTER, COMPARE_FAIL, COMPARE_MISSING };

typedef struct compare_case {
    char attitude[KIT_NAME];
    uint32_t scene; /* index in the kit */
    int tier;
    double quaternion[4], direction[3], azel_deg[2];
    double sigma_m2, bound_m2, float_m2, edge_m2;
    double side_m;    /* of the square that is shown */
    uint32_t image;   /* side of its pictures in pixels, 0 for none */
    double theirs_m2; /* may be NaN */
    double printed;   /* the same number as in the submitted table */
    int given;        /* 1 if an answer was submitted */
    int grade;        /* compare_grade */
    int explained;    /* the finding that explains it, from 1; 0 for none */
    lrcs_pose pose;
    lrcs_facet_record *records; /* the truth's, NULL until they are needed */
    double peak;                /* their largest f_r cos */
} compare_case;

typedef struct compare_scene {
    char name[KIT_NAME];
    int tier, loaded;
    uint32_t first, count; /* cases */
    lrcs_host_scene host;
    lrcs_point *normal; /* of vertices, for mistakes: means of the normals of adjacent facets */
} compare_scene;

typedef struct compare_kit {
    const char *folder;
    lrcs_binding *binding;
    char (*material)[KIT_NAME];
    uint32_t bindings, cases, scenes;
    compare_case *list;
    compare_scene *scene;
} compare_kit;

/* Reads the kit in DIR; 0 or CLI_FAILED with the message printed; the caller frees it in any
   case. */
int cli_compare_kit(const char *folder, compare_kit *kit);
void cli_compare_kit_free(compare_kit *kit);

/* The scene's facets, prepared; the truth's records of a case. 0 or CLI_FAILED. */
int cli_compare_scene(const compare_kit *kit, compare_scene *scene);
int cli_compare_records(const compare_kit *kit, compare_case *one);

/* Runs a scene by the exact method without some effects (lrcs_run_options.without). 0 or
   CLI_FAILED. */
int cli_compare_run(const lrcs_host_scene *host, const lrcs_pose *pose, uint32_t without,
                    lrcs_facet_record *records);

/* The case of a line whose columns 0 and 1 are scene and attitude; NULL with the message printed.
 */
compare_case *cli_compare_find(const compare_kit *kit, const compare_table *table);

/* ---- the judgement ---- */

#define COMPARE_FINDINGS 6
#define COMPARE_TEXT     1024u

/* A cause of failures, described in a sentence. */
typedef struct compare_finding {
    const char *name; /* "no-shadows" */
    char text[COMPARE_TEXT];
    double factor;      /* a constant factor in addition; 1 for none */
    uint32_t explained; /* number of failing cases that it explains */
    double rest;        /* median share of their differences that remains */
} compare_finding;

/* ---- what their facets and images show beside ---- */

#define COMPARE_NAMED 8u /* number of facets, and of images, that are named */
#define COMPARE_TOP   3u /* number of facets named for each image */

enum compare_facet_way {
    FACET_SHOWN,
    FACET_LOST,
    FACET_WHOLE,
    FACET_PART,
    FACET_LARGER,
    FACET_ELSEWHERE,
    FACET_WAYS
};

/* A facet whose visible area differs. */
typedef struct compare_facet {
    const compare_case *one;
    uint32_t facet;
    double theirs_m2, truth_m2;
    double sigma_m2; /* the change of sigma */
    double weight;   /* the same, as a share of what the case is allowed */
    int failed;      /* 1 if its case fails */
    int way;
} compare_facet;

typedef struct compare_facets {
    uint32_t cases;           /* cases submitted */
    uint32_t way[FACET_WAYS]; /* number of facets that differ in each way */
    uint32_t cosines, turned; /* number of cosines submitted; of those, with the opposite sign */
    double cosine_most;       /* largest |difference|, without those of opposite sign */
    uint32_t worsts;
    compare_facet worst[COMPARE_NAMED]; /* facets of failing cases first, then by the change of
                                           sigma, the largest first */
} compare_facets;

/* An image that does not agree with the truth in any way. */
typedef struct compare_image {
    const compare_case *one;
    double agree;                /* share of the non-empty pixels that agree */
    uint32_t facet[COMPARE_TOP]; /* the facets that lose most pixels */
    uint32_t lost[COMPARE_TOP];  /* number of lost pixels; 0: no such facet */
} compare_image;

#define COMPARE_IMAGE_WAYS 10u

typedef struct compare_items {
    uint32_t images, handed, differ;
    uint32_t way[COMPARE_IMAGE_WAYS]; /* number of images that agree in each way */
    uint32_t named;
    compare_image image[COMPARE_NAMED];
} compare_items;

typedef struct compare_job {
    const cli_args *args;
    const char *theirs, *facets, *items;
    uint32_t pixels, tier;
    int grade;    /* the lowest class that passes */
    int decibels; /* 1 if the answers are in dBsm */
    compare_kit kit;
    uint32_t asked, given,
        failed; /* cases: those of the tiers asked for; failed: including missing ones */
    uint32_t not_numbers, negatives; /* failing cases that no finding explains */
    compare_finding finding[COMPARE_FINDINGS];
    uint32_t findings, unexplained;
    int biased; /* 1 if all answers share a factor although each is within its class */
    compare_facets by_facet;
    compare_items by_item;
} compare_job;

const char *cli_compare_grade(int grade);

/* The allowed error of a case in a class, m2. */
double cli_compare_allowed(const compare_case *one, int grade, uint32_t pixels);

/* 1 if the submission passed. */
int cli_compare_passed(const compare_job *job);

/* 1 if a case belongs to the tiers asked for. */
int cli_compare_asked(const compare_job *job, const compare_case *one);

/* 1 if a case fails the job; a case that was not asked for does not. */
int cli_compare_failed(const compare_job *job, const compare_case *one);

/* The fault of a failing case that no finding explains. */
enum compare_lack { LACK_NONE, LACK_ANSWER, LACK_NUMBER, LACK_SIGN, LACK_REASON };
int cli_compare_lack(const compare_job *job, const compare_case *one);

/* Reads the answers and assigns every case to its class. 0 or CLI_FAILED. */
int cli_compare_judge(compare_job *job);

/* Finds the causes of the failures. 0 or CLI_FAILED. */
int cli_compare_explain(compare_job *job);

/* ---- mistakes ---- */

/* A mistake: whatever is not 0 differs from the truth. */
typedef struct compare_mistake {
    const char *name, *text;
    int shade, area, turn; /* mistakes.c: enum mistake_shade, ... */
    double at;             /* of shade */
    int axes[3]; /* of turn: for x, y, z of s_hat, the component that is used, 1 .. 3, negative to
                    mirror it */
    int corners; /* 3 if the facet is the mean of the values at its corners */
    uint32_t without;   /* effects that are left out, lrcs_run_options.without */
    int wrong_coplanar; /* 1 if of coplanar facets the wrong one is seen */
} compare_mistake;

/* The catalogue, terminated by a NULL name; the first entry is no mistake. */
extern const compare_mistake cli_compare_mistakes[];

/* sigma of a case with a mistake. 0 or CLI_FAILED with the message printed. */
int cli_compare_answer(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                       double *sigma_m2);

/* ---- the search for causes ---- */

typedef struct compare_search {
    compare_job *job;
    compare_case **failing; /* not explained yet */
    compare_case **passing; /* a sample of them */
    uint32_t failings, passings;
    int telling;          /* 1 if some failing case has an answer other than 0 */
    double weight;        /* number of passing cases that each of the sample stands for */
    double *answer;       /* answers of a mistake: to the failing cases, then to the passing ones */
    double *room;         /* for sorting */
    unsigned char *holds; /* by failing case: 1 if the current cause explains it */
} compare_search;

/* Finds causes that need no mistake of the catalogue: those visible in the table, before the
   search; those that are left, after it. The second returns 0, or -1 with the message printed. */
void cli_compare_format(compare_search *search);
int cli_compare_symptoms(compare_search *search);

/* 1 if an expected answer explains the submitted one. */
int cli_search_explained(const compare_search *search, const compare_case *one, double expected);

/* The number of failing cases that the current cause explains (search->holds). */
uint32_t cli_search_holds(const compare_search *search);

/* Makes that cause a finding with its sentence: its cases are marked and no longer unexplained.
   NULL if there is no room for one. */
__attribute__((format(printf, 3, 4))) compare_finding *
cli_search_find(compare_search *search, const char *name, const char *format, ...);

/* The median, 0 of an empty list; sorts the values. */
double cli_search_median(double *value, uint32_t count);

/* The possible cause of a constant factor, and its name. */
const char *cli_factor_text(const compare_job *job, double factor);
const char *cli_factor_name(double factor);

/* ---- what else they handed in ---- */

/* Finds which facets differ, if job->facets names a file, and what the images in job->items show. 0
   or CLI_FAILED with the message printed. */
int cli_compare_facets(compare_job *job);
int cli_compare_items(compare_job *job);

/* The ways in words, and a verdict on the cosines; NULL if none were submitted. */
const char *cli_compare_facet_way(int way);
const char *cli_compare_image_way(size_t way);
const char *cli_compare_cosines(const compare_facets *facets);

/* ---- what is written ---- */

void cli_compare_table(const compare_job *job);
cli_text_writer cli_compare_json; /* the context is the job */
cli_text_writer cli_compare_junit;

#endif
