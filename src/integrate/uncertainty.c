/* SPDX-License-Identifier: MIT */
/* The material uncertainty of sigma. sigma = sum over materials of A G(s) + B D(m), so that all a
   sample needs of the scene is G and D of each material near its own s and m.
   Steps: 1. materials of one source are joined: they are off together. 2. First order: with v the
   four derivatives times the four deviations and C the correlations, the variance is the sum over
   sources of v' C v. 3. The sample: normal deviates with the correlations (C = L L'), clamped to
   the domain; G and D by cubic Hermite interpolation between nodes; mean, deviation and quantiles.
 */
#include "integrate/uncertainty.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/range.h"
#include "base/work.h"

/* Nodes reach so many deviations to either side, and so do draws. */
#define REACH 4.0
/* The least s, as a share of the material's own: sigma changes little below. */
#define DRAWN_SLOPE_LEAST 0.0625
/* First order is reported up to this relative difference from the sample's deviation, and while the
   sample's mean is off sigma by no more than this share of it. Smaller differences than three
   standard errors of a sample are chance. */
#define FIRST_ORDER_SERVES 0.05
#define MEAN_SERVES        0.1
#define CHANCE             3.0
/* The quantiles of a normal distribution at -1 and 1 deviation. */
#define QUANTILE_LOW  0.15865525393145705
#define QUANTILE_HIGH 0.84134474606854295
/* Of each two uniform deviates pi / 4 serve; so many pairs never fail to give one. */
#define POLAR_TRIES 64
/* Below this a response has no logarithm to interpolate. */
#define RESPONSE_LEAST 1e-250

static void deviations(const lrcs_brdf_error *error, double out[4])
{
    out[0] = error->A;
    out[1] = error->B;
    out[2] = error->s;
    out[3] = error->m;
}

int lrcsi_uncertainty_stated(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_brdf_error *e = &scene->material[i].error;
        if (e->A > 0 || e->B > 0 || e->s > 0 || e->m > 0) {
            return 1;
        }
    }
    return 0;
}

int lrcsi_uncertainty_bends(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (scene->material[i].error.s > 0 || scene->material[i].error.m > 0) {
            return 1;
        }
    }
    return 0;
}

/* --- nodes ------------------------------------------------------------------------------------ */

/* The ends of a parameter's nodes. */
static double node_low(double value, double deviation, double least)
{
    return lrcsi_most(least, value - REACH * deviation);
}

static double node_high(double value, double deviation)
{
    return value + REACH * deviation;
}

/* Node k of `count`: two runs of equal steps, from the low end to the value and on to the high end.
 */
static double node_at(double low, double value, double high, uint32_t k, uint32_t count)
{
    uint32_t half = count / 2;
    return k < half    ? low + (value - low) * k / half
           : k == half ? value
                       : value + (high - value) * (k - half) / half;
}

lrcs_brdf lrcsi_uncertainty_node(const lrcs_material *material, uint32_t k, uint32_t count)
{
    lrcs_brdf at = material->brdf;
    const lrcs_brdf_error *e = &material->error;
    if (count > 1) {
        at.s = node_at(node_low(at.s, e->s, DRAWN_SLOPE_LEAST * at.s), at.s, node_high(at.s, e->s),
                       k, count);
        at.m = node_at(node_low(at.m, e->m, 0), at.m, node_high(at.m, e->m), k, count);
    }
    return at;
}

/* --- sources ---------------------------------------------------------------------------------- */

/* The materials of one source, as one. */
typedef struct source {
    const lrcs_material *material; /* the first of them */
    lrcsi_node *node;              /* [count]: their sum */
    double root[4][4];             /* L, lower triangle */
} source;

static int is_stated(const lrcs_material *material)
{
    const lrcs_brdf_error *e = &material->error;
    return e->A > 0 || e->B > 0 || e->s > 0 || e->m > 0;
}

static void correlation_fill(const double c[6], double out[4][4])
{
    const double full[4][4] = {
        {1, c[0], c[1], c[2]}, {c[0], 1, c[3], c[4]}, {c[1], c[3], 1, c[5]}, {c[2], c[4], c[5], 1}};
    memcpy(out, full, sizeof full);
}

/* C = L L'; a pivot that is 0, or below by rounding, leaves its column 0. */
static void correlation_root(const double c[6], double root[4][4])
{
    double a[4][4];
    correlation_fill(c, a);
    memset(root, 0, 16 * sizeof(double));
    for (int j = 0; j < 4; j++) {
        double pivot = a[j][j];
        for (int k = 0; k < j; k++) {
            pivot -= root[j][k] * root[j][k];
        }
        if (!(pivot > 1e-9)) {
            continue;
        }
        root[j][j] = sqrt(pivot);
        for (int i = j + 1; i < 4; i++) {
            double sum = a[i][j];
            for (int k = 0; k < j; k++) {
                sum -= root[i][k] * root[j][k];
            }
            root[i][j] = sum / root[j][j];
        }
    }
}

/* The sources with errors; what a later material of a source adds joins the first one's nodes. */
static uint32_t sources_make(const lrcs_scene *scene, const lrcsi_node *node, uint32_t count,
                             lrcsi_node *room, source *list)
{
    uint32_t sources = 0;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *m = &scene->material[i];
        uint32_t at = 0;
        while (at < sources && !(m->source > 0 && list[at].material->source == m->source)) {
            at++;
        }
        if (!is_stated(m)) {
            continue;
        }
        if (at == sources) {
            list[sources].material = m;
            list[sources].node = room + (size_t)sources * count;
            memset(list[sources].node, 0, count * sizeof *room);
            correlation_root(m->error.correlation, list[sources].root);
            sources++;
        }
        for (uint32_t k = 0; k < count; k++) {
            const lrcsi_node *from = &node[(size_t)k * scene->material_count + i];
            lrcsi_node *to = &list[at].node[k];
            to->glint += from->glint;
            to->diffuse += from->diffuse;
            to->glint_s += from->glint_s;
            to->diffuse_m += from->diffuse_m;
        }
    }
    return sources;
}

/* --- first order ------------------------------------------------------------------------------ */

static double source_variance(const source *one, uint32_t count)
{
    const lrcs_brdf *brdf = &one->material->brdf;
    const lrcsi_node *own = &one->node[count / 2];
    double deviation[4];
    double c[4][4];
    double sum = 0;
    deviations(&one->material->error, deviation);
    correlation_fill(one->material->error.correlation, c);
    const double v[4] = {own->glint * deviation[0], own->diffuse * deviation[1],
                         brdf->A * own->glint_s * deviation[2],
                         brdf->B * own->diffuse_m * deviation[3]};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            sum += v[i] * c[i][j] * v[j];
        }
    }
    return lrcsi_most(0, sum);
}

/* --- the sample ------------------------------------------------------------------------------- */

/* SplitMix64 (Steele, Lea and Flood 2014). */
static double random_uniform(uint64_t *state)
{
    uint64_t x = *state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return ((double)((x ^ (x >> 31)) >> 11) + 0.5) * 0x1p-53;
}

/* Two independent normal deviates by the polar method (Marsaglia and Bray 1964). */
static void random_normal(uint64_t *state, double out[2])
{
    out[0] = out[1] = 0;
    for (int i = 0; i < POLAR_TRIES; i++) {
        double x = 2 * random_uniform(state) - 1;
        double y = 2 * random_uniform(state) - 1;
        double square = x * x + y * y;
        if (square > 0 && square < 1) {
            double factor = sqrt(-2 * lrcsi_log(square).hi / square);
            out[0] = x * factor;
            out[1] = y * factor;
            return;
        }
    }
}

/* The cubic through two values with their slopes, `step` apart, at share t of the step. */
static double hermite(double f0, double f1, double g0, double g1, double step, double t)
{
    double a = step * g0 - (f1 - f0);
    double b = (f1 - f0) - step * g1;
    return f0 + t * (f1 - f0) + t * (1 - t) * ((1 - t) * a + t * b);
}

/* A response between two nodes: its logarithm by the cubic, for on the flank of a glint it varies
   by orders of magnitude; the response itself where it underflows. */
static double interpolate(double f0, double f1, double g0, double g1, double step, double t)
{
    if (!(f0 > RESPONSE_LEAST) || !(f1 > RESPONSE_LEAST)) {
        return lrcsi_most(0, hermite(f0, f1, g0, g1, step, t));
    }
    double low = lrcsi_log(f0).hi;
    double high = lrcsi_log(f1).hi;
    return lrcsi_exp(hermite(low, high, g0 / f0, g1 / f1, step, t));
}

/* Of which interval of nodes, and at what share of it, is x? */
static uint32_t interval_find(double low, double value, double high, uint32_t count, double x,
                              double *t)
{
    uint32_t half = count / 2;
    double from = x < value ? low : value;
    double step = (x < value ? value - low : high - value) / half;
    double place = step > 0 ? (x - from) / step : 0;
    uint32_t k = place > 0 ? (uint32_t)lrcsi_least(place, half - 1) : 0;
    *t = lrcsi_least(1, lrcsi_most(0, place - k));
    return (x < value ? 0 : half) + k;
}

/* What a source's materials reflect with those numbers. */
static double source_sigma(const source *one, uint32_t count, const lrcs_brdf *at)
{
    const lrcs_brdf *own = &one->material->brdf;
    const lrcs_brdf_error *e = &one->material->error;
    const lrcsi_node *node = one->node;
    double glint = node[count / 2].glint;
    double diffuse = node[count / 2].diffuse;
    double t = 0;
    if (count > 1 && e->s > 0) {
        double low = node_low(own->s, e->s, DRAWN_SLOPE_LEAST * own->s);
        double high = node_high(own->s, e->s);
        uint32_t k = interval_find(low, own->s, high, count, at->s, &t);
        double step =
            node_at(low, own->s, high, k + 1, count) - node_at(low, own->s, high, k, count);
        glint = interpolate(node[k].glint, node[k + 1].glint, node[k].glint_s, node[k + 1].glint_s,
                            step, t);
    }
    if (count > 1 && e->m > 0) {
        double low = node_low(own->m, e->m, 0);
        double high = node_high(own->m, e->m);
        uint32_t k = interval_find(low, own->m, high, count, at->m, &t);
        double step =
            node_at(low, own->m, high, k + 1, count) - node_at(low, own->m, high, k, count);
        diffuse = interpolate(node[k].diffuse, node[k + 1].diffuse, node[k].diffuse_m,
                              node[k + 1].diffuse_m, step, t);
    }
    return at->A * glint + at->B * diffuse;
}

/* One draw of a source's numbers, in their domain. */
static lrcs_brdf source_draw(const source *one, uint64_t *state)
{
    const lrcs_brdf *own = &one->material->brdf;
    const lrcs_brdf_error *e = &one->material->error;
    double normal[4];
    double off[4] = {0, 0, 0, 0};
    random_normal(state, normal);
    random_normal(state, normal + 2);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k <= i; k++) {
            off[i] += one->root[i][k] * normal[k];
        }
    }
    for (int i = 2; i < 4; i++) {
        off[i] = lrcsi_least(REACH, lrcsi_most(-REACH, off[i]));
    }
    return (lrcs_brdf){lrcsi_most(0, own->A + off[0] * e->A), lrcsi_most(0, own->B + off[1] * e->B),
                       lrcsi_most(DRAWN_SLOPE_LEAST * own->s, own->s + off[2] * e->s),
                       lrcsi_most(0, own->m + off[3] * e->m)};
}

/* In place, by Shell's method with Ciura's gaps (2001), grown by 9/4. */
static void sort_ascending(double *x, uint32_t count)
{
    static const uint32_t gap[] = {1,    4,    10,   23,    57,    132,    301,    701,
                                   1750, 3937, 8858, 19930, 44842, 100894, 227011, 510774};
    for (size_t g = sizeof gap / sizeof gap[0]; g-- > 0;) {
        for (uint32_t i = gap[g]; i < count; i++) {
            double one = x[i];
            uint32_t j = i;
            for (; j >= gap[g] && x[j - gap[g]] > one; j -= gap[g]) {
                x[j] = x[j - gap[g]];
            }
            x[j] = one;
        }
    }
}

/* Linear between the order statistics. */
static double quantile(const double *sorted, uint32_t count, double share)
{
    double place = share * (count - 1);
    uint32_t k = (uint32_t)lrcsi_least(place, count - 2);
    return sorted[k] + (place - k) * (sorted[k + 1] - sorted[k]);
}

/* Given: sigma, and what the sources reflect of it with their own numbers. */
static void sample_make(const source *list, uint32_t sources, uint32_t count, double sigma,
                        double own, const lrcs_uncertainty_options *how, double *draw,
                        lrcs_uncertainty *uncertainty)
{
    double fixed = lrcsi_most(0, sigma - own);
    uint64_t state = how->seed;
    lrcsi_sum sum = {0, 0};
    lrcsi_sum square = {0, 0};
    for (uint32_t i = 0; i < how->draws; i++) {
        draw[i] = fixed;
        for (uint32_t k = 0; k < sources; k++) {
            lrcs_brdf at = source_draw(&list[k], &state);
            draw[i] += source_sigma(&list[k], count, &at);
        }
        lrcsi_sum_add(&sum, draw[i]);
    }
    double mean = lrcsi_sum_value(&sum) / how->draws;
    for (uint32_t i = 0; i < how->draws; i++) {
        lrcsi_sum_add(&square, (draw[i] - mean) * (draw[i] - mean));
    }
    sort_ascending(draw, how->draws);
    uncertainty->draws = how->draws;
    uncertainty->sample_mean_m2 = mean;
    uncertainty->sample_m2 = sqrt(lrcsi_sum_value(&square) / (how->draws - 1));
    double chance = CHANCE / sqrt(how->draws);
    double apart = fabs(uncertainty->sample_m2 - uncertainty->first_order_m2);
    double bias = fabs(mean - sigma);
    if (apart > lrcsi_most(FIRST_ORDER_SERVES, chance / sqrt(2.0)) * uncertainty->sample_m2 ||
        bias > lrcsi_most(MEAN_SERVES, chance) * uncertainty->sample_m2) {
        uncertainty->sampled = 1;
        uncertainty->deviation_m2 = uncertainty->sample_m2;
        uncertainty->low_m2 = quantile(draw, how->draws, QUANTILE_LOW);
        uncertainty->high_m2 = quantile(draw, how->draws, QUANTILE_HIGH);
    }
}

size_t lrcsi_uncertainty_need(const lrcs_scene *scene, const lrcs_uncertainty_options *how)
{
    size_t need = lrcsi_work_bytes(scene->material_count, sizeof(source));
    need = lrcsi_work_add(
        need, lrcsi_work_bytes((size_t)scene->material_count * LRCSI_NODES, sizeof(lrcsi_node)));
    return lrcsi_work_add(need, lrcsi_work_bytes(how->draws, sizeof(double)));
}

int lrcsi_uncertainty_make(const lrcs_scene *scene, double sigma, const lrcsi_node *node,
                           uint32_t count, const lrcs_uncertainty_options *how, lrcs_work *work,
                           lrcs_uncertainty *uncertainty)
{
    size_t mark = work->used;
    source *list = lrcsi_work_take(work, scene->material_count, sizeof *list);
    lrcsi_node *room = lrcsi_work_take(work, (size_t)scene->material_count * count, sizeof *room);
    double *draw = lrcsi_work_take(work, how->draws, sizeof *draw);
    lrcs_uncertainty out = {0, 0, 0, 0, 0, 0, -1, 0, 0};
    if (!list || !room || !draw) {
        return LRCS_E_MEMORY;
    }
    uint32_t sources = sources_make(scene, node, count, room, list);
    double own = 0;
    double variance = 0;
    for (uint32_t k = 0; k < sources; k++) {
        own += source_sigma(&list[k], count, &list[k].material->brdf);
        variance += source_variance(&list[k], count);
    }
    out.stated = sources > 0;
    out.deviation_m2 = out.first_order_m2 = sqrt(variance);
    out.low_m2 = lrcsi_most(0, sigma - out.deviation_m2);
    out.high_m2 = sigma + out.deviation_m2;
    if (sources > 0 && how->draws > 0) {
        sample_make(list, sources, count, sigma, own, how, draw, &out);
    }
    *uncertainty = out;
    work->used = mark;
    return LRCS_OK;
}
