/* SPDX-License-Identifier: MIT */
/* The summary at the top of the page: the verdict of lrcs run, in its words. This file decides how
   those lines become markup, not their text. */
#include "cli/report/report.h"

#include <string.h>

#define SUMMARY_INDENT 13u /* column of the text of a line, after its name */

int cli_report_summary_make(report_job *job)
{
    int code = cli_run_caveats(&job->run);
    FILE *out = code == 0 ? cli_report_bytes_begin(&job->summary) : NULL;
    if (!out) {
        return code ? code : CLI_FAILED;
    }
    cli_run_verdict(&job->run, out);
    return cli_report_bytes_end(out);
}

/* Lines are "name       text"; a line without a name continues the previous one. The first is a
   paragraph, the others are a list. */
void cli_report_summary(FILE *out, const report_job *job)
{
    char *text = job->summary.bytes;
    int items = 0;
    while (text && *text) {
        size_t size = strcspn(text, "\n");
        char *next = text[size] ? text + size + 1 : text + size;
        text[size] = '\0';
        size_t blank = strspn(text, " ");
        const char *words = size > SUMMARY_INDENT ? text + SUMMARY_INDENT : text + blank;
        if (blank >= SUMMARY_INDENT || size <= SUMMARY_INDENT) {
            putc(' ', out);
        } else if (blank == 0) {
            fputs("<p class=\"verdict\"><b>Verdict:</b> ", out);
        } else {
            char name[SUMMARY_INDENT + 1] = "";
            size_t used = SUMMARY_INDENT;
            memcpy(name, text, SUMMARY_INDENT);
            while (used > 0 && name[used - 1] == ' ') {
                name[--used] = '\0';
            }
            fputs(items++ == 0 ? "</p>\n<ul class=\"notices\">\n" : "</li>\n", out);
            cli_page(out, "<li><b>%s</b>: ", name + blank);
        }
        cli_page(out, "%s", words);
        text = next;
    }
    fputs(items > 0 ? "</li>\n</ul>\n" : job->summary.bytes ? "</p>\n" : "", out);
}
