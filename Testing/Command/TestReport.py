# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the command reports: the JSON report, the CSV table, and what it prints."""

import csv
import math
import pathlib
import random
import re

from CommandTesting import CommandTest, bad_mesh, bumpy_grid, make_mesh, turns_of, worst_case

HEADER = pathlib.Path(__file__).resolve().parents[2] / "CInterface/delaunayflip_c.h"
TEXTS = ["stop_reason", "converged", "geometry_used", "geometry_reason", "tolerance", "backend", "fallback"]


def list_numbers():
    """The names of the numbers of a report, from the C header, which Python follows, too."""
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(encoding="utf-8"), flags=re.S)
    body = re.search(r"int64_t number_of_iterations;[^}]*(?=\} delaunayflip_report;)", text)[0]
    return re.findall(r"(\w+);", body)


COLUMNS = "Iteration,Tested,NonDelaunay,Flipped,Excluded,Blocked,MinimumAngle,Seconds"


class Report(CommandTest):
    def test_keys(self):
        """Each number has its name of the C header and of Python; from points there are more."""
        path = self.write_mesh(worst_case(4), "in.vtk")
        names = [*TEXTS, *list_numbers(), "read_seconds", "write_seconds", "warnings"]
        report = self.report(path, "out.vtk", "--from-points")
        self.assertEqual(list(report), names)
        more = {name for name in names if name not in ("refinement_points", "removed_points") and re.search(
            "_points|points_|^segment|segments$|^crossings|^largest_|^outside_|^large_|^left_out_|^move_", name)}
        self.assertEqual(len(more), 13)
        report = self.report(path, "out.vtk")
        self.assertEqual(list(report), [name for name in names if name not in more])
        for name in ("read_seconds", "build_seconds", "flip_seconds", "write_seconds"):
            self.assertGreaterEqual(report[name], 0.0)

    def test_warnings(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 0, 1)])
        path = self.write_mesh(mesh, "in.vtk")
        arguments = (path, "out.vtk", "--report", "r.json", "--tolerance", 0.1, "--quiet")
        said = [line.removeprefix("warning: ") for line in self.succeed(*arguments).stderr.splitlines()]
        report = self.report(*arguments[:2], "--tolerance", 0.1)
        self.assertEqual(report["warnings"], said)
        self.assertEqual(sum("olerance" in warning for warning in said), 1, said)
        self.write(
            "in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/1 2/1\n")
        (texture, _) = self.report("in.obj", "out.vtk")["warnings"]
        self.assertIn("in.obj: left out vt (2)", texture)

    def test_worst_case(self):
        report = self.report(self.write_mesh(worst_case(4), "in.vtk"), "out.vtk")
        expected = {
            **{"points": 8, "triangles": 6, "edges": 13, "boundary_edges": 8, "fixed_edges": 8},
            **{"non_manifold_edges": 0, "geometry_used": "planar", "number_of_iterations": 5, "total_flips": 9},
            **{"total_blocked": 0, "tolerance": "none", "non_delaunay_before": 1, "non_delaunay_after": 0},
            **{"converged": True, "stop_reason": "converged"},
        }
        self.assertEqual({key: report[key] for key in expected}, expected)

    def test_no_triangles(self):
        report = self.report(self.write_mesh(make_mesh([(0, 0, 0)], []), "in.vtk"), "out.vtk")
        self.assertEqual((report["points"], report["triangles"]), (1, 0))
        self.assertIsNone(report["minimum_angle_before"])
        self.assertIsNone(report["minimum_angle_after"])


class Statistics(CommandTest):
    def rows(self, mesh, *arguments):
        path = self.write_mesh(mesh, "in.vtk")
        self.succeed(path, "out.vtk", "--statistics", "table.csv", *arguments)
        with open(self.path("table.csv"), encoding="utf-8", newline="") as file:
            self.assertEqual(file.readline(), COLUMNS + "\n")
            file.seek(0)
            return list(csv.DictReader(file))

    def column(self, rows, name):
        return [int(row[name]) for row in rows]

    def test_worst_case(self):
        rows = self.rows(worst_case(4))
        self.assertEqual(self.column(rows, "Iteration"), [1, 2, 3, 4, 5])
        self.assertEqual(self.column(rows, "Flipped"), [1, 2, 3, 2, 1])
        angles = [float(row["MinimumAngle"]) for row in rows]
        self.assertEqual([math.isnan(angle) for angle in angles], [False, True, True, True, False])
        self.assertEqual([row["MinimumAngle"] for row in rows][1], "nan")

    def test_columns_add_up(self):
        rows = self.rows(bad_mesh(18))
        self.assertGreater(sum(self.column(rows, "Excluded")), 0)
        report = self.report(self.path("in.vtk"), "out.vtk")
        self.assertEqual(report["number_of_iterations"], len(rows))
        for key, name in (
            ("total_flips", "Flipped"),
            ("total_excluded", "Excluded"),
            ("total_blocked", "Blocked"),
        ):
            self.assertEqual(report[key], sum(self.column(rows, name)))
        self.assertEqual(report["minimum_angle_after"], float(rows[-1]["MinimumAngle"]))


class Summary(CommandTest):
    def test_numbers(self):
        text = self.succeed(self.write_mesh(worst_case(4), "in.vtk"), "out.vtk").stdout
        for words in (
            "mesh            8 points, 6 triangles, 13 edges\n",
            "kept edges      8 (8 boundary)\n",
            "geometry        planar: all points lie in one plane; the feature angle has no effect\n",
            "bad edges       1 -> 0",
            "9 in 5 iterations, converged",
            "wrote           out.vtk",
        ):
            self.assertIn(words, text)
        self.assertRegex(text, r"smallest angle  [\d.]+ -> [\d.]+ degrees")
        self.assertRegex(text, r"time            read [\d.]+ s, edges [\d.]+ s, flips [\d.]+ s")
        self.assertLessEqual(len(text.splitlines()), 9)

    def test_why_edges_are_left(self):
        """A tetrahedron, in which every flip would duplicate an edge, beside a folded sheet."""
        points = [(-2, 0, 0), (2, 0, 0), (0, -1, 0.1), (0, 1, 0.1),
                  (-4, 9, 0), (4, 9, 0), (-3, 11, 0), (3, 12, 1)]
        triangles = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2), (6, 4, 5), (7, 5, 4)]
        text = self.succeed(
            self.write_mesh(make_mesh(points, triangles), "in.vtk"), "out.vtk",
            "--geometry", "surface", "--feature-angle", 180).stdout
        self.assertIn("bad edges       2 -> 2 (1 blocked: would duplicate an edge, "
                      "1 blocked: would fold)\n", text)

    def test_what_keeps_many_edges(self):
        """A hint follows if more than a tenth of the inner edges is kept on request."""
        path = self.write_mesh(bumpy_grid(12, 3), "in.vtk")
        for angle, share in ((1, r"9\d|100"), (180, None)):
            text = self.succeed(path, "out.vtk", "--geometry", "surface", "--feature-angle", angle).stdout
            hint = re.search(r"hint +(\d+) % of the inner edges are kept; with a larger feature angle", text)
            self.assertEqual(hint is not None, share is not None, text)
            self.assertTrue(hint is None or re.fullmatch(share, hint[1]), text)
        text = self.succeed(path, "out.vtk", "--constraints", path).stdout
        self.assertIn("100 % of the inner edges are kept; with fewer constraints", text)

    def test_what_hides_bad_edges(self):
        """A hint names the remedy where bad edges stay because of defects, and only there."""
        flat, tall = [(0, -1, 0), (4, 0, 0), (0, 1, 0), (-4, 0, 0)], [(0, -4, 0), (1, 0, 0), (0, 4, 0), (-1, 0, 0)]
        for points, is_bad in ((tall, True), (flat, False)):
            for triangles, hint in (
                ([(0, 1, 2), (3, 2, 0)], None if not is_bad else
                 "1 bad edge kept between triangles that are wound differently; wind all the same way (--orient)"),
                ([(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)], None if not is_bad else
                 "2 triangles with the corners of another one: their edges are kept; leave them out "
                 "(--drop-duplicates), and more can flip"),
            ):
                path = self.write_mesh(make_mesh(points, triangles), "in.vtk")
                text = self.succeed(path, "out.vtk").stdout
                self.assertEqual("hint" in text, hint is not None, text)
                self.assertIn(hint or "", text)
        path = self.write_mesh(make_mesh(tall, [(0, 1, 2), (0, 2, 3), (2, 1, 0, 3)]), "in.vtk")
        self.assertIn("2 triangles with the corners of another one: their edges are kept; they are parts of larger "
                      "polygons, so run --drop-duplicates on the output, and more can flip",
                      self.succeed(path, "out.vtk", "--drop-duplicates").stdout)
        self.assertIn("flips           1 ", self.succeed("out.vtk", "out.ply", "--drop-duplicates").stdout)
        leaves = [*tall, (0, 0, 1)]
        path = self.write_mesh(make_mesh(leaves, [(0, 1, 2), (0, 2, 3), (0, 2, 4)]), "in.vtk")
        self.assertIn("hint            100 % of the inner edges have more than two triangles and are kept; flip the "
                      "parts that meet there one by one, and more can flip\n", self.succeed(path, "out.vtk").stdout)

    def test_coordinates_with_few_digits(self):
        """A hint names a tolerance where they make edges bad, in text or in what was made from it."""
        def torus(form):
            """A torus of trapezoids with coordinates of this form. Both diagonals of each are as good."""
            rows, columns = 40, 60
            points, cells = [], []
            for i in range(rows):
                for j in range(columns):
                    a, b = 2 * math.pi * (i + 0.3) / rows, 2 * math.pi * (j + 0.2) / columns
                    place = ((30 + 10 * math.cos(a)) * math.cos(b), (30 + 10 * math.cos(a)) * math.sin(b),
                             10 * math.sin(a))
                    points.append([float(form % x) for x in place])
                    here, below = i * columns, (i + 1) % rows * columns
                    next_column = (j + 1) % columns
                    cells += [(here + j, here + next_column, below + next_column),
                              (here + j, below + next_column, below + j)]
            text = "".join(f"v {form} {form} {form}\n" % tuple(point) for point in points)
            return points, cells, text + "".join("f %d %d %d\n" % tuple(1 + k for k in ids) for ids in cells)

        hint = re.compile(r"^hint +coordinates are rounded to (\d+) digits, .*; --tolerance ([\d.e-]+) ", re.M)
        for form, digits in (("%.6g", 6), ("%.3f", 5), ("%.9g", 9), ("%.17g", None)):
            points, cells, text = torus(form)
            self.write("in.obj", text)
            for path in ("in.obj", self.write_mesh(make_mesh(points, cells), "in.vtk")):
                found = hint.search(self.succeed(path, "out.vtk").stdout)
                self.assertEqual(found and int(found[1]), digits, (form, path))
                if found:
                    before = self.report(path, "out.vtk")["non_delaunay_before"]
                    after = self.report(path, "out.vtk", "--tolerance", found[2])
                    self.assertGreater(before, 100)
                    self.assertLess(after["non_delaunay_before"], before / 10)
                    self.assertNotIn("hint", self.succeed(path, "out.vtk", "--tolerance", found[2]).stdout)
        points, cells, _ = torus("%.3f")
        points[7][0] += 1e-9  # one point of another origin
        path = self.write_mesh(make_mesh(points, cells), "in.vtk")
        self.assertRegex(self.succeed(path, "out.vtk").stdout, hint)
        shuffled = random.Random(1)
        points = [[round(x + shuffled.uniform(-.8, .8), 3) for x in point] for point in points]
        path = self.write_mesh(make_mesh(points, cells), "in.vtk")
        self.assertNotRegex(self.succeed(path, "out.vtk").stdout, hint)  # bad in itself

    def test_no_triangles(self):
        path = self.write_mesh(make_mesh([(0, 0, 0)], []), "in.vtk")
        text = self.succeed(path, "out.vtk").stdout
        self.assertRegex(text, r"^mesh            1 point, no triangles\ntime .* s\nwrote  ")


class Messages(CommandTest):
    def test_steep_height_field(self):
        """The summary gives a hint, and a warning counts triangles that flips have turned over."""
        path = self.write_mesh(bumpy_grid(20, 20), "in.vtk")
        result = self.succeed(path, "out.vtk")
        self.assertIn("% of its area slopes below 45 degrees; if it is terrain", result.stdout)
        turned = sum(turn < 0 for turn in turns_of(self.read_mesh("out.vtk")))
        self.assertGreater(turned, 0)
        self.assertRegex(
            result.stderr, rf"^warning: {turned} triangles that flips in space have turned over"
        )
        self.assertEqual(self.succeed(path, "out.vtk", "--geometry", "planar-xy").stderr, "")

    def test_control_characters_are_escaped(self):
        for name in ("no\x1b[31mred\n.vtk", "tab\t.xyz", "x\x7f.vtp"):
            text = self.run_command(name, "out.vtk").stderr
            escaped = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in name)
            self.assertRegex(text, rf"^error: {re.escape(escaped)}: .*\n$")
        name = self.write_mesh(worst_case(4), "o\x1b.vtk")
        self.assertIn("o\\x1b.vtk\n", self.succeed(name, name).stdout)

    def test_warnings_are_single_lines(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 2), (0, 0, 1)])
        result = self.succeed(self.write_mesh(mesh, "in.vtk"), "out.vtk", "--quiet")
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("warning: "))
        self.assertNotIn("0x", lines[0])
