# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Constraints under mpirun that are not edges and cross triangles of several ranks."""
import unittest

from RanksTesting import RanksTest, flip_on

COUNTS = ("constraints", "unmatched", "inserted", "left", "geometry")


class Insertion(RanksTest):
    def expect_same_as_alone(self, ranks, case, **arguments):
        facts = flip_on(ranks, case, **arguments)
        self.assertEqual({name: facts[name] for name in COUNTS},
                         {name: facts["alone"][name] for name in COUNTS})
        self.assertEqual(facts["stopped"], "converged")
        self.assertTrue(facts["same"], facts)
        return facts

    def test_random_ones(self):
        for ranks, kind, given, ids in (
                (2, "space", "rank 0", True), (3, "scattered", "parts", True),
                (4, "one is empty", "rank 0", False), (3, "one has all", "parts", True),
                (4, "space", "lines", True), (3, "one is empty", "lines", False),
                (8, "space", "rank 0", False)):
            with self.subTest(f"{ranks} {kind} {given}"):
                facts = self.expect_same_as_alone(
                    ranks, "inserted", count=200, pairs=30, kind=kind, given=given, ids=ids)
                self.assertGreater(facts["inserted"], 20)

    def test_with_regions(self):
        for ranks, given in ((2, "rank 0"), (4, "lines")):
            with self.subTest(given):
                facts = self.expect_same_as_alone(
                    ranks, "inserted", count=200, pairs=30, kind="space", given=given, regions=True)
                self.assertGreater(facts["inserted"], 5)
                self.assertGreater(facts["unmatched"], 5)

    def test_through_points_of_other_ranks(self):
        """Three ranks have columns of a lattice. Constraints go through points of the middle rank,
        between points that two ranks share, and from a seam to the same seam."""
        facts = self.expect_same_as_alone(
            3, "lattice", side=10, kind="space",
            pairs=[(0, 9, 9, 0), (3, 0, 6, 1), (3, 5, 3, 9), (0, 0, 9, 0), (4, 9, 6, 8)])
        self.assertEqual((facts["inserted"], facts["unmatched"]), (5, 0))

    def test_two_that_cross(self):
        facts = flip_on(4, "lattice", side=9, kind="space", pairs=[(0, 8, 8, 1), (0, 2, 8, 7)])
        self.assertEqual((facts["inserted"], facts["unmatched"], facts["left"]), (1, 1, 0))
        self.assertIn("because it crosses edges that stay", facts["said"])

    def test_some_that_leave_the_mesh(self):
        facts = flip_on(4, "ring", side=8)
        self.assertEqual((facts["inserted"], facts["unmatched"]), (1, 3))
        self.assertTrue(facts["same"])
        self.assertIn("2 constraint edges that cannot be inserted because they leave the mesh",
                      facts["said"])
        self.assertIn("1 constraint edge of the second input that the mesh does not have",
                      facts["said"])


if __name__ == "__main__":
    unittest.main()
