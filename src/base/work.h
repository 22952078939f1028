/* SPDX-License-Identifier: MIT */
/* Allocation from the caller's work area: in order, aligned, checked; memory is released only by
   returning to a mark. */
#ifndef LRCSI_WORK_H
#define LRCSI_WORK_H

#include <lrcs/work.h>

#include <stdint.h>

/* Memory for `count` items of `size` bytes, not cleared; NULL if it does not fit (work->peak is
   then the size that would have sufficed so far). A count of 0 gives a valid pointer. */
void *lrcsi_work_take(lrcs_work *work, size_t count, size_t size);

/* The same, every byte zero. */
void *lrcsi_work_take_zero(lrcs_work *work, size_t count, size_t size);

/* Upper bound of the bytes that lrcsi_work_take uses for such a block, for the _need functions.
   Saturates. */
size_t lrcsi_work_bytes(size_t count, size_t size);

/* The same for several blocks of that size. */
size_t lrcsi_work_blocks(size_t blocks, size_t count, size_t size);

/* side * side, saturating. */
size_t lrcsi_work_square(uint32_t side);

/* a + b, saturating at SIZE_MAX. */
size_t lrcsi_work_add(size_t a, size_t b);

/* To release memory, restore `used`: size_t mark = work->used; ... work->used = mark; */

#endif
