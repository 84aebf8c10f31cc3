"""What the tests of the boards share: where things are, and the frames that are right.

The environment names them: YB_HOST_FRAME (the program host_frame), YB_FIRMWARE (the folder that
holds a build folder per board) and YB_GALLERY (a folder of codes, may be empty).
"""

import os
import pathlib
import subprocess

import emulator

AZIMUTHS_BAM = (0, 8192, 24576, 33024, 57344)


def elf(board, program="yamabiko"):
    return os.path.join(os.environ["YB_FIRMWARE"], board, "bin", f"{program}-{board}.elf")


def board(name, slot=None):
    return emulator.Board(name, elf(name), slot)


def gallery():
    """The gallery's codes that have a place in the map slot, as paths."""
    return sorted(str(path) for path in pathlib.Path(os.environ["YB_GALLERY"]).glob("*.yb"))


def frame_bytes(map_path, azimuth_bam, looks=0):
    """The frame's pixel bytes as the PC draws them: 64 rows of 64. looks: 1 shadows, 2 lines."""
    command = [os.environ["YB_HOST_FRAME"], map_path, str(azimuth_bam), str(looks)]
    result = subprocess.run(command, capture_output=True, check=False)
    if result.returncode != 0 or len(result.stdout) != 64 * 64:
        raise AssertionError(f"{command}: {result.stderr.decode()}, {len(result.stdout)} bytes")
    return result.stdout


def frame_rows(pixels):
    """Levels, a bytes object per row, from a frame's pixel bytes."""
    levels = bytes(level for pair in pixels for level in (pair >> 4, pair & 15))
    return [levels[y * 128:(y + 1) * 128] for y in range(64)]


def frame_hash(pixels):
    """FNV-1a, 32 bits, as the console prints it."""
    value = 2166136261
    for byte in pixels:
        value = (value ^ byte) * 16777619 & 0xFFFFFFFF
    return f"{value:08x}"


def wrong_pixels(shown, expected):
    """Where two pictures differ, as a sentence; empty if they do not."""
    wrong = [(x, y) for y in range(64) for x in range(128) if shown[y][x] != expected[y][x]]
    return f"{len(wrong)} pixels differ, the first at {wrong[0]}" if wrong else ""
