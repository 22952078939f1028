/* SPDX-License-Identifier: MIT */
/* Sigma and angles against one number: a body's size, the slope s, the diffusivity m. */
#include "study.h"

#include <math.h>

#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))

static const double slope_list[] = {0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5};
static const double m_list[] = {0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0};

/* The walls of 1 m2, in the order of their curvature. */
static const int wall_list[] = {STUDY_DISC, STUDY_CONE, STUDY_CYLINDER, STUDY_SPHERE};

static study_table *dial_table(study_job *job, const char *stem, const char *title, int chart,
                               const char *x_id, const char *x_name, const char *y_name)
{
    study_table *table = study_table_add(job, stem, title);
    table->chart = chart;
    table->x_id = x_id;
    table->x_name = x_name;
    table->y_name = y_name;
    return table;
}

static uint32_t body_column(study_table *table, int kind, const char *unit)
{
    char id[32];
    snprintf(id, sizeof id, "%s_%s", study_name(kind), unit);
    return study_column_add(table, id, study_name(kind), study_colour(kind),
                            kind == STUDY_CONE ? LRCS_HOST_DASHED : LRCS_HOST_SOLID);
}

/* A body 1/8 to 8 times as large, broadside. */
static void size_table(study_job *job)
{
    static const int list[] = {STUDY_CUBE, STUDY_CYLINDER, STUDY_CONE};
    study_table *table = dial_table(job, "size", "Influence of size", STUDY_LOG_LOG, "scale",
                                    "length relative to the body of 6 m2", "sigma (m2)");
    snprintf(table->note, sizeof table->note, "mixed surface, broadside");
    for (size_t k = 0; k < COUNT_OF(list); k++) {
        uint32_t column = body_column(table, list[k], "m2");
        for (int i = -3; i <= 3; i++) {
            lrcs_shape shape = study_scaled_body(study_body(list[k]), ldexp(1.0, i));
            uint32_t row = (uint32_t)(i + 3);
            table->x[row] = ldexp(1.0, i);
            study_put(table, column, row, study_sigma(job, &shape, &job->brdf, 90.0));
        }
    }
}

/* Half-power angles of glints, of a cone to both sides. */
typedef struct width_curve {
    int kind;
    double side;
    const char *id, *name;
    int colour, dash;
} width_curve;

static const width_curve width_curves[] = {
    {STUDY_DISC, 1.0, "disc", "disc", LRCS_HOST_BLACK, LRCS_HOST_SOLID},
    {STUDY_CYLINDER, -1.0, "cylinder", "cylinder", LRCS_HOST_VERMILION, LRCS_HOST_DASHED},
    {STUDY_CONE, 1.0, "cone_to_base", "cone, towards its base", LRCS_HOST_GREEN, LRCS_HOST_SOLID},
    {STUDY_CONE, -1.0, "cone_to_nose", "cone, towards its nose", LRCS_HOST_SKY_BLUE,
     LRCS_HOST_SOLID}};

static void width_columns(study_table *table, const char *unit, const char *unit_name)
{
    for (size_t k = 0; k < COUNT_OF(width_curves); k++) {
        const width_curve *curve = &width_curves[k];
        char id[32];
        char name[48];
        snprintf(id, sizeof id, "%s_%s", curve->id, unit);
        snprintf(name, sizeof name, "%s%s", curve->name, unit_name);
        study_column_add(table, id, name, curve->colour, curve->dash);
    }
}

static study_number width_of(study_job *job, const width_curve *curve, double s)
{
    const lrcs_shape shape = study_wall(curve->kind, STUDY_HALF);
    const lrcs_brdf brdf = study_with(study_finish(job, STUDY_GLINT), 's', s);
    double normal = study_normal(curve->kind, STUDY_HALF);
    return study_half_power(job, &shape, &brdf, normal, curve->side);
}

/* s sqrt(ln 2) rad, in deg. */
static double width_first_order(double s)
{
    return s * sqrt(log(2.0)) * 180.0 / LRCS_PI;
}

static void width_table(study_job *job)
{
    uint32_t columns = COUNT_OF(width_curves);
    study_table *table = dial_table(job, "glint-width", "Half-power angle of a glint (deg)",
                                    STUDY_NO_CHART, "s", "s", NULL);
    width_columns(table, "deg", "");
    study_column_add(table, "first_order_deg", "s sqrt(ln 2)", 0, 0);
    for (uint32_t i = 0; i < COUNT_OF(slope_list); i++) {
        table->x[i] = slope_list[i];
        for (uint32_t k = 0; k < columns; k++) {
            study_put(table, k, i, width_of(job, &width_curves[k], slope_list[i]));
        }
        study_put(table, columns, i, study_exact(width_first_order(slope_list[i])));
    }
}

static void widening_table(study_job *job)
{
    study_table *table =
        dial_table(job, "glint-widening", "How the width of a glint follows the rms slope s",
                   STUDY_LINEAR, "s", "rms slope s", "half-power angle / (s sqrt(ln 2))");
    snprintf(table->note, sizeof table->note,
             "purely specular; angles from the normal, from broadside, from the cone's 90 deg - "
             "half-angle (%g deg)",
             STUDY_HALF);
    width_columns(table, "ratio", "");
    for (uint32_t i = 0; i < 25; i++) {
        double s = table->x[i] = (i + 1) / 50.0;
        for (uint32_t k = 0; k < COUNT_OF(width_curves); k++) {
            study_number half = width_of(job, &width_curves[k], s);
            study_put(table, k, i, study_scaled(half, 1.0 / width_first_order(s)));
        }
    }
}

/* Each wall at normal incidence. */
static void wall_fill(study_job *job, study_table *table, const lrcs_brdf *brdf, uint32_t row)
{
    for (uint32_t k = 0; k < COUNT_OF(wall_list); k++) {
        const lrcs_shape shape = study_wall(wall_list[k], STUDY_HALF);
        double normal = study_normal(wall_list[k], STUDY_HALF);
        study_put(table, k, row, study_sigma(job, &shape, brdf, normal));
    }
}

static void peak_table(study_job *job)
{
    study_table *table = dial_table(job, "glint-peak", "Height of a glint against the rms slope s",
                                    STUDY_LOG_LOG, "s", "rms slope s", "sigma of the glint (m2)");
    snprintf(table->note, sizeof table->note,
             "purely specular, 1 m2 of flat face or curved wall at normal incidence; A = %.5g /sr",
             job->brdf.A);
    for (size_t k = 0; k < COUNT_OF(wall_list); k++) {
        body_column(table, wall_list[k], "m2");
    }
    for (uint32_t i = 0; i < COUNT_OF(slope_list); i++) {
        lrcs_brdf brdf = study_with(study_finish(job, STUDY_GLINT), 's', slope_list[i]);
        table->x[i] = slope_list[i];
        wall_fill(job, table, &brdf, i);
    }
}

static void diffuse_table(study_job *job)
{
    study_table *table =
        dial_table(job, "diffuse-m", "Height of the diffuse part against m", STUDY_LOG, "m",
                   "diffusivity m", "sigma of the diffuse part (m2)");
    snprintf(table->note, sizeof table->note,
             "purely diffuse, 1 m2 of flat face or curved wall at normal incidence; B = %.5g /sr",
             job->brdf.B);
    for (size_t k = 0; k < COUNT_OF(wall_list); k++) {
        body_column(table, wall_list[k], "m2");
    }
    for (uint32_t i = 0; i <= 40; i++) {
        lrcs_brdf brdf = study_with(study_finish(job, STUDY_DIFFUSE), 'm', 0.5 * i);
        table->x[i] = 0.5 * i;
        wall_fill(job, table, &brdf, i);
    }
}

static void lobe_table(study_job *job)
{
    study_table *table =
        dial_table(job, "diffuse-width", "Half-power angle of the diffuse lobe (deg)",
                   STUDY_NO_CHART, "m", "m", NULL);
    const lrcs_shape disc = study_wall(STUDY_DISC, 0.0);
    const lrcs_shape cylinder = study_wall(STUDY_CYLINDER, 0.0);
    body_column(table, STUDY_DISC, "deg");
    body_column(table, STUDY_CYLINDER, "deg");
    for (uint32_t i = 0; i < COUNT_OF(m_list); i++) {
        lrcs_brdf brdf = study_with(study_finish(job, STUDY_DIFFUSE), 'm', m_list[i]);
        table->x[i] = m_list[i];
        study_put(table, 0, i, study_half_power(job, &disc, &brdf, 0.0, 1.0));
        study_put(table, 1, i, study_half_power(job, &cylinder, &brdf, 90.0, -1.0));
    }
}

void study_surface_tables(study_job *job)
{
    size_table(job);
    width_table(job);
    widening_table(job);
    peak_table(job);
    diffuse_table(job);
    lobe_table(job);
}
