# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Real meshes under mpirun, and seams where meshes are not simple."""
import os
import unittest

from RanksTesting import RanksTest, flip_on

SURFACE = {"Geometry": 3, "FeatureAngle": 180.0}


class Seams(RanksTest):
    def expect_valid(self, facts):
        self.expect_done(facts)
        self.assertEqual(facts["crowded"], facts["crowded before"])

    def test_edges_with_three_triangles(self):
        for ranks, kind in ((3, "sheets"), (4, "scattered"), (2, "space")):
            with self.subTest(kind):
                facts = flip_on(ranks, "book", side=8, kind=kind)
                self.expect_valid(facts)
                self.assertEqual(facts["crowded"], 7)
                self.assertEqual(facts["rounds"] > 1, kind != "sheets")

    def test_a_plane_that_overlaps_itself(self):
        for ranks, kind in ((2, "space"), (3, "scattered")):
            with self.subTest(kind):
                facts = flip_on(ranks, "overlap", count=60, kind=kind)
                self.expect_valid(facts)
                self.assertEqual(facts["geometry"], "planar")
                self.assertGreater(facts["flips"], 10)
                self.assertGreater(facts["left"], 0)

    def test_closed_twins(self):
        """Without global ids they share no points, as if they were alone."""
        facts = flip_on(2, "twins", ids=False)
        self.assertGreater(facts["flips"], 10)
        self.assertEqual((facts["flips"], facts["said"]), (2 * facts["flips alone"], []))
        self.assertEqual(flip_on(2, "twins", ids=True)["flips"], 0)  # four triangles at every edge

    def test_points_that_coincide(self):
        said = flip_on(2, "slit", ids=False)["said"]
        self.assertIn("3 points at the borders of pieces coincide with others of the same piece",
                      said[0])
        self.assertIn("vtkGlobalPointIds", said[0])
        (said,) = flip_on(2, "slit", ids=True)["said"]  # by the process with all of it
        self.assertIn("no two share an edge", said)


@unittest.skipUnless(os.path.isdir(os.environ["DELAUNAYFLIP_DATA_DIR"]), "no DELAUNAYFLIP_DATA_DIR")
class RealMeshes(RanksTest):
    def expect_flips(self, facts, fewest):
        self.expect_done(facts)
        self.assertGreater(facts["flips"], fewest)
        self.assertEqual(facts["crowded"], facts["crowded before"])

    def test_coast(self):
        for ranks, kind in ((2, "space"), (4, "space"), (3, "one is empty")):
            with self.subTest(f"{ranks} {kind}"):
                facts = flip_on(ranks, "real", name="adcirc_alaska.vtk", kind=kind,
                                options={"Geometry": 2, "TieRule": 1})
                self.expect_flips(facts, 5000)
                self.assertTrue(facts["same"])

    def test_surfaces(self):
        for name, ranks, fewest in (("cm_fandisk.obj", 4, 500), ("gc_triple_vierbein.obj", 3, -1)):
            with self.subTest(name):
                self.expect_flips(flip_on(ranks, "real", name="small/" + name, kind="space",
                                          options=SURFACE, unique=False), fewest)


if __name__ == "__main__":
    unittest.main()
