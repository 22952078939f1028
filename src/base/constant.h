/* SPDX-License-Identifier: MIT */
/* The unit roundoff, and the public constants. */
#ifndef LRCSI_CONSTANT_H
#define LRCSI_CONSTANT_H

#include <lrcs/constant.h>

#define LRCSI_U 0x1p-53 /* unit roundoff: half the distance from 1 to the next larger double */

#endif
