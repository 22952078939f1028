#!/bin/sh
# SPDX-License-Identifier: MIT
# Joins the core into two files, FOLDER/lrcs.h and FOLDER/lrcs.c: the public headers, and the
# sources with their private headers, each once and after what it includes. Guards and includes
# fall away; nothing else changes, and a comment tells where each part is from.
# usage: amalgamate.sh FOLDER SOURCE...    (in the root; sources in the order of the layers)
[ $# -gt 1 ] || { echo 'amalgamate: a folder and sources, please' >&2; exit 2; }
folder=$1
shift
mkdir -p "$folder" || exit 1

# Prints the files given with what they include. Headers of the other file count as known.
join='
function expand(path, public, private,   line, name, private_path) {
    if (path in known) return
    known[path] = 1
    body[path] = ""
    while ((status = (getline line < path)) > 0) {
        if (line ~ /^#include <lrcs\//) {
            name = line; gsub(/^#include <|>.*$/, "", name)
            expand("include/" name)
        } else if (line ~ /^#include "/) {
            name = line; gsub(/^#include "|".*$/, "", name)
            expand("src/" name)
        } else if (line ~ /^#include </) {
            if (!(line in known)) system_headers = system_headers line "\n"
            known[line] = 1
        } else if (line ~ /^#endif/ && !inside[path]) { # of the guard
        } else if (line !~ /^#(ifndef|define) LRCSI?_[A-Z0-9_]+_H$/ &&
                   line !~ /^\/\* SPDX-License-Identifier/) {
            inside[path] += line ~ /^#if/
            inside[path] -= line ~ /^#endif/
            body[path] = body[path] line "\n"
        }
    }
    if (status < 0) { print "amalgamate: cannot read " path >"/dev/stderr"; failed = 1; exit 1 }
    close(path)
    if (path !~ hidden) {
        gsub(/\n\n\n+/, "\n\n", body[path])
        text = text "\n/* --- " path " --- */\n" body[path]
    }
}
BEGIN {
    for (i = 1; i < ARGC; i++) expand(ARGV[i])
    printf "%s\n%s", system_headers, text
}
END { exit failed }'

licence() {
    echo '/* SPDX-License-Identifier: MIT'
    sed 's/^\(.\)/   \1/' LICENSE
    echo '*/'
}

{
    licence
    echo '/* The core of lrcs in two files, made by make amalgamation: this is its public header. */'
    printf '#ifndef LRCS_LRCS_H\n#define LRCS_LRCS_H\n\n'
    awk -v hidden='^$' "$join" include/lrcs/lrcs.h || exit 1
    printf '\n#endif\n'
} >"$folder/lrcs.h" || exit 1

{
    licence
    echo '/* The core of lrcs in two files, made by make amalgamation: compile this one with'
    echo '   -std=c11 -ffp-contract=off, link it with -lm. */'
    echo '/* a * b + c is rounded twice, whatever the options say: exact signs depend on it. */'
    echo '#if defined(__clang__)'
    echo '#pragma STDC FP_CONTRACT OFF'
    echo '#elif defined(__GNUC__)'
    echo '#pragma GCC optimize("fp-contract=off")'
    echo '#endif'
    printf '#include "lrcs.h"\n\n'
    awk -v hidden='^include/' "$join" "$@" || exit 1
} >"$folder/lrcs.c"
