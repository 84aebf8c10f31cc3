"""Runs the bench firmware of a board under QEMU with the counting plugin, and reads the toolchain's
tools: what the measuring groups share.

The environment may name YB_FIRMWARE (the folder that holds a build folder per board) and YB_COUNT
(the plugin); else they are where the presets build them.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "qemu"))

import emulator  # noqa: E402

FIRMWARE = pathlib.Path(os.environ.get("YB_FIRMWARE", ROOT / "build"))
PLUGIN = os.environ.get("YB_COUNT", str(ROOT / "build/host-release/tests/budget/libyb_count.so"))

# The boards that are measured, and the name their figures go under.
TARGETS = {"lm3s6965evb": "cortex-m3", "microbit": "cortex-m0", "mps2-an385": "cortex-m3-4mb"}
# Those of them that a program is written for; the other has RAM for what they cannot hold.
DEVICES = ("lm3s6965evb", "microbit")

PATIENCE_S = 120


class MeasureError(Exception):
    """A figure could not be had."""


def bench_elf(board, program="bench"):
    return FIRMWARE / board / "bin" / f"{program}-{board}.elf"


def firmware_elf(board):
    return FIRMWARE / board / "bin" / f"yamabiko-{board}.elf"


def engine_archive(board):
    return FIRMWARE / board / "engine" / "libyamabiko.a"


def tool(*command):
    """What a command prints; its failure is ours."""
    try:
        return subprocess.run([str(word) for word in command], check=True, text=True,
                              capture_output=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise MeasureError(f"{command[0]}: {getattr(error, 'stderr', None) or error}") from error


def symbol_addresses(elf):
    lines = (line.split() for line in tool("arm-none-eabi-nm", elf).splitlines())
    return {fields[2]: int(fields[0], 16) for fields in lines if len(fields) == 3}


def section_sizes(path):
    """Bytes by section name, summed over an archive's members."""
    sizes = {}
    for line in tool("arm-none-eabi-size", "-A", path).splitlines():
        fields = line.split()
        if len(fields) == 3 and fields[0].startswith("."):
            sizes[fields[0]] = sizes.get(fields[0], 0) + int(fields[1])
    return sizes


def member_sizes(archive):
    """{file: {section: bytes}} of an archive; border.c.obj is "border"."""
    files = {}
    sizes = {}
    for line in tool("arm-none-eabi-size", "-A", archive).splitlines():
        fields = line.split()
        if "(ex" in fields:
            sizes = files[fields[0].split(".")[0]] = {}
        elif len(fields) == 3 and fields[0].startswith("."):
            sizes[fields[0]] = sizes.get(fields[0], 0) + int(fields[1])
    return files


class Run:
    """One run of the bench firmware: regions (instructions), sizes and stack (bytes), by name."""

    def __init__(self):
        self.regions = {}
        self.sizes = {}
        self.stack = {}
        self.error = None


def _command(board, elf, code_path, counts_path, more):
    symbols = symbol_addresses(elf)
    return [
        "qemu-system-arm", "-M", board, "-kernel", str(elf), "-nodefaults", "-display", "none",
        "-serial", "stdio", "-semihosting-config", "enable=on,target=native",
        "-device", f"loader,file={code_path},addr={emulator.SLOT_ADDRESS:#x},force-raw=on",
        "-plugin", f"{PLUGIN},begin={symbols['yb_mark_begin']:#x},"
                   f"end={symbols['yb_mark_end']:#x},out={counts_path}{more}",
    ]


def _read(run, console, counts):
    names = []
    for line in console.splitlines():
        word, _, rest = line.partition(" ")
        if word == "region":
            names.append(rest)
        elif word in ("size", "stack"):
            name, _, value = rest.rpartition(" ")
            (run.sizes if word == "size" else run.stack)[name] = int(value)
        elif word == "error":
            run.error = rest
    if not console.endswith("done\r\n") or len(names) != len(counts):
        raise MeasureError(f"the bench firmware stopped early: {console[-200:]!r}, "
                           f"{len(names)} regions, {len(counts)} counts")
    run.regions = {name: count - counts[0] for name, count in zip(names, counts)}


def run_bench(board, code, more="", program="bench"):
    """Runs the bench of a board with the code (bytes) in the map slot; `more`: plugin options."""
    run = Run()
    with tempfile.TemporaryDirectory(prefix="yamabiko-bench-") as folder:
        code_path = os.path.join(folder, "map.yb")
        counts_path = os.path.join(folder, "counts")
        with open(code_path, "wb") as file:
            file.write(code)
        command = _command(board, bench_elf(board, program), code_path, counts_path, more)
        try:
            result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True,
                                    timeout=PATIENCE_S, check=False)
        except subprocess.TimeoutExpired as error:
            raise MeasureError(f"the bench firmware of {board} does not end") from error
        if result.returncode != 0:
            raise MeasureError(f"QEMU: {result.stderr.decode(errors='replace')}")
        with open(counts_path, encoding="ascii") as file:
            counts = [int(line) for line in file]
        _read(run, result.stdout.decode("ascii"), counts)
    return run


# Of the gallery: single mountains, a range, gorges. All of it would take a quarter of an hour.
MEASURED = ("adams", "big_butte", "faial", "fuji", "lost_river", "mauna_kea", "maunga_whau",
            "solukhumbu")


def maps():
    """The codes that are measured, by name."""
    return {name: (ROOT / "maps" / f"{name}.yb").read_bytes() for name in MEASURED}


_runs = {}


def run_map(board, name, code):
    """run_bench, once per board and name."""
    if (board, name) not in _runs:
        run = run_bench(board, code)
        if run.error:
            raise MeasureError(f"{board} refuses the code {name}: {run.error}")
        _runs[board, name] = run
    return _runs[board, name]
