#!/usr/bin/env python3
"""tidy.py BUILD FOLDER: clang-tidy on the C files of FOLDER, as BUILD compiles them.

A file that was good is not looked at again until it, a header of it, the rules or clang-tidy
change: its preprocessed text is remembered in BUILD/tidy. Assertions are on, whatever the build:
they tell clang-tidy what cannot be.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys


def output_of(command, folder=None):
    return subprocess.run(command, cwd=folder, capture_output=True, check=True).stdout


def fingerprint(entry, rules):
    """Of all that clang-tidy will read. Line markers stay in: messages name lines."""
    arguments = shlex.split(entry["command"])
    while os.path.basename(arguments[0]) in ("ccache", "distcc"):
        del arguments[0]
    place = arguments.index("-o")
    del arguments[place:place + 2]
    arguments = [a for a in arguments if a != "-c"] + ["-UNDEBUG", "-E", "-C"]
    return hashlib.sha256(rules + output_of(arguments, entry["directory"])).hexdigest()


def look(build, entry, rules):
    """What clang-tidy has against a file; nothing if all is well."""
    stamp = build / "tidy" / fingerprint(entry, rules)
    if stamp.exists():
        return ""
    result = subprocess.run(["clang-tidy", "--quiet", "--extra-arg=-UNDEBUG", "-p", str(build),
                             entry["file"]],
                            capture_output=True, text=True, check=False)
    if result.returncode == 0 and not result.stdout.strip():
        stamp.touch()
        return ""
    return result.stdout + (result.stderr if result.returncode else "")


def main(build, folder):
    root = pathlib.Path(__file__).resolve().parents[2]
    database = json.loads((build / "compile_commands.json").read_text())
    # A file that is compiled more than once (the engine, for two limits) is looked at as it is first.
    first = {e["file"]: e for e in reversed(database)}
    entries = [e for e in first.values() if (root / folder) in pathlib.Path(e["file"]).parents]
    if not entries and any((root / folder).rglob("*.c")):
        print(f"tidy.py: {build} compiles nothing of {folder}", file=sys.stderr)
        return 1
    (build / "tidy").mkdir(exist_ok=True)
    rules = (root / ".clang-tidy").read_bytes() + output_of(["clang-tidy", "--version"])
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        complaints = list(pool.map(lambda entry: look(build, entry, rules), entries))
    bad = [text for text in complaints if text]
    print("\n".join(bad), end="")
    print(f"{len(entries)} files of {folder}, {len(bad)} with faults")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]))
