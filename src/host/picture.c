/* SPDX-License-Identifier: MIT */
/* The picture of a run: each pixel shows what its facet returns for the area it shows the laser,
   sigma / projected area = 4 pi f_r cos(theta), in dB on a perceptually even scale; what returns
   nothing is grey by its slant. It decides how a run looks, never a number of the result. */
#include "host/fail.h"
#include "host/font.h"

#include <math.h>
#include <string.h>

#define OVERSAMPLE  2u   /* raster cells a pixel, each way: smooth outlines */
#define LEGEND_FROM 160u /* smaller pictures have no legend */
#define SCALE_DB    40.0 /* what the scale spans at most */
#define SCALE_BINS  800  /* a histogram of -400 .. 400 dB */

static const unsigned char picture_ground[3] = {13, 17, 28};
static const unsigned char picture_ink[3] = {205, 210, 220};

/* Where things stand, in pixels. */
typedef struct picture_layout {
    uint32_t left, top, side; /* the drawing */
    uint32_t scale;           /* of the letters */
    uint32_t bar_top, bar_height;
} picture_layout;

static picture_layout picture_place(uint32_t size)
{
    picture_layout at = {0, 0, size, 1, 0, 0};
    uint32_t margin = size / 32;
    uint32_t legend = 0;
    if (size >= LEGEND_FROM) {
        at.scale = 1 + size / 900;
        legend = 38 * at.scale;
        at.bar_top = size - legend - margin / 2 + 10 * at.scale;
        at.bar_height = 10 * at.scale;
    }
    at.side = size - 2 * margin - legend;
    at.left = (size - at.side) / 2;
    at.top = margin;
    return at;
}

uint32_t lrcs_host_picture_need(uint32_t size)
{
    return picture_place(size).side * OVERSAMPLE;
}

/* Viridis (S. van der Walt and N. Smith, 2015, CC0) at 0 .. 1, every eighth. */
static void picture_viridis(double value, double rgb[3])
{
    static const unsigned char at[9][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                           {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                           {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
    double place = 8.0 * fmin(fmax(value, 0.0), 1.0);
    int low = place < 8.0 ? (int)place : 7;
    for (int k = 0; k < 3; k++) {
        rgb[k] = at[low][k] + (place - low) * (at[low + 1][k] - at[low][k]);
    }
}

/* sigma per visible projected area in dB, or -HUGE_VAL where nothing comes back. */
static double facet_return(const lrcs_facet_record *record)
{
    if (!(record->sigma_m2 > 0.0) || !(record->visible_area_m2 > 0.0)) {
        return -HUGE_VAL;
    }
    return 10.0 * (log10(record->sigma_m2) - log10(record->visible_area_m2));
}

/* The value below which `share` of the counted cells lie, from a histogram of whole dB. */
static double histogram_at(const uint32_t count[SCALE_BINS], double share)
{
    double total = 0.0;
    double seen = 0.0;
    int bin = 0;
    for (int i = 0; i < SCALE_BINS; i++) {
        total += count[i];
    }
    while (bin < SCALE_BINS - 1 && seen + count[bin] <= share * total) {
        seen += count[bin++];
    }
    return bin - SCALE_BINS / 2.0;
}

/* The scale covers all returns seen but the weakest and strongest half percent of the area, in
   steps of 5 dB; what lies beyond has the end's colour. */
static void scale_read(const lrcs_scene *scene, const lrcs_facet_record *records,
                       const lrcs_image *image, double range[2])
{
    uint32_t count[SCALE_BINS] = {0};
    for (size_t i = 0; i < (size_t)image->size * image->size; i++) {
        uint32_t facet = image->facet[i];
        double value = facet < scene->facet_count ? facet_return(&records[facet]) : -HUGE_VAL;
        double bin = floor(value) + SCALE_BINS / 2.0;
        if (bin >= 0.0 && bin < SCALE_BINS) {
            count[(int)bin]++;
        }
    }
    range[1] = 5.0 * ceil((histogram_at(count, 0.995) + 1.0) / 5.0);
    range[0] = 5.0 * floor(histogram_at(count, 0.005) / 5.0);
    range[0] = fmax(range[0], range[1] - SCALE_DB);
    range[0] = fmin(range[0], range[1] - 10.0);
}

static void facet_colour(const lrcs_facet_record *record, const double range[2], double rgb[3])
{
    double value = facet_return(record);
    if (isfinite(value)) {
        picture_viridis((value - range[0]) / (range[1] - range[0]), rgb);
        return;
    }
    double grey = 45.0 + 75.0 * fmin(fabs(record->cos_theta), 1.0);
    rgb[0] = rgb[1] = rgb[2] = grey;
}

/* Whether an outline runs between two cells: another part, or nothing. */
static int outline_between(const lrcs_scene *scene, uint32_t a, uint32_t b)
{
    int in_a = a < scene->facet_count;
    int in_b = b < scene->facet_count;
    return in_a && (!in_b || scene->facet_part[a] != scene->facet_part[b]);
}

static void cell_colour(const lrcs_scene *scene, const lrcs_facet_record *records,
                        const lrcs_image *image, size_t x, size_t y, const double range[2],
                        double rgb[3])
{
    size_t side = image->size;
    const uint32_t *cell = image->facet + y * side + x;
    if (*cell >= scene->facet_count) {
        for (int k = 0; k < 3; k++) {
            rgb[k] = picture_ground[k];
        }
        return;
    }
    facet_colour(&records[*cell], range, rgb);
    int edge = (x + 1 < side && outline_between(scene, *cell, cell[1])) ||
               (y + 1 < side && outline_between(scene, *cell, cell[side]));
    for (int k = 0; edge && k < 3; k++) {
        rgb[k] *= 0.55;
    }
}

/* Averages cells into the pixels of the drawing. */
static void drawing_make(const lrcs_scene *scene, const lrcs_facet_record *records,
                         const lrcs_image *image, uint32_t size, const picture_layout *at,
                         const double range[2], unsigned char *rgb)
{
    for (uint32_t y = 0; y < at->side; y++) {
        for (uint32_t x = 0; x < at->side; x++) {
            double sum[3] = {0.0, 0.0, 0.0};
            for (uint32_t i = 0; i < OVERSAMPLE * OVERSAMPLE; i++) {
                size_t cx = (size_t)x * OVERSAMPLE + i % OVERSAMPLE;
                size_t cy = (size_t)y * OVERSAMPLE + i / OVERSAMPLE;
                double one[3] = {picture_ground[0], picture_ground[1], picture_ground[2]};
                if (cx < image->size && cy < image->size) {
                    cell_colour(scene, records, image, cx, cy, range, one);
                }
                for (int k = 0; k < 3; k++) {
                    sum[k] += one[k];
                }
            }
            unsigned char *pixel = rgb + 3 * ((size_t)(at->top + y) * size + at->left + x);
            for (int k = 0; k < 3; k++) {
                pixel[k] = (unsigned char)(sum[k] / (OVERSAMPLE * OVERSAMPLE) + 0.5);
            }
        }
    }
}

static void legend_make(uint32_t size, const picture_layout *at, const double range[2],
                        unsigned char *rgb)
{
    uint32_t width = size / 2;
    uint32_t left = (size - width) / 2;
    const char *title = "sigma per projected area, dB";
    uint32_t title_width = (uint32_t)strlen(title) * LRCSI_FONT_ADVANCE * at->scale;
    lrcsi_font_draw(rgb, size, title_width < size ? (size - title_width) / 2 : 0,
                    at->bar_top - 10 * at->scale, at->scale, title, picture_ink);
    for (uint32_t x = 0; x < width; x++) {
        double colour[3];
        picture_viridis(x / (width - 1.0), colour);
        for (uint32_t y = 0; y < at->bar_height; y++) {
            unsigned char *pixel = rgb + 3 * ((size_t)(at->bar_top + y) * size + left + x);
            for (int k = 0; k < 3; k++) {
                pixel[k] = (unsigned char)(colour[k] + 0.5);
            }
        }
    }
    double step = range[1] - range[0] > 20.0 ? 10.0 : 5.0;
    double first = step * ceil(range[0] / step);
    int ticks = (int)((range[1] - first) / step) + 1;
    for (int i = 0; i < ticks; i++) {
        double db = first + i * step;
        char text[16];
        snprintf(text, sizeof text, "%.0f", db);
        uint32_t half = (uint32_t)strlen(text) * LRCSI_FONT_ADVANCE * at->scale / 2;
        double place = (db - range[0]) / (range[1] - range[0]);
        uint32_t x = left + (uint32_t)(place * width);
        lrcsi_font_draw(rgb, size, x > half ? x - half : 0,
                        at->bar_top + at->bar_height + at->scale * 3, at->scale, text, picture_ink);
    }
}

void lrcs_host_picture_make(const lrcs_scene *scene, const lrcs_facet_record *records,
                            const lrcs_image *image, uint32_t size, unsigned char *rgb)
{
    picture_layout at = picture_place(size);
    double range[2];
    for (size_t i = 0; i < (size_t)size * size; i++) {
        memcpy(rgb + 3 * i, picture_ground, 3);
    }
    scale_read(scene, records, image, range);
    drawing_make(scene, records, image, size, &at, range, rgb);
    if (at.bar_height > 0) {
        legend_make(size, &at, range, rgb);
    }
}
