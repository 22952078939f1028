/* SPDX-License-Identifier: MIT */
/* Whether facets are fine enough for a glint: an ESTIMATE of the error that flat facets make. */
#ifndef LRCSI_COMB_H
#define LRCSI_COMB_H

/* Relative error of sigma, at the worst aspect, of a cylinder's flat facets that turn by `turn`
   (rad, > 0) from one to the next, under a glint of slope s: (turn/2)^2 / 6 for the chords and
   2 exp(-(pi s / turn)^2) for the comb of separate glints. */
double lrcsi_comb_error(double turn, double s);

/* The fewest facets around a full turn whose error is at most `most`. */
double lrcsi_comb_around(double s, double most);

#endif
