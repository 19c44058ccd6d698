# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Points, breaklines and rings in shapefiles, GeoPackage, GeoJSON, DXF and FlatGeobuf, which GDAL
reads, and lines in text."""

import base64
import json
import math
import os
import sqlite3
import struct
import threading
import zlib

from CommandTesting import points_of, same, triangles_of, values_of
from TestPoints import PLACES, PointTest, area_of, edges_of, grid, text_of

FLAT_GEOBUF = (  # PLACES, by GDAL
    "eNpLS09iTktPYsxhYGBQYIAACQYZBg4GHgYWBlaoiACDCAMbUJyBgZGRgcEGSIsAMQ8Qw1SAAAsDLiDgAKOB2hkKgDgEbC"
    "oMsDFwAXWzwcW4wGazAF3BBXYPxGxGuPoP9iCSCYtNlJnL4IBqLszdlJrLgcNcAQfKzBVwwB4OlJorgm4uLBwcAJ4lDVI=")
HINT = ("hint: points.geojson: its points have longitudes and latitudes; --projection sphere --degrees joins "
        "them on a globe\n")
SQUARE = [[0.5, 0.5], [3.5, 0.5], [3.5, 3.5], [0.5, 3.5], [0.5, 0.5]]
HOLE = [[1.5, 1.5], [1.5, 2.5], [2.5, 2.5], [2.5, 1.5], [1.5, 1.5]]


def geojson(*features, crs=None):
    """A file of pairs of a type of geometry and coordinates, and perhaps attributes. Without `crs`, GDAL
    takes them for longitudes and latitudes."""
    made = []
    for kind, coordinates, *attributes in features:
        key = "geometries" if kind == "GeometryCollection" else "coordinates"
        geometry = kind and {"type": kind, key: coordinates}
        made.append({"type": "Feature", "geometry": geometry,
                     "properties": attributes[0] if attributes else {}})
    named = {"crs": {"type": "name", "properties": {"name": crs}}} if crs else {}
    return json.dumps({"type": "FeatureCollection", "features": made, **named})


def dxf(*entities, labels=""):
    """A drawing of pairs of a layer and places: a point, or a line."""
    text = "0\nSECTION\n2\nENTITIES\n" + labels
    for layer, places in entities:
        head = f"0\nPOINT\n8\n{layer}\n"
        if len(places) > 1:
            head = f"0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n8\n"
            places = [f"0\nVERTEX\n8\n{layer}\n70\n32\n" + at(place) for place in places]
            text += head + "".join(places) + f"0\nSEQEND\n8\n{layer}\n"
        else:
            text += head + at(places[0])
    return text + "0\nENDSEC\n0\nEOF\n"


def at(place):
    return "10\n{}\n20\n{}\n30\n{}\n".format(*place)


def shapefile(points):
    """A .shp and a .shx of points with z."""
    def header(length):
        return struct.pack(">7i", 9994, 0, 0, 0, 0, 0, length) + struct.pack("<2i8d", 1000, 11, *[0] * 8)

    records = index = b""
    for number, point in enumerate(points, 1):
        index += struct.pack(">2i", 50 + len(records) // 2, 18)
        records += struct.pack(">2i", number, 18) + struct.pack("<i4d", 11, *point, 0)
    return (header(50 + len(records) // 2) + records, header(50 + len(index) // 2) + index)


def write_geopackage(path, systems=None, attributes=None, **layers):
    """A GeoPackage of layers of points with z. `systems` has a number of EPSG for some of them, and
    `attributes` columns, such as {"n INTEGER": values}."""
    data = sqlite3.connect(path)
    data.executescript("""
        PRAGMA application_id = 1196444487; PRAGMA user_version = 10200;
        CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT, srs_id INTEGER PRIMARY KEY,
          organization TEXT, organization_coordsys_id INTEGER, definition TEXT, description TEXT);
        INSERT INTO gpkg_spatial_ref_sys VALUES ('u', -1, 'NONE', -1, 'undefined', '');
        CREATE TABLE gpkg_contents (table_name TEXT PRIMARY KEY, data_type TEXT, identifier TEXT,
          description TEXT, last_change DATETIME, min_x REAL, min_y REAL, max_x REAL, max_y REAL,
          srs_id INTEGER);
        CREATE TABLE gpkg_geometry_columns (table_name TEXT PRIMARY KEY, column_name TEXT,
          geometry_type_name TEXT, srs_id INTEGER, z TINYINT, m TINYINT);""")
    for name, points in layers.items():
        system = (systems or {}).get(name, -1)
        columns = (attributes or {}).get(name, {})
        data.execute("INSERT OR IGNORE INTO gpkg_spatial_ref_sys VALUES ('s', ?, 'EPSG', ?, 'undefined', '')",
                     (system, system))
        data.execute(f'CREATE TABLE "{name}" ({", ".join(["fid INTEGER PRIMARY KEY, geom POINT", *columns])})')
        data.execute("INSERT INTO gpkg_contents (table_name, data_type, last_change, srs_id) "
                     "VALUES (?, 'features', '2026-01-01T00:00:00Z', ?)", (name, system))
        data.execute("INSERT INTO gpkg_geometry_columns VALUES (?, 'geom', 'POINT', ?, 1, 0)", (name, system))
        for number, point in enumerate(points):
            blob = b"GP\0\1" + struct.pack("<i", system) + struct.pack("<BI3d", 1, 1001, *point)
            row = [number + 1, blob, *(values[number] for values in columns.values())]
            data.execute(f'INSERT INTO "{name}" VALUES ({", ".join("?" * len(row))})', row)
    data.commit()
    data.close()


class VectorTest(PointTest):
    def setUp(self):
        super().setUp()
        self.write("points.geojson", geojson(*(("Point", place) for place in PLACES)))
        told = self.run_command("points.geojson", "out.vtp", "--from-points").stderr
        if "needs GDAL" in told:
            self.skipTest(told)


class Vectors(VectorTest):
    def test_formats(self):
        shp, shx = shapefile(PLACES)
        self.write("points.shp", shp)
        self.write("points.shx", shx)
        write_geopackage(self.path("points.gpkg"), survey=PLACES)
        self.write("points.dxf", dxf(*(("0", [place]) for place in PLACES)))
        self.write("points.FGB", zlib.decompress(base64.b64decode(FLAT_GEOBUF)))
        labels = f"0\nTEXT\n8\ntexts\n40\n1\n1\n7.5\n{at((1, 1, 0))}0\nPOINT\n67\n1\n8\n0\n{at((90, 90, 0))}"
        self.write("labels.dxf", dxf(*(("0", [place]) for place in PLACES), labels=labels))
        mesh, result = self.triangulate("labels.dxf:0")
        self.assertEqual(points_of(mesh), PLACES)
        self.assertIn("left out texts and what is in paper space (1 feature)", result.stderr)
        self.assertEqual(points_of(self.triangulate("labels.dxf")[0]), PLACES)
        for name in ("geojson", "shp", "gpkg", "dxf", "FGB"):
            mesh, result = self.triangulate("points." + name)
            self.assertEqual(points_of(mesh), PLACES, name)
            self.assertEqual(len(triangles_of(mesh)), 4)
            self.assertEqual(result.stderr, HINT if name == "geojson" else "", name)

    def test_attributes(self):
        """Numbers are point data; of a flat file one may be the height."""
        places = [("Point", place[:2], {"n": i, "name": "a", "elev": place[2] / 2})
                  for i, place in enumerate(PLACES)]
        del places[3][2]["n"]
        self.write("in.geojson", geojson(*places))
        mesh, result = self.triangulate("in.geojson")
        self.assertEqual(points_of(mesh)[4], (2, 2, 0))
        self.assertIn("no z, so z is 0; --columns NAME takes a numeric attribute as z: 'n', 'elev'\n",
                      result.stderr)
        data = mesh.GetPointData()
        self.assertEqual([data.GetArrayName(i) for i in range(data.GetNumberOfArrays())], ["n", "elev"])
        numbers = values_of(data.GetArray("n"))
        self.assertTrue(math.isnan(numbers.pop(3)))
        self.assertEqual(numbers, [0, 1, 2, 4])
        mesh, result = self.triangulate("in.geojson", "--columns", "elev")
        self.assertEqual([z for _, _, z in points_of(mesh)], [0.5, 1, 1.5, 2, 2.5])
        told = "warning: in.geojson: left out the attributes 'name'\n"
        self.assertEqual(sorted(result.stderr.splitlines()), sorted((told + HINT.replace("points", "in", 1)).splitlines()))
        for code, choice, words in ((3, "name", ["no numeric attribute 'name'", "'n', 'elev'"]),
                                    (3, "n", ["feature 3 has no value of 'n'"]),
                                    (2, "x,y,elev", ["--columns takes one attribute"])):
            self.fail_with(code, "in.geojson", "out.vtk", "--from-points", "--columns", choice,
                           naming=["in.geojson", *words])
        self.write("bare.geojson", geojson(*(("Point", place) for place in PLACES)))
        self.fail_with(3, "bare.geojson", "out.vtk", "--from-points", "--columns", "n",
                       naming=["no numeric attribute 'n'; it has no numeric attributes"])
        everything = "warning: in.geojson: left out the attributes 'n', 'name', 'elev'\n"
        for warning, options in ((everything, ["bare.geojson", "out.csv", "--heights-at", "in.geojson"]),
                                 (told, ["in.geojson", "out.vti", "--raster", 1, "--raster-array", "elev"])):
            result = self.succeed(*options, "--from-points")  # z does not matter
            self.assertEqual(sorted(result.stderr.splitlines()),
                             sorted((warning + HINT.replace("points.geojson", options[0])).splitlines()))

    def test_lines_and_rings(self):
        """Breaklines, and areas of several polygons with holes, as survey data come."""
        self.write("in.xyz", text_of(grid(5)))
        self.write("roads.geojson", geojson(
            ("LineString", [[0, 0], [3, 1]]), ("MultiLineString", [[[0, 3], [4, 4]], [[1, 4], [4, 4]]]),
            ("GeometryCollection", [{"type": "LineString", "coordinates": [[1, 0], [4, 1]]},
                                    {"type": "Point", "coordinates": [0.25, 0.5]}]), (None, None)))
        mesh, result = self.triangulate("in.xyz", "--constraints", "roads.geojson")
        for edge in (((0, 0), (3, 1)), ((0, 3), (4, 4)), ((1, 0), (4, 1))):
            self.assertIn(edge, edges_of(mesh))
        self.assertIn("warning: roads.geojson: left out 1 feature without a geometry", result.stderr)
        island = [[1.75, 1.75], [2.25, 1.75], [2.25, 2.25], [1.75, 1.75]]
        self.write("area.geojson", geojson(("MultiPolygon", [[SQUARE, HOLE], [island]])))
        for option, area in (("--outline", 8.125), ("--holes", 7.875)):
            mesh, _ = self.triangulate("in.xyz", option, "area.geojson")
            self.assertEqual(area_of(mesh), area)
        self.write("open.geojson", geojson(("LineString", SQUARE), ("LineString", SQUARE[:4])))
        self.fail_with(3, "in.xyz", "out.vtk", "--from-points", "--outline", "open.geojson",
                       naming=["open.geojson: line 1 (the first is line 0) does not end where it begins"])
        self.fail_with(3, "in.xyz", "out.vtk", "--from-points", "--outline", "points.geojson",
                       naming=["points.geojson", "no lines or polygons"])

    def test_layers(self):
        write_geopackage(self.path("two.gpkg"), survey=PLACES, trees=[(1, 1, 9)])
        self.write("in.dxf", dxf(*(("SURVEY", [place]) for place in PLACES), ("TREES", [(1, 1, 9)]),
                                 ("Road", [(0, 0, 1), (2, 2, 5), (4, 4, 3)])))
        for name, first, other in (("two.gpkg", "survey", "trees"), ("in.dxf", "SURVEY", "TREES")):
            self.fail_with(3, name, "out.vtk", "--from-points",
                           naming=[name, "several layers", f"'{first}', '{other}'", f":{first}"])
            self.fail_with(3, name + ":rocks", "out.vtk", "--from-points",
                           naming=[name, "no layer 'rocks'", f"'{first}', '{other}'"])
            mesh, _ = self.triangulate(f"{name}:{first}")
            self.assertEqual(points_of(mesh), PLACES)
            mesh, _ = self.triangulate(name + ":*")
            self.assertIn((1, 1, 9), points_of(mesh))
        mesh, _ = self.triangulate("in.dxf:TREES", "--constraints", "in.dxf:Road")
        self.assertEqual(len(points_of(mesh)), 4)
        self.fail_with(2, "two.gpkg:survey", "out.vtk", "--from-points", "--report", "two.gpkg",
                       naming=["two.gpkg", "two purposes"])

    def test_coordinate_reference_systems(self):
        """Files with different ones are told of, but not a .geojson of metres that names none."""
        places = [(500000 + x, 5500000 + y, z) for x, y, z in PLACES]
        self.write("survey.geojson", geojson(*(("Point", place) for place in places), crs="EPSG:25832"))
        inner = [(500001, 5500001), (500002, 5500002)]
        for name, ends, crs in (("angles", [(9, 49.6), (9.1, 49.7)], None), ("metres", inner, None),
                                ("same", inner, "urn:ogc:def:crs:EPSG::25832")):
            self.write(f"{name}.geojson", geojson(("LineString", ends), crs=crs))
        _, result = self.triangulate("survey.geojson", "--constraints", "angles.geojson")
        self.assertIn("angles.geojson: its coordinate reference system is not that of survey.geojson "
                      "(WGS 84 and ETRS89 / UTM zone 32N)", result.stderr)
        _, result = self.triangulate("survey.geojson", "--constraints", "metres.geojson")
        self.assertNotIn("is not that of", result.stderr)
        self.assertIn("metres.geojson: its coordinates are no longitudes and latitudes", result.stderr)
        _, result = self.triangulate("survey.geojson", "--constraints", "same.geojson")
        self.assertNotIn("coordinate", result.stderr)
        for name, differs in (("EPSG:25832", False), ("EPSG:25833", True)):
            result = self.succeed("survey.geojson", "out.tif", "--from-points", "--raster", 1, "--crs", name)
            told = ("warning: --crs: its coordinate reference system is not that of survey.geojson "
                    "(ETRS89 / UTM zone 33N and ETRS89 / UTM zone 32N)")
            self.assertEqual(told in result.stderr, differs, result.stderr)
            self.assertEqual("warning" in result.stderr, differs, result.stderr)

    def test_attributes_of_several_layers(self):
        """Numbers are joined by their names; a warning names the attributes that are left out."""
        more = [(1, 1, 9), (3, 1, 9)]
        write_geopackage(self.path("two.gpkg"), survey=PLACES, trees=more, attributes={
            "survey": {"n INTEGER": range(5), "kind TEXT": ["a"] * 5},
            "trees": {"height REAL": [7.5, 8.5], "n INTEGER": [20, None], "day DATE": ["2026-01-01"] * 2}})
        mesh, result = self.triangulate("two.gpkg:*")
        self.assertEqual(points_of(mesh), PLACES + more)
        data, nan = mesh.GetPointData(), math.nan
        self.assertEqual([data.GetArrayName(i) for i in range(data.GetNumberOfArrays())], ["n", "height"])
        for name, expected in (("n", [0, 1, 2, 3, 4, 20, nan]), ("height", [nan] * 5 + [7.5, 8.5])):
            self.assertTrue(same(values_of(data.GetArray(name)), expected), name)
        self.assertEqual(result.stderr, "warning: two.gpkg:*: left out the attributes 'kind', 'day'\n")
        self.write("in.xyz", text_of(grid(5)))
        self.write("roads.geojson", geojson(("LineString", [[0, 0], [3, 1]], {"n": 1, "name": "a"})))
        _, result = self.triangulate("in.xyz", "--constraints", "roads.geojson")
        self.assertIn("warning: roads.geojson: left out the attributes 'n', 'name'\n", result.stderr)

    def test_large_integers(self):
        """Beyond 2^53 a double cannot hold all of them."""
        for number, isTold in ((2**53, False), (2**53 + 2, False), (-2**60, False), (2**53 + 1, True), (-2**53 - 1, True), (2**63 - 1, True)):
            path = self.path(f"in{number}.gpkg")
            write_geopackage(path, survey=PLACES, attributes={"survey": {"id INTEGER": [1, 2, 3, 4, number]}})
            for options in ([], ["--columns", "id"]):
                mesh, result = self.triangulate(path, *options)
                self.assertEqual("warning: " + path + ": the attribute 'id' has integers beyond 2^53, "
                                 "which are rounded\n" in result.stderr, isTold, (number, options))
                values = [point[2] for point in points_of(mesh)]
                if not options:
                    values = values_of(mesh.GetPointData().GetArray("id"))
                self.assertEqual(values[4], float(number))

    def test_layers_with_colons(self):
        write_geopackage(self.path("ns.gpkg"), **{"topp:states": PLACES, "a.gpkg:b": PLACES[:4]})
        os.mkdir(self.path("old.gpkg:x"))
        write_geopackage(self.path("old.gpkg:x/in.gpkg"), one=PLACES[:3], two=PLACES)
        for name, points in (("ns.gpkg:topp:states", PLACES), ("ns.gpkg:a.gpkg:b", PLACES[:4]),
                             ("old.gpkg:x/in.gpkg:one", PLACES[:3])):
            mesh, _ = self.triangulate(name)
            self.assertEqual(points_of(mesh), points, name)
        self.fail_with(3, "ns.gpkg:topp:rivers", "out.vtk", "--from-points",
                       naming=["ns.gpkg", "no layer 'topp:rivers'"])

    def test_layers_in_different_systems(self):
        """The first one is that of the file."""
        write_geopackage(self.path("two.gpkg"), first=PLACES, none=[(1, 1, 9)], same=[(1, 2, 9)], other=[(3, 1, 9)],
                         systems={"first": 25832, "same": 25832, "other": 25833})
        _, result = self.triangulate("two.gpkg:*")
        self.assertEqual(result.stderr, "warning: two.gpkg:*: the coordinate reference system of its layer 'other' "
                         "is not that of its layer 'first' (ETRS89 / UTM zone 33N and ETRS89 / UTM zone 32N); "
                         "the coordinates are taken as they are\n")
        for crs, isTold in (("EPSG:25832", False), ("EPSG:25833", True)):
            result = self.succeed("two.gpkg:*", "out.asc", "--from-points", "--raster", 1, "--crs", crs)
            self.assertEqual("warning: --crs: its coordinate" in result.stderr, isTold, result.stderr)

    def test_systems_that_a_raster_cannot_name(self):
        write_geopackage(self.path("in.gpkg"), survey=PLACES, systems={"survey": 5773})  # of heights
        for name in ("out.tif", "out.asc"):
            result = self.succeed("in.gpkg", name, "--from-points", "--raster", 1)
            self.assertEqual(result.stderr, "" if name == "out.asc" else "warning: out.tif: its format has no way to "
                             "name the coordinate reference system of in.gpkg, so it names none\n")

    def test_pipes(self):
        """GDAL reads some formats from a pipe. It needs files of the others."""
        write_geopackage(self.path("in.gpkg"), survey=PLACES)
        flat = zlib.decompress(base64.b64decode(FLAT_GEOBUF))
        drawing = dxf(*(("0", [place]) for place in PLACES))
        for name, content, words in (
            ("pipe.gpkg", self.content("in.gpkg"), ["a .gpkg cannot be read from a pipe", "file"]),
            ("pipe.shp", shapefile(PLACES)[0], ["a .shp cannot be read from a pipe", "file"]),
            ("pipe.geojson", self.content("points.geojson"), []), ("pipe.fgb", flat, []), ("pipe.dxf", drawing, []),
            ("bad.geojson", "{", ["bad.geojson"]),
        ):
            os.mkfifo(self.path(name))
            writer = threading.Thread(target=self.write, args=(name, content), daemon=True)
            writer.start()
            if words:
                result = self.fail_with(3, name, "out.vtp", "--from-points", naming=[name, *words])
                self.assertNotIn("/dev/fd", result.stderr)
            else:
                self.assertEqual(points_of(self.triangulate(name)[0]), PLACES, name)
            writer.join()

    def test_bad_files(self):
        """GDAL's messages are in the error, and nowhere else."""
        shp, shx = shapefile(PLACES)
        write_geopackage(self.path("good.gpkg"), survey=PLACES)
        flat = zlib.decompress(base64.b64decode(FLAT_GEOBUF))
        for name, content in (
            ("a.shp", shp), ("b.shp", b""), ("a.geojson", "{"), ("b.geojson", "x\n\xff"),
            ("c.geojson", '{"type": "FeatureCollection", "features": [{"type": "Feature", "geo'),
            ("a.gpkg", self.content("good.gpkg")[:5000]), ("b.gpkg", "SQLite format 3\0"),
            ("a.dxf", "0\nSECTION\n2\nENTITIES\n0\nPOINT\n10\n"), ("a.fgb", flat[:300]),
            ("none.geojson", None), ("empty.geojson", geojson()),
        ):
            if content is not None:
                self.write(name, content)
            with self.subTest(name):
                self.fail_with(3, name, "out.vtp", "--from-points", naming=[name])
        os.mkdir(self.path("folder.shp"))
        self.fail_with(3, "folder.shp", "out.vtp", "--from-points", naming=["is a folder"])
        self.fail_with(2, "points.geojson", "out.vtp", naming=["no triangles; --from-points"])
        self.fail_with(2, "points.geojson", "out.gpkg", "--from-points", naming=["out.gpkg", ".vtp"])

    def test_without_gdal(self):
        self.write("libdelaunayflip-gdal.so", "")
        environment = dict(os.environ, LD_LIBRARY_PATH=self.folder)
        self.fail_with(3, "points.geojson", "out.vtp", "--from-points", env=environment,
                       naming=["points.geojson: needs GDAL", "libgdal"])


class TextLines(PointTest):
    """x,y[,z],line: consecutive points with one number are a line."""

    def setUp(self):
        super().setUp()
        self.write("in.xyz", text_of(grid(5)))

    def test_breaklines(self):
        for text in ("0,0,7\n3,1,7\n3.5,1.25,7\n1,0,2\n4,1,2\n",
                     "0 0 0 7\n3 1 0 7\n3.5 1.25 5 7\n1 0 0 2\n4 1 0 2",
                     "Line;y;x\n7;0;0\n7;1;3\n7;1,25;3,5\n2;0;1\n2;1;4\n",
                     "x,y,z,ring_id\n0,0,0,7\n3,1,0,7\n3.5,1.25,5,7\n# a\n1,0,0,2\n4,1,0,2\n"):
            self.write("lines.csv", text)
            mesh, result = self.triangulate("in.xyz", "--constraints", "lines.csv")
            edges = edges_of(mesh)
            for edge in (((0, 0), (3, 1)), ((3, 1), (3.5, 1.25)), ((1, 0), (4, 1))):
                self.assertIn(edge, edges)
            self.assertEqual(len(points_of(mesh)), 26)
            self.assertNotIn("warning", result.stderr)

    def test_rings(self):
        rows = [(*place, number) for number, ring in enumerate((SQUARE, HOLE)) for place in ring]
        self.write("rings.csv", text_of(rows, ","))
        for option, area in (("--outline", 8), ("--holes", 8)):
            mesh, result = self.triangulate("in.xyz", option, "rings.csv")
            self.assertEqual(area_of(mesh), area)
            self.assertIn(" 33 points,", result.stdout)
        self.write("rings.csv", text_of(rows[:-1], ","))
        self.fail_with(3, "in.xyz", "out.vtk", "--from-points", "--outline", "rings.csv",
                       naming=["rings.csv: line 1 (the first is line 0) does not end where it begins"])

    def test_empty_heights(self):
        self.write("in.xyz", text_of([(x, y, 4) for x, y, _ in grid(5)]))
        self.write("lines.csv", "x,y,z,line\n0.5,0.5,9,7\n2.5,1.5,,7\n3.5,1.25,nan,7\n3.5,3.5,8,7\n")
        mesh, result = self.triangulate("in.xyz", "--constraints", "lines.csv")
        self.assertEqual([round(z, 9) for _, _, z in points_of(mesh)[25:]], [9, 4, 4, 8])
        self.assertIn("2 points of segments without heights (z is not finite;", result.stderr)

    def test_rows_that_are_no_lines(self):
        for text, words in (
            (text_of(PLACES, ","), ["line with the number 1 has one point", "consecutive rows"]),
            ("0,0,1\n1,1,1.5\n", ["row 2", "'1.5' is not a whole number"]),
            ("0,0,1\na,1,1\n", ["row 2", "'a' is not a number"]),
            ("0,0\n1,1\n", ["which of its columns has the number", "x,y,z,line"]),
            ("x,y,z\n0,0,1\n1,1,1\n", ["which of its columns has the number"]),
            ("0,0,1,1,1\n1,1,1,1,1\n", ["which of its columns has the number"]),
            ("x,y,line\n0,0,1\n1,1,\n", ["row 3", "a number is missing"]),
        ):
            self.write("lines.csv", text)
            self.fail_with(3, "in.xyz", "out.vtk", "--from-points", "--constraints", "lines.csv",
                           naming=["lines.csv", *words])

    def test_errors_name_places(self):
        """Points have numbers that count those of all files, so coordinates say which they are."""
        self.write("breaks.csv", "0.75,0.75,1\n1,3,1\n")
        self.write("good.csv", text_of([(*place, 5) for place in SQUARE], ","))
        self.write("bad.csv", text_of([(*place, 5) for place in SQUARE], ",")
                   + "1.25,1.5,7\n3,1,7\nnan,3,7\n1.25,1.5,7\n")
        for options in (["--outline", "bad.csv"], ["--outline", "bad.csv", "--constraints", "breaks.csv"],
                        ["--holes", "bad.csv", "--outline", "good.csv", "--constraints", "breaks.csv"]):
            self.fail_with(3, "in.xyz", "out.vtk", "--from-points", *options, naming=[
                "bad.csv: ring 1 from (3, 1, 0) to (nan, 3, 0) cannot be inserted: a coordinate of an end is"])
        self.write("breaks.csv", "0.25,0.25,1\n3,1,1\n")
        self.fail_with(3, "in.xyz", "out.vtk", "--from-points", "--outline", "good.csv", "--constraints", "breaks.csv",
                       naming=["good.csv: ring 0 from (0.5, 0.5, 0) to (3.5, 0.5, 0) crosses segment 0 from "
                               "(0.25, 0.25, 0) to (3, 1, 0): "])
        globe = ["globe.csv", "out.vtk", "--from-points", "--projection", "sphere", "--degrees"]
        self.write("globe.csv", "10,20\n20,30\n80,-30\n")
        self.write("far.csv", "0,0,1\n10,20,1\n190,-20,1\n")
        self.fail_with(3, *globe, "--constraints", "far.csv", naming=[
            "far.csv: segment 1 from (10, 20, 0) to (190, -20, 0) has ends on opposite sides"])
        self.write("far.csv", "0,0,1\n10,20,1\n190,-20,1\n0,0,1\n")
        self.fail_with(3, *globe, "--outline", "far.csv", naming=["from (10, 20, 0) to (190, -20, 0) has ends"])
        self.write("globe.csv", "10,20\n20,30\n80,-30\n180,0\n0,90\n")
        self.write("far.csv", "-180,0,0\n170,10,0\n20,1,1\n77,90,1\n20,1,2\n-160,-1,2\n")
        self.fail_with(3, *globe, "--constraints", "far.csv", naming=[
            "far.csv: segment 2 from (20, 1, 0) to (-160, -1, 0) has ends on opposite sides"])
