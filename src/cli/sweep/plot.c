/* SPDX-License-Identifier: MIT */
/* --plot of lrcs sweep and -o of lrcs plot: their options, and the files. The host draws
   (lrcs/sweep_chart.h). */
#include "cli/sweep/sweep.h"

#include <string.h>

/* The option that names the files. */
static const char *plot_option(const cli_args *args)
{
    return args->command == &cli_sweep_command ? "plot" : "o";
}

int cli_plot_read(const cli_args *args, const lrcs_host_plan *plan, lrcs_host_sweep_chart *plot)
{
    lrcs_host_error error;
    const char *option = plot_option(args);
    *plot = (lrcs_host_sweep_chart){.dbsm = cli_value(args, "dbsm") != NULL,
                                    .polar = cli_value(args, "polar") != NULL,
                                    .accept = cli_value(args, "accept"),
                                    .plan = plan};
    int code = cli_choice(args, "projection", "flat or mollweide", &plot->mollweide);
    if (code == 0 && plot->mollweide && plot->polar) {
        return cli_usage(args->command, "--polar draws curves, --projection maps: give one");
    }
    int asked = cli_value(args, option) != NULL;
    if (code == 0 && !asked && (plot->dbsm || plot->polar || plot->mollweide)) {
        return cli_usage(args->command, "--%s needs %s%s FILE.svg or FILE.png",
                         plot->dbsm    ? "dbsm"
                         : plot->polar ? "polar"
                                       : "projection",
                         cli_dashes(option), option);
    }
    if (code == 0 && asked && lrcs_host_sweep_chart_check(plot, &error) != LRCS_OK) {
        return cli_usage(args->command, "--%s", error.text);
    }
    return code == 0 && asked && cli_value(args, "shard")
               ? cli_usage(args->command, "--plot needs the whole sweep: leave out --shard")
               : code;
}

typedef struct plot_job {
    const lrcs_host_sweep_chart *plot;
    uint32_t count;
} plot_job;

static int plot_draw(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const plot_job *job = context;
    return lrcs_host_sweep_chart_write(out, job->plot, job->count, png, error);
}

int cli_plot_write(const cli_args *args, const lrcs_host_sweep_chart *plot, uint32_t count)
{
    const plot_job job = {plot, count};
    return cli_charts_write(args, plot_option(args), plot_draw, &job);
}
