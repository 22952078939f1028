# SPDX-License-Identifier: MIT
# Functions for the shell tests of the tool: they run it and compare its output.
# Sourced with $1 the tool's path; sets out (stdout), err (stderr), rc and a scratch folder.
tool=$1
case $tool in /*) ;; *) tool=$PWD/$tool ;; esac
[ -x "$tool" ] || { echo "not ok the_tool_is_there: $tool"; exit 1; }
root=$(cd "$(dirname "$0")/../.." && pwd)
models=$root/../shared/models
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/test # no traces in the tree; tap, png_file

# Results in the Test Anything Protocol. Each leaves one letter in $TAP_RESULTS, of which finish makes
# the plan: the Python in a test (test/tap.py) and subshells write there, too.
export TAP_RESULTS=$scratch/.results
: >"$TAP_RESULTS"
ok() {
    echo "ok $1"
    printf o >>"$TAP_RESULTS"
}
# not_ok NAME DETAIL
not_ok() {
    echo "not ok $1"
    printf '%s\n' "${2:-}" | sed 's/^/# /'
    printf n >>"$TAP_RESULTS"
}
# skip NAME REASON
skip() {
    echo "ok $1 # SKIP $2"
    printf s >>"$TAP_RESULTS"
}

# run ARGUMENTS...: runs the tool.
run() {
    asked="lrcs $*"
    out=$("$tool" "$@" 2>"$scratch/.err")
    rc=$?
    err=
    [ ! -s "$scratch/.err" ] || err=$(cat "$scratch/.err")
}

# FNV-1a in awk, 32 bits at a time in halves of 16, from the bytes that od prints.
fnv1a() {
    od -An -v -tu1 "$1" | awk '
        function xor(a, b,   r, p) { r = 0; for (p = 1; p < 65536; p *= 2) { if (int(a / p) % 2 != int(b / p) % 2) r += p } return r }
        BEGIN { h[3] = 52210; h[2] = 40164; h[1] = 33826; h[0] = 8997 }
        { for (i = 1; i <= NF; i++) {
            h[0] = xor(h[0], $i)
            # times 0x100000001b3: by 0x1b3, and by 2^40, which is two halves and 8 bits up
            c = h[0] * 435; n0 = c % 65536
            c = h[1] * 435 + int(c / 65536); n1 = c % 65536
            c = h[2] * 435 + h[0] * 256 + int(c / 65536); n2 = c % 65536
            c = h[3] * 435 + h[1] * 256 + int(c / 65536); n3 = c % 65536
            h[0] = n0; h[1] = n1; h[2] = n2; h[3] = n3 } }
        END { printf "fnv1a:%04x%04x%04x%04x\n", h[3], h[2], h[1], h[0] }'
}

# same NAME GOT WANT
same() {
    if [ "$2" = "$3" ]; then ok "$1"; else not_ok "$1" "got '$2', want '$3'"; fi
}

# usage_error NAME TEXT ARGUMENTS...: exit 2, nothing on stdout, TEXT in the message.
usage_error() {
    name=$1
    text=$2
    shift 2
    run "$@"
    case $err in
    *"$text"*) found=1 ;;
    *) found=0 ;;
    esac
    if [ "$rc" -eq 2 ] && [ -z "$out" ] && [ "$found" -eq 1 ]; then
        ok "$name"
    else
        not_ok "$name" "exit $rc, stdout '$out', stderr '$err', wanted '$text'"
    fi
}

# failure NAME TEXT ARGUMENTS...: exit 1, nothing on stdout, TEXT in the message.
failure() {
    name=$1
    text=$2
    shift 2
    run "$@"
    case $err in
    *"$text"*) found=1 ;;
    *) found=0 ;;
    esac
    if [ "$rc" -eq 1 ] && [ -z "$out" ] && [ "$found" -eq 1 ]; then
        ok "$name"
    else
        not_ok "$name" "exit $rc, stdout '$out', stderr '$err', wanted '$text'"
    fi
}

# near NAME GOT WANT: equal to 1e-11 of it, for values that are known to 12 digits.
near() {
    if awk -v a="$2" -v b="$3" 'BEGIN { d = a - b; exit !(a != "" && d * d <= 1e-22 * b * b) }'; then
        ok "$1"
    else
        not_ok "$1" "got '$2', want '$3'"
    fi
}

# keys: the top-level keys of the JSON in $out, in order, in one line.
keys() { printf '%s\n' "$out" | sed -n 's/^  "\([a-z0-9_]*\)":.*/\1/p' | tr '\n' ' '; }

# value KEY: the value of a top-level key of the JSON in $out. Tests use it so often that it starts no
# process.
value() {
    while IFS= read -r line; do
        case $line in
        "  \"$1\": "*)
            line=${line#"  \"$1\": "}
            printf '%s\n' "${line%,}"
            return
            ;;
        esac
    done <<END
$out
END
}

# Scenes that several tests run: one box;
box_scene() {
    cat <<'END'
[[part]]
name = "box"
shape = "box"
size = [1, 2, 3]
END
}
# two boxes, one in the other's shadow: small, and not convex;
pair_scene() {
    cat <<'END'
[[part]]
name = "near"
shape = "box"
size = [1, 2, 3]
material = "paint-white"
[[part]]
name = "far"
shape = "box"
size = [3, 1, 1]
translate = [0.3, 0.2, -4]
material = "solar-cell"
END
}
# a plate of 2 x 2 half under another, which hides the corner x > 0, y > 0 of it.
plates_scene() {
    cat <<'END'
[[part]]
name = "low"
shape = "plate"
size = [2, 2]
[[part]]
name = "high"
shape = "plate"
size = [1, 1]
translate = [0.5, 0.5, 1]
END
}

# finish: the plan; its status is that of the test. Nothing follows it but exit.
finish() {
    echo "1..$(wc -c <"$TAP_RESULTS" | tr -d ' ')"
    ! grep -q n "$TAP_RESULTS"
}
