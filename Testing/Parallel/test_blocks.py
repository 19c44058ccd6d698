# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Composite datasets under mpirun: a leaf is a mesh of which each rank may have a piece."""

from RanksTesting import RanksTest, flip_on

NO_SURFACE = "block 2: not a surface, passed unchanged"


class Blocks(RanksTest):
    def expect_converged(self, facts, meshes):
        self.assertEqual((facts["stopped"], facts["left"]), ("converged", 0))
        self.assertEqual(facts["same"], [True] * meshes)
        self.assertEqual(facts["flips"], sum(facts["flips of leaves"]))
        self.assertEqual(facts["rows"], facts["iterations"])
        self.assertGreater(facts["rounds"], 1)

    def test_multiblock(self):
        for ranks in (2, 4):
            with self.subTest(ranks):
                facts = flip_on(ranks, "composite", kind="blocks")
                self.expect_converged(facts, 3)
                self.assertEqual(len(facts["said"]), 1)
                self.assertIn(NO_SURFACE, facts["said"][0])

    def test_partitions_of_ranks_are_one_mesh(self):
        for kind, meshes in (("partitions", 1), ("collection", 3)):
            with self.subTest(kind):
                facts = flip_on(3, "composite", kind=kind)
                self.expect_converged(facts, meshes)
                self.assertEqual(facts["said"], [])

    def test_partitions_of_a_rank_are_one_mesh(self):
        for ranks, kind, count in ((2, "two", 4), (4, "uneven", 6), (3, "anonymous", 9),
                                   (1, "two", 2)):
            with self.subTest(kind):
                facts = flip_on(ranks, "composite", kind=kind + " partitions")
                self.assertEqual((facts["same"], facts["said"]), ([True], []))
                self.assertEqual((facts["stopped"], facts["left"]), ("converged", 0))
                self.assertEqual(facts["flips of leaves"], [facts["flips"]])
                self.assertEqual((facts["partitions"], facts["rounds"] > 1), (count, ranks > 1))

    def test_constraints(self):
        for kind, unmatched in (("shared", True), ("composite", False)):
            with self.subTest(kind):
                facts = flip_on(3, "constraints_of_blocks", kind=kind)
                self.assertTrue(facts["same"])
                self.assertEqual(facts["constraints"], facts["constraints alone"])
                self.assertEqual(facts["unmatched"] > 0, unmatched)
                misfit = "rank 1, block 4 of the second input: ignored, because the first input has"
                self.assertEqual(misfit in str(facts["said"]), kind == "composite")


class BlockFailures(RanksTest):
    def test_a_block_fails(self):
        facts = flip_on(3, "failing_block")
        self.assertIn("block 4 (wing): rank 1: Invalid mesh: cell 0 names point 7777",
                      facts["error"])
        self.assertEqual(facts["stopped"], "failed: " + facts["error"])
        self.assertEqual(facts["meshes"], [0, 2])

    def test_mixed_kinds(self):
        facts = flip_on(2, "mixed_kinds")
        self.assertEqual(facts["error"],
                         "rank 1: this rank has a single mesh, but others have composite datasets")
