/* SPDX-License-Identifier: MIT */
/* The search for what explains failing cases: the catalogue of mistakes, and causes that need no
   mistake. */
#ifndef LRCSI_KIT_SEARCH_H
#define LRCSI_KIT_SEARCH_H

#include "host/kit/kit.h"

/* ---- mistakes ---- */

/* A mistake: whatever is not 0 differs from the truth. */
typedef struct lrcsi_mistake {
    const char *name, *text;
    int shade, area, pose; /* mistakes.c: enum mistake_shade, ... */
    double parameter;      /* of the mistake in the shading, as enum mistake_shade states */
    int axes[3]; /* of pose: for x, y, z of s_hat, the component that is used, 1 .. 3, negative to
                    mirror it */
    int corners; /* 3 if the facet is the mean of the values at its corners */
    uint32_t without;   /* effects that are left out, lrcs_run_options.without */
    int wrong_coplanar; /* 1 if of coplanar facets the wrong one is seen */
} lrcsi_mistake;

/* The catalogue, terminated by a NULL name; the first entry is no mistake. */
extern const lrcsi_mistake lrcsi_mistakes[];

/* sigma of a case with a mistake. Status: as lrcs_host_judge. */
int lrcsi_mistake_answer(const lrcs_host_kit *kit, lrcs_host_kit_case *one,
                         const lrcsi_mistake *mistake, double *sigma_m2, lrcs_host_error *error);

/* ---- the search ---- */

typedef struct lrcsi_search {
    lrcs_host_judgement *job;
    lrcs_host_error *error;
    lrcs_host_kit_case **failing; /* not explained yet */
    lrcs_host_kit_case **passing; /* a sample of them */
    uint32_t failing_count, passing_count;
    int any_nonzero; /* 1 if some failing case has an answer other than 0 */
    double weight;   /* number of passing cases that each of the sample stands for */
    /* Room, whose contents no function takes over from another one unless it is given them: */
    double *answer, *other_answer; /* to the failing cases, then to the passing ones */
    double *room;                  /* for sorting */
    unsigned char *explains;       /* for the cases that a cause explains, as below */
} lrcsi_search;

/* 1 if an expected answer explains the one that was given. */
int lrcsi_search_explained(const lrcsi_search *search, const lrcs_host_kit_case *one,
                           double expected);

/* The number of failing cases that a cause explains.
   Given: explains[failing_count], 1 for each case that it explains. */
uint32_t lrcsi_search_explained_cases(const lrcsi_search *search, const unsigned char *explains);

/* Makes a cause a finding with its sentence: the cases that it explains, given as above, are marked
   and no longer among the failing ones. NULL if there is no room for one. */
__attribute__((format(printf, 4, 5))) lrcs_host_finding *
lrcsi_search_finding_add(lrcsi_search *search, const unsigned char *explains, const char *name,
                         const char *format, ...);

/* The median, the upper of the two middle values if their number is even; 0 of an empty list. Sorts
   the values. */
double lrcsi_search_upper_median(double *value, uint32_t count);

/* ---- constant factors ---- */

typedef struct lrcsi_factor {
    double value;
    const char *name, *text;
} lrcsi_factor;

/* The known factor to which a ratio is near; NULL if there is none. */
const lrcsi_factor *lrcsi_factor_find(double ratio);

/* The possible cause of a factor, and its name; pixels: per side, of the images. */
const char *lrcsi_factor_text(double factor, uint32_t pixels);
const char *lrcsi_factor_name(double factor);

/* ---- symptoms ---- */

/* Finds causes that need no mistake of the catalogue: those visible in the table, before the
   search; those that are left, after it. Status: as lrcs_host_judge. */
void lrcsi_symptoms_format(lrcsi_search *search);
int lrcsi_symptoms_rest(lrcsi_search *search);

#endif
