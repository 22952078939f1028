#!/bin/sh
# SPDX-License-Identifier: MIT
# What other programs are built against: the names, numbers and layouts of the public headers, and
# what their comments promise. abi.txt is a record, not a reference: it shows that something changed.
. "$(dirname "$0")/../cli/check.sh"

cd "$root" || exit 1
build=$(dirname "$tool")

text=$(sed -n 's/.*LRCS_VERSION_TEXT *"\(.*\)"/\1/p' include/lrcs/status.h)
numbers=$(sed -n 's/.*LRCS_VERSION_\(MAJOR\|MINOR\|PATCH\) *\([0-9]*\)$/\2/p' include/lrcs/status.h | paste -sd.)
same version_text_and_numbers_agree "$text" "$numbers"
same the_tool_says_the_same_version "$("$tool" --version)" "lrcs $text"
same the_changelog_begins_with_this_version "$(sed -n 's/^## \[\([0-9.]*\)\].*/\1/p' CHANGELOG.md | sed -n 1p)" "$text"

if ! command -v python3 >/dev/null; then
    skip the_public_surface 'no python3'
    finish
    exit
fi
said=$(python3 test/api/contract.py 2>&1)
same comments_name_every_status_and_no_other "$?: $said" "0: "

# A removed or changed line breaks programs that use it, and needs a new minor version while the
# major one is 0, later a new major one. An added line breaks none.
python3 test/api/abi.py "${CC:-cc}" >"$scratch/abi"
same the_surface_can_be_read "$?" 0
if cmp -s "$scratch/abi" test/api/abi.txt; then
    ok the_public_surface_is_the_one_on_record
else
    not_ok the_public_surface_is_the_one_on_record \
        "meant? then: python3 test/api/abi.py cc >test/api/abi.txt; $(diff test/api/abi.txt "$scratch/abi" | sed -n 1,20p)"
fi
nm -g --defined-only "$build/liblrcs.a" | sed -n 's/.* [TR] \(lrcs_.*\)/\1/p' | LC_ALL=C sort -u >"$scratch/defined"
sed -n 's/^[a-z].*[ *]\(lrcs_[a-z0-9_]*\)(.*;$/\1/p' "$scratch/abi" | LC_ALL=C sort -u >"$scratch/declared"
same every_public_name_is_declared_and_defined "$(diff "$scratch/declared" "$scratch/defined")" ""
same and_they_are_many "$([ "$(wc -l <"$scratch/declared")" -gt 90 ] && echo yes)" yes
finish
