"""What the engine and the firmware's app may not contain: a heap, printing, floating point, and any
header but the four of the freestanding kind (and, in the app, those of our own modules)."""
import pathlib
import re
import sys

WORDS = re.compile(
    r"\b(malloc|calloc|realloc|free|alloca|\w*printf|puts|putchar|assert|float|double|setjmp|longjmp"
    r")\b"
)
INCLUDE = re.compile(r'#\s*include\s*([<"][^>"]+[>"])')
SYSTEM = {"<stdint.h>", "<stddef.h>", "<stdbool.h>", "<string.h>"}


def code_of(text: str) -> str:
    """The text without comments and strings; line numbers stay."""
    def blank(match: re.Match) -> str:
        return re.sub(r"[^\n]", " ", match.group())

    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def faults_in(path: pathlib.Path, own: set[str]) -> list[str]:
    text = path.read_text(encoding="utf-8")
    bare = code_of(text)
    faults = [
        f"{path}:{bare.count(chr(10), 0, match.start()) + 1}: {match.group()}"
        for match in WORDS.finditer(bare)
    ]
    for match in INCLUDE.finditer(text):
        name = match.group(1)
        ours = name.startswith('"') or name.startswith("<yamabiko/") or name[1:-1] in own
        if name not in SYSTEM and not ours:
            faults.append(f"{path}: includes {name}")
    return faults


def main(folders: list[str]) -> int:
    files = [
        path
        for folder in folders
        for path in sorted(pathlib.Path(folder).rglob("*"))
        if path.suffix in (".c", ".h")
    ]
    if not files:
        print("no sources in", *folders)
        return 1
    own = {path.name for path in files}
    faults = [fault for path in files for fault in faults_in(path, own)]
    for fault in faults:
        print(fault)
    print(f"{len(files)} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
