/* SPDX-License-Identifier: MIT */
/* The error of a glint caused by flat facets, from the turn between them: an estimate. Its model is
   a cylinder seen at broadside, the worst of the common cases.

   N facets sample the normals of a full turn at spacing h = 2 pi / N. Their sum is a trapezoidal
   rule over azimuth for a Gaussian of slope s; by Poisson's formula its error relative to the
   integral is 2 sum_k exp(-(pi s k / h)^2) cos(k phase), of which the first term dominates.
   The relative area that chords lose: 1 - sin(h/2)/(h/2), about (h/2)^2 / 6. */
#include "optics/aliasing.h"

#include <math.h>

#include "base/constant.h"

double lrcsi_aliasing_error(double turn, double s)
{
    double ratio = LRCS_PI * s / turn;
    return turn * turn / 24.0 + 2.0 * exp(-ratio * ratio);
}

double lrcsi_aliasing_around(double s, double max_error)
{
    double low = 2.0;
    double high = 3.0;
    while (lrcsi_aliasing_error(2.0 * LRCS_PI / high, s) > max_error && high < 1e15) {
        low = high;
        high *= 2.0;
    }
    while (high - low > 1.0) { /* the error decreases with N */
        double middle = floor(0.5 * (low + high));
        if (lrcsi_aliasing_error(2.0 * LRCS_PI / middle, s) > max_error) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}
