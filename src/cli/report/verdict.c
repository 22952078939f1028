/* SPDX-License-Identifier: MIT */
/* The text beside sigma at the top of the page: the verdict of lrcs run, in its words. This file
   decides how those lines become markup, not their text. */
#include "cli/report/report.h"
#include "cli/run/run.h"

#include <stdlib.h>
#include <string.h>

#define VERDICT_INDENT 13u /* column of the text of a line, after its name */

int cli_report_verdict_make(report_job *job)
{
    run_job *run = calloc(1, sizeof *run);
    if (!run) {
        return cli_out_of_memory();
    }
    run->args = job->args;
    run->pose = job->pose;
    run->options = job->options;
    run->load = job->load;
    run->scene = job->scene;
    run->result = job->result;
    run->records = job->records;
    run->sampling = lrcs_uncertainty_options_default();
    int code = cli_run_materials(run);
    code = code ? code : cli_run_open(run);
    FILE *out = code == 0 ? cli_report_bytes_begin(&job->verdict) : NULL;
    if (out) {
        cli_run_verdict(run, out);
        code = cli_report_bytes_end(out);
    } else if (code == 0) {
        code = CLI_FAILED;
    }
    job->uncertainty = run->uncertainty;
    free(run->sensitivity);
    free(run);
    return code;
}

/* Lines are "name       text"; a line without a name continues the previous one. The first is a
   paragraph, the others are a list. */
void cli_report_verdict(FILE *out, const report_job *job)
{
    char *text = job->verdict.bytes;
    int items = 0;
    while (text && *text) {
        size_t size = strcspn(text, "\n");
        char *next = text[size] ? text + size + 1 : text + size;
        text[size] = '\0';
        size_t blank = strspn(text, " ");
        const char *words = size > VERDICT_INDENT ? text + VERDICT_INDENT : text + blank;
        if (blank >= VERDICT_INDENT || size <= VERDICT_INDENT) {
            putc(' ', out);
        } else if (blank == 0) {
            fputs("<p class=\"verdict\"><b>Verdict:</b> ", out);
        } else {
            char name[VERDICT_INDENT + 1] = "";
            size_t used = VERDICT_INDENT;
            memcpy(name, text, VERDICT_INDENT);
            while (used > 0 && name[used - 1] == ' ') {
                name[--used] = '\0';
            }
            fputs(items++ == 0 ? "</p>\n<ul class=\"notices\">\n" : "</li>\n", out);
            cli_page(out, "<li><b>%s</b>: ", name + blank);
        }
        cli_page(out, "%s", words);
        text = next;
    }
    fputs(items > 0 ? "</li>\n</ul>\n" : job->verdict.bytes ? "</p>\n" : "", out);
}
