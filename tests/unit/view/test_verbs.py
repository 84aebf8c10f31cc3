"""The verbs that draw and measure, as a user runs them: files, exit codes, sentences."""

import json
import math
import math
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

import paper_code

YAMABIKO = os.environ["YAMABIKO"]


def run(*words, stdin=None):
    return subprocess.run([YAMABIKO, *map(str, words)], input=stdin, capture_output=True,
                          timeout=300, check=False)


def png_pixels(data):
    """Width, height, channels and rows of an 8-bit PNG without interlacing."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
            assert depth == 8
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    channels = {0: 1, 2: 3}[colour]
    raw, pitch, rows = zlib.decompress(packed), width * channels, []
    before = bytes(pitch)
    for y in range(height):
        kind, row = raw[y * (pitch + 1)], bytearray(raw[y * (pitch + 1) + 1:(y + 1) * (pitch + 1)])
        for i in range(pitch):
            a = row[i - channels] if i >= channels else 0
            b, c = before[i], before[i - channels] if i >= channels else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        before = bytes(row)
        rows.append(before)
    return width, height, channels, rows


def fnv1a(data):
    value = 2166136261
    for byte in data:
        value = (value ^ byte) * 16777619 & 0xFFFFFFFF
    return f"{value:08x}"


def ring(x, y, radius, count):
    turns = [2 * math.pi * (i % count) / count for i in range(count + 1)]
    return [[x + radius * math.cos(turn), y + radius * math.sin(turn)] for turn in turns]


class Verbs(unittest.TestCase):
    def setUp(self):
        room = tempfile.TemporaryDirectory()
        self.addCleanup(room.cleanup)
        self.room = pathlib.Path(room.name)
        self.map = self.room / "hill.yb"
        self.map.write_bytes(paper_code.two_summits())

    def good(self, *words, stdin=None):
        done = run(*words, stdin=stdin)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, b"")
        return done.stdout

    def bad(self, code, *words):
        """Fails with that exit code and one sentence; leaves no file."""
        before = sorted(os.listdir(self.room))
        done = run(*words)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        self.assertEqual(done.stdout, b"")
        self.assertTrue(done.stderr.startswith(f"yamabiko {words[0]}: ".encode()), done.stderr)
        self.assertEqual(done.stderr.count(b"\n"), 1 if code == 1 else 2)
        self.assertEqual(sorted(os.listdir(self.room)), before)
        return done.stderr.decode()

    def test_panel_pixels_are_levels_times_17(self):
        out = self.room / "oled.png"
        said = json.loads(self.good("render", self.map, "-o", out, "--panel", "ssd0323", "--json"))
        self.assertEqual(said["screen"], {"width": 128, "height": 64, "format": "grey4"})
        width, height, channels, rows = png_pixels(out.read_bytes())
        self.assertEqual((width, height, channels), (128, 64, 1))
        levels = [value // 17 for row in rows for value in row]
        self.assertTrue(all(value % 17 == 0 for row in rows for value in row))
        self.assertGreater(len(set(levels)), 4)
        packed = bytes(a << 4 | b for a, b in zip(levels[::2], levels[1::2]))
        self.assertEqual(said["fnv1a"], fnv1a(packed))

    def test_render_is_the_same_in_bands_and_through_a_pipe(self):
        whole, bands = self.room / "whole.png", self.room / "bands.png"
        self.good("render", self.map, "-o", whole, "--size", "200x150", "--view", "walk-1")
        self.good("render", self.map, "-o", bands, "--size", "200x150", "--view", "walk-1",
                  "--band", 7)
        self.assertEqual(whole.read_bytes(), bands.read_bytes())
        piped = self.good("render", "-", "-o", "-", "--size", "200x150", "--view", "walk-1",
                          stdin=self.map.read_bytes())
        self.assertEqual(piped, whole.read_bytes())

    def test_orbit(self):
        said = json.loads(self.good("render", self.map, "-o", self.room / "f-%02d.png", "--orbit",
                                    4, "--size", "64x48", "--azimuth", 45, "--json"))
        self.assertEqual(sorted(path.name for path in self.room.glob("f-*")),
                         ["f-00.png", "f-01.png", "f-02.png", "f-03.png"])
        self.assertEqual([frame["view"]["azimuth_bam"] for frame in said["frames"]],
                         [8192, 24576, 40960, 57344])
        one = self.room / "one.png"
        self.good("render", self.map, "-o", one, "--size", "64x48", "--azimuth", 135)
        self.assertEqual(one.read_bytes(), (self.room / "f-01.png").read_bytes())
        self.assertIn("--force", self.bad(1, "render", self.map, "-o", self.room / "f-%02d.png",
                                          "--orbit", 9, "--size", "64x48"))

    def test_surfaces(self):
        self.good("dem", self.map, "-o", self.room / "hill.tif", "--cells", 64)
        self.good("contours", self.map, "-o", self.room / "hill.geojson", "--interval", 100)
        lines = json.loads((self.room / "hill.geojson").read_text())["features"]
        self.assertGreater(len(lines), 3)
        self.assertTrue(all(line["properties"]["elevation"] % 100 == 0 for line in lines))
        self.good("mesh", self.map, "-o", self.room / "hill.obj")
        text = (self.room / "hill.obj").read_text()
        corners, faces = text.count("\nv "), text.count("\nf ")
        self.assertEqual(corners, 22)
        self.assertEqual(faces, 2 * corners - 2 - 4)
        self.good("mesh", self.map, "-o", self.room / "fine.obj", "--depth", 4)
        self.assertGreater((self.room / "fine.obj").read_text().count("\nf "), 4 * faces)

    def test_mesh_of_a_frame(self):
        view = ("--view", "orbit-135", "--size", "128x64", "--edge", 8, "--walls", "off")
        self.good("mesh", self.map, "-o", self.room / "frame.obj", "--refined", *view)
        told = self.good("render", self.map, "-o", self.room / "frame.png", "--json", *view)
        drawn = json.loads(told)["stats"]["drawn"]
        self.assertGreater(drawn, 100)
        self.assertEqual((self.room / "frame.obj").read_text().count("\nf "), drawn)

    def test_drawing(self):
        out = self.room / "hill.svg"
        self.good("mesh", self.map, "-o", out)
        self.assertIn("--force", self.bad(1, "mesh", self.map, "-o", out))
        drawn = out.read_bytes()
        self.assertEqual(self.good("mesh", self.map, "-o", "-", "--svg"), drawn)
        self.assertEqual(self.good("mesh", self.map, "-o", "-", "--svg", "--stage", "triangles"),
                         drawn)
        self.assertNotEqual(self.good("mesh", self.map, "-o", "-", "--svg", "--stage", "links"),
                            drawn)
        root = xml.etree.ElementTree.fromstring(drawn)
        self.assertEqual(root.get("viewBox").split()[:3], ["0", "0", "1000"])
        self.good("mesh", self.map, "-o", self.room / "hill.PNG", "--width", 700)
        self.assertEqual(png_pixels((self.room / "hill.PNG").read_bytes())[0], 700)

    def test_evaluate(self):
        self.good("dem", self.map, "-o", self.room / "hill.tif")
        said = json.loads(self.good("evaluate", self.map, self.room / "hill.tif", "--json",
                                    "--sheet", self.room / "sheet.png"))
        self.assertLess(said["detail"]["rmse_m"], 0.01)
        self.assertGreater(said["k"], 0.7)
        self.assertLess(said["spectrum"]["detail"], 0.01)
        off = [abs(math.log2(lag["smooth_m"] / lag["reference_m"])) for lag in said["roughness"]]
        self.assertAlmostEqual(said["spectrum"]["smooth"], sum(off) / len(off), 6)
        self.assertEqual(said["bytes"], len(self.map.read_bytes()))
        self.assertEqual(said["body_bits"], 12 * said["points"] + 20 * said["contours"] + 8)
        self.assertEqual([round(contour["height_m"]) for contour in said["contour"]],
                         [400, 1100, 900])
        width, height = struct.unpack(">II", (self.room / "sheet.png").read_bytes()[16:24])
        self.assertGreater(width * height, 1000000)
        self.assertIn(b"K ", self.good("evaluate", self.map, self.room / "hill.tif"))

    def write_lines(self, name, features):
        """Contour lines in UTM zone 32 N, as GeoJSON: pairs of a height and its places."""
        path = self.room / name
        path.write_text(json.dumps({
            "type": "FeatureCollection",
            "crs": {"type": "name", "properties": {"name": "EPSG:32632"}},
            "features": [{"type": "Feature", "properties": {"metres": height, "id": i},
                          "geometry": {"type": "LineString", "coordinates": places}}
                         for i, (height, places) in enumerate(features)]}))
        return path

    def write_hill(self):
        features = [(100 * k, [[500000 + x, 5000000 + y] for x, y in
                               ring(2000, 2000, 2000 - 180 * k, 400)]) for k in range(1, 10)]
        return self.write_lines("hill.geojson", features)

    def test_contour_lines_instead_of_a_code(self):
        lines, field = self.write_hill(), ("--field", "metres")
        said = json.loads(self.good("info", lines, *field, "--json"))
        self.assertEqual((said["n"], said["m"]), (3600, 9))
        self.assertNotIn("bytes", said)
        self.assertIn(b"no code", self.good("info", lines, *field))
        dem, again = self.room / "hill.tif", self.room / "again.gpkg"
        self.good("dem", lines, *field, "-o", dem)
        self.good("contours", lines, *field, "-o", again, "--interval", 60, "--base", 30)
        # In its own place: the lines at both heights and the raster are of one window.
        said = json.loads(self.good("evaluate", lines, dem, *field, "--json"))
        self.assertLess(said["smooth"]["rmse_m"], 5)
        self.assertGreater(said["k"], 0.95)
        box = ("--window", 500500, 5000500, 503500, 5003500)
        said = json.loads(self.good("evaluate", again, dem, *box, "--json"))
        self.assertLess(said["smooth"]["rmse_m"], 5)
        self.good("render", lines, *field, "-o", self.room / "hill.png", "--size", "64x48")
        self.good("mesh", lines, *field, "-o", self.room / "hill.obj")

    def test_contour_lines_that_cross(self):
        lines = self.write_lines("cross.geojson", [
            (100, [[0, 900], [2500, 900]]), (200, [[900, 0], [900, 2500]]),
            (300, [[1000, 1000], [1000, 2000], [2000, 2000], [1000, 1000]])])
        done = run("info", lines, "--field", "metres")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count(b"\n"), 1)
        self.assertIn(b"1 lines and 0 points of others are left out", done.stderr)
        self.assertIn("--field", self.bad(1, "info", lines))
        self.assertIn("is a code", self.bad(1, "info", self.map, "--field", "metres"))
        self.assertIn("excl", self.bad(2, "dem", lines, "-o", self.room / "x.tif", "--window", 0, 0,
                                       1, 1, "--center", 9, 46))

    def test_help_is_a_page(self):
        for verb in ("render", "dem", "contours", "mesh", "evaluate"):
            text = self.good(verb, "--help").decode()
            self.assertTrue(text.startswith(f"Usage: yamabiko {verb} MAP.yb"))
            self.assertLessEqual(max(map(len, text.splitlines())), 90)
            self.assertIn("Example", text)

    def test_wrong_usage(self):
        out = self.room / "new"
        for words in (("render", self.map), ("render", "-o", out), ("render", self.map, self.map),
                      ("render", self.map, "-o", out, "--panel", "nosuch"),
                      ("render", self.map, "-o", out, "--panel", "ssd0323", "--size", "9x9"),
                      ("render", self.map, "-o", out, "--orbit", 3),
                      ("render", self.map, "-o", "%d%d", "--orbit", 3),
                      ("render", self.map, "-o", "%d", "--orbit", 3, "--view", "walk-1"),
                      ("render", self.map, "-o", "-", "--json"),
                      ("render", self.map, "-o", out, "--shadows", 3),
                      ("render", self.map, "-o", out, "--eye", 1, 2),
                      ("dem", self.map, "-o", out, "--cells", 0), ("dem", self.map),
                      ("contours", self.map, "-o", out), ("contours", self.map, "--interval", 5),
                      ("contours", self.map, "-o", out, "--interval", -5),
                      ("mesh", self.map, "-o", out), ("mesh", self.map, "-o", "x.glb"),
                      ("mesh", self.map, "-o", "x.obj", "--depth", 2, "--reference"),
                      ("mesh", self.map, "-o", "x.svg", "--stage", "hills"),
                      ("mesh", self.map, "-o", "x.svg", "--depth", 2),
                      ("mesh", self.map, "-o", "x.svg", "--no-detail"),
                      ("mesh", self.map, "-o", "x.svg", "--view", "walk-1"),
                      ("mesh", self.map, "-o", "x.svg", "--refined"),
                      ("mesh", self.map, "-o", "x.obj", "--view", "walk-1"),
                      ("mesh", self.map, "-o", "x.obj", "--refined", "--haze", 1),
                      ("mesh", self.map, "-o", "x.obj", "--refined", "--depth", 2),
                      ("mesh", self.map, "-o", "x.png", "--svg"),
                      ("mesh", self.map, "-o", "x.svg", "--width", 0),
                      ("mesh", self.map, "-o", "x.svg", "--width", 300),
                      ("mesh", self.map, "-o", "x.obj", "--plain"),
                      ("mesh", self.map, "-o", "-", "--stage", "links"),
                      ("evaluate", self.map), ("evaluate", self.map, self.map, "--km", 3),
                      ("evaluate", self.map, self.map, "--window", 1, 2, 3),
                      ("evaluate", self.map, self.map, "--size", "9x9")):
            self.bad(2, *words)

    def test_bad_input(self):
        broken = self.room / "broken.yb"
        broken.write_bytes(self.map.read_bytes()[:-1])
        for verb, name, more in (("render", "new.png", ()), ("dem", "new.tif", ()),
                                 ("contours", "new.geojson", ("--interval", 50)),
                                 ("mesh", "new.obj", ())):
            self.assertIn("broken.yb", self.bad(1, verb, broken, "-o", self.room / name, *more))
            self.assertIn("none.yb", self.bad(1, verb, self.room / "none.yb", "-o",
                                              self.room / name, *more))
            self.assertIn("nowhere", self.bad(1, verb, self.map, "-o",
                                              self.room / "nowhere" / name, *more))
            (self.room / name).write_bytes(b"kept")
            self.assertIn("--force", self.bad(1, verb, self.map, "-o", self.room / name, *more))
            self.assertEqual((self.room / name).read_bytes(), b"kept")
            (self.room / name).unlink()
        self.assertIn("no.tif", self.bad(1, "evaluate", self.map, self.room / "no.tif"))
        self.assertIn("interval", self.bad(1, "contours", self.map, "-o",
                                           self.room / "new.geojson", "--interval", 0.001))
        self.assertIn(".nosuch", self.bad(1, "dem", self.map, "-o", self.room / "a.nosuch"))


if __name__ == "__main__":
    unittest.main()
