#!/usr/bin/env python3
"""The golden meshes and frames, by every compiler there is, with and without optimisation.

    compilers.py [--update] BUILD_FOLDER

Each compiler's hashes must be those of golden.txt. Where they are not, the lines that differ are
printed and the frames written as pictures to BUILD_FOLDER. --update writes golden.txt anew: only
when the surface or the picture was meant to change, and after a look at the pictures.
"""
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
GOLDEN = HERE / "golden.txt"
COMPILERS = ("gcc -O0", "gcc -O2", "clang -O0", "clang -O2")


def run_with(compiler, folder):
    program = folder / ("golden-" + compiler.replace(" ", ""))
    sources = [HERE / "golden.c", ROOT / "host-tools" / "lib" / "standard_views.c",
               *sorted((ROOT / "engine" / "src").glob("*.c"))]
    includes = [ROOT / "engine" / "include", ROOT / "tests" / "support", ROOT / "host-tools" / "lib"]
    subprocess.run([*compiler.split(), "-std=c11", "-Wall", "-Wextra", "-Werror",
                    *(f"-I{path}" for path in includes), *sources, "-o", program], check=True)
    maps = sorted((ROOT / "maps").glob("*.yb"))
    run = subprocess.run([program, "-p", folder, *maps], check=True, stdout=subprocess.PIPE,
                         text=True)
    return run.stdout.splitlines()


def main():
    update = "--update" in sys.argv[1:]
    folder = pathlib.Path(sys.argv[-1])
    folder.mkdir(parents=True, exist_ok=True)
    wrong = False
    for compiler in COMPILERS:
        if shutil.which(compiler.split()[0]) is None:
            print(f"{compiler}: not run, there is no such compiler")
            continue
        lines = run_with(compiler, folder)
        if update:
            GOLDEN.write_text("\n".join(lines) + "\n")
            update = False
        expected = GOLDEN.read_text().splitlines()
        differ = sorted(set(lines) ^ set(expected))
        print(f"{compiler}: {len(lines)} hashes, {len(set(lines) - set(expected))} differ")
        for line in differ[:20]:
            print("  " + ("has    " if line in lines else "wanted ") + line)
        if differ:
            print(f"  pictures: {folder}/*.ppm")
        wrong = wrong or bool(differ)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
