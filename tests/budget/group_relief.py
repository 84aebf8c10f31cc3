"""How near a relief comes to the real one when it is rebuilt from contour lines alone, in full detail.

For every window in YB_DATA: the contour lines at nine heights, a tenth of the relief apart; from them
the surface of Yamabiko, smooth, and beside it a plain TIN of the same points and GRASS r.surf.contour
on the same lines; all compared with the DEM at its cells. docs/BENCHMARKS.md says what the figures
are. Without the data nothing is measured, without GRASS its figures are left out.
"""

import array
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "host-release" / "bin" / "rebuild_relief"
BINS = 20
GRASS = """
v.in.ogr -o --q input="$1/contours.gpkg" output=lines
g.region w=$2 s=$2 e=$3 n=$4 cols=$5 rows=$6
v.to.rast --q input=lines output=cells use=attr attribute_column=elevation type=line
r.surf.contour --q input=cells output=relief
r.out.bin --q -f input=relief output="$1/grass.f32" null=-9999
"""


def run_grass(folder, columns, rows, cell_m):
    half = cell_m / 2
    words = (folder, -half, columns * cell_m - half, rows * cell_m - half, columns, rows)
    subprocess.run(["grass", "--tmp-location", "XY", "--exec", "bash", "-ec", GRASS, "-",
                    *map(str, words)], check=True, capture_output=True)


def read_heights(path):
    heights = array.array("f")
    heights.frombytes(path.read_bytes())
    return heights


def shares(heights, low_m, interval_m):
    """Which share of the cells lies how high between one contour and the next, in BINS steps."""
    counts = [0] * BINS
    for height in heights:
        place = (height - low_m) / interval_m % 1
        counts[min(int(place * BINS), BINS - 1)] += 1
    return [count / len(heights) for count in counts]


def figures(heights, dem, low_m, interval_m):
    """RMSE in intervals, and how far the shares are from the DEM's own."""
    square = sum((a - b) ** 2 for a, b in zip(heights, dem)) / len(dem)
    own = shares(dem, low_m, interval_m)
    off = sum(abs(a - b) for a, b in zip(shares(heights, low_m, interval_m), own))
    return math.sqrt(square) / interval_m, off


def rebuild(window):
    """{surface: (rmse, shares)}, metres per interval"""
    with tempfile.TemporaryDirectory() as folder:
        told = subprocess.run([PROGRAM, window, folder], check=True, capture_output=True, text=True)
        columns, rows, cell_m, low_m, interval_m = map(float, told.stdout.split())
        names = ["yamabiko", "tin"]
        if shutil.which("grass"):
            run_grass(folder, int(columns), int(rows), cell_m)
            names.append("grass")
        place = pathlib.Path(folder)
        dem = read_heights(place / "dem.f32")
        return {name: figures(read_heights(place / f"{name}.f32"), dem, low_m, interval_m)
                for name in names}, interval_m


def measure():
    data = pathlib.Path(os.environ.get("YB_DATA", ROOT.parent / "shared" / "data"))
    windows = sorted((data / "windows").glob("*.tif"))
    if windows and not shutil.which("grass"):
        print("group relief: GRASS is missing, scripts/setup --bench installs it", file=sys.stderr)
    found = []
    for window in windows:
        surfaces, interval_m = rebuild(window)
        found.append(surfaces)
        for name, (rmse, off) in surfaces.items():
            yield f"rmse, {name}", window.stem, f"{rmse:.4f}", "intervals"
            yield f"rmse in metres, {name}", window.stem, f"{rmse * interval_m:.2f}", "m"
            yield f"shares between contours, {name}", window.stem, f"{off:.3f}", "off the DEM's"
    for name in found[0] if found else ():
        for k, (what, unit) in enumerate((("rmse", "intervals"),
                                          ("shares between contours", "off the DEM's"))):
            mean = sum(surfaces[name][k] for surfaces in found) / len(found)
            yield f"{what}, {name}", "mean", f"{mean:.4f}", unit
        if name != "yamabiko":
            lost = sum(surfaces["yamabiko"][0] >= surfaces[name][0] for surfaces in found)
            yield f"rmse not below that of {name}", "all windows", lost, "windows"
