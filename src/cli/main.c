/* SPDX-License-Identifier: MIT */
/* The entry point: selects the command, and prints help for all commands. The manual page and the
   completion for bash are generated from the help texts and option lists of the commands, so that
   they always agree with the tool. */
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>

static const cli_command *const main_commands[] = {
    &cli_run_command,   &cli_image_command,   &cli_profile_command, &cli_info_command,
    &cli_scene_command, &cli_shape_command,   &cli_verify_command,  &cli_converge_command,
    &cli_sweep_command, &cli_merge_command,   &cli_plot_command,    &cli_report_command,
    &cli_fit_command,   &cli_vectors_command, &cli_compare_command};

#define MAIN_COMMANDS (sizeof main_commands / sizeof main_commands[0])

static const char main_help[] =
    "lrcs: monostatic laser radar cross-section (sigma, m2) of a facet mesh, with a proved bound.\n"
    "\n"
    "usage: lrcs COMMAND [operand] [options]\n"
    "\n"
    "  scene MODEL     writes a scene file to edit: materials, and what is assumed of them\n"
    "  run SCENE       sigma for one pose, its bound, and what was simulated\n"
    "  image SCENE     what the laser sees: pictures, vector graphics, VTK for ParaView\n"
    "  profile SCENE   sigma over range, in bins, and the response to a pulse\n"
    "  info SCENE      what a model holds: parts, materials, area, volume, defects\n"
    "  shape KIND      sigma of a simple body from its closed form\n"
    "  verify          checks the engine against closed forms on this machine\n"
    "  converge SCENE  what accuracy costs in time: every method against the truth\n"
    "  sweep SCENE     sigma over attitudes, joints, materials: tables and maps, in threads\n"
    "  merge FILE...   joins the shards of a sweep\n"
    "  plot FILE...    draws files of sweep, profile and converge again; statistics\n"
    "  report SCENE    all of this on one HTML page, with its pictures and charts\n"
    "  fit DATA.csv    fits a material's A, B, s, m to measured BRDF against angle\n"
    "  vectors DIR     writes a conformance kit for other implementations\n"
    "  compare DIR ..  judges the answers of another implementation to a kit, and explains them\n"
    "  help COMMAND    options, units and examples of one command; --man: all as a manual page;\n"
    "                  --bash: completion for bash\n"
    "\n"
    "SCENE is a .3ds, .obj or .stl model, a scene file (.toml), or 'demo', which is built in.\n"
    "Options are given as '--name value' or '--name=value'. --version prints the version.\n"
    "Exit: 0 done, 1 failed, 2 wrong usage, 3 done, but a tolerance was not met, memory was "
    "short,\n"
    "or a fit leaves parameters undetermined. On stderr 'lrcs: ...' says why a command failed or\n"
    "ended with 3, 'notice: ...' what else is worth knowing, and 'wrote FILE' what was written.\n"
    "\n"
    "examples:\n"
    "  lrcs run demo\n"
    "  lrcs run satellite.3ds --unit mm --azel 30,20 --material 'solar=solar-cell'\n"
    "  lrcs shape sphere --radius 1 --material 1,0.25,0.2,0.5\n";

/* The end of the help of every command that writes files. */
#define REPLACES "An existing output file is replaced, unless stated otherwise above.\n"

static const cli_command *command_find(const char *name)
{
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        if (strcmp(main_commands[i]->name, name) == 0) {
            return main_commands[i];
        }
    }
    return NULL;
}

static int unknown_command(const char *name)
{
    const char *best = NULL;
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        best = lrcs_host_name_nearer(name, best, main_commands[i]->name);
    }
    if (lrcs_host_name_is_near(name, best)) {
        return cli_usage(NULL, "unknown command '%s'; the nearest is %s", name, best);
    }
    char list[MAIN_COMMANDS * 12] = "";
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        lrcs_host_append(list, sizeof list, "%s%s", i > 0 ? ", " : "", main_commands[i]->name);
    }
    return cli_usage(NULL, "unknown command '%s'; expected one of %s", name, list);
}

/* 1 if an option of the command names a file to write. */
static int command_writes(const cli_command *command)
{
    int writes = 0;
    for (const cli_option *o = command->option; o->name; o++) {
        writes |= cli_is_output(command, o->name);
    }
    return writes;
}

/* Prints a command's help, and the material library if it takes a material. */
static int help_print(const cli_command *command)
{
    const lrcs_brdf_entry *entry;
    fputs(command ? command->help : main_help, stdout);
    fputs(command && command->help_more ? command->help_more : "", stdout);
    fputs(command && command_writes(command) ? "\n" REPLACES : "", stdout);
    for (const cli_option *o = command ? command->option : NULL; o && o->name; o++) {
        if (strcmp(o->name, "material") != 0) {
            continue;
        }
        printf("\nlibrary materials (A,B,s,m are ILLUSTRATIVE, not measured, except B where a "
               "source is named):\n");
        for (uint32_t i = 0; (entry = lrcs_brdf_library(i)) != NULL; i++) {
            printf("  %-20s %.5g,%.5g,%.5g,%.5g  %s\n", entry->name, entry->brdf.A, entry->brdf.B,
                   entry->brdf.s, entry->brdf.m, entry->text);
            if (entry->source) {
                printf("  %-20s B +- %.2g: solar reflectance, %s\n", "", entry->error.B,
                       entry->source);
            }
        }
    }
    return cli_finish(CLI_DONE);
}

/* ---- the manual page (man 7 macros) ---- */

/* A text, escaped so that roff reads no request and no escape in it. */
static void roff_as_is(const char *text)
{
    for (int begins = 1; *text; text++) {
        fputs(begins && (*text == '.' || *text == '\'') ? "\\&" : "", stdout);
        fputs(*text == '\\'   ? "\\e"
              : *text == '-'  ? "\\-"
              : *text == '\'' ? "\\(aq"
                              : (const char[2]){*text, '\0'},
              stdout);
        begins = *text == '\n';
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

static void manual_page(void)
{
    printf(".TH LRCS 1 \"\" \"lrcs %s\" \"User Commands\"\n.SH NAME\n", lrcs_version());
    puts("lrcs \\- monostatic laser radar cross\\-section of a facet mesh, with a proved bound");
    puts(".SH DESCRIPTION");
    puts(".nf");
    roff_as_is(main_help);
    puts(".fi\n.SH COMMANDS");
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        printf(".SS %s\n.nf\n", main_commands[i]->name);
        roff_as_is(main_commands[i]->help);
        roff_as_is(main_commands[i]->help_more ? main_commands[i]->help_more : "");
        roff_as_is(command_writes(main_commands[i]) ? "\n" REPLACES : "");
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

static void bash_completion(void)
{
    puts("# bash completion for lrcs\n"
         "_lrcs() {\n"
         "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words= "
         "values=\n"
         "    if [[ $word == = ]]; then word=; fi\n"
         "    if [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
         "    if (( COMP_CWORD == 1 )); then");
    fputs("        COMPREPLY=($(compgen -W '", stdout);
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        printf("%s ", main_commands[i]->name);
    }
    puts("help --help --version' -- \"$word\"))\n        return\n    fi\n"
         "    case ${COMP_WORDS[1]},$before in");
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        const char *name = main_commands[i]->name;
        for (const cli_option *o = main_commands[i]->option; o->name; o++) {
            if (option_words(o->name)) {
                printf("        %s,%s%s) values='%s' ;;\n", name, cli_dashes(o->name), o->name,
                       option_words(o->name));
            } else if (strcmp(o->name, "material") == 0) {
                const lrcs_brdf_entry *entry;
                printf("        %s,%s%s) values='", name, cli_dashes(o->name), o->name);
                for (uint32_t k = 0; (entry = lrcs_brdf_library(k)) != NULL; k++) {
                    printf("%s ", entry->name);
                }
                puts("' ;;");
            } else if (o->has_value) {
                printf("        %s,%s%s) values=' ' ;;\n", name, cli_dashes(o->name), o->name);
            }
        }
    }
    puts("    esac\n    case ${COMP_WORDS[1]} in");
    for (size_t i = 0; i < MAIN_COMMANDS; i++) {
        printf("        %s) words='", main_commands[i]->name);
        for (const cli_option *o = main_commands[i]->option; o->name; o++) {
            printf("%s%s ", cli_dashes(o->name), o->name);
        }
        puts("' ;;");
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

/* ---- the command line ---- */

static int is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

/* Prints help; or the manual page or the completion, as make install installs them. */
static int help_command(int count, char **word)
{
    if (count == 0 || is_help(word[0])) {
        return help_print(NULL);
    }
    if (strcmp(word[0], "--man") == 0) {
        manual_page();
    } else if (strcmp(word[0], "--bash") == 0) {
        bash_completion();
    } else if (word[0][0] == '-') {
        return cli_usage(NULL, "help: expected a command, --man or --bash, found '%s'", word[0]);
    } else {
        const cli_command *command = command_find(word[0]);
        return command ? help_print(command) : unknown_command(word[0]);
    }
    return cli_finish(CLI_DONE);
}

int main(int count, char **word)
{
    if (count < 2) {
        fputs(main_help, stderr);
        return CLI_USAGE;
    }
    if (is_help(word[1]) || strcmp(word[1], "help") == 0) {
        return help_command(count - 2, word + 2);
    }
    if (strcmp(word[1], "--version") == 0) {
        printf("lrcs %s\n", lrcs_version());
        return cli_finish(CLI_DONE);
    }
    if (word[1][0] == '-') {
        return cli_usage(NULL, "a command is expected before options, found '%s'", word[1]);
    }
    const cli_command *command = command_find(word[1]);
    if (!command) {
        return unknown_command(word[1]);
    }
    for (int i = 2; i < count; i++) {
        if (is_help(word[i])) {
            return help_print(command);
        }
    }
    cli_args args;
    int code = cli_args_read(command, count - 2, word + 2, &args);
    code = code ? code : cli_outputs_check(&args);
    if (code == 0) {
        cli_watch_begin(command->name);
        code = command->run(&args);
        cli_watch_end();
        code = cli_finish(code);
    }
    free(args.given);
    return code;
}
