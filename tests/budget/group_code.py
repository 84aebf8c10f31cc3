"""Bytes of code and constants: the engine as the linker finds it, and the viewer's firmware."""

import boards


def used(board, sizes):
    """Of the engine's sections what the viewer takes, which loads and draws: the linker drops the
    rest. Texts have no names of their own and count."""
    kept = {line.split()[-1] for line in
            boards.tool("arm-none-eabi-nm", boards.firmware_elf(board)).splitlines()}
    total = 0
    for section, size in sizes.items():
        _, kind, *name = section.split(".", 2)
        if kind in ("text", "rodata") and (name == [] or name[0] in kept or ".str" in section):
            total += size
    return total


def measure():
    for board in boards.DEVICES:
        target = boards.TARGETS[board]
        sizes = boards.section_sizes(boards.engine_archive(board))
        for what in (".text", ".rodata"):
            total = sum(size for name, size in sizes.items()
                        if name == what or name.startswith(what + "."))
            yield f"engine, {what}", target, total, "bytes"
        yield "engine, load and draw", target, used(board, sizes), "bytes"
        firmware = boards.section_sizes(boards.firmware_elf(board))
        yield "viewer firmware, flash", target, firmware[".text"] + firmware.get(".data", 0), \
            "bytes"
