#!/usr/bin/env python3
"""Prints what has been measured against what it may cost.

    bench.py [--check] [--page FILE] [GROUP ...]

A line is group, name, target, value, unit, budget, separated by tabs; without a budget the last is
"-". A group is a module tests/budget/group_<name>.py whose measure() yields (name, target, value,
unit); a group that cannot measure all here has a function lacks() that says what it lacks, or None. The
budgets are in budgets.tsv; with --check the exit status is 1 if an enforced one is exceeded, or if an
enforced figure was not measured and nothing is lacking. With --page they are written as a page of
tables as well, in which other groups stay as they are: that is how docs/BENCHMARKS.md is made.
"""

import argparse
import importlib
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent

PAGE_HEAD = """# Benchmarks

Written by `scripts/bench --page docs/BENCHMARKS.md`, not by hand. Instructions are counted by a plugin
of QEMU: exact and repeatable, but instructions, not cycles. "Most" is the budget in
[tests/budget/budgets.tsv](../tests/budget/budgets.tsv), where there is one; **bold** is above it.
Frames are drawn on eight maps of the gallery (`boards.py`); the standard views are four orbits, two from the summit
and two on foot. `128x64-12k` and `320x240-32k` are all of it in so many KB, bands as tall as the map leaves
memory for; `rows8` are bands of 8 rows whatever the map. Fidelity is of codes made from the development windows, beside what ideal coders reach
that have no header (`tests/budget/group_fidelity.py` says more). Codes of 60 and 100 bytes are made at the
usual effort 5, those of 200 and 400 bytes at effort 3, with a ninth of its trials: more effort is worth more.

Panels: bytes over the wires in a slow turn round the maps, a degree a frame from the standard orbit, against
whole frames; a memory LCD takes whole lines only. "At the rated clock" is what the bus alone would carry.

Pc: frames a second by the CPU's time of one core of the machine that measured; unlike all other figures
they depend on it.

Relief: no code, but the contour lines of every development window at nine heights, a tenth of its relief
apart, in full detail. "yamabiko" is the smooth surface of the map of these lines, "tin" the plain
constrained Delaunay triangulation of the same points and the frame's corners, linear in each triangle,
"grass" r.surf.contour of GRASS on the same lines, made cells by v.to.rast. All are compared with the DEM
at its cells. *rmse*: of the height, in contour intervals. *Shares between contours*: how high between
one contour and the next do the cells lie, in 20 steps (Carrara's test; a surface with terraces has too
many cells at the contours' own heights); the sum of the differences from the DEM's own shares, 0 to 2.
"""


def table(lines):
    text = "| figure | target | value | unit | most |\n| --- | --- | ---: | --- | ---: |\n"
    for _, figure, target, value, unit, most in lines:
        shown = f"{int(value):,}" if str(value).isdigit() else str(value)
        if most != "-" and float(value) > float(most):
            shown = f"**{shown}**"
        text += f"| {figure} | {target} | {shown} | {unit} | {most} |\n"
    return text


def write_page(path, lines):
    """Tables of groups that were not measured now stay as they are."""
    path = pathlib.Path(path)
    old = path.read_text(encoding="utf-8").split("\n## ")[1:] if path.exists() else []
    tables = dict(part.rstrip().split("\n\n", 1) for part in old)
    for group in {line[0] for line in lines}:
        tables[group.capitalize()] = table(line for line in lines if line[0] == group).rstrip()
    page = PAGE_HEAD
    for name in sorted(tables):
        page += f"\n## {name}\n\n{tables[name]}\n"
    path.write_text(page, encoding="utf-8")


def read_budgets():
    """{(group, name, target): (most, enforced)}"""
    budgets = {}
    lines = (HERE / "budgets.tsv").read_text(encoding="utf-8").splitlines()
    for line in lines:
        if line and not line.startswith("#"):
            group, name, target, most, enforced = line.split("\t")
            if enforced not in ("yes", "no"):
                raise ValueError(f"budgets.tsv: {line!r}: enforced is yes or no")
            budgets[group, name, target] = (most, enforced == "yes")
    return budgets


def main():
    known = sorted(path.stem.removeprefix("group_") for path in HERE.glob("group_*.py"))
    parser = argparse.ArgumentParser(description="measured figures, one a line")
    parser.add_argument("--check", action="store_true", help="fail if a budget is exceeded")
    parser.add_argument("--page", metavar="FILE", help="write a page of tables too")
    parser.add_argument("group", nargs="*", help=f"of {', '.join(known)}; without: all")
    options = parser.parse_args()
    unknown = set(options.group) - set(known)
    if unknown:
        parser.error(f"no group {', '.join(sorted(unknown))}: there are {', '.join(known)}")

    budgets = read_budgets()
    broken = []
    chosen = options.group or known
    lines = []
    missing = {key for key, (_, enforced) in budgets.items() if enforced and key[0] in chosen}
    for group in chosen:
        module = importlib.import_module(f"group_{group}")
        lack = getattr(module, "lacks", lambda: None)()
        if lack:
            print(f"{group}: not all is measured: {lack}", file=sys.stderr)
            missing = {key for key in missing if key[0] != group}
        for name, target, value, unit in module.measure():
            most, enforced = budgets.get((group, name, target), ("-", False))
            print(group, name, target, value, unit, most, sep="\t", flush=True)
            lines.append((group, name, target, value, unit, most))
            missing.discard((group, name, target))
            if enforced and float(value) > float(most):
                broken.append(f"{group}: {name}, {target}: {value} {unit}, at most {most}")
    broken += [f"{', '.join(key)}: has a budget but was not measured" for key in sorted(missing)]
    if options.page:
        write_page(options.page, lines)
    if options.check:
        for line in broken:
            print(line, file=sys.stderr)
        return 1 if broken else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
