#!/usr/bin/env python3
"""Boots the handheld's firmware in QEMU and saves what its OLED shows.

    oled_shot.py --elf yamabiko-lm3s6965evb.elf --map map.yb -o oled.png [--azimuth-steps N]

The picture is a PNG of 128 x 64 pixels, 8-bit grey; its azimuth and hash are printed.
"""

import argparse
import sys

sys.dont_write_bytecode = True  # run by hand, it leaves nothing beside the sources

import emulator  # noqa: E402
import png  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description="a picture of the handheld's OLED, from QEMU")
    parser.add_argument("--elf", required=True, help="the firmware of lm3s6965evb")
    parser.add_argument("--map", help="a code for the map slot; without it the built-in map")
    parser.add_argument("-o", "--output", required=True, metavar="PNG")
    parser.add_argument("--azimuth-steps", type=int, default=0, metavar="N",
                        help="how far to turn, in 256ths of a turn")
    options = parser.parse_args()
    azimuth = options.azimuth_steps * emulator.STEP_BAM % emulator.TURN_BAM
    try:
        with emulator.Board("lm3s6965evb", options.elf, options.map) as board:
            frame = board.pause_at(azimuth)
            if options.map and " map=slot" not in board.greeting:
                raise emulator.BoardError(f"{options.map} was refused: {board.greeting}")
            rows = board.picture()
    except (emulator.BoardError, OSError) as error:
        print(f"oled_shot.py: {error}", file=sys.stderr)
        return 1
    png.write_grey(options.output, [bytes(level * 17 for level in row) for row in rows])
    print(f"azimuth={frame.azimuth_bam:05} hash={frame.hash}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
