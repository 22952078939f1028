/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2 over the facets of one material, in packets of LRCSI_LANES, in plain doubles
   (optics/shade.h). select_facets selects the facets that face the laser (lrcsi_view_dot),
   add_singles adds those of them that cannot be evaluated in packets one by one (total_facet.c),
   and add_packet evaluates the others. */
#include <string.h>

#include "base/bits.h"
#include "base/constant.h"
#include "base/range.h"
#include "integrate/sum/facet_terms.h"
#include "integrate/sum/total_run.h"
#include "optics/shade.h"

/* The relative error of the area of a facet that is entirely visible and not near grazing: that of
   lrcsi_incidence.projected (8 u), and a product. */
#define AREA_ERROR (10 * LRCSI_U)

/* Facets with this lrcsi_redundant or a larger one are not visible: others are seen instead. Given:
   the side that faces the laser, 1, or -1 for the back. */
static inline int least_redundant(const lrcsi_total_run *run, int side)
{
    return side > 0 ? LRCSI_REDUNDANT : run->view->backs.cast;
}

/* May some of a facet be visible, by any method? */
static inline int side_may_be_visible(const lrcsi_total_run *run, uint32_t facet, int side)
{
    return run->areas->visible ? lrcsi_areas_may_be_visible(run->areas, facet)
                               : run->view->prepared->redundant[facet] < least_redundant(run, side);
}

/* May some facets not be visible, or not be added in packets? */
static inline int may_have_singles(const lrcsi_total_run *run, int side)
{
    return run->areas->visible || run->clear->count > 0 ||
           run->view->prepared->batches.redundant >= least_redundant(run, side);
}

/* The facets of one material. Those that can be evaluated in packets are collected until there are
   enough for one packet. */
typedef struct total_batch {
    lrcsi_lobes lobes;
    int back_reflects;                 /* back sides reflect */
    int back_visible;                  /* back sides may be visible */
    int seen;                          /* a facet that reflects may be visible */
    uint32_t waiting;                  /* facets collected for the next packet */
    uint32_t element[2 * LRCSI_LANES]; /* their indices in prepared->batches */
    signed char side[2 * LRCSI_LANES]; /* 1 or, if back sides reflect, -1 for those */
    lrcsi_shade_normals normals;       /* of the packet that is being added */
    lrcsi_sum_lanes glint, diffuse, projected, back_side;
    double error[LRCSI_SUM_LANES];
} total_batch;

/* Fills batch->normals with the unit normals, on the side towards the laser, and `area` with the
   areas of the first `count` facets collected. Unused lanes get the direction to the laser as their
   normal, and area 0. */
static void packet_gather(const lrcsi_total_run *run, total_batch *batch, uint32_t count,
                          double area[LRCSI_LANES])
{
    lrcsi_shade_normals *normals = &batch->normals;
    const lrcsi_view *view = run->view;
    const lrcsi_batches *b = &view->prepared->batches;
    const double *x = b->normal[0];
    const double *y = b->normal[1];
    const double *z = b->normal[2];
    const double *areas = b->area;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t at = batch->element[i];
        normals->x[0][i] = x[at];
        normals->x[1][i] = y[at];
        normals->x[2][i] = z[at];
        area[i] = areas[at];
    }
    for (uint32_t i = 0; batch->back_reflects && i < count; i++) {
        normals->x[0][i] *= batch->side[i];
        normals->x[1][i] *= batch->side[i];
        normals->x[2][i] *= batch->side[i];
    }
    for (uint32_t i = count; i < LRCSI_LANES; i++) {
        for (int k = 0; k < 3; k++) {
            normals->x[k][i] = view->unit[k];
        }
        area[i] = 0;
    }
}

/* Replaces the projected areas by the visible ones for facets that have no answer, also their upper
   bounds, and adds the errors due to these areas. */
static void packet_visible(lrcsi_total_run *run, const total_batch *batch, uint32_t count,
                           const lrcsi_shades *shades, double visible[LRCSI_LANES],
                           double high[LRCSI_LANES])
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t facet = run->view->prepared->batches.facet[batch->element[i]];
        if (lrcsi_areas_answered(run->areas, facet)) {
            continue;
        }
        const lrcsi_visible_area *found = &run->areas->visible[facet];
        visible[i] = found->area;
        high[i] = lrcsi_max(found->high, found->area);
        if (found->low < found->high) {
            lrcsi_total_add_area_error(&run->sums, shades->glint[i] + shades->diffuse[i], found);
            lrcsi_total_count(&run->total, lrcsi_view_projected(run->view, facet), found);
        }
    }
}

/* Adds one packet by Eq. 2, the first LRCSI_LANES facets collected:
   1. gathers their normals and areas S;
   2. computes 4 pi f_r cos(theta), with errors;
   3. computes projected areas S cos(theta), and replaces them by visible areas. With method facet,
      facets may be hidden unless cos(theta) is proved to exceed the plan's grazing threshold;
   4. adds the products of 2 and 3 to the sums;
   5. fills records. */
static void add_packet(lrcsi_total_run *run, total_batch *batch)
{
    const lrcsi_view *view = run->view;
    const double threshold = run->plan->grazing_cos;
    lrcsi_shades shades;
    uint32_t count = batch->waiting < LRCSI_LANES ? batch->waiting : LRCSI_LANES;
    double area[LRCSI_LANES];
    double visible[LRCSI_LANES];
    double high[LRCSI_LANES];
    double glint[LRCSI_LANES];
    double diffuse[LRCSI_LANES];
    double error[LRCSI_LANES];
    packet_gather(run, batch, count, area);                                           /* 1 */
    lrcsi_shade(&batch->lobes, view->unit, view->unit_low, &batch->normals, &shades); /* 2 */
    for (int i = 0; i < LRCSI_LANES; i++) {                                           /* 3 */
        visible[i] = high[i] = area[i] * shades.cosine[i];
    }
    if (run->areas->visible) {
        packet_visible(run, batch, count, &shades, visible, high);
    } else if (threshold > 0 && threshold < 1) {
        for (uint32_t i = 0; i < count; i++) {
            double per_area = shades.glint[i] + shades.diffuse[i];
            int proved = shades.cosine[i] > threshold + 0x1p-40; /* its error is below 2^-48 */
            run->sums.visibility += proved ? 0 : per_area * visible[i];
        }
    }
    for (int i = 0; i < LRCSI_LANES; i++) { /* 4 */
        glint[i] = shades.glint[i] * visible[i];
        diffuse[i] = shades.diffuse[i] * visible[i];
        error[i] = shades.error[i] * high[i];
    }
    lrcsi_sum_lanes_add(&batch->glint, glint);
    lrcsi_sum_lanes_add(&batch->diffuse, diffuse);
    lrcsi_sum_lanes_add(&batch->projected, visible);
    lrcsi_lanes_add(batch->error, error);
    for (uint32_t i = 0; run->details.records && i < count; i++) { /* 5 */
        lrcsi_total_record(run, view->prepared->batches.facet[batch->element[i]], glint[i],
                           diffuse[i]);
    }
    if (batch->lobes.A > 0 || batch->lobes.B > 0) {
        run->sums.rounding += count * LRCSI_FACET_UNDERFLOW;
    }
    batch->waiting -= count;
    memmove(batch->element, batch->element + LRCSI_LANES, sizeof batch->element / 2);
    memmove(batch->side, batch->side + LRCSI_LANES, sizeof batch->side / 2);
}

/* Adds the facets of clear shapes one by one and, after them, the visible ones with curved normals;
   counts hidden ones. Given: `count` facets that reflect, from the side given, as indices in the
   batches. Returned: list[0 .. n - 1], those that are evaluated in packets, and their number n. */
static uint32_t add_singles(lrcsi_total_run *run, int side, uint32_t *list, uint32_t count)
{
    const uint32_t *facet = run->view->prepared->batches.facet;
    uint32_t left = 0;
    if (run->clear->count > 0) {
        for (uint32_t k = 0; k < count; k++) {
            if (lrcsi_total_in_clear_shape(run, facet[list[k]])) {
                lrcsi_total_add_clear(run, facet[list[k]]);
            } else {
                list[left++] = list[k];
            }
        }
        count = left;
    }
    left = 0;
    for (uint32_t k = 0; k < count; k++) { /* without branches */
        uint32_t at = list[k];
        list[left] = at;
        left += (uint32_t)side_may_be_visible(run, facet[at], side);
    }
    run->total.hidden += count - left;
    if (run->curve_terms) {
        count = left;
        left = 0;
        for (uint32_t k = 0; k < count; k++) {
            if (lrcsi_curve_applies(run->view, facet[list[k]])) {
                lrcsi_total_add_reflecting(run, facet[list[k]]);
            } else {
                list[left++] = list[k];
            }
        }
    }
    return left;
}

/* Adds the selected facets among the LRCSI_LANES from index `start` on, which reflect from the side
   given, 1 for their front or -1 for their back:
   1. lists them;
   2. adds those that are not evaluated in packets, and removes them from the list (add_singles);
   3. the others join the next packet, which is added once it is full. */
static void add_selected(lrcsi_total_run *run, total_batch *batch, uint32_t start,
                         const uint64_t pick[LRCSI_LANES], int side)
{
    uint32_t *list = batch->element + batch->waiting;
    uint32_t count = 0;
    for (uint32_t i = 0; i < LRCSI_LANES; i++) { /* without branches: facings follow no pattern */
        list[count] = start + i;
        count += (uint32_t)(pick[i] >> 63);
    }
    if (may_have_singles(run, side)) {
        count = add_singles(run, side, list, count);
    }
    for (uint32_t i = 0; batch->back_reflects && i < count; i++) {
        batch->side[batch->waiting + i] = (signed char)side;
    }
    batch->waiting += count;
    batch->seen |= count > 0;
    if (batch->waiting >= LRCSI_LANES) {
        add_packet(run, batch);
    }
}

/* The cosine of the incidence of an element of the batches. */
static inline double element_dot(const lrcsi_batches *b, uint32_t at, const double d[3])
{
    return lrcsi_view_dot(b->normal[0][at], b->normal[1][at], b->normal[2][at], d);
}

/* Adds the visible areas of the selected back sides, which do not reflect. */
static void add_back_areas(lrcsi_total_run *run, total_batch *batch, uint32_t start,
                           const uint64_t pick[LRCSI_LANES])
{
    const lrcsi_batches *b = &run->view->prepared->batches;
    const double *d = run->view->unit;
    double area[LRCSI_LANES] = {0}; /* projected */
    uint32_t count = 0;
    if (run->areas->visible || b->redundant >= least_redundant(run, -1)) {
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            if (pick[i] >> 63) {
                uint32_t facet = b->facet[start + i];
                if (side_may_be_visible(run, facet, -1)) {
                    area[count] = run->areas->visible
                                      ? lrcsi_areas_value(run->areas, run->view, facet)
                                      : -element_dot(b, start + i, d) * b->area[start + i];
                }
                run->total.back_sides += area[count++] > 0;
            }
        }
    } else {
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            uint32_t at = start + i;
            area[i] =
                lrcsi_bits_masked(-element_dot(b, at, d) * b->area[at], ~((pick[i] >> 63) - 1));
            count += (uint32_t)(pick[i] >> 63);
        }
        run->total.back_sides += count;
    }
    lrcsi_sum_lanes_add(&batch->back_side, area);
}

/* Which of LRCSI_LANES facets are evaluated in packets, as sign bits: those whose front faces the
   laser, and those whose back does. */
typedef struct total_selection {
    uint64_t front[LRCSI_LANES], back[LRCSI_LANES];
    uint64_t any_front, any_back, any_other; /* sign bit: 1 if there is one */
} total_selection;

/* Selects among the facets from index `start` on, without branches: the comparison a < b is the
   sign bit of a - b. The ball of their normals selects most of them at once. */
static void select_facets(const lrcsi_total_run *run, const total_batch *batch, uint32_t start,
                          uint32_t count, total_selection *restrict pick)
{
    const lrcsi_batches *b = &run->view->prepared->batches;
    const double *x = b->normal[0] + start;
    const double *y = b->normal[1] + start;
    const double *z = b->normal[2] + start;
    const double d[3] = {run->view->unit[0], run->view->unit[1], run->view->unit[2]};
    const double low = batch->lobes.low;
    const double high = batch->lobes.high;
    const double back_high = batch->back_reflects ? high : 2; /* 2: no cosine exceeds it */
    uint64_t fronts = 0;
    uint64_t backs = 0;
    uint64_t others = 0;
    double least;
    double most;
    lrcsi_view_dot_range(&b->ball[start / LRCSI_LANES], d, &least, &most);
    if ((low < least && most < high) || (most < -low && -back_high < least)) {
        fronts = least > 0 ? UINT64_MAX : 0;
        backs = ~fronts;
        for (uint32_t i = 0; i < LRCSI_LANES; i++) {
            pick->front[i] = i < count ? fronts : 0;
            pick->back[i] = i < count ? backs : 0;
        }
        pick->any_front = fronts;
        pick->any_back = backs;
        pick->any_other = 0;
        return;
    }
    for (int i = 0; i < LRCSI_LANES; i++) {
        double dot = lrcsi_view_dot(x[i], y[i], z[i], d);
        uint64_t front = lrcsi_bits_of(low - dot) & lrcsi_bits_of(dot - high);
        uint64_t back = lrcsi_bits_of(low + dot) & lrcsi_bits_of(-back_high - dot);
        pick->front[i] = front;
        pick->back[i] = back;
        fronts |= front;
        backs |= back;
        others |= ~(front | back);
    }
    for (uint32_t i = count; i < LRCSI_LANES; i++) { /* of other materials */
        pick->front[i] = pick->back[i] = 0;
    }
    pick->any_front = fronts;
    pick->any_back = backs;
    pick->any_other = others;
}

/* Adds up to LRCSI_LANES facets from index `start` on:
   1. selects those that are evaluated in packets, except facets that represent patches of curved
      walls;
   2. adds selected front sides;
   3. adds selected back sides too if they reflect; otherwise only their areas;
   4. adds the others one by one: facets near grazing incidence or in the bright lobe of a narrow
      glint, and those of curved walls; for these also the tessellation error, which needs the same
      patch. */
static void add_lanes(lrcsi_total_run *run, total_batch *batch, uint32_t start, uint32_t count)
{
    const uint32_t *facet = run->view->prepared->batches.facet + start;
    total_selection pick;
    select_facets(run, batch, start, count, &pick);
    for (uint32_t i = 0; run->plan->patches && i < count; i++) {
        if (lrcsi_patch_exists(run->view->prepared, facet[i])) {
            pick.front[i] = pick.back[i] = 0;
            pick.any_other = UINT64_MAX;
        }
    }
    if (pick.any_front >> 63) {
        add_selected(run, batch, start, pick.front, 1);
    }
    int back = (int)(pick.any_back >> 63);
    if (back && batch->back_reflects) { /* then they cast shadows, and may be visible */
        add_selected(run, batch, start, pick.back, -1);
    } else if (back && batch->back_visible) {
        add_back_areas(run, batch, start, pick.back);
    }
    for (uint32_t i = 0; pick.any_other >> 63 && i < count; i++) {
        if (!((pick.front[i] | pick.back[i]) >> 63)) {
            lrcsi_total_add_facet(run, facet[i]);
            if (run->bounds_tessellation && lrcsi_patch_exists(run->view->prepared, facet[i])) {
                lrcsi_incidence incidence = lrcsi_view_incidence(run->view, facet[i]);
                lrcsi_total_add_tessellation(run, facet[i], &incidence);
            }
        }
    }
}

static int is_evaluated(int term, double amplitude)
{
    return amplitude > 0 || term == LRCSI_TERM_FORCED;
}

/* Adds all facets of a material, in their order:
   1. the facets, in packets or one by one;
   2. the last packet, which may not be full;
   3. the sums and the errors of the packets. With method facet and a grazing threshold of 1,
   nothing is known about what is hidden, and all of the material may be. */
void lrcsi_total_add_material(lrcsi_total_run *run, uint32_t material)
{
    const lrcsi_view *view = run->view;
    const lrcs_material *m = &view->prepared->scene->material[material];
    lrcs_brdf brdf = lrcsi_plan_brdf(run->plan, m);
    total_batch batch = {
        .lobes = lrcsi_lobes_make(&brdf, brdf.s > 0 && is_evaluated(run->plan->glint, brdf.A),
                                  is_evaluated(run->plan->diffuse, brdf.B)),
        .back_reflects = view->backs.reflect && m->two_sided,
        .back_visible = view->backs.cast};
    const uint32_t *first = view->prepared->batches.first + material;
    for (uint32_t start = first[0], count; start < first[1]; start += count) {
        count = lrcsi_batch_lanes(start, first[1]);
        add_lanes(run, &batch, start, count);
    }
    if (batch.waiting > 0) {
        add_packet(run, &batch);
    }
    lrcsi_total_sums *sums = &run->sums;
    lrcsi_sum both = {0, 0};
    lrcsi_sum_lanes_join(&both, &batch.glint);
    lrcsi_sum_lanes_join(&both, &batch.diffuse);
    lrcsi_sum_lanes_join(&sums->glint, &batch.glint);
    lrcsi_sum_lanes_join(&sums->diffuse, &batch.diffuse);
    lrcsi_sum_lanes_join(&sums->projected, &batch.projected);
    lrcsi_sum_lanes_join(&sums->projected, &batch.back_side);
    lrcsi_sum_lanes_join(&sums->back_side, &batch.back_side);
    for (int k = 0; k < LRCSI_SUM_LANES; k++) {
        sums->rounding += batch.error[k] * LRCSI_SHADE_UNIT;
    }
    sums->rounding += run->areas->visible ? lrcsi_sum_value(&both) * AREA_ERROR : 0;
    sums->visibility +=
        !run->areas->visible && run->plan->grazing_cos >= 1 ? lrcsi_sum_value(&both) : 0;
    if (batch.seen) {
        lrcsi_total_note_terms(sums, &brdf);
    }
}
