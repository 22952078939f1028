/* SPDX-License-Identifier: MIT */
/* What a sweep varies, as options give it: which of them exclude each other, and which rows a shard
   has; and where its rows go. The host makes the plan of them. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>
#include <string.h>

/* Only one way to specify the direction may be given; a rotation starts from a pose. */
static int ways_check(const cli_args *args)
{
    static const struct {
        const char *name;
        int way;
    } given[] = {{"az", 1},        {"el", 1},   {"rotate", 2}, {"sphere", 3},    {"poses", 4},
                 {"direction", 5}, {"azel", 6}, {"euler", 7},  {"quaternion", 8}};
    const char *first = NULL;
    int way = 0;
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        int turned = way == 2 && given[i].way >= 5; /* cli_pose_read checks this one */
        if (!cli_value(args, given[i].name) || given[i].way == way || turned) {
            continue;
        }
        if (first) {
            return cli_usage(args->command, "--%s and --%s both give the poses: give one", first,
                             given[i].name);
        }
        first = given[i].name;
        way = given[i].way;
    }
    lrcs_pose pose;
    return way == 2 ? cli_pose_read(args, &pose) : 0;
}

int cli_plan_failed(const cli_command *command, int status, const lrcs_host_error *error)
{
    if (status == LRCS_E_EMPTY) {
        return cli_usage(command,
                         "nothing varies: give --az A:B:STEP, --el, --euler, --rotate, --sphere N, "
                         "--poses FILE.csv, --joint or --vary");
    }
    if (status == LRCS_E_ARGUMENT || status == LRCS_E_LIMIT) {
        return cli_usage(command, "%s%s", status == LRCS_E_ARGUMENT ? "--" : "", error->text);
    }
    return cli_failed(error);
}

int cli_plan_read(const cli_args *args, lrcs_host_plan *plan)
{
    lrcs_host_error error;
    lrcs_host_track track;
    const char *poses = cli_value(args, "poses");
    memset(plan, 0, sizeof *plan);
    int code = ways_check(args);
    if (code != 0) {
        return code;
    }
    if (poses) {
        int status = lrcs_host_track_read(poses, &track, &error);
        cli_notices_print(stderr, &track.notices);
        if (status != LRCS_OK) {
            lrcs_host_track_free(&track);
            return cli_failed(&error);
        }
    }
    lrcs_host_plan_text *given = calloc((size_t)args->given_count + 1, sizeof *given);
    int count = 0;
    for (int i = 0; given && i < args->given_count; i++) {
        given[count++] = (lrcs_host_plan_text){args->given[i].name, args->given[i].value};
    }
    int status = given ? lrcs_host_plan_make(given, count, poses ? &track : NULL, plan, &error)
                       : LRCS_E_SYSTEM;
    if (poses && !plan->track.row) {
        lrcs_host_track_free(&track);
    }
    free(given);
    return !given              ? cli_out_of_memory()
           : status == LRCS_OK ? 0
                               : cli_plan_failed(args->command, status, &error);
}

int cli_plan_check(const cli_args *args, const lrcs_host_plan *plan, const lrcs_host_scene *base)
{
    lrcs_host_error error;
    int status = lrcs_host_plan_check(plan, base, &error);
    if (status != LRCS_OK) {
        return cli_plan_failed(args->command, status, &error);
    }
    return cli_value(args, "joint") && plan->track.joints > 0
               ? cli_usage(args->command, "--joint and the joint columns of --poses both turn "
                                          "joints: give one")
               : 0;
}

/* K/N: part K of N nearly equal parts of the rows. */
int cli_shard_read(const cli_args *args, const lrcs_host_plan *plan, uint64_t *first, uint64_t *end)
{
    const char *text = cli_value(args, "shard");
    double part[2];
    size_t size = text ? strcspn(text, "/") : 0;
    *first = 0;
    *end = plan->rows;
    if (!text) {
        return 0;
    }
    if (!text[size] || lrcs_host_number_read(text, size, &part[0]) != LRCS_OK ||
        lrcs_host_number_read(text + size + 1, strlen(text + size + 1), &part[1]) != LRCS_OK ||
        !(part[0] >= 1.0 && part[0] <= part[1] && part[1] <= 1e6) ||
        part[0] != (double)(uint32_t)part[0] || part[1] != (double)(uint32_t)part[1]) {
        return cli_expected(args, "shard", "K/N, 1 <= K <= N <= 1000000");
    }
    uint64_t shards = (uint64_t)part[1];
    uint64_t k = (uint64_t)part[0];
    uint64_t whole = plan->rows / shards;
    uint64_t rest = plan->rows % shards;
    *first = whole * (k - 1) + rest * (k - 1) / shards;
    *end = whole * k + rest * k / shards;
    return 0;
}

int cli_rows_output_read(const cli_args *args, lrcs_host_sweep_output *output)
{
    static const char *const extension[] = {".csv", ".jsonl", ".npy"}; /* by format; of a map */
    const char *path = cli_value(args, "o");
    int lines = cli_value(args, "json") != NULL;
    int format = lines ? LRCS_HOST_ROWS_JSONL : LRCS_HOST_ROWS_CSV;
    int kind = 0;
    lrcs_host_error error;
    path = path && strcmp(path, "-") == 0 ? NULL : path;
    lrcs_host_sweep_output_make(NULL, format, 0, output, NULL);
    if (!path && cli_value(args, "resume")) {
        return cli_usage(args->command, "--resume needs -o FILE: it continues that file");
    }
    if (path && lines) {
        return cli_usage(args->command, "--json is for standard output; -o FILE.jsonl writes it");
    }
    while (path && kind < 3 && !cli_extension(path, extension[kind])) {
        kind++;
    }
    if (kind == 3) {
        return cli_expected(args, "o", "FILE.csv, FILE.jsonl or FILE.npy");
    }
    return !path || lrcs_host_sweep_output_make(path, kind == 1, kind == 2, output, &error) ==
                        LRCS_OK
               ? 0
               : cli_failed(&error);
}
