"""Instructions (not cycles) of loading a code and of drawing a frame, exact and repeatable."""

import boards
import paper_code

STANDARD_VIEWS = 8
ORBITS = 4  # the first of them


def many_summits():
    """The code with the most vertices: 251 spot heights, scattered by a fixed rule."""
    places = set()
    state = 1
    while len(places) < 251:
        state = (state * 1103515245 + 12345) & 0x7FFFFFFF
        places.add((1 + (state >> 8) % 253, 1 + (state >> 18) % 253))
    return paper_code.paper_code([(30 + i * 97 % 251, [(x, y)])
                                  for i, (x, y) in enumerate(sorted(places))])


def mean(values):
    values = list(values)
    return sum(values) // len(values)


def frame_regions(run):
    """{setting: {view: instructions}}"""
    frames = {}
    for name, count in run.regions.items():
        words = name.split()
        if words[0] == "frame":
            frames.setdefault(words[1], {})[words[2]] = count
    return frames


def measure_loads(board, loads, shadows):
    target = boards.TARGETS[board]
    yield "load, mean of the maps", target, mean(loads), "instructions"
    yield "load, worst of the maps", target, max(loads), "instructions"
    yield "shadows, mean of the maps", target, mean(shadows), "instructions"
    yield "shadows, worst of the maps", target, max(shadows), "instructions"
    crowded = boards.run_map(board, "many-summits", many_summits())
    yield "load, 251 summits", target, crowded.regions["load"], "instructions"


def measure_board(board):
    target = boards.TARGETS[board]
    runs = [boards.run_map(board, name, code) for name, code in boards.maps().items()]
    if board in boards.DEVICES:
        yield from measure_loads(board, [run.regions["load"] for run in runs],
                                 [run.regions["shadows"] for run in runs])
    frames = [frame_regions(run) for run in runs]
    for setting in frames[0]:
        if not all(setting in frame for frame in frames):
            continue  # too much memory for some of the maps
        if board not in boards.DEVICES and setting.startswith("128x64"):
            continue  # the same to the instruction as on the device with this core
        for view in frames[0][setting]:
            yield (f"frame {setting} {view}", target,
                   mean(frame[setting][view] for frame in frames), "instructions")
        for what, chosen in (("views", STANDARD_VIEWS), ("orbits", ORBITS)):
            if len(frames[0][setting]) >= chosen:
                yield (f"frame {setting}, mean of the {what}", target,
                       mean(mean(list(frame[setting].values())[:chosen]) for frame in frames),
                       "instructions")


def ratios(figures):
    """What the figures say of each other: bands against a full height, and M0 against M3."""
    def frame(setting, target):
        return figures.get((f"frame {setting}, mean of the orbits", target))

    for setting, full in (("128x64-rows16", "128x64-rows64"), ("128x64-rows8", "128x64-rows64"),
                          ("128x64-rows1", "128x64-rows64"),
                          ("320x240-rows16", "320x240-rows240")):
        for target in boards.TARGETS.values():
            if frame(setting, target) and frame(full, target):
                yield (f"{setting} against {full}", target,
                       f"{frame(setting, target) / frame(full, target):.2f}", "ratio")
    for look in ("shadows", "lines", "haze", "all"):
        for target in boards.TARGETS.values():
            plain, richer = (frame(setting, target)
                             for setting in ("128x64-12k", f"128x64-12k-{look}"))
            if plain and richer:
                yield (f"128x64-12k-{look} against 128x64-12k", target,
                       f"{richer / plain:.2f}", "ratio")
    pair = [frame("128x64-12k", target) for target in ("cortex-m0", "cortex-m3")]
    yield "128x64-12k against cortex-m3", "cortex-m0", f"{pair[0] / pair[1]:.2f}", "ratio"


def measure():
    figures = {}
    for board in boards.TARGETS:
        for name, target, value, unit in measure_board(board):
            figures[name, target] = value
            yield name, target, value, unit
    yield from ratios(figures)
