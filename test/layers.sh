#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks the order of the layers: a file includes its own layer or earlier ones, the tool only the
# public headers, the core no system header that needs an operating system. Also: every header
# compiles alone, no includes are cyclic, src/README.md names every file and, in its trace of one
# facet, only what exists and calls that are made. Prints FILE:LINE and the reason for each violation.
# usage: layers.sh    (in the root; CC names the compiler)
core='base mesh optics scene view visibility integrate'
layers="$core analysis host cli"
# Public headers above the core: of analysis, and of the host layer.
analysis_headers="distribution|emulate|fit|quadric|sequence"
host_headers="chart|conformance|convergence|explain|file|glint|host|inventory|kit|load|picture|plan|readings|rows|shares|sweep|sweep_chart|sweep_file|table|track|write"
core_headers='float.h limits.h math.h stddef.h stdint.h string.h'
public_headers='stddef.h stdint.h'
CC=${CC:-cc}
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT

for folder in src/*/; do
    name=$(basename "$folder")
    case " $layers " in
    *" $name "*) ;;
    *) echo "src/$name: not a layer ($layers)" >>"$log" ;;
    esac
done

files=$(find src include -name '*.[ch]' | LC_ALL=C sort)
awk -v layers="$layers" -v core="$core" -v core_headers="$core_headers" \
    -v public_headers="$public_headers" -v analysis_headers="$analysis_headers" \
    -v host_headers="$host_headers" '
function has(list, word) { return index(" " list " ", " " word " ") > 0 }
function exists(path,   line, status) {
    status = (getline line < path)
    close(path)
    return status >= 0
}
function breach(reason) { print FILENAME ":" FNR ": " reason }
BEGIN { count = split(layers, name, " "); for (i = 1; i <= count; i++) rank[name[i]] = i }
FNR == 1 {
    public = FILENAME ~ /^include\//
    host = FILENAME ~ ("^include/lrcs/(" host_headers ")[.]h$")
    split(FILENAME, part, "/")
    layer = part[2]
    in_core = !public && has(core, layer)
}
/^[ \t]*#[ \t]*include/ {
    target = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", target)
    quote = substr(target, 1, 1)
    sub(/[ \t]*(\/[\/*].*)?$/, "", target)
    path = substr(target, 2, length(target) - 2)
    if (quote == "<" && path ~ /^lrcs\//) {
        if (!exists("include/" path)) breach("no such public header: " path)
        if (path ~ ("^lrcs/(" analysis_headers "|" host_headers ")[.]h$") && (in_core || (public && !host)))
            breach("it is above the core: <" path ">")
    } else if (quote == "<") {
        if (public && !has(public_headers, path) && !(host && path ~ /^(stdio|signal)\.h$/))
            breach("a public header includes <" path ">; it may: " public_headers)
        if (in_core && !has(core_headers, path))
            breach("the core includes <" path ">; it may: " core_headers)
    } else if (quote != "\"") {
        breach("an include that is neither <...> nor \"...\"")
    } else if (public) {
        breach("a public header includes the private \"" path "\"")
    } else {
        if (path !~ /\//) path = part[1] "/" part[2] "/" path # beside it
        sub(/^src\//, "", path)
        split(path, folder, "/")
        if (!exists("src/" path) && path !~ /\.inc$/) # .inc: a generated table
            breach("no such file under src/: \"" path "\"")
        else if (!(folder[1] in rank) || rank[folder[1]] > rank[layer])
            breach("layer " layer " includes the later layer " folder[1] ": \"" path "\"")
        else if (layer == "cli" && folder[1] != "cli")
            breach("the tool sits on the public headers alone, but includes \"" path "\"")
    }
}
in_core && /\([ \t]*\*[ \t]*(const[ \t]+)?[a-z_0-9]*[ \t]*(\[[^]]*\])?\)[ \t]*\(/ {
    breach("a function pointer in the core")
}' $files >>"$log" || exit 1

# Prints pairs of modules, a header with its source each, of which the first includes the second;
# with `folders` 1 pairs of their folders, of layers that have some.
includes() {
    awk -v folders="$1" '
    function folder_of(path) { sub(/\/[^\/]*$/, "", path); return path }
    FNR == 1 {
        file = FILENAME
        sub(/^src\//, "", file)
        sub(/\.[ch]$/, "", file)
    }
    /^[ \t]*#[ \t]*include[ \t]*"[^"]*\.h"/ {
        split($0, part, "\"")
        to = part[2]
        sub(/\.h$/, "", to)
        if (to !~ /\//) to = folder_of(file) "/" to
        if (folders && folder_of(to) != folder_of(file)) print folder_of(file), folder_of(to)
        if (!folders && to != file) print file, to
    }' $(echo "$files" | grep '^src/')
}

# No two modules include each other, directly or by way of others, and no two folders.
for folders in 0 1; do
    if ! includes $folders | tsort >/dev/null 2>"$log.cycle"; then
        sed 's/^tsort: /cyclic include: /; /loop:$/d' "$log.cycle" >>"$log"
    fi
done
rm -f "$log.cycle"

# One name, one thing, in the whole library: its files can be joined into one.
awk '
function claim(kind, word) {
    if ((kind, word) in owner)
        print FILENAME ":" FNR ": " kind " " word " is also in " owner[kind, word]
    else
        owner[kind, word] = FILENAME
}
/^static / && /[a-z_0-9]\(/ && !/;[ \t]*$/ {
    word = $0
    sub(/\(.*/, "", word)
    sub(/.*[ *]/, "", word)
    claim("name", word)
}
/^static / && /(=|\[)/ && !/\(/ {
    word = $0
    sub(/[ \t]*[[=].*/, "", word)
    sub(/.*[ *]/, "", word)
    claim("name", word)
}
/^} [a-z_0-9]+;/ { word = $2; sub(/;.*/, "", word); claim("name", word) }
/^#define / { # the same text twice is legal, and no harm
    word = $2
    $1 = $2 = ""
    if (!(word in body) || body[word] != $0) claim("macro", word)
    body[word] = $0
}
' $(echo "$files" | grep -v '^src/cli/') >>"$log" || exit 1

for header in $(find include src -name '*.h' | LC_ALL=C sort); do
    name=${header#*/}
    case $header in
    src/host/* | src/cli/*) posix=-D_POSIX_C_SOURCE=200809L ;;
    src/*) posix= ;;
    *) posix= ;;
    esac
    private=-Isrc
    case $header in include/*) private= ;; esac
    # twice: its guard works too
    if ! printf '#include "%s"\n#include "%s"\ntypedef int not_empty;\n' "$name" "$name" |
        $CC -std=c11 -pedantic -Wall -Wextra -Werror $posix -Iinclude $private \
            -fsyntax-only -x c - 2>>"$log"; then
        echo "$header: does not compile alone" >>"$log"
    fi
done

# The umbrella holds the core; fits, emulation, files and threads are included by name.
for header in include/lrcs/*.h; do
    base=$(basename "$header")
    echo "$base" | grep -qE "^(lrcs|$analysis_headers|$host_headers)\.h\$" && continue
    grep -q "^#include <lrcs/$base>" include/lrcs/lrcs.h ||
        echo "include/lrcs/lrcs.h: does not include <lrcs/$base>" >>"$log"
done

# src/README.md names every source file, by itself or by a pattern (`toml*`).
patterns=$(grep -oE '`[a-z0-9_]+\*`' src/README.md | tr -d '`*')
for file in src/*/*.c src/*/*/*.c; do
    stem=$(basename "$file" .c)
    grep -q "\`$stem\`" src/README.md && continue
    for pattern in $patterns; do
        case $stem in "$pattern"*) continue 2 ;; esac
    done
    echo "src/README.md: does not name $file" >>"$log"
done

# Its trace of one facet names functions and files that exist.
for name in $(sed -n '/^## One facet/,$p' src/README.md | grep -oE '`[a-z0-9_]+`' | tr -d '`' |
    LC_ALL=C sort -u); do
    grep -qE "^[a-z].*[ *]$name\\(" $files || [ -d "src/$name" ] || [ -n "$(find src -name "$name.c")" ] ||
        echo "src/README.md: the trace of one facet names $name, which does not exist" >>"$log"
done

# Where it says that one function calls another, `A` → `B`, the body of A names B.
awk '
FNR == 1 { file++ }
file == 1 && /^## One facet/ { trace = 1 }
file == 1 { if (trace) text = text " " $0; next }
/^[a-z].*[a-z0-9_]+\(/ && !/;[ \t]*$/ { # a definition begins in the first column
    name = $0
    sub(/\(.*/, "", name)
    sub(/.*[ *]/, "", name)
}
{ body[name] = body[name] " " $0 }
/^}/ { name = "" }
END {
    gsub(/\([a-z0-9_\/]*`[a-z0-9_\/]+`\)/, "", text) # the file of a function
    count = split(text, piece, "→")
    for (i = 1; i < count; i++) {
        n = split(piece[i], part, "`")
        from = part[n - 1]
        split(piece[i + 1], part, "`")
        to = part[2]
        if (body[from] !~ ("[^a-z0-9_]" to "[^a-z0-9_]"))
            print "src/README.md: the trace says that " from " calls " to
    }
}' src/README.md $(echo "$files" | grep '^src/') >>"$log" || exit 1

if [ -s "$log" ]; then
    cat "$log" >&2
    exit 1
fi
echo "layers: $(echo "$files" | wc -l) files keep the order ($layers)"
