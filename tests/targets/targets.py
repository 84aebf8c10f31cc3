"""The golden frames on every processor: runs golden-<board> in its emulator and reads what it says.

The environment may name YB_FIRMWARE (the folder that holds a build folder per board) and YB_COUNT
(the plugin that counts instructions); else they are where the presets build them.
"""

import os
import pathlib
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIRMWARE = pathlib.Path(os.environ.get("YB_FIRMWARE", ROOT / "build"))
PLUGIN = os.environ.get("YB_COUNT", str(ROOT / "build/host-release/tests/budget/libyb_count.so"))
PATIENCE_S = 240

_BARE = ("-nodefaults", "-display", "none", "-serial", "stdio")


def _arm(board):
    return ("qemu-system-arm", "-M", board, *_BARE, "-kernel"), "arm-none-eabi-nm"


# By board: the name its figures go under; the emulator, to be followed by the program; nm.
TARGETS = {
    "microbit": ("cortex-m0", *_arm("microbit")),
    "lm3s6965evb": ("cortex-m3", *_arm("lm3s6965evb")),
    "mps2-an386": ("cortex-m4", *_arm("mps2-an386")),
    "mps2-an500": ("cortex-m7", *_arm("mps2-an500")),
    "sifive_e": ("rv32imac", ("qemu-system-riscv32", "-M", "sifive_e", *_BARE, "-kernel"),
                 "riscv64-unknown-elf-nm"),
    "mega2560": ("atmega2560", ("qemu-system-avr", "-M", "mega2560", *_BARE, "-bios"), "avr-nm"),
    "powerpc": ("powerpc", ("qemu-ppc",), "powerpc-linux-gnu-nm"),
}


class TargetError(Exception):
    """A program did not do what it must."""


class Run:
    """What a program said: hashes {"code what": hash} in their order, sizes and stack in bytes, and
    the instructions that each hash's mesh or frame took (if they were counted)."""

    def __init__(self):
        self.hashes = {}
        self.instructions = {}
        self.sizes = {}
        self.stack = {}


def elf(board):
    return FIRMWARE / board / "bin" / f"golden-{board}.elf"


def _plugin(board, counts_path):
    nm = subprocess.run([TARGETS[board][2], elf(board)], check=True, capture_output=True, text=True)
    at = {fields[2]: int(fields[0], 16)
          for fields in (line.split() for line in nm.stdout.splitlines()) if len(fields) == 3}
    return ("-plugin", f"{PLUGIN},begin={at['yb_mark_begin']:#x},end={at['yb_mark_end']:#x},"
                       f"out={counts_path}")


def _console(command):
    """The lines up to "done"; most emulators do not end by themselves."""
    lines = []
    deadline = time.monotonic() + PATIENCE_S
    with tempfile.TemporaryFile() as errors, \
            subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=errors, text=True, encoding="ascii") as process:
        try:
            for line in process.stdout:
                lines.append(line.rstrip("\r\n"))
                if lines[-1] == "done" or time.monotonic() > deadline:
                    break
        finally:
            process.kill()
        if not lines or lines[-1] != "done":
            errors.seek(0)
            raise TargetError(f"{command[0]} stopped early: {lines[-3:]}, {errors.read()[-500:]}")
    return lines[:-1]


def run(board, counted=False):
    found = Run()
    with tempfile.TemporaryDirectory(prefix="yamabiko-targets-") as folder:
        counts_path = os.path.join(folder, "counts")
        emulator = list(TARGETS[board][1])
        if counted:
            emulator[1:1] = _plugin(board, counts_path)
        for line in _console([*emulator, str(elf(board))]):
            words = line.split(" ")
            if words[0] in ("size", "stack"):
                (found.sizes if words[0] == "size" else found.stack)[words[1]] = int(words[2])
            elif len(words) == 3:
                found.hashes[f"{words[0]} {words[1]}"] = words[2]
            else:
                raise TargetError(f"{board} said {line!r}")
        if counted:
            with open(counts_path, encoding="ascii") as file:
                counts = [int(line) for line in file]
            if len(counts) != len(found.hashes):
                raise TargetError(f"{board}: {len(counts)} counts of {len(found.hashes)} hashes")
            found.instructions = dict(zip(found.hashes, counts))
    return found
