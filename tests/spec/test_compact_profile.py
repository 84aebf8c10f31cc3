"""Does the second decoder make of compact codes what the engine makes of them?

    test_compact_profile.py DUMP_MESH DUMP_MESH_LARGE CODE ...

Random codes (YB_SPEC_SEED, YB_SPEC_COUNT), the same damaged with a check that fits, random bytes,
cut ones, and those of the files that are compact.
"""

import collections
import os
import pathlib
import random
import sys

import compact_writer
import second_decoder
from test_second_decoder import differences, mended, records

LARGE = 65535


def papers(program, seed, count):
    """Legal plans of the paper profile."""
    for record in records(program, ("--random", seed, count)):
        if record["status"] == "ok":
            yield second_decoder.read_code(second_decoder.Bytes(bytes.fromhex(record["code"])), 255)


def same_plan(plan, code):
    """Does the second decoder find what was written, or refuse it?"""
    try:
        found = second_decoder.read_code(second_decoder.Bytes(code), LARGE)
    except second_decoder.Refused:
        return True
    wanted = [line for line, _, _ in plan.lines] + [[place] for place, _ in sorted(
        plan.spots, key=lambda spot: spot[0][::-1])]
    wanted = [[(x * plan.spacing, y * plan.spacing) for x, y in line] for line in wanted]
    return wanted == [[found.points[v] for v in contour.points()] for contour in found.contours]


def damaged(code, rng):
    """Some bits flipped, or all bytes from one on replaced; the check fits."""
    wrong = bytearray(code[:-1])
    if rng.random() < 0.8:
        for _ in range(rng.choice((1, 1, 2))):
            wrong[rng.randrange(1, len(wrong))] ^= 1 << rng.randrange(8)
    else:
        at = rng.randrange(2, len(wrong))
        wrong[at:] = rng.randbytes(len(wrong) - at)
    return mended(bytes(wrong))


def random_bytes(rng):
    return mended(b"\x21" + rng.randbytes(rng.randrange(60)))


def main():
    program, large, *files = sys.argv[1:]
    seed, count = (int(os.environ.get(f"YB_SPEC_{name}", default))
                   for name, default in (("SEED", "1"), ("COUNT", "250")))
    rng = random.Random(seed)
    written = [compact_writer.random_code(paper, rng) for paper in papers(program, seed, count)]
    wide = [compact_writer.random_code(paper, rng, most_class=15)
            for paper in papers(program, seed, count // 4)]
    wrong = sum(not same_plan(*pair) for pair in written + wide)
    codes = [code for _, code in written]
    codes += [code for code in (pathlib.Path(file).read_bytes() for file in files)
              if code[0] == 0x21]
    spoilt = [damaged(code, rng) for code in codes for _ in range(3)]
    spoilt += [random_bytes(rng) for _ in range(2 * count)]
    spoilt += [code[:size] for code in codes[:10] for size in range(1, len(code))]
    statuses = collections.Counter()
    for room, which, those in ((255, program, codes), (255, program, spoilt),
                               (LARGE, large, [code for _, code in wide])):
        for record in records(which, ("--lines",), those):
            statuses[record["status"]] += 1
            found = list(differences(record, room))
            if found:
                wrong += 1
                print(record["code"], *found[:8], sep="\n    ")
    print(", ".join(f"{n} {status}" for status, n in sorted(statuses.items())) + f"; {wrong} wrong")
    return 1 if wrong or statuses["ok"] < count // 2 else 0


if __name__ == "__main__":
    sys.exit(main())
