#!/bin/sh
# SPDX-License-Identifier: MIT
# A run of more than two seconds shows at a terminal which stage it is in, and a Ctrl-C says what is
# kept. Elsewhere it is silent.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
command -v python3 >/dev/null || { skip a_stage_is_shown 'no python3'; finish; exit; }
# Balls in the shadow of a plate, divided very finely: seconds on any machine.
{
    for i in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23; do
        printf '[[part]]\nname = "ball %s"\nshape = "sphere"\nradius = 1\ntranslate = [%s, 0, 0]\n' $i $((3 * i))
    done
    printf '[[part]]\nname = "plate"\nshape = "plate"\nsize = [80, 1]\ntranslate = [30.3, 0.2, 3]\n'
} >balls.toml
# watch.py SIGNAL TOOL SECONDS TEXT WORDS...: runs WORDS at a terminal until a line of it matches TEXT, then
# sends it the signal.
cat >watch.py <<'END'
import os, pty, re, signal, sys, time
stop = signal.Signals[sys.argv.pop(1)]
tool, seconds, wanted = sys.argv[1], float(sys.argv[2]), re.compile(sys.argv[3].encode())
pid, terminal = pty.fork()
if pid == 0:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ignored where the tests run in the background
    os.execv(tool, [tool] + sys.argv[4:])
seen, end = b"", time.time() + seconds
while time.time() < end and not wanted.search(seen):
    try:
        seen += os.read(terminal, 4096)
    except OSError:
        break
os.kill(pid, stop)
try:
    while True:
        more = os.read(terminal, 4096)
        if not more:
            break
        seen += more
except OSError:
    pass
status = os.waitpid(pid, 0)[1]
print(wanted.search(seen) is not None, b"stopped: outputs that were complete are kept, none is half written" in seen,
      os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGINT)
END
watched() { # NAME TEXT WORDS...
    name=$1
    shift
    same "$name" "$(python3 -B watch.py SIGINT "$tool" 120 "$@")" "True True True"
}
watched a_stage_is_shown_and_a_stop_said '\r(preparing, [0-5] of 5 stages done|dividing curved shapes|pose.*), [0-9]+ s' run balls.toml --tolerance 1e-9 --facets out.csv
# a ball with curved normals behind very many slats: a long pose, which says how far it is
python3 -c '
import math
n, slats = 200, 6000
for i in range(slats):
    x = -1 + 2 * i / slats
    print("v", x, -1, 3, "\nv", x + 0.5 / slats, -1, 3, "\nv", x + 0.3 / slats, 1, 3)
for i in range(n + 1):
    for k in range(n):
        a, b = math.pi * i / n, 2 * math.pi * k / n
        print("v", math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a))
for i in range(slats):
    print("f", 3 * i + 1, 3 * i + 2, 3 * i + 3)
print("s 1")
for i in range(n):
    for k in range(n):
        a, b = 3 * slats + 1 + n * i + k, 3 * slats + 1 + n * i + (k + 1) % n
        print("f", a, a + n, b + n, b)' >ball.obj
watched a_pose_says_how_far_it_is '\rpose: (visibility|integration), [0-9]+ %, [0-9]+ s' run ball.obj --normals smooth --method exact --tolerance 1e-9 --unit m
watched a_comparison_names_its_settings '\r(zbuffer|facet|exact|by estimate|meshes|loading|converge)[^\r]*, [0-9]+ s' converge ball.obj --unit m
watched a_report_names_its_stages '\r[a-z ]+(, [0-5] of 5 stages done|: [a-z]+)?[^\r]*, [0-9]+ s' report ball.obj --unit m -o ball.html
same nothing_half_written "$(ls out.csv .lrcs* 2>/dev/null)" ""
# a sweep that is interrupted would still complete the pose that is running, which takes long here
same a_sweep_says_how_many_rows_before_the_first "$(python3 -B watch.py SIGKILL "$tool" 120 '\r\[ +\]   0 %  0 of 37 ' sweep balls.toml --az 0:360:10 --tolerance 1e-5 -o rows.csv | cut -d' ' -f1)" True
same no_page_half_written "$(ls ball.html 2>/dev/null)" ""
run run balls.toml --tolerance 1e-2
same no_terminal_no_stage "$(printf '%s' "$err" | grep -c 'stages done')" 0
finish
