#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes decimal.inc: decimal strings and the bits of the double nearest to each.

Source of truth: CPython's float() (David Gay's dtoa), and beside it exact rational arithmetic
(fractions.Fraction), which proves each result nearest, ties to even; the two must agree.
Run: python3 make_decimal.py > decimal.inc   (fixed seed: the same file each time)
"""
import random
import struct
import sys
from fractions import Fraction

if hasattr(sys, "set_int_max_str_digits"):
    sys.set_int_max_str_digits(0)
random.seed(20140156)


def bits(x):
    return struct.unpack("<Q", struct.pack("<d", x))[0]


def double(b):
    return struct.unpack("<d", struct.pack("<Q", b))[0]


def exact(b):
    """Value of the bits of a non-negative double; infinity as 2^1024."""
    return Fraction(2) ** 1024 if b == 0x7FF << 52 else Fraction(double(b))


def text_value(text):
    mantissa, _, exponent = text.lower().partition("e")
    exponent = int(exponent or "0")
    whole, _, part = mantissa.partition(".")
    return Fraction(int((whole + part) or "0")) * Fraction(10) ** (exponent - len(part))


def nearest(text):
    b = bits(float(text))
    v = text_value(text)
    if b > 0:
        half = (exact(b - 1) + exact(b)) / 2
        assert v > half or (v == half and b % 2 == 0), text
    if b < 0x7FF << 52:
        half = (exact(b) + exact(b + 1)) / 2
        assert v < half or (v == half and b % 2 == 0), text
    return b


def decimal_of(f):
    """A fraction with a power of two below the line, written out in full as digits e exponent."""
    k = f.denominator.bit_length() - 1
    assert f.denominator == 1 << k
    return str(f.numerator * 5**k), -k


def written(digits, exponent):
    """One of several spellings of digits * 10^exponent."""
    way = random.randrange(4)
    if way == 0 and -len(digits) < exponent <= 0:
        cut = len(digits) + exponent
        return digits[:cut] + "." + digits[cut:]
    if way == 1:
        return "%s.%se%d" % (digits[0], digits[1:], exponent + len(digits) - 1)
    if way == 2:
        return "00.000%sE%+d" % (digits, exponent + len(digits) + 3)
    return "%se%d" % (digits, exponent)


rows = [
    "0", "0.0", ".0", "0.", "0e999999999999", "1", "10", "1.", ".5", "1e22", "1e23", "8.5e22",
    "1e-22", "1e-23", "9007199254740991", "9007199254740992", "9007199254740993",
    "9007199254740994", "9007199254740995", "9007199254740993.0000000000000000000000000001",
    "9007199254740992.9999999999999999999999999999", "2.2250738585072011e-308",
    "2.2250738585072012e-308", "2.2250738585072014e-308", "2.225073858507201e-308",
    "1.7976931348623157e308", "1.7976931348623158e308", "1.7976931348623159e308",
    "1.797693134862315807e308", "1.797693134862315808e308", "1e308", "1e309", "2e308",
    "4.9406564584124654e-324", "5e-324", "3e-324", "2.4703282292062327208e-324",
    "2.4703282292062327209e-324", "2.4703282292062328e-324", "2e-324", "1e-324", "1e-323",
    "1e-400", "1e400", "1e999999999999", "1e-999999999999", "1e99999999999999999999999999",
    "1e-99999999999999999999999999", "6.631236846766476e-316", "3.237883913302901289588352412501532e-322",
    "6.9294956446009195e15", "3.7455744005952583e15", "2.2250738585072011360574097967091319759348195e-308",
    "5.708990770823839207320493820740630171355185152001e-3",
    "1.00000000000000011102230246251565404236316680908203125",
    "1.00000000000000011102230246251565404236316680908203124",
    "1.00000000000000011102230246251565404236316680908203126",
    "1.00000000000000033306690738754696212708950042724609375",
    "7.2057594037927933e16", "123456789012345678901234567890", "0.1", "0.2", "0.3", "1.1", "8.41e21",
    "2.0919495182368195e19", "2.6760179287532483e19", "3.2942957306323907e19", "5e-20", "6e-10",
]
# The ends of the range, and their neighbours, written out in full.
HUGE = exact((0x7FF << 52) - 1)
for f in [Fraction(1, 2**1075), Fraction(3, 2**1075), Fraction(1, 2**1074),
          Fraction(2**53 - 1, 2**1075), Fraction(2**54 - 1, 2**1075), HUGE,
          (HUGE + Fraction(2)**1024) / 2]:
    digits, exponent = decimal_of(f)
    below = str(int(digits) - 1)
    for d in (digits, digits + "0" * 40 + "1", below + "9" * 40, digits + "000"):
        rows.append("%se%d" % (d, exponent - (len(d) - len(digits))))
# 800 digits and more: only the last one tells.
half = decimal_of((exact(bits(1.5)) + exact(bits(1.5) + 1)) / 2)[0]
for tail in ("0" * 900, "0" * 900 + "1", "0" * 747, "0" * 746 + "1", "0" * 747 + "1"):
    rows.append("%s.%s%s" % (half[0], half[1:], tail))
rows.append("0." + "0" * 900 + "1e901")
rows.append("1" + "0" * 900 + "e-900")
rows.append("1" + "2" * 799 + "e-700")
rows.append("0." + "3" * 1000)
# Plain random numbers of 1 to 25 digits over the whole range and beyond it.
for _ in range(1200):
    digits = str(random.randrange(10 ** random.randrange(1, 26)))
    rows.append(written(digits, random.randrange(-345, 312)))
for _ in range(500):  # what files hold
    rows.append("%.*g" % (random.randrange(4, 18), random.uniform(-1, 1) * 10 ** random.randrange(-6, 7)))
    rows[-1] = rows[-1].lstrip("-")
for _ in range(400):  # doubles of all sizes, as 17 digits
    rows.append("%.16e" % double(random.randrange(0x7FF << 52)))


def near_halfway(b):
    f = (exact(b) + exact(b + 1)) / 2
    digits, exponent = decimal_of(f)
    way = random.randrange(5)
    if way == 1:
        digits, exponent = digits + "1", exponent - 1
    elif way == 2:
        digits = str(int(digits) - 1)
    elif way >= 3 and len(digits) > 20:  # cut, or cut and one up: near, not on it
        keep = random.randrange(17, min(len(digits), 40))
        exponent += len(digits) - keep
        digits = str(int(digits[:keep]) + (way - 3))
    return written(digits, exponent)


for _ in range(1000):
    rows.append(near_halfway(bits(2.0 ** random.randrange(-60, 120) * random.uniform(1, 2))))
for _ in range(120):
    rows.append(near_halfway(random.randrange(0x7FF << 52)))
for _ in range(40):
    rows.append(near_halfway(random.randrange(1 << 52)))
for _ in range(40):
    rows.append(near_halfway(random.randrange(1 << random.randrange(1, 52))))

print("/* Made by make_decimal.py with CPython %s; do not edit. {text, bits of the nearest double} */"
      % sys.version.split()[0])
for text in rows:
    if any(len(e) > 6 for e in [text.lower().partition("e")[2]]):
        b = bits(float(text))  # exponents that no rational could hold
    else:
        b = nearest(text)
    print('{"%s",\n UINT64_C(0x%016x)},' % (text, b))
