#!/usr/bin/env python3
"""Whatever lies in the map slot: the board says what it found, and always shows a mountain."""

import unittest

import firmware
import paper_code

BOARDS = ("lm3s6965evb", "microbit")


class MapSlot(unittest.TestCase):
    def check_built_in_shown(self, slot, word):
        expected = firmware.frame_bytes("built-in", 512)
        for name in BOARDS:
            with self.subTest(board=name), firmware.board(name, slot) as board:
                self.assertEqual(board.greeting.split()[0], "yamabiko")
                self.assertEqual(board.greeting.split()[2:],
                                 [name, f"slot={word}", "map=built-in"])
                self.assertEqual(board.pause_at(512).hash, firmware.frame_hash(expected))
                if name == "lm3s6965evb":
                    rows = firmware.frame_rows(expected)
                    self.assertEqual(firmware.wrong_pixels(board.picture(), rows), "")

    def test_never_written(self):
        self.check_built_in_shown(None, "empty")

    def test_erased(self):
        self.check_built_in_shown(b"\xff" * 4096, "empty")

    def test_another_version(self):
        self.check_built_in_shown(b"garbage", "version")

    def test_a_flipped_bit(self):
        code = bytearray(paper_code.two_summits())
        code[-9] ^= 0x10
        self.check_built_in_shown(bytes(code), "corrupt")

    def test_crossing_contours(self):
        square = [(40, 40), (200, 40), (200, 200), (40, 200)]
        crossing = [(24, 120), (120, 24), (216, 120), (120, 216)]
        self.check_built_in_shown(paper_code.paper_code([(40, square), (60, crossing)], shift=3),
                                  "corrupt")

    def test_what_follows_a_code_is_not_looked_at(self):
        code = paper_code.two_summits()
        for name in BOARDS:
            with self.subTest(board=name), \
                    firmware.board(name, code + b"\x5a" * (4096 - len(code))) as board:
                self.assertIn(" slot=ok map=slot", board.greeting)


if __name__ == "__main__":
    unittest.main()
