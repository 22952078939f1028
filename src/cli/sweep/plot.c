/* SPDX-License-Identifier: MIT */
/* lrcs sweep --plot: the rows as curves, about a pole, or as a map. It decides which of what varies
   runs along which axis, and the words; the host draws. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PLOT_CURVES 7u   /* more values than that, both ways, make a map */
#define PLOT_MARKS  40u  /* fewer points are marked */
#define PLOT_DEEP   60.0 /* dB that a map's colours span at most */
#define PLOT_ROWS   ((uint64_t)1 << 28)

/* ---- words ---- */

/* "az_deg" in words and its unit; others as they are. */
static void axis_words(const char *name, char text[160], const char **unit)
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
    size_t size = strlen(name);
    *unit = NULL;
    snprintf(text, 160, "%s", name);
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        size_t end = strlen(units[i][0]);
        if (size > end && strcmp(name + size - end, units[i][0]) == 0) {
            *unit = units[i][1];
            text[units[i][0][0] == '_' ? size - end : size] = '\0';
        }
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i][0]) == 0) {
            snprintf(text, 160, "%s", known[i][1]);
        }
    }
}

static void axis_title(const char *name, char text[192])
{
    char words[160];
    const char *unit;
    axis_words(name, words, &unit);
    snprintf(text, 192, unit ? "%s (%s)" : "%s", words, unit);
}

static void value_text(const char *name, double value, char text[192])
{
    char words[160];
    const char *unit;
    axis_words(name, words, &unit);
    snprintf(text, 192, "%s %.7g%s%s", words, value, unit ? " " : "", unit ? unit : "");
}

static int is_angle(const plot_axis *axis)
{
    char words[160];
    const char *unit;
    axis_words(axis->name, words, &unit);
    return unit && strcmp(unit, "deg") == 0;
}

/* ---- what varies ---- */

/* Everything with more than one value: the axes, and the time of a track. */
static uint32_t varying_list(const sweep_plan *plan, plot_axis axis[SWEEP_AXES + 1])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->axes; i++) {
        if (plan->axis[i].range.count > 1) {
            axis[count++] = (plot_axis){i, plan->axis[i].range.count, plan->column[i]};
        }
    }
    if (plan->kind == SWEEP_TRACK) {
        axis[count++] = (plot_axis){plan->axes, plan->track.count, "time"};
    }
    return count;
}

/* A map's axes ascend; ranges do, or are turned round. */
static int track_ascends(const sweep_plan *plan)
{
    for (uint64_t i = 1; plan->kind == SWEEP_TRACK && i < plan->track.count; i++) {
        if (!(plan->track.row[i][0] > plan->track.row[i - 1][0])) {
            return 0;
        }
    }
    return 1;
}

/* Curves run along the one with more values, of two alike the faster; maps along the slower. */
static void plot_choose(const plot_axis *axis, uint32_t count, sweep_plot *plot)
{
    plot->x = axis[0];
    plot->y = count == 2 ? axis[1] : (plot_axis){0, 1, ""};
    plot->swapped = count == 2 && plot->x.count <= PLOT_CURVES && plot->y.count >= plot->x.count;
    if (plot->swapped) {
        plot->x = axis[1];
        plot->y = axis[0];
    }
    plot->map = plot->y.count > PLOT_CURVES && !plot->polar;
}

/* Can it be drawn about a pole, or as a map, if it is to be? */
static int kind_check(const cli_args *args, const sweep_plan *plan, const sweep_plot *plot)
{
    if (plot->polar && plot->y.count > PLOT_CURVES) {
        return cli_usage(args->command, "--polar draws at most %u curves, found %llu", PLOT_CURVES,
                         (unsigned long long)plot->y.count);
    }
    if (plot->polar && !is_angle(&plot->x)) {
        return cli_usage(args->command, "--polar: curves turn with an angle, found '%s'",
                         plot->x.name);
    }
    if (plot->map && !track_ascends(plan)) {
        return cli_usage(args->command, "--plot: a map wants poses whose time ascends");
    }
    return 0;
}

static int plot_check(const cli_args *args, const sweep_plan *plan, sweep_plot *plot)
{
    plot_axis axis[SWEEP_AXES + 1];
    uint32_t count = varying_list(plan, axis);
    if (plan->kind == SWEEP_SPHERE) {
        return cli_usage(args->command, "--plot: the directions of --sphere stand on no axis; give "
                                        "--az and --el");
    }
    if (cli_value(args, "shard")) {
        return cli_usage(args->command, "--plot draws whole sweeps: not with --shard");
    }
    if (count < 1 || count > 2) {
        return cli_usage(args->command, "--plot draws one or two things that vary, found %lu",
                         (unsigned long)count);
    }
    if (plan->rows > PLOT_ROWS) {
        return cli_usage(args->command, "--plot: at most 2^28 rows, found %llu",
                         (unsigned long long)plan->rows);
    }
    plot_choose(axis, count, plot);
    return kind_check(args, plan, plot);
}

/* ---- options ---- */

static int is_plot(const cli_given *given)
{
    return strcmp(given->name, "plot") == 0;
}

int cli_plot_read(const cli_args *args, const sweep_plan *plan, sweep_plot *plot)
{
    *plot = (sweep_plot){.dbsm = cli_value(args, "dbsm") != NULL,
                         .polar = cli_value(args, "polar") != NULL};
    for (int i = 0; i < args->given_count; i++) {
        const char *path = args->given[i].value;
        if (!is_plot(&args->given[i])) {
            continue;
        }
        if (!cli_extension(path, ".svg") && !cli_extension(path, ".png")) {
            return cli_usage(args->command, "--plot: expected FILE.svg or FILE.png, found '%s'",
                             path);
        }
        plot->asked = 1;
    }
    if (!plot->asked && (plot->dbsm || plot->polar)) {
        return cli_usage(args->command, "--%s needs --plot FILE.svg or FILE.png",
                         plot->dbsm ? "dbsm" : "polar");
    }
    return plot->asked ? plot_check(args, plan, plot) : 0;
}

/* One plot against what is read, the rows, and the plots given before it. */
static int plot_spares(const cli_args *args, int index, const sweep_file *file,
                       const lrcs_host_scene *scene)
{
    const cli_output plot = {"plot", args->given[index].value};
    const cli_output rows[2] = {{"o", file->path}, plot};
    const cli_output poses[2] = {{"poses", cli_value(args, "poses")}, plot};
    int code = cli_outputs_spare(args->command, &plot, 1, scene);
    code = code ? code : cli_outputs_apart(args->command, rows, 2);
    code = code ? code : cli_outputs_apart(args->command, poses, 2);
    for (int i = 0; i < index && code == 0; i++) {
        const cli_output pair[2] = {{"plot", args->given[i].value}, plot};
        code = is_plot(&args->given[i]) ? cli_outputs_apart(args->command, pair, 2) : 0;
    }
    return code;
}

int cli_plot_spares(const cli_args *args, const sweep_file *file, const lrcs_host_scene *scene)
{
    int code = 0;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        code = is_plot(&args->given[i]) ? plot_spares(args, i, file, scene) : 0;
    }
    return code;
}

/* ---- notes ---- */

/* Below the title: what stayed as it was, and how well sigma is known. */
static void plot_note(const cli_args *args, const sweep_plot *plot, const sweep_plan *plan,
                      char note[512])
{
    const char *accept = cli_value(args, "accept");
    char bound[CLI_BOUND_SIZE];
    double worst = 0.0;
    int dark = 0;
    int used = 0;
    note[0] = '\0';
    for (uint32_t i = 0; i < plan->axes && used < 300; i++) {
        if (plan->axis[i].range.count == 1) {
            char text[192];
            value_text(plan->column[i], cli_range_at(&plan->axis[i].range, 0), text);
            used += snprintf(note + used, 512 - (size_t)used, "%s; ", text);
        }
    }
    for (uint64_t i = 0; i < plan->rows; i++) {
        worst = fmax(worst, plot->row[i][1]);
        dark |= plot->dbsm && !(plot->row[i][0] > 0.0);
    }
    cli_bound_text(worst, 2, bound);
    snprintf(note + used, 512 - (size_t)used,
             "each sigma is proved to within %s m2 or better%s%s%s%s", bound,
             plot->open ? " for its materials, which are illustrative" : "",
             accept && strcmp(accept, "bound") != 0 ? "; accepted by " : "",
             accept && strcmp(accept, "bound") != 0 ? accept : "",
             !dark       ? ""
             : plot->map ? "; grey: sigma is 0"
                         : "; gaps: sigma is 0");
}

/* ---- data ---- */

static uint64_t plot_row(const sweep_plot *plot, uint64_t x, uint64_t y)
{
    return plot->swapped || plot->y.count == 1 ? y * plot->x.count + x : x * plot->y.count + y;
}

static double plot_sigma(const sweep_plot *plot, uint64_t x, uint64_t y)
{
    double sigma = plot->row[plot_row(plot, x, y)][0];
    return plot->dbsm ? cli_dbsm(sigma) : sigma; /* of 0: not finite, and not drawn */
}

/* The value of an axis at one of its places. */
static double axis_value(const sweep_plan *plan, const plot_axis *axis, uint64_t place)
{
    return axis->column == plan->axes ? plan->track.row[place][0]
                                      : cli_range_at(&plan->axis[axis->column].range, place);
}

/* ---- drawing ---- */

typedef struct plot_sheet {
    const sweep_plot *plot;
    const sweep_plan *plan;
    double *x, *y, *z; /* values along both axes, and sigma: z[y][x] */
    char title[256], note[512], x_name[192], y_name[192];
    int png;
} plot_sheet;

static int sheet_curves(FILE *out, const plot_sheet *sheet, lrcs_host_error *error)
{
    static const int colour[PLOT_CURVES] = {LRCS_HOST_BLUE,   LRCS_HOST_VERMILION, LRCS_HOST_GREEN,
                                            LRCS_HOST_PURPLE, LRCS_HOST_SKY_BLUE,  LRCS_HOST_ORANGE,
                                            LRCS_HOST_BLACK};
    const sweep_plot *plot = sheet->plot;
    lrcs_host_series series[PLOT_CURVES];
    char name[PLOT_CURVES][192];
    for (uint32_t i = 0; i < plot->y.count; i++) {
        value_text(plot->y.name, sheet->y[i], name[i]);
        series[i] =
            (lrcs_host_series){.name = plot->y.count > 1 ? name[i] : NULL,
                               .count = (uint32_t)plot->x.count,
                               .x = sheet->x,
                               .y = sheet->z + i * plot->x.count,
                               .colour = colour[i],
                               .marker = plot->x.count < PLOT_MARKS ? (int)(i % LRCS_HOST_NO_MARKER)
                                                                    : LRCS_HOST_NO_MARKER,
                               .dash = (int)(i % 2 ? LRCS_HOST_DASHED : LRCS_HOST_SOLID)};
    }
    const lrcs_host_chart chart = {.title = sheet->title,
                                   .note = sheet->note,
                                   .x_name = sheet->x_name,
                                   .y_name = plot->dbsm ? "sigma (dBsm)" : "sigma (m2)",
                                   .x_deg = is_angle(&plot->x),
                                   .y_from_0 = !plot->dbsm,
                                   .polar = plot->polar,
                                   .series = series,
                                   .series_count = (uint32_t)plot->y.count};
    if (sheet->png) {
        return lrcs_host_chart_png(out, &chart, error);
    }
    lrcs_host_chart_svg(out, &chart);
    return LRCS_OK;
}

static int sheet_map(FILE *out, const plot_sheet *sheet, lrcs_host_error *error)
{
    const sweep_plot *plot = sheet->plot;
    const lrcs_host_map map = {.title = sheet->title,
                               .note = sheet->note,
                               .x_name = sheet->x_name,
                               .y_name = sheet->y_name,
                               .z_name = plot->dbsm ? "sigma (dBsm)" : "sigma (m2)",
                               .columns = (uint32_t)plot->x.count,
                               .rows = (uint32_t)plot->y.count,
                               .x = sheet->x,
                               .y = sheet->y,
                               .z = sheet->z,
                               .deep = plot->dbsm ? PLOT_DEEP : 0.0,
                               .x_deg = is_angle(&plot->x),
                               .y_deg = is_angle(&plot->y)};
    if (sheet->png) {
        return lrcs_host_map_png(out, &map, error);
    }
    lrcs_host_map_svg(out, &map);
    return LRCS_OK;
}

static int sheet_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const plot_sheet *sheet = context;
    return sheet->plot->map ? sheet_map(out, sheet, error) : sheet_curves(out, sheet, error);
}

/* Values along both axes in ascending order, as a map needs them, and sigma with them: ranges that
   descend are turned round. */
static void sheet_fill(plot_sheet *sheet)
{
    const sweep_plot *plot = sheet->plot;
    const plot_axis *along[2] = {&plot->x, &plot->y};
    int back[2];
    for (int k = 0; k < 2; k++) {
        uint64_t last = along[k]->count - 1;
        double *value = k == 0 ? sheet->x : sheet->y;
        back[k] = last > 0 &&
                  axis_value(sheet->plan, along[k], last) < axis_value(sheet->plan, along[k], 0);
        for (uint64_t i = 0; i <= last; i++) {
            value[i] = last == 0 ? 0.0 : axis_value(sheet->plan, along[k], back[k] ? last - i : i);
        }
    }
    for (uint64_t y = 0; y < plot->y.count; y++) {
        for (uint64_t x = 0; x < plot->x.count; x++) {
            sheet->z[y * plot->x.count + x] = plot_sigma(plot, back[0] ? plot->x.count - 1 - x : x,
                                                         back[1] ? plot->y.count - 1 - y : y);
        }
    }
}

/* Values and words of a drawing; x is to be freed. 0 or CLI_FAILED. */
static int sheet_make(const cli_args *args, const sweep_plot *plot, const sweep_plan *plan,
                      plot_sheet *sheet)
{
    uint64_t room = plan->rows + plot->x.count + plot->y.count;
    *sheet = (plot_sheet){.plot = plot, .plan = plan, .x = malloc(room * sizeof(double))};
    if (!sheet->x) {
        cli_out_of_memory();
        return CLI_FAILED;
    }
    sheet->y = sheet->x + plot->x.count;
    sheet->z = sheet->y + plot->y.count;
    sheet_fill(sheet);
    snprintf(sheet->title, sizeof sheet->title, "Laser radar cross-section of %.200s",
             cli_base_name(args->operand));
    plot_note(args, plot, plan, sheet->note);
    axis_title(plot->x.name, sheet->x_name);
    axis_title(plot->y.name, sheet->y_name);
    return 0;
}

int cli_plot_svg(FILE *out, const cli_args *args, const sweep_plot *plot, const sweep_plan *plan)
{
    plot_sheet sheet;
    int code = sheet_make(args, plot, plan, &sheet);
    if (code == 0) {
        sheet_write(out, &sheet, NULL);
        free(sheet.x);
    }
    return code;
}

int cli_plot_write(const cli_args *args, const sweep_plot *plot, const sweep_plan *plan)
{
    plot_sheet sheet;
    int code = sheet_make(args, plot, plan, &sheet);
    if (code != 0) {
        return code;
    }
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const char *path = args->given[i].value;
        if (is_plot(&args->given[i])) {
            sheet.png = cli_extension(path, ".png");
            code = cli_output_write(path, sheet_write, &sheet);
        }
    }
    free(sheet.x);
    return code;
}
