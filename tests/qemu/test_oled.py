#!/usr/bin/env python3
"""The handheld shows, pixel for pixel, what the PC draws."""

import os
import tempfile
import unittest

import firmware
import paper_code


class Oled(unittest.TestCase):
    def check_map(self, path):
        with firmware.board("lm3s6965evb", path) as board:
            self.assertIn(" slot=ok map=slot", board.greeting)
            for azimuth in firmware.AZIMUTHS_BAM:
                expected = firmware.frame_bytes(path, azimuth)
                frame = board.pause_at(azimuth)
                self.assertEqual(frame.hash, firmware.frame_hash(expected), f"azimuth {azimuth}")
                self.check_picture(board.picture(), firmware.frame_rows(expected), azimuth)
            self.assertNotIn("ssd0323: error", board.stderr())

    def check_picture(self, shown, expected, azimuth):
        self.assertGreater(len(set(b"".join(expected))), 4, "a mountain has more than 4 greys")
        self.assertEqual(firmware.wrong_pixels(shown, expected), "", f"azimuth {azimuth}")

    def test_two_summits(self):
        with tempfile.NamedTemporaryFile(suffix=".yb") as file:
            file.write(paper_code.two_summits())
            file.flush()
            self.check_map(file.name)

    def test_gallery(self):
        for path in firmware.gallery():
            with self.subTest(map=os.path.basename(path)):
                self.check_map(path)

    def test_still_while_paused(self):
        with firmware.board("lm3s6965evb") as board:
            first = board.pause()
            shown = board.picture()
            again = board.pause()
            self.assertEqual((again.azimuth_bam, again.hash), (first.azimuth_bam, first.hash))
            self.assertEqual(firmware.wrong_pixels(board.picture(), shown), "")
            self.assertNotEqual(board.next().hash, first.hash)
            self.assertNotEqual(firmware.wrong_pixels(board.picture(), shown), "")

    def test_shadows_and_lines(self):
        path = firmware.gallery()[0]
        with firmware.board("lm3s6965evb", path) as board:
            plain = board.pause()
            seen = [plain.hash]
            for key, looks in (("s", 1), ("l", 3), ("s", 2)):
                frame = board.look(key)
                expected = firmware.frame_bytes(path, plain.azimuth_bam, looks)
                self.assertEqual(frame.hash, firmware.frame_hash(expected), f"looks {looks}")
                self.check_picture(board.picture(), firmware.frame_rows(expected), looks)
                self.assertNotIn(frame.hash, seen)
                seen.append(frame.hash)
            self.assertEqual(board.look("l").hash, plain.hash)

    def test_runs_on(self):
        with firmware.board("lm3s6965evb") as board:
            first = board.pause()
            turned = first
            while turned.azimuth_bam == first.azimuth_bam:
                board.send("r")
                turned = board.pause()


if __name__ == "__main__":
    unittest.main()
