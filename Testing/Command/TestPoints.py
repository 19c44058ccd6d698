# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""--from-points: files of points, segments, outlines, holes, and what the command says about them."""

import math
import re

from vtkmodules.vtkCommonCore import vtkPoints

from CommandTesting import (
    FORMATS, BadFileTest, bumpy_grid, make_array, make_mesh, points_of, read_report, triangle_set, triangles_of,
    turns_of)

# A square and its middle.
PLACES = [(0, 0, 1), (4, 0, 2), (4, 4, 3), (0, 4, 4), (2, 2, 5)]


def grid(columns, spacing=1.0):
    return [(x * spacing, y * spacing, 0) for y in range(columns) for x in range(columns)]


def area_of(mesh):
    """The sum of the triangles' areas in x and y; all must turn counter-clockwise."""
    turns = list(turns_of(mesh))
    assert all(turn > 0 for turn in turns)
    return sum(turns) / 2


def edges_of(mesh):
    """Pairs of places in x and y."""
    points = [point[:2] for point in points_of(mesh)]
    return {tuple(sorted((points[a], points[b])))
            for t in triangles_of(mesh) for a, b in zip(t, t[1:] + t[:1])}


def text_of(points, separator=" ", header="", end="\n"):
    rows = [separator.join(map(repr, point)) for point in points]
    return end.join(([header] if header else []) + rows) + end


class PointTest(BadFileTest):
    def triangulate(self, name, *options):
        """Returns the mesh and what is printed."""
        result = self.succeed(name, "out.vtp", "--from-points", *options)
        return self.read_mesh("out.vtp"), result

    def refuse_points(self, text, *naming, name="in.csv", code=3):
        self.write(name, text)
        self.fail_with(code, name, "out.vtk", "--from-points", naming=[name, *naming])

    def rings(self, name, *rings):
        """A file of closed lines through these places."""
        points = [point for ring in rings for point in ring]
        cells, begin = [], 0
        for ring in rings:
            cells.append((*range(begin, begin + len(ring)), begin))
            begin += len(ring)
        self.write_mesh(make_mesh(points, [], cells), name)
        return name


class Files(PointTest):
    def expect(self, name, text, points, warning="", options=()):
        self.write(name, text)
        mesh, result = self.triangulate(name, *options)
        self.assertEqual(points_of(mesh), points, text)
        self.assertEqual(len(triangles_of(mesh)), len(points) - 1, text)
        if warning:
            self.assertIn(f": {name}: {warning}\n", result.stderr)
        else:
            self.assertEqual(result.stderr, "", text)

    def test_separators_headers_and_line_ends(self):
        """A table of layouts, all of the same points."""
        for separator in (" ", "\t", ",", ";", " , ", "  \t "):
            for header in ("", "x y z", "X Y Z", "# x y z", "//X Y Z", "# made by hand"):
                for end in ("\n", "\r\n", "\r"):
                    names = header.replace(" ", separator)
                    self.expect("in.txt", text_of(PLACES, separator, names, end), PLACES)

    def test_columns(self):
        text = 'name\tPoint ID\tz\tY\tx\n' + "".join(
            f"a b\t7\t{z}\t{y}\t{x}\n" for x, y, z in PLACES)
        self.expect("in.txt", text, PLACES, "left out the columns 'name', 'Point ID'")
        rows = text_of([(7, *p) for p in PLACES], "\t", "\tx\ty\tz")
        self.expect("in.txt", rows, PLACES, "left out the columns ''")
        rows = text_of([p[::-1] for p in PLACES], "\t", "\t#z\ty\tx")
        self.expect("in.txt", rows, PLACES)
        flat = [(x, y, 0) for x, y, _ in PLACES]
        self.expect("in.xyz", text_of([p[:2] for p in PLACES]), flat)
        self.expect("in.csv", text_of(PLACES, ",", "x,y,depth"), flat,
                    "left out the columns 'depth'; no name is known as that of z, so z is 0")
        self.expect("in.xyz", text_of([(*p, 9, 9) for p in PLACES]), PLACES,
                    "left out the columns from number 4 on")
        self.expect("in.xyz", text_of([(*p, 9) for p in PLACES], end=" an oak\n"), PLACES,
                    "left out the columns from number 4 on")
        self.expect("in.xyz", "0 0 1 oak\n" + text_of(PLACES[1:], end=" old oak 7\n"), PLACES,
                    "left out the columns from number 4 on")
        many = ",".join(f"c{i}" for i in range(12))
        rows = text_of([(*p, *range(12)) for p in PLACES], ",", "x,y,z," + many)
        listed = ", ".join(f"'c{i}'" for i in range(10)) + " and others"
        self.expect("in.csv", rows, PLACES, "left out the columns " + listed)

    def test_known_names(self):
        for names in ("X_COORD,Y_COORD,Z_COORD", "POINT_X,POINT_Y,Elev", "lon,lat,h", "E,N,Z", "e,n,u",
                      "x,y,Höhe [m]", "x,y,hauteur",
                      "Easting (m),Northing (m),Elevation (m)", "Longitude,Latitude,height",
                      "Points:0,Points:1,Points:2", "utm_e,utm_n,z_m", "x,y,altitude"):
            x, y, z = names.split(",")
            told = f"took '{x}', '{y}', '{z}' as x, y, z"
            rows = text_of([(9.5, *p) for p in PLACES], ",", "FID," + names)
            self.expect("in.csv", rows, PLACES, "left out the columns 'FID'" if len(x) == 1 and y != "y" else told)
            rows = text_of([(9.5, *p[::-1]) for p in PLACES], ";", f"Height error;{z};{y};{x}")
            self.expect("in.csv", rows, PLACES, "left out the columns 'Height error'")
        rows = text_of([(*p, 7, 8) for p in PLACES], ",", "x,y,z,lon,lat")
        self.expect("in.csv", rows, PLACES, "left out the columns 'lon', 'lat'")

    def test_chosen_columns(self):
        rows = [(n, y, x, z, "an oak") for n, (x, y, z) in enumerate(PLACES, 101)]
        text = text_of(rows, ",").replace("'", "")
        for choice, names in (("3,2,4", ""), ("c,B,d", "a,b,c,d,e\n"), ("3,b,4", "a,b,c,d,e\n"),
                              ("3,b,4", "# a,b,c,d,e\n"), ("3,2,4", "P#,N,E,Z,1988\n"),
                              ("4,2,3", "3,2,4,3,e\n"), ("3,2,4", "a title\n"), ("3,2,4", "# x y\n")):
            with self.subTest(choice=choice, names=names):
                expected = [(z, y, x) for x, y, z in PLACES] if choice == "4,2,3" else PLACES
                told = "left out the columns " if names[:1] in ("a", "P", "3") else "left out all columns"
                self.write("in.csv", names + text)
                mesh, result = self.triangulate("in.csv", "--columns", choice)
                if names == "3,2,4,3,e\n":
                    expected = points_of(mesh)[:1] + expected
                self.assertEqual(points_of(mesh), expected)
        self.expect("in.csv", text, [(y, x, 0) for x, y, _ in PLACES],
                    "left out all columns but those of --columns", ("--columns", "2,3"))
        for names, choice, words in (
            ("a,b,c,d,e\n", "b,x", ["'a', 'b', 'c', 'd', 'e'"]), ("", "b,c", ["5 without names"]),
            ("", "2,6", ["5 without names"]), ("a,b,c,d,e\n", "2,6", ["'a', 'b'"]),
        ):
            self.write("in.csv", names + text)
            self.fail_with(3, "in.csv", "out.vtk", "--from-points", "--columns", choice,
                           naming=["in.csv", "--columns", *words])
        for choice in ("", "1", "1,,2", "1,1", "1,2,3,4", "x,"):
            self.fail_with(2, "in.csv", "out.vtk", "--from-points", "--columns", choice,
                           naming=["--columns"])
        path = self.write_mesh(make_mesh(PLACES, [(0, 1, 2)]), "in.vtk")
        self.fail_with(2, path, "out.vtk", "--from-points", "--columns", "1,2", naming=["in.vtk", ".csv"])

    def test_names_that_are_numbers(self):
        flat = [(x, y, 0) for x, y, _ in PLACES]
        told = "left out the columns '13.137'; no name is known as that of z, so z is 0"
        self.expect("in.csv", text_of(PLACES, ",", "x,y,13.137"), flat, told)
        rows = text_of([(7, *p) for p in PLACES], ",", "Unnamed: 0,x,y,1")
        self.expect("in.csv", rows, flat, told.replace("'13.137'", "'Unnamed: 0', '1'"))
        rows = text_of([(n, *p) for n, p in enumerate(PLACES)], ",", ",0,1,2")
        self.refuse_points(rows, "'', '0', '1', '2'", "--columns")
        for choice in ("0,1,2", "2,3,4"):
            self.write("in.csv", rows)
            mesh, _ = self.triangulate("in.csv", "--columns", choice)
            self.assertEqual(points_of(mesh), PLACES)

    def test_columns_that_are_not_sure(self):
        """Names that nobody knows, and numbers of points before their coordinates."""
        self.refuse_points(text_of(PLACES, ",", "time,depth,p"), "'time', 'depth', 'p'", "--columns")
        survey = [(5000.5, 410.25, 17.5), (5001.5, 412.5, 18.5), (5000.25, 411, 17.25)]
        for numbers in ((1, 2, 3), (101, 107, 104)):
            for end in ("\n", ",TREE\n"):
                rows = text_of([(n, *p) for n, p in zip(numbers, survey)], ",", end=end)
                self.refuse_points(rows, "numbers of points", "--columns 2,3,4", "3,2,4")
        self.refuse_points("A1,1,2,3\nA2,4,5,6\n", "line 1", "'A1' is not a number", "--columns")
        self.refuse_points("52.1,N,13.2,E\n52.2,N,13.2,E\n", "line 1", "'N' is not a number")
        counted = [(n, n * 7 % 5, n % 3) for n in range(12)]
        self.refuse_points(text_of(counted, ","), "numbers of points", "--columns 2,3")
        for rows in (survey, [(0, *p) for p in survey], counted[:9], counted[1:] + counted[:1]):
            self.write("in.csv", text_of(rows, ","))
            self.triangulate("in.csv")

    def test_comments_are_prose(self):
        for comment in ("# x and y\n", "// x, and, y\n", "# x, y and z are lengths, in m\n",
                        "# time depth p\n", "# x y and other things\n", "# n e s w\n"):
            self.expect("in.xyz", comment + text_of(PLACES), PLACES)
            self.expect("in.csv", comment + text_of(PLACES, ","), PLACES)
        self.expect("in.xyz", "# x y z kind\n0 0 1 oak\n" + text_of(PLACES[1:]), PLACES,
                    "left out the columns 'kind'")

    def test_spreadsheets(self):
        comma = [text_of([(x + 0.5, y, z, x) for x, y, z in PLACES], s).replace(".", ",")
                 for s in ";\t "]
        expected = [(x + 0.5, y, z) for x, y, z in PLACES]
        for text in comma:
            self.expect("in.txt", text, expected, "left out the columns from number 4 on")
        text = "sep=;\r\nx;y;z;m\r\n" + comma[0]
        self.expect("in.csv", text, expected, "left out the columns 'm'")
        self.expect("in.txt", "x\ty\tz\tm n\n" + comma[1], expected, "left out the columns 'm n'")
        self.expect("in.csv", "sep=,\n" + text_of(PLACES, ","), PLACES)
        blank = ',,\n"","",""\n, ,\n'
        self.expect("in.csv", blank + "x,y,z\n" + blank + text_of(PLACES, ",", end="\n" + blank), PLACES)
        self.refuse_points("1,5;2\n1.5;2\n", "line 2", "'1.5' has a decimal point")
        self.refuse_points("1,500,5;2\n", "line 1", "'1,500,5' is not a number")

    def test_longer_lines(self):
        told = "left out the columns from number 3 on, which "
        self.write("in.csv", "0,0\n4,0,a\n4,3\n\n1,2,b\n")
        _, result = self.triangulate("in.csv")
        self.assertIn(told + "2 lines have (the first is line 2)", result.stderr)

    def test_nothing(self):
        for text in ("", "x,y,z\n", "# nothing\n", ",,\n", "\n\n", "sep=;\n"):
            self.refuse_points(text, "is empty")

    def test_small_print(self):
        """Quotes, a byte order mark, comments, empty lines, separators at the end, plus signs, numbers
        below the smallest, and no line end at the end."""
        self.expect("in.csv", '"x","y","z"\n"0","0","1"\n"4","0","2"\n4,4,"3"\n0,4,4\n2,2,5', PLACES)
        self.expect("in.csv", "\ufeffx;y;z;\n" + text_of(PLACES, ";", end=";\n"), PLACES)
        rows = text_of(PLACES, ",", "x,y,z,n,m")
        for first in ("0,0,1,,\n", "0,0,1,\n", "0,0,1\n"):
            self.expect("in.csv", rows.replace("0,0,1\n", first), PLACES,
                        "left out the columns 'n', 'm'")
        for name in ("#1", "//", "a, b", "a; b", 'a, ""b"", c', "a, "):
            rows = f'"{name}", "{name}",' + text_of(PLACES, ",", end=f'\n"{name}", "{name}",')
            rows = rows[:rows.rindex("\n")]
            self.expect("in.csv", "n,m,x,y,z\n" + rows, PLACES, "left out the columns 'n', 'm'")
        self.expect("in.xyz", "\n# a\n//b\n\n" + text_of(PLACES, end="\n\n#c\n"), PLACES)
        self.expect("in.xyz", "+0 1e-400 1\n" + text_of(PLACES[1:]), PLACES)

    def test_bad_lines_are_named(self):
        for text, words in {
            "1,2,3\n4,five,6\n": ["line 2", "'five' is not a number"],
            "1,2,3\n4,5\n": ["line 2", "a number is missing"],
            "1,2,3\n\n4,,6\n": ["line 3", "a number is missing"],
            "x,y,z\n1,2,3\na,b,c\n": ["line 3", "'a' is not a number"],
            "1.5;2,5;3\n": ["line 1", "'2,5' has a decimal comma"],
            "12\n1 2 3\n": ["line 1", "x y [z]"],
            "x y z\n1 0.1 0.2 0.3\n": ["line 2", "4 columns", "names has 3"],
            "x y z w\n1 2 3 4\n1  3 4\n": ["line 3", "3 columns", "have 4; a value is missing"],
            "1\t2\t3\t4 a b\n#\n1\t\t3\n": ["line 3", "2 columns", "have 4; a value is missing"],
            "lon,lat,height\n0,0,\n": ["line 2", "a number is missing"],
            "1 2 1e999\n": ["line 1", "'1e999' is out of range"],
            "x,y,z\n1,2,3\n1,5,2,5,3,5\n": ["line 3", "more than 3 numbers", "has 3 columns"],
            "1,2,3\n1,5,2,5,3,5,a\n": ["line 2", "more than 3 numbers", "has 3 columns"],
            "x\ty\n1\t2\n".encode("utf-16"): ["UTF-16", "UTF-8"],
            "0 0\n1 0 25\n": ["line 2", "more than 2 numbers", "has 2 columns"],
            "0,0,\n1,0,\n1,1,25,\n": ["line 3", "more than 2 numbers", "has 2 columns"],
            b"\x7fELF\x01\x02\n\x03 1 2\n": ["line 2"],
        }.items():
            self.refuse_points(text, *words)
        self.fail_with(3, "none.xyz", "out.vtk", "--from-points", naming=["none.xyz", "No such"])

    def test_any_mesh_gives_its_points(self):
        mesh = bumpy_grid(6, 0)
        expected = None
        for extension in FORMATS:
            path = self.write_mesh(mesh, "in" + extension)
            out, result = self.triangulate(path)
            self.assertIn("its triangles are not used", result.stderr)
            expected = expected or triangle_set(out)
            self.assertEqual(triangle_set(out), expected, extension)
        self.assertNotEqual(expected, triangle_set(mesh))


class Results(PointTest):

    def test_points_that_are_not_used(self):
        more = PLACES + [(4, 0, 9), (math.nan, 1, 1), (0, math.inf, 1), (2.01, 2, 0)]
        self.write("in.csv", text_of(more, ","))
        _, result = self.triangulate("in.csv")
        self.assertIn("points          6 used, 1 repeated, 2 not finite\n", result.stdout)
        report = self.report("in.csv", "out.vtk", "--from-points", "--point-tolerance", 0.1)
        self.assertEqual(report["repeated_points"] + report["points_too_near"], 2)
        self.assertEqual(report["points_not_finite"], 2)
        self.assertEqual(report["triangles"], 4)

    def test_bad_edges_that_are_left(self):
        self.write("in.xyz", text_of(points_of(bumpy_grid(9, 0))))
        self.assertNotIn("bad edges", self.triangulate("in.xyz")[1].stdout)
        told = self.succeed("in.xyz", "out.vtk", "--from-points", "--max-iterations", 0, code=4).stdout
        self.assertRegex(told, r"bad edges +[1-9]\d*\n")

    def test_too_few_points(self):
        for text in ("1 2 3\n", text_of([(i, i, 0) for i in range(5)])):
            self.write("in.xyz", text)
            mesh, result = self.triangulate("in.xyz")
            self.assertEqual(triangles_of(mesh), [])
            self.assertIn("no triangles", result.stdout)

    def test_plane(self):
        """Points of the plane x = 3."""
        wall = [(3, y, x) for x, y, _ in PLACES]
        self.write("in.xyz", text_of(wall))
        mesh, _ = self.triangulate("in.xyz")
        self.assertEqual(triangles_of(mesh), [])
        mesh, _ = self.triangulate("in.xyz", "--projection", "plane")
        self.assertEqual(len(triangles_of(mesh)), 4)
        for places in ([(x, y, 9 * x) for x, y, _ in PLACES], wall):
            self.write("in.xyz", text_of(places))
            ring = self.rings("ring.vtk", [places[i] for i in (0, 1, 4, 3)])
            for option in ("--outline", "--holes"):
                mesh, _ = self.triangulate("in.xyz", "--projection", "plane", option, ring)
                self.assertEqual(len(triangles_of(mesh)), 2)

    def test_sphere(self):
        """A grid has -180 and 180 degrees, and a pole at every longitude."""
        rows = [(x, y) for y in range(-90, 91, 30) for x in range(-180, 181, 30)]
        self.write("in.csv", text_of(rows, ",", "lon,lat"))
        mesh, result = self.triangulate("in.csv", "--projection", "sphere", "--degrees")
        self.assertEqual(len(triangles_of(mesh)), 2 * (12 * 5 + 2) - 4)
        self.assertRegex(result.stdout, "points +62 used, 29 repeated")
        self.assertTrue(all(math.isclose(math.hypot(*point), 1) for point in points_of(mesh)))
        self.assertNotIn("hint", result.stderr)
        for options, count in (([], 1), (["--quiet"], 0), (["--columns", "lat,lon"], 0)):
            _, result = self.triangulate("in.csv", *options)
            self.assertEqual(result.stderr.count("hint: in.csv: its points have longitudes"), count)
        self.write("in.csv", text_of([row for row in rows if row[1] > 0], ",", "lon,lat"))
        mesh, _ = self.triangulate("in.csv", "--projection", "open-sphere", "--degrees")
        self.assertEqual(len(triangles_of(mesh)), 2 * 12 + 12)
        self.fail_with(2, "in.csv", "out.vtk", "--from-points", "--projection", "sphere", "--degrees",
                       "--alpha", 1, naming=["--alpha has no meaning on a sphere"])
        self.write("in.csv", text_of(rows, ",", "lon,lat"))
        coast = self.rings("coast.vtk", [(165, -25, 0), (-175, -25, 0), (-175, 25, 0), (165, 25, 0)])
        sizes = []
        for option in ("--outline", "--holes"):
            mesh, _ = self.triangulate("in.csv", "--projection", "sphere", "--degrees", option, coast)
            sizes.append(len(triangles_of(mesh)))
        self.assertEqual(sum(sizes), 2 * (12 * 5 + 2 + 4) - 4)
        self.assertLess(sizes[0], 20)
        for projection in ([], ["--projection", "plane"]):
            self.fail_with(2, "in.csv", "out.vtk", "--from-points", "--degrees", *projection,
                           naming=["--degrees needs --projection sphere"])

    def test_triangles_of_an_open_sphere(self):
        self.write("in.csv", "lon,lat\n" + "".join(f"{x},{y}\n" for x in range(4) for y in range(4)))
        _, result = self.triangulate("in.csv", "--projection", "open-sphere", "--degrees")
        self.assertRegex(result.stdout, r"removed +0 triangles outside, \d+ with a circumcircle that encloses half of the sphere or more\n")

    def test_large_triangles(self):
        self.write("in.xyz", text_of(grid(4) + [(20, 1, 0)]))
        mesh, _ = self.triangulate("in.xyz")
        self.assertGreater(area_of(mesh), 9.5)
        for option, value in (("--longest-edge", 1.5), ("--alpha", 0.8)):
            mesh, result = self.triangulate("in.xyz", option, value)
            self.assertEqual(area_of(mesh), 9.0)
            self.assertRegex(result.stdout, r"removed +0 triangles outside, \d too large\n")


class Segments(PointTest):
    def setUp(self):
        super().setUp()
        self.write("in.xyz", text_of(grid(5)))

    def test_breaklines(self):
        """A line through points and to a place that no point is at; a polygon is a line, too."""
        line = make_mesh([(0, 0, 0), (3, 1, 0), (3.5, 1.25, 7)], [], [(0, 1, 2)])
        path = self.write_mesh(line, "line.vtk")
        mesh, result = self.triangulate("in.xyz", "--constraints", path)
        self.assertIn("segments        2 edges\n", result.stdout)
        edges = edges_of(mesh)
        self.assertIn(((0, 0), (3, 1)), edges)
        self.assertIn(((3, 1), (3.5, 1.25)), edges)
        self.assertEqual(points_of(mesh)[25:], [(3.5, 1.25, 7)])
        self.assertEqual(area_of(mesh), 16)
        polygon = make_mesh([(0, 0, 0), (4, 1, 0), (1, 4, 0)], [(0, 1, 2)])
        mesh, _ = self.triangulate(
            "in.xyz", "--constraints", self.write_mesh(polygon, "polygon.vtk"))
        self.assertIn(((0, 0), (4, 1)), edges_of(mesh))
        self.assertIn(((0, 0), (1, 4)), edges_of(mesh))
        self.assertEqual(area_of(mesh), 16)

    def test_lines_of_the_input(self):
        mesh = make_mesh(grid(5), [], [(0, 8)])
        path = self.write_mesh(mesh, "in.vtk")
        self.assertNotIn(((0, 0), (3, 1)), edges_of(self.triangulate(path)[0]))
        self.assertIn(((0, 0), (3, 1)), edges_of(self.triangulate(path, "--insert-lines")[0]))

    def test_crossings(self):
        lines = make_mesh([(0, 0, 0), (4, 1, 8), (0, 1, 0), (4, 0, 0)], [], [(0, 1), (2, 3)])
        path = self.write_mesh(lines, "lines.vtk")
        mesh, result = self.triangulate("in.xyz", "--constraints", path)
        self.assertIn("1 refused", result.stdout)
        self.assertRegex(result.stderr, r"1 segment that crosses an earlier one: with --split-crossings both "
                         r"get a point where they cross \(first: 5-4 crosses segment 0 \(points 0 and 25\)\)")
        self.assertIn(((0, 0), (4, 1)), edges_of(mesh))
        mesh, result = self.triangulate("in.xyz", "--constraints", path, "--split-crossings")
        self.assertIn("segments        4 edges, 1 crossing added\n", result.stdout)
        self.assertEqual(points_of(mesh)[25:], [(4, 1, 8), (2, 0.5, 4)])
        self.assertIn(((0, 1), (2, 0.5)), edges_of(mesh))

    def test_outline_and_holes(self):
        outline = self.rings("outline.vtk", [(0.5, 0.5, 0), (3.5, 0.5, 0), (3.5, 3.5, 0), (0.5, 3.5, 0)])
        hole = self.rings("hole.vtk", [(1.5, 1.5, 0), (1.5, 2.5, 0), (2.5, 2.5, 0), (2.5, 1.5, 0)])
        nested = self.rings("nested.vtk", [(0.5, 0.5, 0), (3.5, 0.5, 0), (3.5, 3.5, 0), (0.5, 3.5, 0)],
                            [(1, 1, 0), (3, 1, 0), (3, 3, 0), (1, 3, 0)])
        turned = self.rings("turned.vtk", [(0.5, 0.5, 0), (3.5, 0.5, 0), (3.5, 3.5, 0), (0.5, 3.5, 0)],
                            [(1, 3, 0), (3, 3, 0), (3, 1, 0), (1, 1, 0)])
        for options, area in (
            (["--outline", outline], 9), (["--holes", hole], 15), (["--outline", hole], 1),
            (["--outline", outline, "--holes", hole], 8),
            (["--outline", nested], 5), (["--outline", nested, "--holes", hole], 5),
            (["--holes", nested], 11), (["--holes", nested, "--ring-rule", "nonzero"], 7),
            (["--outline", nested, "--holes", hole, "--ring-rule", "nonzero"], 8),
            (["--outline", outline, "--constraints", hole], 9),
            (["--outline", turned, "--ring-rule", "nonzero"], 5),
            (["--outline", turned, "--ring-rule", "orientation"], 5),
            (["--outline", hole, "--ring-rule", "nonzero"], 1),
            (["--outline", hole, "--ring-rule", "orientation"], 15),
            (["--holes", hole, "--ring-rule", "orientation"], 15),
        ):
            mesh, result = self.triangulate("in.xyz", *options)
            self.assertEqual(area_of(mesh), area, options)
            self.assertRegex(result.stdout, r"removed +\d+ triangles outside, 0 too large")

    def test_outline_without_heights(self):
        self.write("in.xyz", text_of([(x, y, 100 + x) for x, y, _ in grid(5)]))
        outline = self.rings("outline.vtk", [(0.5, 0.5, 0), (3.5, 0.5, 0), (3.5, 3.5, 0)])
        line = make_mesh([(1, 1, 101), (2.5, 1.5, 101)], [], [(0, 1)])
        result = self.triangulate("in.xyz", "--outline", outline, "--constraints",
                                  self.write_mesh(line, "line.vtk"))[1]
        self.assertIn("warning: 3 points of segments without heights", result.stderr)
        line = make_mesh([(0.1, 3.1, 0), (0.2, 3.9, 0)], [], [(0, 1)])  # which the outline cuts off
        result = self.triangulate("in.xyz", "--outline", outline, "--constraints",
                                  self.write_mesh(line, "line.vtk"))[1]
        self.assertIn("warning: 3 points of segments without heights", result.stderr)
        self.assertIn("have got the heights of the given points there; --heights own keeps", result.stderr)
        for options, height in (([], 100.5), (["--heights", "own"], 0), (["--heights", "survey"], 100.5)):
            mesh, result = self.triangulate("in.xyz", "--outline", outline, *options)
            self.assertAlmostEqual(mesh.GetPoint(25)[2], height)
            self.assertEqual("warning" in result.stderr, not options)

    def test_outline_elsewhere(self):
        outline = self.rings("outline.vtk", [(50, 50, 0), (53, 50, 0), (53, 53, 0)])
        result = self.triangulate("in.xyz", "--outline", outline)[1]
        self.assertIn("points          3 used, 25 without a triangle\n", result.stdout)
        self.assertIn("the segments in x 50 to 53, y 50 to 53", result.stderr)

    def test_rings_that_are_none(self):
        for mesh, words in (
            (make_mesh(PLACES, [], [(0, 1, 2, 0), (0, 1, 2)]), ["line 1", "not end where it begins"]),
            (make_mesh(PLACES[:2], [], [(0, 7, 1, 0)]), ["cell 0 names point 7"]),
            (make_mesh(PLACES, []), ["no lines or polygons"]),
        ):
            path = self.write_mesh(mesh, "ring.vtk")
            for option in ("--outline", "--holes"):
                self.fail_with(3, "in.xyz", "out.vtk", "--from-points", option, path,
                               naming=["ring.vtk", *words])

    def test_lines_that_close_into_rings(self):
        """In any order and direction, also of other places beside closed lines."""
        square = "v 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\nv 1.25 1.25 0\nv 1.75 1.25 0\nv 1.25 1.75 0\n"
        for lines in ("l 1 2\nl 2 3\nl 3 4\nl 4 1\n", "l 4 1\nl 2 3\nl 1 2\nl 4 3\n",
                      "l 1 2 3\nv 3 3 0\nl 8 4 1\n"):
            self.write("ring.obj", square + lines + "l 5 6 7 5\n")
            mesh, _ = self.triangulate("in.xyz", "--outline", "ring.obj")
            self.assertEqual(area_of(mesh), 4 - 0.125)
        for lines, words in (("l 1 2\nl 2 3\nl 3 4\n", ["line 0", "At point 0 only this line ends"]),
                             ("l 1 2\nl 2 3\nl 3 1\nl 3 4\n", ["line 1", "At point 2 3 lines end"])):
            self.write("ring.obj", square + lines)
            self.fail_with(3, "in.xyz", "out.vtk", "--from-points", "--outline", "ring.obj",
                           naming=["ring.obj", *words])

    def test_holes_outside(self):
        """Without an outline the mesh reaches to them, which a warning says; not if they end at its border."""
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        for shift, count in ((6, 2), (3.5, 2), (3, 0), (2.5, 0)):
            hole = self.rings("hole.vtk", [(x + shift, y + min(shift, 3), z) for x, y, z in square])
            result = self.triangulate("in.xyz", "--holes", hole)[1]
            told = re.findall(r"warning: .*\b(\d) points of holes on the convex hull", result.stderr)
            self.assertEqual(told, [str(count)] if count else [], result.stderr)
            border = self.rings("border.vtk", [(x * 4, y * 4, z) for x, y, z in square])
            result = self.triangulate("in.xyz", "--holes", hole, "--outline", border, "--split-crossings")[1]
            self.assertNotIn("on the convex hull", result.stderr)

    def test_rings_that_run_twice(self):
        ring = [(1, 1, 0), (3, 1, 0), (3, 3, 0), (1, 3, 0)]
        for rule in "evenodd", "nonzero":
            rings = self.rings("ring.vtk", 2 * ring, ring[::-1])
            mesh, result = self.triangulate("in.xyz", "--outline", rings, "--ring-rule", rule)
            self.assertEqual(area_of(mesh), 4)
            self.assertIn("counted once (first: ring 0 of ring.vtk)", result.stderr)
            self.assertIn("left out (first: ring 1 of ring.vtk)", result.stderr)
        for name in ("Alpha.vtk", "Küste.vtk"):  # Alpha is the name of a property, too
            _, result = self.triangulate("in.xyz", "--holes", self.rings(name, 2 * ring))
            self.assertIn(f"(first: ring 0 of {name})", result.stderr)

    def test_rings_without_area(self):
        """They are left out, and one warning counts them, with the names of the first ones."""
        outline = [(0.5, 0.5, 0), (3.5, 0.5, 0), (3.5, 3.5, 0), (0.5, 3.5, 0)]
        rings = self.rings("some.vtk", outline, [(1, 1, 0), (2, 1, 0)], [(1, 1, 0)])
        lines = self.rings("lines.vtk", [(1, 2, 0), (3, 2, 0), (2, 2, 0)],
                           *2 * [[(4, 4, 0), (4, 4.5, 0), (4.5, 4, 0)]])
        mesh, result = self.triangulate("in.xyz", "--outline", rings, "--holes", lines)
        self.assertEqual(area_of(mesh), 9)
        self.assertEqual(result.stderr.count("warning: "), 1)
        self.assertIn("3 rings without an area, left out (first: ring 1 of some.vtk, ring 2 of some.vtk, "
                      "ring 0 of lines.vtk); 1 ring with the edges of an earlier one, left out (first: "
                      "ring 2 of lines.vtk)", result.stderr)

    def test_ring_that_is_crossed(self):
        good = [(1.5, 1.5, 0), (1.5, 2.5, 0), (2.5, 2.5, 0), (2.5, 1.5, 0)]
        bow = self.rings(
            "bow.vtk", good, [(0.5, 0.5, 0), (3.5, 3.5, 0), (3.5, 0.5, 0), (0.5, 3.0, 0)])
        for options in (["--outline", bow], ["--outline", self.rings("a.vtk", good), "--holes", bow]):
            self.fail_with(3, "in.xyz", "out.vtk", "--from-points", *options,
                           naming=["bow.vtk: ring 1", "crosses", "--split-crossings"])
        self.succeed("in.xyz", "out.vtk", "--from-points", "--outline", bow, "--split-crossings")
        bow = self.rings("bow.vtk", [(0.5, 0.5, 0), (3.5, 0.5, 0), (0.5, 3.5, 0), (3.5, 3.5, 0)])
        mesh, _ = self.triangulate("in.xyz", "--outline", bow, "--split-crossings")
        self.assertEqual(area_of(mesh), 4.5)

    def test_floats_beside_doubles(self):
        """A breakline of floats is at points of the survey, also if the outline has doubles. With a
        survey of floats, a breakline of doubles is rounded as well, with a note."""
        places = [(x / 10, y / 10, 0.1) for x, y, _ in grid(5)]
        self.write("in.xyz", text_of(places))
        line = make_mesh(places, [], [(0, 8)])
        doubles = self.write_mesh(make_mesh([*places, (0.35, 0.11, 7.7)], [], [(0, 8, 25)]), "d.vtk")
        floats = vtkPoints()
        for place in places:
            floats.InsertNextPoint(place)
        line.SetPoints(floats)
        line = self.write_mesh(line, "line.vtk")
        mesh, result = self.triangulate(line, "--constraints", doubles)
        self.assertEqual(mesh.GetNumberOfPoints(), 26)
        self.assertIn("d.vtk: its coordinates are rounded to floats", result.stderr)
        ring = self.rings("ring.vtk", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
        mesh, _ = self.triangulate("in.xyz", "--constraints", line, "--outline", ring)
        self.assertEqual(points_of(mesh)[:25], places)
        self.assertEqual(mesh.GetNumberOfPoints(), 29)
        self.assertIn(((0, 0), (0.3, 0.1)), edges_of(mesh))

    def test_point_data_of_several_files(self):
        line = make_mesh([(0, 0, 0), (3.5, 1.25, 7)], [], [(0, 1)])
        line.GetPointData().AddArray(make_array("depth", [1, 2]))
        path = self.write_mesh(line, "line.vtp")
        hole = self.rings("hole.vtk", [(1.5, 1.5, 0), (1.5, 2.5, 0), (2.5, 2.5, 0)])
        mesh, _ = self.triangulate("in.xyz", "--constraints", path)
        self.assertEqual(mesh.GetPointData().GetArray("depth").GetValue(25), 2)
        _, result = self.triangulate("in.xyz", "--constraints", path, "--holes", hole)
        self.assertIn("only arrays that all", result.stderr)


class Usage(PointTest):
    def test_options_without_effect(self):
        self.write("in.xyz", text_of(PLACES))
        for option in (
            ["--geometry", "planar"], ["--criterion", "in-circle"], ["--feature-angle", 30],
            ["--tolerance", 0], ["--tie-rule", "keep"], ["--no-insert-constraints"],
            ["--ignore-lines"], ["--region-array", "a"], ["--devices", "all"], ["--pieces", 2],
            ["--quality"], ["--merge-points"], ["--drop-duplicates"], ["--orient"],
        ):
            self.fail_with(2, "in.xyz", "out.vtk", "--from-points", *option,
                           naming=[option[0], "excludes", "--from-points"])
        path = self.write_mesh(make_mesh(PLACES, [(0, 1, 2)]), "in.vtk")
        for option in (
            ["--outline", path], ["--holes", path], ["--split-crossings"], ["--alpha", 1],
            ["--longest-edge", 1], ["--point-tolerance", 1], ["--projection", "xy"],
            ["--heights", "own"], ["--ring-rule", "nonzero"], ["--columns", "1,2"],
        ):
            self.fail_with(2, path, "out.vtk", *option,
                           naming=[option[0], "requires --from-points"])

    def test_refinement(self):
        """A square of 8 by 8 with a wall at x = 4, and a size at each corner."""
        square = make_mesh([(0, 0, 0), (8, 0, 8), (8, 8, 8), (0, 8, 0)], [(0, 1, 2, 3)])
        square.GetPointData().AddArray(make_array("depth", [3.0, 1.0, 1.0, 3.0]))
        self.write_mesh(square, "in.vtk")
        self.write_mesh(make_mesh([(4, 0, 4), (4, 8, 4)], [], [(0, 1)]), "wall.vtk")
        goals = ("--outline", "in.vtk", "--constraints", "wall.vtk", "--minimum-angle", "28",
                 "--report", self.path("report.json"))
        mesh, result = self.triangulate("in.vtk", *goals, "--maximum-area", "0.5", "--region", "1,1,7",
                                        "--region", "7,7,-2,0.1")
        self.assertAlmostEqual(area_of(mesh), 64)
        labels = mesh.GetCellData().GetArray("Region")
        points = points_of(mesh)
        for number, (ids, turn) in enumerate(zip(triangles_of(mesh), turns_of(mesh))):
            is_left = sum(points[i][0] for i in ids) < 12
            self.assertEqual(labels.GetValue(number), 7 if is_left else -2)
            self.assertLessEqual(turn / 2, 0.5 if is_left else 0.1)
        self.assertTrue(all(abs(x - z) < 1e-5 for x, _, z in points))
        report = read_report(self.path("report.json"))
        self.assertGreaterEqual(report["minimum_angle_after"], 28)
        self.assertEqual(report["unrefined_triangles"], 0)
        added = report["refinement_points"]
        self.assertEqual(len(points), 6 + added)
        self.assertRegex(result.stdout, rf"refinement +{added:,} points added in \d+ rounds?\n")
        self.assertRegex(result.stdout, r"smallest angle +[\d.]+ degrees \(asked for: 28\)")
        self.assertEqual((mesh.GetNumberOfLines(), mesh.GetPointData().HasArray("SegmentIds")), (0, 0))
        marked, _ = self.triangulate("in.vtk", *goals, "--pass-segments", "--region", "1,1,7")
        ids = marked.GetCellData().GetArray("SegmentIds")
        for line in range(marked.GetNumberOfLines()):
            ends = [points_of(marked)[marked.GetCell(line).GetPointId(k)] for k in range(2)]
            self.assertEqual(ids.GetValue(line), 0 if all(x == 4 for x, _, _ in ends) else 1)
            self.assertEqual(marked.GetCellData().GetArray("Region").GetValue(line), 0)
        self.assertEqual(ids.GetValue(marked.GetNumberOfLines()), -1)
        on_wall = [marked.GetPointData().GetArray("SegmentIds").GetValue(i) == 0 and x != 4
                   for i, (x, _, _) in enumerate(points_of(marked))]
        self.assertFalse(any(on_wall))
        mesh, _ = self.triangulate("in.vtk", "--size-array", "depth")
        points = points_of(mesh)
        for ids in triangles_of(mesh):
            corners = [points[i] for i in ids]
            longest = max(math.dist(a[:2], b[:2]) for a in corners for b in corners)
            self.assertLessEqual(longest, 3 - min(x for x, _, _ in corners) / 4 + 1e-9)
        mesh, result = self.triangulate("in.vtk", "--maximum-edge", "0.1", "--point-limit", "100")
        self.assertEqual(mesh.GetNumberOfPoints(), 100)
        self.assertIn("100 points are there, so refinement has ended: --point-limit allows no more", result.stderr)
        for extra in ([], ["--from-points"]):
            result = self.succeed("in.vtk", "out.vtk", *extra, "--keep-boundary", "--point-limit", "100")
            self.assertIn("without a goal nothing is refined: --keep-boundary, --point-limit", result.stderr)
        self.fail_with(2, "in.vtk", "out.vtk", "--from-points", "--region", "1,1,7,-1", naming=["area of 0 or more"])
        mesh, _ = self.triangulate("in.vtk", *goals[:2], "--maximum-edge", "1", "--keep-boundary")
        self.assertEqual(sum(x in (0, 8) or y in (0, 8) for x, y, _ in points_of(mesh)), 4)
        self.fail_with(2, "in.vtk", "out.vtk", "--from-points", "--size-array", "width",
                       naming=["in.vtk", "--size-array", '"depth"'])

    def test_refinement_of_a_mesh(self):
        """A square of four triangles in two zones, in a plane that rises, with a size at each point."""
        square = make_mesh([(0, 0, 0), (8, 0, 8), (8, 8, 8), (0, 8, 0), (4, 0, 4), (4, 8, 4)],
                           [(0, 4, 3), (4, 5, 3), (4, 1, 5), (1, 2, 5)])
        square.GetPointData().AddArray(make_array("depth", [3.0, 1.0, 1.0, 3.0, 2.0, 2.0]))
        square.GetCellData().AddArray(make_array("zone", [7.0, 7.0, -2.0, -2.0]))
        self.write_mesh(square, "in.vtk")
        goals = ("--geometry", "planar-xy", "--region-array", "zone", "--report", self.path("report.json"))
        for more in (["--minimum-angle", 28], ["--maximum-area", 0.2], ["--size-array", "depth"]):
            result = self.succeed("in.vtk", "out.vtk", *goals, *more)
            report = read_report(self.path("report.json"))
            mesh = self.read_mesh("out.vtk")
            points, labels = points_of(mesh), mesh.GetCellData().GetArray("zone")
            self.assertEqual(len(points), 6 + report["refinement_points"])
            self.assertLess(2, report["refinement_points"])
            self.assertAlmostEqual(area_of(mesh), 64)
            for number, ids in enumerate(triangles_of(mesh)):
                is_left = sum(points[i][0] for i in ids) < 12
                self.assertEqual(labels.GetValue(number), 7 if is_left else -2)
            self.assertTrue(all(abs(x - z) < 1e-5 for x, _, z in points))
            self.assertRegex(result.stdout, r"points added in \d+ rounds?\n")
        self.succeed("in.vtk", "seeded.vtk", *goals, "--region", "1,1,5,0.3", "--region", "7,1,-9")
        mesh = self.read_mesh("seeded.vtk")
        labels, seeded = (mesh.GetCellData().GetArray(name) for name in ("zone", "Region"))
        for number, turn in enumerate(turns_of(mesh)):
            self.assertEqual(seeded.GetValue(number), 5 if labels.GetValue(number) == 7 else -9)
            self.assertLessEqual(turn / 2, 0.3 if labels.GetValue(number) == 7 else 64)
        self.assertGreater(mesh.GetNumberOfPoints(), 50)
        mesh = self.read_mesh("out.vtk")
        depths = mesh.GetPointData().GetArray("depth")
        self.assertTrue(all(abs(3 - x / 4 - depths.GetValue(i)) < 1e-5 for i, (x, _, _) in enumerate(points)))
        self.fail_with(2, "in.vtk", "out.vtk", "--geometry", "surface", "--minimum-angle", 20,
                       naming=["surface in space", "choose --geometry planar-xy to"])
        self.fail_with(2, "in.vtk", "out.vtk", "--size-array", "width", naming=["--size-array", '"depth"'])
        result = self.succeed("in.vtk", "out.vtk", "--maximum-edge", "0.1", "--point-limit", "100")
        self.assertIn("so refinement has ended: --point-limit allows no more", result.stderr)

    def test_values(self):
        self.write("in.xyz", text_of(PLACES))
        for option, values in {"--minimum-angle": ("-1", "33.5", "nan"), "--maximum-area": ("-1", "inf"),
                               "--maximum-edge": ("a",), "--point-limit": ("-1", "1.5"),
                               "--region": ("1,2", "1,2,3.5", "1,2,3,-1", "1,2,3,4,5", "1,nan,3", "")}.items():
            for value in values:
                self.fail_with(2, "in.xyz", "out.vtk", "--from-points", option, value, naming=[option])
        for option in ("--alpha", "--longest-edge", "--point-tolerance"):
            for value in ("-1", "nan", "inf", "a"):
                self.fail_with(2, "in.xyz", "out.vtk", "--from-points", option, value, naming=[option])
        self.fail_with(2, "in.xyz", "out.vtk", "--from-points", "--projection", "yz",
                       naming=["--projection"])

    def test_files_that_have_no_triangles(self):
        self.write("in.xyz", text_of(PLACES))
        self.fail_with(2, "in.xyz", "out.vtk", naming=["in.xyz", "--from-points"])
        path = self.write_mesh(make_mesh(PLACES, []), "in.vtk")
        result = self.succeed(path, "out.vtk")
        self.assertIn("no triangles; --from-points makes them", result.stderr)
        path = self.write_mesh(make_mesh([], []), "in.vtk")
        for options in ([], ["--from-points"]):
            told = self.succeed(path, "out.vtk", *options).stderr
            self.assertIn("in.vtk: is empty: it contains no points\n", told)
            self.assertNotIn("--from-points", told)

    def test_files_for_other_purposes(self):
        self.write("in.xyz", text_of(PLACES))
        self.fail_with(2, "in.xyz", "out.csv", "--from-points", naming=["out.csv", ".vtp"])
        for option in ("--constraints", "--outline", "--holes"):
            self.fail_with(2, "in.xyz", "out.vtk", "--from-points", option, "a.tex",
                           naming=["a.tex: unknown file extension"])
            self.fail_with(2, "in.xyz", "out.vtk", "--from-points", option, "out.vtk",
                           naming=["out.vtk", "two purposes"])
