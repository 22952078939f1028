/* SPDX-License-Identifier: MIT */
/* The material uncertainty of sigma: the standard deviation of sigma that follows from the stated
   errors of A, B, s and m. sigma is the sum over materials of A G(s) + B D(m), so that a sample
   needs only the responses G and D of each material near its own s and m. The steps of
   lrcs_uncertainty_run:
   1. The pose, as lrcs_sigma_run (lrcsi_sigma_stages).
   2. The responses of all materials at the nodes of s and m (lrcsi_response_make): over the visible
      areas of that pose or, with curved normals, from a pose for each node (run_node). The visible
      pieces of round walls are integrated at the materials' own s and m only: at other nodes means
      over patches replace them, corrected by their error at the own node (nodes_correct).
   3. The derivatives of sigma, from the node of the materials' own s and m.
   4. Sources: materials with the same source have the same errors, and are combined (sources_make).
   5. First order: with v the four derivatives times the four standard deviations and C the
      correlations, the variance is the sum over sources of v' C v.
   6. The sample: normal deviates with these correlations (C = L L'), clamped to the domain; G and D
      by cubic Hermite interpolation between nodes; mean, standard deviation and quantiles. */
#include <lrcs/uncertainty.h>

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/range.h"
#include "base/sort.h"
#include "base/work.h"
#include "integrate/derivative/sensitivity.h"
#include "integrate/sigma.h"

/* The nodes of each material's s and m, of which the middle one is its own. A heuristic: so many
   that the error of interpolation is small beside the random error of the sample. */
#define NODES        17u
#define NODES_CURVED 9u /* with curved normals, where each node takes a pose */
/* Nodes and draws of s and m extend this many standard deviations to either side: a normal deviate
   is beyond that once in 16,000 draws. */
#define DEVIATIONS_MAX 4.0
/* The smallest s of nodes and draws, relative to the material's own, which keeps it above 0. A
   heuristic: below it sigma changes little. */
#define SLOPE_MIN 0.0625
/* The result to first order is reported unless its standard deviation differs from that of the
   sample by more than this fraction, or the sample's mean differs from sigma by more than this many
   of its standard deviations. Differences below three standard errors are attributed to chance.
   Heuristics: both results are reported. */
#define DEVIATION_DIFFERENCE_MAX 0.05
#define MEAN_DIFFERENCE_MAX      0.1
#define STANDARD_ERRORS          3.0
/* The probabilities of a normal deviate below -1 and below 1 standard deviation. */
#define QUANTILE_LOW  0.15865525393145705
#define QUANTILE_HIGH 0.84134474606854295
/* The polar method accepts a fraction of pi / 4 of all pairs. That it rejects so many in succession
   has a probability of 2e-43. */
#define POLAR_TRIES 64
/* Responses are interpolated in their logarithm unless one is smaller than this. */
#define RESPONSE_MIN 1e-250
#define DRAWS_MAX    (1u << 20)

/* What a term of one material reflects at a node, m2 per unit of amplitude, and its derivative in
   the parameter of that term. */
typedef struct response {
    double value, slope;
} response;

/* A node: the response of the glint, at its s, and that of the diffuse term, at its m. */
typedef struct response_node {
    response glint, diffuse;
} response_node;

lrcs_uncertainty_options lrcs_uncertainty_options_default(void)
{
    return (lrcs_uncertainty_options){4096, 1};
}

/* --- nodes ------------------------------------------------------------------------------------ */

/* The number of nodes that a sample needs. sigma is linear in A and B: if nothing else is
   uncertain, the node of the materials' own s and m suffices. */
static uint32_t node_count(const lrcs_prepared *prepared, const lrcs_uncertainty_options *options)
{
    const lrcs_scene *scene = prepared->scene;
    int nonlinear = 0;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        nonlinear |= scene->material[i].error.s > 0 || scene->material[i].error.m > 0;
    }
    return options->draws == 0 || !nonlinear ? 1
           : prepared->has_curved_normals    ? NODES_CURVED
                                             : NODES;
}

/* The nodes of one parameter, s or m: `count` values from low to high. The middle one is the
   material's own value; the steps from low to it are equal, and so are those from it to high. */
typedef struct node_axis {
    double low, own, high;
    uint32_t count;
} node_axis;

static node_axis axis_of(double own, double deviation, double minimum, uint32_t count)
{
    return (node_axis){lrcsi_max(minimum, own - DEVIATIONS_MAX * deviation), own,
                       own + DEVIATIONS_MAX * deviation, count};
}

static node_axis axis_of_s(const lrcs_material *material, uint32_t count)
{
    return axis_of(material->brdf.s, material->error.s, SLOPE_MIN * material->brdf.s, count);
}

static node_axis axis_of_m(const lrcs_material *material, uint32_t count)
{
    return axis_of(material->brdf.m, material->error.m, 0, count);
}

/* The value of the parameter at node k. */
static double axis_value(const node_axis *axis, uint32_t k)
{
    uint32_t half = axis->count / 2;
    return k < half    ? axis->low + (axis->own - axis->low) * k / half
           : k == half ? axis->own
                       : axis->own + (axis->high - axis->own) * (k - half) / half;
}

/* --- sources ---------------------------------------------------------------------------------- */

/* A source: all materials whose parameters, and so their errors, have the same origin. */
typedef struct source {
    const lrcs_material *material;         /* the first of them */
    node_axis s, m;                        /* the nodes, the same for all of them */
    response glint[NODES], diffuse[NODES]; /* at each node: the sum over them */
    double root[4][4];                     /* L, lower triangular */
} source;

static void correlation_fill(const double c[6], double out[4][4])
{
    const double full[4][4] = {
        {1, c[0], c[1], c[2]}, {c[0], 1, c[3], c[4]}, {c[1], c[3], 1, c[5]}, {c[2], c[4], c[5], 1}};
    memcpy(out, full, sizeof full);
}

/* The Cholesky factor L of C = L L'. If C is singular, so that a pivot is 0 up to rounding (below
   1e-9, a heuristic), the column of that pivot is 0. */
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
        root[j][j] = pivot > 1e-9 ? sqrt(pivot) : 0;
        for (int i = j + 1; i < 4 && root[j][j] > 0; i++) {
            double sum = a[i][j];
            for (int k = 0; k < j; k++) {
                sum -= root[i][k] * root[j][k];
            }
            root[i][j] = sum / root[j][j];
        }
    }
}

static void response_add(response *to, const response *from)
{
    to->value += from->value;
    to->slope += from->slope;
}

/* Lists the sources with errors, each with the sum of the responses of its materials. Returns their
   number. */
static uint32_t sources_make(const lrcs_scene *scene, const response_node *node, uint32_t count,
                             source *list)
{
    uint32_t sources = 0;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *m = &scene->material[i];
        uint32_t at = 0;
        while (at < sources && !(m->source > 0 && list[at].material->source == m->source)) {
            at++;
        }
        const lrcs_brdf_error *e = &m->error;
        if (!(e->A > 0 || e->B > 0 || e->s > 0 || e->m > 0)) {
            continue;
        }
        if (at == sources) {
            list[sources++] =
                (source){.material = m, .s = axis_of_s(m, count), .m = axis_of_m(m, count)};
            correlation_root(e->correlation, list[at].root);
        }
        for (uint32_t k = 0; k < count; k++) {
            const response_node *from = &node[(size_t)k * scene->material_count + i];
            response_add(&list[at].glint[k], &from->glint);
            response_add(&list[at].diffuse[k], &from->diffuse);
        }
    }
    return sources;
}

/* --- first order ------------------------------------------------------------------------------ */

/* The variance v' C v of a source to first order. */
static double source_variance(const source *one)
{
    const lrcs_brdf *brdf = &one->material->brdf;
    const lrcs_brdf_error *e = &one->material->error;
    const response *glint = &one->glint[one->s.count / 2];
    const response *diffuse = &one->diffuse[one->m.count / 2];
    double c[4][4];
    double sum = 0;
    correlation_fill(e->correlation, c);
    const double v[4] = {glint->value * e->A, diffuse->value * e->B, brdf->A * glint->slope * e->s,
                         brdf->B * diffuse->slope * e->m};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            sum += v[i] * c[i][j] * v[j];
        }
    }
    return lrcsi_max(0, sum);
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

/* The response at the value x of a parameter, or at the nearest end of the axis, by cubic Hermite
   interpolation between the two nodes around x. The logarithm of the response is interpolated,
   because on the flank of a glint it varies by orders of magnitude; near underflow the response
   itself is interpolated. Given: the responses at the nodes of the axis. */
static double response_at(const response *node, const node_axis *axis, double x)
{
    uint32_t half = axis->count / 2;
    if (!(axis->count > 1 && axis->high > axis->low)) {
        return node[half].value;
    }
    double from = x < axis->own ? axis->low : axis->own;
    double apart = (x < axis->own ? axis->own - axis->low : axis->high - axis->own) / half;
    double position = apart > 0 ? (x - from) / apart : 0;
    uint32_t k = position > 0 ? (uint32_t)lrcsi_min(position, half - 1) : 0;
    double t = lrcsi_min(1, lrcsi_max(0, position - k));
    k += x < axis->own ? 0 : half;
    double step = axis_value(axis, k + 1) - axis_value(axis, k);
    double f0 = node[k].value;
    double f1 = node[k + 1].value;
    double g0 = node[k].slope;
    double g1 = node[k + 1].slope;
    int logarithmic = f0 > RESPONSE_MIN && f1 > RESPONSE_MIN;
    if (logarithmic) {
        g0 /= f0;
        g1 /= f1;
        f0 = lrcsi_log(f0).hi;
        f1 = lrcsi_log(f1).hi;
    }
    double a = step * g0 - (f1 - f0);
    double b = (f1 - f0) - step * g1;
    double value = f0 + t * (f1 - f0) + t * (1 - t) * ((1 - t) * a + t * b);
    return logarithmic ? lrcsi_exp(value) : lrcsi_max(0, value);
}

/* What the materials of a source reflect with the parameters `at`, m2. */
static double source_sigma(const source *one, const lrcs_brdf *at)
{
    return at->A * response_at(one->glint, &one->s, at->s) +
           at->B * response_at(one->diffuse, &one->m, at->m);
}

/* One draw of a source's parameters, clamped to their domain. */
static lrcs_brdf source_draw(const source *one, uint64_t *state)
{
    const lrcs_brdf *own = &one->material->brdf;
    const lrcs_brdf_error *e = &one->material->error;
    double normal[4];
    double deviate[4] = {0, 0, 0, 0}; /* correlated, in standard deviations */
    random_normal(state, normal);
    random_normal(state, normal + 2);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k <= i; k++) {
            deviate[i] += one->root[i][k] * normal[k];
        }
    }
    for (int i = 2; i < 4; i++) {
        deviate[i] = lrcsi_min(DEVIATIONS_MAX, lrcsi_max(-DEVIATIONS_MAX, deviate[i]));
    }
    return (lrcs_brdf){lrcsi_max(0, own->A + deviate[0] * e->A),
                       lrcsi_max(0, own->B + deviate[1] * e->B),
                       lrcsi_max(SLOPE_MIN * own->s, own->s + deviate[2] * e->s),
                       lrcsi_max(0, own->m + deviate[3] * e->m)};
}

/* A quantile of the sample, by linear interpolation between the order statistics. */
static double quantile(const double *sorted, uint32_t count, double probability)
{
    double position = probability * (count - 1);
    uint32_t k = (uint32_t)lrcsi_min(position, count - 2);
    return sorted[k] + (position - k) * (sorted[k + 1] - sorted[k]);
}

/* --- first order and the sample --------------------------------------------------------------- */

/* Steps 4 to 6. Given: sigma, m2; node[count][material_count], in which the responses of terms that
   the plan leaves out are 0. Status: LRCS_OK; LRCS_E_MEMORY. */
static int estimate_make(const lrcs_scene *scene, double sigma, const response_node *node,
                         uint32_t count, const lrcs_uncertainty_options *options, lrcs_work *work,
                         lrcs_uncertainty *uncertainty)
{
    source *list = lrcsi_work_take(work, scene->material_count, sizeof *list);
    double *draw = lrcsi_work_take(work, options->draws, sizeof *draw);
    lrcs_uncertainty out = {0, 0, 0, 0, 0, 0, -1, 0, 0};
    if (!list || !draw) {
        return LRCS_E_MEMORY;
    }
    uint32_t sources = sources_make(scene, node, count, list); /* 4 */
    double own = 0; /* the part of sigma that the sources add with their own parameters */
    double variance = 0;
    for (uint32_t k = 0; k < sources; k++) { /* 5 */
        own += source_sigma(&list[k], &list[k].material->brdf);
        variance += source_variance(&list[k]);
    }
    out.stated = sources > 0;
    out.deviation_m2 = out.first_order_m2 = sqrt(variance);
    out.low_m2 = lrcsi_max(0, sigma - out.deviation_m2);
    out.high_m2 = sigma + out.deviation_m2;
    if (sources > 0 && options->draws > 0) { /* 6 */
        /* What other materials add. With curved normals the cubature at the own node is not that of
           sigma: if it exceeds sigma, the draws are scaled, so that they are sigma where no
           parameter has an error; otherwise only rounding makes `own` exceed sigma. */
        double fixed = lrcsi_max(0, sigma - own);
        double scale = own > sigma ? sigma / own : 1;
        uint64_t state = options->seed;
        lrcsi_sum sum = {0, 0};
        lrcsi_sum square = {0, 0};
        for (uint32_t i = 0; i < options->draws; i++) {
            draw[i] = fixed;
            for (uint32_t k = 0; k < sources; k++) {
                lrcs_brdf at = source_draw(&list[k], &state);
                draw[i] += scale * source_sigma(&list[k], &at);
            }
            lrcsi_sum_add(&sum, draw[i]);
        }
        double mean = lrcsi_sum_value(&sum) / options->draws;
        for (uint32_t i = 0; i < options->draws; i++) {
            lrcsi_sum_add(&square, (draw[i] - mean) * (draw[i] - mean));
        }
        lrcsi_sort_ascending(draw, options->draws);
        out.draws = options->draws;
        out.sample_mean_m2 = mean;
        out.sample_m2 = sqrt(lrcsi_sum_value(&square) / (options->draws - 1));
        double chance = STANDARD_ERRORS / sqrt(options->draws);
        double difference = fabs(out.sample_m2 - out.first_order_m2);
        double bias = fabs(mean - sigma);
        if (difference > lrcsi_max(DEVIATION_DIFFERENCE_MAX, chance / sqrt(2.0)) * out.sample_m2 ||
            bias > lrcsi_max(MEAN_DIFFERENCE_MAX, chance) * out.sample_m2) {
            out.sampled = 1;
            out.deviation_m2 = out.sample_m2;
            out.low_m2 = quantile(draw, options->draws, QUANTILE_LOW);
            out.high_m2 = quantile(draw, options->draws, QUANTILE_HIGH);
        }
    }
    *uncertainty = out;
    return LRCS_OK;
}

/* --- responses at the nodes ------------------------------------------------------------------- */

/* Memory for the responses of all materials. */
typedef struct response_memory {
    response_node *node;     /* [nodes][material_count] */
    response_node *computed; /* [material_count]: the own node, computed as the others are */
    lrcs_brdf *brdf;         /* [material_count]: at the current node; the next two likewise */
    lrcsi_response *response;
    lrcs_material *material; /* the scene's materials with the parameters of the node */
} response_memory;

size_t lrcs_uncertainty_need(const lrcs_prepared *prepared, const lrcs_run_options *options,
                             const lrcs_uncertainty_options *how)
{
    size_t count = prepared->scene->material_count;
    size_t need = lrcs_sigma_need(prepared, options);
    need = lrcsi_work_add(need, lrcsi_work_bytes(count * NODES, sizeof(response_node)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(response_node)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(lrcs_brdf)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(lrcsi_response)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(lrcs_material)));
    /* estimate_make */
    need = lrcsi_work_add(need, lrcsi_work_bytes(count, sizeof(source)));
    return lrcsi_work_add(need, lrcsi_work_bytes(how->draws, sizeof(double)));
}

/* Computes the responses over the visible areas of a finished run, with the parameters
   memory->brdf: node[material_count]. as_sigma: as for lrcsi_response_make. */
static void node_fill(const lrcsi_sigma *run, int as_sigma, const response_memory *memory,
                      response_node *node)
{
    const lrcs_prepared *p = run->view.prepared;
    uint32_t count = p->scene->material_count;
    lrcsi_response_make(run, memory->brdf, as_sigma, memory->response);
    for (uint32_t i = 0; i < count; i++) {
        const lrcsi_response *at = &memory->response[i];
        node[i] = (response_node){{lrcsi_prepared_area(p, lrcsi_sum_value(&at->glint)),
                                   lrcsi_prepared_area(p, lrcsi_sum_value(&at->glint_s))},
                                  {lrcsi_prepared_area(p, lrcsi_sum_value(&at->diffuse)),
                                   lrcsi_prepared_area(p, lrcsi_sum_value(&at->diffuse_m))}};
    }
}

/* Corrects the response of a term at a node, `apart` from its own one, by a factor that makes value
   and slope right at the own node: f exp(c apart), at most a factor of e from f. Given: at the own
   node, the right response and that computed as at the other nodes. */
static response response_correct(response at, double apart, const response *right,
                                 const response *computed)
{
    if (!(right->value > RESPONSE_MIN && computed->value > RESPONSE_MIN)) {
        return at;
    }
    double c = right->slope / right->value - computed->slope / computed->value;
    double exponent = lrcsi_min(1, lrcsi_max(-1, c * apart));
    double factor = right->value / computed->value * lrcsi_exp(exponent);
    double slope = fabs(exponent) < 1 ? c : 0;
    return (response){factor * at.value, factor * (at.slope + slope * at.value)};
}

/* Corrects all nodes but the own one. Only on curved walls is the own node computed in another way
   (lrcsi_response_make): elsewhere nothing changes. Given: computed[material_count], the own node,
   if there are others. */
static void nodes_correct(const lrcs_scene *scene, response_node *node, uint32_t nodes,
                          const response_node *computed)
{
    const uint32_t count = scene->material_count;
    const response_node *right = node + (size_t)(nodes / 2) * count;
    for (size_t at = 0; at < (size_t)nodes * count; at++) {
        const uint32_t i = (uint32_t)(at % count);
        const uint32_t k = (uint32_t)(at / count);
        const lrcs_material *m = &scene->material[i];
        const node_axis s_axis = axis_of_s(m, nodes);
        const node_axis m_axis = axis_of_m(m, nodes);
        if (k != nodes / 2) {
            node[at].glint = response_correct(node[at].glint, axis_value(&s_axis, k) - m->brdf.s,
                                              &right[i].glint, &computed[i].glint);
            node[at].diffuse =
                response_correct(node[at].diffuse, axis_value(&m_axis, k) - m->brdf.m,
                                 &right[i].diffuse, &computed[i].diffuse);
        }
    }
}

/* Computes the responses at node k of a scene with curved normals, by a run of the pose with the
   parameters of the node and amplitudes of 1. */
static int run_node(const lrcs_prepared *prepared, const lrcs_pose *pose,
                    const lrcs_run_options *options, lrcs_work *work, response_memory *memory,
                    uint32_t k)
{
    size_t mark = work->used;
    lrcs_scene scene = *prepared->scene;
    lrcs_prepared other = *prepared;
    const lrcsi_sigma_request request = {
        .options = options, .last = LRCSI_SIGMA_SUM, .derivatives = 1};
    lrcsi_sigma run;
    for (uint32_t i = 0; i < scene.material_count; i++) {
        memory->material[i] = prepared->scene->material[i];
        memory->material[i].brdf = memory->brdf[i];
        memory->material[i].brdf.A = memory->brdf[i].s > 0 ? 1 : 0;
        memory->material[i].brdf.B = 1;
    }
    scene.material = memory->material;
    other.scene = &scene;
    int status = lrcsi_sigma_stages(&request, &other, pose, work, &run);
    if (status == LRCS_OK) {
        node_fill(&run, 0, memory, memory->node + (size_t)k * scene.material_count);
    }
    work->used = mark;
    return status;
}

/* --- a pose ----------------------------------------------------------------------------------- */

/* Are the options valid, and the errors of all materials? */
static int uncertainty_check(const lrcs_scene *scene, const lrcs_run_options *options,
                             const lrcs_uncertainty_options *how)
{
    if (how->draws == 1 || how->draws > DRAWS_MAX || lrcsi_sigma_check(options, NULL) != LRCS_OK) {
        return LRCS_E_ARGUMENT;
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *m = &scene->material[i];
        if (lrcs_brdf_error_check(&m->brdf, &m->error) != LRCS_OK) {
            return LRCS_E_NUMBER;
        }
    }
    return LRCS_OK;
}

/* The derivatives with respect to the parameters of one material. Given: the responses at the node
   of its own s and m. */
static lrcs_sensitivity sensitivity_of(const lrcs_brdf *brdf, const response_node *own)
{
    return (lrcs_sensitivity){own->glint.value, own->diffuse.value, brdf->A * own->glint.slope,
                              brdf->B * own->diffuse.slope};
}

int lrcs_uncertainty_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                         const lrcs_run_options *options, const lrcs_uncertainty_options *how,
                         lrcs_work *work, lrcs_result *result, lrcs_sensitivity *sensitivity,
                         lrcs_uncertainty *uncertainty)
{
    const lrcs_scene *scene = prepared->scene;
    uint32_t nodes = node_count(prepared, how);
    size_t mark = work->used;
    uint32_t materials = scene->material_count;
    lrcs_result answer;
    lrcs_uncertainty estimate;
    lrcsi_sigma_request request;
    lrcsi_sigma run;
    int status = uncertainty_check(scene, options, how);
    if (status != LRCS_OK) {
        return status;
    }
    response_memory memory;
    memory.node = lrcsi_work_take(work, (size_t)nodes * materials, sizeof *memory.node);
    memory.computed = lrcsi_work_take(work, materials, sizeof *memory.computed);
    memory.brdf = lrcsi_work_take(work, materials, sizeof *memory.brdf);
    memory.response = lrcsi_work_take(work, materials, sizeof *memory.response);
    memory.material = lrcsi_work_take(work, materials, sizeof *memory.material);
    if (!memory.node || !memory.computed || !memory.brdf || !memory.response || !memory.material) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    status = lrcsi_sigma_request_make(prepared, options, work, &request);
    request.derivatives = !prepared->has_curved_normals; /* those take runs of their own */
    size_t start = work->used;
    /* 1 */
    status = status == LRCS_OK ? lrcsi_sigma_stages(&request, prepared, pose, work, &run) : status;
    status = status == LRCS_OK ? lrcsi_sigma_result(&run, &answer) : status;
    for (uint32_t k = 0; k < nodes && status == LRCS_OK; k++) { /* 2 */
        for (uint32_t i = 0; i < materials; i++) {
            const lrcs_material *m = &scene->material[i];
            const node_axis s_axis = axis_of_s(m, nodes);
            const node_axis m_axis = axis_of_m(m, nodes);
            memory.brdf[i] = m->brdf;
            memory.brdf[i].s = axis_value(&s_axis, k);
            memory.brdf[i].m = axis_value(&m_axis, k);
        }
        if (prepared->has_curved_normals) {
            work->used = start; /* the run of the pose is no longer needed */
            status = run_node(prepared, pose, options, work, &memory, k);
        } else {
            const int is_own = k == nodes / 2;
            node_fill(&run, is_own, &memory, memory.node + (size_t)k * materials);
            if (is_own && nodes > 1) {
                node_fill(&run, 0, &memory, memory.computed);
            }
        }
    }
    if (status == LRCS_OK && !prepared->has_curved_normals) {
        nodes_correct(scene, memory.node, nodes, memory.computed);
    }
    work->used = status == LRCS_OK ? start : work->used;
    const response_node *own = memory.node + (size_t)(nodes / 2) * materials;
    for (uint32_t i = 0; i < materials && status == LRCS_OK; i++) { /* 3 */
        lrcs_sensitivity d = sensitivity_of(&scene->material[i].brdf, &own[i]);
        status = isfinite(d.dA + d.dB + d.ds + d.dm) ? LRCS_OK : LRCS_E_NUMBER;
    }
    if (status == LRCS_OK) { /* 4 to 6 */
        status = estimate_make(scene, answer.sigma_m2, memory.node, nodes, how, work, &estimate);
    }
    if (status == LRCS_OK) {
        for (uint32_t i = 0; i < materials; i++) {
            sensitivity[i] = sensitivity_of(&scene->material[i].brdf, &own[i]);
        }
        lrcsi_sigma_part_error_copy(&run);
        *result = answer;
        *uncertainty = estimate;
    }
    work->used = mark;
    return status;
}
