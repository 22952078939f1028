#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs every test given, C programs and shell scripts, as many at a time as there are processors.
# Each prints TAP (Test Anything Protocol) and so does this: one line a program, in the order given,
# then the counts of all. Tests that lack what they need (models that are not part of the project)
# are skipped, and say why.
# usage: run.sh TOOL TEST...
tool=$1
shift
passed=0
failed=0
skipped=0
number=0
logs=$(mktemp -d) || exit 1
trap 'rm -rf "$logs"' EXIT
export CMOCKA_MESSAGE_OUTPUT=TAP
# Some launchers take longer to find Python than the tests run: find it once.
if python=$(python3 -c 'import sys; print(sys.executable)' 2>/dev/null); then
    mkdir "$logs/bin"
    printf '#!/bin/sh\nexec "%s" "$@"\n' "$python" >"$logs/bin/python3"
    chmod +x "$logs/bin/python3"
    PATH=$logs/bin:$PATH
fi
# one test: its output and its exit status, in files named after it
one='name=$2/$(echo "$3" | tr / _)
case $3 in
*.sh) sh "$3" "$1" ;;
*) "$3" ;;
esac >"$name" 2>&1
echo $? >"$name.status"'
printf '%s\n' "$@" | xargs -n 1 -P "$(getconf _NPROCESSORS_ONLN)" sh -c "$one" sh "$tool" "$logs"
echo "1..$#"
for test in "$@"; do
    number=$((number + 1))
    log=$logs/$(echo "$test" | tr / _)
    status=$(cat "$log.status")
    # cmocka 1.1.5 writes "not ok 1 # SKIP name" for a skipped test.
    skip=$(grep -cE '^(not )?ok .*# SKIP' "$log")
    good=$(grep -E '^ok ' "$log" | grep -cv '# SKIP')
    bad=$(grep -E '^not ok ' "$log" | grep -cv '# SKIP')
    planned=$(sed -n 's/^1\.\.\([0-9]*\)$/\1/p' "$log" | awk '{ sum += $1 } END { print sum + 0 }')
    if [ "$status" -eq 0 ] && [ "$bad" -eq 0 ] && [ "$planned" -gt 0 ] && [ "$planned" -eq "$((good + skip))" ]; then
        note=
        [ "$skip" -eq 0 ] || note=", $skip skipped: $(sed -nE '/^(ok .*)# SKIP /{ s/.*# SKIP //p; q; }
            /^(not ok|ok|#|1\.\.)/d; /./{ p; q; }' "$log")"
        echo "ok $number - $test ($good$note)"
    else
        [ "$bad" -gt 0 ] || bad=1
        echo "not ok $number - $test (exit $status; $planned tests planned, $good passed, $skip skipped)"
        sed 's/^/# /' "$log"
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    skipped=$((skipped + skip))
done
[ "$skipped" -eq 0 ] || echo "# $skipped skipped"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
