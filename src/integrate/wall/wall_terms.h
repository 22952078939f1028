/* SPDX-License-Identifier: MIT */
/* What a facet of a partly visible curved wall adds to sigma, where the true surface is integrated
   in place of its facets. */
#ifndef LRCSI_WALL_TERMS_H
#define LRCSI_WALL_TERMS_H

/* A sum of integrals of G, with bounds on its errors. Scaled, without the factor 4 pi. */
typedef struct lrcsi_round_sum {
    double glint, diffuse, rounding, remainder;
    double glint_u, diffuse_log; /* the same integrals of glint * u and diffuse * log(1 + u), u =
                                    tan^2(theta), if they are asked for; else 0 */
} lrcsi_round_sum;

/* How a facet is integrated. */
enum lrcsi_wall_way {
    LRCSI_WALL_FACET,  /* as a facet: the other fields are not used */
    LRCSI_WALL_PIECES, /* its visible pieces (integrate/wall/round_pieces.h) */
    LRCSI_WALL_PATCH   /* the visible part of its sector's patch (integrate/wall/clear_sectors.h) */
};

/* T and M: integrate/wall/round_pieces.h. */
typedef struct lrcsi_wall_terms {
    int way;             /* lrcsi_wall_way */
    lrcsi_round_sum sum; /* M; its remainder: bound on |T - M| that its own part causes */
    double visibility;   /* bound on the error of its visible area */
    double above, below; /* bounds on T - M and M - T that other parts cause */
    double bound;        /* on G above the facet, and above what is next to it: not added */
} lrcsi_wall_terms;

#endif
