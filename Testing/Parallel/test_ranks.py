# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter for many ranks under mpirun, with more ranks than cores. flip_on_ranks.py is run by
every rank and compares the pieces with a run of one rank."""

from RanksTesting import RanksTest, flip_on


class Planar(RanksTest):
    def test_many_ranks(self):
        for ranks in (1, 2, 3, 4, 8):
            with self.subTest(ranks):
                facts = self.expect_same(ranks)
                self.assertEqual(facts["rounds"] > 1, ranks > 1)

    def test_points_by_their_places(self):
        self.expect_same(3, ids=False)

    def test_scattered_triangles(self):
        self.expect_same(4, count=300, kind="scattered")
        self.expect_same(2, count=300, kind="scattered", ids=False)


class Surfaces(RanksTest):
    def test_all_arrays(self):
        facts = flip_on(
            3, "same", maker="make_bumps", count=200, kind="space", ids=False,
            options={"Geometry": 2, "GenerateQuality": True, "GenerateFlipCount": True},
            unique=False)
        self.expect_done(facts)


class Pieces(RanksTest):
    def test_one_rank_has_all(self):
        self.assertEqual(self.expect_same(3, kind="one has all")["rounds"], 1)

    def test_one_rank_is_empty(self):
        self.expect_same(4, kind="one is empty")

    def test_one_rank_has_no_data(self):
        self.assertEqual(flip_on(2, "missing_data")["stopped"], "converged")

    def test_ghosts_are_dropped(self):
        facts = flip_on(3, "ghosts", count=400)
        self.assertTrue(facts["same"], facts)

    def test_copies_that_no_ghost_array_marks(self):
        """A rank that ignores its ghost array has triangles of others twice; the edges there stay."""
        facts = flip_on(3, "ghosts", count=400, wrong=1)
        self.assertEqual((facts["stopped"], facts["left"]), ("converged", 0))
        self.assertGreater(facts["flips"], 100)
        self.assertEqual(len(facts["said"]), 1)
        self.assertIn('rank 1: 1 ghost array with several components ignored: "vtkGhostType"',
                      facts["said"][0])

    def test_points_that_coincide(self):
        said = flip_on(2, "slit", ids=False)["said"]
        self.assertIn("3 points at the borders of pieces coincide with others of the same piece",
                      said[0])
        self.assertIn("vtkGlobalPointIds", said[0])
        (said,) = flip_on(2, "slit", ids=True)["said"]  # by the process with all of it
        self.assertIn("no two share an edge", said)


class Failures(RanksTest):
    def test_a_failure_is_that_of_all(self):
        for rank in (0, 2):
            with self.subTest(rank):
                facts = flip_on(3, "failure", rank=rank, wrong="point")
                self.assertIn(f"rank {rank}: Invalid mesh: cell 3 names point 7777",
                              facts["error"])
                self.assertTrue(facts["stopped"].startswith("failed: rank"))
                self.assertEqual((len(facts["said"]), facts["then"]), (1, "converged"))

    def test_missing_regions(self):
        facts = flip_on(2, "failure", rank=0, wrong="regions")
        self.assertIn('no cell array named "missing"', facts["error"])
