/* SPDX-License-Identifier: MIT */
/* The axes of a chart of a sweep: which quantity runs along which axis, whether it can be drawn,
   and the names of quantities in words. sweep_chart.c draws. */
#include "host/chart/sweep_axes.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "host/fail.h"

#define PLOT_ROWS ((uint64_t)1 << 28) /* sigma and bound of these take 4 GiB */

/* ---- words ---- */

lrcsi_axis_words lrcsi_axis_words_of(const char *name)
{
    static const char *const units[][2] = {{"_deg", "deg"},  {".A", "1/sr"},    {".B", "1/sr"},
                                           {".size_x", "m"}, {".size_y", "m"},  {".size_z", "m"},
                                           {".radius", "m"}, {".radius2", "m"}, {".length", "m"}};
    static const char *const known[][2] = {{"az_deg", "azimuth"},
                                           {"el_deg", "elevation"},
                                           {"euler_a_deg", "Euler angle a"},
                                           {"euler_b_deg", "Euler angle b"},
                                           {"euler_c_deg", "Euler angle c"},
                                           {"rotate_deg", "rotation"}};
    static const char joint[] = ".joint"; /* NAME.joint_deg */
    lrcsi_axis_words words = {.unit = NULL};
    size_t size = strlen(name);
    snprintf(words.text, sizeof words.text, "%s", name);
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        size_t end = strlen(units[i][0]);
        if (size > end && strcmp(name + size - end, units[i][0]) == 0) {
            words.unit = units[i][1];
            words.text[units[i][0][0] == '_' ? size - end : size] = '\0';
        }
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i][0]) == 0) {
            snprintf(words.text, sizeof words.text, "%s", known[i][1]);
        }
    }
    size = strlen(words.text);
    if (size > strlen(joint) && strcmp(words.text + size - strlen(joint), joint) == 0) {
        snprintf(words.text, sizeof words.text, "joint of %.*s", (int)(size - strlen(joint)), name);
    }
    return words;
}

void lrcsi_axis_value_text(const char *name, double value, char text[192])
{
    lrcsi_axis_words words = lrcsi_axis_words_of(name);
    snprintf(text, 192, "%s %.7g%s%s", words.text, value, words.unit ? " " : "",
             words.unit ? words.unit : "");
}

int lrcsi_axis_is_angle(const lrcs_host_sweep_axis *axis)
{
    const char *unit = lrcsi_axis_words_of(axis->name).unit;
    return unit && strcmp(unit, "deg") == 0;
}

/* ---- what varies ---- */

/* 1. Lists everything with more than one value: the axes, and the time of a track.
   2. Directions of the whole sphere: a map over azimuth and elevation whose step is a third of the
      distance between them.
   3. Others: curves run along the axis with more values (if equal, the faster one); a map's second
      axis is the slower one. More curves than there are colours become a map. */
uint32_t lrcs_host_sweep_chart_choose(lrcs_host_sweep_chart *plot)
{
    static const uint32_t degrees[] = {1, 2, 3, 5};
    const lrcs_host_plan *plan = plot->plan;
    lrcs_host_sweep_axis axis[LRCS_HOST_PLAN_AXES + 1];
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->axes; i++) { /* 1 */
        if (plan->axis[i].range.count > 1) {
            axis[count++] = (lrcs_host_sweep_axis){i, plan->axis[i].range.count, plan->column[i]};
        }
    }
    if (plan->kind == LRCS_HOST_PLAN_TRACK) {
        axis[count++] = (lrcs_host_sweep_axis){plan->axes, plan->track.count, "time"};
    }
    if (plan->kind == LRCS_HOST_PLAN_SPHERE) { /* 2 */
        double apart = LRCS_DEGREES_PER_RADIAN * sqrt(LRCS_FOUR_PI / (double)plan->rows);
        uint32_t i = 0;
        while (i < 3 && 3.0 * degrees[i + 1] <= apart) {
            i++;
        }
        plot->x = (lrcs_host_sweep_axis){0, 360 / degrees[i] + 1, "az_deg"};
        plot->y = (lrcs_host_sweep_axis){0, 180 / degrees[i] + 1, "el_deg"};
        plot->map = 1;
        return count;
    }
    if (count == 0) {
        return 0;
    }
    plot->x = axis[0]; /* 3 */
    plot->y = count == 2 ? axis[1] : (lrcs_host_sweep_axis){0, 1, ""};
    plot->swapped =
        count == 2 && plot->x.count <= LRCS_HOST_SWEEP_CURVES && plot->y.count >= plot->x.count;
    if (plot->swapped) {
        plot->x = axis[1];
        plot->y = axis[0];
    }
    if (plot->mollweide && count == 2 && strcmp(plot->x.name, "az_deg") != 0) {
        lrcs_host_sweep_axis el = plot->x;
        plot->x = plot->y;
        plot->y = el;
        plot->swapped = !plot->swapped;
    }
    plot->map = plot->mollweide || (plot->y.count > LRCS_HOST_SWEEP_CURVES && !plot->polar);
    return count;
}

/* 1 if azimuth spans at most a full turn and elevation at most pole to pole. */
static int mollweide_fits(const lrcs_host_plan *plan, const lrcs_host_sweep_chart *plot)
{
    static const double most[2] = {360.0, 90.0};
    for (int k = 0; k < 2 && plan->kind != LRCS_HOST_PLAN_SPHERE; k++) {
        const lrcs_host_sweep_axis *axis = k == 0 ? &plot->x : &plot->y;
        if (plan->kind != LRCS_HOST_PLAN_AZEL || axis->count < 2 || axis->column >= plan->axes ||
            strcmp(axis->name, k == 0 ? "az_deg" : "el_deg") != 0) {
            return 0;
        }
        const lrcs_host_range *range = &plan->axis[axis->column].range;
        double first = lrcs_host_range_at(range, 0);
        double last = lrcs_host_range_at(range, range->count - 1);
        if (!(k == 0 ? fabs(last - first) <= most[0]
                     : fabs(first) <= most[1] && fabs(last) <= most[1])) {
            return 0;
        }
    }
    return 1;
}

int lrcs_host_sweep_chart_check(lrcs_host_sweep_chart *plot, lrcs_host_error *error)
{
    const lrcs_host_plan *plan = plot->plan;
    uint32_t count = lrcs_host_sweep_chart_choose(plot);
    int sphere = plan->kind == LRCS_HOST_PLAN_SPHERE;
    int ascends = 1; /* the axes of a map must ascend; ranges do so, or are reversed */
    for (uint64_t i = 1; plan->kind == LRCS_HOST_PLAN_TRACK && i < plan->track.count; i++) {
        ascends &= plan->track.row[i][0] > plan->track.row[i - 1][0];
    }
    if (sphere && (count > 0 || plot->polar)) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "plot: the directions of --sphere are drawn as a map of one scene");
    }
    if (!sphere && (count < 1 || count > 2)) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "plot: expected one or two quantities that vary, found %lu",
                               (unsigned long)count);
    }
    if (plan->rows > PLOT_ROWS) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "plot: expected at most 2^28 rows, found %llu",
                               (unsigned long long)plan->rows);
    }
    if (plot->polar && plot->y.count > LRCS_HOST_SWEEP_CURVES) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "polar: expected at most %u curves, found %llu",
                               LRCS_HOST_SWEEP_CURVES, (unsigned long long)plot->y.count);
    }
    if (plot->polar && !lrcsi_axis_is_angle(&plot->x)) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "polar: the values along the curves must be angles, found '%s'",
                               plot->x.name);
    }
    if (plot->map && !ascends) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "plot: a map needs poses in the order of their times");
    }
    if (plot->mollweide && !mollweide_fits(plan, plot)) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "projection mollweide needs azimuths over at most 360 deg and "
                               "elevations within -90 .. 90 deg, or --sphere");
    }
    return LRCS_OK;
}
