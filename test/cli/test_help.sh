#!/bin/sh
# SPDX-License-Identifier: MIT
# Help and version: on stdout, exit 0, and in agreement with the options of the tool.
. "$(dirname "$0")/check.sh"

run --help
same help_exits_0 "$rc" 0
whole=$out
run help
same help_is_a_command_too "$out" "$whole"
run -h
same short_help_is_the_same "$out" "$whole"
run --version
same version_is_one_line "$(printf '%s\n' "$out" | grep -cE '^lrcs [0-9]+\.[0-9]+\.[0-9]+$')" 1

for command in run image profile info shape verify converge sweep merge report fit vectors compare; do
    run "$command" --help
    text=$out
    same "help_of_${command}_exits_0" "$rc" 0
    run help "$command"
    same "help_${command}_is_the_same" "$out" "$text"
    # Every option that the help names is one that the command knows.
    unknown=
    for option in $(printf '%s\n' "$text" | sed -n 's/^  *\(--[a-z0-9-]*\).*/\1/p' | sort -u); do
        run "$command" x "$option"
        case $err in *"unknown option"*) unknown="$unknown $option" ;; esac
    done
    same "help_of_${command}_names_only_known_options" "$unknown" ""
done
run run demo --json --help
same help_wins_over_the_rest "$(printf '%s\n' "$out" | head -1 | cut -c1-15)" "usage: lrcs run"
finish
