# SPDX-License-Identifier: MIT
"""For the Python in shell tests: one line a check, as the other tests have it; finish() ends the
script, with 1 where a check was bad."""
import sys

bad = 0


def check(name, good, why=""):
    global bad
    print("ok " + name if good else f"not ok {name} {why}")
    bad += not good


def finish():
    sys.exit(bad != 0)
