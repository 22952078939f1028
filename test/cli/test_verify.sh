#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs verify: every case within its bound, and both forms say so.
. "$(dirname "$0")/check.sh"

run verify --json
same verify_exits_0 "$rc" 0
same verify_keys_in_order "$(keys)" "schema version cases count failed worst_error_over_bound "
same no_case_failed "$(value failed)" 0
same every_case_is_listed "$(printf '%s\n' "$out" | grep -c '"ok": true')" "$(value count)"
same all_shapes_are_tried "$(printf '%s\n' "$out" | sed -n 's/^    {"shape": "\([a-z]*\)".*/\1/p' | sort -u | wc -l | tr -d ' ')" 9
count=$(value count)
run verify
same table_has_a_row_for_every_case "$(printf '%s\n' "$out" | wc -l | tr -d ' ')" "$((count + 2))"
same no_row_says_fail "$(printf '%s\n' "$out" | grep -c FAIL)" 0
finish
