"""Every processor: instructions (not cycles) of the golden codes that a board draws, and their RAM.

The boards do not draw the same codes; these figures are of two that all of them do.
"""

import sys

import boards

sys.path.insert(0, str(boards.ROOT / "tests" / "targets"))

import targets  # noqa: E402

COMMON = ("coast", "cone")
SMALL = "128x64"


def mean(values):
    values = list(values)
    return sum(values) // len(values)


def measure_target(board):
    name = targets.TARGETS[board][0]
    run = targets.run(board, counted=True)
    counts = {tuple(key.split(" ")): count for key, count in run.instructions.items()}
    label = " and ".join(COMMON)
    yield f"load, mean of {label}", name, mean(counts[code, "mesh"] for code in COMMON), \
        "instructions"
    yield f"frame {SMALL}, mean of {label}", name, \
        mean(count for (code, what), count in counts.items()
             if code in COMMON and what.endswith(SMALL)), "instructions"
    load = run.sizes["yb_load_t"] + run.stack["load"]
    draw = run.sizes["yb_frame_t"] + run.sizes[f"band-{SMALL}"] + run.stack[f"frame-{SMALL}"]
    yield f"all of it for {SMALL}", name, run.sizes["yb_map_t"] + max(load, draw), "bytes"


def measure():
    for board in targets.TARGETS:
        yield from measure_target(board)
