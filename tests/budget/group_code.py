"""Bytes of code and constants: the engine as the linker finds it, and the viewer's firmware."""

import boards


def measure():
    for board in boards.DEVICES:
        target = boards.TARGETS[board]
        sizes = boards.section_sizes(boards.engine_archive(board))
        for what in (".text", ".rodata"):
            total = sum(size for name, size in sizes.items()
                        if name == what or name.startswith(what + "."))
            yield f"engine, {what}", target, total, "bytes"
        total = sum(size for name, size in sizes.items()
                    if name.split(".")[1] in ("text", "rodata"))
        yield "engine, load and draw", target, total, "bytes"
        firmware = boards.section_sizes(boards.firmware_elf(board))
        yield "viewer firmware, flash", target, firmware[".text"] + firmware.get(".data", 0), \
            "bytes"
