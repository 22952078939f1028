/* SPDX-License-Identifier: MIT */
/* Sigma against attitude: bodies of the same surface beside each other for each kind of surface,
   the kinds beside each other for each body, and a cylinder with one parameter changed. */
#include "study.h"

#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))

static study_table *attitude_table(study_job *job, const char *stem, const char *title,
                                   double floor_m2)
{
    study_table *table = study_table_add(job, stem, title);
    table->x_id = "aspect_deg";
    table->x_name = "angle between line of sight and axis (deg)";
    table->y_name = "sigma (dBsm)";
    table->chart = STUDY_DBSM;
    table->floor = floor_m2;
    return table;
}

/* A column of sigma from 0 deg on. */
static void attitude_fill(study_job *job, study_table *table, uint32_t column,
                          const lrcs_shape *shape, const lrcs_brdf *brdf, double step_deg,
                          double last_deg)
{
    for (uint32_t i = 0; i * step_deg <= last_deg; i++) {
        table->x[i] = i * step_deg;
        study_put(table, column, i, study_sigma(job, shape, brdf, table->x[i]));
    }
}

/* What is drawn, and its material except for a parameter that varies. */
static void material_note(study_table *table, const char *what, const lrcs_brdf *brdf, char varies)
{
    static const char name[] = {'A', 'B', 's', 'm'};
    const double value[] = {brdf->A, brdf->B, brdf->s, brdf->m};
    size_t size = (size_t)snprintf(table->note, sizeof table->note, "%s", what);
    for (int i = 0; i < 4 && size < sizeof table->note; i++) {
        if (name[i] != varies) {
            size += (size_t)snprintf(table->note + size, sizeof table->note - size, ", %c = %.5g%s",
                                     name[i], value[i], i < 2 ? " /sr" : "");
        }
    }
}

/* ---- bodies beside each other ---- */

static const char *const finish_stem[STUDY_FINISHES] = {"attitude-diffuse", "attitude-glint",
                                                        "attitude-mixed"};
static const char *const finish_title[STUDY_FINISHES] = {
    "Attitude, purely diffuse surface", "Attitude, purely specular (glint) surface",
    "Attitude, mixed surface"};

/* Cube and cylinder show faces of the same size, whose curves coincide. */
static const int body_dash[STUDY_KINDS] = {[STUDY_DISC] = LRCS_HOST_DOTTED,
                                           [STUDY_CYLINDER] = LRCS_HOST_DASHED,
                                           [STUDY_SPHERE] = LRCS_HOST_DOTTED};

static void bodies_table(study_job *job, int finish)
{
    const lrcs_brdf brdf = study_finish(job, finish);
    study_table *table = attitude_table(job, finish_stem[finish], finish_title[finish],
                                        finish == STUDY_GLINT ? 1e-6 : 0.1);
    material_note(table, "bodies of 6 m2 of surface", &brdf, 0);
    table->polar = finish == STUDY_MIXED;
    for (int kind = 0; kind < STUDY_KINDS; kind++) {
        const lrcs_shape shape = study_body(kind);
        char id[32];
        snprintf(id, sizeof id, "%s_m2", study_name(kind));
        uint32_t column =
            study_column_add(table, id, study_name(kind), study_colour(kind), body_dash[kind]);
        attitude_fill(job, table, column, &shape, &brdf, 1.0, 180.0);
    }
}

/* ---- kinds of surface beside each other ---- */

static void finishes_table(study_job *job, int kind, const char *stem, const char *title)
{
    static const char *const id[] = {"diffuse_m2", "glint_m2", "mixed_m2"};
    static const char *const name[] = {"purely diffuse", "purely specular", "mixed"};
    static const int colour[] = {LRCS_HOST_GREEN, LRCS_HOST_ORANGE, LRCS_HOST_BLACK};
    const lrcs_shape shape = study_body(kind);
    study_table *table = attitude_table(job, stem, title, 1e-3);
    material_note(table, "6 m2 of surface", &job->brdf, 0);
    for (int finish = 0; finish < STUDY_FINISHES; finish++) {
        const lrcs_brdf brdf = study_finish(job, finish);
        uint32_t column =
            study_column_add(table, id[finish], name[finish], colour[finish],
                             finish == STUDY_MIXED ? LRCS_HOST_DASHED : LRCS_HOST_SOLID);
        attitude_fill(job, table, column, &shape, &brdf, 1.0, 180.0);
    }
}

/* ---- one parameter at a time ---- */

typedef struct influence {
    const char *stem, *title;
    char parameter;
    double value[4];
} influence;

static const influence influences[] = {
    {"influence-A", "Influence of the glint amplitude A", 'A', {0.25, 1.0, 4.0, 16.0}},
    {"influence-B", "Influence of the diffuse amplitude B", 'B', {0.0625, 0.125, 0.25, 0.5}},
    {"influence-s", "Influence of the rms slope s", 's', {0.05, 0.1, 0.2, 0.4}},
    {"influence-m", "Influence of the diffusivity m", 'm', {0.0, 1.0, 5.0, 20.0}}};

static void influence_table(study_job *job, const influence *of)
{
    static const int colour[] = {LRCS_HOST_BLACK, LRCS_HOST_BLUE, LRCS_HOST_VERMILION,
                                 LRCS_HOST_GREEN};
    static const int dash[] = {LRCS_HOST_SOLID, LRCS_HOST_DASHED, LRCS_HOST_SOLID,
                               LRCS_HOST_DOTTED};
    const lrcs_shape shape = study_body(STUDY_CYLINDER);
    study_table *table = attitude_table(job, of->stem, of->title, 1e-3);
    material_note(table, "cylinder of 6 m2 of surface", &job->brdf, of->parameter);
    for (int i = 0; i < 4; i++) {
        const lrcs_brdf brdf = study_with(job->brdf, of->parameter, of->value[i]);
        char id[32];
        char name[48];
        snprintf(id, sizeof id, "%c_%g_m2", of->parameter, of->value[i]);
        snprintf(name, sizeof name, "%c = %g", of->parameter, of->value[i]);
        uint32_t column = study_column_add(table, id, name, colour[i], dash[i]);
        attitude_fill(job, table, column, &shape, &brdf, 0.5, 90.0);
    }
}

void study_attitude_tables(study_job *job)
{
    for (int finish = 0; finish < STUDY_FINISHES; finish++) {
        bodies_table(job, finish);
    }
    finishes_table(job, STUDY_CUBE, "surface-cube", "Kinds of surface: cube");
    finishes_table(job, STUDY_CYLINDER, "surface-cylinder", "Kinds of surface: cylinder");
    finishes_table(job, STUDY_CONE, "surface-cone", "Kinds of surface: cone");
    for (size_t i = 0; i < COUNT_OF(influences); i++) {
        influence_table(job, &influences[i]);
    }
}
