#!/usr/bin/env python3
"""A Cortex-M0 in 16 KB draws the very frames of the PC."""

import os
import tempfile
import unittest

import emulator
import firmware
import paper_code


class Microbit(unittest.TestCase):
    def check_map(self, path):
        with firmware.board("microbit", path) as board:
            self.assertIn(" slot=ok map=slot", board.greeting)
            for azimuth in firmware.AZIMUTHS_BAM:
                expected = firmware.frame_hash(firmware.frame_bytes(path, azimuth))
                self.assertEqual(board.pause_at(azimuth).hash, expected, f"azimuth {azimuth}")

    def test_two_summits(self):
        with tempfile.NamedTemporaryFile(suffix=".yb") as file:
            file.write(paper_code.two_summits())
            file.flush()
            self.check_map(file.name)

    def test_gallery(self):
        for path in firmware.gallery():
            with self.subTest(map=os.path.basename(path)):
                self.check_map(path)

    def test_tells_frames_while_running(self):
        with firmware.board("microbit") as board:
            for step in range(3):
                frame = emulator.Frame(board.line())
                self.assertFalse(frame.paused)
                self.assertEqual(frame.azimuth_bam, step * emulator.STEP_BAM)
                expected = firmware.frame_bytes("built-in", frame.azimuth_bam)
                self.assertEqual(frame.hash, firmware.frame_hash(expected))


if __name__ == "__main__":
    unittest.main()
