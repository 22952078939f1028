/* SPDX-License-Identifier: MIT */
/* What a facet of a partly visible round wall adds to sigma (integrate/wall/round_pieces.h). */
#ifndef LRCSI_ROUND_TERMS_H
#define LRCSI_ROUND_TERMS_H

/* Scaled, without the factor 4 pi. T and M: integrate/wall/round_pieces.h. */
typedef struct lrcsi_round_terms {
    int known;                   /* 0: the facet is not integrated in this way */
    double glint, diffuse;       /* M */
    double glint_u, diffuse_log; /* the same integrals of glint * u and diffuse * log(1 + u), u =
                                    tan^2(theta), if they are asked for; else 0 */
    double rounding;
    double visibility;   /* bound on the error of its visible area */
    double above, below; /* bounds on T - M and M - T that other parts cause */
    double own;          /* bound on |T - M| that its own part causes */
    double bound;        /* on G above the facet, and above what is next to it: not added */
} lrcsi_round_terms;

#endif
