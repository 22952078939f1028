/* SPDX-License-Identifier: MIT */
/* Draws the rows of sweeps as curves, as a polar diagram, or as a map. This file decides the values
   and the texts; sweep_axes.c decides which quantity runs along which axis; chart.c and map.c draw.
 */
#include <lrcs/sweep_chart.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/chart/sweep_axes.h"
#include "host/fail.h"
#include "host/run/median.h"

#define PLOT_MARKS 40u  /* points are marked if there are fewer */
#define PLOT_DEEP  60.0 /* the colours of a map span at most this many dB */

/* ---- notes ---- */

int lrcs_host_sweep_chart_band(const lrcs_host_sweep_chart *plot, double part[2],
                               lrcs_host_error *error)
{
    uint64_t count = 0;
    double *half = malloc((plot->plan->rows + 1) * sizeof *half);
    if (!half) {
        return lrcsi_host_out_of_memory(error);
    }
    for (uint64_t i = 0; i < plot->plan->rows; i++) {
        if (plot->row[i][0] > 0.0) {
            half[count++] = 0.5 * (plot->band[i][1] - plot->band[i][0]) / plot->row[i][0];
        }
    }
    part[0] = lrcsi_host_median(half, (uint32_t)count);
    part[1] = count > 0 ? half[count - 1] : 0.0;
    free(half);
    return LRCS_OK;
}

/* The text below the title: the fixed values, and how accurate sigma is. */
static int plot_note(const lrcs_host_sweep_chart *plots, uint32_t count, char note[512],
                     lrcs_host_error *error)
{
    const lrcs_host_plan *plan = plots->plan;
    const char *accept = NULL;
    char bound[LRCS_HOST_BOUND_SIZE];
    double worst = 0.0;
    int dark = 0;
    int assumed = 0;
    char interval_text[120] = "";
    int status = LRCS_OK;
    note[0] = '\0';
    for (uint32_t i = 0; i < plan->axes && strlen(note) < 300 && count == 1; i++) {
        if (plan->axis[i].range.count == 1) {
            char text[192];
            lrcsi_axis_value_text(plan->column[i], lrcs_host_range_at(&plan->axis[i].range, 0),
                                  text);
            lrcs_host_append(note, 512, "%s; ", text);
        }
    }
    for (uint32_t k = 0; k < count; k++) {
        const lrcs_host_sweep_chart *plot = &plots[k];
        for (uint64_t i = 0; i < plot->plan->rows; i++) {
            worst = fmax(worst, plot->row[i][1]);
            dark |= plot->dbsm && !(plot->row[i][0] > 0.0);
        }
        assumed |= plot->materials_assumed;
        if (plot->band && plot->map) {
            double part[2] = {0.0, 0.0};
            status = lrcs_host_sweep_chart_band(plot, part, error);
            char median[32] = "below 0.05";
            if (part[0] >= 5e-4) {
                snprintf(median, sizeof median, "+-%.2g", 100.0 * part[0]);
            }
            snprintf(interval_text, sizeof interval_text,
                     "; errors of materials (68 %%): %s %% of sigma (median), +-%.2g %% (most)",
                     median, 100.0 * part[1]);
        } else if (plot->band) {
            snprintf(interval_text, sizeof interval_text,
                     "; shaded: 68 %% by the errors of materials");
        }
        accept = plot->accept && strcmp(plot->accept, "bound") != 0 ? plot->accept : accept;
    }
    lrcs_host_bound_text(worst, 2, bound);
    lrcs_host_append(
        note, 512, "each sigma is proved to within %s m2 or better%s%s%s%s%s%s", bound,
        assumed ? " for its materials, which are illustrative" : "", interval_text,
        accept ? "; accepted by " : "", accept ? accept : "",
        !dark        ? ""
        : plots->map ? "; grey: sigma is 0"
                     : "; gaps: sigma is 0",
        plan->kind == LRCS_HOST_PLAN_SPHERE ? "; each place shows the nearest direction" : "");
    return status;
}

/* ---- data ---- */

/* The direction of a Fibonacci lattice nearest to an azimuth and elevation: rows descend in z, and
   only those within a chord of 4 / sqrt(N) of its z can be nearest (the lattice leaves no gap of
   that radius). */
static uint64_t sphere_nearest(const lrcs_host_plan *plan, double az, double el)
{
    lrcs_pose pose = lrcs_pose_default();
    double n = (double)plan->rows;
    double reach = 4.0 / sqrt(n);
    uint64_t best = 0;
    double most = -2.0;
    lrcs_pose_from_azel(az, el, &pose);
    double z = pose.direction[2];
    uint64_t first = (uint64_t)fmax(0.0, floor(0.5 * n * (1.0 - z - reach)));
    uint64_t end = (uint64_t)fmin(n, ceil(0.5 * n * (1.0 - z + reach)) + 1.0);
    for (uint64_t i = first; i < end; i++) {
        double direction[LRCS_HOST_PLAN_COLUMNS];
        lrcs_host_plan_values(plan, i, direction);
        double dot = direction[0] * pose.direction[0] + direction[1] * pose.direction[1] +
                     direction[2] * pose.direction[2];
        if (dot > most) {
            most = dot;
            best = i;
        }
    }
    return best;
}

static double plot_shown(const lrcs_host_sweep_chart *plot, double sigma)
{
    return plot->dbsm ? 10.0 * log10(sigma) : sigma; /* dBsm of 0 is not finite and not drawn */
}

/* The value of an axis at one of its places. */
static double place_value(const lrcs_host_sweep_chart *plot, const lrcs_host_sweep_axis *axis,
                          uint64_t place)
{
    const lrcs_host_plan *plan = plot->plan;
    if (plan->kind == LRCS_HOST_PLAN_SPHERE) {
        double first = axis == &plot->x ? -180.0 : -90.0;
        return first * (1.0 - 2.0 * (double)place / (double)(axis->count - 1));
    }
    return axis->column == plan->axes ? plan->track.row[place][0]
                                      : lrcs_host_range_at(&plan->axis[axis->column].range, place);
}

/* The title of an axis; for the time of a track with its unit and its epoch. */
static void time_title(const lrcs_host_sweep_chart *plot, const lrcs_host_sweep_axis *axis,
                       char text[192])
{
    const lrcs_host_plan *plan = plot->plan;
    if (plan->kind != LRCS_HOST_PLAN_TRACK || axis->column != plan->axes ||
        strcmp(axis->name, "time") != 0) {
        lrcsi_axis_words words = lrcsi_axis_words_of(axis->name);
        snprintf(text, 192, words.unit ? "%s (%s)" : "%s", words.text, words.unit);
    } else if (plan->track.epoch[0]) {
        snprintf(text, 192, "time since %s (s)", plan->track.epoch);
    } else {
        snprintf(text, 192, "time (s)");
    }
}

/* ---- drawing ---- */

/* The values of one sweep. */
typedef struct plot_values {
    double *x, *y, *z;  /* values along both axes, and sigma: z[y][x]; x is allocated */
    double *low, *high; /* the ends of bands, as z; NULL if none */
} plot_values;

typedef struct plot_drawing {
    const lrcs_host_sweep_chart *plot;
    uint32_t count; /* number of sweeps */
    plot_values values[LRCS_HOST_SWEEP_CURVES];
    char title[256], note[512], x_name[192], y_name[192];
    char *about; /* what the sweeps were made from, for the file; owned */
} plot_drawing;

static int drawing_curves(FILE *out, const plot_drawing *drawing, int png, lrcs_host_error *error)
{
    static const int colour[LRCS_HOST_SWEEP_CURVES] = {
        LRCS_HOST_BLUE,     LRCS_HOST_VERMILION, LRCS_HOST_GREEN, LRCS_HOST_PURPLE,
        LRCS_HOST_SKY_BLUE, LRCS_HOST_ORANGE,    LRCS_HOST_BLACK};
    const lrcs_host_sweep_chart *plot = drawing->plot;
    lrcs_host_series series[LRCS_HOST_SWEEP_CURVES];
    char name[LRCS_HOST_SWEEP_CURVES][400];
    uint32_t curves = 0;
    for (uint32_t k = 0; k < drawing->count; k++) {
        const lrcs_host_sweep_chart *one = &drawing->plot[k];
        const plot_values *values = &drawing->values[k];
        for (uint32_t i = 0; i < one->y.count; i++, curves++) {
            int marked = one->x.count < PLOT_MARKS;
            char value[192] = ""; /* a curve is named by its sweep, its value along y, or both */
            if (one->y.count > 1) {
                lrcsi_axis_value_text(one->y.name, values->y[i], value);
            }
            snprintf(name[curves], sizeof name[curves], "%.200s%s%s", one->name ? one->name : "",
                     one->name && value[0] ? ", " : "", value);
            series[curves] = (lrcs_host_series){
                .name = name[curves][0] ? name[curves] : NULL,
                .count = (uint32_t)one->x.count,
                .x = values->x,
                .y = values->z + i * one->x.count,
                .low = values->low ? values->low + i * one->x.count : NULL,
                .high = values->high ? values->high + i * one->x.count : NULL,
                .colour = colour[curves],
                .marker = marked ? (int)(curves % LRCS_HOST_NO_MARKER) : LRCS_HOST_NO_MARKER,
                .dash = (int)(curves % 2 ? LRCS_HOST_DASHED : LRCS_HOST_SOLID)};
        }
    }
    const lrcs_host_chart chart = {.title = drawing->title,
                                   .note = drawing->note,
                                   .x_name = drawing->x_name,
                                   .y_name = plot->dbsm ? "sigma (dBsm)" : "sigma (m2)",
                                   .x_deg = lrcsi_axis_is_angle(&plot->x),
                                   .y_from_0 =
                                       !plot->dbsm && plot->plan->kind != LRCS_HOST_PLAN_TRACK,
                                   .polar = plot->polar,
                                   .about = drawing->about,
                                   .series = series,
                                   .series_count = curves};
    if (png) {
        return lrcs_host_chart_png(out, &chart, error);
    }
    lrcs_host_chart_svg(out, &chart);
    return LRCS_OK;
}

/* A map around the whole sphere in Mollweide's projection whose azimuths end one step before the
   full turn: repeats its first column there, because otherwise that step would be empty. Returns
   the memory of the longer arrays; NULL if the map stays as it is. */
static double *ring_close(lrcs_host_map *map)
{
    const uint32_t n = map->columns;
    double end = map->x[0] + 360.0;
    double step = map->x[n - 1] - map->x[n - 2];
    if (!map->mollweide || !(end > map->x[n - 1] && end - map->x[n - 1] <= 1.000001 * step)) {
        return NULL;
    }
    double *x = malloc(((size_t)n + 1) * ((size_t)map->rows + 1) * sizeof *x);
    if (x) {
        double *z = x + n + 1;
        memcpy(x, map->x, n * sizeof *x);
        x[n] = end;
        for (size_t i = 0; i < map->rows; i++) {
            memcpy(z + i * (n + 1), map->z + i * n, n * sizeof *z);
            z[i * (n + 1) + n] = map->z[i * n];
        }
        map->x = x;
        map->z = z;
        map->columns = n + 1;
    }
    return x;
}

static int drawing_map(FILE *out, const plot_drawing *drawing, int png, lrcs_host_error *error)
{
    const lrcs_host_sweep_chart *plot = drawing->plot;
    lrcs_host_map map = {.title = drawing->title,
                         .note = drawing->note,
                         .x_name = drawing->x_name,
                         .y_name = drawing->y_name,
                         .z_name = plot->dbsm ? "sigma (dBsm)" : "sigma (m2)",
                         .columns = (uint32_t)plot->x.count,
                         .rows = (uint32_t)plot->y.count,
                         .x = drawing->values->x,
                         .y = drawing->values->y,
                         .z = drawing->values->z,
                         .deep = plot->dbsm ? PLOT_DEEP : 0.0,
                         .x_deg = lrcsi_axis_is_angle(&plot->x),
                         .y_deg = lrcsi_axis_is_angle(&plot->y),
                         .mollweide = plot->mollweide,
                         .about = drawing->about,
                         .cells = plot->plan->kind == LRCS_HOST_PLAN_SPHERE};
    int status = LRCS_OK;
    double *closed = ring_close(&map);
    if (png) {
        status = lrcs_host_map_png(out, &map, error);
    } else {
        lrcs_host_map_svg(out, &map);
    }
    free(closed);
    return status;
}

/* The values along both axes in ascending order, as a map needs them, and sigma in that order:
   descending ranges are reversed. */
static int values_fill(const lrcs_host_sweep_chart *plot, plot_values *values,
                       lrcs_host_error *error)
{
    const lrcs_host_sweep_axis *along[2] = {&plot->x, &plot->y};
    int back[2];
    int sphere = plot->plan->kind == LRCS_HOST_PLAN_SPHERE;
    double step = 360.0 / (double)(plot->x.count - 1); /* deg, of a sphere */
    uint64_t cells = plot->x.count * plot->y.count;
    values->x = malloc((3 * cells + plot->x.count + plot->y.count) * sizeof(double));
    if (!values->x) {
        return lrcsi_host_out_of_memory(error);
    }
    values->y = values->x + plot->x.count;
    values->z = values->y + plot->y.count;
    values->low = plot->band ? values->z + cells : NULL;
    values->high = plot->band ? values->z + 2 * cells : NULL;
    for (int k = 0; k < 2; k++) {
        uint64_t last = along[k]->count - 1;
        double *value = k == 0 ? values->x : values->y;
        back[k] = last > 0 && place_value(plot, along[k], last) < place_value(plot, along[k], 0);
        for (uint64_t i = 0; i <= last; i++) {
            value[i] = last == 0 ? 0.0 : place_value(plot, along[k], back[k] ? last - i : i);
        }
    }
    for (uint64_t y = 0; y < plot->y.count; y++) {
        for (uint64_t x = 0; x < plot->x.count; x++) {
            uint64_t i = back[0] ? plot->x.count - 1 - x : x;
            uint64_t k = back[1] ? plot->y.count - 1 - y : y;
            uint64_t row = sphere ? sphere_nearest(plot->plan, (double)i * step - 180.0,
                                                   (double)k * step - 90.0)
                           : plot->swapped || plot->y.count == 1 ? k * plot->x.count + i
                                                                 : i * plot->y.count + k;
            uint64_t at = y * plot->x.count + x;
            values->z[at] = plot_shown(plot, plot->row[row][0]);
            if (plot->band) {
                values->low[at] = plot_shown(plot, plot->band[row][0]);
                values->high[at] = plot_shown(plot, plot->band[row][1]);
            }
        }
    }
    return LRCS_OK;
}

/* What the sweeps were made from, which the caller frees; NULL without memory. */
static char *about_text(const lrcs_host_sweep_chart *plot, uint32_t count)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        return NULL;
    }
    fprintf(out, "lrcs %s sweep", lrcs_version());
    for (uint32_t k = 0; k < count; k++) {
        fprintf(out, "; scene_hash=%016llx", (unsigned long long)plot[k].head->scene_hash);
        lrcs_host_rows_options_write(out, plot[k].head);
    }
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

int lrcs_host_sweep_chart_write(FILE *out, const lrcs_host_sweep_chart *plot, uint32_t count,
                                int png, lrcs_host_error *error)
{
    plot_drawing drawing = {.plot = plot, .count = count};
    int status = LRCS_OK;
    int alike = 1;
    for (uint32_t k = 0; k < count && status == LRCS_OK; k++) {
        status = values_fill(&plot[k], &drawing.values[k], error);
        alike &= strcmp(plot[k].title, plot->title) == 0;
    }
    snprintf(drawing.title, sizeof drawing.title, "Laser radar cross-section%s%.200s",
             alike ? " of " : "", alike ? plot->title : "");
    status = status == LRCS_OK ? plot_note(plot, count, drawing.note, error) : status;
    drawing.about = plot->head ? about_text(plot, count) : NULL;
    time_title(plot, &plot->x, drawing.x_name);
    time_title(plot, &plot->y, drawing.y_name);
    if (status == LRCS_OK) {
        status = (plot->map ? drawing_map : drawing_curves)(out, &drawing, png, error);
    }
    for (uint32_t k = 0; k < count; k++) {
        free(drawing.values[k].x);
    }
    free(drawing.about);
    return status;
}
