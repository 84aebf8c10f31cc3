"""A board in QEMU: its console, its monitor and, where it has one, the picture on its display.

    with Board("lm3s6965evb", elf, slot="map.yb") as board:
        print(board.greeting)
        frame = board.pause_at(512)
        rows = board.picture()

Console and monitor are socket pairs handed to QEMU: nothing to name, nothing to wait for.
"""

import json
import os
import re
import socket
import subprocess
import tempfile
import time

SLOT_ADDRESS = 0x3F000
PATIENCE_S = 30
STEP_BAM = 256
STRIDE_STEPS = 16
TURN_BAM = 65536

FRAME = re.compile(r"(paused|frame) azimuth=(\d{5}) hash=([0-9a-f]{8})")


class BoardError(Exception):
    """The board did not do what it must."""


class Frame:
    """What the console says of a frame."""

    def __init__(self, line):
        match = FRAME.fullmatch(line)
        if not match:
            raise BoardError(f"the board said {line!r} instead of a frame")
        self.paused = match[1] == "paused"
        self.azimuth_bam = int(match[2])
        self.hash = match[3]


class Monitor:
    """QEMU's machine protocol, over a connected socket."""

    def __init__(self, connection):
        self.connection = connection
        self.lines = connection.makefile("rw", encoding="utf-8", newline="\n")
        self._receive()  # the greeting
        self.execute("qmp_capabilities")

    def _receive(self):
        line = self.lines.readline()
        if not line:
            raise BoardError("QEMU has gone")
        return json.loads(line)

    def close(self):
        self.lines.close()
        self.connection.close()

    def execute(self, command, **arguments):
        self.lines.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.lines.flush()
        while True:
            answer = self._receive()
            if "error" in answer:
                raise BoardError(f"{command}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]


class Board:
    """QEMU running `elf` on `machine`; `slot` is a code's file, or its bytes, or None."""

    def __init__(self, machine, elf, slot=None):
        self.folder = tempfile.TemporaryDirectory(prefix="yamabiko-qemu-")
        self.errors = open(self._file("stderr"), "w+b")
        console, console_far = socket.socketpair()
        monitor, monitor_far = socket.socketpair()
        command = [
            "qemu-system-arm", "-M", machine, "-kernel", elf, "-nodefaults", "-display", "none",
            "-chardev", f"socket,id=console,fd={console_far.fileno()}",
            "-serial", "chardev:console",
            "-chardev", f"socket,id=monitor,fd={monitor_far.fileno()}",
            "-mon", "chardev=monitor,mode=control",
        ]
        if slot is not None:
            command += ["-device", f"loader,file={self._slot_file(slot)},"
                                   f"addr={SLOT_ADDRESS:#x},force-raw=on"]
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=self.errors, stderr=self.errors,
            pass_fds=(console_far.fileno(), monitor_far.fileno()))
        console_far.close()
        monitor_far.close()
        console.settimeout(PATIENCE_S)
        monitor.settimeout(PATIENCE_S)
        self.console = console
        self.monitor = None
        self.console_lines = console.makefile("r", encoding="ascii", newline="\r\n")
        try:
            self.monitor = Monitor(monitor)
            self.greeting = self.line()
        except BaseException as error:
            message = self.stderr()
            self.close()
            raise BoardError(f"{machine} did not start ({error}): {message}") from error

    def _file(self, name):
        return os.path.join(self.folder.name, name)

    def _slot_file(self, slot):
        if not isinstance(slot, bytes):
            return slot
        with open(self._file("slot.yb"), "wb") as file:
            file.write(slot)
        return self._file("slot.yb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.process.kill()
        self.process.wait()
        if self.monitor:
            self.monitor.close()
        self.console_lines.close()
        self.console.close()
        self.errors.close()
        self.folder.cleanup()

    def stderr(self):
        """All that QEMU has said so far."""
        with open(self._file("stderr"), encoding="utf-8", errors="replace") as file:
            return file.read()

    def line(self):
        line = self.console_lines.readline()
        if not line:
            raise BoardError("the console was closed")
        return line.removesuffix("\r\n")

    def send(self, command):
        self.console.sendall(command.encode("ascii"))
        # QEMU looks whether a UART takes characters only when its main loop comes by, which it did
        # before the guest started its receiver, and may not again: any request wakes it.
        self.monitor.execute("query-status")

    def pause(self):
        """Holds the turntable still; frames drawn until then may still be told before."""
        self.send("p")
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            frame = Frame(self.line())
            if frame.paused:
                return frame
        raise BoardError("the board does not pause")

    def next(self, steps=1):
        """While paused: the next frame, or the one 16 steps on."""
        self.send({1: "n", STRIDE_STEPS: "N"}[steps])
        return Frame(self.line())

    def look(self, key):
        """While paused: the frame with shadows (s) or contour lines (l) turned on or off."""
        self.send(key)
        return Frame(self.line())

    def pause_at(self, azimuth_bam):
        """Turns until the frame of that azimuth is on the display."""
        frame = self.pause()
        for _ in range(2 * STRIDE_STEPS + 2):
            left = (azimuth_bam - frame.azimuth_bam) % TURN_BAM // STEP_BAM
            if left == 0:
                return frame
            frame = self.next(STRIDE_STEPS if left >= STRIDE_STEPS else 1)
        raise BoardError(f"turning did not reach azimuth {azimuth_bam}")

    def picture(self, width=128, height=64, zoom=4):
        """The display's pixels, levels 0 to 15, a bytes object per row."""
        path = self._file("screen.ppm")
        self.monitor.execute("screendump", filename=path)
        with open(path, "rb") as file:
            magic, size, maximum, pixels = file.read().split(b"\n", 3)
        expected = f"{width * zoom} {height * zoom}".encode()
        if (magic, size, maximum) != (b"P6", expected, b"255"):
            raise BoardError(f"the screen is {magic} {size} {maximum}, not {expected}")
        return [_level_row(pixels, width, zoom, y) for y in range(height)]


def _level_row(pixels, width, zoom, y):
    """One row of the display from `zoom` equal rows of the screen, every level a grey of its own."""
    pitch = width * zoom * 3
    first = pixels[y * zoom * pitch:][:pitch]
    for copy in range(1, zoom):
        if pixels[(y * zoom + copy) * pitch:][:pitch] != first:
            raise BoardError(f"row {y} of the display is not made of equal rows")
    row = bytearray()
    for x in range(width):
        block = first[x * zoom * 3:][:zoom * 3]
        if block != block[:1] * len(block) or block[0] % 17 != 0:
            raise BoardError(f"pixel {x}, {y} of the display is not one grey of 16")
        row.append(block[0] // 17)
    return bytes(row)
