# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Real planar meshes, and terrain judged by x and y, as requested or chosen by Auto. The answers
are exact: the Delaunay triangulation is unique except for co-circular points."""

import csv
import os
import unittest

from CommandTesting import edge_counts, read_mesh, triangles_of
from RealDataTesting import FOLDER, RealDataTest

XY = ("--geometry", "planar-xy")


class Planar(RealDataTest):
    def assert_unchanged(self, name):
        before = read_mesh(os.path.join(FOLDER, name))
        after = read_mesh(self.path("out.vtk"))
        for array in ("GetConnectivityArray", "GetOffsetsArray"):
            old, new = (memoryview(getattr(m.GetPolys(), array)()) for m in (before, after))
            self.assertEqual(old.tobytes(), new.tobytes())
        old, new = (memoryview(m.GetPoints().GetData()) for m in (before, after))
        self.assertEqual(old.tobytes(), new.tobytes())

    def test_delaunay_input_stays(self):
        report = self.flip("greenland_cdt.vtk", *XY)
        self.assertEqual((report["total_flips"], report["non_delaunay_before"]), (0, 0))
        self.assertEqual((report["points"], report["triangles"]), (33343, 64125))
        self.assert_unchanged("greenland_cdt.vtk")

    def test_constraints(self):
        report = self.flip("lake_superior_cdt_constrained.vtk", *XY)
        self.assertEqual((report["total_flips"], report["non_delaunay_after"]), (0, 0))
        self.assert_unchanged("lake_superior_cdt_constrained.vtk")

    def test_without_constraints(self):
        name = "lake_superior_cdt_constrained.vtk"
        report = self.flip(name, *XY, "--ignore-lines")
        self.assertEqual((report["total_flips"], report["non_delaunay_before"]), (32, 29))
        self.assertEqual(report["non_delaunay_after"], 0)

    def test_flips_an_iteration(self):
        path = os.path.join(FOLDER, "lake_superior_cdt_constrained.vtk")
        self.succeed(path, "out.vtk", *XY, "--ignore-lines", "--statistics", "table.csv")
        with open(self.path("table.csv"), encoding="utf-8", newline="") as file:
            self.assertEqual([int(row["Flipped"]) for row in csv.DictReader(file)], [29, 3])

    def test_clockwise_quads(self):
        report = self.flip("su2_cht_3cyl_mixed.vtk", *XY)
        self.assertEqual((report["triangles"], report["total_flips"]), (66718, 12047))
        self.assertEqual((report["non_delaunay_before"], report["non_delaunay_after"]), (12047, 0))

    def test_islands(self):
        report = self.flip("adcirc_alaska.vtk", *XY)
        self.assertEqual((report["non_delaunay_before"], report["non_delaunay_after"]), (5196, 0))
        self.about(report["total_flips"], 5575, "flips")

    def test_auto_knows_degrees_and_metres(self):
        report = self.flip("adcirc_alaska.vtk")
        self.assertEqual(report["geometry"], "planar-xy")
        self.assertIn("z extends further than x and y", report["geometry_reason"])
        self.assertEqual((report["total_flips"], report["non_delaunay_after"]), (5588, 0))

    def test_auto_knows_terrain_in_utm(self):
        report = self.flip("turbine_siting_terrain_utm.stl")
        self.assertEqual(report["geometry"], "planar-xy")
        self.assertIn("100 % of its area slopes below 45 degrees", report["geometry_reason"])
        self.assertEqual(report["total_flips"], 0)

    def test_auto_knows_terrain_full_of_slivers(self):
        report = self.flip("tin_bigtujunga_bad_60k.vtk")
        self.assertEqual(report["geometry"], "planar-xy")
        self.assertIn("99 % of its area slopes below 45 degrees", report["geometry_reason"])
        self.assertEqual(report["non_delaunay_after"], 0)

    def test_bad_terrain(self):
        report = self.flip("tin_bigtujunga_bad_60k.vtk", *XY)
        self.assertEqual((report["non_delaunay_before"], report["non_delaunay_after"]), (34770, 0))
        self.about(report["total_flips"], 335500, "flips")
        self.assertEqual((report["edges"], report["boundary_edges"]), (179726, 271))
        counts = edge_counts(triangles_of(read_mesh(self.path("out.vtk"))))
        self.assertEqual(counts, (179726, 271, 0))

    def test_ties(self):
        """Regular terrain far from the origin: every diagonal is an exact tie."""
        report = self.flip("turbine_siting_terrain_utm.stl", *XY)
        self.assertEqual((report["total_flips"], report["non_delaunay_before"]), (0, 0))


if __name__ == "__main__":
    unittest.main(verbosity=2)
