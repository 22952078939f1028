/* SPDX-License-Identifier: MIT */
/* The colours for numbers and names. It does not decide what they represent. */
#include "host/chart/palette.h"
#include "base/constant.h"

#include <math.h>

/* M. Okabe and K. Ito, Color Universal Design, 2008. */
static const uint32_t palette_names[] = {0x000000u, 0xe69f00u, 0x56b4e9u, 0x009e73u,
                                         0xf0e442u, 0x0072b2u, 0xd55e00u, 0xcc79a7u};

/* Viridis (S. van der Walt and N. Smith, 2015, CC0), every eighth. */
static const unsigned char palette_viridis[LRCSI_PALETTE_KNOTS][3] = {
    {68, 1, 84},    {71, 44, 122}, {59, 81, 139},  {44, 113, 142}, {33, 144, 141},
    {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};

#define GRID_SIDE    9u   /* candidates per channel */
#define GRID_L_MIN   38.0 /* the range of L* of candidates */
#define GRID_L_MAX   90.0
#define GRID_COLOURS (GRID_SIDE * GRID_SIDE * GRID_SIDE)

static uint32_t palette_pack(const double rgb[3])
{
    uint32_t colour = 0;
    for (int k = 0; k < 3; k++) {
        colour = colour << 8 | (uint32_t)(fmin(fmax(rgb[k], 0.0), 255.0) + 0.5);
    }
    return colour;
}

uint32_t lrcsi_palette_named(int colour)
{
    return palette_names[colour & 7];
}

uint32_t lrcsi_palette_viridis(double value)
{
    double place = (LRCSI_PALETTE_KNOTS - 1) * fmin(fmax(value, 0.0), 1.0);
    int low = (int)fmin(place, LRCSI_PALETTE_KNOTS - 2);
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        double from = palette_viridis[low][k];
        rgb[k] = from + (place - low) * (palette_viridis[low + 1][k] - from);
    }
    return palette_pack(rgb);
}

/* Successive hues differ by the golden ratio of a turn, so that any few neighbours are far apart;
   every third is pale. */
uint32_t lrcsi_palette_distinct(uint32_t number)
{
    double turn = fmod(0.6180339887498949 * (number % 65536u) + 0.08, 1.0);
    double pale = 45.0 * (number % 3);
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        double wave = cos(2.0 * LRCS_PI * (turn - k / 3.0));
        rgb[k] = 115.0 + 0.6 * pale + (105.0 - 0.4 * pale) * wave;
    }
    return palette_pack(rgb);
}

/* CIE 1976 L*, a*, b* of an sRGB colour under D65 (IEC 61966-2-1, CIE 15): equal distances look
   about equally different. */
static void palette_lab(uint32_t colour, double lab[3])
{
    static const double xyz[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    static const double white[3] = {0.9505, 1.0, 1.089};
    double linear[3];
    double f[3];
    for (int k = 0; k < 3; k++) {
        double c = (colour >> (16 - 8 * k) & 255u) / 255.0;
        linear[k] = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    }
    for (int k = 0; k < 3; k++) {
        double t =
            (xyz[k][0] * linear[0] + xyz[k][1] * linear[1] + xyz[k][2] * linear[2]) / white[k];
        f[k] = t > 216.0 / 24389.0 ? cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    }
    lab[0] = 116.0 * f[1] - 16.0;
    lab[1] = 500.0 * (f[0] - f[1]);
    lab[2] = 200.0 * (f[1] - f[2]);
}

static uint32_t grid_colour(uint32_t i)
{
    uint32_t step = 255u / (GRID_SIDE - 1u);
    return i % GRID_SIDE * step << 16 | i / GRID_SIDE % GRID_SIDE * step << 8 |
           i / (GRID_SIDE * GRID_SIDE) * step;
}

static double lab_distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The first seven are Okabe and Ito's; each further one is the colour of a 9 x 9 x 9 grid that
   is farthest from all previous ones and from the backgrounds of pictures. */
void lrcsi_palette_categorical(uint32_t count, uint32_t *colour)
{
    static const uint32_t background[] = {0xffffffu, 0x0d111cu, 0x787878u};
    double distance[GRID_COLOURS]; /* of a candidate from all that are taken */
    double candidate[GRID_COLOURS][3];
    double lab[3];
    for (uint32_t i = 0; i < GRID_COLOURS; i++) {
        palette_lab(grid_colour(i), candidate[i]);
        distance[i] =
            candidate[i][0] >= GRID_L_MIN && candidate[i][0] <= GRID_L_MAX ? HUGE_VAL : -1.0;
    }
    for (uint32_t n = 0; n < count + 3; n++) {
        uint32_t best = 0;
        for (uint32_t i = 0; n >= 10 && i < GRID_COLOURS; i++) {
            best = distance[i] > distance[best] ? i : best;
        }
        uint32_t taken = n < 3 ? background[n] : n < 10 ? palette_names[n - 2] : grid_colour(best);
        palette_lab(taken, lab);
        for (uint32_t i = 0; i < GRID_COLOURS; i++) {
            distance[i] = fmin(distance[i], lab_distance(lab, candidate[i]));
        }
        if (n >= 3) {
            colour[n - 3] = taken;
        }
    }
}

uint32_t lrcsi_palette_shade(uint32_t colour, double light)
{
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        rgb[k] = light * (colour >> (16 - 8 * k) & 255u);
    }
    return palette_pack(rgb);
}

uint32_t lrcsi_palette_tint(uint32_t colour, double fraction)
{
    uint32_t tint = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        double part = 255.0 - fraction * (255.0 - (double)(colour >> shift & 0xffu));
        tint |= (uint32_t)(part + 0.5) << shift;
    }
    return tint;
}
