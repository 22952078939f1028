/* SPDX-License-Identifier: MIT */
/* The building blocks of the catalogue: shading and areas with a mistake. */
#ifndef LRCS_CLI_COMPARE_MISTAKES_H
#define LRCS_CLI_COMPARE_MISTAKES_H

#include "cli/compare/compare.h"

/* `at` is: the power of the cosine; 1 for its magnitude; the power in 1 / cos^6; a factor of tan^2;
   the value of m; 0 without the glint, 1 without the diffuse term; the step in deg (twice); the
   brightest value of a channel; the largest value. */
mistake_shade cli_shade_cosine;
mistake_shade cli_shade_degrees;
mistake_shade cli_shade_power;
mistake_shade cli_shade_slope;
mistake_shade cli_shade_sine;
mistake_shade cli_shade_small_angle;
mistake_shade cli_shade_tan_degrees;
mistake_shade cli_shade_lambert;
mistake_shade cli_shade_one_term;
mistake_shade cli_shade_lines;
mistake_shade cli_shade_steps;
mistake_shade cli_shade_bits;
mistake_shade cli_shade_clamped;

mistake_area cli_area_unshadowed;
mistake_area cli_area_backs;
mistake_area cli_area_all;
mistake_area cli_area_one_sided;
mistake_area cli_area_flipped;
mistake_area cli_area_one_material;
mistake_area cli_area_next_material;
mistake_area cli_area_smooth;
mistake_area cli_area_last;

#endif
