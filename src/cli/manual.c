/* SPDX-License-Identifier: MIT */
/* The manual page and the completion for bash, generated from the help texts and option lists of
   the commands, so that they always agree with the tool. */
#include "cli/cli.h"

#include <string.h>

/* ---- the manual page (man 7 macros) ---- */

/* One line of text, escaped so that roff reads no request and no escape in it. */
static const char *roff_line(const char *text)
{
    if (*text == '.' || *text == '\'') {
        fputs("\\&", stdout);
    }
    for (; *text && *text != '\n'; text++) {
        if (*text == '\\') {
            fputs("\\e", stdout);
        } else if (*text == '-') {
            fputs("\\-", stdout);
        } else if (*text == '\'') {
            fputs("\\(aq", stdout);
        } else {
            putchar(*text);
        }
    }
    putchar('\n');
    return *text ? text + 1 : text;
}

static void roff_as_is(const char *text)
{
    while (*text) {
        text = roff_line(text);
    }
}

static const char roff_end[] =
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\ndone\n"
    ".TP\n.B 1\nfailed\n"
    ".TP\n.B 2\nusage: the command line is not one that the tool knows\n"
    ".TP\n.B 3\ndone, but the tolerance was not met, memory forced a coarser answer,\n"
    "or readings leave a parameter open\n"
    ".SH SOURCE\n"
    "Eq. 2 and the four\\-parameter BRDF: Han et al. (2014). Bounds are proved for the mesh and "
    "the\n"
    "BRDF as given; that a paint follows that BRDF is outside every bound.\n";

void cli_manual_page(const cli_command *const *command, size_t count, const char *overview)
{
    printf(".TH LRCS 1 \"\" \"lrcs %s\" \"User Commands\"\n.SH NAME\n", lrcs_version());
    puts("lrcs \\- monostatic laser radar cross\\-section of a facet mesh, with a proved bound");
    puts(".SH DESCRIPTION");
    puts(".nf");
    roff_as_is(overview);
    puts(".fi\n.SH COMMANDS");
    for (size_t i = 0; i < count; i++) {
        printf(".SS %s\n.nf\n", command[i]->name);
        roff_as_is(command[i]->help);
        roff_as_is(command[i]->help_more ? command[i]->help_more : "");
        puts(".fi");
    }
    fputs(roff_end, stdout);
}

/* ---- completion ---- */

/* The values of options that take one of a few words. */
static const char *option_words(const char *name)
{
    return strcmp(name, "method") == 0    ? "auto facet zbuffer exact"
           : strcmp(name, "accept") == 0  ? "bound estimate any"
           : strcmp(name, "normals") == 0 ? "flat auto smooth"
           : strcmp(name, "unit") == 0    ? "mm cm m in ft"
           : strcmp(name, "noise") == 0   ? "auto absolute relative"
                                          : NULL;
}

static void completion_command(const cli_command *command)
{
    printf("        %s) words='", command->name);
    for (const cli_option *o = command->option; o->name; o++) {
        printf("%s%s ", cli_dashes(o->name), o->name);
    }
    puts("' ;;");
}

static void completion_values(const cli_command *command)
{
    for (const cli_option *o = command->option; o->name; o++) {
        if (option_words(o->name)) {
            printf("        %s,%s%s) values='%s' ;;\n", command->name, cli_dashes(o->name), o->name,
                   option_words(o->name));
        } else if (strcmp(o->name, "material") == 0) {
            const lrcs_brdf_entry *entry;
            printf("        %s,%s%s) values='", command->name, cli_dashes(o->name), o->name);
            for (uint32_t i = 0; (entry = lrcs_brdf_library(i)) != NULL; i++) {
                printf("%s ", entry->name);
            }
            puts("' ;;");
        } else if (o->has_value) {
            printf("        %s,%s%s) values=' ' ;;\n", command->name, cli_dashes(o->name), o->name);
        }
    }
}

void cli_manual_completion(const cli_command *const *command, size_t count)
{
    puts("# bash completion for lrcs\n"
         "_lrcs() {\n"
         "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words= "
         "values=\n"
         "    if [[ $word == = ]]; then word=; fi\n"
         "    if [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
         "    if (( COMP_CWORD == 1 )); then");
    fputs("        COMPREPLY=($(compgen -W '", stdout);
    for (size_t i = 0; i < count; i++) {
        printf("%s ", command[i]->name);
    }
    puts("help --help --version' -- \"$word\"))\n        return\n    fi\n"
         "    case ${COMP_WORDS[1]},$before in");
    for (size_t i = 0; i < count; i++) {
        completion_values(command[i]);
    }
    puts("    esac\n    case ${COMP_WORDS[1]} in");
    for (size_t i = 0; i < count; i++) {
        completion_command(command[i]);
    }
    puts("    esac\n"
         "    if [[ $word == -* && -z $values ]]; then\n"
         "        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "    elif [[ -n ${values// } ]]; then\n"
         "        COMPREPLY=($(compgen -W \"$values\" -- \"$word\"))\n"
         "    else\n"
         "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "    fi\n"
         "}\n"
         "complete -o filenames -F _lrcs lrcs");
}
