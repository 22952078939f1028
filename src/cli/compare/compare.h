/* SPDX-License-Identifier: MIT */
/* What the rooms of lrcs compare share: the kit as it was read back, what others answered, the
   class of each case, and the mistakes that could explain it. */
#ifndef LRCS_CLI_COMPARE_H
#define LRCS_CLI_COMPARE_H

#include "cli/kit.h"

#include <lrcs/table.h>

/* ---- tables ---- */

/* A table whose first line names the columns, and its file. */
typedef struct compare_table {
    lrcs_host_file file;
    lrcs_host_table text;
} compare_table;

/* Opens a table and reads its names. 0 or CLI_FAILED with the message printed; closed in any
   case. */
int cli_table_open(const char *path, compare_table *table);
void cli_table_close(compare_table *table);

/* At least as many as there are lines to come. */
size_t cli_table_lines(const compare_table *table);

/* The column of a name, -1 for none; and one that must be there: 0 or CLI_FAILED. */
int cli_table_column(const compare_table *table, const char *name);
int cli_table_require(const compare_table *table, const char *name, int *column);

/* The next line that holds something: 1, 0 at the end, -1 with the message printed. */
int cli_table_next(compare_table *table);

/* A field of the line: a name, a number, a number that may be nan or inf. 0 or CLI_FAILED with the
   line, the column, what was found and what was expected. */
int cli_table_name(const compare_table *table, int column, char name[KIT_NAME]);
int cli_table_number(const compare_table *table, int column, double *value);
int cli_table_answer(const compare_table *table, int column, double *value);

/* The same for what else is wrong with a field. Returns CLI_FAILED. */
__attribute__((format(printf, 3, 4))) int cli_table_refuse(const compare_table *table, int column,
                                                           const char *format, ...);

/* ---- the kit ---- */

enum compare_grade { COMPARE_EXACT, COMPARE_FLOAT, COMPARE_RASTER, COMPARE_FAIL, COMPARE_MISSING };

typedef struct compare_case {
    char attitude[KIT_NAME];
    uint32_t scene; /* of the kit */
    int tier;
    double quaternion[4], direction[3], azel_deg[2];
    double sigma_m2, bound_m2, float_m2, edge_m2;
    double side_m;    /* of the square that is shown */
    uint32_t image;   /* side of its pictures, 0: none */
    double theirs_m2; /* may be NaN */
    double printed;   /* the same as their table has it */
    int given;        /* did they answer? */
    int grade;        /* compare_grade */
    int explained;    /* by which finding, from 1 */
    lrcs_pose pose;
    lrcs_facet_record *records; /* the truth's, once asked for */
    double peak;                /* their largest f_r cos */
} compare_case;

typedef struct compare_scene {
    char name[KIT_NAME];
    int tier, loaded;
    uint32_t first, count; /* cases */
    lrcs_host_scene host;
    lrcs_point *normal; /* of vertices, for mistakes: means of their facets' normals */
} compare_scene;

typedef struct compare_kit {
    const char *folder;
    lrcs_binding *binding;
    char (*material)[KIT_NAME];
    uint32_t bindings, cases, scenes;
    compare_case *list;
    compare_scene *scene;
} compare_kit;

/* Reads DIR; 0 or CLI_FAILED with the message printed; the caller frees it in any case. */
int cli_compare_kit(const char *folder, compare_kit *kit);
void cli_compare_kit_free(compare_kit *kit);

/* The scene's facets, ready to run; the truth's records of a case. 0 or CLI_FAILED. */
int cli_compare_scene(const compare_kit *kit, compare_scene *scene);
int cli_compare_records(const compare_kit *kit, compare_case *one);

/* The case of the scene and attitude in these columns of a line; NULL with the message printed. */
compare_case *cli_compare_find(const compare_kit *kit, const compare_table *table,
                               const int column[2]);

/* ---- the judgement ---- */

#define COMPARE_FINDINGS 6
#define COMPARE_TEXT     1024u

/* What explains failures, in a sentence. */
typedef struct compare_finding {
    const char *name; /* "no-shadows" */
    char text[COMPARE_TEXT];
    double factor;      /* on top of it; 1: none */
    uint32_t explained; /* failing cases */
    double rest;        /* of the differences of those, the median share that is left */
} compare_finding;

/* ---- what their facets and images show beside ---- */

#define COMPARE_NAMED 8u /* facets, and images, that are named */
#define COMPARE_TOP   3u /* facets that are named an image */

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
    double sigma_m2; /* what it changes */
    double weight;   /* the same, of what the case is allowed */
    int failed;      /* does its case fail? */
    int way;
} compare_facet;

typedef struct compare_facets {
    uint32_t cases;           /* handed in */
    uint32_t way[FACET_WAYS]; /* facets that differ so */
    uint32_t cosines, turned; /* given; with the other sign */
    double cosine_most;       /* |difference| of those that are not turned round */
    uint32_t worsts;
    compare_facet worst[COMPARE_NAMED]; /* of cases that fail, then what changes most, first */
} compare_facets;

/* An image that agrees with the truth in no way. */
typedef struct compare_image {
    const compare_case *one;
    double agree;                /* share of the pixels that show something */
    uint32_t facet[COMPARE_TOP]; /* that lose most pixels */
    uint32_t lost[COMPARE_TOP];  /* so many; 0: no such facet */
} compare_image;

#define COMPARE_IMAGE_WAYS 10u

typedef struct compare_items {
    uint32_t images, handed, differ;
    uint32_t way[COMPARE_IMAGE_WAYS]; /* images that agree so */
    uint32_t named;
    compare_image image[COMPARE_NAMED];
} compare_items;

typedef struct compare_job {
    const cli_args *args;
    const char *theirs, *facets, *items;
    uint32_t pixels, tier;
    int grade;    /* the least that passes */
    int decibels; /* did they hand in dBsm? */
    compare_kit kit;
    uint32_t asked, given,
        failed; /* cases of the tiers asked for; failed: those not handed in too */
    uint32_t not_numbers, negatives; /* that no finding explains */
    compare_finding finding[COMPARE_FINDINGS];
    uint32_t findings, unexplained;
    int biased; /* a factor that all answers share, each within its class */
    compare_facets by_facet;
    compare_items by_item;
} compare_job;

const char *cli_compare_grade(int grade);

/* What a case is allowed in a class, m2. */
double cli_compare_allowed(const compare_case *one, int grade, uint32_t pixels);

/* Did they pass? */
int cli_compare_passed(const compare_job *job);

/* Is a case of the tiers asked for? */
int cli_compare_asked(const compare_job *job, const compare_case *one);

/* Does a case fail the job? One that was not asked for does not. */
int cli_compare_failed(const compare_job *job, const compare_case *one);

/* What is wrong with a failing case that no finding explains. */
enum compare_lack { LACK_NONE, LACK_ANSWER, LACK_NUMBER, LACK_SIGN, LACK_REASON };
int cli_compare_lack(const compare_job *job, const compare_case *one);

/* Reads the answers and puts every case into its class. 0 or CLI_FAILED. */
int cli_compare_judge(compare_job *job);

/* Finds what explains the failures. 0 or CLI_FAILED. */
int cli_compare_explain(compare_job *job);

/* ---- mistakes ---- */

/* Where a facet is shaded. */
typedef struct mistake_spot {
    const lrcs_brdf *brdf;
    double c;    /* the cosine that is used, 0 .. 1 */
    double peak; /* the largest f_r cos of the case */
} mistake_spot;

/* A case as somebody sees it: from this pose, with these records. */
typedef struct mistake_view {
    const compare_scene *scene;
    const lrcs_facet_record *records;
    double direction[3]; /* unit */
} mistake_view;

/* f_r cos as somebody computes it; `at`: the mistake's. */
typedef double mistake_shade(const mistake_spot *spot, double at);

/* The projected area that somebody sums for a corner (of 0 .. 2) of a facet, a third of the
   facet's, and how they shade it; 0 for none. */
typedef double mistake_area(const mistake_view *view, uint32_t facet, int corner,
                            mistake_spot *spot);

/* A mistake: what is not NULL or 0 is done otherwise. */
typedef struct compare_mistake {
    const char *name, *text;
    mistake_shade *shade;
    double at;
    mistake_area *area;
    int (*turn)(const compare_case *one, const struct compare_mistake *mistake, lrcs_pose *pose);
    int corners;      /* 3: the facet is the mean of what it is at its corners */
    int axes[3];      /* of turn: for x, y, z of s_hat, which component they take, 1 .. 3, negative
                         to mirror it */
    uint32_t without; /* effects that somebody leaves out, lrcs_run_options.without */
    int skins;        /* of facets in one plane the wrong one is seen */
} compare_mistake;

/* The catalogue, ended by a NULL name; the first one is no mistake. */
extern const compare_mistake cli_compare_mistakes[];

/* f_r cos as it should be. */
double cli_mistake_right(const mistake_spot *spot, double at);

/* The area as it should be. */
double cli_mistake_seen(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot);

/* The records of a case, had once already, where of facets in one plane the wrong one is seen. 0 or
   CLI_FAILED with the message printed. */
int cli_compare_skins(const compare_kit *kit, const compare_case *one,
                      const lrcs_run_options *options, lrcs_facet_record *records);

/* sigma of a case with a mistake. 0 or CLI_FAILED with the message printed. */
int cli_compare_answer(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                       double *sigma_m2);

/* ---- what else they handed in ---- */

/* Which facets differ, where job->facets names a file; what the images show in job->items. 0 or
   CLI_FAILED with the message printed. */
int cli_compare_facets(compare_job *job);
int cli_compare_items(compare_job *job);

/* The ways in words, and what the cosines look like; NULL where none were given. */
const char *cli_compare_facet_way(int way);
const char *cli_compare_image_way(size_t way);
const char *cli_compare_cosines(const compare_facets *facets);

/* ---- what is written ---- */

void cli_compare_table(const compare_job *job);
int cli_compare_json(FILE *out, const void *job, lrcs_host_error *error);
int cli_compare_junit(FILE *out, const void *job, lrcs_host_error *error);

#endif
