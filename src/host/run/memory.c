/* SPDX-License-Identifier: MIT */
/* Blocks and work areas from the heap. It decides how areas grow (at least doubling, a bounded
   number of times), and asks for large pages; it does not depend on what the memory holds. */
#define _DEFAULT_SOURCE 1 /* madvise, and MADV_HUGEPAGE where there is one */
#include "host/run/memory.h"

#include "host/run/levels.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

/* Each attempt has at least twice the memory of the last: 2^11 times the need of the first. */
#define ATTEMPTS 12
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

lrcsi_host_attempt lrcsi_host_attempt_make(lrcsi_host_area *area, size_t need)
{
    return (lrcsi_host_attempt){
        .area = area, .need = need, .left = ATTEMPTS, .status = LRCS_E_MEMORY};
}

int lrcsi_host_attempt_next(lrcsi_host_attempt *attempt, lrcs_host_error *error)
{
    lrcsi_host_area *area = attempt->area;
    if (attempt->status != LRCS_E_MEMORY || attempt->left == 0) {
        return 0;
    }
    if (attempt->left < ATTEMPTS) { /* the last one did not fit */
        size_t twice = attempt->need <= SIZE_MAX / 2 ? 2 * attempt->need : SIZE_MAX;
        attempt->need = attempt->work.peak > twice ? attempt->work.peak : twice;
    }
    if (!area->block || attempt->need > area->size) {
        lrcsi_host_area_free(area);
        area->block = block_make(attempt->need);
        area->size = area->block ? attempt->need : 0;
    }
    if (!area->block) {
        attempt->status = lrcsi_host_fail_memory(error, attempt->need);
        return 0;
    }
    attempt->left--;
    attempt->work = lrcs_work_make(area->block + 1, attempt->need);
    return 1;
}

int lrcsi_host_attempt_keep(lrcsi_host_attempt *attempt, void **blocks)
{
    if (attempt->status == LRCS_OK) {
        block_own(blocks, attempt->area->block);
        *attempt->area = (lrcsi_host_area){NULL, 0};
    }
    lrcsi_host_area_free(attempt->area);
    return attempt->status;
}

void lrcsi_host_area_free(lrcsi_host_area *area)
{
    free(area->block);
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
