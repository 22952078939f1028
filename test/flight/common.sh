# SPDX-License-Identifier: MIT
# For the tests here, which run in the root: the core joined into two files, and the library with
# what it must be linked with. Sourced with $1 the tool's path.
. "$(dirname "$0")/../cli/check.sh"
cd "$root" || exit 1

library=$(dirname "$tool")/liblrcs.a
nm "$library" 2>/dev/null | grep -q ' __asan_init' && library="$library -fsanitize=address,undefined"

# join_core FOLDER
join_core() {
    to=$1
    set --
    for layer in base mesh optics scene view visibility integrate; do
        set -- "$@" $(find src/$layer -name '*.c' | LC_ALL=C sort)
    done
    sh src/amalgamate.sh "$to" "$@"
}

# needs NAME PROGRAM...: skips the test, and ends, where one of them is not installed.
needs() {
    skipped=$1
    shift
    for program in "$@"; do
        if ! command -v "$program" >/dev/null; then
            skip "$skipped" "no $program"
            finish
            exit
        fi
    done
}
