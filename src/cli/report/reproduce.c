/* SPDX-License-Identifier: MIT */
/* The command lines that reproduce all of a report, quoted for a shell. */
#include "cli/report/report.h"

#include <stdlib.h>
#include <string.h>

/* Writes a word as it is, or in single quotes if a shell would split or change it. */
static void word_quote(FILE *out, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_./:,=+@%-";
    putc(' ', out);
    if (word[0] && word[strspn(word, plain)] == '\0') {
        fputs(word, out);
        return;
    }
    putc('\'', out);
    for (; *word; word++) {
        fputs(*word == '\'' ? "'\\''" : (const char[2]){*word, '\0'}, out);
    }
    putc('\'', out);
}

/* Adds those of the options in a list that were given. */
static void given_add(FILE *out, const cli_args *args, const cli_option *list)
{
    for (int i = 0; i < args->given_count; i++) {
        const cli_given *one = &args->given[i];
        const cli_option *option = list;
        while (option->name && strcmp(option->name, one->name) != 0) {
            option++;
        }
        if (option->name) {
            fprintf(out, " %s%s", cli_dashes(one->name), one->name);
            if (one->value) {
                word_quote(out, one->value);
            }
        }
    }
}

static const cli_option pose_list[] = {CLI_POSE_OPTIONS, {NULL, 0, 0}};
static const cli_option scene_list[] = {CLI_SCENE_OPTIONS, {NULL, 0, 0}};
static const cli_option accuracy_list[] = {CLI_ACCURACY_OPTIONS, {NULL, 0, 0}};
static const cli_option *const sweep_list = accuracy_list + 1; /* without the tolerance */
static const cli_option report_list[] = {{"o", 1, 0}, {"seconds", 1, 0}, {NULL, 0, 0}};

/* "lrcs COMMAND SCENE" with the options of pose, accuracy and scene that were given. */
static void line_begin(FILE *out, const report_job *job, const char *command, int pose,
                       int accuracy)
{
    fprintf(out, "lrcs %s", command);
    word_quote(out, job->args->operand);
    if (pose) {
        given_add(out, job->args, pose_list);
    }
    if (accuracy) {
        given_add(out, job->args, accuracy_list);
    }
    given_add(out, job->args, scene_list);
}

static void sweep_line(FILE *out, const report_job *job, int kind)
{
    static const char *const file[REPORT_SWEEPS] = {"xy", "xz", "yz", "map"};
    const report_sweep *sweep = &job->sweep[kind];
    fputs("lrcs sweep", out);
    word_quote(out, job->args->operand);
    fprintf(out, " --az %s --el %s --tolerance %.15g", sweep->az, sweep->el,
            job->sweep_options.tolerance);
    given_add(out, job->args, sweep_list);
    given_add(out, job->args, scene_list);
    fprintf(out, " --dbsm %s-o %s.csv --plot %s.svg", kind == REPORT_MAP ? "" : "--polar ",
            file[kind], file[kind]);
    if (kind == REPORT_MAP) {
        fprintf(out, " --brightest %u", REPORT_PEAKS);
    }
    putc('\n', out);
}

static void lines_write(FILE *out, const void *context)
{
    const report_job *job = context;
    line_begin(out, job, "report", 1, 1);
    given_add(out, job->args, report_list);
    fprintf(out, " --cut-step %lu --map-step %lu\n", (unsigned long)job->cut_step,
            (unsigned long)job->map_step);
    line_begin(out, job, "run", 1, 1);
    fputs(" --shares --facets facets.csv\n", out);
    line_begin(out, job, "image", 1, 1);
    fputs(" --by sigma -o sigma.png\n", out);
    line_begin(out, job, "image", 1, 1);
    fputs(" --by material -o material.png\n", out);
    line_begin(out, job, "info", 0, 0);
    putc('\n', out);
    for (int kind = 0; kind < REPORT_SWEEPS; kind++) {
        sweep_line(out, job, kind);
    }
    line_begin(out, job, "converge", 1, 0);
    fprintf(out, " --seconds %.3g --plot accuracy.svg\n", job->converge.all.seconds);
}

void cli_report_reproduce(FILE *out, const report_job *job)
{
    cli_page_section(out, "again", "How to reproduce it");
    fputs("<dl class=\"facts\">\n", out);
    cli_page_fact(out, "Version", "lrcs %s", lrcs_version());
    for (const lrcs_host_input *input = job->run.scene.input; input; input = input->next) {
        char text[CLI_FILE_TEXT];
        cli_file_text(input, text);
        cli_page_fact(out, "File", "%s", text);
    }
    fprintf(out,
            "<div><dt>Scene hash</dt><dd><code id=\"scene_hash\">%016llx</code></dd></div>\n"
            "</dl>\n"
            "<p>The first line reproduces this page, the others what is on it, one by "
            "one.</p>\n",
            (unsigned long long)lrcs_scene_hash(&job->run.scene.scene));
    char *lines = cli_text_of(lines_write, job);
    if (lines) {
        cli_page(out, "<pre tabindex=\"0\"><code>%s</code></pre>\n", lines);
    } else {
        cli_out_of_memory();
    }
    free(lines);
    fputs("</section>\n", out);
}
