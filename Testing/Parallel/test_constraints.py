# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Constraints under mpirun that are not edges: ranks insert those within their pieces."""

from RanksTesting import RanksTest, flip_on

COUNTS = ("constraints", "inserted", "left", "geometry")


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
                    ranks, "inserted", count=200, pairs=30, across=8, kind=kind, given=given, ids=ids)
                self.assertGreater(facts["inserted"], 20)
                self.assertEqual(facts["unmatched"], facts["across"])
                self.assertEqual(facts["across"] > 0, kind != "one has all")
                self.assertEqual("before the mesh is divided" in facts["said"], facts["across"] > 0)
