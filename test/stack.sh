#!/bin/sh
# SPDX-License-Identifier: MIT
# How much stack the core uses: the frames of its functions and the deepest chain of calls from
# each public function, from the call graph that gcc writes (-fcallgraph-info=su). Fails on
# recursion, on a call through a pointer, and on a frame whose size is not known when compiling.
# The frames of libm and libc are not in it.
# usage: stack.sh GRAPH.ci
[ $# -ge 1 ] || { echo 'stack: the call graph of one file, please' >&2; exit 2; }
awk '
function word(text, key,   from) { # the quoted text after key:
    from = index(text, key ": \"")
    if (!from) return ""
    text = substr(text, from + length(key) + 3)
    return substr(text, 1, index(text, "\"") - 1)
}
function plain(title) { sub(/.*:/, "", title); return title }
function fail(reason) { print "stack: " reason >"/dev/stderr"; failed = 1 }

# Bytes below and with f; next_of remembers where the deepest chain goes. A function that is met
# again while it is open calls itself.
function depth(f,   i, n, callee, least, d) {
    if (state[f] == "closed") return deepest[f]
    if (state[f] == "open") { fail("recursion through " plain(f)); return 0 }
    state[f] = "open"
    n = split(calls[f], callee, "\n")
    least = 0
    for (i = 1; i < n; i++) {
        if (!(callee[i] in frame)) continue # libm, libc
        d = depth(callee[i])
        if (d > least) { least = d; next_of[f] = callee[i] }
    }
    state[f] = "closed"
    return deepest[f] = frame[f] + least
}
function chain(f,   text) {
    text = plain(f) " " frame[f]
    while (f in next_of) { f = next_of[f]; text = text ", " plain(f) " " frame[f] }
    return text
}
function largest(value, count, what,   f, best, used, i) {
    for (i = 0; i < count; i++) {
        best = ""
        for (f in value)
            if (!(f in used) && (what == "" || plain(f) ~ what) &&
                (best == "" || value[f] > value[best] || (value[f] == value[best] && f < best)))
                best = f
        if (best == "") return
        used[best] = 1
        printf "%8d  %s\n", value[best], what == "" ? plain(best) : chain(best)
    }
}

/^node:/ && !/shape : ellipse/ {
    f = word($0, "title")
    size = word($0, "label")
    kind = size
    sub(/.*\\n/, "", size)
    frame[f] = size + 0
    order[++functions] = f
    if (kind !~ /\((static|dynamic,bounded)\)$/) fail("the frame of " plain(f) " has no known size")
}
/^edge:/ {
    f = word($0, "sourcename")
    g = word($0, "targetname")
    calls[f] = calls[f] g "\n"
    if (g == "__indirect_call") fail(plain(f) " calls through a pointer")
}
END {
    if (!functions) { fail("no functions in the graph"); exit 1 }
    for (i = 1; i <= functions; i++) { d = depth(order[i]); if (d > most) most = d }
    if (failed) exit 1
    print "stack: " functions " functions, no recursion, no calls through pointers, every frame known"
    print "largest frames, bytes:"
    largest(frame, 8, "")
    print "deepest chains from public functions, bytes, with the frames of each:"
    largest(deepest, 12, "^lrcs_[a-z0-9_]*$")
    print "stack: at most " most " bytes, and what libm takes"
}' "$1"
