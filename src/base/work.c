/* SPDX-License-Identifier: MIT */
/* The bump arena over the caller's bytes. It decides alignment and refuses what does not fit;
   it never grows, and does not know what is stored in it. */
#include "base/work.h"

#include <stdint.h>
#include <string.h>

lrcs_work lrcs_work_make(void *bytes, size_t size)
{
    lrcs_work work = {bytes, bytes ? size : 0, 0, 0};
    return work;
}

size_t lrcsi_work_add(size_t a, size_t b)
{
    return a > SIZE_MAX - b ? SIZE_MAX : a + b;
}

size_t lrcsi_work_bytes(size_t count, size_t size)
{
    if (size != 0 && count > SIZE_MAX / size) {
        return SIZE_MAX;
    }
    size_t bytes = count * size;
    return lrcsi_work_add(bytes > 0 ? bytes : 1, LRCS_WORK_ALIGN - 1);
}

size_t lrcsi_work_blocks(size_t blocks, size_t count, size_t size)
{
    size_t bytes = lrcsi_work_bytes(count, size);
    return blocks > 0 && bytes > SIZE_MAX / blocks ? SIZE_MAX : blocks * bytes;
}

size_t lrcsi_work_square(uint32_t side)
{
    return side != 0 && side > SIZE_MAX / side ? SIZE_MAX : (size_t)side * side;
}

/* Bytes from `at` to the next aligned address. */
static size_t padding(const unsigned char *at)
{
    return (size_t)(-(uintptr_t)at & (LRCS_WORK_ALIGN - 1));
}

void *lrcsi_work_take(lrcs_work *work, size_t count, size_t size)
{
    if (count == 0 || size == 0) { /* a block of no bytes still has an address of its own */
        count = size = 1;
    }
    size_t pad = work->bytes ? padding(work->bytes + work->used) : 0;
    size_t end = lrcsi_work_bytes(count, size);
    end =
        end == SIZE_MAX ? SIZE_MAX : lrcsi_work_add(lrcsi_work_add(work->used, pad), count * size);
    if (end > work->peak) {
        work->peak = end;
    }
    if (end > work->size) {
        return NULL;
    }
    void *block = work->bytes + work->used + pad;
    work->used = end;
    return block;
}

void *lrcsi_work_take_zero(lrcs_work *work, size_t count, size_t size)
{
    void *block = lrcsi_work_take(work, count, size);
    if (block && count != 0 && size != 0) {
        memset(block, 0, count * size);
    }
    return block;
}
