"""How near the encoder comes to real reliefs: `yamabiko encode` on the windows in YB_DATA.

*nrmse* is the RMSE of the smooth surface in standard deviations of the relief's heights, for a
whole file of at most so many bytes; beside it what ideal coders reach (BASELINES.tsv). Windows not
below greedy TIN, the B-spline and the DCT line are counted. 200 and 400 bytes are searched at effort 3,
a ninth of the usual trials, which take two to seven times as long there, and for meshes of up to 1000
vertices, which only the PC holds.
*k* is the similarity of the contours with the fractal detail on, of codes made by --target-k.
*compact against paper* is what the gallery's codes take against the same contours in the paper
profile, which would need even more where steps are long.

Without the data only the last is measured.
"""

import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("YB_DATA", ROOT.parent / "shared" / "data"))
WINDOWS = DATA / "windows"
PROGRAM = ROOT / "build" / "host-release" / "bin" / "yamabiko"
SIZES = {60: (), 100: (), 200: ("--effort", "3", "--vertices", "1000"),
         400: ("--effort", "3", "--vertices", "1000")}
LINES = ("dct", "bspline", "tin")
SINGLE = ("fuji", "adams", "mauna_kea", "faial", "big_butte", "maunga_whau")
K_BYTES = 104
WANTED_K = 0.8


def tell(verb, *arguments):
    run = subprocess.run([PROGRAM, verb, *map(str, arguments), "--json"], check=True,
                         capture_output=True, text=True)
    return json.loads(run.stdout)


def baselines():
    with open(DATA / "BASELINES.tsv", encoding="utf-8") as file:
        return {row["window"]: row for row in csv.DictReader(file, delimiter="\t")}


def errors(windows, lines, size, options, folder, pool):
    def encode(window):
        out = pathlib.Path(folder) / f"{window.stem}-{size}.yb"
        return tell("encode", window, "-o", out, "--bytes", size, *options)["nrmse"]

    found = list(pool.map(encode, windows))
    name = f"nrmse of {size} B"
    for window, nrmse in zip(windows, found):
        yield name, window.stem, f"{nrmse:.3f}", "std"
        for line in LINES:
            yield f"{name}, {line}", window.stem, lines[window.stem][f"{line}_{size}B"], "std"
    yield name, "mean", f"{sum(found) / len(found):.4f}", "std"
    for line in LINES:
        values = [float(lines[window.stem][f"{line}_{size}B"]) for window in windows]
        yield f"{name}, {line}", "mean", f"{sum(values) / len(values):.4f}", "std"
        above = sum(nrmse >= value for nrmse, value in zip(found, values))
        yield f"nrmse of {size} B not below that of {line}", "all windows", above, "windows"


def similarity(folder, pool):
    def measure(name):
        window = WINDOWS / f"{name}.tif"
        out = pathlib.Path(folder) / f"{name}-k.yb"
        tell("encode", window, "-o", out, "--bytes", K_BYTES, "--target-k", WANTED_K)
        return tell("evaluate", out, window)

    below = 0
    for name, told in zip(SINGLE, pool.map(measure, SINGLE)):
        below += told["k"] < WANTED_K
        yield "k", name, f"{told['k']:.3f}", "K"
        yield "k, bytes", name, told["bytes"], "B"
        yield "k, nrmse", name, f"{told['smooth']['nrmse']:.3f}", "std"
        yield "k, slope", name, f"{told['detail']['slope_deg']:.2f}", "degrees"
        yield "k, spectrum", name, f"{told['spectrum']['detail']:.3f}", "octaves"
    yield f"k below {WANTED_K}", "single mountains", below, "windows"


def encoding_time(folder):
    """CPU seconds of one encoding at default effort: what it takes on one core."""
    before = os.times().children_user
    tell("encode", WINDOWS / "fuji.tif", "-o", pathlib.Path(folder) / "time.yb")
    yield "time of 100 B, one core", "fuji", f"{os.times().children_user - before:.0f}", "s"


def against_paper():
    shares = []
    for code in sorted((ROOT / "maps").glob("*.yb")):
        told = tell("info", code)
        if told["profile"] == "compact":
            shares.append(told["bytes"] / told["paper_bytes"])
    if shares:
        yield "compact against paper", "mean of the maps", f"{sum(shares) / len(shares):.3f}", "of bytes"


def lacks():
    if not any(WINDOWS.glob("*.tif")):
        return f"there are no relief windows in {WINDOWS}: set YB_DATA"
    return None


def measure():
    yield from against_paper()
    windows = sorted(WINDOWS.glob("*.tif"))
    if not windows:
        return
    lines = baselines()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        yield from encoding_time(folder)
        for size, options in SIZES.items():
            yield from errors(windows, lines, size, options, folder, pool)
        yield from similarity(folder, pool)
