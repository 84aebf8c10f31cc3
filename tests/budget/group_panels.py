"""Bytes over the wires of each panel in a slow turn round eight maps, a degree a frame, against frames
sent whole; what a still picture sends; and what the bus's rated clock makes of whole frames.
"""

import json
import os
import re

import boards

PROGRAM = os.environ.get("YB_YAMABIKO", str(boards.ROOT / "build/host-release/bin/yamabiko"))
FRAMES = 361  # the first is sent whole


def bytes_a_frame(name, panel, *options):
    words = ("sim", boards.ROOT / "maps" / f"{name}.yb", "--panel", panel["name"], "--png", os.devnull,
             "--force", "--stats", *options)
    said = boards.tool(PROGRAM, *words, "--frames", FRAMES)
    frames, sent = map(int, re.search(r"(\d+) frames, (\d+) bytes", said).groups())
    assert frames == FRAMES
    first = boards.tool(PROGRAM, *words, "--frames", 1)
    return (sent - int(re.search(r", (\d+) bytes", first).group(1))) / (FRAMES - 1)


def measure():
    for panel in json.loads(boards.tool(PROGRAM, "info", "--panel", "--json")):
        turns = [bytes_a_frame(name, panel, "--orbit") for name in boards.MEASURED]
        mean = sum(turns) / len(turns)
        yield "bytes of a frame in a slow turn", panel["name"], round(mean), "bytes"
        yield "the same against a whole frame", panel["name"], f"{mean / panel['frame_bytes']:.2f}", "ratio"
        still = bytes_a_frame(boards.MEASURED[0], panel)
        yield "bytes of a still frame", panel["name"], f"{still:g}", "bytes"
        yield "whole frames at the rated clock", panel["name"], \
            f"{panel['frames_per_second']:.1f}", "frames a second"
