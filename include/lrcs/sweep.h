/* SPDX-License-Identifier: MIT */
/* Many poses over one prepared scene, or each over its own, in POSIX threads (link with -pthread).
   What comes out does not depend on the number of threads: it is what a loop over
   lrcs_host_scene_run gives, to the bit wherever memory suffices, and comes in the same order. */
#ifndef LRCS_SWEEP_H
#define LRCS_SWEEP_H

#include <lrcs/host.h>

#include <signal.h>

/* Stopped because it was asked to. Beside the codes of lrcs/status.h and LRCS_E_SYSTEM. */
#define LRCS_E_CANCELLED (-65)

/* Says where pose number `index` is. Called from every thread: it may only read what it shares.
   Status: LRCS_OK; any other one fails that pose. */
typedef int lrcs_host_sweep_pose(void *context, uint64_t index, lrcs_pose *pose);

/* Makes the scene of pose `index`, prepared, where each has its own. Called from every thread, as
   above; the sweep frees what it makes. Status: LRCS_OK; any other one, with its sentence, fails
   that pose, and leaves nothing to be freed. */
typedef int lrcs_host_sweep_scene(void *context, uint64_t index, lrcs_host_scene *scene,
                                  lrcs_host_error *error);

/* Takes one result. Called on the thread that called lrcs_host_sweep_run, in order of index, each
   index once. Status: LRCS_OK; any other one ends the sweep with that status and its error. */
typedef int lrcs_host_sweep_take(void *context, uint64_t index, const lrcs_pose *pose,
                                 const lrcs_result *result, lrcs_host_error *error);

typedef struct lrcs_host_sweep {
    uint64_t first, count; /* poses first .. first + count - 1 */
    uint32_t threads;      /* at most 1024, the caller's own among them; 0: one a processor */
    lrcs_host_sweep_pose *pose;
    lrcs_host_sweep_scene *scene; /* NULL: all poses are over the scene that is given */
    lrcs_host_sweep_take *take;
    void *context;                       /* handed to all of them */
    const volatile sig_atomic_t *cancel; /* set by a signal handler or by `take`, say: not 0 stops
                                            the sweep after the poses that are running; or NULL */
} lrcs_host_sweep;

/* Runs them.
   Given: a prepared scene (NULL where sweep->scene makes them); options of each run; sweep.
   Returned: done unless NULL, also on failure: the first `done` poses were taken.
   Status: LRCS_OK; LRCS_E_CANCELLED; LRCS_E_ARGUMENT; LRCS_E_SYSTEM (memory); as
   lrcs_host_scene_run or `pose` for the first pose that fails, whose number the sentence says: all
   before it were taken, whatever the number of threads; as `take`.
   Work: for each thread a work area that grows as the poses need it; a bounded queue of results,
   however many poses there are. Threads that the system refuses are done without, and where a pose
   runs short of memory the rest, itself included, is run by half as many. */
int lrcs_host_sweep_run(const lrcs_host_scene *scene, const lrcs_run_options *options,
                        const lrcs_host_sweep *sweep, uint64_t *done, lrcs_host_error *error);

/* The pose after the body has turned by an angle about one of its own axes: R = R_pose R(axis,
   deg), and the direction accordingly. Multiples of 90 deg about a coordinate axis are exact.
   Status: LRCS_OK; LRCS_E_NUMBER (not finite); LRCS_E_ARGUMENT (an axis of zero). */
int lrcs_host_pose_turn(const lrcs_pose *pose, const double axis[3], double deg, lrcs_pose *turned);

#endif
