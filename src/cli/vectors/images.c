/* SPDX-License-Identifier: MIT */
/* Writes what the laser sees of a case, pixel by pixel: facet and depth at the centre of each, as
   raw data for programs and as PNG for people. Row 0 is at the top, column 0 at the left;
   little-endian on every machine. */
#include "cli/vectors/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct images_case {
    const vectors_case *one;
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

/* Writes pixels with colours computed by `colour` from their indices. */
typedef void images_colour(const images_case *file, size_t i, unsigned char *pixel);

static int png_make(FILE *out, const images_case *file, uint32_t channels, images_colour *colour,
                    lrcs_host_error *error)
{
    uint32_t side = file->image->size;
    size_t count = (size_t)side * side;
    unsigned char *pixels = malloc(count * channels);
    if (!pixels) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return LRCS_E_SYSTEM;
    }
    for (size_t i = 0; i < count; i++) {
        colour(file, i, pixels + i * channels);
    }
    int status = lrcs_host_png_write(out, pixels, side, side, channels, NULL, error);
    free(pixels);
    return status;
}

/* Facet + 1 as red * 65536 + green * 256 + blue; black for none. */
static void item_colour(const images_case *file, size_t i, unsigned char *pixel)
{
    uint32_t id = file->image->facet[i] + 1u;
    pixel[0] = (unsigned char)(id >> 16 & 255u);
    pixel[1] = (unsigned char)(id >> 8 & 255u);
    pixel[2] = (unsigned char)(id & 255u);
}

/* Lighter is nearer; black for none. */
static void depth_colour(const images_case *file, size_t i, unsigned char *pixel)
{
    double range = file->nearest - file->farthest;
    double rise = range > 0.0 ? (file->depth[i] - file->farthest) / range : 1.0;
    pixel[0] = (unsigned char)(isnan(file->depth[i]) ? 0.0 : 40.0 + 215.0 * rise);
}

static int item_png(FILE *out, const void *context, lrcs_host_error *error)
{
    return png_make(out, context, 3, item_colour, error);
}

static int depth_png(FILE *out, const void *context, lrcs_host_error *error)
{
    return png_make(out, context, 1, depth_colour, error);
}

/* The depth at which the line of sight through a point of the view plane intersects a facet's
   plane. */
static double facet_depth(const images_case *file, uint32_t facet, double x, double y)
{
    const lrcs_pose *pose = &file->one->pose;
    double v[3][3];
    for (int k = 0; k < 3; k++) {
        const double *p = file->scene->vertex[file->scene->facet[facet].corner[k]].x;
        for (int row = 0; row < 3; row++) {
            const double *r = pose->R[row];
            v[k][row] = r[0] * p[0] + r[1] * p[1] + r[2] * p[2];
        }
    }
    const double a[3] = {v[1][0] - v[0][0], v[1][1] - v[0][1], v[1][2] - v[0][2]};
    const double b[3] = {v[2][0] - v[0][0], v[2][1] - v[0][1], v[2][2] - v[0][2]};
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    return v[0][2] - (n[0] * (x - v[0][0]) + n[1] * (y - v[0][1])) / n[2];
}

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
        int seen = image->facet[i] != LRCS_NONE;
        file->depth[i] = seen ? facet_depth(file, image->facet[i], x, y) : (double)NAN;
        file->nearest = seen ? fmax(file->nearest, file->depth[i]) : file->nearest;
        file->farthest = seen ? fmin(file->farthest, file->depth[i]) : file->farthest;
    }
}

int cli_vectors_images(const vectors_job *job, const vectors_case *one, const lrcs_scene *scene,
                       const lrcs_image *image)
{
    static const vectors_file file[] = {{"item.u32", item_raw},
                                        {"item.png", item_png},
                                        {"depth.f64", depth_raw},
                                        {"depth.png", depth_png}};
    images_case context = {.one = one, .scene = scene, .image = image};
    char prefix[KIT_PATH];
    if (cli_kit_path(prefix, "%s/truth/%s.%s.", job->folder, one->scene->name,
                     one->attitude->name) != 0) {
        return CLI_FAILED;
    }
    context.depth = malloc((size_t)image->size * image->size * sizeof *context.depth);
    if (!context.depth) {
        return cli_out_of_memory();
    }
    depth_fill(&context);
    int code = cli_vectors_write(prefix, file, 4, &context);
    free(context.depth);
    return code;
}
