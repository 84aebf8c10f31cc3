#!/usr/bin/env python3
"""The counts are exact: two runs agree to the instruction, and more work counts more."""

import unittest

import boards
import paper_code


class Count(unittest.TestCase):
    def test_two_runs_agree(self):
        code = paper_code.two_summits()
        for board in boards.DEVICES:
            with self.subTest(board=board):
                first = boards.run_bench(board, code)
                self.assertIsNone(first.error)
                self.assertGreater(first.regions["load"], 10000)
                self.assertEqual(boards.run_bench(board, code).regions, first.regions)

    def test_a_refused_code_is_told(self):
        run = boards.run_bench("microbit", b"\x99nothing")
        self.assertEqual(run.error, "version")
        self.assertLess(run.regions["load"], 20000)


if __name__ == "__main__":
    unittest.main()
