#!/usr/bin/env python3
"""Draws a sheet as if by hand: contour lines of a hill with two summits and of a slope in a corner.

    examples/sheet.py > examples/sheet.png
    yamabiko encode examples/sheet.png --base 100 --interval 20 --cell 2.5 -o hill.yb

The pen trembles, presses now more, now less, and is lifted here and there; the paper is yellowish
and lies in the shadow of whoever scanned it.
"""
import math
import struct
import sys
import zlib

WIDTH, HEIGHT = 560, 420
# Hills: middle, half widths, height, turn.
HILLS = ((215, 215, 95, 72, 6.7, 0.4), (350, 190, 62, 72, 7.5, -0.3), (290, 270, 130, 60, 1.9, 0.1),
         (590, 450, 120, 100, 4.6, 0.7))
LIFTED = ((128, 160, 4), (92, 205, 4), (300, 118, 4), (250, 333, 5), (404, 150, 4), (443, 262, 4),
          (237, 180, 4), (489, 385, 4))
SUMMITS = ((228, 225), (341, 198))
INK = (44, 36, 52)


def wave(x, y, length, seed):
    """Something smooth between -1 and 1 that changes over so many pixels."""
    total = 0
    for i in range(4):
        angle = 2.4 * i + seed
        total += math.sin((x * math.cos(angle) + y * math.sin(angle)) * 6.28 / length
                          / (1 + 0.3 * i) + 1.7 * seed + i)
    return total / 4


def height(x, y):
    """In intervals; the first line lies at 1."""
    x, y = x + 1.6 * wave(x, y, 31, 1), y + 1.6 * wave(x, y, 37, 2)
    total = 0.25 * wave(x, y, 160, 3)
    for middle_x, middle_y, half_x, half_y, top, turn in HILLS:
        dx, dy = x - middle_x, y - middle_y
        along = (dx * math.cos(turn) + dy * math.sin(turn)) / half_x
        across = (dy * math.cos(turn) - dx * math.sin(turn)) / half_y
        total += top * math.exp(-along * along - across * across)
    return total


def ink(x, y, low, row, column):
    """How much of a pixel the pen covers, 0 to 1; low holds the heights of the pixels."""
    here = low[row][column]
    slope = math.hypot(low[row][column + 1] - here, low[row + 1][column] - here)
    off = abs(here - max(1, round(here))) / max(slope, 1e-6)
    drawn = 1.3 + 0.45 * wave(x, y, 55, 4) - off + 0.5
    for gap_x, gap_y, radius in LIFTED:
        drawn = min(drawn, math.hypot(x - gap_x, y - gap_y) - radius)
    dot, cross = SUMMITS
    drawn = max(drawn, 4 - math.hypot(x - dot[0], y - dot[1]))
    dx, dy = x - cross[0], y - cross[1]
    if max(abs(dx), abs(dy)) < 5:
        drawn = max(drawn, 1.8 - min(abs(dx - dy), abs(dx + dy)) * 0.7)
    return min(max(drawn, 0), 1)


def paper(x, y):
    """Its colour in steps of one sixteenth."""
    light = 1 - 0.3 * (x / WIDTH) ** 2 - 0.1 * (y / HEIGHT) + 0.02 * wave(x, y, 90, 5)
    return round(16 * light) / 16


def row_of(low, row):
    pixels = bytearray(b"\0")
    for column in range(WIDTH):
        covered = round(4 * ink(column, row, low, row, column)) / 4
        light = paper(column, row)
        for channel, full in zip(INK, (255, 249, 232)):
            pixels.append(int(min(full, light * (full + covered * (channel - full)))))
    return bytes(pixels)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def main():
    low = [[height(x, y) for x in range(WIDTH + 1)] for y in range(HEIGHT + 1)]
    rows = b"".join(row_of(low, row) for row in range(HEIGHT))
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    sys.stdout.buffer.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


main()
