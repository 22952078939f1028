/* SPDX-License-Identifier: MIT */
/* Jobs in threads. It decides which worker does which job (the next one, whoever is free), how far
   fast workers may run ahead of slow ones (a ring buffer of slots), and when to stop; it does not
   depend on what the jobs are. The calling thread is a worker too: it hands over results that are
   ready and works if there are none. It does all jobs if the system grants no threads. */
#include "host/run/workers.h"

#include <lrcs/sweep.h>

#include <pthread.h>
#include <stdlib.h>

/* Slots per worker: enough for jobs of unequal length and an occasional slow hand-over. */
#define WORKERS_SLOTS 16u
/* The core keeps no large arrays on the stack; some systems give threads very little. */
#define WORKERS_STACK ((size_t)1 << 20)

typedef struct workers_ring {
    const lrcsi_workers *workers;
    unsigned char *slot; /* of job i: i % window */
    unsigned char *done; /* 1: that slot holds the result of a job */
    uint64_t window;
    uint64_t head, next, end; /* to be taken; to be done; one past the last */
    int stop;
    pthread_mutex_t lock; /* of all above */
    pthread_cond_t room;  /* there is a job to do, or none any more */
    pthread_cond_t ready; /* the slot at the head is done */
} workers_ring;

typedef struct workers_thread {
    workers_ring *ring;
    uint32_t number;
    pthread_t thread;
} workers_thread;

static void *ring_slot(const workers_ring *ring, uint64_t index)
{
    return ring->slot + (size_t)(index % ring->window) * ring->workers->slot_size;
}

static int ring_has_job(const workers_ring *ring)
{
    return !ring->stop && ring->next < ring->end && ring->next - ring->head < ring->window;
}

/* Does the next job; the lock is held before and after. */
static void ring_work(workers_ring *ring, uint32_t worker)
{
    uint64_t index = ring->next++;
    pthread_mutex_unlock(&ring->lock);
    ring->workers->work(ring->workers->context, worker, index, ring_slot(ring, index));
    pthread_mutex_lock(&ring->lock);
    ring->done[index % ring->window] = 1;
    if (index == ring->head) {
        pthread_cond_signal(&ring->ready);
    }
}

static void *workers_thread_run(void *context)
{
    workers_thread *worker = context;
    workers_ring *ring = worker->ring;
    pthread_mutex_lock(&ring->lock);
    while (!ring->stop && ring->next < ring->end) {
        if (ring_has_job(ring)) {
            ring_work(ring, worker->number);
        } else {
            pthread_cond_wait(&ring->room, &ring->lock);
        }
    }
    pthread_mutex_unlock(&ring->lock);
    return NULL;
}

/* Hands over what is at the head; the lock is held before and after. */
static int ring_take(workers_ring *ring)
{
    uint64_t index = ring->head;
    pthread_mutex_unlock(&ring->lock);
    int status = ring->workers->take(ring->workers->context, index, ring_slot(ring, index));
    pthread_mutex_lock(&ring->lock);
    if (status == LRCS_OK) {
        ring->done[index % ring->window] = 0;
        ring->head++;
        pthread_cond_signal(&ring->room);
    }
    return status;
}

/* The calling thread's part, until all is taken or the work ends. */
static int workers_lead(workers_ring *ring)
{
    const volatile sig_atomic_t *cancel = ring->workers->cancel;
    int status = LRCS_OK;
    pthread_mutex_lock(&ring->lock);
    while (ring->head < ring->end && status == LRCS_OK) {
        if (cancel && *cancel) {
            status = LRCS_E_CANCELLED;
        } else if (ring->done[ring->head % ring->window]) {
            status = ring_take(ring);
        } else if (ring_has_job(ring)) {
            ring_work(ring, 0);
        } else {
            pthread_cond_wait(&ring->ready, &ring->lock);
        }
    }
    ring->stop = 1;
    pthread_cond_broadcast(&ring->room);
    pthread_mutex_unlock(&ring->lock);
    return status;
}

/* Starts as many threads as the system grants; only the calling thread receives signals. Returns
   their number. */
static uint32_t workers_start(workers_ring *ring, workers_thread *worker)
{
    sigset_t all;
    sigset_t before;
    pthread_attr_t attributes;
    uint32_t started = 0;
    if (ring->workers->threads == 1 || pthread_attr_init(&attributes) != 0) {
        return 0;
    }
    pthread_attr_setstacksize(&attributes, WORKERS_STACK);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (started + 1 < ring->workers->threads) {
        worker[started] = (workers_thread){.ring = ring, .number = started + 1};
        if (pthread_create(&worker[started].thread, &attributes, workers_thread_run,
                           &worker[started]) != 0) {
            break;
        }
        started++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    return started;
}

/* 1. The ring and its threads.
   2. The calling thread works, and hands over results, until all is taken or the work ends.
   3. After a cancel, jobs that are done are still handed over. */
int lrcsi_workers_run(const lrcsi_workers *workers, uint64_t *done, lrcs_host_error *error)
{
    workers_ring ring = {.workers = workers,
                         .head = workers->first,
                         .next = workers->first,
                         .end = workers->first + workers->count,
                         .window = (uint64_t)WORKERS_SLOTS * workers->threads,
                         .lock = PTHREAD_MUTEX_INITIALIZER,
                         .room = PTHREAD_COND_INITIALIZER,
                         .ready = PTHREAD_COND_INITIALIZER};
    size_t bytes = (size_t)ring.window * workers->slot_size;
    workers_thread *worker = calloc(workers->threads, sizeof *worker);
    ring.slot = calloc((size_t)ring.window, workers->slot_size);
    ring.done = calloc((size_t)ring.window, 1);
    int status = LRCS_OK;
    if (!worker || !ring.slot || !ring.done) {
        status = lrcsi_host_fail_memory(error, bytes);
    } else {
        uint32_t started = workers_start(&ring, worker);
        status = workers_lead(&ring); /* 2 */
        for (uint32_t i = 0; i < started; i++) {
            pthread_join(worker[i].thread, NULL);
        }
        pthread_mutex_lock(&ring.lock); /* 3 */
        int taken = LRCS_OK;
        while (status == LRCS_E_CANCELLED && taken == LRCS_OK && ring.head < ring.next &&
               ring.done[ring.head % ring.window]) {
            taken = ring_take(&ring);
        }
        int whole = ring.head == ring.end; /* nothing was left to cancel */
        pthread_mutex_unlock(&ring.lock);
        if (status == LRCS_E_CANCELLED) {
            status = taken != LRCS_OK ? taken : whole ? LRCS_OK : status;
        }
    }
    *done = ring.head - workers->first;
    free(ring.done);
    free(ring.slot);
    free(worker);
    pthread_cond_destroy(&ring.ready);
    pthread_cond_destroy(&ring.room);
    pthread_mutex_destroy(&ring.lock);
    return status;
}
