/* SPDX-License-Identifier: MIT */
/* Mathematical constants, rounded to doubles. */
#ifndef LRCS_CONSTANT_H
#define LRCS_CONSTANT_H

#define LRCS_PI      3.14159265358979323846
#define LRCS_FOUR_PI 12.566370614359172954 /* the factor of Eq. 2 */

#define LRCS_DEGREES_PER_RADIAN (180.0 / LRCS_PI)
#define LRCS_RADIANS_PER_DEGREE (LRCS_PI / 180.0)

#endif
