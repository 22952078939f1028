/* SPDX-License-Identifier: MIT */
/* f_r cos(theta) by the chord between normal and direction. With v = n - d and q = |v|^2, half of
   which is 1 - cos(theta),
       c = cos(theta) = 1 - q/2,   tan^2(theta) = q (1 - q/4) / c^2,
   so that everything is a function of q, and near normal incidence v is accurate: n and d are then
   subtracted exactly.

   Error of q, with u = 2^-53 and r = |v|: n has an error of at most 1.01 u in all, d is exact, the
   two subtractions add 2 u of v; squares and their sums add 3 u of q. Together
       |dq| <= 2.02 u r + 7 u q + 8 u^2,
   also with r and q as computed. As dc = -dq/2, this changes the logarithms
       of c^-5 exp(-tan^2/s^2)  by at most (2.5/c + 1/(s^2 c^3)) |dq|,
       of c^(m+1)               by at most (m + 2)/(2 c) |dq|,
   and those of c^-4 exp(-tan^2/s^2) and c^(m+2), which apply to an area S c, by no more.

   All other errors are roundings in functions of the computed q: relative, in units of u:

   c      1; its inverse 2, of which the square has 5, the fourth power 11, the fifth 14

   x      tan^2/s^2: q (1 - q/4) 2, the inverse square 5, 1/s^2 2, and two products 2: 11

   glint  the inverse fifth power 14, exp 2, 4 pi A 2, three products 3, S and S c 4: 25,
          less 1 for c in both; and 11 x for its exponent

   power  c^(m+1) for m = 0, 1/2, 1, 2: 3 for c, a root 3.1, products 2; 4 pi B 2, two products 2,
          S and S c, with its c, 5: 17.1

   any    c^(m+1) otherwise, exp(y) with y = (m + 1) log(c): the logarithm 6 of itself and its sum
          with what 1 - q/2 loses in being rounded 1, m + 1 and the product 2: 9 |y|; exp 2,
          4 pi B 2, two products 2, S and S c, with its c, 5: 11

   The constants below leave room for terms in u^2. An error delta of the logarithm
   gives the value a relative error of at most delta (1 + delta), and LRCSI_SHADE_UNIT has room for
   delta < 2^-11: its largest part is (2.02 r + 7 q) u/(s^2 c^3). If r >= 2^-12, it is at most
   (2.02/r + 7) (1400/c) u < 2^-23, because 1/(s^2 c^2) <= 2 x/q and x <= 700; otherwise c is almost
   1, and it is at most (2.02 r + 7 q) 2^41 u < 2^-22, because s >= 2^-20.

   A term with an exponent beyond 700 counts as 0: it is below 4 pi A c^-5 e^-699, or 4 pi B e^-699.
   Underflow of intermediate results causes an error of at most 2^-1075. */
#include "optics/shade.h"

#include <string.h>

#include "base/bits.h"

#define SHADE_GLINT_UNITS   25.0
#define SHADE_POWER_UNITS   18.0 /* m = 0, 1/2, 1, 2 */
#define SHADE_GENERAL_UNITS 12.0 /* other m */
#define SHADE_EXPONENT      700.0
#define SHADE_CUTOFF        0x1p-924 /* 2^53 times 2^31 e^-699 */

/* The smallest cosine: closer to grazing incidence errors grow. */
#define SHADE_GRAZING 0x1p-6
/* For a glint of smaller slope, and a diffuse lobe as narrow, the error of q matters within the
   bright lobe: up to an exponent of about 12, 2 r/s^2 exceeds 150 units. */
#define SHADE_NARROW_S 0.05
#define SHADE_NARROW_M 800.0
#define SHADE_BRIGHT   6.0

/* An upper bound of sqrt(q), at most 6.1 % above it, q >= 0: half the exponent, the mantissa by the
   secant 1 + f/2 of sqrt(1 + f), or 3/2 + f/2 for sqrt(2 + 2 f). */
static inline double sqrt_bound(double q)
{
    return lrcsi_bits_double((lrcsi_bits_of(q) >> 1) + UINT64_C(0x1ff8000000000000));
}

/* sqrt(c) for c in [2^-7, 2]. The bits give y = c^(-1/2) to 3.5 %; with h = 1 - c y^2, the step to
   y (1 + h/2 + 3 h^2/8) leaves 5/16 h^3: 1.2e-4, 5e-12, and the third step, without its last term,
   3/8 h^2: below 2^-70. Rounding: h to 2 u of 1, so y to 1 + 1 units, and c y: 3 in all. */
static inline double sqrt_iterated(double c)
{
    double y = lrcsi_bits_double(UINT64_C(0x5fe6eb50c7b537a9) - (lrcsi_bits_of(c) >> 1));
    double h = 1 - c * y * y;
    y += y * h * (0.5 + 0.375 * h);
    h = 1 - c * y * y;
    y += y * h * (0.5 + 0.375 * h);
    h = 1 - (c * y) * y;
    y += y * (0.5 * h);
    return c * y;
}

static int in_range(double x, double low, double high)
{
    return x >= low && x <= high;
}

lrcsi_lobes lrcsi_lobes_make(const lrcs_brdf *brdf, int glint, int diffuse)
{
    lrcsi_lobes lobes = {.A = LRCS_FOUR_PI * brdf->A,
                         .B = LRCS_FOUR_PI * brdf->B,
                         .m = brdf->m,
                         .low = SHADE_GRAZING,
                         .high = 2,
                         .glint = glint,
                         .diffuse = diffuse};
    lobes.cutoff = (lobes.A + lobes.B) * SHADE_CUTOFF;
    if ((glint && !(in_range(brdf->s, 0x1p-20, 0x1p20) &&
                    (brdf->A == 0 || in_range(brdf->A, 0x1p-100, 0x1p100)))) ||
        (diffuse &&
         !(brdf->m <= 0x1p20 && (brdf->B == 0 || in_range(brdf->B, 0x1p-100, 0x1p100))))) {
        lobes.low = 2;
    }
    if (glint) {
        lobes.inverse_s2 = 1 / (brdf->s * brdf->s);
        lobes.high = brdf->s < SHADE_NARROW_S ? 1 - SHADE_BRIGHT * brdf->s * brdf->s : 2;
    }
    if (diffuse && brdf->m > SHADE_NARROW_M) {
        double high = 1 - 2 * SHADE_BRIGHT / (brdf->m + 2);
        lobes.high = high < lobes.high ? high : lobes.high;
    }
    return lobes;
}

/* Quantities from the chord, and the part of the errors that both lobes share: |dq|/c. */
typedef struct shade_chord {
    double q[LRCSI_LANES], inverse[LRCSI_LANES], err[LRCSI_LANES];
} shade_chord;

static void chords_make(const lrcsi_lobes *restrict lobes, const double *restrict d,
                        const double *restrict d_low, const lrcsi_shade_normals *restrict normals,
                        lrcsi_shades *restrict shades, shade_chord *restrict chord)
{
    for (int i = 0; i < LRCSI_LANES; i++) {
        double x = (normals->x[0][i] - d[0]) - d_low[0];
        double y = (normals->x[1][i] - d[1]) - d_low[1];
        double z = (normals->x[2][i] - d[2]) - d_low[2];
        double q = (x * x + y * y) + z * z;
        double c = 1 - 0.5 * q;
        double inverse = 1 / c;
        shades->cosine[i] = c;
        shades->error[i] = lobes->cutoff;
        chord->q[i] = q;
        chord->inverse[i] = inverse;
        chord->err[i] = (2.02 * sqrt_bound(q) + (7 * q + 0x1p-50)) * inverse;
    }
}

static void lobe_glint(const lrcsi_lobes *restrict lobes, const shade_chord *restrict chord,
                       lrcsi_shades *restrict shades)
{
    double x[LRCSI_LANES];
    double e[LRCSI_LANES];
    uint64_t keep[LRCSI_LANES];
    uint64_t any = 0;
    for (int i = 0; i < LRCSI_LANES; i++) {
        double q = chord->q[i];
        double square = chord->inverse[i] * chord->inverse[i];
        double exponent = (q * (1 - 0.25 * q)) * square * lobes->inverse_s2;
        keep[i] = lrcsi_bits_negative(exponent - SHADE_EXPONENT);
        x[i] = -lrcsi_bits_masked(exponent, keep[i]);
        any |= keep[i];
    }
    if (!any) {
        memset(shades->glint, 0, sizeof shades->glint);
        return;
    }
    lrcsi_exp_lanes(x, e);
    for (int i = 0; i < LRCSI_LANES; i++) {
        double inverse = chord->inverse[i];
        double square = inverse * inverse;
        double glint = lrcsi_bits_masked(lobes->A * (square * square * inverse * e[i]), keep[i]);
        shades->glint[i] = glint;
        shades->error[i] += glint * ((SHADE_GLINT_UNITS - 11 * x[i]) +
                                     chord->err[i] * (2.5 + lobes->inverse_s2 * square));
    }
}

/* c times 1, c, c^2 or sqrt(c): one of the first three factors is 1, the others 0. */
static void lobe_power(const lrcsi_lobes *restrict lobes, const shade_chord *restrict chord,
                       lrcsi_shades *restrict shades)
{
    double one = lobes->m == 0;
    double first = lobes->m == 1;
    double second = lobes->m == 2;
    double half_nu = 0.5 * (lobes->m + 2);
    for (int i = 0; i < LRCSI_LANES; i++) {
        double c = shades->cosine[i];
        double diffuse = lobes->B * (c * (one + c * (first + c * second)));
        shades->diffuse[i] = diffuse;
        shades->error[i] += diffuse * (SHADE_POWER_UNITS + chord->err[i] * half_nu);
    }
}

static void lobe_root(const lrcsi_lobes *restrict lobes, const shade_chord *restrict chord,
                      lrcsi_shades *restrict shades)
{
    for (int i = 0; i < LRCSI_LANES; i++) {
        double c = shades->cosine[i];
        double diffuse = lobes->B * (c * sqrt_iterated(c));
        shades->diffuse[i] = diffuse;
        shades->error[i] += diffuse * (SHADE_POWER_UNITS + chord->err[i] * 1.25);
    }
}

static void lobe_general(const lrcsi_lobes *restrict lobes, const shade_chord *restrict chord,
                         lrcsi_shades *restrict shades)
{
    double y[LRCSI_LANES];
    double e[LRCSI_LANES];
    uint64_t keep[LRCSI_LANES];
    double power = lobes->m + 1;
    double half_nu = 0.5 * (lobes->m + 2);
    lrcsi_log_lanes(shades->cosine, y);
    for (int i = 0; i < LRCSI_LANES; i++) {
        double lost = (1 - shades->cosine[i]) - 0.5 * chord->q[i]; /* of c: exact (Dekker 1971) */
        double exponent = power * (y[i] + lost * chord->inverse[i]);
        keep[i] = lrcsi_bits_negative(-SHADE_EXPONENT - exponent);
        y[i] = lrcsi_bits_masked(exponent, keep[i]);
    }
    lrcsi_exp_lanes(y, e);
    for (int i = 0; i < LRCSI_LANES; i++) {
        double diffuse = lrcsi_bits_masked(lobes->B * e[i], keep[i]);
        shades->diffuse[i] = diffuse;
        shades->error[i] += diffuse * ((SHADE_GENERAL_UNITS - 9 * y[i]) + chord->err[i] * half_nu);
    }
}

void lrcsi_shade(const lrcsi_lobes *lobes, const double d[3], const double d_low[3],
                 const lrcsi_shade_normals *normals, lrcsi_shades *shades)
{
    shade_chord chord;
    chords_make(lobes, d, d_low, normals, shades, &chord);
    if (lobes->glint) {
        lobe_glint(lobes, &chord, shades);
    } else {
        memset(shades->glint, 0, sizeof shades->glint);
    }
    if (!lobes->diffuse) {
        memset(shades->diffuse, 0, sizeof shades->diffuse);
    } else if (lobes->m == 0.5) {
        lobe_root(lobes, &chord, shades);
    } else if (lobes->m == 0 || lobes->m == 1 || lobes->m == 2) {
        lobe_power(lobes, &chord, shades);
    } else {
        lobe_general(lobes, &chord, shades);
    }
}
