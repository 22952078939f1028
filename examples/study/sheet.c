/* SPDX-License-Identifier: MIT */
/* Tables with a row for each body: at the same surface, the same silhouette, the same wall; the
   mean over all attitudes; and the engine beside the closed forms. */
#include "study.h"

#include <math.h>

#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))

static const int order_list[] = {STUDY_DISC, STUDY_CONE, STUDY_CYLINDER, STUDY_SPHERE};

static study_table *sheet_table(study_job *job, const char *stem, const char *title)
{
    study_table *table = study_table_add(job, stem, title);
    table->x_id = "body";
    return table;
}

/* Three columns, one for each kind of surface. */
static void sheet_columns(study_table *table, const char *view, const char *name)
{
    static const char *const finish[] = {"diffuse", "glint", "mixed"};
    for (int i = 0; i < STUDY_FINISHES; i++) {
        char id[32];
        char text[48];
        snprintf(id, sizeof id, "%s_%s_m2", view, finish[i]);
        snprintf(text, sizeof text, "%s, %s (m²)", name, finish[i]);
        study_column_add(table, id, text, LRCS_HOST_BLACK, LRCS_HOST_SOLID);
    }
}

static void sheet_fill(study_job *job, study_table *table, uint32_t column, uint32_t row,
                       const lrcs_shape *shape, double aspect_deg)
{
    for (uint32_t finish = 0; finish < STUDY_FINISHES; finish++) {
        const lrcs_brdf brdf = study_finish(job, (int)finish);
        study_put(table, column + finish, row, study_sigma(job, shape, &brdf, aspect_deg));
    }
}

static void surface_sheet(study_job *job)
{
    study_table *table = sheet_table(job, "equal-surface", "Bodies of 6 m² of surface");
    sheet_columns(table, "axis", "along the axis");
    sheet_columns(table, "broadside", "broadside");
    for (uint32_t kind = 0; kind < STUDY_KINDS; kind++) {
        const lrcs_shape shape = study_body((int)kind);
        table->row_name[kind] = study_name((int)kind);
        sheet_fill(job, table, 0, kind, &shape, 0.0);
        sheet_fill(job, table, STUDY_FINISHES, kind, &shape, 90.0);
    }
}

static void silhouette_sheet(study_job *job)
{
    static const int kind[] = {STUDY_CUBE, STUDY_CYLINDER, STUDY_CONE, STUDY_SPHERE};
    study_table *table =
        sheet_table(job, "equal-projected-area", "Bodies that show 1 m² at 90 deg from their axis");
    sheet_columns(table, "broadside", "broadside");
    for (uint32_t row = 0; row < COUNT_OF(kind); row++) {
        const lrcs_shape shape = study_silhouette(kind[row]);
        table->row_name[row] = study_name(kind[row]);
        sheet_fill(job, table, 0, row, &shape, 90.0);
    }
}

/* How high a glint is and how rare. */
static void glint_sheet(study_job *job)
{
    const lrcs_brdf brdf = study_finish(job, STUDY_GLINT);
    study_table *table =
        sheet_table(job, "glint-share", "Glint of 1 m² of wall: how high, and how often");
    study_column_add(table, "peak_m2", "at normal incidence (m²)", 0, 0);
    study_column_add(table, "mean_m2", "mean over all attitudes (m²)", 0, 0);
    study_column_add(table, "share", "share of attitudes within half power", 0, 0);
    table->estimate = 1;
    table->maker = "Closed forms and their quadrature";
    for (uint32_t row = 0; row < COUNT_OF(order_list); row++) {
        int kind = order_list[row];
        const lrcs_shape shape = study_wall(kind, STUDY_HALF);
        double normal = study_normal(kind, STUDY_HALF);
        table->row_name[row] = study_name(kind);
        study_put(table, 0, row, study_sigma(job, &shape, &brdf, normal));
        study_put(table, 1, row, study_mean(job, &shape, &brdf));
        study_put(table, 2, row,
                  kind == STUDY_SPHERE ? study_exact(1.0)
                                       : study_share(job, kind, STUDY_HALF, &brdf));
    }
}

static void mean_sheet(study_job *job)
{
    study_table *table =
        sheet_table(job, "attitude-mean", "Mean over all attitudes, bodies of 6 m² of surface");
    sheet_columns(table, "mean", "mean");
    table->estimate = 1;
    table->maker = "Closed forms and their quadrature";
    for (uint32_t kind = 0; kind < STUDY_KINDS; kind++) {
        const lrcs_shape shape = study_body((int)kind);
        table->row_name[kind] = study_name((int)kind);
        for (uint32_t finish = 0; finish < STUDY_FINISHES; finish++) {
            const lrcs_brdf brdf = study_finish(job, (int)finish);
            study_put(table, finish, kind, study_mean(job, &shape, &brdf));
        }
    }
}

/* The last column has the bounds of the closed forms, as everywhere. */
static void engine_sheet(study_job *job)
{
    static const int list[] = {STUDY_CUBE, STUDY_CYLINDER, STUDY_CONE};
    static const double aspect[] = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 150.0, 180.0};
    study_number sigma[COUNT_OF(aspect)];
    study_table *table =
        study_table_add(job, "engine", "The engine's facets against closed forms, mixed surface");
    table->x_id = "aspect_deg";
    table->x_name = "aspect (deg)";
    table->maker = "Closed forms, and the engine's facets (method facet, tolerance 1e-4)";
    for (size_t k = 0; k < COUNT_OF(list); k++) {
        const lrcs_shape shape = study_body(list[k]);
        char id[32];
        char name[48];
        snprintf(id, sizeof id, "%s_closed_m2", study_name(list[k]));
        snprintf(name, sizeof name, "%s, closed form (m²)", study_name(list[k]));
        uint32_t column = study_column_add(table, id, name, 0, 0);
        snprintf(id, sizeof id, "%s_engine_m2", study_name(list[k]));
        snprintf(name, sizeof name, "%s, engine (m²)", study_name(list[k]));
        study_column_add(table, id, name, 0, 0);
        snprintf(id, sizeof id, "%s_bound_m2", study_name(list[k]));
        snprintf(name, sizeof name, "%s, engine's bound (m²)", study_name(list[k]));
        study_column_add(table, id, name, 0, 0);
        study_engine(job, &shape, &job->brdf, aspect, COUNT_OF(aspect), sigma);
        for (uint32_t i = 0; i < COUNT_OF(aspect) && job->status == LRCS_OK; i++) {
            table->x[i] = aspect[i];
            study_put(table, column, i, study_sigma(job, &shape, &job->brdf, aspect[i]));
            study_put(table, column + 1, i, study_exact(sigma[i].value));
            study_put(table, column + 2, i, study_exact(sigma[i].bound));
        }
    }
}

void study_body_tables(study_job *job)
{
    surface_sheet(job);
    silhouette_sheet(job);
    glint_sheet(job);
    mean_sheet(job);
    engine_sheet(job);
}
