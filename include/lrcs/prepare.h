/* SPDX-License-Identifier: MIT */
/* A scene prepared for runs: everything about it that does not depend on direction. */
#ifndef LRCS_PREPARE_H
#define LRCS_PREPARE_H

#include <lrcs/scene.h>

/* Normals, edges, contacts between facets, and proved properties for the planner. Opaque; lives in
   the caller's work area. */
typedef struct lrcs_prepared lrcs_prepared;

/* Bytes of work area that preparing a scene takes: an upper bound for ordinary scenes. If very many
   facets intersect each other, lrcs_prepare_run may return LRCS_E_MEMORY; work->peak is then what
   it needed up to that point, and a larger area is required. */
size_t lrcs_prepare_need(const lrcs_scene *scene);

/* Prepares a scene, which must outlive the result. Coordinates below 2^-300 of the largest one
   count as zero. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 neighbours in a
   list); LRCS_E_INDEX, LRCS_E_NUMBER (a scene not made by lrcs_scene_build); LRCS_E_UNSUPPORTED
   (this thread or build does not round doubles to nearest as IEEE 754 defines, fuses products and
   sums, or flushes subnormal numbers to zero: the proofs would not hold). */
int lrcs_prepare_run(const lrcs_scene *scene, lrcs_work *work, const lrcs_prepared **prepared);

#endif
