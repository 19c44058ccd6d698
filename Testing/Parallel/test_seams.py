# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Real meshes under mpirun, and points that coincide."""
import os
import unittest

from RanksTesting import RanksTest, flip_on


class Seams(RanksTest):
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

    def test_fandisk(self):
        self.expect_flips(flip_on(4, "real", name="small/cm_fandisk.obj", kind="space",
                                  options={"Geometry": 3, "FeatureAngle": 180.0}, unique=False), 500)


if __name__ == "__main__":
    unittest.main()
