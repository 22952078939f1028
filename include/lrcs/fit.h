/* SPDX-License-Identifier: MIT */
/* Fits the four parameters of a material to readings of its BRDF at several angles, in monostatic
   (retro) geometry: the best fit, confidence limits, and which of the four parameters the readings
   do not determine. All results are statistical estimates; none is a proved bound. */
#ifndef LRCS_FIT_H
#define LRCS_FIT_H

#include <lrcs/brdf.h>
#include <lrcs/work.h>

typedef struct lrcs_fit_reading {
    double angle_deg; /* between line of sight and normal, -90 < angle_deg < 90; sign ignored */
    double value;     /* the reading, in the unit that the options state; may be negative */
    double sigma;     /* its standard error in the same unit; used with _GIVEN and _WEIGHTED only */
} lrcs_fit_reading;

/* The noise model: the relative size of the errors of readings. */
enum lrcs_fit_noise {
    LRCS_FIT_ABSOLUTE, /* the same for all */
    LRCS_FIT_RELATIVE, /* proportional to the measured value, at least 1e-4 of the largest one's */
    LRCS_FIT_GIVEN,    /* each reading's sigma */
    LRCS_FIT_WEIGHTED  /* each reading's sigma, times an unknown common factor */
};

typedef struct lrcs_fit_options {
    double unit; /* f_r, 1/sr, that a value of 1 stands for, > 0: 1 if values are f_r; rho/pi if
                    they are relative to a Lambertian panel of reflectance rho (default 1) */
    int cosine;  /* 1: values are f_r cos(theta) (default 0) */
    int noise;   /* lrcs_fit_noise (LRCS_FIT_ABSOLUTE) */
} lrcs_fit_options;

lrcs_fit_options lrcs_fit_options_default(void);

/* The parameters in their order. */
enum lrcs_fit_index { LRCS_FIT_A, LRCS_FIT_B, LRCS_FIT_S, LRCS_FIT_M, LRCS_FIT_PARAMETERS };

/* What the readings determine about a parameter. */
enum lrcs_fit_verdict {
    LRCS_FIT_DETERMINED, /* both limits exist; the lower limit of m may be 0 */
    LRCS_FIT_ABSENT,     /* A or B: not distinguishable from 0; has an upper limit */
    LRCS_FIT_UNDEFINED,  /* s or m: its A or B is not distinguishable from 0 */
    LRCS_FIT_AT_MOST,    /* no lower limit */
    LRCS_FIT_AT_LEAST,   /* no upper limit */
    LRCS_FIT_FREE        /* no limits */
};

typedef struct lrcs_fit_parameter {
    double value;
    double error;     /* standard error, linearised about the fit; HUGE_VAL if not defined */
    double low, high; /* 95 % confidence limits; 0 and HUGE_VAL if there is none */
    int verdict;      /* lrcs_fit_verdict */
} lrcs_fit_parameter;

typedef struct lrcs_fit {
    lrcs_brdf brdf; /* s is 0 if A is 0, m is 0 if B is 0 */
    lrcs_fit_parameter parameter[LRCS_FIT_PARAMETERS];
    double correlation[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS]; /* 0 if not defined */
    double rms;      /* of the residuals of the readings kept, 1/sr */
    double noise;    /* their standard deviation with kept - 4 degrees of freedom (kept - 2 where a
                        term is left out): in 1/sr, relative, or in sigmas; in sigmas its square is
                        the reduced chi-square */
    uint32_t kept;   /* readings that the fit uses */
    uint32_t angles; /* number of different angles among them, counted up to 4 */
    double least_deg, most_deg; /* the smallest and the largest angle, without sign */
    uint32_t starts;            /* starting points of the minimization */
} lrcs_fit;

/* A reading compared with the fit, in the reading's unit. */
typedef struct lrcs_fit_point {
    double fitted;
    double residual; /* value - fitted */
    double standard; /* residual divided by the noise of such a reading */
    int outlier;     /* 1: excluded from the fit */
} lrcs_fit_point;

/* The fewest readings that can be fitted: one more than there are parameters. */
#define LRCS_FIT_READINGS 5u

/* Bytes of work area that lrcs_fit_run takes. */
size_t lrcs_fit_need(uint32_t count);

/* Fits f_r to readings.
   Given: `count` readings in any order, several at an angle allowed.
   Returned: fit; point[count] unless NULL.
   Status: LRCS_OK; LRCS_E_EMPTY (fewer than LRCS_FIT_READINGS, or no value above 0);
   LRCS_E_NUMBER (a reading not finite or outside its range; the largest f_r outside 1e-100 ..
   1e100, or in units of some sigma outside 1e-70 .. 1e70); LRCS_E_ARGUMENT (options);
   LRCS_E_MEMORY.
   Work: lrcs_fit_need(count) bytes; O(count), about 5e3 evaluations of f_r per reading.
   Notes: 1. Least squares over the readings that are kept. A and B enter linearly and are solved
   for at every s and m (Golub and Pereyra 1973), constrained to be non-negative.
   2. Starting points: the local minima of the sum of absolute residuals over a grid of s and m;
   each is minimized with Huber's weights (1964).
   3. A reading is excluded if its residual exceeds 3.5 times a scale from the median of all
   residuals (Rousseeuw and Leroy 1987, ch. 5), but never more than 3 in 10, and none of fewer
   than 8.
   4. The term, glint or diffuse, that noise alone would produce in 1 of 20 cases or more is left
   out: its A or B is 0 (H. Hotelling 1939; M. Knowles and D. Siegmund 1989).
   5. Limits are profile limits: the value at which the weighted sum of squares of the best fit of
   the other three exceeds that of the reported fit by Student's t^2 times the noise^2; a term that
   was left out is free again among the three. With LRCS_FIT_GIVEN and a reduced chi-square below 1
   the noise is 1 and t is that of the normal distribution.
   6. Search range: s from 1/6 of the smallest tangent read to 2, m from 0 to 1000, A and B up to
   1e9 times the largest value. A limit outside this range counts as no limit.
   7. An outlier at the smallest angle cannot be distinguished from a narrow glint, nor can an
   outlier among the only three readings on the slope of a glint: a glint needs about five. */
int lrcs_fit_run(const lrcs_fit_reading *reading, uint32_t count, const lrcs_fit_options *options,
                 lrcs_work *work, lrcs_fit *fit, lrcs_fit_point *point);

/* The same for readings of unknown errors: with relative errors and with absolute ones, of which
   the likelier is kept. options->noise is not used. Returned: noise, LRCS_FIT_RELATIVE or
   LRCS_FIT_ABSOLUTE; fit; point[count]. Status: as lrcs_fit_run. Work: lrcs_fit_need(count) bytes;
   up to three times that of lrcs_fit_run. */
int lrcs_fit_run_likelier(const lrcs_fit_reading *reading, uint32_t count,
                          const lrcs_fit_options *options, lrcs_work *work, int *noise,
                          lrcs_fit *fit, lrcs_fit_point *point);

/* One sentence on what a verdict means for a parameter. Never NULL. */
const char *lrcs_fit_verdict_text(int parameter, int verdict);

#endif
