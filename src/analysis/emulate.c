/* SPDX-License-Identifier: MIT */
/* sigma as graphics hardware computes it: a shade for every facet, and the sum of the shades of all
   pixels. This file decides how f_r cos(theta) is evaluated and added at the chosen precision;
   analysis/gpu.c decides which facet owns which pixel. */
#include <lrcs/emulate.h>

#include <math.h>
#include <string.h>

#include "analysis/gpu.h"
#include "base/constant.h"
#include "base/single.h"
#include "base/work.h"
#include "integrate/image.h"

static const char *const precision_name[] = {"float64", "float32"};

const char *lrcs_precision_text(int precision)
{
    return precision == LRCS_PRECISION_FLOAT64 || precision == LRCS_PRECISION_FLOAT32
               ? precision_name[precision]
               : NULL;
}

int lrcs_precision_find(const char *name)
{
    for (int i = LRCS_PRECISION_FLOAT64; i <= LRCS_PRECISION_FLOAT32; i++) {
        if (strcmp(name, precision_name[i]) == 0) {
            return i;
        }
    }
    return LRCS_E_NAME;
}

lrcs_emulation_options lrcs_emulation_options_default(void)
{
    return (lrcs_emulation_options){1024, LRCS_PRECISION_FLOAT64, 64};
}

/* --- shades ----------------------------------------------------------------------------------- */

/* f_r cos(theta) of a facet, its two terms separately. */
typedef struct gpu_shade {
    double glint, diffuse, cos_theta;
} gpu_shade;

/* The product of R and the facet's unit normal, both as they are uploaded. */
static void shade_normal(const lrcsi_view *view, int single, uint32_t facet, double out[3])
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    for (int k = 0; k < 3; k++) {
        double part[3];
        for (int j = 0; j < 3; j++) {
            part[j] = lrcsi_single(single, lrcsi_single(single, view->R[k][j]) *
                                               lrcsi_single(single, n->high[j] / n->length));
        }
        out[k] = lrcsi_single(single, lrcsi_single(single, part[0] + part[1]) + part[2]);
    }
}

/* A exp(-(tan / s)^2) / cos^5. The tangent is computed from the components of the normal: from the
   cosine alone, floats would lose a narrow glint. The result is infinite only if it exceeds the
   range of the precision; it is 0 if the exponential is 0. */
static double shade_glint(int single, const lrcs_brdf *brdf, double cos_theta, double across,
                          double along)
{
    double A = lrcsi_single(single, brdf->A);
    double s = lrcsi_single(single, brdf->s);
    double x = across > 0 ? lrcsi_single(single, across / lrcsi_single(single, along * s)) : 0;
    double e = lrcsi_single(single, exp(-lrcsi_single(single, x * x)));
    double c2 = lrcsi_single(single, cos_theta * cos_theta);
    double c5 = lrcsi_single(single, lrcsi_single(single, c2 * c2) * cos_theta);
    return A > 0 && e > 0 ? lrcsi_single(single, A * lrcsi_single(single, e / c5)) : 0;
}

/* B cos^m cos. */
static double shade_diffuse(int single, const lrcs_brdf *brdf, double cos_theta)
{
    double B = lrcsi_single(single, brdf->B);
    double power = lrcsi_single(single, pow(cos_theta, lrcsi_single(single, brdf->m)));
    double weight = lrcsi_single(single, power * cos_theta);
    return B > 0 && weight > 0 ? lrcsi_single(single, B * weight) : 0;
}

/* A facet whose visible side reflects nothing has no shade. */
static gpu_shade shade_make(const lrcsi_gpu *gpu, uint32_t facet)
{
    int single = gpu->single;
    const lrcs_material *material = lrcsi_prepared_material(gpu->view->prepared, facet);
    double n[3];
    shade_normal(gpu->view, single, facet, n);
    double across2 =
        lrcsi_single(single, lrcsi_single(single, n[0] * n[0]) + lrcsi_single(single, n[1] * n[1]));
    double length = lrcsi_single(
        single, sqrt(lrcsi_single(single, across2 + lrcsi_single(single, n[2] * n[2]))));
    gpu_shade shade = {.cos_theta = lrcsi_single(single, n[2] / length)};
    double c = fabs(shade.cos_theta);
    if (shade.cos_theta > 0 || (c > 0 && material->two_sided)) {
        double across = lrcsi_single(single, sqrt(across2));
        shade.glint = shade_glint(single, &material->brdf, c, across, fabs(n[2]));
        shade.diffuse = shade_diffuse(single, &material->brdf, c);
    }
    return shade;
}

/* --- sums ------------------------------------------------------------------------------------- */

#define LEVELS 29 /* pairs of pairs of ... 16384^2 pixels */

/* A pairwise sum in progress: if bit k of the count is set, level[k] is the sum of 2^k terms. */
typedef struct pair_sum {
    double level[LEVELS];
    uint32_t count;
} pair_sum;

static void pair_add(pair_sum *sum, int single, double x)
{
    int k = 0;
    for (uint32_t bits = sum->count; bits & 1u; bits >>= 1, k++) {
        x = lrcsi_single(single, sum->level[k] + x);
    }
    sum->level[k] = x;
    sum->count++;
}

/* Adds the remaining partial sums, the shortest first. */
static double pair_value(const pair_sum *sum, int single)
{
    double total = 0;
    for (int k = 0; k < LEVELS; k++) {
        total = sum->count >> k & 1u ? lrcsi_single(single, sum->level[k] + total) : total;
    }
    return total;
}

/* The steps after the item buffer. */
typedef struct gpu_totals {
    double glint, diffuse; /* of f_r cos(theta) over pixels, in pairs */
    double running[2];     /* the same, added one pixel after the other */
    uint64_t owned;        /* pixels */
} gpu_totals;

static gpu_totals totals_make(const lrcsi_gpu *gpu, const gpu_shade *shade)
{
    static const gpu_shade none = {0, 0, 0};
    pair_sum glint = {.count = 0};
    pair_sum diffuse = {.count = 0};
    gpu_totals totals = {.owned = 0};
    for (size_t i = 0; i < (size_t)gpu->size * gpu->size; i++) {
        const gpu_shade *at = gpu->owner[i] != LRCS_NONE ? &shade[gpu->owner[i]] : &none;
        totals.owned += at != &none;
        pair_add(&glint, gpu->single, at->glint);
        pair_add(&diffuse, gpu->single, at->diffuse);
        totals.running[0] = lrcsi_single(gpu->single, totals.running[0] + at->glint);
        totals.running[1] = lrcsi_single(gpu->single, totals.running[1] + at->diffuse);
    }
    totals.glint = pair_value(&glint, gpu->single);
    totals.diffuse = pair_value(&diffuse, gpu->single);
    return totals;
}

/* --- outputs ---------------------------------------------------------------------------------- */

/* The area of a pixel in square metres, times x. */
static double pixels_area(const lrcsi_gpu *gpu, double x)
{
    double pixel = gpu->view->side / gpu->size;
    return lrcsi_prepared_area(gpu->view->prepared, x * pixel * pixel);
}

static void records_fill(const lrcsi_gpu *gpu, const gpu_shade *shade, lrcs_facet_record *records)
{
    const lrcs_prepared *p = gpu->view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        records[f] = (lrcs_facet_record){.area_m2 = 0};
        if (!p->skip[f]) {
            records[f].area_m2 = lrcsi_prepared_area(p, 0.5 * p->normal[f].length);
            records[f].cos_theta = shade[f].cos_theta;
        }
    }
    for (size_t i = 0; i < (size_t)gpu->size * gpu->size; i++) {
        if (gpu->owner[i] != LRCS_NONE) {
            records[gpu->owner[i]].visible_area_m2 += 1;
        }
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        double pixels = records[f].visible_area_m2;
        records[f].visible_area_m2 = pixels_area(gpu, pixels);
        if (pixels > 0) { /* shades of facets without pixels may be infinite */
            records[f].sigma_glint_m2 = pixels_area(gpu, LRCS_FOUR_PI * pixels * shade[f].glint);
            records[f].sigma_m2 = records[f].sigma_glint_m2 +
                                  pixels_area(gpu, LRCS_FOUR_PI * pixels * shade[f].diffuse);
        }
    }
}

static lrcs_emulation emulation_make(const lrcsi_gpu *gpu, const gpu_totals *totals)
{
    lrcs_emulation e;
    e.sigma_glint_m2 = pixels_area(gpu, LRCS_FOUR_PI * totals->glint);
    e.sigma_diffuse_m2 = pixels_area(gpu, LRCS_FOUR_PI * totals->diffuse);
    e.sigma_m2 = e.sigma_glint_m2 + e.sigma_diffuse_m2;
    e.running_m2 = pixels_area(gpu, LRCS_FOUR_PI * totals->running[0]) +
                   pixels_area(gpu, LRCS_FOUR_PI * totals->running[1]);
    e.projected_area_m2 = pixels_area(gpu, (double)totals->owned);
    return e;
}

/* --- one run ---------------------------------------------------------------------------------- */

static int emulation_check(const lrcs_prepared *prepared, const lrcs_emulation_options *options,
                           const lrcs_image *image)
{
    uint32_t bits = options->depth_bits;
    if (options->resolution < 1 || options->resolution > LRCSI_IMAGE_SIZE_MAX ||
        !lrcs_precision_text(options->precision) ||
        (bits != 16 && bits != 24 && bits != 32 && bits != 64) ||
        (image && image->size != options->resolution)) {
        return LRCS_E_ARGUMENT;
    }
    return prepared->smooth ? LRCS_E_UNSUPPORTED : LRCS_OK;
}

size_t lrcs_emulate_need(const lrcs_prepared *prepared, const lrcs_emulation_options *options)
{
    size_t shades = lrcsi_work_bytes(prepared->scene->facet_count, sizeof(gpu_shade));
    size_t need = lrcsi_work_add(lrcsi_view_need(prepared), shades);
    return lrcsi_work_add(need, lrcsi_gpu_need(prepared, options->resolution));
}

static gpu_shade *shades_make(const lrcsi_gpu *gpu, lrcs_work *work)
{
    const lrcs_prepared *p = gpu->view->prepared;
    gpu_shade *shade = lrcsi_work_take_zero(work, p->scene->facet_count, sizeof *shade);
    for (uint32_t f = 0; shade && f < p->scene->facet_count; f++) {
        if (!p->skip[f]) {
            shade[f] = shade_make(gpu, f);
        }
    }
    return shade;
}

/* Nothing can fail after the sums: outputs are written last. */
static int emulate_in(lrcsi_view *view, const lrcs_emulation_options *options, lrcs_work *work,
                      lrcs_emulation *emulation, lrcs_facet_record *records, lrcs_image *image)
{
    lrcsi_gpu gpu;
    int status = lrcsi_gpu_make(view, options, work, &gpu);
    if (status != LRCS_OK) {
        return status;
    }
    const gpu_shade *shade = shades_make(&gpu, work);
    if (!shade) {
        return LRCS_E_MEMORY;
    }
    gpu_totals totals = totals_make(&gpu, shade);
    lrcs_emulation e = emulation_make(&gpu, &totals);
    if (!isfinite(e.sigma_m2 + e.running_m2)) {
        return LRCS_E_NUMBER;
    }
    *emulation = e;
    if (records) {
        records_fill(&gpu, shade, records);
    }
    if (image) {
        lrcsi_image_fill(view, gpu.owner, image);
    }
    return LRCS_OK;
}

int lrcs_emulate_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                     const lrcs_emulation_options *options, lrcs_work *work,
                     lrcs_emulation *emulation, lrcs_facet_record *records, lrcs_image *image)
{
    lrcsi_view view;
    size_t mark = work->used;
    int status = emulation_check(prepared, options, image);
    status = status == LRCS_OK ? lrcsi_view_make(prepared, pose, work, &view) : status;
    if (status == LRCS_OK) {
        status = emulate_in(&view, options, work, emulation, records, image);
    }
    work->used = mark;
    return status;
}
