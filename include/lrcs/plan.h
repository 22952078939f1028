/* SPDX-License-Identifier: MIT */
/* The plan of a sweep: which poses of which variants of a scene it runs. Its rows, numbered from 0,
   are all combinations of what varies; the last quantity varies fastest. */
#ifndef LRCS_PLAN_H
#define LRCS_PLAN_H

#include <lrcs/load.h>
#include <lrcs/track.h>

#define LRCS_HOST_PLAN_AXES    8
#define LRCS_HOST_PLAN_COLUMNS 20

/* Decimal numbers A, A + STEP, .. as integer multiples of a power of ten: value i is the double
   nearest to the decimal number, so that no error accumulates. */
typedef struct lrcs_host_range {
    int64_t first, step; /* (first + i step) / 10^decimals */
    uint64_t count;
    int decimals;
} lrcs_host_range;
double lrcs_host_range_at(const lrcs_host_range *range, uint64_t i);

/* What gives the poses of each scene. */
enum lrcs_host_plan_kind {
    LRCS_HOST_PLAN_FIXED, /* one pose: only the scene varies */
    LRCS_HOST_PLAN_AZEL,
    LRCS_HOST_PLAN_EULER,
    LRCS_HOST_PLAN_ROTATE,
    LRCS_HOST_PLAN_SPHERE,
    LRCS_HOST_PLAN_TRACK
};

/* A quantity that varies. */
typedef struct lrcs_host_plan_axis {
    const char *key; /* of lrcs_host_plan_text: "az", "vary" */
    char name[128];  /* of its column: "az_deg", "foil.A" */
    lrcs_host_range range;
    char subject[100]; /* of an axis of the scene: the part or material */
    int parameter;     /* and which of its numbers */
} lrcs_host_plan_axis;

typedef struct lrcs_host_plan {
    lrcs_host_plan_axis axis[LRCS_HOST_PLAN_AXES]; /* those of the scene before those of the pose */
    uint32_t axes, scene_axes;                     /* scene_axes: without the joints of a track */
    int kind;                                      /* lrcs_host_plan_kind */
    lrcs_pose base;                                /* of FIXED and ROTATE */
    char sequence[4];                              /* of EULER */
    double about[3];                               /* of ROTATE: the axis, body frame */
    lrcs_host_track track;                         /* of TRACK; owned */
    uint64_t poses;                                /* of each scene */
    uint64_t rows;                                 /* of all scenes, at most 2^53 */
    uint32_t columns;                              /* values of a row: those of its axes, then of a
                                                      track the joints and the time, then of a track
                                                      or sphere the direction to the laser */
    const char *column[LRCS_HOST_PLAN_COLUMNS];    /* their names */
} lrcs_host_plan;

/* One thing that varies, or the pose, as key and text. RANGE is A:B:STEP, both ends included, or
   one number:
     az, el      RANGE, deg
     euler       SEQ:a,b,c, three RANGEs, deg (lrcs_pose_from_euler)
     rotate      AXIS:RANGE, deg: turns about x, y, z or u,v,w of the body, from the pose
     sphere      N: so many directions of a spherical Fibonacci lattice
     joint       PART:RANGE, deg; parts as NAME,NAME or * turn together
     vary        MATERIAL.KEY:RANGE with KEY A, B, s or m; PART.KEY:RANGE with KEY size_x, size_y,
                 size_z, radius, radius2, length (m) or half_angle_deg
     direction, azel, euler, quaternion    the pose (lrcs_host_pose_read); without one +z */
typedef struct lrcs_host_plan_text {
    const char *key, *text;
} lrcs_host_plan_text;

/* 1 if it is a key of lrcs_host_plan_text. */
int lrcs_host_plan_takes(const char *key);

/* Makes a plan. `joint` and `vary` may be repeated; of the others that give poses only one is
   taken: az and el, else rotate, else sphere, else a track, else euler, else the pose.
   Given: given[count], whose keys must outlive the plan; other keys than those above and texts that
   are NULL are ignored; a track, or NULL: the plan takes over its memory.
   Returned: plan, to be freed in any case.
   Status: LRCS_OK; LRCS_E_ARGUMENT: the sentence begins with the key of the faulty text;
   LRCS_E_LIMIT (too many axes or rows); LRCS_E_EMPTY (nothing varies). */
int lrcs_host_plan_make(const lrcs_host_plan_text *given, int count, const lrcs_host_track *track,
                        lrcs_host_plan *plan, lrcs_host_error *error);
void lrcs_host_plan_free(lrcs_host_plan *plan);

/* Checks that the parts, materials and values of a plan fit the scene. Status: LRCS_OK;
   LRCS_E_ARGUMENT: as above. */
int lrcs_host_plan_check(const lrcs_host_plan *plan, const lrcs_host_scene *base,
                         lrcs_host_error *error);

/* A pose from its text: kind is "direction" (x,y,z), "azel" (AZ,EL, deg), "euler" (SEQ:a,b,c, deg)
   or "quaternion" (w,x,y,z). Status: LRCS_OK; LRCS_E_NAME (the kind); LRCS_E_ARGUMENT: the sentence
   begins with the kind. */
int lrcs_host_pose_read(const char *kind, const char *text, lrcs_pose *pose,
                        lrcs_host_error *error);

/* ---- the rows of a plan ---- */

/* The place of a row along an axis; its values; its pose. Status: as lrcs_pose_from_direction,
   lrcs_pose_from_euler and lrcs_host_pose_turn. */
uint64_t lrcs_host_plan_place(const lrcs_host_plan *plan, uint64_t row, uint32_t axis);
void lrcs_host_plan_values(const lrcs_host_plan *plan, uint64_t row,
                           double value[LRCS_HOST_PLAN_COLUMNS]);
int lrcs_host_plan_pose(const lrcs_host_plan *plan, uint64_t row, lrcs_pose *pose);

/* 1 if the scene varies: rows have other scenes than the one that was read. */
int lrcs_host_plan_varies_scene(const lrcs_host_plan *plan);

/* The prepared scene of a row, made from `base`, which was read and must outlive it. Any thread may
   call it. Status: as lrcs_host_scene_vary and lrcs_host_scene_prepare. */
int lrcs_host_plan_scene(const lrcs_host_plan *plan, uint64_t row, const lrcs_host_scene *base,
                         const lrcs_build_options *build, lrcs_host_scene *scene,
                         lrcs_host_error *error);

/* 1 if all rows are directions of one sphere, each of the same solid angle: their mean is that over
   all directions. */
int lrcs_host_plan_is_sphere(const lrcs_host_plan *plan);

/* 1 if azimuth and elevation both vary, elevation within the poles: a map. And the solid angle that
   a row of a map stands for, up to a common factor: along azimuth all rows have the same width,
   except the ends of a full turn, which are one direction; along elevation the width is a
   difference of sines, which ends at the poles. */
int lrcs_host_plan_is_map(const lrcs_host_plan *plan);
double lrcs_host_plan_weight(const lrcs_host_plan *plan, uint64_t row);

/* Finds the peaks: rows with sigma > 0 that are brighter than all their neighbours, of equal rows
   the first. Neighbours are one step away along the axes, diagonals included; a range of a full
   turn is closed, and at a pole of azimuth and elevation all azimuths are one direction. On a
   sphere they are the next points around, on a track the rows before and after.
   Given: sigma and bound of every row; most > 0.
   Returned: the brightest of them, at most `most`, the brightest first; how many. */
uint32_t lrcs_host_plan_peaks(const lrcs_host_plan *plan, const double (*row)[2], uint32_t most,
                              uint64_t *peak);

#endif
