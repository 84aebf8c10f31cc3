#!/usr/bin/env python3
"""What `yamabiko render --panel` draws is what the handheld's OLED shows: both as PNG files."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import firmware
import paper_code

HERE = pathlib.Path(__file__).resolve().parent
SAME_PIXELS = HERE.parents[1] / "scripts" / "same-pixels"
STEPS_PER_DEGREE = 256 / 360


class Shot(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="yamabiko-shot-")
        self.map = os.path.join(self.folder.name, "map.yb")
        with open(self.map, "wb") as file:
            file.write(paper_code.two_summits())

    def tearDown(self):
        self.folder.cleanup()

    def shot(self, degrees):
        path = os.path.join(self.folder.name, f"oled{degrees}.png")
        subprocess.run([sys.executable, "-B", HERE / "oled_shot.py",
                        "--elf", firmware.elf("lm3s6965evb"), "--map", self.map, "-o", path,
                        "--azimuth-steps", str(round(degrees * STEPS_PER_DEGREE))],
                       check=True, capture_output=True)
        return path

    def render(self, degrees):
        path = os.path.join(self.folder.name, f"render{degrees}.png")
        subprocess.run([os.environ["YB_YAMABIKO"], "render", self.map, "-o", path,
                        "--exaggerate", "2",
                        "--panel", "ssd0323", "--azimuth", str(degrees), "--elevation", "30",
                        "--distance", "1.2"], check=True, capture_output=True)
        return path

    def same(self, a, b):
        return subprocess.run([sys.executable, "-B", SAME_PIXELS, a, b], check=False,
                              capture_output=True).returncode

    def test_render_is_what_the_glass_shows(self):
        for degrees in (0, 45, 270):
            with self.subTest(azimuth=degrees):
                self.assertEqual(self.same(self.shot(degrees), self.render(degrees)), 0)

    def test_other_azimuths_differ(self):
        self.assertEqual(self.same(self.shot(45), self.render(135)), 1)


if __name__ == "__main__":
    unittest.main()
