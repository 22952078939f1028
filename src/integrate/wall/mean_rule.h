/* SPDX-License-Identifier: MIT */
/* Gauss-Legendre rules for means over [-1, 1]. A rule of n points is exact for polynomials up to
   degree 2 n - 1.

   Remainder. Let f be analytic and |f| <= M in the disc of radius r > 1, and so in the ellipse with
   foci -1 and 1 whose half-axes are r and sqrt(r^2 - 1). With rho = r + sqrt(r^2 - 1), the
   coefficients of its series of Chebyshev polynomials T_k are at most 2 M rho^-k (Bernstein 1912;
   Trefethen, Approximation Theory and Approximation Practice, 2013, Theorem 8.1). A rule of n
   points is exact for odd k and for k < 2 n. For even k >= 2 n >= 4 the mean of T_k is -1 / (k^2 -
   1), at most 1/15 in size, and that of the rule is at most 1. So the error of its mean of f is at
   most
       M sum over even k >= 2 n of 2 (16/15) rho^-k = M (32/15) rho^(-2n) / (1 - rho^-2). */
#ifndef LRCSI_MEAN_RULE_H
#define LRCSI_MEAN_RULE_H

/* The largest number of points of a rule. */
#define LRCSI_MEAN_RULE_POINTS 8

/* The points >= 0 of a rule and their weights, each for x and -x. */
typedef struct lrcsi_mean_rule {
    int points, half;
    double x[LRCSI_MEAN_RULE_POINTS / 2], weight[LRCSI_MEAN_RULE_POINTS / 2];
} lrcsi_mean_rule;

/* Rules of 2, 3, 4, 5, 6 and 8 points. */
#define LRCSI_MEAN_RULES 6
extern const lrcsi_mean_rule lrcsi_mean_rules[LRCSI_MEAN_RULES];

/* Lowers bounds on the errors of all rules to that of the remainder, given M and r; M may be
   infinite. */
void lrcsi_mean_rule_bound(double most, double r, double error[LRCSI_MEAN_RULES]);

/* The index of the rule with the fewest points whose error, of those given, is at most the target;
   of the last rule if there is none. */
int lrcsi_mean_rule_choose(const double error[LRCSI_MEAN_RULES], double target);

/* Writes the points and weights of a rule, and returns how many there are. */
int lrcsi_mean_rule_points(const lrcsi_mean_rule *rule, double x[LRCSI_MEAN_RULE_POINTS],
                           double weight[LRCSI_MEAN_RULE_POINTS]);

#endif
