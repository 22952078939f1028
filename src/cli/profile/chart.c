/* SPDX-License-Identifier: MIT */
/* The chart of lrcs profile --plot and of lrcs plot: the density of sigma over range as steps, one
   for each bin, and the response of a pulse as a curve. */
#include "cli/profile/profile.h"

#include <stdlib.h>

/* More bins are drawn in groups, each with its mean density. */
#define CHART_STEPS 4000u

/* The response is known at points: they are marked if there are no more. */
#define CHART_MARKED 100u

/* The density of each group of bins as two points, and the pulse at its first bin as one. Returns
   the number of groups. */
static uint32_t profile_points_make(const profile_job *job, uint32_t group, double *x,
                                    double *density, double *middle, double *pulse)
{
    size_t count = 0;
    for (uint32_t i = 0; i < job->rows; i += group, count++) {
        uint32_t end = job->rows - i < group ? job->rows : i + group;
        double sigma = 0.0;
        for (uint32_t k = i; k < end; k++) {
            sigma += cli_profile_sigma(&job->row[k].bin);
        }
        double near = job->row[i].near_m;
        double far = job->row[end - 1].far_m;
        x[2 * count] = near;
        x[2 * count + 1] = far;
        density[2 * count] = density[2 * count + 1] = sigma / (far - near);
        middle[count] = 0.5 * near + 0.5 * job->row[i].far_m;
        pulse[count] = job->row[i].pulse_m;
    }
    return (uint32_t)count;
}

static int profile_chart_draw(const profile_job *job, double *number, size_t room, int png,
                              FILE *out, lrcs_host_error *error)
{
    uint32_t group = 1 + job->rows / CHART_STEPS;
    const lrcs_profile *p = &job->profile.list;
    char title[256];
    char note[256];
    lrcs_host_series series[2] = {{.name = "bins",
                                   .x = number,
                                   .y = number + room,
                                   .colour = LRCS_HOST_BLUE,
                                   .marker = LRCS_HOST_NO_MARKER},
                                  {.name = "pulse, at the middle of each bin",
                                   .x = number + 2 * room,
                                   .y = number + 3 * room,
                                   .colour = LRCS_HOST_VERMILION,
                                   .marker = LRCS_HOST_NO_MARKER}};
    uint32_t groups = profile_points_make(job, group, number, number + room, number + 2 * room,
                                          number + 3 * room);
    series[0].count = 2 * groups;
    series[1].count = job->fwhm_m > 0.0 ? groups : 0;
    if (series[1].count <= CHART_MARKED) {
        series[1].marker = LRCS_HOST_DISC;
    }
    snprintf(title, sizeof title, "Range profile of %.180s", cli_base_name(job->title));
    snprintf(note, sizeof note, "sigma %.6g m2 in all; bins of %g m",
             p->sigma_glint_m2 + p->sigma_diffuse_m2, job->bin_m);
    if (job->fwhm_m > 0.0) {
        lrcs_host_append(note, sizeof note, "; pulse of %g m (FWHM)", job->fwhm_m);
    }
    if (job->materials_assumed) {
        lrcs_host_append(note, sizeof note, "; materials illustrative or default");
    }
    const lrcs_host_chart chart = {.title = title,
                                   .about = job->about,
                                   .note = note,
                                   .x_name =
                                       "range from the body's origin, away from the laser (m)",
                                   .y_name = "sigma per range (m2/m)",
                                   .y_from_0 = 1,
                                   .series = series,
                                   .series_count = series[1].count > 0 ? 2 : 1};
    return cli_chart_put(out, &chart, png, error);
}

int cli_profile_chart(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const profile_job *job = context;
    size_t room = 2 * (size_t)job->rows + 2;
    double *number = malloc(4 * room * sizeof *number);
    if (!number) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return LRCS_E_SYSTEM;
    }
    int status = profile_chart_draw(job, number, room, png, out, error);
    free(number);
    return status;
}
