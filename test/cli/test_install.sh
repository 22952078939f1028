#!/bin/sh
# SPDX-License-Identifier: MIT
# make install and uninstall, and what is installed at work.
. "$(dirname "$0")/check.sh"

cd "$root" || exit 1
build=$(dirname "$tool")
build=${build#"$root"/} # by the name that it was built under, which its dependencies are kept by
# make's own variables stay out: this is a user's make, not a part of the test's.
unset MAKEFLAGS MFLAGS MAKELEVEL
to=$scratch/root
install_to() { make -s BUILD="$build" DESTDIR="$to" PREFIX=/opt/lrcs "$1" >"$scratch/log" 2>&1; }

install_to install
same make_install_works "$?: $(cat "$scratch/log")" "0: "
at=$to/opt/lrcs
same the_tool_is_installed "$("$at/bin/lrcs" --version)" "$("$tool" --version)"
same all_headers_are_installed "$(ls "$at/include/lrcs")" "$(ls include/lrcs)"

# ---- the library, as another project would take it ----
# The objects are those of this build: with sanitizers in them, only programs built likewise can load
# the library.
sanitized=$(nm -D "$at/lib/liblrcs.so" | grep -cE ' __(asan|ubsan|tsan)_')
if [ "$sanitized" -gt 0 ]; then
    skip a_program_links_by_pkg_config 'the library was built with sanitizers'
elif command -v pkg-config >/dev/null; then
    flags=$(PKG_CONFIG_PATH=$at/lib/pkgconfig pkg-config --define-variable=prefix="$at" --cflags --libs lrcs)
    # shellcheck disable=SC2086 # flags are words
    "${CC:-cc}" -o "$scratch/embed" examples/embed.c $flags -lm
    same a_program_links_by_pkg_config "$?" 0
    same it_asks_for_the_soname "$(readelf -d "$scratch/embed" | grep -c 'liblrcs\.so\.0\.2]')" 1
    same shared_and_static_say_the_same "$(LD_LIBRARY_PATH=$at/lib "$scratch/embed")" "$("$build/examples/embed")"
else
    skip a_program_links_by_pkg_config 'no pkg-config'
fi
same only_public_names_are_exported "$(nm -D --defined-only "$at/lib/liblrcs.so" | grep -cv ' lrcs_')" 0

# ---- and from Python ----
if [ "$sanitized" -gt 0 ]; then
    skip python_gets_what_the_tool_says 'the library was built with sanitizers'
elif command -v python3 >/dev/null; then
    python3 examples/oracle/oracle.py "$at/lib/liblrcs.so" demo >"$scratch/python" 2>&1
    "$tool" sweep demo --az 0:315:45 --el 0 2>/dev/null | awk -F, '$1 ~ /^[0-7]$/ {
        printf "az %3d deg  sigma %.6g m2\n", $2, $4 }' >"$scratch/tool"
    # The tool divides curved shapes as finely as each pose needs: both are within 1e-4 of the truth.
    same python_gets_what_the_tool_says "$(sed 's/  bound .*//' "$scratch/python" | paste - "$scratch/tool" |
        awk '{ printf "%s ", $2 == $8 && ($5 - $11) ^ 2 <= (2e-4 * $5) ^ 2 }')" "1 1 1 1 1 1 1 1 "
    PYTHONPATH=examples/oracle python3 - "$at/lib/liblrcs.so" >"$scratch/python" 2>&1 <<'EOF'
import ctypes
import math
import re
import sys
import oracle
for name, struct in {"lrcs_host_scene": oracle.SCENE, "lrcs_result": oracle.RESULT, "lrcs_pose": oracle.POSE,
                     "lrcs_run_options": oracle.RUN_OPTIONS, "lrcs_facet_record": oracle.RECORD,
                     "lrcs_host_options": oracle.HOST_OPTIONS, "lrcs_build_options": oracle.BUILD,
                     "lrcs_host_error": oracle.ERROR}.items():
    size = re.search(rf"^{name}: (\d+) bytes$", open("test/api/abi.txt").read(), re.M).group(1)
    assert ctypes.sizeof(struct) == int(size), name
library = oracle.Oracle(sys.argv[1])
with library.scene("demo") as scene:
    answer = scene.run((1, 2, 3), facets=True)
    assert math.isclose(sum(row[3] for row in answer.facets), answer.sigma_m2, rel_tol=1e-13)
    assert math.isclose(sum(row[2] for row in answer.facets), answer.projected_area_m2, rel_tol=1e-12)
    for wrong in ((0, 0, 0), (math.nan, 0, 0)):
        try:
            scene.run(wrong)
            print("no error for", wrong)
        except ValueError as error:
            print(error)
    assert scene.run((1, 2, 3)).sigma_m2 == answer.sigma_m2
try:
    library.scene("nothing.stl")
except ValueError as error:
    print(error)
EOF
    same python_sees_facets_and_errors "$(cat "$scratch/python")" "an argument is outside its domain
a number is not finite or outside its range
nothing.stl: cannot open: No such file or directory"
fi

# ---- the manual page and the completion ----
if command -v groff >/dev/null; then
    same the_manual_page_is_free_of_warnings "$(groff -man -Tascii -ww "$at/share/man/man1/lrcs.1" 2>&1 >/dev/null)" ""
else
    ok the_manual_page_is_free_of_warnings "# SKIP no groff"
fi
for command in $("$tool" --help | sed -n 's/^  \([a-z]*\) .*/\1/p' | grep -vx -e help -e lrcs); do
    same "the_manual_tells_of_$command" "$(grep -c "^\.SS $command\$" "$at/share/man/man1/lrcs.1")" 1
done
if command -v bash >/dev/null; then
    # complete WORDS...: what completion offers for the last of them.
    complete() {
        bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lrcs; echo "${COMPREPLY[*]}"' \
            "$at/share/bash-completion/completions/lrcs" lrcs "$@"
    }
    same completion_offers_commands "$(complete ver)" verify
    same completion_offers_options "$(complete run demo --tol)" --tolerance
    same completion_offers_values "$(complete run demo --method ex)" exact
    same completion_offers_values_after_an_equals_sign "$(complete run demo --method = fa)" facet
    same completion_offers_one_letter_options "$(complete sweep demo -o 2>&1 | tr ' ' '\n' | grep -x -e -o)" -o
    same completion_offers_files "$(complete info READM)" README.md
fi

install_to uninstall
same uninstall_leaves_no_file "$(find "$to" -type f -o -type l)" ""
usage_error help_names_what_it_writes "--man or --bash" help --roff
finish
