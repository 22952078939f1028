/* SPDX-License-Identifier: MIT */
/* The first line of a sweep's file: everything that its rows depend on, and nothing that differs
   between machines, threads or shards. Files that begin alike belong together. */
#include "cli/sweep/sweep.h"

#include <string.h>

/* Adds an option; if it is repeated, its texts are joined. Returns 0 if there is no room. */
static int head_add(sweep_head *head, const char *key, const char *text)
{
    const size_t room = sizeof head->option[0].text;
    uint32_t at = 0;
    while (at < head->options && strcmp(head->option[at].key, key) != 0) {
        at++;
    }
    char *end = head->option[at].text + strlen(head->option[at].text);
    const char *between = at < head->options ? " and " : "";
    head->option[at].key = key;
    head->options += at == head->options;
    size_t left = room - (size_t)(end - head->option[at].text);
    int size = snprintf(end, left, "%s%s", between, text);
    for (; *end; end++) {
        *end = (unsigned char)*end < 0x20 || *end == 0x7f ? '?' : *end;
    }
    return size >= 0 && (size_t)size < left;
}

/* Adds the options of these names as they were given. 0 or CLI_USAGE. */
static int head_given(const cli_args *args, const char *const *name, sweep_head *head)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *given = &args->given[i];
        for (size_t k = 0; name[k]; k++) {
            if (strcmp(given->name, name[k]) == 0 &&
                !head_add(head, name[k], given->value ? given->value : "yes")) {
                return cli_usage(args->command, "--%s: too long", name[k]);
            }
        }
    }
    return 0;
}

/* Adds the options that rows depend on; the hash of the scene stands for all options of the
   scene. */
static int head_options(const cli_args *args, const sweep_plan *plan,
                        const lrcs_run_options *options, sweep_head *head)
{
    static const char *const varied[] = {"az",    "el",         "rotate",    "sphere",
                                         "joint", "vary",       "direction", "azel",
                                         "euler", "quaternion", NULL};
    char text[64];
    int code = head_given(args, varied, head);
    if (plan->kind == SWEEP_TRACK) {
        snprintf(text, sizeof text, "fnv1a:%016llx", (unsigned long long)plan->track.hash);
        head_add(head, "poses", text);
        if (plan->track.epoch[0]) {
            head_add(head, "time_from", plan->track.epoch);
        }
    }
    lrcs_host_number_text(options->tolerance, text);
    head_add(head, "tolerance", text);
    if (options->accept != LRCS_ACCEPT_BOUND) {
        head_add(head, "accept", lrcs_accept_text(options->accept));
    }
    head_add(head, "method", lrcs_method_text(options->method));
    snprintf(text, sizeof text, "%lu", (unsigned long)options->resolution);
    head_add(head, "resolution", options->resolution ? text : "auto");
    return code;
}

/* Adds the origin of the scene: its files with their hashes, by their last names, which do not
   depend on where the files are stored; and the command-line options that changed it. */
static int head_scene(const cli_args *args, const lrcs_host_scene *scene, sweep_head *head)
{
    static const char *const names[] = {"unit", "material", "two-sided", "keep-transparent", NULL};
    char text[CLI_FILE_TEXT];
    head_add(head, "normals", lrcs_normals_text(scene->scene.normals));
    head_add(head, "title", cli_base_name(cli_scene_title(args, scene)));
    if (cli_materials_open(&scene->scene)) {
        head_add(head, "materials", "illustrative or assumed");
    }
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        cli_file_text(input->path, input->hash, text);
        if (!head_add(head, "files", text)) {
            break; /* the scene's hash stands for all of them */
        }
    }
    return head_given(args, names, head);
}

int cli_head_make(const cli_args *args, const sweep_plan *plan, const lrcs_run_options *options,
                  const lrcs_host_scene *scene, sweep_head *head)
{
    memset(head, 0, sizeof *head);
    head->scene_hash = lrcs_scene_hash(&scene->scene);
    head->rows = plan->rows;
    for (uint32_t i = 0; i < plan->axes; i++) {
        if (plan->axis[i].range.count > 1) {
            head->shape[head->dimensions++] = plan->axis[i].range.count;
        }
    }
    if (plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK || head->dimensions == 0) {
        head->shape[head->dimensions++] = plan->kind == SWEEP_FIXED ? 1 : plan->poses;
    }
    if (plan->fields.materials) { /* before all texts from users: readers search for it */
        lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
        char text[64];
        snprintf(text, sizeof text, "%lu draws seed %lu", (unsigned long)how.draws,
                 (unsigned long)how.seed);
        head_add(head, SWEEP_UNCERTAINTY, text);
    }
    if (plan->fields.glint) {
        head_add(head, SWEEP_COARSE_GLINT, "estimated");
    }
    int code = head_options(args, plan, options, head);
    return code ? code : head_scene(args, scene, head);
}

size_t cli_head_about(const sweep_head *head, char *text, size_t size, size_t used)
{
    if (used < size) {
        used += (size_t)snprintf(text + used, size - used, "; scene_hash=%016llx",
                                 (unsigned long long)head->scene_hash);
    }
    for (uint32_t i = 0; i < head->options && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "; %s=%s", head->option[i].key,
                                 head->option[i].text);
    }
    return used;
}
