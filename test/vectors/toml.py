#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# What Python's tomllib (3.11, TOML 1.0) makes of numbers, strings and documents: toml.inc.
# A row has the text, whether tomllib takes it, and the value. Run: python3 toml.py > toml.inc
import random
import tomllib

random.seed(20140911)


def c_text(data):
    return '"' + "".join(chr(b) if 32 <= b < 127 and chr(b) not in '"\\?' else "\\%03o" % b
                         for b in data) + '"'


def load(data):
    try:
        return tomllib.loads(data.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError):
        return None


def number_row(token):
    got = load(("x = " + token + "\n").encode())
    value = got["x"] if got else None
    # Beside the subset: integers that a double may not hold, inf, nan, 0x..., dates.
    good = (isinstance(value, (int, float)) and not isinstance(value, bool)
            and value - value == 0 and set(token) <= set("0123456789+-_.eE")
            and (isinstance(value, float) or abs(value) < 2**53))
    print("    {%s, %d, %s}," % (c_text(token.encode()), good, repr(float(value)) if good else "0.0"))


def string_row(body):
    got = load(b"x = " + body + b"\n")
    good = got is not None and list(got) == ["x"] and isinstance(got["x"], str) and "\0" not in got["x"]
    value = got["x"].encode() if good else b""
    print("    {%s, %d, %d, %s, %d}," % (c_text(body), len(body), good, c_text(value), len(value)))


print("/* Made by toml.py with Python's tomllib; do not edit. */")
print("static const number_row number_rows[] = {")
fixed = ["0", "-0", "+0", "1_000", "1__0", "_1", "1_", "01", "-01", "1.0", "1.", ".5", "1.e5", "1e5",
         "1E+05", "1e-07", "6.022_140_76e2_3", "1e_5", "1_.0", "1._0", "9007199254740992",
         "9007199254740993", "-9007199254740992", "1e308", "1e309", "-1e400", "5e-324", "1e-400",
         "0.1", "3.14159265358979323846264338327950288", "00.5", "0e0", "0.0", "-0.0", "+1.5e+3",
         "++1", "1e", "1e+", "--1", "0_0", "0_1", "1.0_1", "e5", "0x10", "0o7", "0b1", "inf", "-inf",
         "nan", "+nan", "1979-05-27", "07:32:00", "1,5", "1 2", "12e03", "1.7976931348623159e308"]
seen = set(fixed)
for token in fixed:
    number_row(token)
while len(seen) < 900:
    token = "".join(random.choice("00112589__..eE+-") for _ in range(random.randint(1, 7)))
    if token not in seen:
        seen.add(token)
        number_row(token)
print("};\n\nstatic const string_row string_rows[] = {")
pieces = [b"a", b"b c", b"\xc3\xa9", b"\\n", b"\\t", b"\\\\", b'\\"', b"\\u00e9", b"\\U0001F6F0",
          b"\\uD800", b"\\U00110000", b"\\q", b"\\u12", b"\t", b"\x7f", b"\x01", b"#", b"'", b'"',
          b"\\", b"\\b\\f\\r", b"\xff", b"\xc0\xaf", b"\xed\xa0\x80", b"\\u0000", b"\\x41", b"]", b"="]
bodies = set()
while len(bodies) < 500:
    quote = random.choice([b'"', b"'"])
    body = quote + b"".join(random.choice(pieces) for _ in range(random.randint(0, 4)))
    body += quote if random.random() < 0.95 else b""
    if body.startswith((b'"""', b"'''")):
        continue
    bodies.add(body)
for body in sorted(bodies):
    string_row(body)
print("};\n\nstatic const document_row document_rows[] = {")
# 1: in the subset, so both must take it. 0: beside it; then only tomllib's verdict limits us.
documents = [
    (1, ""), (1, "# only a comment"), (1, "a=1"), (1, "a = 1 # c"), (1, "a = 1\r\nb = 2\r\n"),
    (1, "\n\n  a\t=\t1  \n"), (1, '"a b" = 1'), (1, "'a\\b' = 1"), (1, "1 = 1"), (1, "-_- = 1"),
    (1, '"" = 1'), (1, "a = [1, 2]"), (1, "a = [\n 1, # one\n 2,\n]\nb = 1"), (1, "a = []"),
    (1, "a = [1,]"), (1, "[a]"), (1, "[a.b]"), (1, "[[a]]"), (1, "[[a.b]]"), (1, "[ a . b ]"),
    (1, "[ 'a' . \"b\" ] # c"), (1, "[[ a ]]"), (1, "a = true"), (1, "a = false#"),
    (1, "a = ''"), (1, 'a = ""'), (1, "[[a]]\nb = 1\n[a.c]\nd = 2"), (1, "a = '#'"),
    (0, "a = 1 b = 2"), (0, "a"), (0, "a ="), (0, "= 1"), (0, "a = 1\rb = 2"), (0, "a = [1 2]"),
    (0, "a = [,]"), (0, "a = [1,,2]"), (0, "a = [1"), (0, "[a"), (0, "[]"), (0, "[a.]"), (0, "[.a]"),
    (0, "[[a]"), (0, "[a]]"), (0, "[ [a]]"), (0, "[[a] ]"), (0, "[a] b = 1"), (0, "a = True"),
    (0, "a = truefalse"), (0, "a.b = 1"), (0, "a = {b = 1}"), (0, 'a = """x"""'), (0, "a = '''x'''"),
    (0, "a = 0xff"), (0, "a = 1979-05-27"), (0, "a = 07:32:00"), (0, "a = inf"), (0, "a = [[1]]"),
    (0, "a = ['x']"), (0, "a = [true]"), (0, "[a.b.c]"), (0, "a\n= 1"), (0, "a =\n1"), (0, "a b = 1"),
    (0, "a = \"x\ny\""), (0, "a : 1"), (0, "a = 1;"), (0, "a = 'x' 'y'"), (0, "# \x01"), (0, "a = .5"),
    (0, "\x0ca = 1"), (0, "a = 1\x00"), (0, "[a]\x0b"), (0, "a == 1"), (0, "a = +"), (0, "a = [1]]"),
]
for inside, text in documents:
    data = text.encode()
    print("    {%s, %d, %d, %d}," % (c_text(data), len(data), inside, load(data) is not None))
print("};")
