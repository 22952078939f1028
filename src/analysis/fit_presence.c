/* SPDX-License-Identifier: MIT */
/* Whether a glint or a diffuse term is significant compared with the noise of readings. It decides
   by how much the sum of squares must fall before a term counts as present.

   Without the term, its shape parameter (s or m) has no meaning, and the fit takes the most
   favourable of all shapes: the usual t test of one parameter would find a glint in one of five
   series of pure noise. H. Hotelling (1939) gives the correct probability, and M. Knowles and D.
   Siegmund (Int. Stat. Rev. 57 (1989) 205) its application here: let v be the term's vector over
   the readings, made orthogonal to what the other term can represent (its vector and the derivative
   of that), and L the length of the arc that v/|v| draws on the unit sphere as the shape runs over
   its range. The probability that noise of N dimensions is so near to that arc that the term lowers
   the sum of squares by a fraction of q or more is at most
     (1 - q)^((N-2)/2) (sqrt(1 - q)/2 + L/(2 pi)),
   the volume of a tube about the arc with half a cap at its end (a cap of angle a is at most
   sin(a)^(N-1)/2 of the sphere). With known errors the power becomes exp(-fall/2), where fall is
   the decrease of the sum of squares. The bound is exact if the rest of the model is linear; the
   derivative of the other term's shape makes it so to first order. */
#include "analysis/fit_presence.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"

#define PRESENCE_LEVEL 0.05
#define PRESENCE_STEPS 240

/* If the other term represents a vector to within rounding, the direction of the residual is not
   usable. */
#define PRESENCE_ROUNDING 1e-12

/* The term's vector v over the readings at given s and m, made orthogonal to the other term's and
   normalised. Returns 0 if it is zero to within rounding. */
static int presence_vector(lrcsi_fit_data *data, int term, const lrcsi_fit_parameters *parameters,
                           double *v)
{
    int other = term == LRCS_FIT_A ? LRCS_FIT_B : LRCS_FIT_A;
    int shape = other + LRCS_FIT_S;
    lrcsi_fit_parameters at = *parameters;
    lrcsi_fit_normal normal;
    lrcsi_fit_evaluate(data, 3u, &at, &normal);
    double a = normal.gram[other][other];
    double b = normal.gram[shape][shape];
    double ab = normal.gram[other][shape];
    double det = a * b - ab * ab;
    double x = a > 0.0 ? normal.gram[term][other] / a : 0.0;
    double y = 0.0;
    if (det > PRESENCE_ROUNDING * a * b) {
        x = (b * normal.gram[term][other] - ab * normal.gram[term][shape]) / det;
        y = (a * normal.gram[term][shape] - ab * normal.gram[term][other]) / det;
    }
    double square = 0.0;
    for (uint32_t i = 0; i < data->count; i++) {
        v[i] = data->column[term][i] - x * data->column[other][i] - y * data->column[shape][i];
        square += v[i] * v[i];
    }
    if (!(square > PRESENCE_ROUNDING * normal.gram[term][term])) {
        return 0;
    }
    for (uint32_t i = 0; i < data->count; i++) {
        v[i] /= sqrt(square);
    }
    return 1;
}

/* The length of the arc, as the sum of chords. */
static double presence_arc(lrcsi_fit_data *data, int term, const lrcsi_fit_parameters *without)
{
    int shape = term + LRCS_FIT_S;
    double *v = data->residual;
    double *last = data->spare; /* the vector of the step before */
    int before = 0;
    double arc = 0.0;
    lrcsi_fit_parameters parameters = *without;
    for (int k = 0; k <= PRESENCE_STEPS; k++) {
        double chord = 0.0;
        double fraction = (double)k / PRESENCE_STEPS;
        parameters.at[shape] = data->low[shape] + fraction * (data->high[shape] - data->low[shape]);
        if (!presence_vector(data, term, &parameters, v)) {
            continue;
        }
        for (uint32_t i = 0; i < data->count; i++) {
            double change = v[i] - last[i];
            chord += change * change;
            last[i] = v[i];
        }
        arc += before ? 2.0 * asin(lrcsi_min(1.0, 0.5 * sqrt(chord))) : 0.0;
        before = 1;
    }
    return arc;
}

int lrcsi_fit_presence(lrcsi_fit_data *data, int term, const lrcsi_fit_parameters *without,
                       double square, uint32_t kept, int known)
{
    double fall = lrcsi_max(0.0, without->square - square);
    double ratio = without->square > 0.0 ? square / without->square : 1.0; /* 1 - q */
    double freedom = (double)kept - 2.0;
    double arc = presence_arc(data, term, without) / (2.0 * LRCS_PI);
    ratio = lrcsi_min(1.0, ratio);
    double probability = known ? exp(-0.5 * fall) * (0.5 + arc)
                               : pow(ratio, 0.5 * freedom - 1.0) * (0.5 * sqrt(ratio) + arc);
    return probability < PRESENCE_LEVEL;
}
