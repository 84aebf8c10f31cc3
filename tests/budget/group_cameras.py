"""The worst of a thousand cameras round, on and above eight maps: instructions (not cycles) of a frame
of 128 x 64 in 12 KB for all of it, or of 320 x 240 in 32 KB, and of a band.
"""

import boards

BOARD = "lm3s6965evb"
ROWS_IN_ALL = 256


def frames_of(run):
    """{setting: [(instructions of a frame, of its worst band)]}"""
    settings = {}
    for name, count in run.regions.items():
        what, *of = name.split()
        if what == "begin":
            settings.setdefault(of[0], []).append([count])
        elif what == "band":
            settings[of[0]][int(of[1]) // ROWS_IN_ALL].append(count)
    return {setting: [(sum(parts), max(parts[1:])) for parts in frames]
            for setting, frames in settings.items()}


def measure():
    settings = {}
    for name, code in boards.maps().items():
        run = boards.run_bench(BOARD, code, program="cameras")
        if run.error:
            raise boards.MeasureError(f"{BOARD} refuses the code {name}: {run.error}")
        for setting, frames in frames_of(run).items():
            settings.setdefault(setting, []).extend(frames)
    target = boards.TARGETS[BOARD]
    for setting, frames in settings.items():
        label = f"of {len(frames)} cameras, {setting}"
        yield f"mean frame {label}", target, sum(frame for frame, _ in frames) // len(frames), \
            "instructions"
        yield f"worst frame {label}", target, max(frame for frame, _ in frames), "instructions"
        yield f"worst band {label}", target, max(band for _, band in frames), "instructions"
