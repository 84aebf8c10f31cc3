#!/usr/bin/env python3
"""What the engine asks of the rest of a program: symbols.py libyamabiko.a VIEWER.elf

Only mem* and the integer helpers that a Cortex-M0 lacks instructions for; no heap, no stdio, no
floating point. And what a whole program gets for that: no signed division of 64 bits, which is a
helper of its own.
"""

import re
import sys

import boards

ALLOWED = re.compile(r"""
    mem(cpy|move|set|cmp)
    | __aeabi_mem(cpy|move|set|clr)[48]?
    | __aeabi_(u?idiv|u?idivmod|u?ldivmod|lmul|llsl|llsr|lasr|lcmp|ulcmp)
    | __gnu_thumb1_case_(sqi|uqi|shi|uhi|si)
    | __clzsi2 | __clzdi2
""", re.VERBOSE)


def main():
    undefined = set()
    defined = set()
    for line in boards.tool("arm-none-eabi-nm", sys.argv[1]).splitlines():
        fields = line.split()
        if len(fields) >= 2 and fields[-2] == "U":
            undefined.add(fields[-1])
        elif len(fields) == 3:
            defined.add(fields[-1])
    if not any(name.startswith("yb_") for name in defined):
        print(f"{sys.argv[1]} defines nothing of the engine", file=sys.stderr)
        return 1
    outside = sorted(undefined - defined)
    forbidden = [name for name in outside if not ALLOWED.fullmatch(name)]
    print("asks for:", " ".join(outside) or "nothing")
    if forbidden:
        print("must not:", " ".join(forbidden), file=sys.stderr)
    signed = re.search(r"__aeabi_ldivmod", boards.tool("arm-none-eabi-nm", sys.argv[2]))
    if signed:
        print(f"{sys.argv[2]} divides signed numbers of 64 bits", file=sys.stderr)
    return 1 if forbidden or signed else 0


if __name__ == "__main__":
    sys.exit(main())
