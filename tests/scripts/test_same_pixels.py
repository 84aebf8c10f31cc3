#!/usr/bin/env python3
"""scripts/same-pixels: the same picture by every filter and colour type, and what is not the same."""

import pathlib
import struct
import subprocess
import tempfile
import unittest
import zlib

TOOL = pathlib.Path(__file__).resolve().parents[2] / "scripts/same-pixels"
WIDTH, HEIGHT = 7, 6


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def filtered(method, row, above, step):
    out = bytearray([method])
    for i, value in enumerate(row):
        left = row[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        guess = left + above[i] - corner
        paeth = min((left, above[i], corner), key=lambda v: abs(guess - v))
        out.append(value - (0, left, above[i], (left + above[i]) // 2, paeth)[method] & 255)
    return bytes(out)


def png(greys, colour=0, method=0):
    """A PNG file of grey levels, as colour type 0 (grey), 2 (RGB) or 6 (RGBA)."""
    spread = {0: lambda g: [g], 2: lambda g: [g] * 3, 6: lambda g: [g, g, g, 255]}[colour]
    step = len(spread(0))
    above, body = bytes(WIDTH * step), b""
    for y in range(HEIGHT):
        row = bytes(b for g in greys[y * WIDTH:(y + 1) * WIDTH] for b in spread(g))
        body += filtered(method, row, above, step)
        above = row
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, colour, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(body)) + chunk(b"IEND", b""))


class SamePixels(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.greys = [(i * i * 37 + 11) % 256 for i in range(WIDTH * HEIGHT)]

    def compare(self, a, b):
        paths = []
        for name, data in (("a.png", a), ("b.png", b)):
            paths.append(pathlib.Path(self.folder.name) / name)
            paths[-1].write_bytes(data)
        return subprocess.run([TOOL, *paths], capture_output=True, text=True, check=False)

    def test_same(self):
        for colour in (0, 2, 6):
            for method in range(5):
                with self.subTest(colour=colour, method=method):
                    result = self.compare(png(self.greys), png(self.greys, colour, method))
                    self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_one_level_in_one_pixel(self):
        for place in (0, WIDTH - 1, WIDTH * HEIGHT - 1):
            other = list(self.greys)
            other[place] ^= 1
            result = self.compare(png(self.greys, 0, 4), png(other, 2, 2))
            self.assertEqual(result.returncode, 1)
            self.assertIn("1 of 42 pixels", result.stderr)

    def test_no_picture(self):
        good = png(self.greys)
        for bad in (b"", b"GIF89a", good[:-30], good[:40], good.replace(b"\x08\0", b"\x10\0", 1)):
            self.assertEqual(self.compare(good, bad).returncode, 2)


if __name__ == "__main__":
    unittest.main()
