"""RAM: the engine's structs, the stack, and the whole of what a screen size takes."""

import boards

# The setting that each screen size is measured with.
STANDARD = ("128x64-12k", "320x240-32k")
STRUCTS = ("yb_map_t", "yb_load_t", "yb_frame_t")


def measure_board(board):
    target = boards.TARGETS[board]
    runs = [boards.run_map(board, name, code) for name, code in boards.maps().items()]
    sizes = runs[0].sizes
    for name in STRUCTS:
        yield f"size of {name}", target, sizes[name], "bytes"
    load_stack = max(run.stack["load"] for run in runs)
    yield "stack of loading", target, load_stack, "bytes"
    yield "stack of casting shadows", target, max(run.stack["shadows"] for run in runs), "bytes"
    load = sizes["yb_map_t"] + sizes["yb_load_t"] + load_stack
    for setting in STANDARD:
        if f"piece-{setting}" not in sizes:
            continue
        frame_stack = max(run.stack[f"frame-{setting}"] for run in runs)
        yield f"stack of a frame {setting}", target, frame_stack, "bytes"
        draw = sizes[f"piece-{setting}"] + frame_stack
        yield f"all of it for {setting}", target, max(load, draw), "bytes"
    sections = boards.section_sizes(boards.firmware_elf(board))
    yield "viewer firmware, .data and .bss", target, sections.get(".data", 0) + sections[".bss"], \
        "bytes"


def measure():
    for board in boards.DEVICES:
        yield from measure_board(board)
