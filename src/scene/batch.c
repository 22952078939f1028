/* SPDX-License-Identifier: MIT */
/* Facets sorted by material, with unit normals. It decides the order in which facets are summed. */
#include "scene/batch.h"

#include <math.h>
#include <string.h>

#include "base/dd.h"
#include "base/work.h"
#include "scene/prepare.h"

/* |N|^2 to 8 u^2: three squares to 2 u^2 of what they lose, twice their low parts' products, sums.
 */
static lrcsi_dd normal_square(const double *high, const double *low)
{
    lrcsi_dd sum = {0, 0};
    for (int k = 0; k < 3; k++) {
        lrcsi_dd square = lrcsi_dd_two_product(high[k], high[k]);
        square.lo += 2 * high[k] * low[k];
        sum = lrcsi_dd_add(sum, lrcsi_dd_quick_sum(square.hi, square.lo));
    }
    return sum;
}

/* N / |N|, its components rounded once: y = 1 / |N| to 4 u, and with r = 1 - y^2 |N|^2, at most 8 u
   and good to u of itself, y (1 + r / 2) is good to 3/8 r^2 + u r, some 32 u^2; so is the product
   before it is rounded. N is off by 2^-90 of itself. |N| = (1 + r / 2) y |N|^2, two roundings.
   Where squares of small components lose bits, all is times 2^500, exactly. */
static void batch_place(lrcsi_batches *b, uint32_t place, const lrcsi_normal *n)
{
    double scale = n->length < 0x1p-400 ? 0x1p500 : 1;
    double high[3];
    double low[3];
    for (int k = 0; k < 3; k++) {
        high[k] = n->high[k] * scale;
        low[k] = n->low[k] * scale;
    }
    lrcsi_dd square = normal_square(high, low);
    double y = 1 / sqrt(square.hi);
    lrcsi_dd y2 = lrcsi_dd_two_product(y, y);
    double half = 0.5 * lrcsi_dd_value(lrcsi_dd_sub((lrcsi_dd){1, 0}, lrcsi_dd_mul(y2, square)));
    for (int k = 0; k < 3; k++) {
        lrcsi_dd p = lrcsi_dd_two_product(high[k], y);
        b->normal[k][place] = p.hi + (p.lo + (low[k] * y + p.hi * half));
    }
    double length = y * square.hi;
    b->area[place] = 0.5 * (length + length * half) / scale;
}

size_t lrcsi_batches_need(const lrcs_scene *scene)
{
    size_t facets = scene->facet_count;
    size_t need = lrcsi_work_bytes((size_t)scene->material_count + 2, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    for (int k = 0; k < 4; k++) {
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets + LRCSI_LANES, sizeof(double)));
    }
    return need;
}

/* first[i + 1] counts material i - 1, then becomes its first place, then, as places are taken, the
   next: in the end that of material i. */
int lrcsi_batches_make(lrcs_prepared *p, lrcs_work *work)
{
    lrcsi_batches *b = &p->batches;
    const lrcs_scene *scene = p->scene;
    size_t room = (size_t)scene->facet_count + LRCSI_LANES;
    b->first = lrcsi_work_take_zero(work, (size_t)scene->material_count + 2, sizeof *b->first);
    b->facet = lrcsi_work_take(work, scene->facet_count, sizeof *b->facet);
    b->area = lrcsi_work_take_zero(work, room, sizeof *b->area);
    for (int k = 0; k < 3; k++) {
        b->normal[k] = lrcsi_work_take_zero(work, room, sizeof *b->normal[k]);
    }
    if (!b->first || !b->facet || !b->area || !b->normal[2]) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        b->first[scene->facet_material[f] + 2] += !p->skip[f];
        b->count += !p->skip[f];
        b->redundant |= !p->skip[f] && p->redundant[f] != LRCSI_NOT_REDUNDANT;
    }
    for (uint32_t i = 1; i < scene->material_count; i++) {
        b->first[i + 1] += b->first[i];
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        if (!p->skip[f]) {
            uint32_t place = b->first[scene->facet_material[f] + 1]++;
            b->facet[place] = f;
            batch_place(b, place, &p->normal[f]);
        }
    }
    return LRCS_OK;
}
