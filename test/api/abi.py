# SPDX-License-Identifier: MIT
"""The public surface of the library, one line each: functions as declared, constants with their
values, structs with their sizes and members with their places (on a 64-bit machine). Kept in
abi.txt beside this, so that a change to it is seen, and meant.
usage: abi.py CC    (in the root)"""
import glob
import os
import re
import subprocess
import sys
import tempfile

from contract import COMMENT, declarations


def struct_members(body):
    """The names that a struct's members are declared with; of a nested struct only its own name."""
    while re.search(r"\{[^{}]*\}", body):
        body = re.sub(r"\{[^{}]*\}", " ", body)
    for member in body.split(";"):
        pointer = re.search(r"\(\*(\w+)\)", member)
        if pointer:
            yield pointer.group(1)
        else:
            yield from re.findall(r"(\w+)\s*(?:\[[^\]]*\]\s*)*(?:,|$)", member.strip())


def questions(text):
    """C statements that print what a header's structs and constants are."""
    text = COMMENT.sub(" ", text)
    for name in re.findall(r"^#define (LRCS_\w+)[ \\]+\S", text, re.M):
        if not name.endswith("_TEXT"):
            yield f'printf("{name} = %lld\\n", (long long)({name}));'
    for body in re.findall(r"\benum \w+ \{(.*?)\}", text, re.S):
        for name in re.findall(r"\b(LRCS_\w+)\b(?=\s*(?:=|,|$))", body):
            yield f'printf("{name} = %lld\\n", (long long){name});'
    for name, body in re.findall(r"^typedef struct (\w+) \{\n(.*?)^\}", text, re.S | re.M):
        yield f'printf("{name}: %zu bytes\\n", sizeof({name}));'
        for member in struct_members(body):
            yield f'printf("{name}.{member} at %zu\\n", offsetof({name}, {member}));'


def answers(compiler, statements):
    with tempfile.TemporaryDirectory() as folder:
        source, program = os.path.join(folder, "abi.c"), os.path.join(folder, "abi")
        with open(source, "w", encoding="utf-8") as file:
            file.write("#define _XOPEN_SOURCE 700\n")
            for path in sorted(glob.glob("include/lrcs/*.h")):
                file.write(f"#include <lrcs/{os.path.basename(path)}>\n")
            file.write("#include <stddef.h>\n#include <stdio.h>\nint main(void)\n{\n")
            file.write("\n".join(statements) + "\n}\n")
        subprocess.run([compiler, "-std=c11", "-Iinclude", source, "-o", program], check=True)
        return subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout


def main():
    texts = {}
    for path in sorted(glob.glob("include/lrcs/*.h")):
        with open(path, encoding="utf-8") as file:
            texts[f"== {os.path.basename(path)}\n"] = file.read()
    statements = []  # one program answers for all headers
    for head, text in texts.items():
        statements += [f'printf("{head.strip()}\\n");', *questions(text)]
    said = re.split(r"^(== .*\n)", answers(sys.argv[1], statements), flags=re.M)
    for head, lines in zip(said[1::2], said[2::2]):
        print(head, end="")
        for _, _, words in declarations(texts[head]):
            print(words)
        print(lines, end="")


if __name__ == "__main__":
    main()
