# SPDX-License-Identifier: MIT
"""A PNG of 8-bit RGB, read by Python's zlib alone: for the tests of what the tool draws."""
import struct
import zlib


class Png:
    """head: what IHDR holds; sums: whether all chunks' are right; raw: the bytes inflated; rows: of
    each row, top first, its bytes unfiltered."""

    def __init__(self, path):
        data, pos, idat, self.sums = open(path, "rb").read(), 8, b"", True
        while pos < len(data):
            size, kind = struct.unpack(">I4s", data[pos:pos + 8])
            body = data[pos + 8:pos + 8 + size]
            self.sums &= zlib.crc32(kind + body) == struct.unpack(">I", data[pos + 8 + size:pos + 12 + size])[0]
            if kind == b"IHDR": self.head = struct.unpack(">IIBBBBB", body)
            if kind == b"IDAT": idat += body
            pos += 12 + size
        self.raw, self.rows, w = zlib.decompress(idat), [], self.head[0]
        last = bytes(3 * w)
        for y in range(len(self.raw) // (3 * w + 1)):
            kind, *row = self.raw[y * (3 * w + 1):(y + 1) * (3 * w + 1)]
            for i in range(3 * w if kind else 0):
                a, b, c = row[i - 3] if i > 2 else 0, last[i], last[i - 3] if i > 2 else 0
                p = a + b - c
                paeth = a if abs(p - a) <= abs(p - b) and abs(p - a) <= abs(p - c) else b if abs(p - b) <= abs(p - c) else c
                row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
            last = bytes(row)
            self.rows.append(last)
