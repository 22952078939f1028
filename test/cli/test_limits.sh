#!/bin/sh
# SPDX-License-Identifier: MIT
# Files that claim more than they hold, and little memory: refused with the place and the reason
# before room is taken for what is claimed; names of a megabyte are read.
. "$(dirname "$0")/check.sh"

zeros() { dd if=/dev/zero bs="$1" count=1 2>/dev/null; }
many() { zeros "$1" | tr '\0' "$2"; }

{ zeros 80 && printf '\377\377\377\377' && zeros 50; } >"$scratch/m.stl"
failure stl_of_4294967295_facets "byte 80: facet count: found '4294967295 with bytes for 1'" run "$scratch/m.stl"

printf '\115\115\377\377\377\377\075\075\360\377\377\377' >"$scratch/m.3ds"
failure 3ds_chunk_of_4_gigabytes "byte 8: chunk length: found '4294967280 with " run "$scratch/m.3ds"

printf 'MM\42\0\0\0==\34\0\0\0\0@\26\0\0\0a\0\0A\16\0\0\0\20A\10\0\0\0\377\377' >"$scratch/m.3ds"
failure 3ds_list_of_65535_vertices "byte 34: vertex list" run "$scratch/m.3ds"

for index in 4294967297 18446744073709551617 -4294967295; do
    printf 'v 0 0 0\nf 1 1 %s\n' "$index" >"$scratch/m.obj"
    failure "obj_index_$index" "line 2: face corner: found '$index" run "$scratch/m.obj"
done

{ printf 'schema = ' && many 1000000 '['; } >"$scratch/s.toml"
failure toml_nested_a_million_deep "line 1: array" run "$scratch/s.toml"

{ many 1000000 a && printf ' = 1\n'; } >"$scratch/s.toml"
failure toml_key_of_a_megabyte "line 1" run "$scratch/s.toml"

{ printf '[[part]]\nshape = "box"\nsize = [1, 1, 1]\nname = "' && many 1000000 n && printf '"\n'; } >"$scratch/s.toml"
run run "$scratch/s.toml" --json
same toml_name_of_a_megabyte_is_read "$rc" 0

{ printf 'o ' && many 1000000 n && printf '\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'; } >"$scratch/m.obj"
run run "$scratch/m.obj" --json
same obj_name_of_a_megabyte_is_read "$rc" 0

: >"$scratch/m.stl"
failure empty_file "there is nothing to read" run "$scratch/m.stl"
failure folder_is_no_file "cannot read" run "$scratch"

mkfifo "$scratch/pipe.obj"
failure pipe_is_no_model "pipe.obj: expected a regular file, found a device, pipe or socket" run "$scratch/pipe.obj"
failure device_is_no_model "/dev/zero: expected a regular file" info /dev/zero
printf '[[part]]\nname = "p"\nfile = "pipe.obj"\n' >"$scratch/s.toml"
failure pipe_is_no_part "pipe.obj: expected a regular file" run "$scratch/s.toml"

# Limits of address space from too small to sufficient: each run completes, is degraded, or is refused
# with a message, and never crashes. Sanitizers need all address space.
limit_memory() {
    name=$1
    shift
    worst=
    refused=0
    for kilobytes in 5000 6000 7000 8000 10000 16000 32000 64000; do
        (ulimit -v $kilobytes && exec "$tool" "$@") >"$scratch/out" 2>"$scratch/err"
        rc=$?
        case $rc in
        0 | 3) ;;
        1)
            refused=$((refused + 1))
            grep -q 'out of memory' "$scratch/err" || worst="$worst no message at $kilobytes kB"
            ;;
        *) worst="$worst exit $rc at $kilobytes kB" ;;
        esac
    done
    same "little_memory_is_said_by_$name" "$worst" ""
    same "some_memory_is_too_little_for_$name" "$((refused > 0))" 1
}
if (ulimit -v 4000000 && exec "$tool" help) >/dev/null 2>&1; then
    limit_memory run run demo
    limit_memory a_raster run demo --method zbuffer --resolution 2048
    limit_memory a_picture image demo -o "$scratch/demo.png"
    limit_memory sweep sweep demo --az 0:20:10 --el 0
    # If memory does not suffice for all threads, fewer run, and the rows are those of one thread.
    what='demo --az 0:8:2 --el 20 --method zbuffer --resolution 4096'
    # shellcheck disable=SC2086
    "$tool" sweep $what --jobs 1 >"$scratch/one.csv" 2>/dev/null
    # shellcheck disable=SC2086
    (ulimit -v 600000 && exec "$tool" sweep $what --jobs 5 >"$scratch/five.csv" 2>"$scratch/err")
    same fewer_threads_where_memory_refuses_more "$? $(cmp "$scratch/one.csv" "$scratch/five.csv" && echo same)" "0 same"
    same nothing_half_written "$(find "$scratch" -name '*.png*' | grep -v '/demo.png$')" ""
else
    skip "little_memory" "this build does not run in a limited address space"
fi
finish
