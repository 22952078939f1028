# SPDX-License-Identifier: MIT
"""For the Python in shell tests: one line a check in the Test Anything Protocol, counted with those
of the shell (test/cli/check.sh)."""
import os
import sys


def tell(line, letter):
    print(line)
    sys.stdout.flush()
    with open(os.environ["TAP_RESULTS"], "a") as results:
        results.write(letter)


def check(name, good, why=""):
    tell("ok " + name if good else f"not ok {name}\n# {why}", "o" if good else "n")


def skip(name, why):
    tell(f"ok {name} # SKIP {why}", "s")

