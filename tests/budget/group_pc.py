"""Frames per second on the machine that measures, one core, all of the frame at once: of a turn round
eight maps, by the CPU's time. Unlike all other figures they depend on the machine and its load.
"""

import os

import boards

PROGRAM = os.environ.get("YB_HOST_FRAMES", str(boards.ROOT / "build/host-release/bin/host_frames"))
SETTINGS = (
    ("320x240", "320x240", 0),
    ("1920x1080", "1920x1080", 0),
    ("1920x1080, edges of 6 pixels", "1920x1080", 96),
)


def measure():
    maps = [boards.ROOT / "maps" / f"{name}.yb" for name in boards.MEASURED]
    for label, size, edge in SETTINGS:
        micros, drawn = boards.tool(PROGRAM, size, edge, *maps).split()
        yield f"frame {label}", "this PC", f"{1e6 / int(micros):.0f}", "frames a second"
        yield f"triangles drawn, {label}", "this PC", drawn, "triangles"
