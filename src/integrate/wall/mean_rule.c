/* SPDX-License-Identifier: MIT */
/* The rules, generated to 50 digits with Newton's method. */
#include "integrate/wall/mean_rule.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"

const lrcsi_mean_rule lrcsi_mean_rules[LRCSI_MEAN_RULES] = {
    {2, 1, {0.577350269189625764509}, {0.5}},
    {3, 2, {0.0, 0.774596669241483377035}, {0.444444444444444444444, 0.277777777777777777777}},
    {4,
     2,
     {0.339981043584856264802, 0.861136311594052575223},
     {0.326072577431273071313, 0.173927422568726928686}},
    {5,
     3,
     {0.0, 0.538469310105683091036, 0.906179845938663992798},
     {0.284444444444444444444, 0.239314335249683234021, 0.118463442528094543757}},
    {6,
     3,
     {0.238619186083196908630, 0.661209386466264513661, 0.932469514203152027812},
     {0.233956967286345523694, 0.180380786524069303784, 0.085662246189585172520}},
    {8,
     4,
     {0.183434642495649804939, 0.525532409916328985817, 0.796666477413626739591,
      0.960289856497536231683},
     {0.181341891689180991482, 0.156853322938943643668, 0.111190517226687235272,
      0.050614268145188129576}}};

void lrcsi_mean_rule_bound(double most, double r, double error[LRCSI_MEAN_RULES])
{
    const double inverse = r - sqrt((r - 1) * (r + 1)); /* 1 / rho */
    const double q = inverse * inverse;
    double bound = most * (32.0 / 15) / (1 - q) * LRCSI_OUTWARD_NANO;
    for (int n = 0, k = 0; n < LRCSI_MEAN_RULES && most < HUGE_VAL; n++) {
        for (; k < lrcsi_mean_rules[n].points; k++) {
            bound *= q;
        }
        error[n] = lrcsi_min(error[n], bound);
    }
}

int lrcsi_mean_rule_choose(const double error[LRCSI_MEAN_RULES], double target)
{
    int n = 0;
    while (n + 1 < LRCSI_MEAN_RULES && !(error[n] <= target)) {
        n++;
    }
    return n;
}

int lrcsi_mean_rule_points(const lrcsi_mean_rule *rule, double x[LRCSI_MEAN_RULE_POINTS],
                           double weight[LRCSI_MEAN_RULE_POINTS])
{
    int count = 0;
    for (int k = 0; k < rule->half; k++) {
        x[count] = rule->x[k];
        weight[count++] = rule->weight[k];
        if (rule->x[k] != 0) {
            x[count] = -rule->x[k];
            weight[count++] = rule->weight[k];
        }
    }
    return count;
}
