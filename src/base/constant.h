/* SPDX-License-Identifier: MIT */
/* Constants that several files need. */
#ifndef LRCSI_CONSTANT_H
#define LRCSI_CONSTANT_H

#define LRCSI_PI 3.14159265358979323846

#endif
