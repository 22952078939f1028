/* SPDX-License-Identifier: MIT */
/* Writes what the laser sees of a case, pixel by pixel: facet and depth at the centre of each, as
   raw data for programs and as PNG for people. Row 0 is at the top, column 0 at the left;
   little-endian on every machine. */
#include "host/kit/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct images_case {
    const lrcsi_vectors_case *one;
    const lrcs_scene *scene;
    const lrcs_image *image;
    double *depth; /* m towards the laser, NaN if there is no facet */
    double farthest, nearest;
} images_case;

static void bytes_put(FILE *out, uint64_t value, int count)
{
    for (int i = 0; i < count; i++) {
        putc((int)(value >> (8 * i) & 255u), out);
    }
}

static int item_raw(FILE *out, const void *context, lrcs_host_error *error)
{
    const lrcs_image *image = ((const images_case *)context)->image;
    (void)error;
    for (size_t i = 0; i < (size_t)image->size * image->size; i++) {
        bytes_put(out, image->facet[i], 4);
    }
    return LRCS_OK;
}

static int depth_raw(FILE *out, const void *context, lrcs_host_error *error)
{
    const images_case *file = context;
    (void)error;
    for (size_t i = 0; i < (size_t)file->image->size * file->image->size; i++) {
        uint64_t bits;
        memcpy(&bits, &file->depth[i], sizeof bits);
        bytes_put(out, isnan(file->depth[i]) ? 0x7ff8000000000000u : bits, 8);
    }
    return LRCS_OK;
}

/* Facets as colours: facet + 1 as red * 65536 + green * 256 + blue, black for none (3 channels); or
   depths as greys: lighter is nearer, black for none (1 channel). */
static int png_make(FILE *out, const images_case *file, uint32_t channels, lrcs_host_error *error)
{
    uint32_t side = file->image->size;
    size_t count = (size_t)side * side;
    double range = file->nearest - file->farthest;
    unsigned char *pixels = malloc(count * channels);
    if (!pixels) {
        return lrcsi_host_out_of_memory(error);
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t id = file->image->facet[i] + 1u;
        double rise = range > 0.0 ? (file->depth[i] - file->farthest) / range : 1.0;
        double grey = isnan(file->depth[i]) ? 0.0 : 40.0 + 215.0 * rise;
        for (uint32_t k = 0; k < channels; k++) {
            uint32_t value = channels == 1 ? (uint32_t)grey : id >> (16 - 8 * k) & 255u;
            pixels[i * channels + k] = (unsigned char)value;
        }
    }
    int status = lrcs_host_png_write(out, pixels, side, side, channels, NULL, error);
    free(pixels);
    return status;
}

static int item_png(FILE *out, const void *context, lrcs_host_error *error)
{
    return png_make(out, context, 3, error);
}

static int depth_png(FILE *out, const void *context, lrcs_host_error *error)
{
    return png_make(out, context, 1, error);
}

/* The depth of each pixel: where the line of sight through its centre intersects the plane of the
   facet that is seen there. */
static void depth_fill(images_case *file)
{
    const lrcs_image *image = file->image;
    double step = image->side_m / image->size;
    file->nearest = -HUGE_VAL;
    file->farthest = HUGE_VAL;
    for (size_t i = 0; i < (size_t)image->size * image->size; i++) {
        size_t row = i / image->size;
        size_t column = i % image->size;
        double x = image->left_m + ((double)column + 0.5) * step;
        double y = image->top_m - ((double)row + 0.5) * step;
        double v[3][3];
        file->depth[i] = (double)NAN;
        if (image->facet[i] == LRCS_NONE) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const double *p = file->scene->vertex[file->scene->facet[image->facet[i]].corner[k]].x;
            for (int axis = 0; axis < 3; axis++) {
                const double *r = file->one->pose.R[axis];
                v[k][axis] = r[0] * p[0] + r[1] * p[1] + r[2] * p[2];
            }
        }
        const double a[3] = {v[1][0] - v[0][0], v[1][1] - v[0][1], v[1][2] - v[0][2]};
        const double b[3] = {v[2][0] - v[0][0], v[2][1] - v[0][1], v[2][2] - v[0][2]};
        const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                             a[0] * b[1] - a[1] * b[0]};
        file->depth[i] = v[0][2] - (n[0] * (x - v[0][0]) + n[1] * (y - v[0][1])) / n[2];
        file->nearest = fmax(file->nearest, file->depth[i]);
        file->farthest = fmin(file->farthest, file->depth[i]);
    }
}

int lrcsi_vectors_images_write(const lrcsi_vectors_job *job, const lrcsi_vectors_case *one,
                               const lrcs_scene *scene, const lrcs_image *image,
                               lrcs_host_error *error)
{
    static const lrcsi_vectors_file file[] = {{"item.u32", item_raw},
                                              {"item.png", item_png},
                                              {"depth.f64", depth_raw},
                                              {"depth.png", depth_png}};
    images_case context = {.one = one, .scene = scene, .image = image};
    char prefix[LRCSI_KIT_PATH];
    int status = lrcsi_kit_path(prefix, error, "%s/truth/%s.%s.", job->folder, one->scene->name,
                                one->attitude->name);
    if (status != LRCS_OK) {
        return status;
    }
    context.depth = malloc((size_t)image->size * image->size * sizeof *context.depth);
    if (!context.depth) {
        return lrcsi_host_out_of_memory(error);
    }
    depth_fill(&context);
    status = lrcsi_vectors_write(prefix, file, 4, &context, error);
    free(context.depth);
    return status;
}
