"""Bytes of code and constants: the engine as the linker finds it, and the viewer's firmware."""

import boards


# What loads a code; some of fix.c and relief.c is there for what draws.
LOADING = ("border", "code", "compact", "fix", "links", "mesh", "paper", "regions", "relief",
           "saddles", "skeleton", "summits", "triangulate")


def used(board, only=None):
    """Of the engine's sections what the viewer takes, which loads and draws: the linker drops the
    rest. Texts have no names of their own and count. `only`: of these files."""
    kept = {line.split()[-1] for line in
            boards.tool("arm-none-eabi-nm", boards.firmware_elf(board)).splitlines()}
    total = 0
    for file, sizes in boards.member_sizes(boards.engine_archive(board)).items():
        for section, size in sizes.items():
            _, kind, *name = section.split(".", 2)
            if kind in ("text", "rodata") and (only is None or file in only) and \
                    (name == [] or name[0] in kept or ".str" in section):
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
        yield "engine, load and draw", target, used(board), "bytes"
        yield "engine, load", target, used(board, LOADING), "bytes"
        firmware = boards.section_sizes(boards.firmware_elf(board))
        yield "viewer firmware, flash", target, firmware[".text"] + firmware.get(".data", 0), \
            "bytes"
