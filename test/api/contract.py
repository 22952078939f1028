# SPDX-License-Identifier: MIT
"""Holds the public headers to what the sources do: every public function has a comment of its own
(or shares the one above its neighbours), and that comment names every status that the function can
return. What a function can return is read off the sources: every LRCS_E_... that it, or anything
it calls, mentions other than to compare with it. That is more than what really happens; what a
caller cannot see is listed below, each with its reason.
usage: contract.py [--list]    (in the root; --list prints every function with its statuses)"""
import glob
import re
import sys

# What is mentioned on the way but never leaves the function.
NEVER = {
    # the recipe's shapes and materials are checked as the scene is built
    "lrcs_prepare_run": {"LRCS_E_ARGUMENT"},
    "lrcs_host_scene_prepare": {"LRCS_E_ARGUMENT"},
    # it returns no status; what it calls `build` are options, not the function of that name
    "lrcs_refine_halvings": {"LRCS_E_ARGUMENT", "LRCS_E_INDEX", "LRCS_E_LIMIT", "LRCS_E_MEMORY", "LRCS_E_NAME",
                             "LRCS_E_NUMBER"},
    # a finer division that cannot be built is not used
    "lrcs_host_scene_refine": {"LRCS_E_ARGUMENT", "LRCS_E_INDEX", "LRCS_E_LIMIT", "LRCS_E_MEMORY", "LRCS_E_NAME",
                               "LRCS_E_NUMBER", "LRCS_E_SYSTEM", "LRCS_E_UNSUPPORTED"},
    "lrcs_host_sweep_run": {"LRCS_E_NAME"},
    # every fault of a text is one of its plan
    "lrcs_host_plan_make": {"LRCS_E_NAME", "LRCS_E_NUMBER", "LRCS_E_SYNTAX"},
    "lrcs_host_plan_check": {"LRCS_E_NUMBER"},
    "lrcs_host_pose_read": {"LRCS_E_NUMBER", "LRCS_E_SYNTAX"},
    "lrcs_host_kit_read": {"LRCS_E_ARGUMENT"},
    # a fault of a row is one of its line; rows that were read are checked
    "lrcs_host_rows_next": {"LRCS_E_ARGUMENT", "LRCS_E_NAME", "LRCS_E_NUMBER"},
    "lrcs_host_sweep_map_open": {"LRCS_E_LIMIT", "LRCS_E_SYSTEM"},
    "lrcs_host_sweep_read": {"LRCS_E_NAME", "LRCS_E_NUMBER"},
    "lrcs_host_sweep_output_open": {"LRCS_E_ARGUMENT", "LRCS_E_NAME", "LRCS_E_NUMBER"},
    "lrcs_host_sweep_output_close": {"LRCS_E_ARGUMENT", "LRCS_E_NAME", "LRCS_E_NUMBER"},
    "lrcs_host_sweep_part_read": {"LRCS_E_ARGUMENT", "LRCS_E_NAME", "LRCS_E_NUMBER"},
    "lrcs_host_sweep_join": {"LRCS_E_ARGUMENT", "LRCS_E_NAME", "LRCS_E_NUMBER", "LRCS_E_SYNTAX"},
    # a direction made of a sine and a cosine, or a rotation, is never zero
    "lrcs_pose_from_azel": {"LRCS_E_ARGUMENT"},
    "lrcs_pose_from_euler": {"LRCS_E_ARGUMENT"},
    # a surface that is refused is not claimed
    "lrcs_quadric_find": {"LRCS_E_ARGUMENT", "LRCS_E_NUMBER"},
    "lrcs_host_surfaces_find": {"LRCS_E_ARGUMENT", "LRCS_E_NUMBER"},
    # the pictures they write are of one size, and not too large
    "lrcs_host_chart_png": {"LRCS_E_ARGUMENT", "LRCS_E_LIMIT"},
    "lrcs_host_map_png": {"LRCS_E_ARGUMENT", "LRCS_E_LIMIT"},
    "lrcs_host_picture_png": {"LRCS_E_ARGUMENT"},
    "lrcs_host_sweep_chart_write": {"LRCS_E_ARGUMENT", "LRCS_E_LIMIT", "LRCS_E_NAME", "LRCS_E_NUMBER"},
}

COMMENT = re.compile(r"/\*.*?\*/", re.S)
TOKEN = re.compile(r'/\*.*?\*/|\{|\}|;|#(?:[^\n\\]|\\.|\\\n)*|"(?:[^"\\]|\\.)*"|[^/{};#"]+|/', re.S)
CODE = re.compile(r"LRCS_E_[A-Z]+")


def declarations(text):
    """(comment, declaration) of every public function, in order."""
    comment, words, depth = "", "", 0
    for token in TOKEN.findall(text):
        if token.startswith("/*"):
            if depth == 0 and not words.strip():
                comment = token
        elif not token.startswith("#"):
            depth += (token == "{") - (token == "}")
            words += token
            if token == ";" and depth == 0:
                words = re.sub(r"__attribute__\(\(format\(.*?\)\)\)", "", words)
                found = re.match(r"(?!typedef|enum|struct)[^(]*?\b(lrcs_\w+)\(", words.lstrip())
                if found:
                    yield found.group(1), comment, " ".join(words.split())
                words = ""


def bodies(text):
    """(name, body) of every function that a source defines."""
    text = COMMENT.sub(" ", text)
    for found in re.finditer(r"^[a-z][^;={}#]*?\b(\w+)\([^;{}]*\)\s*\{\n(.*?)^\}", text, re.S | re.M):
        yield found.group(1), found.group(2)


def sources():
    """name: (functions that its body calls, statuses that it mentions other than to compare with them)."""
    body = {}
    for path in sorted(glob.glob("src/**/*.[ch]", recursive=True)):
        if not path.startswith("src/cli/"):
            with open(path, encoding="utf-8") as file:
                body.update(bodies(file.read()))
    return {name: (set(re.findall(r"\b\w+\b", text)) & body.keys(),
                   set(CODE.findall(re.sub(r"[!=]= *LRCS_E_[A-Z]+|case LRCS_E_[A-Z]+", "", text))))
            for name, text in body.items()}


def can_return(name, body):
    seen, front, codes = {name}, [name], set()
    while front:
        calls, mentioned = body.get(front.pop(), (set(), set()))
        codes |= mentioned
        front += calls - seen
        seen |= calls
    return codes


def spelt(comment):
    """The statuses that a comment spells out: LRCS_E_NAME, and _NAME after another."""
    return set(CODE.findall(comment)) | {
        "LRCS_E" + short for short in re.findall(r"(?<=[ ,])_[A-Z]{4,}\b", comment)}


def named(name, comments, seen=()):
    """Those, and those of functions that the comment refers to."""
    comment = comments[name]
    codes = spelt(comment)
    for phrase in re.findall(r"\bas\s+((?:lrcs_\w+(?:,\s+|\s+and\s+|\s+or\s+)?)+)", comment.replace("\n  ", " ")):
        for other in re.findall(r"lrcs_\w+", phrase):
            if other in comments and other != name and other not in seen:
                codes |= named(other, comments, (*seen, name))
    return codes


def main():
    comments, bad = {}, 0
    status = []
    for path in sorted(glob.glob("include/lrcs/*.h")):
        with open(path, encoding="utf-8") as file:
            for name, comment, words in declarations(file.read()):
                comments[name] = comment
                if not comment:
                    print(f"{path}: {name} has no comment")
                    bad += 1
                if words.startswith("int "):
                    status.append((path, name))
    body = sources()
    for path, name in status:
        codes = can_return(name, body) - NEVER.get(name, set())
        missing = sorted(codes - named(name, comments))
        made = set().union(*(can_return(other, body) for other in comments
                             if comments[other] == comments[name]))
        stale = sorted(spelt(comments[name]) - made)
        if "--list" in sys.argv:
            print(name, *sorted(codes))
        elif missing:
            print(f"{path}: {name} can return {', '.join(missing)}, which its comment does not name")
            bad += 1
        if stale:
            print(f"{path}: {name} cannot return {', '.join(stale)}, which its comment names")
            bad += 1
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
