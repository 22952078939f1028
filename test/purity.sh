#!/bin/sh
# SPDX-License-Identifier: MIT
# Proves of the core's objects that they hold no writable data and call nothing outside but the
# functions listed here: no heap, no stdio, no locale, no errno, no threads, no setjmp; and that
# all their external names begin with lrcs_ or lrcsi_. And that the folders whose results have the same
# bits everywhere call only those functions of libm that are exact or correctly rounded.
# usage: purity.sh OBJ...
same_everywhere='
memchr memcmp memcpy memmove memset strchr strcmp strcspn strlen strncmp strspn
ceil copysign fabs floor fma fmax fmin fmod frexp ilogb ldexp llround logb lrint lround modf nearbyint
nextafter remainder remquo rint round scalbln scalbn sqrt trunc
_GLOBAL_OFFSET_TABLE_ __stack_chk_fail
'
allowed="$same_everywhere
asin atan atan2 atanh cos erfc exp expm1 hypot log log1p pow sin sincos sinh tan"
# Everything but shapes, what they and curved normals err, and closed forms.
promised='/src/(base|scene|view|visibility)/|/src/mesh/(read/|check|convex|slice|store|topology|contact/tree)|/src/optics/(brdf|reflect|shade)|/src/integrate/(cost|curve|facet_terms|image|patch_visibility|plan|sigma|tessellation|text|total|wall_error)'
# sincos: what gcc makes of sin and cos of one angle. The last two are the compiler's own.
[ $# -gt 0 ] || { echo 'purity: no objects given' >&2; exit 2; }
for tool in nm size; do
    command -v $tool >/dev/null || { echo "purity needs $tool (apt-get install binutils)" >&2; exit 1; }
done
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# Writable sections. Constant tables of pointers lie in .data.rel.ro, which is sealed once loaded.
size -A "$@" >"$work/size" || exit 1
if ! awk '
$2 == ":" { object = $1 }
$1 ~ /^\.(data|bss|tdata|tbss|sdata|sbss)/ && $1 !~ /^\.data\.rel\.ro/ && $2 + 0 > 0 {
    print object ": " $2 " writable bytes in " $1
    bad = 1
}
END { exit bad }' "$work/size" >&2; then
    nm -A "$@" | grep ' [BbDd] ' >&2
    bad=1
fi
if nm -A "$@" | grep ' C ' >&2; then
    echo 'purity: common symbols are writable' >&2
    bad=1
fi

nm --defined-only -g "$@" | awk 'NF == 3 { print $3 }' | LC_ALL=C sort -u >"$work/defined"
if grep -v '^lrcsi\{0,1\}_' "$work/defined" >&2; then
    echo 'purity: these names are seen outside and lack lrcs_ or lrcsi_' >&2
    bad=1
fi
nm -u "$@" | awk 'NF == 2 { print $2 }' | LC_ALL=C sort -u >"$work/undefined"
LC_ALL=C comm -13 "$work/defined" "$work/undefined" >"$work/used"
for symbol in $(cat "$work/used"); do
    case " $(echo $allowed) " in
    *" $symbol "*) ;;
    *)
        echo "purity: the core calls $symbol:" >&2
        nm -A -u "$@" | grep " $symbol\$" >&2
        bad=1
        ;;
    esac
done
nm -A -u "$@" | sed -n 's/:  *U / /p' | grep -E "$promised" | while read -r object symbol; do
    case " $(echo $same_everywhere) " in
    *" $symbol "*) ;;
    *) grep -qx "$symbol" "$work/used" && echo "$object: $symbol rounds as each libm likes" ;;
    esac
done >"$work/rounded"
if [ -s "$work/rounded" ]; then
    cat "$work/rounded" >&2
    bad=1
fi
echo "purity: $# objects use: $(echo $(cat "$work/used"))"
exit $bad
