"""Does the second decoder make of codes what the engine makes of them?

    test_second_decoder.py DUMP_MESH CODE ...

Compares the codes of the files, then random ones (YB_SPEC_SEED, YB_SPEC_COUNT).
"""

import collections
import os
import subprocess
import sys

import second_decoder


def records(program, words):
    """What dump_mesh prints: for each code a dictionary of its lines."""
    text = subprocess.run([program, *map(str, words)], check=True, capture_output=True,
                          text=True).stdout
    record = collections.defaultdict(list)
    for line in text.splitlines():
        what, *rest = line.split()
        if what == "end":
            yield record
            record = collections.defaultdict(list)
        elif what in ("code", "status"):
            record[what] = rest[0]
        else:
            record[what].append(tuple(map(int, rest)))


def turned(corners):
    """A triangle from its lowest number on."""
    k = corners.index(min(corners))
    return corners[k:] + corners[:k]


def differences(record):
    """Says what differs, one sentence each."""
    try:
        found = second_decoder.decode(bytes.fromhex(record["code"]))
    except second_decoder.Refused as refused:
        status = str(refused)
    else:
        status = "ok"
    if status != record["status"]:
        yield f"status {status}, not {record['status']}"
        return
    if status != "ok":
        return
    if len(found.vertex) != len(record["vertex"]):
        yield f"{len(found.vertex)} vertices, not {len(record['vertex'])}"
    for k, (mine, its) in enumerate(zip(found.vertex, record["vertex"])):
        if mine != its:
            yield f"vertex {k} {mine}, not {its}"
    mine, its = ({turned(t) for t in ts} for ts in (found.triangle, record["triangle"]))
    if mine != its:
        yield f"triangles {sorted(mine - its)}, not {sorted(its - mine)}"
        return
    if found.scale != list(record["noise"][0]):
        yield f"noise {found.scale}, not {record['noise'][0]}"
    for x, y, *its in record["height"]:
        mine = [found.height(x, y), found.height(x, y, detail=False)]
        if mine != its:
            yield f"height at ({x}, {y}) {mine}, not {its}"


def main():
    program, *files = sys.argv[1:]
    seed, count = (int(os.environ.get(f"YB_SPEC_{name}", default))
                   for name, default in (("SEED", "1"), ("COUNT", "400")))
    statuses, wrong = collections.Counter(), 0
    for words in (files, ("--random", seed, count)):
        for record in records(program, words):
            statuses[record["status"]] += 1
            found = list(differences(record))
            if found:
                wrong += 1
                print(record["code"], *found[:8], sep="\n    ")
    print(", ".join(f"{n} {status}" for status, n in sorted(statuses.items())) + f"; {wrong} wrong")
    return 1 if wrong or statuses["ok"] < len(files) else 0


if __name__ == "__main__":
    sys.exit(main())
