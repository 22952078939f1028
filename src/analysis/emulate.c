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

/* The shade of a facet; none if its visible side reflects nothing. Every operation is rounded to
   the precision.
   1. The product of R and the unit normal, both as they are uploaded.
   2. The cosine and the sine of the incidence angle, times the length of that product.
   3. The glint A exp(-(tan / s)^2) / cos^5. The tangent is computed from the components of the
      normal: from the cosine alone, floats would lose a narrow glint. It is infinite only if it
      exceeds the range of the precision; it is 0 if the exponential is 0.
   4. The diffuse term B cos^m cos. */
static gpu_shade shade_make(const lrcsi_gpu *gpu, uint32_t facet)
{
    int single = gpu->single;
    const lrcsi_view *view = &gpu->view;
    const lrcs_material *material = lrcsi_prepared_material(view->prepared, facet);
    const lrcs_brdf *brdf = &material->brdf;
    const lrcsi_normal *normal = &view->prepared->normal[facet];
    double n[3];
    for (int k = 0; k < 3; k++) { /* 1 */
        double product[3];
        for (int j = 0; j < 3; j++) {
            product[j] =
                lrcsi_single(single, lrcsi_single(single, view->R[k][j]) *
                                         lrcsi_single(single, normal->high[j] / normal->length));
        }
        n[k] = lrcsi_single(single, lrcsi_single(single, product[0] + product[1]) + product[2]);
    }
    double across2 = /* 2 */
        lrcsi_single(single, lrcsi_single(single, n[0] * n[0]) + lrcsi_single(single, n[1] * n[1]));
    double length = lrcsi_single(
        single, sqrt(lrcsi_single(single, across2 + lrcsi_single(single, n[2] * n[2]))));
    gpu_shade shade = {.cos_theta = lrcsi_single(single, n[2] / length)};
    double c = fabs(shade.cos_theta);
    if (!(shade.cos_theta > 0 || (c > 0 && material->two_sided))) {
        return shade;
    }
    double across = lrcsi_single(single, sqrt(across2));
    double A = lrcsi_single(single, brdf->A); /* 3 */
    double s = lrcsi_single(single, brdf->s);
    double x = across > 0 ? lrcsi_single(single, across / lrcsi_single(single, fabs(n[2]) * s)) : 0;
    double e = lrcsi_single(single, exp(-lrcsi_single(single, x * x)));
    double c2 = lrcsi_single(single, c * c);
    double c5 = lrcsi_single(single, lrcsi_single(single, c2 * c2) * c);
    shade.glint = A > 0 && e > 0 ? lrcsi_single(single, A * lrcsi_single(single, e / c5)) : 0;
    double B = lrcsi_single(single, brdf->B); /* 4 */
    double power = lrcsi_single(single, pow(c, lrcsi_single(single, brdf->m)));
    double weight = lrcsi_single(single, power * c);
    shade.diffuse = B > 0 && weight > 0 ? lrcsi_single(single, B * weight) : 0;
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

/* --- outputs ---------------------------------------------------------------------------------- */

/* The area of a pixel in square metres, times x. */
static double pixels_area(const lrcsi_gpu *gpu, double x)
{
    double pixel = gpu->view.side / gpu->size;
    return lrcsi_prepared_area(gpu->view.prepared, x * pixel * pixel);
}

static void records_fill(const lrcsi_gpu *gpu, const gpu_shade *shade, lrcs_facet_record *records)
{
    const lrcs_prepared *p = gpu->view.prepared;
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

/* Adds the shades of all pixels, each term in pairs and one after the other. */
static lrcs_emulation pixels_add(const lrcsi_gpu *gpu, const gpu_shade *shade)
{
    static const gpu_shade none = {0, 0, 0};
    pair_sum glint = {.count = 0};
    pair_sum diffuse = {.count = 0};
    double running_glint = 0;
    double running_diffuse = 0;
    uint64_t owned = 0; /* pixels that show a facet */
    for (size_t i = 0; i < (size_t)gpu->size * gpu->size; i++) {
        const gpu_shade *at = gpu->owner[i] != LRCS_NONE ? &shade[gpu->owner[i]] : &none;
        owned += at != &none;
        pair_add(&glint, gpu->single, at->glint);
        pair_add(&diffuse, gpu->single, at->diffuse);
        running_glint = lrcsi_single(gpu->single, running_glint + at->glint);
        running_diffuse = lrcsi_single(gpu->single, running_diffuse + at->diffuse);
    }
    lrcs_emulation e;
    e.sigma_glint_m2 = pixels_area(gpu, LRCS_FOUR_PI * pair_value(&glint, gpu->single));
    e.sigma_diffuse_m2 = pixels_area(gpu, LRCS_FOUR_PI * pair_value(&diffuse, gpu->single));
    e.sigma_m2 = e.sigma_glint_m2 + e.sigma_diffuse_m2;
    e.running_m2 = pixels_area(gpu, LRCS_FOUR_PI * running_glint) +
                   pixels_area(gpu, LRCS_FOUR_PI * running_diffuse);
    e.projected_area_m2 = pixels_area(gpu, (double)owned);
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
    return prepared->has_curved_normals ? LRCS_E_UNSUPPORTED : LRCS_OK;
}

size_t lrcs_emulate_need(const lrcs_prepared *prepared, const lrcs_emulation_options *options)
{
    size_t shades = lrcsi_work_bytes(prepared->scene->facet_count, sizeof(gpu_shade));
    size_t need = lrcsi_work_add(lrcsi_view_need(prepared), shades);
    return lrcsi_work_add(need, lrcsi_gpu_need(prepared, options->resolution));
}

int lrcs_emulate_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                     const lrcs_emulation_options *options, lrcs_work *work,
                     lrcs_emulation *emulation, lrcs_facet_record *records, lrcs_image *image)
{
    lrcsi_view view;
    lrcsi_gpu gpu;
    gpu_shade *shade = NULL;
    lrcs_emulation e = {0};
    uint32_t facets = prepared->scene->facet_count;
    size_t mark = work->used;
    int status = emulation_check(prepared, options, image);
    status = status == LRCS_OK ? lrcsi_view_make(prepared, pose, work, &view) : status;
    status = status == LRCS_OK ? lrcsi_gpu_make(&view, options, work, &gpu) : status;
    if (status == LRCS_OK) {
        shade = lrcsi_work_take_zero(work, facets, sizeof *shade);
        status = shade ? LRCS_OK : LRCS_E_MEMORY;
    }
    if (status == LRCS_OK) {
        for (uint32_t f = 0; f < facets; f++) {
            if (!prepared->skip[f]) {
                shade[f] = shade_make(&gpu, f);
            }
        }
        e = pixels_add(&gpu, shade);
        status = isfinite(e.sigma_m2 + e.running_m2) ? LRCS_OK : LRCS_E_NUMBER;
    }
    if (status == LRCS_OK) { /* nothing can fail from here on: outputs may be touched */
        *emulation = e;
        if (records) {
            records_fill(&gpu, shade, records);
        }
        if (image) {
            lrcsi_image_fill(&gpu.view, gpu.owner, image);
        }
    }
    work->used = mark;
    return status;
}
