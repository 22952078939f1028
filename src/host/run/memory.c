/* SPDX-License-Identifier: MIT */
/* Blocks and work areas from the heap. It decides how areas grow (at least doubling, a bounded
   number of times), and asks for large pages; it does not depend on what the memory holds. */
#define _DEFAULT_SOURCE 1 /* madvise, and MADV_HUGEPAGE where there is one */
#include "host/run/memory.h"

#include "host/run/refine.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

#define STEP_TRIES 12
/* The large pages of most machines that have any; with others the request has no effect. */
#define LARGE_PAGE ((size_t)1 << 21)

/* The link before each block; what follows it is aligned for anything. */
typedef struct host_block {
    _Alignas(max_align_t) struct host_block *next;
} host_block;

/* As malloc. The whole large pages within a block are requested as such: a block that is filled for
   the first time then causes one page fault where it would cause 512, and random accesses miss the
   translation cache less often. It takes more memory where a block is used only here and there. */
static void *memory_take(size_t bytes)
{
    unsigned char *block = malloc(bytes);
#ifdef MADV_HUGEPAGE
    size_t before = (LARGE_PAGE - (uintptr_t)block % LARGE_PAGE) % LARGE_PAGE;
    if (block && bytes >= before + LARGE_PAGE) {
        size_t within = (bytes - before) / LARGE_PAGE * LARGE_PAGE;
        (void)madvise(block + before, within, MADV_HUGEPAGE); /* may be refused: no harm */
    }
#endif
    return block;
}

/* A block not yet owned, or NULL. */
static host_block *block_make(size_t bytes)
{
    return bytes <= SIZE_MAX - sizeof(host_block) ? memory_take(sizeof(host_block) + bytes) : NULL;
}

static void block_own(void **blocks, host_block *block)
{
    block->next = *blocks;
    *blocks = block;
}

void *lrcsi_host_take(lrcs_host_scene *scene, size_t count, size_t size)
{
    size_t bytes = count <= SIZE_MAX / size ? count * size : SIZE_MAX;
    host_block *block = block_make(bytes);
    if (!block) {
        return NULL;
    }
    block_own(&scene->blocks, block);
    return memset(block + 1, 0, bytes);
}

char *lrcsi_host_copy(lrcs_host_scene *scene, const char *text, size_t size)
{
    char *copy = lrcsi_host_take(scene, size + 1, 1);
    if (copy) {
        memcpy(copy, text, size);
    }
    return copy;
}

/* The size of the next work area for a step that did not fit. */
static size_t step_grown(size_t need, const lrcs_work *work)
{
    size_t twice = need <= SIZE_MAX / 2 ? 2 * need : SIZE_MAX;
    return work->peak > twice ? work->peak : twice;
}

int lrcsi_host_step_run(void **blocks, size_t need, lrcsi_host_step *step, void *context,
                        lrcs_host_error *error)
{
    int status = LRCS_E_MEMORY;
    for (int i = 0; i < STEP_TRIES && status == LRCS_E_MEMORY; i++) {
        host_block *block = block_make(need);
        if (!block) {
            return lrcsi_host_fail_memory(error, need);
        }
        lrcs_work work = lrcs_work_make(block + 1, need);
        status = step(context, &work);
        if (status == LRCS_OK) {
            block_own(blocks, block);
        } else {
            free(block);
        }
        need = step_grown(need, &work);
    }
    return status;
}

int lrcsi_host_area_run(lrcsi_host_area *area, size_t need, lrcsi_host_step *step, void *context,
                        lrcs_host_error *error)
{
    int status = LRCS_E_MEMORY;
    for (int i = 0; i < STEP_TRIES && status == LRCS_E_MEMORY; i++) {
        if (need > area->size) {
            lrcsi_host_area_free(area);
            area->bytes = memory_take(need);
            area->size = area->bytes ? need : 0;
        }
        if (need > area->size) {
            return lrcsi_host_fail_memory(error, need);
        }
        lrcs_work work = lrcs_work_make(area->bytes, need);
        status = step(context, &work);
        need = step_grown(need, &work);
    }
    return status;
}

void lrcsi_host_area_free(lrcsi_host_area *area)
{
    free(area->bytes);
    *area = (lrcsi_host_area){NULL, 0};
}

double lrcsi_host_seconds(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void lrcsi_host_free(void *blocks)
{
    host_block *block = blocks;
    while (block) {
        host_block *next = block->next;
        free(block);
        block = next;
    }
}

void lrcs_host_scene_free(lrcs_host_scene *scene)
{
    lrcsi_host_levels_free(scene->levels);
    lrcsi_host_free(scene->blocks);
    for (uint32_t i = 0; i < scene->notices.count; i++) {
        free(scene->notices.text[i]);
    }
    free(scene->notices.text);
    memset(scene, 0, sizeof *scene);
}
