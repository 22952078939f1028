#!/bin/sh
# SPDX-License-Identifier: MIT
# A run of more than two seconds shows at a terminal which stage it is in, and a Ctrl-C says what is
# kept. Elsewhere it is silent.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
command -v python3 >/dev/null || { skip a_stage_is_shown 'no python3'; finish; exit; }
# A ball in the shadow of a plate, divided very finely: seconds on any machine.
cat >ball.toml <<'END'
[[part]]
name = "ball"
shape = "sphere"
radius = 1
[[part]]
name = "plate"
shape = "plate"
size = [1, 1]
translate = [0.3, 0.2, 3]
END
cat >watch.py <<'END'
import os, pty, signal, sys, time
tool, seconds = sys.argv[1], float(sys.argv[2])
pid, terminal = pty.fork()
if pid == 0:
    os.execv(tool, [tool, "run", "ball.toml", "--tolerance", "1e-9", "--facets", "out.csv"])
seen, end = b"", time.time() + seconds
while time.time() < end and b"stages done, " not in seen and b" s" not in seen.split(b"\r")[-1]:
    try:
        seen += os.read(terminal, 4096)
    except OSError:
        break
os.kill(pid, signal.SIGINT)
try:
    while True:
        more = os.read(terminal, 4096)
        if not more:
            break
        seen += more
except OSError:
    pass
status = os.waitpid(pid, 0)[1]
shown = any(w in seen for w in (b"loading, ", b"preparing, ", b"pose, "))
print(shown, b"stopped: outputs that were complete are kept, none is half written" in seen,
      os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGINT)
END
same a_stage_is_shown_and_a_stop_said "$(python3 -B watch.py "$tool" 120)" "True True True"
same nothing_half_written "$(ls out.csv .lrcs* 2>/dev/null)" ""
run run ball.toml --tolerance 1e-2
same no_terminal_no_stage "$(printf '%s' "$err" | grep -c 'stages done')" 0
finish
