/* SPDX-License-Identifier: MIT */
/* Whether facets are fine enough for a glint: an ESTIMATE of the error caused by flat facets. */
#ifndef LRCSI_ALIASING_H
#define LRCSI_ALIASING_H

/* Relative error of sigma, at the worst aspect, of a cylinder of flat facets whose normals differ
   by `turn` (rad, > 0) between neighbours, for a glint of slope s: (turn/2)^2 / 6 for the chords
   and 2 exp(-(pi s / turn)^2) for the ripple of the sum over discrete normals. */
double lrcsi_aliasing_error(double turn, double s);

/* The smallest number of facets per full turn with an error of at most `max_error`. */
double lrcsi_aliasing_around(double s, double max_error);

#endif
