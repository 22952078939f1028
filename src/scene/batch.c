/* SPDX-License-Identifier: MIT */
/* Sorts facets by material, and computes their normals, unit normals and areas. This decides the
   order in which facets are summed. */
#include "scene/batch.h"

#include <math.h>

#include "base/length.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "scene/normal.h"

/* The normals of up to LRCSI_LANES facets, before they are scaled to unit length. */
typedef struct batch_normals {
    double high[3][LRCSI_LANES], low[3][LRCSI_LANES];
    double length[LRCSI_LANES];
    double half[LRCSI_LANES]; /* area of the facet = length * half */
} batch_normals;

/* Unit normals N / |N| and areas |N| / 2, where the relative error of N is 2^-90. Writes all
   LRCSI_LANES elements. */
static void normals_finish(const batch_normals *restrict n, double *restrict x, double *restrict y,
                           double *restrict z, double *restrict area)
{
    for (int i = 0; i < LRCSI_LANES; i++) {
        const double high[3] = {n->high[0][i], n->high[1][i], n->high[2][i]};
        const double low[3] = {n->low[0][i], n->low[1][i], n->low[2][i]};
        lrcsi_inverse inverse = lrcsi_length_inverse(high, low, n->length[i]);
        x[i] = lrcsi_inverse_times(&inverse, high[0], low[0]).hi;
        y[i] = lrcsi_inverse_times(&inverse, high[1], low[1]).hi;
        z[i] = lrcsi_inverse_times(&inverse, high[2], low[2]).hi;
        area[i] = inverse.length * n->half[i];
    }
}

/* For each packet: the normals of its facets, then their unit normals and areas. Last, the normals
   of skipped facets, which are in no batch. Where the squares of small components would lose bits
   to underflow, the normal is multiplied by 2^500, exactly. Unused lanes repeat the first. */
static void batch_normals_make(lrcs_prepared *p, lrcsi_batches *b)
{
    batch_normals n;
    for (uint32_t start = 0; start < b->count; start += LRCSI_LANES) {
        const uint32_t *facet = b->facet + start;
        uint32_t count = lrcsi_batch_lanes(start, b->count);
        lrcsi_normals_make(p, facet, count);
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            const lrcsi_normal *from = &p->normal[facet[i < count ? i : 0]];
            double scale = from->length < 0x1p-400 ? 0x1p500 : 1;
            for (int k = 0; k < 3; k++) {
                n.high[k][i] = from->high[k] * scale;
                n.low[k][i] = from->low[k] * scale;
            }
            n.length[i] = from->length * scale;
            n.half[i] = 0.5 / scale;
        }
        normals_finish(&n, b->normal[0] + start, b->normal[1] + start, b->normal[2] + start,
                       b->area + start);
    }
    for (uint32_t i = 0; i < LRCSI_LANES; i++) {
        b->normal[0][b->count + i] = 0;
        b->normal[1][b->count + i] = 0;
        b->normal[2][b->count + i] = 0;
        b->area[b->count + i] = 0;
    }
    uint32_t skipped[LRCSI_LANES];
    uint32_t count = 0;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        skipped[count] = f;
        count += p->skip[f];
        if (count == LRCSI_LANES) {
            lrcsi_normals_make(p, skipped, count);
            count = 0;
        }
    }
    lrcsi_normals_make(p, skipped, count);
}

/* The ball around the unit normals of `count` elements: about the middle of their box. */
static lrcsi_normal_ball normal_ball(const lrcsi_batches *b, uint32_t start, uint32_t count)
{
    lrcsi_normal_ball ball = {.radius = 0};
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (uint32_t i = start; i < start + count; i++) {
            lrcsi_range_extend(b->normal[k][i], &low, &high);
        }
        ball.middle[k] = 0.5 * (low + high);
    }
    for (uint32_t i = start; i < start + count; i++) {
        const double from[3] = {b->normal[0][i] - ball.middle[0], b->normal[1][i] - ball.middle[1],
                                b->normal[2][i] - ball.middle[2]};
        ball.radius = lrcsi_max(ball.radius, sqrt(lrcsi_vec3_dot(from, from)));
    }
    ball.radius += 0x1p-46;
    return ball;
}

static uint32_t ball_count(uint32_t facets)
{
    return facets / LRCSI_LANES + (facets % LRCSI_LANES != 0);
}

size_t lrcsi_batches_need(const lrcs_scene *scene)
{
    size_t facets = scene->facet_count;
    size_t need = lrcsi_work_bytes((size_t)scene->material_count + 2, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(
        need, lrcsi_work_bytes(ball_count(scene->facet_count), sizeof(lrcsi_normal_ball)));
    for (int k = 0; k < 4; k++) {
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets + LRCSI_LANES, sizeof(double)));
    }
    return need;
}

/* A counting sort by material. At first, first[i + 2] is the number of facets of material i. The
   prefix sums make first[i + 1] the index of its first facet. Storing a facet increments that
   index, so that in the end first[i] is the index of the first facet of material i. */
int lrcsi_batches_make(lrcs_prepared *p, lrcs_work *work)
{
    lrcsi_batches *b = &p->batches;
    const lrcs_scene *scene = p->scene;
    size_t capacity = (size_t)scene->facet_count + LRCSI_LANES;
    b->first = lrcsi_work_take_zero(work, (size_t)scene->material_count + 2, sizeof *b->first);
    b->facet = lrcsi_work_take(work, scene->facet_count, sizeof *b->facet);
    b->area = lrcsi_work_take(work, capacity, sizeof *b->area);
    for (int k = 0; k < 3; k++) {
        b->normal[k] = lrcsi_work_take(work, capacity, sizeof *b->normal[k]);
    }
    b->ball = lrcsi_work_take(work, ball_count(scene->facet_count), sizeof *b->ball);
    if (!b->first || !b->facet || !b->area || !b->normal[2] || !b->ball) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        b->first[scene->facet_material[f] + 2] += !p->skip[f];
        b->count += !p->skip[f];
        if (!p->skip[f] && p->redundant[f] > b->redundant) {
            b->redundant = p->redundant[f];
        }
    }
    for (uint32_t i = 1; i < scene->material_count; i++) {
        b->first[i + 1] += b->first[i];
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        if (!p->skip[f]) {
            uint32_t index = b->first[scene->facet_material[f] + 1]++;
            b->facet[index] = f;
        }
    }
    batch_normals_make(p, b);
    for (uint32_t start = 0; start < b->count; start += LRCSI_LANES) {
        b->ball[start / LRCSI_LANES] = normal_ball(b, start, lrcsi_batch_lanes(start, b->count));
    }
    return LRCS_OK;
}
