#!/usr/bin/env python3
"""Where the instructions of one region of the bench go, by function.

    where.py [--board lm3s6965evb] [--map MAP.yb] [--region "frame 128x64-12k orbit-45"]

A line a function: share of the region, instructions, name. What the compiler has inlined counts
for the function that it was inlined into.
"""

import argparse
import bisect
import pathlib
import sys
import tempfile

import boards


def functions(elf):
    """Sorted addresses of the functions, and their names."""
    lines = (line.split() for line in boards.tool("arm-none-eabi-nm", elf).splitlines())
    found = sorted((int(f[0], 16) & ~1, f[2]) for f in lines
                   if len(f) == 3 and f[1] in "tTwW" and not f[2].startswith("$"))
    return [address for address, _ in found], [name for _, name in found]


def profile(board, code, region):
    """{function: instructions} of a region."""
    names = list(boards.run_bench(board, code).regions)
    if region not in names:
        raise boards.MeasureError(f"no region {region!r}: there are {', '.join(names)}")
    addresses, owners = functions(boards.bench_elf(board))
    spent = {}
    with tempfile.NamedTemporaryFile("r") as file:
        boards.run_bench(board, code, f",profile={file.name},region={names.index(region)}")
        with open(file.name, encoding="ascii") as lines:
            for line in lines:
                address, count = line.split()
                owner = owners[bisect.bisect_right(addresses, int(address, 16)) - 1]
                spent[owner] = spent.get(owner, 0) + int(count)
    return spent


def main():
    parser = argparse.ArgumentParser(description="instructions of a region by function")
    parser.add_argument("--board", default="lm3s6965evb", choices=boards.TARGETS)
    parser.add_argument("--map", help="a code; without it the first that bench measures")
    parser.add_argument("--region", default="frame 128x64-12k orbit-45")
    options = parser.parse_args()
    try:
        code = pathlib.Path(options.map).read_bytes() if options.map else \
            next(iter(boards.maps().values()))
        spent = profile(options.board, code, options.region)
    except (boards.MeasureError, OSError) as error:
        print(f"where.py: {error}", file=sys.stderr)
        return 1
    whole = sum(spent.values())
    for name, count in sorted(spent.items(), key=lambda item: -item[1]):
        print(f"{100 * count / whole:5.1f} %{count:14}  {name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
