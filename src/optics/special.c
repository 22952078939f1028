/* SPDX-License-Identifier: MIT */
/* erfcx, the integral of a power of a cosine, and a quantile of Student's t. It decides from which
   argument on a series is used. libm in C11 has none of these functions, and its erfc and tgamma
   underflow and overflow where the first two do not. */
#include "optics/special.h"

#include <math.h>

#include "base/dd.h"

#define SPECIAL_SQRT_PI 1.77245385090551602730

/* erfcx below x = 2 is exp times erfc: x^2 = hi + lo exactly. From 2 on it is Laplace's continued
   fraction, sqrt(pi) erfcx = 1/(x + (1/2)/(x + (2/2)/(x + (3/2)/(x + ...)))) (Abramowitz and
   Stegun 1964, 7.1.14), all terms positive: each level's relative error enters the next with a
   weight below 1/2, so 4 units in all. The truncation error after n levels decreases as
   exp(-2 x sqrt(2 n)): 2^-64 at x = 2, n = 64. */
double lrcsi_special_erfcx(double x)
{
    if (x < 2.0) {
        lrcsi_dd square = lrcsi_dd_two_product(x, x);
        return exp(square.hi) * (1.0 + square.lo) * erfc(x);
    }
    double tail = x;
    for (int k = 64; k >= 1; k--) {
        tail = x + 0.5 * k / tail;
    }
    return 1.0 / (SPECIAL_SQRT_PI * tail);
}

/* Gamma(z + 1/2) / Gamma(z + 1) = w^(-1/2) (1 + c1 / w^2 + c2 / w^4 + ...), w = z + 1/4: the even
   series about the midpoint (Tricomi and Erdelyi 1951); c_k 64^k is exact below. At w >= 12 the
   first term left out is below 2.1e-17. Smaller nu are reduced to larger ones by
   I(nu) = I(nu + 2) (nu + 2)/(nu + 1), at most 12 times, 3 units each; 8 for the series and the
   root. */
double lrcsi_special_cosine_power(double nu)
{
    static const double c[] = {464147669.0625, -2612302.875, 22540.375, -335.5, 10.5, -1.0, 1.0};
    double above = 1.0;
    double below = 1.0;
    while (nu < 23.5) {
        above *= nu + 2.0;
        below *= nu + 1.0;
        nu += 2.0;
    }
    double w = 0.5 * nu + 0.25;
    double t = 1.0 / 64.0 / w / w;
    double sum = 0.0;
    for (int k = 0; k < 7; k++) {
        sum = sum * t + c[k];
    }
    return SPECIAL_SQRT_PI / sqrt(w) * sum * (above / below);
}

/* The quantile 0.975: infinite for 0 degrees of freedom; eight values rounded from 30 digits; then
   the expansion in 1/freedom about that of the normal distribution (Abramowitz and Stegun 1964,
   26.7.5), which has an error of 7e-6 at 9 degrees of freedom and a smaller one beyond. */
double lrcsi_special_student(uint32_t freedom)
{
    static const double few[] = {HUGE_VAL,
                                 12.7062047361747046,
                                 4.30265272974946385,
                                 3.18244630528370959,
                                 2.77644510519779436,
                                 2.57058183563631551,
                                 2.44691185114496997,
                                 2.36462425159278534,
                                 2.30600413520416668};
    static const double c[] = {1.58953405339382354, 2.55584967950772333, 2.8224986157396118,
                               2.37227123029856278, 1.95996398454005423};
    if (freedom < sizeof few / sizeof few[0]) {
        return few[freedom];
    }
    double sum = 0.0;
    for (int k = 0; k < 5; k++) {
        sum = sum / freedom + c[k];
    }
    return sum;
}
