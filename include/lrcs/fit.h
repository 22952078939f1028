/* SPDX-License-Identifier: MIT */
/* The four parameters of a material from readings of its BRDF at several angles, in mono-station
   (retro) geometry: what fits best, within which limits, and which of the four the readings cannot
   determine. Everything here is statistics: estimates, no proved bounds. */
#ifndef LRCS_FIT_H
#define LRCS_FIT_H

#include <lrcs/brdf.h>
#include <lrcs/work.h>

typedef struct lrcs_fit_reading {
    double angle_deg; /* between line of sight and normal, -90 < angle_deg < 90; sign ignored */
    double value;     /* what was read, in the unit that the options state; may be negative */
    double sigma;     /* its standard error in the same unit; read only where it is given */
} lrcs_fit_reading;

/* How large the errors of readings are to one another. */
enum lrcs_fit_noise {
    LRCS_FIT_ABSOLUTE, /* the same for all */
    LRCS_FIT_RELATIVE, /* in proportion to what is measured, down to 1e-4 of its largest */
    LRCS_FIT_GIVEN,    /* each reading's sigma */
    LRCS_FIT_WEIGHTED  /* each reading's sigma, but for a common factor that is not known */
};

typedef struct lrcs_fit_options {
    double unit; /* 1/sr for a value of 1, > 0: 1 where values are f_r; rho/pi where they are
                    relative to a Lambert panel of reflectance rho (1) */
    int cosine;  /* values fall with cos(theta) too: f_r cos(theta) (0) */
    int noise;   /* lrcs_fit_noise (LRCS_FIT_ABSOLUTE) */
} lrcs_fit_options;

lrcs_fit_options lrcs_fit_options_default(void);

/* The parameters in their order. */
enum lrcs_fit_index { LRCS_FIT_A, LRCS_FIT_B, LRCS_FIT_S, LRCS_FIT_M, LRCS_FIT_PARAMETERS };

/* What the readings say of a parameter. */
enum lrcs_fit_verdict {
    LRCS_FIT_DETERMINED, /* limits on both sides; those of m may begin at 0 */
    LRCS_FIT_ABSENT,     /* A or B: cannot be told from 0, and has an upper limit */
    LRCS_FIT_MOOT,       /* s or m: its A or B cannot be told from 0 */
    LRCS_FIT_AT_MOST,    /* no lower limit */
    LRCS_FIT_AT_LEAST,   /* no upper limit */
    LRCS_FIT_FREE        /* no limits */
};

typedef struct lrcs_fit_parameter {
    double value;
    double error; /* standard error, linearised about the fit; HUGE_VAL where that says nothing */
    double low, high; /* limits of confidence, 95 %; 0 and HUGE_VAL where there is none */
    int verdict;      /* lrcs_fit_verdict */
} lrcs_fit_parameter;

typedef struct lrcs_fit {
    lrcs_brdf brdf; /* s is 0 where A is, m is 0 where B is */
    lrcs_fit_parameter parameter[LRCS_FIT_PARAMETERS];
    double correlation[LRCS_FIT_PARAMETERS][LRCS_FIT_PARAMETERS]; /* 0 where not defined */
    double rms;      /* of the residuals of readings kept, 1/sr */
    double noise;    /* their standard deviation with kept - 4 degrees of freedom (kept - 2 where a
                        part is left out): in 1/sr, relative, or in sigmas; its square is then the
                        reduced chi-square */
    uint32_t kept;   /* readings that the fit stands on */
    uint32_t angles; /* how many different angles they have, counted up to 4 */
    double least_deg, most_deg; /* the smallest and the largest of them, without sign */
    uint32_t starts;            /* starting points of the descent */
} lrcs_fit;

/* A reading beside the fit, in the reading's unit. */
typedef struct lrcs_fit_point {
    double fitted;
    double residual; /* value - fitted */
    double standard; /* residual over the noise of such a reading */
    int outlier;     /* set aside */
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
   Work: lrcs_fit_need(count) bytes; time in proportion to count, some 5e3 evaluations of f_r each.
   Notes: 1. Least squares over the readings that are kept; A and B, which enter linearly, are
   solved for at every s and m (Golub and Pereyra 1973), never below 0.
   2. Starting points: the local minima of the sum of absolute residuals over a grid of s and m,
   each brought down with Huber's weights (1964).
   3. A reading is set aside where its residual exceeds 3.5 times a scale from the median of all
   (Rousseeuw and Leroy 1987, ch. 5), never more than 3 in 10, and none of fewer than 8.
   4. The part, glint or diffuse, that noise alone would feign in 1 of 20 cases or more is left out:
   its A or B is 0 (H. Hotelling 1939; M. Knowles and D. Siegmund 1989).
   5. Limits are those of the profile: the value at which the best fit of the other three is worse
   than the fit reported by Student's t^2 times the noise^2; a part left out is among the three.
   With LRCS_FIT_GIVEN and a reduced chi-square below 1 the noise is 1 and t is the normal
   distribution's.
   6. Searched: s from 1/6 of the smallest tangent read to 2, m from 0 to 1000, A and B up to 1e9
   of the largest value. A limit outside is none.
   7. An outlier at the smallest angle cannot be told from a narrow glint, nor one of three readings
   that a glint has from its flank: a glint needs some five. */
int lrcs_fit_run(const lrcs_fit_reading *reading, uint32_t count, const lrcs_fit_options *options,
                 lrcs_work *work, lrcs_fit *fit, lrcs_fit_point *point);

/* One sentence for what a verdict means of a parameter. Never NULL. */
const char *lrcs_fit_verdict_text(int parameter, int verdict);

#endif
