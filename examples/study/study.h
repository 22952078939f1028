/* SPDX-License-Identifier: MIT */
/* What a study computes, as its program, tables, laws and files share it. */
#ifndef STUDY_H
#define STUDY_H

#include <lrcs/host.h>

#include <stdio.h>

/* The cone's half-angle is the one with which its slant height equals its base's diameter. */
#define STUDY_SURFACE 6.0  /* m2: that of a cube of 1 m, which every body has */
#define STUDY_HALF    30.0 /* deg: the cone's half-angle */
#define STUDY_ROWS    181u
#define STUDY_COLUMNS 9u
#define STUDY_TABLES  24u
#define STUDY_LAWS    24u

/* A value and how far the truth may be from it. */
typedef struct study_number {
    double value, bound;
} study_number;

/* Bodies in the order of tables and legends. */
enum study_kind {
    STUDY_DISC, /* thin, both faces */
    STUDY_CUBE,
    STUDY_CYLINDER, /* as long as wide */
    STUDY_CONE,
    STUDY_SPHERE,
    STUDY_KINDS
};

/* Surfaces made of one material: its diffuse part alone, its glint alone, all of it. */
enum study_finish { STUDY_DIFFUSE, STUDY_GLINT, STUDY_MIXED, STUDY_FINISHES };

/* How a table is drawn. */
enum study_chart {
    STUDY_NO_CHART, /* a table of the page */
    STUDY_DBSM,     /* sigma in dBsm over an angle */
    STUDY_LOG_LOG,  /* as it is, both axes logarithmic */
    STUDY_LOG,      /* as it is, y logarithmic */
    STUDY_LINEAR    /* as it is */
};

typedef struct study_column {
    char id[32];      /* in CSV, with its unit */
    char name[48];    /* in legends and pages */
    int colour, dash; /* lrcs_host_colour, lrcs_host_dash */
    double value[STUDY_ROWS];
} study_column;

/* Numbers of one figure or of one table of the page: rows are values of x, or have names. */
typedef struct study_table {
    const char *stem; /* of its files: STEM.csv, STEM.svg */
    const char *title, *x_id, *x_name, *y_name;
    const char *maker; /* what made it */
    char note[160];
    double floor; /* m2: plots in dBsm and statements about relative bounds end there */
    int chart, polar, estimate; /* polar: drawn about a pole too; estimate: a quadrature's error
                                   is in its bounds, which are then no proof */
    uint32_t columns, rows;
    const char *row_name[STUDY_ROWS]; /* NULL where x says it */
    double x[STUDY_ROWS];
    study_column column[STUDY_COLUMNS];
    double bound[STUDY_ROWS]; /* the largest of the row */
    double relative;          /* the largest bound / value of values above the floor */
} study_table;

/* A general law: a sentence, and the comparisons that it stands or falls with. */
typedef struct study_law {
    const char *name;
    const char *quantity; /* what is compared */
    char text[640];
    char range[480];
    int checks, estimate; /* estimate: as a table's */
    /* The smallest distance of any comparison from its limits, minus its bound; negative or NaN:
       not supported. */
    double slack;
    study_number worst; /* of that comparison */
    double least, most; /* and its limits */
} study_law;

typedef struct study_job {
    lrcs_brdf brdf; /* of the mixed surface */
    int status;     /* of the first closed form or run that failed */
    lrcs_host_error error;
    uint32_t tables, laws;
    study_table table[STUDY_TABLES];
    study_law law[STUDY_LAWS];
} study_job;

/* ---- numbers ---- */
study_number study_exact(double value);
study_number study_sum(study_number a, study_number b);
study_number study_scaled(study_number a, double factor);
study_number study_ratio(study_number a, study_number b);
double study_dbsm(double sigma_m2);

/* ---- bodies and their sigma ---- */
const char *study_name(int kind);
int study_colour(int kind);

/* A body with the surface STUDY_SURFACE. */
lrcs_shape study_body(int kind);
/* What glints: the flat face, the curved wall alone, of 1 m2; not of a cube. */
lrcs_shape study_wall(int kind, double half_angle_deg);
/* A body that shows 1 m2 at 90 deg from its axis; not a disc. */
lrcs_shape study_silhouette(int kind);
lrcs_shape study_scaled_body(lrcs_shape shape, double factor);
/* The aspect at which some of such a wall is seen along its normal, deg. */
double study_normal(int kind, double half_angle_deg);

lrcs_brdf study_finish(const study_job *job, int finish);
/* A material with one of 'A', 'B', 's', 'm' changed. */
lrcs_brdf study_with(lrcs_brdf brdf, char parameter, double value);
study_number study_sigma(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                         double aspect_deg);
/* That of such a wall at such an aspect. */
study_number study_wall_sigma(study_job *job, int kind, double half_angle_deg,
                              const lrcs_brdf *brdf);
/* Sigma for the exact lengths, which the bodies above have except for rounding. */
study_number study_meant(study_number sigma);
study_number study_sigma_at(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                            const lrcs_aspect *aspect);

/* ---- what takes more than one sigma ---- */

/* The angle from `aspect_deg`, up or down, at which sigma has fallen to half, deg. */
study_number study_half_power(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                              double aspect_deg, double side);
/* The angle at which that of one material has fallen to that of another, likewise. */
study_number study_crossing(study_job *job, const lrcs_shape *shape, const lrcs_brdf *falling,
                            const lrcs_brdf *other);
/* The fraction of all attitudes from which a glint is at least half of what it is at normal
   incidence (one face of the disc). */
study_number study_share(study_job *job, int kind, double half_angle_deg, const lrcs_brdf *brdf);
/* The mean over all attitudes. Its bound holds the quadrature's error, an estimate. */
study_number study_mean(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf);
/* The same for a body that is alike in all eight octants, with an even number of panels in each
   direction of one octant; `look` returns its sigma for a direction. */
typedef study_number study_look(study_job *job, const void *what, const double direction[3]);
study_number study_octant(study_job *job, study_look *look, const void *what, int panels);

/* ---- the engine itself, where a scene calls for it ---- */

/* A body alone, from some aspects, by tessellation and facets. */
void study_engine(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                  const double *aspect_deg, uint32_t count, study_number *sigma);
/* A cube with two panels, which shade each other: its surface, m2, and its mean over attitudes, as
   study_mean says it. */
study_number study_shaded(study_job *job, const lrcs_brdf *brdf, double *surface_m2);

/* ---- tables ---- */

/* Adds a table, of which the caller fills in the rest; a column of it; a value. */
study_table *study_table_add(study_job *job, const char *stem, const char *title);
uint32_t study_column_add(study_table *table, const char *id, const char *name, int colour,
                          int dash);
void study_put(study_table *table, uint32_t column, uint32_t row, study_number number);
/* The table with a stem; never NULL for those of study_..._tables. */
const study_table *study_find(const study_job *job, const char *stem);

/* Make all tables; a failure is stored in job->status. */
void study_attitude_tables(study_job *job);
void study_surface_tables(study_job *job);
void study_body_tables(study_job *job);

/* ---- laws ---- */
void study_surface_laws(study_job *job);
void study_shape_laws(study_job *job);
void study_engine_laws(study_job *job);

/* A new one; its sentences are the caller's to fill in. */
study_law *study_law_add(study_job *job, const char *name, const char *quantity);
/* Adds a comparison: within limits, the bound included; or equal to within the bound. */
void study_within(study_law *law, study_number number, double least, double most);
void study_equal(study_law *law, study_number number, double expected);
/* The first is the larger. */
void study_order(study_law *law, study_number large, study_number small);
int study_holds(const study_law *law);
/* How many hold. */
uint32_t study_held(const study_job *job);
/* The limits of a law's closest comparison, in words. */
void study_limits(const study_law *law, char text[64]);

/* ---- what is written ---- */
void study_print(const study_job *job);
void study_page(const study_job *job, FILE *out);
/* All files, each complete or not at all. A status, with the error filled in. */
int study_write(const study_job *job, const char *folder, lrcs_host_error *error);

#endif
