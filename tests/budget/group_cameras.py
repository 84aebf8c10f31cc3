"""The worst of a thousand cameras round, on and above eight maps: instructions (not cycles) of a frame
of 128 x 64 in 12 KB for all of it, and of a band.
"""

import boards

BOARD = "lm3s6965evb"
ROWS_IN_ALL = 64


def frames_of(run):
    """[(instructions of a frame, of its worst band)]"""
    frames = []
    for name, count in run.regions.items():
        what, _, number = name.partition(" ")
        if what == "begin":
            frames.append([count])
        elif what == "band":
            frames[int(number) // ROWS_IN_ALL].append(count)
    return [(sum(parts), max(parts[1:])) for parts in frames]


def measure():
    frames = []
    for name, code in boards.maps().items():
        run = boards.run_bench(BOARD, code, program="cameras")
        if run.error:
            raise boards.MeasureError(f"{BOARD} refuses the code {name}: {run.error}")
        frames += frames_of(run)
    target = boards.TARGETS[BOARD]
    label = f"of {len(frames)} cameras, 128x64-12k"
    yield f"mean frame {label}", target, sum(frame for frame, _ in frames) // len(frames), \
        "instructions"
    yield f"worst frame {label}", target, max(frame for frame, _ in frames), "instructions"
    yield f"worst band {label}", target, max(band for _, band in frames), "instructions"
