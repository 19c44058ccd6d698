#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The numbers in Documentation/notebook/paper.md are those of paper.json beside it, and its pictures
exist. Usage: test_document.py SOURCE_FOLDER [TEST...]"""

import os
import re
import sys
import tempfile
import unittest

SOURCE = os.path.abspath(sys.argv[1])
sys.path.insert(0, os.path.join(SOURCE, "Utilities", "paper"))

try:
    import matplotlib  # the report's
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(125)

import document


class Document(unittest.TestCase):
    def test_numbers_are_those_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            expected = document.make_text(folder).splitlines()
        self.assertEqual(expected, document.read_document()[1].strip().splitlines())

    def test_pictures_are_there(self):
        names = re.findall(r"\(\.\./images/paper/(\w+\.png)\)", document.read_document()[1])
        self.assertEqual(8, len(names))
        self.assertEqual(sorted(names), sorted(os.listdir(document.IMAGES)))

    def test_hand_written_text_has_no_measured_numbers(self):
        """Numbers are allowed only in powers, years, degrees and names of files."""
        before, text, after = document.read_document()
        words = re.findall(r"(?<![\w.`])\d[\d.,]*(?:e-?\d+)?(?![\w`])", before + after)
        allowed = {"2013", "2013.", "180", "3.5e-4", "5", "5,"}
        self.assertEqual([], [word for word in words if word not in allowed])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
