/* SPDX-License-Identifier: MIT */
/* Runs many poses of one prepared scene, or of one scene per pose, in POSIX threads (link with
   -pthread). The results do not depend on the number of threads: they are those of a loop over
   lrcs_host_scene_run, to the bit wherever memory suffices, in the same order. */
#ifndef LRCS_SWEEP_H
#define LRCS_SWEEP_H

#include <lrcs/host.h>

#include <signal.h>

/* Stopped on request. In addition to the codes of lrcs/status.h and LRCS_E_SYSTEM. */
#define LRCS_E_CANCELLED (-65)

/* Callback: makes pose number `index`. Called from every thread: it must not modify shared data.
   Status: LRCS_OK; any other status fails that pose. */
typedef int lrcs_host_sweep_pose(void *context, uint64_t index, lrcs_pose *pose);

/* Callback: makes and prepares the scene of pose `index`, if each pose has its own. Called from
   every thread, as above; the sweep frees the scene. Status: LRCS_OK; any other status, with its
   sentence, fails that pose; then there must be nothing to free. */
typedef int lrcs_host_sweep_scene(void *context, uint64_t index, lrcs_host_scene *scene,
                                  lrcs_host_error *error);

/* Callback: takes one result. Called on the thread that called lrcs_host_sweep_run, in order of
   index, once per index. uncertainty: of the materials; glint: of facets too coarse for it; each
   NULL if it was not asked for. Status: LRCS_OK; any other status ends the sweep with it and its
   error. */
typedef int lrcs_host_sweep_take(void *context, uint64_t index, const lrcs_pose *pose,
                                 const lrcs_result *result, const lrcs_uncertainty *uncertainty,
                                 const lrcs_host_glint_sum *glint, lrcs_host_error *error);

typedef struct lrcs_host_sweep {
    uint64_t first, count; /* poses first .. first + count - 1 */
    uint32_t threads;      /* at most 1024, including the caller's own; 0: one per processor */
    lrcs_host_sweep_pose *pose;
    lrcs_host_sweep_scene *scene; /* NULL: all poses use the scene passed to the sweep */
    lrcs_host_sweep_take *take;
    int refine; /* run poses again at finer divisions of curved shapes where these make them miss
                   the tolerance, for a scene read with a division; glint is of its own facets */
    const lrcs_uncertainty_options *uncertainty; /* NULL: that of materials is not wanted */
    const lrcs_host_glint *glint; /* as for lrcs_host_glint_sum_make; NULL: not wanted */
    uint32_t glint_count;
    void *context;                       /* passed to all callbacks */
    const volatile sig_atomic_t *cancel; /* set by a signal handler or by `take`, for example: if
                                            not 0, the sweep stops after the running poses;
                                            or NULL */
} lrcs_host_sweep;

/* Runs the poses of a sweep.
   Given: a prepared scene (NULL if sweep->scene makes the scenes); options of each run; sweep.
   Returned: done unless NULL, also on failure: the first `done` poses were taken.
   Status: LRCS_OK; LRCS_E_CANCELLED; LRCS_E_ARGUMENT (threads, first + count, or a scene that
   is not prepared); LRCS_E_SYSTEM (memory); as
   lrcs_host_scene_run or `pose` for the first pose that fails, whose number the sentence states:
   all poses before it were taken, for any number of threads; as `take`.
   Work: one work area per thread, which grows as the poses need it; a queue of results whose length
   does not depend on the number of poses. With `glint` and `uncertainty` each pose is run twice. If
   the system refuses threads, the sweep runs with fewer; if a pose runs out of memory, that pose
   and the remaining ones are run by half as many threads. */
int lrcs_host_sweep_run(const lrcs_host_scene *scene, const lrcs_run_options *options,
                        const lrcs_host_sweep *sweep, uint64_t *done, lrcs_host_error *error);

/* The pose after rotating the body by an angle about one of its own axes: R = R_pose R(axis, deg),
   and the direction accordingly. Multiples of 90 deg about a coordinate axis are exact.
   Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (an axis of zero). */
int lrcs_host_pose_turn(const lrcs_pose *pose, const double axis[3], double deg, lrcs_pose *turned);

#endif
