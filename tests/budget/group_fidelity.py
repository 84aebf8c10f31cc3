"""How near the encoder comes to real reliefs: `yamabiko encode` on the windows in YB_DATA.

The figure is the RMSE of the smooth surface in standard deviations of the relief's heights, for a
whole file of at most so many bytes. Without the data nothing is measured.
"""

import concurrent.futures
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "host-release" / "bin" / "yamabiko"
SIZES = (100,)


def encode(window, size, folder):
    out = pathlib.Path(folder) / f"{window.stem}-{size}.yb"
    command = [PROGRAM, "encode", window, "-o", out, "--bytes", str(size), "--json"]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return json.loads(told)["nrmse"]


def measure():
    data = pathlib.Path(os.environ.get("YB_DATA", ROOT.parent / "shared" / "data"))
    windows = sorted((data / "windows").glob("*.tif"))
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        for size in SIZES if windows else ():
            found = list(pool.map(lambda window: encode(window, size, folder), windows))
            for window, nrmse in zip(windows, found):
                yield f"nrmse of {size} B", window.stem, f"{nrmse:.3f}", "std"
            yield f"nrmse of {size} B", "mean", f"{sum(found) / len(found):.4f}", "std"
