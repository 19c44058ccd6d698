# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""--raster and --heights-at: values at places in a triangulation of points."""

import math
import os
import random
import struct
import zlib

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

from CommandTesting import make_array, make_mesh
from TestPoints import PLACES, PointTest, text_of


def plane(x, y):
    return 0.5 * x + 0.25 * y + 10


def scattered(count=400, size=16.0, seed=5):
    """Points of the plane, with the corners of a square."""
    draw = random.Random(seed).uniform
    places = [(0, 0), (size, 0), (size, size), (0, size)]
    places += [(draw(0, size), draw(0, size)) for _ in range(count)]
    return [(x, y, plane(x, y)) for x, y in places]


def read_geotiff(content):
    """The tags of a TIFF of one band, and its rows from the north: doubles in tiles, compressed by
    Deflate after the differences of their bytes, which are sorted by significance."""
    offset, tags = struct.unpack("<4xI", content[:8])[0], {}
    for i in range(struct.unpack_from("<H", content, offset)[0]):
        tag, kind, count = struct.unpack_from("<HHI", content, offset + 2 + 12 * i)
        code = {1: "B", 2: "B", 3: "H", 4: "I", 12: "d"}[kind]
        place = offset + 10 + 12 * i
        if struct.calcsize(code) * count > 4:
            place = struct.unpack_from("<I", content, place)[0]
        tags[tag] = struct.unpack_from(f"<{count}{code}", content, place)
    (width,), (height,), (size,) = tags[256], tags[257], tags[322]
    across = -(-width // size)
    rows = numpy.empty((-(-height // size) * size, across * size))
    for number, (begin, length) in enumerate(zip(tags[324], tags[325])):
        tile = numpy.frombuffer(zlib.decompress(content[begin:begin + length]), numpy.uint8)
        tile = numpy.cumsum(tile.reshape(size, 8 * size), axis=1, dtype=numpy.uint8)
        tile = tile.reshape(size, 8, size).transpose(0, 2, 1).tobytes()
        y, x = number // across * size, number % across * size
        rows[y:y + size, x:x + size] = numpy.frombuffer(tile, ">f8").reshape(size, size)
    return tags, rows[:height, :width]


class HeightTest(PointTest):
    def setUp(self):
        super().setUp()
        self.write("plane.csv", text_of(scattered(), ","))
        self.write("peak.csv", text_of(PLACES, ","))

    def ask(self, name, output, *options):
        return self.succeed(name, output, "--from-points", *options)

    def grid(self, name):
        """The header of an .asc, and its rows from the north."""
        lines = self.content(name).decode().splitlines()
        header = {key: float(value) for key, value in map(str.split, lines[:6])}
        rows = numpy.array([list(map(float, line.split())) for line in lines[6:]])
        self.assertEqual(rows.shape, (header["nrows"], header["ncols"]))
        return header, numpy.where(rows == header["NODATA_value"], math.nan, rows)

    def image(self, name):
        """The rows of a .vti from the south, with x and y, and the name of the values."""
        reader = vtkXMLImageDataReader()
        reader.SetFileName(self.path(name))
        reader.Update()
        image = reader.GetOutput()
        columns, rows, _ = image.GetDimensions()
        x = image.GetOrigin()[0] + image.GetSpacing()[0] * numpy.arange(columns)
        y = image.GetOrigin()[1] + image.GetSpacing()[1] * numpy.arange(rows)
        values = image.GetPointData().GetScalars()
        return x, y[:, None], vtk_to_numpy(values).reshape(rows, columns).copy(), values.GetName()


class Rasters(HeightTest):
    def test_plane(self):
        """Linear functions are reproduced, by both methods and in both formats of whole precision."""
        for method in ([], ["--raster-method", "natural"]):
            result = self.ask("plane.csv", "out.vti", "--raster", 0.25, *method)
            self.assertIn("raster          64 x 64 cells, 0 outside\n", result.stdout)
            x, y, values, name = self.image("out.vti")
            self.assertEqual((x[0], x[-1], y[0], y[-1], name), (0.125, 15.875, 0.125, 15.875, "z"))
            self.assertLess(abs(values - plane(x, y)).max(), 1e-12)
            self.ask("plane.csv", "out.asc", "--raster", 0.25, *method)
            header, rows = self.grid("out.asc")
            self.assertEqual([header[key] for key in ("xllcenter", "yllcenter", "cellsize")],
                             [0.125, 0.125, 0.25])
            self.assertTrue((rows[::-1] == values).all())

    def test_by_hand(self):
        """Cells of a square with a peak inside; a place on an edge; the extent, and what is outside."""
        self.ask("peak.csv", "out.asc", "--raster", 1, "--extent", "-0.5,-0.5,5.25,4.5")
        header, rows = self.grid("out.asc")
        self.assertEqual(rows.shape, (5, 6))
        self.assertEqual((header["xllcenter"], header["yllcenter"]), (0, 0))
        south = rows[::-1]
        self.assertEqual(south[0, :5].tolist(), [1, 1.25, 1.5, 1.75, 2])
        self.assertEqual(south[1, 2], 0.25 * 1 + 0.25 * 2 + 0.5 * 5)
        self.assertEqual(south[1, 1], 3)
        self.assertEqual(south[2, 2], 5)
        self.assertEqual(south[3, 3], 4)
        self.assertTrue(numpy.isnan(south[:, 5]).all())
        self.ask("peak.csv", "out.asc", "--raster", 1.5)
        header, rows = self.grid("out.asc")
        self.assertEqual((header["xllcenter"], *rows.shape), (0.75, 3, 3))
        self.assertEqual(rows[2, 0], 0.75 / 2 * 5 + 0.625 * 1)

    def test_globe(self):
        """A map goes on at 180 degrees, and a pole has one value."""
        rows = [(x, y, 100 - abs(y)) for y in range(-90, 91, 30) for x in range(-180, 180, 30)]
        self.write("globe.csv", text_of(rows, ",", "lon,lat,z"))
        sphere = ["--projection", "sphere", "--degrees"]
        for method in ([], ["--raster-method", "natural"]):
            result = self.ask("globe.csv", "map.asc", *sphere, "--raster", 30, "--extent", "-195,-105,195,105",
                              *method)
            self.assertIn("raster          13 x 7 cells, 0 outside\n", result.stdout)
            _, values = self.grid("map.asc")
            expected = [[100 - abs(y)] * 13 for y in range(90, -91, -30)]
            self.assertEqual(values.tolist(), expected)
        self.write("places.csv", "lon,lat\n179,0\n-181,0\n5,90\n")
        self.ask("globe.csv", "out.csv", *sphere, "--heights-at", "places.csv")
        heights = [float(line.split(",")[2]) for line in self.content("out.csv").decode().splitlines()[1:]]
        self.assertEqual(heights[0], heights[1])
        self.assertEqual(heights[2], 10)
        for asked in (["map.asc", "--raster", 1], ["out.csv", "--heights-at", "places.csv"]):
            self.fail_with(2, "globe.csv", *asked, "--from-points", "--projection", "sphere",
                           naming=["need --degrees, or --raster-array", "z is one of three coordinates"])

    def test_extent_across_180_degrees(self):
        """Points around Fiji get a raster of Fiji, and not one around the Earth."""
        sphere = ["--projection", "open-sphere", "--degrees", "--raster", 5]
        rows = [(x if x <= 180 else x - 360, y, y) for y in range(-20, -9, 5) for x in range(170, 191, 5)]
        self.write("fiji.csv", text_of(rows, ",", "lon,lat,z"))
        result = self.ask("fiji.csv", "map.asc", *sphere)
        self.assertIn("raster          4 x 2 cells, 0 outside\n", result.stdout)
        self.assertEqual(self.grid("map.asc")[0]["xllcenter"], 172.5)
        for west, east in ((-180, 90), (-90, 200), (-200, 190)):
            self.write("wide.csv", text_of([(x, y, 1) for x in range(west, east + 1, 10) for y in (0, 5)], ",",
                                           "lon,lat,z"))
            self.ask("wide.csv", "map.asc", *sphere)
            self.assertEqual(self.grid("map.asc")[0]["xllcenter"], west + 2.5)

    def test_mesh_of_a_globe(self):
        """It has the heights of its stations as an array, which goes on maps and to directions."""
        draw = numpy.random.default_rng(4)
        rows = [(x, math.degrees(math.asin(z)), 100 + x) for x, z in zip(draw.uniform(-180, 180, 300),
                                                                         draw.uniform(-1, 1, 300))]
        self.write("stations.csv", text_of(rows, ",", "lon,lat,height"))
        sphere = ["--projection", "sphere"]
        self.ask("stations.csv", "globe.vtp", *sphere, "--degrees")
        self.ask("stations.csv", "one.asc", *sphere, "--degrees", "--raster", 10, "--extent=-180,-90,180,90")
        self.ask("globe.vtp", "two.asc", *sphere, "--raster", 10, "--raster-array", "Height")
        (header, one), (same, two) = self.grid("one.asc"), self.grid("two.asc")
        self.assertEqual(header, same)
        self.assertEqual(one.shape, (18, 36))
        self.assertLess(abs(one - two).max(), 1e-6)
        self.write("places.csv", "x,y,z\n0,0,2\n1,-1,0\n")
        self.ask("globe.vtp", "out.csv", *sphere, "--heights-at", "places.csv", "--raster-array", "Height")
        lines = self.content("out.csv").decode().splitlines()
        self.assertEqual(lines[0], "x,y,z,Height")
        self.assertEqual([line.rpartition(",")[0] for line in lines[1:]], ["0,0,2", "1,-1,0"])
        for names in ("lon,lat", "x,y"):
            self.write("angles.csv", names + "\n77,90\n-45,0\n")
            result = self.ask("globe.vtp", "angles_out.csv", *sphere, "--heights-at", "angles.csv",
                              "--raster-array", "Height")
            self.assertIn("its x and y are longitudes and latitudes", result.stderr)
            found = self.content("angles_out.csv").decode().splitlines()
            self.assertEqual([line.rpartition(",")[0] for line in found], ["x,y", "77,90", "-45,0"])
            for one, other in zip(found[1:], lines[1:]):
                heights = [float(line.rpartition(",")[2]) for line in (one, other)]
                self.assertAlmostEqual(*heights, places=6)

    def test_latitudes_beyond_the_poles(self):
        self.write("globe.csv", "lon,lat,z\n0,0,1\n90,0,2\n180,0,3\n-90,0,4\n0,90,5\n0,-90,6\n")
        self.write("places.csv", "lon,lat\n52.5,113.4\n13.4,52.5\n")
        sphere = ["--projection", "sphere", "--degrees"]
        result = self.ask("globe.csv", "out.csv", *sphere, "--heights-at", "places.csv")
        self.assertIn("1 point with a latitude beyond 90 degrees (first: 0)", result.stderr)
        self.fail_with(2, "globe.csv", "map.asc", "--from-points", *sphere, "--raster", 5,
                       "--extent", "0,-100,360,100", naming=["--extent", "latitudes beyond 90 degrees"])

    def test_points_without_heights(self):
        self.write("flat.csv", "x,y\n0,0\n4,0\n0,4\n")
        result = self.ask("flat.csv", "o.asc", "--raster", "1")
        self.assertIn("all heights are 0, as those of the points are; --columns", result.stderr)
        result = self.ask("plane.csv", "o.asc", "--raster", "1")
        self.assertNotIn("all heights are 0", result.stderr)

    def test_what_rasters_cannot_hold(self):
        self.write("none.csv", "x,y,z\n0,0,1\n4,0,nan\n0,4,1\n4,4,1\n")
        result = self.ask("none.csv", "o.asc", "--raster", "1")
        self.assertRegex(result.stderr, r"o.asc: \d+ places have no value, because points around")
        self.write("low.csv", "x,y,z\n0,0,-9999\n4,0,-9999\n0,4,-9999\n")
        result = self.ask("low.csv", "o.asc", "--raster", "1")
        self.assertRegex(result.stderr, r"o.asc: \d+ heights are -9999, which an .asc has for no value")
        result = self.ask("low.csv", "o.vti", "--raster", "1")
        self.assertNotIn("-9999", result.stderr)
        self.write("high.csv", "x,y,z\n0,0,inf\n4,0,inf\n0,4,inf\n")
        result = self.ask("high.csv", "o.asc", "--raster", "1")
        self.assertRegex(result.stderr, r"o.asc: \d+ heights are infinite, which an .asc cannot have")
        self.assertNotIn(b"inf", self.content("o.asc"))
        result = self.ask("high.csv", "o.vti", "--raster", "1")
        self.assertNotIn("infinite", result.stderr)

    def test_too_large(self):
        for output, extent in (("o.asc", "0,0,2e9,300"), ("o.vti", "0,0,3000,2e9")):
            self.fail_with(2, "plane.csv", output, "--from-points", "--raster", 1, "--extent", extent,
                           naming=["--raster: ", "2,000,000,000", "cells of 1 need", "MB", "--extent"])

    def test_old_reference_system(self):
        self.write("o.prj", "of an earlier file")
        result = self.ask("plane.csv", "o.asc", "--raster", "1")
        self.assertIn("o.prj is that of an earlier file", result.stderr)

    def test_blocks(self):
        """A raster of several blocks of rows, the last one not whole."""
        self.ask("plane.csv", "out.vti", "--raster", 2**-10, "--extent", "1,2,17,2.5")
        x, y, values, _ = self.image("out.vti")
        self.assertEqual(values.shape, (512, 16384))
        inside = x < 16
        self.assertLess(abs(values - plane(x, y))[:, inside].max(), 1e-12)
        self.assertTrue(numpy.isnan(values[:, ~inside]).all())

    def test_outline_and_array(self):
        """What an outline removes has no values; other values than heights; breaklines count."""
        points = make_mesh(PLACES, [])
        points.GetPointData().AddArray(make_array("depth", [8, 8, 8, 8, 0]))
        points.GetPointData().AddArray(make_array("x", [1, 2, 3, 4, 5]))
        self.write_mesh(points, "in.vtp")
        ring = self.rings("ring.vtk", [(0, 0, 1), (4, 0, 2), (4, 4, 3)])
        result = self.ask("in.vtp", "out.vti", "--raster", 1, "--raster-array", "depth",
                          "--outline", ring)
        _, _, values, name = self.image("out.vti")
        self.assertEqual(name, "depth")
        self.assertEqual(values[0].tolist()[1:], [6, 6, 6])
        self.assertTrue(math.isnan(values[3, 0]))
        self.assertIn("raster          4 x 4 cells, 6 outside\n", result.stdout)
        self.fail_with(3, "in.vtp", "out.vti", "--from-points", "--raster", 1, "--raster-array", "z",
                       naming=["in.vtp", "no array 'z'", "'depth', 'x'", "it is z that is taken"])
        flat = self.rings("flat.vtk", [(1, 1, 0), (3, 1, 0), (3, 3, 0)])
        result = self.ask("in.vtp", "o.asc", "--raster", 1, "--outline", flat)
        self.assertIn("without heights", result.stderr)
        result = self.ask("in.vtp", "o.asc", "--raster", 1, "--outline", flat, "--raster-array", "depth")
        self.assertNotIn("without heights", result.stderr)
        line = self.write_mesh(make_mesh([(0, 4, 4), (2, 3, 0), (4, 4, 3)], [], [(0, 1, 2)]), "l.vtk")
        self.ask("peak.csv", "out.vti", "--raster", 1, "--extent", "1.5,2.5,2.5,3.5", "--constraints", line)
        self.assertEqual(self.image("out.vti")[2].tolist(), [[0]])

    def test_geotiff(self):
        result = self.run_command("plane.csv", "out.tif", "--from-points", "--raster", 0.25, "--crs",
                                  "EPSG:25832", "--extent", "-1,0,16,16")
        if "needs GDAL" in result.stderr:
            self.skipTest(result.stderr)
        self.assertEqual(result.returncode, 0, result.stderr)
        tags, rows = read_geotiff(self.content("out.tif"))
        self.assertEqual(rows.shape, (64, 68))
        self.assertEqual(tags[33550][:2], (0.25, 0.25))  # the size of a cell
        self.assertEqual(tags[33922], (0, 0, 0, -1, 16, 0))  # where the north-western corner is
        keys = numpy.array(tags[34735]).reshape(-1, 4).tolist()
        self.assertIn([3072, 0, 1, 25832], keys)  # the projected coordinate reference system
        self.assertEqual(bytes(tags[42113]), b"nan\0")  # what cells without a value have
        self.assertTrue(numpy.isnan(rows[:, :4]).all())
        centres = (numpy.arange(64) + 0.5) / 4
        self.assertLess(abs(rows[::-1, 4:] - plane(centres, centres[:, None])).max(), 1e-12)
        self.assertEqual(sorted(os.listdir(self.folder)), ["out.tif", "peak.csv", "plane.csv"])

    def test_reference_system(self):
        run = ["plane.csv", "out.asc", "--from-points", "--raster", 4, "--crs"]
        result = self.run_command(*run, "EPSG:25832")
        if "needs GDAL" in result.stderr:
            self.skipTest(result.stderr)
        self.assertIn(b'PROJCS["ETRS_1989_UTM_Zone_32N"', self.content("out.prj"))
        for crs in ("EPSG:1", "Atlantis", "/etc/passwd"):
            self.fail_with(2, *run, crs, naming=["out.asc", crs, "EPSG:25832"])
        self.write("libdelaunayflip-gdal.so", "")
        environment = dict(os.environ, LD_LIBRARY_PATH=self.folder)
        self.fail_with(2, "plane.csv", "out.tif", "--from-points", "--raster", 1, env=environment,
                       naming=["out.tif: needs GDAL", "libgdal"])
        self.ask("plane.csv", "out.vti", "--raster", 1, "--quiet")


    def test_reference_systems_that_a_file_cannot_name(self):
        """Said before the work begins."""
        rotated = "+proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=39.25 +lon_0=18 +datum=WGS84"
        for name, crs in (("out.asc", rotated), ("out.asc", "EPSG:4978"), ("out.tif", rotated),
                          ("out.tif", "EPSG:5773")):
            told = self.run_command("plane.csv", name, "--from-points", "--raster", 1, "--crs", crs)
            if "needs GDAL" in told.stderr:
                self.skipTest(told.stderr)
            self.fail_with(2, "plane.csv", name, "--from-points", "--raster", 1, "--crs", crs, naming=[
                f"{name}: its format has no way to name {crs}", "without --crs"])


class Tables(HeightTest):
    def test_places(self):
        self.write("places.csv", "x,y\n2,1\n4.5,1\n2,2\nnan,1\n1,1\n")
        result = self.ask("peak.csv", "out.csv", "--heights-at", "places.csv")
        self.assertEqual(self.content("out.csv").decode(), "x,y,z\n2,1,3.25\n4.5,1,\n2,2,5\nnan,1,\n1,1,3\n")
        self.assertIn("places          5, 2 outside\n", result.stdout)
        report = self.report("peak.csv", "out.csv", "--from-points", "--heights-at", "places.csv")
        self.assertEqual((report["places"], report["places_outside"], report["triangles"]), (5, 2, 4))
        # A row without numbers keeps its place in the table; a line without cells is no row.
        for names in ("", "x,y\n"):
            self.write("places.csv", f",\n{names},\n2,1\n,\n\n#,\n1,1\n,\n")
            self.ask("peak.csv", "out.csv", "--heights-at", "places.csv")
            before = "nan,nan,\n" * (1 if names else 2)
            self.assertEqual(self.content("out.csv").decode(),
                             f"x,y,z\n{before}2,1,3.25\nnan,nan,\n1,1,3\nnan,nan,\n")
        for text, told in (("east,north,id\n2,1,7\n", "as x, y\n"), ("east,north,alt,id\n2,1,9,7\n", "as x, y\n")):
            self.write("places.csv", text)
            result = self.ask("peak.csv", "out.csv", "--heights-at", "places.csv")
            self.assertIn(told, result.stderr)
            self.assertIn("left out the columns 'id'\n", result.stderr)
            self.assertEqual(self.content("out.csv").decode(), "x,y,z\n2,1,3.25\n")
        self.write("places.csv", "9,9\n8,8\n")
        result = self.ask("peak.csv", "out.csv", "--heights-at", "places.csv", "--raster-method", "natural")
        self.assertIn("warning: out.csv: has no value", result.stderr)

    def test_names_of_arrays(self):
        """In a table they are quoted like other text. The mask of places has a name of its own."""
        self.write("places.csv", "x,y\n1,1\n")
        for name, head in (("a,b", 'x,y,"a,b"'), ('a"b', 'x,y,"a""b"'), ("plain name", "x,y,plain name")):
            mesh = make_mesh(PLACES, [])
            mesh.GetPointData().AddArray(make_array(name, [1, 2, 3, 4, 5]))
            mesh.GetPointData().AddArray(make_array("vtkValidPointMask", [1, 2, 3, 4, 5]))
            path = self.write_mesh(mesh, "in.vtk")
            self.ask(path, "out.csv", "--heights-at", "places.csv", "--raster-array", name)
            self.assertEqual(self.content("out.csv").decode().splitlines(), [head, "1,1,3"])
        self.fail_with(2, path, "out.csv", "--from-points", "--heights-at", "places.csv", "--raster-array",
                       "vtkValidPointMask", naming=["--raster-array", "vtkValidPointMask", "another name"])
        for name in ("a<b", "a&b", 'a"b', "a\nb"):
            mesh = make_mesh(PLACES, [])
            mesh.GetPointData().AddArray(make_array(name, [1, 2, 3, 4, 5]))
            path = self.write_mesh(mesh, "in.vtk")
            self.fail_with(3, path, "out.vti", "--from-points", "--raster", 1, "--raster-array", name, naming=[
                "out.vti", "< > & \" or a control character in the name", "a .tif or .asc can hold it"])

    def test_rows_of_empty_cells_between_tabs(self):
        """They are rows, as between commas. An empty line is none."""
        self.write("places.txt", "x\ty\n\t\n1\t1\n \t \n\n2\t2\n\t\n")
        self.ask("peak.csv", "out.csv", "--heights-at", "places.txt")
        self.assertEqual(self.content("out.csv").decode().splitlines(),
                         ["x,y,z", "nan,nan,", "1,1,3", "nan,nan,", "2,2,5", "nan,nan,"])
        self.write("places.txt", "x\ty\n# a comment, with a comma\n\t\n1\t1\n")
        self.ask("peak.csv", "out.csv", "--heights-at", "places.txt")
        self.assertEqual(self.content("out.csv").decode().splitlines(), ["x,y,z", "nan,nan,", "1,1,3"])
        self.write("in.txt", "x\ty\tz\n\t\t\n" + text_of(PLACES, "\t", end="\n\t\t\n"))
        self.assertEqual(self.triangulate("in.txt")[0].GetNumberOfPoints(), 5)

    def test_usage(self):
        for code, options, words in (
            (2, ["out.vtp", "--from-points", "--raster", 1], ["out.vtp", ".tif, .asc or .vti"]),
            (2, ["out.tif", "--from-points"], ["out.tif", "--raster"]),
            (2, ["out.asc", "--raster", 1], ["requires --from-points"]),
            (2, ["out.asc", "--from-points", "--raster", 0], ["--raster"]),
            (2, ["out.asc", "--from-points", "--raster", 1e-12], ["2^31"]),
            (2, ["out.asc", "--from-points", "--raster", 1, "--extent", "0,0,0,1"], ["'0,0,0,1'"]),
            (2, ["out.asc", "--from-points", "--raster", 1, "--extent", "0,0,1"], ["xmin,ymin"]),
            (2, ["out.asc", "--from-points", "--extent", "0,0,1,1"], ["requires --raster"]),
            (2, ["out.vtp", "--from-points", "--raster-method", "natural"],
             ["--raster-method requires --raster or --heights-at"]),
            (2, ["out.vtp", "--from-points", "--raster-array", "z"], ["--raster-array requires --raster or"]),
            (2, ["out.asc", "--from-points", "--heights-at", "peak.csv"], ["writes a .csv"]),
            (2, ["out.asc", "--from-points", "--heights-at", "peak.csv", "--raster", 1], ["excludes"]),
            (2, ["out.vti", "--from-points", "--raster", 1, "--crs", "EPSG:4326"], ["--crs is for"]),
            (2, ["peak.csv", "--from-points", "--heights-at", "peak.csv"], ["two purposes"]),
        ):
            self.fail_with(code, "plane.csv", *options, naming=words)
