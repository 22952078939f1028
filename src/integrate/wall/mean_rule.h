/* SPDX-License-Identifier: MIT */
/* Gauss-Legendre rules for means over [-1, 1]. A rule of n points is exact for polynomials up to
   degree 2 n - 1.

   Remainder. Let f have a Taylor series about 0 whose radius exceeds r > 1, and |f| <= M on the
   disc of radius r: its coefficients are at most M r^-k. A rule of n points is exact for odd k and
   for k < 2 n; for even k >= 2 n its mean of x^k lies between 0 and the true mean 1/(k+1), since
   the error of Gauss's rule is f^(2n)(xi) times a positive number. So the error of its mean of f is
   at most
       M sum over even k >= 2 n of r^-k / (k+1) <= M r^(-2n) / ((2n+1) (1 - r^-2)). */
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

/* The index of the rule with the fewest points whose error, of those given, is at most the target;
   of the last rule if there is none. */
int lrcsi_mean_rule_choose(const double error[LRCSI_MEAN_RULES], double target);

/* Writes the points and weights of a rule, and returns how many there are. */
int lrcsi_mean_rule_points(const lrcsi_mean_rule *rule, double x[LRCSI_MEAN_RULE_POINTS],
                           double weight[LRCSI_MEAN_RULE_POINTS]);

#endif
