/* SPDX-License-Identifier: MIT */
/* Parses the command line into options and prints a message if it is invalid. This file decides the
   syntax, not what an option means. */
#include "cli/cli.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Of an unknown option, so much is compared with the known ones. */
#define NAME_MOST 64u

__attribute__((format(printf, 1, 0))) static void message_print(const char *format, va_list list)
{
    cli_watch_end();
    fputs("lrcs: ", stderr);
    vfprintf(stderr, format, list);
    fputc('\n', stderr);
}

int cli_usage(const cli_command *command, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    message_print(format, list);
    va_end(list);
    fprintf(stderr, "Try 'lrcs%s%s --help'.\n", command ? " " : "", command ? command->name : "");
    return CLI_USAGE;
}

int cli_fail(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    message_print(format, list);
    va_end(list);
    return CLI_FAILED;
}

int cli_degraded(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    message_print(format, list);
    va_end(list);
    return CLI_DEGRADED;
}

int cli_failed(const lrcs_host_error *error)
{
    return cli_fail("%s", error->text);
}

int cli_out_of_memory(void)
{
    return cli_fail("out of memory");
}

int cli_expected(const cli_args *args, const char *name, const char *what)
{
    return cli_usage(args->command, "%s%s: expected %s, found '%s'", cli_dashes(name), name, what,
                     cli_value(args, name));
}

int cli_finish(int code)
{
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        return cli_fail("standard output: cannot write: %s",
                        errno ? strerror(errno) : "an earlier write failed");
    }
    return code;
}

const char *cli_dashes(const char *name)
{
    return name[1] ? "--" : "-";
}

static int unknown_option(const cli_command *command, const char *word, size_t size)
{
    char name[NAME_MOST];
    size_t dashes = strspn(word, "-");
    const char *best = NULL;
    snprintf(name, sizeof name, "%.*s", (int)(size > dashes ? size - dashes : 0), word + dashes);
    for (const cli_option *option = command->option; option->name; option++) {
        best = lrcs_host_name_nearer(name, best, option->name);
    }
    if (!best || !lrcs_host_name_is_near(name, best)) {
        return cli_usage(command, "unknown option '%.*s'", (int)size, word);
    }
    return cli_usage(command, "unknown option '%.*s'; the nearest is %s%s", (int)size, word,
                     cli_dashes(best), best);
}

/* Reads the option at word[i]; advances *i if its value is a separate word. A value may begin with
   a minus sign unless it looks like an option. */
static int option_read(cli_args *args, int count, char **word, int *i)
{
    const cli_command *command = args->command;
    const char *at = word[*i];
    const char *equals = strchr(at, '=');
    size_t size = equals ? (size_t)(equals - at) : strlen(at);
    size_t dashes = strncmp(at, "--", 2) == 0 ? 2 : 1;
    const cli_option *option = command->option;
    while (option->name && (strlen(option->name) != size - dashes ||
                            strncmp(option->name, at + dashes, size - dashes) != 0)) {
        option++;
    }
    if (!option->name || (size == 2) != (dashes == 1)) {
        return unknown_option(command, at, size);
    }
    if (!option->repeats && cli_value(args, option->name)) {
        return cli_usage(command, "%s%s is given twice", cli_dashes(option->name), option->name);
    }
    const char *value = NULL;
    if (!option->has_value && equals) {
        return cli_usage(command, "%s%s takes no value, found '%s'", cli_dashes(option->name),
                         option->name, equals + 1);
    }
    if (option->has_value && equals) {
        value = equals + 1;
    } else if (option->has_value) {
        if (*i + 1 >= count || strncmp(word[*i + 1], "--", 2) == 0) {
            return cli_usage(command, "%s%s needs a value", cli_dashes(option->name), option->name);
        }
        value = word[++*i];
    }
    if (value && !*value) {
        return cli_usage(command, "%s%s needs a value, found an empty one",
                         cli_dashes(option->name), option->name);
    }
    args->given[args->given_count++] = (cli_given){option->name, value};
    return 0;
}

int cli_args_read(const cli_command *command, int count, char **word, cli_args *args)
{
    *args = (cli_args){command, NULL, calloc((size_t)count + 1, sizeof *args->given), 0};
    if (!args->given) {
        return cli_out_of_memory();
    }
    for (int i = 0; i < count; i++) {
        if (word[i][0] == '-' && word[i][1] != '\0') {
            int code = option_read(args, count, word, &i);
            if (code != 0) {
                return code;
            }
        } else if (!command->operand) {
            return cli_usage(command, "%s takes no operand, found '%s'", command->name, word[i]);
        } else if (strstr(command->operand, "...")) {
            args->operand = word[i];
            args->given[args->given_count++] = (cli_given){"", word[i]};
        } else if (args->operand) {
            return cli_usage(command, "one %s is expected, found '%s' and '%s'", command->operand,
                             args->operand, word[i]);
        } else {
            args->operand = word[i];
        }
    }
    if (command->operand && !args->operand) {
        return cli_usage(command, "%s is missing: %s", command->operand, command->operand_hint);
    }
    return 0;
}

const char *cli_value(const cli_args *args, const char *name)
{
    for (int i = 0; i < args->given_count; i++) {
        if (strcmp(args->given[i].name, name) == 0) {
            return args->given[i].value ? args->given[i].value : "";
        }
    }
    return NULL;
}

int cli_number(const cli_args *args, const char *name, double *value)
{
    const char *text = cli_value(args, name);
    return text && lrcs_host_number_read(text, strlen(text), value) != LRCS_OK
               ? cli_expected(args, name, "a finite number")
               : 0;
}

int cli_positive(const cli_args *args, const char *name, const char *what, double *value)
{
    const char *text = cli_value(args, name);
    int wrong =
        text && (lrcs_host_number_read(text, strlen(text), value) != LRCS_OK || !(*value > 0.0));
    return wrong ? cli_expected(args, name, what) : 0;
}

int cli_whole(const cli_args *args, const char *name, double least, double most, uint32_t *value)
{
    const char *text = cli_value(args, name);
    double number = 0.0;
    if (!text) {
        return 0;
    }
    if (lrcs_host_number_read(text, strlen(text), &number) != LRCS_OK ||
        !(number >= least && number <= most) || number != floor(number)) {
        char what[80];
        snprintf(what, sizeof what, "a whole number %.0f .. %.0f", least, most);
        return cli_expected(args, name, what);
    }
    *value = (uint32_t)number;
    return 0;
}

int cli_choice(const cli_args *args, const char *name, const char *words, int *place)
{
    const char *text = cli_value(args, name);
    const char *at = words;
    for (int i = 0; text && *at; i++) {
        size_t size = strcspn(at, ", ");
        if (strlen(text) == size && strncmp(at, text, size) == 0) {
            *place = i;
            return 0;
        }
        at += size + strspn(at + size, ", ");
        at += strncmp(at, "or ", 3) == 0 ? 3 : 0;
    }
    return text ? cli_expected(args, name, words) : 0;
}
