# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The first line of a file of points without names: it is a point, whatever separates its words."""

from CommandTesting import points_of
from TestPoints import PLACES, PointTest, edges_of, grid, text_of


class FirstLines(PointTest):
    def setUp(self):
        super().setUp()
        self.write("in.xyz", text_of(grid(5)))

    def test_decimal_commas_between_blanks_and_tabs(self):
        """A first point of whole numbers but one is a point, also before text."""
        expected = [(x * 1000 + 412600, y * 1000 + 0.25, z) for x, y, z in PLACES]
        for separator in (" ", "\t", "  \t "):
            texts = [separator + "a;b"] if separator == "\t" else []
            for end in (*texts, "", separator + "oak", separator + "an old oak, dead"):
                rows = [separator.join((str(x), str(y).replace(".", ","), str(z))) + end for x, y, z in expected]
                for names, options in (("", []), ("", ["--columns", "1,2,3"]), ("# x y z\n", [])):
                    self.write("in.txt", names + "\n".join(rows))
                    mesh, _ = self.triangulate("in.txt", *options)
                    self.assertEqual(points_of(mesh), expected, (names + rows[0], options))
        self.write("in.txt", "x y z kind\n" + "".join(f"{x} {y},5 {z} oak\n" for x, y, z in PLACES))
        mesh, result = self.triangulate("in.txt")
        self.assertEqual(points_of(mesh), [(x, y + 0.5, z) for x, y, z in PLACES])
        self.assertIn("left out the columns 'kind'", result.stderr)

    def test_other_separators_in_text(self):
        """What separates the coordinates separates all words of the line."""
        for separator, text in ((",", "a;b"), ("\t", "a;b"), ("\t", "a, b; c")):
            rows = text_of([p + (7,) for p in PLACES], separator, end=separator + text + "\n")
            for options in ([], ["--columns", "1,2,3"]):
                self.write("in.txt", rows)
                mesh, _ = self.triangulate("in.txt", *options)
                self.assertEqual(points_of(mesh), PLACES, (rows, options))
        for rows in (text_of(PLACES, end=";\n"), text_of(PLACES, end=" a,b\n"), text_of(PLACES, end=" a;b\n"),
                     "48 12 30 N;16 22 15 E;9\n", "48 12 30,5 N;16 22 15,5 E;9\n", "48 12 30 N,16 22 15 E,9\n"):
            for options in ([], ["--columns", "1,2,3"]):
                self.write("in.txt", rows)
                self.fail_with(3, "in.txt", "out.vtk", "--from-points", *options, naming=["in.txt: "])
        self.write("in.txt", text_of(PLACES, end=";\n"))
        self.fail_with(3, "in.txt", "out.vtk", "--from-points", naming=["in.txt: line 1: "])

    def test_names_with_numbers(self):
        """Known names make a line of names, also if another one begins with numbers."""
        for first, options in (("0 1 flag;x;y;z", []), ("2019 2020;x;y;z", []), ("Height 2019 2020 (m);X;Y;Z", []),
                               ("Height 2019 2020 (m);X;Y;Z", ["--columns", "2,3,4"])):
            self.write("in.csv", first + "\n" + text_of([(9, *p) for p in PLACES], ";"))
            mesh, _ = self.triangulate("in.csv", *options)
            self.assertEqual(points_of(mesh), PLACES, (first, options))

    def test_empty_cells(self):
        """A first point without y is an error like a later one, and no line of names."""
        for rows in ("7,,5\n8,1,5\n9,2,6\n", "8,1,5\n7,,5\n9,2,6\n"):
            self.write("in.csv", rows)
            self.fail_with(3, "in.csv", "out.vtk", "--from-points", "--columns", "2,3",
                           naming=[f"in.csv: line {2 if rows[0] == '8' else 1}: a number is missing"])

    def test_breaklines(self):
        for separator in (" ", "\t"):
            rows = [("0", "0", "7"), ("1", "1,5", "7"), ("3,5", "3,25", "7")]
            for number in range(2):
                lines = rows[number:] + [("4", "3,5", "7")]
                self.write("lines.txt", "\n".join(map(separator.join, lines)))
                mesh, _ = self.triangulate("in.xyz", "--constraints", "lines.txt")
                self.assertIn(((1, 1.5), (3.5, 3.25)), edges_of(mesh))

    def test_names_that_are_dropped_are_told(self):
        """Where columns have numbers, a line of names need not fit. It may be a point after all."""
        rows = text_of([(7, *p, "oak") for p in PLACES], ",").replace("'", "")
        for first in ("a title", "3 points; old", "1,2,zero"):
            self.write("in.csv", first + "\n" + rows)
            mesh, result = self.triangulate("in.csv", "--columns", "2,3,4")
            self.assertEqual(points_of(mesh), PLACES)
            self.assertIn("warning: in.csv: left out line 1, which has other columns than the first point: '",
                          result.stderr)
        self.write("in.csv", "id,x,y,z,kind\n" + rows)
        self.assertNotIn("left out line", self.triangulate("in.csv", "--columns", "2,3,4")[1].stderr)
