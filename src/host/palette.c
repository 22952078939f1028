/* SPDX-License-Identifier: MIT */
/* Which colours stand for numbers and names. What they stand for is decided elsewhere. */
#include "host/palette.h"
#include "base/constant.h"

#include <math.h>

/* M. Okabe and K. Ito, Color Universal Design, 2008. */
static const uint32_t palette_names[] = {0x000000u, 0xe69f00u, 0x56b4e9u, 0x009e73u,
                                         0xf0e442u, 0x0072b2u, 0xd55e00u, 0xcc79a7u};

/* Viridis (S. van der Walt and N. Smith, 2015, CC0), every eighth. */
static const unsigned char palette_viridis[LRCSI_PALETTE_KNOTS][3] = {
    {68, 1, 84},    {71, 44, 122}, {59, 81, 139},  {44, 113, 142}, {33, 144, 141},
    {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};

static uint32_t palette_join(const double rgb[3])
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

uint32_t lrcsi_palette_even(double value)
{
    double place = (LRCSI_PALETTE_KNOTS - 1) * fmin(fmax(value, 0.0), 1.0);
    int low = (int)fmin(place, LRCSI_PALETTE_KNOTS - 2);
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        double from = palette_viridis[low][k];
        rgb[k] = from + (place - low) * (palette_viridis[low + 1][k] - from);
    }
    return palette_join(rgb);
}

/* Hues go round by the golden ratio, so that any few neighbours are far apart; every third is
   pale. */
uint32_t lrcsi_palette_distinct(uint32_t number)
{
    double turn = fmod(0.6180339887498949 * (number % 65536u) + 0.08, 1.0);
    double pale = 45.0 * (number % 3);
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        double wave = cos(2.0 * LRCSI_PI * (turn - k / 3.0));
        rgb[k] = 115.0 + 0.6 * pale + (105.0 - 0.4 * pale) * wave;
    }
    return palette_join(rgb);
}

uint32_t lrcsi_palette_shade(uint32_t colour, double light)
{
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        rgb[k] = light * (colour >> (16 - 8 * k) & 255u);
    }
    return palette_join(rgb);
}
