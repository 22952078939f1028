/* SPDX-License-Identifier: MIT */
/* Other engines on the same mesh from the same directions: programs that draw pictures by OpenGL
   (gl_lrcs) and by Embree (embree_lrcs). They are not part of this repository; bench measures them
   if --peers names the folder that has them. */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "bench/cell.h"

/* The programs. */
enum bench_peer { BENCH_LLVMPIPE, BENCH_EMBREE };

/* Runs one of a folder's programs on a binary STL file at size x size pixels.
   Returned: its poses' times on the wall; build: its tree's time, 0 for none. A program that is not
   there, or fails, leaves no samples. */
void bench_peer_run(const char *folder, int peer, const char *stl, uint32_t size, double limit_s,
                    bench_cell *cell, double *build);

#endif
