#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# The hash of the scene in test/scene/test_build.c (one triangle), from the definition of FNV-1a
# and of the order in src/scene/build/hash.c. Prints one number.
import struct


def fnv(data):
    h = 0xcbf29ce484222325
    for b in data:
        h = (h ^ b) * 0x100000001b3 & 0xffffffffffffffff
    return h


vertices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.25, 0.0, 2.0, -0.5]
data = struct.pack("<III", 3, 1, 1)
data += struct.pack("<9d", *vertices)
data += struct.pack("<III", 0, 1, 2) + struct.pack("<II", 0, 5)
data += struct.pack("<4d", 0.5, 0.25, 0.125, 0.0) + bytes([1, 0])
print("0x%016x" % fnv(data))
