/* SPDX-License-Identifier: MIT */
/* What the first lines of a sweep's rows state: every option that the rows depend on, and where the
   scene is from. */
#include "cli/sweep/sweep.h"

#include <string.h>

/* 1 if an option changes the scene that is read. */
static int is_of_scene(const char *name)
{
    static const cli_option option[] = {CLI_SCENE_OPTIONS};
    int found = 0;
    for (size_t i = 0; i < sizeof option / sizeof option[0]; i++) {
        found |= strcmp(option[i].name, name) == 0;
    }
    return found;
}

/* Adds the options that are `meant`, as they were given. 0 or CLI_USAGE. */
static int head_given(const cli_args *args, int (*meant)(const char *name),
                      lrcs_host_rows_head *head)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        if (meant(given->name) &&
            !lrcs_host_rows_head_add(head, given->name, given->value ? given->value : "yes")) {
            return cli_usage(args->command, "--%s: too long", given->name);
        }
    }
    return 0;
}

/* 1. The options that rows depend on; the hash of the scene stands for all options of the scene.
   2. The origin of the scene: its files with their hashes, by their last names, which do not depend
      on where the files are stored.
   3. The options that changed the scene. */
int cli_rows_head_make(const cli_args *args, const lrcs_host_plan *plan,
                       const lrcs_run_options *options, const lrcs_host_scene *scene, int coarse,
                       lrcs_host_rows_head *head)
{
    char text[CLI_FILE_TEXT];
    lrcs_host_rows_head_make(plan, lrcs_scene_hash(&scene->scene), cli_errors_stated(&scene->scene),
                             coarse, head);
    int code = head_given(args, lrcs_host_plan_takes, head); /* 1 */
    if (plan->kind == LRCS_HOST_PLAN_TRACK) {
        snprintf(text, sizeof text, "fnv1a:%016llx", (unsigned long long)plan->track.hash);
        lrcs_host_rows_head_add(head, "poses", text);
        if (plan->track.epoch[0]) {
            lrcs_host_rows_head_add(head, "time_from", plan->track.epoch);
        }
    }
    lrcs_host_number_text(options->tolerance, text);
    lrcs_host_rows_head_add(head, "tolerance", text);
    if (options->accept != LRCS_ACCEPT_BOUND) {
        lrcs_host_rows_head_add(head, "accept", lrcs_accept_text(options->accept));
    }
    lrcs_host_rows_head_add(head, "method", lrcs_method_text(options->method));
    snprintf(text, sizeof text, "%lu", (unsigned long)options->resolution);
    lrcs_host_rows_head_add(head, "resolution", options->resolution ? text : "auto");
    lrcs_host_rows_head_add(head, "normals", lrcs_normals_text(scene->scene.normals));
    lrcs_host_rows_head_add(head, "title", cli_base_name(cli_scene_title(args, scene))); /* 2 */
    if (cli_materials_assumed(&scene->scene)) {
        lrcs_host_rows_head_add(head, "materials", "illustrative or assumed");
    }
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        cli_file_text(input, text);
        if (!lrcs_host_rows_head_add(head, "files", text)) {
            break; /* the scene's hash stands for all of them */
        }
    }
    return code ? code : head_given(args, is_of_scene, head); /* 3 */
}
