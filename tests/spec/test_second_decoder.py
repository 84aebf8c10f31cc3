"""Does the second decoder make of codes what the engine makes of them?

    test_second_decoder.py DUMP_MESH CODE ...

Compares the codes of the files, each spoilt in every known way, then random ones (YB_SPEC_SEED,
YB_SPEC_COUNT).
"""

import collections
import os
import pathlib
import subprocess
import sys
import tempfile

import second_decoder


def records(program, words, codes=()):
    """What dump_mesh prints: for each code a dictionary of its lines. `codes`: for --lines."""
    text = subprocess.run([program, *map(str, words)], check=True, capture_output=True, text=True,
                          input="".join(code.hex() + "\n" for code in codes)).stdout
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


def differences(record, room=255):
    """Says what differs, one sentence each."""
    code = bytes.fromhex(record["code"])
    taken = len(code)
    try:
        found = second_decoder.decode(code, room)
    except second_decoder.Refused as refused:
        status, taken = str(refused), refused.after
    else:
        status = "ok"
    if status != record["status"]:
        yield f"status {status}, not {record['status']}"
        return
    if [(taken,)] != record["taken"]:
        yield f"{status} after {taken} bytes, not {record['taken']}"
    if status != "ok":
        return
    if [(found.cell, found.unit, found.base, found.seed)] != record["header"]:
        yield f"header {found.cell, found.unit, found.base, found.seed}, not {record['header']}"
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


def mended(code):
    return code + bytes([second_decoder.crc8(code)])


def spoilt(code):
    """The code with something wrong, and what a decoder must say of it."""
    yield "truncated", code[:-1]
    yield "truncated", code[:20]
    yield "corrupt", code[:-1] + bytes([code[-1] ^ 1])
    yield "corrupt", code + b"\0"
    yield "corrupt", mended(code[:1] + bytes([code[1] | 8]) + code[2:-1])
    yield "version", mended(b"\x10" + code[1:-1])
    crossing = bytes.fromhex(code.hex().replace("4040600018a00", "4040618a00628"))
    if crossing != code:  # the square of SPEC 1.6 has become a bow
        yield "corrupt", mended(crossing[:-1])
    found = second_decoder.decode(code)
    exact, added = len(found.vertex), len(found.vertex) > found.coded
    yield "ok", mended(code[:3] + bytes([exact]) + code[4:-1])
    yield "limit" if added else "corrupt", mended(code[:3] + bytes([exact - 1]) + code[4:-1])


def spoil(files, folder):
    """Writes the spoilt codes to files: what must be said, by the code's digits; and the files."""
    wanted, paths = {}, []
    for file in files:
        for status, code in spoilt(bytes.fromhex(pathlib.Path(file).read_text())):
            wanted[code.hex()] = status
            paths.append(pathlib.Path(folder, f"{len(paths)}.hex"))
            paths[-1].write_text(code.hex())
    return wanted, paths


def main():
    program, *files = sys.argv[1:]
    seed, count = (int(os.environ.get(f"YB_SPEC_{name}", default))
                   for name, default in (("SEED", "1"), ("COUNT", "1000")))
    statuses, wrong = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        wanted, paths = spoil(files, folder)
        for words in (files, paths, ("--random", seed, count)):
            for record in records(program, words):
                statuses[record["status"]] += 1
                found = list(differences(record))
                status = wanted.get(record["code"], record["status"])
                if status != record["status"]:
                    found.append(f"the engine says {record['status']}, SPEC {status}")
                if found:
                    wrong += 1
                    print(record["code"], *found[:8], sep="\n    ")
    print(", ".join(f"{n} {status}" for status, n in sorted(statuses.items())) + f"; {wrong} wrong")
    return 1 if wrong or statuses["ok"] < 2 * len(files) else 0


if __name__ == "__main__":
    sys.exit(main())
