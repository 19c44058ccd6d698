#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A small reproduction of the paper: tests all results but times, and that the report has all of
them; and the published run. Usage: test_reproduction.py PROGRAM SOURCE_FOLDER [TEST...]"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
SCRIPTS = os.path.join(SOURCE, "Utilities", "paper")
sys.path.insert(0, SCRIPTS)

try:
    import matplotlib  # the report's
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(125)

import document
import reproduce


class Reproduction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = cls.temporary.name
        command = [sys.executable, os.path.join(SCRIPTS, "reproduce.py"), cls.folder, "--scale",
                   "test", "--program", PROGRAM]
        cls.first = subprocess.run(command, capture_output=True, text=True, check=False)
        cls.results = reproduce.Results(cls.folder)

    def rows(self, experiment, *programs):
        rows = [row for row in self.results.rows(experiment) if row["program"] in programs]
        self.assertTrue(rows, f"{experiment}: no row of {programs}")
        return rows

    def test_ends_well(self):
        self.assertEqual(0, self.first.returncode, self.first.stderr)
        self.assertEqual([], self.results.failures())
        self.assertEqual(len(self.results.parts), len(re.findall(r"(?m)^\[", self.first.stdout)))

    def test_flips_of_figure_6(self):
        for row in self.rows("chain", "ours-1", "paper"):
            m = row["triangles"]
            self.assertEqual(m - 1, row["iterations"])
            self.assertEqual([min(i, m - i) for i in range(1, m)], row["flipped"])
            self.assertTrue(row["is_ramp"])
        for row in self.rows("chain", "lawson"):
            self.assertEqual((row["triangles"] // 2) ** 2, row["flips"])

    def test_nothing_is_left_or_different(self):
        for row in self.rows("random", "ours-1", "ours-all", "no-chunks") + self.rows(
                "quality", "ours"):
            self.assertEqual("converged", row["stop"])
            self.assertTrue(row["bad_left"] == 0 or row["program"] == "no-chunks")
        for row in self.rows("quality", "ours, canonical"):
            self.assertEqual(0, row["different"])

    def test_the_papers_method(self):
        """It is exact in double precision, and quasi-Delaunay with a large epsilon."""
        rows = self.rows("quality", "paper")
        for row in rows:
            if row["precision"] == "double" and row["epsilon"] == 1e-7:
                self.assertEqual((0, 0), (row["different"], row["bad_left"]))
            if row["epsilon"] == max(reproduce.EPSILONS):
                self.assertGreater(row["different"], 0)
        self.assertEqual(2 * 2 * len(reproduce.EPSILONS), len(rows))

    def test_surfaces_stay_manifold(self):
        for row in self.rows("surface", "ours-all"):
            self.assertEqual(0, row["duplicate_edges"])
        for row in self.rows("surface", "ours-all", "paper-all", "lawson"):
            self.assertGreater(row["flips"], 0)

    def test_a_sound_error_bound_is_never_wrong(self):
        for row in self.rows("tests", "in-circle, error bound"):
            self.assertEqual((0, "converged"), (row["false_bad"], row["stop"]))
        for row in self.rows("tests", "ours, in-circle"):
            self.assertTrue(row["bad_left"] == 0 or row["turned_over_before"] > 0)

    def test_bad_surfaces(self):
        """Every edge left has a reason, flips undo flips, and splits do not move the surface."""
        rows = self.rows("ruined", "ours")
        self.assertEqual(5 * 4, len(rows))
        for row in rows:
            self.assertEqual(0, row["left_other"])
            if row["feature_angle"] == 180 and row["ruined_by"] == "flips":
                self.assertGreater(row["mean_smallest_angle"], row["mean_smallest_angle_before"])
            if row["feature_angle"] == 30 and row["shape"] == "box":
                self.assertLess(row["distance"], 1e-9)

    def test_report_is_complete(self):
        with open(os.path.join(self.folder, "report.md"), encoding="utf-8") as file:
            report = file.read()
        self.assertEqual(8, report.count("**Measured here:**"))
        self.assertNotIn("@", report)
        images = re.findall(r"\((plots/\w+\.png)\)", report)
        self.assertEqual(8, len(images))
        for image in images:
            self.assertGreater(os.path.getsize(os.path.join(self.folder, image)), 5000, image)


class Document(unittest.TestCase):
    """The numbers in Documentation/notebook/paper.md are those of paper.json beside it."""

    def test_numbers_are_those_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            expected = document.make_text(folder).splitlines()
        self.assertEqual(expected, document.read_document()[1].strip().splitlines())

    def test_pictures_are_there(self):
        names = re.findall(r"\(\.\./images/paper/(\w+\.png)\)", document.read_document()[1])
        self.assertEqual(8, len(names))
        self.assertEqual(sorted(names), sorted(os.listdir(document.IMAGES)))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
