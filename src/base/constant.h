/* SPDX-License-Identifier: MIT */
/* Constants that several files need. */
#ifndef LRCSI_CONSTANT_H
#define LRCSI_CONSTANT_H

#define LRCSI_PI      3.14159265358979323846
#define LRCSI_FOUR_PI 12.566370614359172954
#define LRCSI_U       0x1p-53 /* unit roundoff: half the distance from 1 to the next larger double */

#endif
