/* SPDX-License-Identifier: MIT */
/* What a facet of a partly visible round wall adds to sigma (integrate/wall/round_pieces.h). */
#ifndef LRCSI_ROUND_TERMS_H
#define LRCSI_ROUND_TERMS_H

/* A sum of integrals of G, with bounds on its errors. Scaled, without the factor 4 pi. */
typedef struct lrcsi_round_sum {
    double glint, diffuse, rounding, remainder;
    double glint_u, diffuse_log; /* the same integrals of glint * u and diffuse * log(1 + u), u =
                                    tan^2(theta), if they are asked for; else 0 */
} lrcsi_round_sum;

/* T and M: integrate/wall/round_pieces.h. */
typedef struct lrcsi_round_terms {
    int known;           /* 0: the facet is not integrated in this way */
    lrcsi_round_sum sum; /* M; its remainder: bound on |T - M| that its own part causes */
    double visibility;   /* bound on the error of its visible area */
    double above, below; /* bounds on T - M and M - T that other parts cause */
    double bound;        /* on G above the facet, and above what is next to it: not added */
} lrcsi_round_terms;

#endif
