/* SPDX-License-Identifier: MIT */
/* What the engine adds to the laws: that its facets give the closed forms, and what shadows do to
   the law of the mean. */
#include "study.h"

#include <math.h>

static void shading_law(study_job *job)
{
    study_law *law =
        study_law_add(job, "mutual shadowing", "mean / sigma of the sphere of the same surface");
    double surface;
    study_number mean = study_shaded(job, &job->brdf, &surface);
    const lrcs_shape sphere = {.kind = LRCS_SHAPE_SPHERE, .radius = sqrt(surface / LRCS_FOUR_PI)};
    study_number convex = study_meant(study_sigma(job, &sphere, &job->brdf, 0.0));
    study_number ratio = study_ratio(mean, convex);
    law->estimate = 1;
    study_within(law, ratio, -HUGE_VAL, 1.0);
    snprintf(
        law->text, sizeof law->text,
        "Parts that shadow each other return less in the mean than their surface would: a cube "
        "of 1 m with two panels of 2 x 1 m beside it returns %.4f of the convex law (computed "
        "by the engine, exact visibility).",
        ratio.value);
    snprintf(law->range, sizeof law->range,
             "This scene. Shadows only take away, so that the sign is general without "
             "interreflection; how much is not.");
}

static void engine_law(study_job *job)
{
    const study_table *table = study_find(job, "engine");
    study_law *law = study_law_add(job, "engine = closed form", "difference / bound");
    double worst = 0.0;
    double largest = 0.0;
    for (uint32_t c = 0; c + 2 < table->columns; c += 3) {
        for (uint32_t r = 0; r < table->rows; r++) {
            double closed = table->column[c].value[r];
            double off = fabs(table->column[c + 1].value[r] - closed);
            double bound = table->column[c + 2].value[r] + table->bound[r];
            study_within(law, study_exact(off / bound), -HUGE_VAL, 1.0);
            worst = fmax(worst, off / closed);
            largest = fmax(largest, bound / closed);
        }
    }
    snprintf(law->text, sizeof law->text,
             "The engine's own facets give the closed forms of cube, cylinder and cone within its "
             "proved bounds: they differ by at most %.1e of sigma, where the bounds allow %.1e.",
             1.1 * worst, 1.1 * largest);
    snprintf(law->range, sizeof law->range, "Mixed surface, ten aspects, tolerance 1e-4.");
}

void study_engine_laws(study_job *job)
{
    shading_law(job);
    engine_law(job);
}
