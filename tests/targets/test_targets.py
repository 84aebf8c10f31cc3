#!/usr/bin/env python3
"""test_targets.py BOARD: what golden-<board> draws is, to the pixel, what the PC draws."""

import pathlib
import sys

import targets

VIEWS = ("orbit", "above", "down", "flood", "foot", "feet")


def main():
    board = sys.argv[1]
    golden = (targets.ROOT / "tests/golden/expected.txt").read_text(encoding="ascii").splitlines()
    expected = dict(line.rsplit(" ", 1) for line in golden)
    found = targets.run(board).hashes
    wrong = [name for name in found if expected.get(name) != found[name]]
    for name in wrong:
        print(f"{board}: {name} is {found[name]}, on the PC {expected.get(name)}", file=sys.stderr)
    # Nothing left out: of each code the mesh and all views.
    codes = {name.split(" ")[0] for name in found}
    missing = [f"{code} {what}" for code in sorted(codes)
               for what in ("mesh", *(f"{view}-128x64" for view in VIEWS))
               if f"{code} {what}" not in found]
    if missing or len(codes) < 4:
        print(f"{board}: {len(codes)} codes; not drawn: {missing}", file=sys.stderr)
    print(f"{board}: {len(found)} hashes of {len(codes)} codes, {len(wrong)} differ")
    return 1 if wrong or missing or len(codes) < 4 else 0


if __name__ == "__main__":
    sys.exit(main())
