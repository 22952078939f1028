/* SPDX-License-Identifier: MIT */
/* The unit roundoff, the range of coordinates, and the public constants. */
#ifndef LRCSI_CONSTANT_H
#define LRCSI_CONSTANT_H

#include <lrcs/constant.h>

/* The largest magnitude of a coordinate or a length, in any unit: cubes stay far below overflow. */
#define LRCSI_COORDINATE_MAX 1e100

#define LRCSI_U 0x1p-53 /* unit roundoff: half the distance from 1 to the next larger double */

#endif
