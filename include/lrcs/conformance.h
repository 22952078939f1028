/* SPDX-License-Identifier: MIT */
/* Conformance kits: scenes, attitudes and the truth of each case in a folder, as lrcs/kit.h writes
   them; and the judgement of another implementation's answers: the class of each case, and
   why those fail that do. An explanation is not a proof: it says how many cases it explains. */
#ifndef LRCS_CONFORMANCE_H
#define LRCS_CONFORMANCE_H

#include <lrcs/load.h>

/* ---- kits ---- */

#define LRCS_HOST_KIT_TIERS          5   /* from a plate to hard cases */
#define LRCS_HOST_KIT_NAME           32u /* size of names of scenes, attitudes and materials */
#define LRCS_HOST_KIT_MATERIALS_TEXT "materials.csv"
#define LRCS_HOST_KIT_CASES_TEXT     "cases.csv"

/* The classes of answers, the strictest first. */
enum lrcs_host_grade {
    LRCS_HOST_GRADE_EXACT,
    LRCS_HOST_GRADE_FLOAT,  /* what single precision may be off by */
    LRCS_HOST_GRADE_RASTER, /* what a raster of so many pixels may be off by */
    LRCS_HOST_GRADE_FAIL,
    LRCS_HOST_GRADE_MISSING,
    LRCS_HOST_GRADES
};

/* A case: a scene from an attitude, its truth, and the answer to it. */
typedef struct lrcs_host_kit_case {
    char attitude[LRCS_HOST_KIT_NAME];
    uint32_t scene; /* index in the kit */
    int tier;
    double quaternion[4], direction[3], azel_deg[2];
    double sigma_m2, bound_m2; /* the truth */
    double float_m2;           /* what single precision may be off by in addition */
    double edge_m2;        /* what a raster may be off by in addition, times its pixels per side */
    double side_m;         /* of the square that is shown */
    uint32_t image;        /* side of its pictures in pixels, 0 for none */
    double answer_m2;      /* sigma that was answered; may be NAN */
    double answer_printed; /* the number in the table of answers: in dBsm if that is its unit */
    int given;             /* 1 if there is an answer */
    int grade;             /* lrcs_host_grade */
    int explained;         /* the finding that explains it, from 1; 0 for none */
    lrcs_pose pose;
    lrcs_facet_record *records; /* the truth's; NULL until they are needed */
    double peak;                /* their largest f_r cos */
} lrcs_host_kit_case;

typedef struct lrcs_host_kit_scene {
    char name[LRCS_HOST_KIT_NAME];
    int tier, loaded;
    uint32_t first, count; /* cases */
    lrcs_host_scene host;  /* prepared once it is needed */
    lrcs_point *normal;    /* of vertices: sums of the normals of adjacent facets */
} lrcs_host_kit_scene;

typedef struct lrcs_host_kit {
    const char *folder;
    lrcs_binding *binding;
    char (*material)[LRCS_HOST_KIT_NAME];
    uint32_t bindings, cases, scenes;
    lrcs_host_kit_case *list;
    lrcs_host_kit_scene *scene;
} lrcs_host_kit;

/* Reads the tables of a kit. Nothing of it is taken from this program, so that an older kit gives
   the same judgement as before. Returned: kit, to be freed in any case; folder must outlive it.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT; LRCS_E_SYNTAX, LRCS_E_NUMBER, LRCS_E_NAME: the
   sentence names the line. */
int lrcs_host_kit_read(const char *folder, lrcs_host_kit *kit, lrcs_host_error *error);
void lrcs_host_kit_free(lrcs_host_kit *kit);

/* ---- the judgement ---- */

/* A cause of failures, described in a sentence. */
#define LRCS_HOST_FINDINGS 6
typedef struct lrcs_host_finding {
    const char *name; /* "no-shadows" */
    char text[1024];
    double factor;         /* a constant factor in addition; 1 for none */
    uint32_t explained;    /* number of failing cases that it explains */
    double residual_share; /* median share of their differences that remains */
} lrcs_host_finding;

/* How the visible area of a facet differs: as it was answered, against the truth. */
enum lrcs_host_facet_kind {
    LRCS_HOST_FACET_SHOWN,     /* visible; hidden in truth */
    LRCS_HOST_FACET_LOST,      /* hidden; visible in truth */
    LRCS_HOST_FACET_WHOLE,     /* entirely visible; partly hidden in truth */
    LRCS_HOST_FACET_PART,      /* partly hidden; entirely visible in truth */
    LRCS_HOST_FACET_LARGER,    /* larger than all of the facet */
    LRCS_HOST_FACET_ELSEWHERE, /* partly hidden, by another area than in truth */
    LRCS_HOST_FACET_KINDS
};
#define LRCS_HOST_KIT_NAMED 8u /* number of facets, and of images, that are named */
#define LRCS_HOST_KIT_TOP   3u /* number of facets named for each image */
/* Conventions for the rows, columns and facet numbers of images; the first one is the kit's. */
#define LRCS_HOST_IMAGE_CONVENTIONS 10u

typedef struct lrcs_host_kit_facet {
    const lrcs_host_kit_case *kit_case;
    uint32_t facet;
    double answer_m2, truth_m2;
    double sigma_m2; /* the change of sigma */
    double weight;   /* the same, as a share of the case's allowed error */
    int failed;      /* 1 if its case fails */
    int kind;        /* lrcs_host_facet_kind */
} lrcs_host_kit_facet;

typedef struct lrcs_host_kit_facets {
    uint32_t cases;                             /* that have facets */
    uint32_t kind_count[LRCS_HOST_FACET_KINDS]; /* number of facets with each kind of difference */
    uint32_t cosines, cosines_negated; /* number of cosines; of those, with the opposite sign */
    double cosine_error_max;           /* largest |difference|, without those of opposite sign */
    uint32_t worst_count;
    lrcs_host_kit_facet worst[LRCS_HOST_KIT_NAMED]; /* of failing cases first, then by the change of
                                                       sigma, the largest first */
} lrcs_host_kit_facets;

/* An image that does not agree with the truth in any of the conventions. */
typedef struct lrcs_host_kit_image {
    const lrcs_host_kit_case *kit_case;
    double agree_share;                /* share of the non-empty pixels that agree */
    uint32_t facet[LRCS_HOST_KIT_TOP]; /* the facets that lose most pixels */
    uint32_t lost[LRCS_HOST_KIT_TOP];  /* number of lost pixels; 0: no such facet */
} lrcs_host_kit_image;

typedef struct lrcs_host_kit_items {
    uint32_t images;        /* number of cases that have an image */
    uint32_t images_found;  /* of those, how many were answered with one */
    uint32_t images_differ; /* of those, how many do not agree in any convention */
    uint32_t convention_count[LRCS_HOST_IMAGE_CONVENTIONS]; /* of those that agree in each */
    uint32_t named;
    lrcs_host_kit_image image[LRCS_HOST_KIT_NAMED]; /* the first `named` of those that differ */
} lrcs_host_kit_items;

typedef struct lrcs_host_judgement {
    uint32_t pixels, tier; /* given: the side of their raster; tiers 1 .. tier are asked for */
    int grade;             /* given: the lowest class that passes, up to RASTER */
    lrcs_host_kit kit;     /* given */
    int decibels;          /* 1 if the answers are in dBsm */
    uint32_t asked, given, failed;   /* cases of the tiers asked for; failed: also missing ones */
    uint32_t not_numbers, negatives; /* failing cases that no finding explains */
    lrcs_host_finding finding[LRCS_HOST_FINDINGS];
    uint32_t findings, unexplained;
    int biased; /* 1 if all answers share a factor although each is within its class */
    lrcs_host_kit_facets by_facet;
    lrcs_host_kit_items by_item;
} lrcs_host_judgement;

/* Reads a table of answers (columns scene, attitude, and sigma_m2 or sigma_dbsm) and assigns every
   case to its class; then finds the causes of the failures.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT; LRCS_E_SYNTAX, LRCS_E_NUMBER, LRCS_E_NAME: the
   sentence names the line; as lrcs_host_scene_read, lrcs_host_scene_prepare and
   lrcs_host_scene_run. */
int lrcs_host_judge(lrcs_host_judgement *judgement, const char *path, lrcs_host_error *error);
int lrcs_host_judge_explain(lrcs_host_judgement *judgement, lrcs_host_error *error);

/* Compares their visible areas with the truth's, of a table with columns scene, attitude, facet,
   visible_area_m2 and perhaps cos_theta; and the item images NAME.ATTITUDE.item.u32 in a folder.
   These only explain: the verdict is by sigma alone. Status: as lrcs_host_judge. */
int lrcs_host_judge_facets(lrcs_host_judgement *judgement, const char *path,
                           lrcs_host_error *error);
int lrcs_host_judge_items(lrcs_host_judgement *judgement, const char *folder,
                          lrcs_host_error *error);

/* The allowed error of a case in a class, m2; 1 if the answers passed; 1 if a case belongs to the
   tiers asked for; 1 if it fails, which one that was not asked for does not. */
double lrcs_host_judge_allowed(const lrcs_host_kit_case *one, int grade, uint32_t pixels);
int lrcs_host_judge_passed(const lrcs_host_judgement *judgement);
int lrcs_host_judge_asked(const lrcs_host_judgement *judgement, const lrcs_host_kit_case *one);
int lrcs_host_judge_failed(const lrcs_host_judgement *judgement, const lrcs_host_kit_case *one);

/* Why a failing case has no finding that explains it. */
enum lrcs_host_unexplained {
    LRCS_HOST_UNEXPLAINED_NONE,    /* it does not fail, or is explained */
    LRCS_HOST_UNEXPLAINED_MISSING, /* there is no answer */
    LRCS_HOST_UNEXPLAINED_NOT_A_NUMBER,
    LRCS_HOST_UNEXPLAINED_NEGATIVE,
    LRCS_HOST_UNEXPLAINED_UNKNOWN /* the cause was not found */
};
int lrcs_host_judge_unexplained(const lrcs_host_judgement *judgement,
                                const lrcs_host_kit_case *one);

/* A class, a kind of difference and a convention in words; a verdict on the cosines, NULL if there
   were none. */
const char *lrcs_host_grade_text(int grade);
const char *lrcs_host_facet_kind_text(int kind);
const char *lrcs_host_image_convention_text(int convention);
const char *lrcs_host_cosines_text(const lrcs_host_kit_facets *facets);

#endif
