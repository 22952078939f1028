/* SPDX-License-Identifier: MIT */
/* sigma of a prepared scene for a pose: Eq. 2 of Han et al. (2014) over the visible surface. */
#ifndef LRCS_RUN_H
#define LRCS_RUN_H

#include <lrcs/options.h>
#include <lrcs/pose.h>
#include <lrcs/prepare.h>

typedef struct lrcs_effect {
    int on;             /* 1: simulated; 0: left out */
    const char *reason; /* why: constant text */
} lrcs_effect;

/* Flags: the answer is degraded, and the bound widened accordingly; or it was accepted without
   proof. */
enum lrcs_flag {
    LRCS_FLAG_TOLERANCE_NOT_MET = 1 << 0, /* neither the bound nor an accepted estimate does */
    /* lack of memory: a raster instead of clipping, or a coarser raster than requested, or facets
       that were not clipped */
    LRCS_FLAG_MEMORY_FALLBACK = 1 << 1,
    LRCS_FLAG_DEPTH_UNDECIDED = 1 << 2, /* two facets too close at a sample to order by depth */
    LRCS_FLAG_STEPS_SPENT = 1 << 3,     /* lrcs_run_options.steps did not suffice */
    /* the bound exceeds the tolerance; estimate_m2, a heuristic, does not, and the options accept
       the estimate */
    LRCS_FLAG_ACCEPTED_BY_ESTIMATE = 1 << 4,
    /* bound and estimate exceed the tolerance, or there is no estimate; the options accept any
       answer */
    LRCS_FLAG_ACCEPTED_UNJUDGED = 1 << 5
};
const char *lrcs_flag_text(int bit); /* "tolerance_not_met", ... Never NULL. */

/* Notices: facts worth knowing that do not degrade the answer. */
enum lrcs_notice {
    LRCS_NOTICE_BACK_SIDES_VISIBLE = 1 << 0, /* open or inverted mesh */
    LRCS_NOTICE_TESSELLATION_UNKNOWN =
        1 << 1 /* no bound holds for facets in the place of curved shapes: one is no larger than
                  rounding errors, or back-face casters were left out */
};
const char *lrcs_notice_text(int bit); /* one sentence; never NULL */

typedef struct lrcs_budget {
    double visibility_m2;   /* raster or clipping, and what a limit of steps left unknown */
    double tessellation_m2; /* negative: not known */
    double rounding_m2;
} lrcs_budget;

/* The result for one facet. The sigma of a shape evaluated by its closed form is distributed over
   its facets in proportion to what they would reflect. If only a sliver of the shape is lit and
   none of its facets faces the laser, no record contains its sigma. What lies between the
   facets and the true surface of a partly hidden sphere, dome or paraboloid is part of the record
   of a facet beside it. That of the most visible facet of a flat end or disc includes what true
   curved shapes in front leave visible of the whole face, more or less than their facets do. */
typedef struct lrcs_facet_record {
    double area_m2;         /* of the facet itself; 0 for degenerate and omitted ones */
    double cos_theta;       /* of the incidence angle; negative if the back faces the laser */
    double visible_area_m2; /* visible projected area, also of back sides */
    double sigma_m2;
    double sigma_glint_m2; /* the glint part of sigma_m2; the rest is diffuse */
} lrcs_facet_record;

typedef struct lrcs_result {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2;
    double bound_m2; /* proved: |sigma - truth| <= bound, truth being Eq. 2 over the placed
                        facets (over the true shapes where the tessellation is known), their
                        normals curved where the scene's are: notes 1 and 2 of
                        lrcs_sigma_run */
    lrcs_budget budget;
    double estimate_m2;           /* estimated error of a raster's answer; negative: none */
    double curvature_estimate_m2; /* estimated error of the cubature over curved normals, not in the
                                     bound; negative: all facets are flat */
    double projected_area_m2;     /* the whole silhouette */
    double back_side_area_m2;     /* visible projected area of one-sided back sides */
    uint32_t back_side_facets;    /* their number */
    int method;                   /* lrcs_method: the one used, never AUTO */
    const char *method_reason;    /* constant text: why; "as requested" unless auto chose */
    uint32_t resolution;          /* 0: no raster */
    uint32_t facets_total;        /* of the scene */
    uint32_t facets_front;        /* whose front faces the laser */
    uint32_t facets_hidden;       /* of those that could reflect, how many are hidden */
    uint32_t facets_partial;      /* likewise, how many are visible in part */
    lrcs_effect effect[LRCS_EFFECTS]; /* by lrcs_effect_name */
    uint32_t flags, notices;          /* lrcs_flag and lrcs_notice bits */
    uint64_t steps; /* of the visibility computation: note 3 of lrcs_run_options_default */
} lrcs_result;

/* The item buffer: the facet that the laser sees in each pixel (row 0 on top, column 0 left;
   x right, y up), and the square of the observation frame that it covers, relative to the body's
   origin, to rounding. */
typedef struct lrcs_image {
    uint32_t size;                /* N, given, at most 16384; 0: no image requested */
    uint32_t *facet;              /* N * N, room provided by the caller: index, or LRCS_NONE */
    double left_m, top_m, side_m; /* returned */
} lrcs_image;

/* Bytes of work area that lrcs_sigma_run takes at most, for any pose, without an image; an image
   takes as much as method zbuffer at its resolution, if that is more. With less memory a run leaves
   facets unclipped, or uses a raster, or a coarser raster (LRCS_FLAG_MEMORY_FALLBACK; the result
   names the method used), or returns LRCS_E_MEMORY if even the coarsest does not fit. */
size_t lrcs_sigma_need(const lrcs_prepared *prepared, const lrcs_run_options *options);

/* sigma for a pose.
   Given: prepared; pose; options; work.
   Returned: result; records[facet_count] unless NULL; image unless NULL or image->size is 0: then a
   raster of that size is drawn for every method; image->facet has room for it.
   Status: LRCS_OK; LRCS_E_ARGUMENT (options, the image's size or the pose); LRCS_E_MEMORY;
   LRCS_E_NUMBER (the pose, or sigma beyond double range); LRCS_E_LIMIT (more than 2^32 - 2
   candidates in a grid); LRCS_E_UNSUPPORTED (this thread's arithmetic, as lrcs_prepare_run).
   Work: nothing stays in the work area. Every loop is bounded: examples/flight/README.md states the
   most work that a pose can require and what poses require in practice; options->steps sets a close
   limit.
   Notes: 1. With curved normals an integral replaces f_r cos^2 times an area. Its cubature has an
   error of about curvature_estimate_m2, which is not proved and not in the bound.
   2. For a partly visible facet with curved normals, samples determine how much is visible but not
   which part: method zbuffer clips such facets, as method exact does, if there is memory for it;
   otherwise the bound covers every possible part. */
int lrcs_sigma_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                   const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                   lrcs_facet_record *records, lrcs_image *image);

#endif
