#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A small reproduction of the paper: tests all results but times, and that the report has all of
them. Usage: test_reproduction.py PROGRAM SOURCE_FOLDER [TEST...]"""

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
    import numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(125)

import parts
import report
import reproduce
from results import Results, write_json

TITLES = (
    "Fig. 6: the worst case",
    "Fig. 7 and 8a: time on random bad meshes",
    "Fig. 8b: triangles that differ from CGAL's",
    "Fig. 9a: iterations over size",
    "Fig. 9b: flips and excluded edges of every iteration",
    "Fig. 10, Fig. 11 and Table 2: surfaces",
    "Future work 1: in-circle against opposite angles",
    "Future work 2: surfaces of bad quality",
    "The claims of the paper",
    "Machine",
    "Other people's programs",
    "What did not run to its end",
)
PLOTS = ("fig6", "fig8a", "fig8b", "fig9a", "fig9b", "fig11", "tests", "ruined")


def run_reproduction(folder, *options):
    command = [sys.executable, os.path.join(SCRIPTS, "reproduce.py"), folder, "--scale", "test",
               "--program", PROGRAM, *options]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Reproduction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        cls.first = run_reproduction(cls.folder)
        cls.results = Results(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def rows(self, experiment, *programs):
        rows = [row for row in self.results.rows(experiment) if row["program"] in programs]
        self.assertTrue(rows, f"{experiment}: no row of {programs}")
        return rows

    def test_ends_well(self):
        self.assertEqual(0, self.first.returncode, self.first.stderr)
        self.assertEqual([], self.results.failures())

    def test_says_what_runs_and_how_long(self):
        lines = [line for line in self.first.stdout.splitlines() if line.startswith("[")]
        self.assertEqual(len(self.results.parts), len(lines))
        for line in lines:
            self.assertRegex(line, r"^\[\d+/\d+\] .+ \(about \d+ s; [\d.]+ min left\)$")

    def test_flips_of_figure_6(self):
        for row in self.rows("chain", "ours-1", "paper"):
            m = row["triangles"]
            self.assertEqual(m - 1, row["iterations"])
            self.assertEqual([min(i, m - i) for i in range(1, m)], row["flipped"])
        for row in self.rows("chain", "lawson"):
            self.assertEqual((row["triangles"] // 2) ** 2, row["flips"])
        smallest = self.rows("chain", "ours-1")[0]
        self.assertEqual([1, 2, 3, 2, 1], smallest["flipped"])

    def test_nothing_is_left_or_different(self):
        for row in self.rows("random", "ours-1", "ours-all") + self.rows("quality", "ours"):
            self.assertEqual((0, "converged"), (row["bad_left"], row["stop"]))
        for row in self.rows("quality", "ours, canonical"):
            self.assertEqual(0, row["different"])

    def test_the_papers_method_in_double_precision(self):
        exact = [row for row in self.rows("quality", "paper")
                 if row["precision"] == "double" and row["epsilon"] == 1e-7]
        self.assertEqual(2, len(exact))
        for row in exact:
            self.assertEqual((0, 0), (row["different"], row["bad_left"]))

    def test_the_papers_method_is_quasi_delaunay(self):
        largest = [row["different"] for row in self.rows("quality", "paper")
                   if row["epsilon"] == max(parts.EPSILONS)]
        self.assertGreater(min(largest), 0)

    def test_iterations_are_comparable(self):
        points = {row["points"] for row in self.rows("random", "no-chunks")}
        self.assertEqual(set(parts.SCALES["test"].sizes), points)

    def test_surfaces_stay_manifold(self):
        for row in self.rows("surface", "ours-all"):
            self.assertEqual(0, row["duplicate_edges"])
            self.assertGreater(row["flips"], 0)
        for row in self.rows("surface", "paper-all", "lawson"):
            self.assertGreater(row["flips"], 0)

    def test_a_sound_error_bound_is_never_wrong(self):
        for row in self.rows("tests", "in-circle, error bound"):
            self.assertEqual((0, "converged"), (row["false_bad"], row["stop"]))
        for row in self.rows("tests", "ours, in-circle"):
            if row["turned_over_before"] == 0:
                self.assertEqual(0, row["bad_left"])

    def test_every_edge_left_has_a_reason(self):
        rows = self.rows("ruined", "ours")
        self.assertEqual(5 * len(parts.FEATURE_ANGLES), len(rows))
        for row in rows:
            self.assertEqual(0, row["left_other"])
            if row["feature_angle"] == 180 and row["ruined_by"] == "flips":
                self.assertGreater(
                    row["mean_smallest_angle"], row["mean_smallest_angle_before"])

    def test_splits_do_not_move_the_surface(self):
        boxes = [row for row in self.rows("ruined", "ours")
                 if row["shape"] == "box" and row["feature_angle"] == 30]
        self.assertEqual(2, len(boxes))
        for row in boxes:
            self.assertLess(row["distance"], 1e-9)

    def test_report_has_all_sections(self):
        markdown, page = self.read("report.md"), self.read("report.html")
        self.assertEqual(list(TITLES), re.findall(r"^## (.+)$", markdown, re.MULTILINE))
        for phrase in ("The paper says", "Measured here", "Where we depart, and why"):
            self.assertEqual(8, markdown.count(f"**{phrase}:**"))
            self.assertEqual(8, page.count(f"<dt>{phrase}</dt>"))
        self.assertIn("absent", markdown)

    def test_plots_are_there_and_inside_the_page(self):
        page = self.read("report.html")
        for name in PLOTS:
            for suffix in (".svg", ".png"):
                path = os.path.join(self.folder, "plots", name + suffix)
                self.assertGreater(os.path.getsize(path), 5000, path)
        self.assertEqual(len(PLOTS), page.count("src='data:image/svg+xml;base64,"))
        self.assertNotRegex(page, r"(src|href)=['\"](?!data:)")

    def test_goes_on_where_it_stopped(self):
        os.remove(os.path.join(self.folder, "parts", "tests-grid.json"))
        late = run_reproduction(self.folder, "--time-limit", "0")
        self.assertEqual(3, late.returncode, late.stderr)
        self.assertIn("1 parts are left", late.stdout)
        other = run_reproduction(self.folder, "--parts", "^chain$", "--run-only")
        self.assertEqual(0, other.returncode, other.stderr)
        self.assertEqual("", other.stdout)
        again = run_reproduction(self.folder)
        self.assertEqual(0, again.returncode, again.stderr)
        self.assertEqual(1, again.stdout.count(" min left)"))
        self.assertIn("grid", again.stdout)


class Failures(unittest.TestCase):
    """The report says why a program failed; the program is not run on larger meshes."""

    def test_reasons_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "parts"))
            write_json(os.path.join(folder, "machine.json"), {"machine": "none", "gpu": False})
            command = (sys.executable, "-c", "import sys; sys.exit('no memory')")
            plan = type("OfTwo", (), {"parts": [
                parts.Part("rival-1-vtk", "one", command, 1, "vtk"),
                parts.Part("rival-2-vtk", "two", command, 1, "vtk")]})
            arguments = type("Arguments", (), {
                "output": folder, "program": "", "rivals": None, "time_limit": None,
                "parts": re.compile("rival")})
            self.assertEqual(0, reproduce.Runner(arguments, plan).run_all())
            results = Results(folder)
            self.assertEqual(
                [("rival-1-vtk", "no memory"),
                 ("rival-2-vtk", "skipped: it failed on a smaller mesh")], results.failures())
            report.write(results)
            with open(os.path.join(folder, "report.md"), encoding="utf-8") as file:
                self.assertIn("| rival-1-vtk | no memory |", file.read())


class Plans(unittest.TestCase):
    def test_no_part_is_longer_than_nine_minutes(self):
        for name, scale in parts.SCALES.items():
            for has_gpu in (False, True):
                plan = parts.Plan(scale, has_gpu, list(parts.RIVAL_SECONDS), ["torus"])
                names = [part.name for part in plan.parts]
                self.assertEqual(len(set(names)), len(names))
                self.assertGreater(len(names), 12, name)

    def test_quick_ends_within_ten_minutes(self):
        plan = parts.Plan(parts.SCALES["quick"], False, list(parts.RIVAL_SECONDS) + ["meshlib"],
                          ["torus", "noisy-torus", "decimated-torus"])
        self.assertLess(sum(part.seconds for part in plan.parts), 600)

    def test_sequential_programs_stop_at_the_papers_size(self):
        plan = parts.Plan(parts.SCALES["full"], True, list(parts.RIVAL_SECONDS), [])
        for part in plan.parts:
            if "100000000" in part.command or 100_000_000 in part.command:
                self.assertRegex(" ".join(part.command), "(ours|paper)-(gpu|all)")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
