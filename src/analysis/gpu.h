/* SPDX-License-Identifier: MIT */
/* The item buffer of graphics hardware: vertices at a chosen precision, snapped to 1/256 pixel,
   facets drawn in order with a depth buffer of a given number of bits. Emulated operation by
   operation as described in lrcs/emulate.h. Nothing here is exact or bounded, and no proof depends
   on it. */
#ifndef LRCSI_GPU_H
#define LRCSI_GPU_H

#include <lrcs/emulate.h>

#include "view/view.h"

/* A corner in the window: in 1/256 pixels, y up; depth from 0 to 1. */
typedef struct lrcsi_gpu_vertex {
    int64_t at[2];
    double depth;
} lrcsi_gpu_vertex;

typedef struct lrcsi_gpu {
    lrcsi_view view; /* as given, but for its window: the one that is drawn */
    uint32_t size;
    int single;      /* 1 if arithmetic is in float */
    double steps;    /* steps of fixed-point depth, 2^bits - 1; 0 for floating point */
    int short_depth; /* 1 if floating-point depth is stored as float */
    lrcsi_gpu_vertex *vertex;
    uint32_t *owner; /* N * N, row 0 at the bottom: the facet, or LRCS_NONE */
    double *depth;   /* N * N, as stored: steps, or a depth */
} lrcsi_gpu;

size_t lrcsi_gpu_need(const lrcs_prepared *prepared, uint32_t size);

/* Draws a view; a window that is narrower than 2^-100 of the scene's radius is enlarged. Status:
   LRCS_OK; LRCS_E_MEMORY. The buffers stay in the work area. */
int lrcsi_gpu_make(const lrcsi_view *view, const lrcs_emulation_options *options, lrcs_work *work,
                   lrcsi_gpu *gpu);

#endif
