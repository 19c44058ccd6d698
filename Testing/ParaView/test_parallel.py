# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Servers with several ranks flip the pieces of these as one mesh: pvbatch and pvserver under
mpirun, compared with pvbatch as one process, without MPI.

parallel_batch.py runs in all of them.
"""

import json
import os
import subprocess
import tempfile
import unittest

from launching import HAS_MPIRUN, launch, make_environment
from test_remote import find_free_port, wait_for_text

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPT = os.path.join(HERE, "parallel_batch.py")
PVPYTHON = os.environ["DELAUNAYFLIP_PVPYTHON"]
PVBATCH = os.path.join(os.path.dirname(PVPYTHON), "pvbatch")
PATIENCE = 200  # seconds: a rank must not wait forever for another one


def start(*command):
    environment = make_environment()
    environment["PYTHONPATH"] = HERE + os.pathsep + environment["PYTHONPATH"]
    return subprocess.Popen(command, encoding="utf-8", env=environment, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def read_results(program, folder):
    """What the filter says in parallel_batch.py, by case."""
    printed = program.communicate(timeout=PATIENCE)[0]
    if program.returncode != 0 or "all is well" not in printed:
        raise AssertionError(printed)
    with open(os.path.join(folder, "facts.json"), encoding="utf-8") as file:
        return json.load(file)


def run_batch(*launcher):
    with tempfile.TemporaryDirectory() as folder:
        return read_results(start(*launcher, PVBATCH, SCRIPT, folder), folder)


def run_server(ranks):
    """The same by a client of a server."""
    port = find_free_port()
    command = [*launch(ranks), os.environ["DELAUNAYFLIP_PVSERVER"], f"--server-port={port}"]
    server = start(*command)
    try:
        printed = wait_for_text(server.stdout, "Accepting connection")
        if "Accepting connection" not in printed:
            raise AssertionError(printed)
        with tempfile.TemporaryDirectory() as folder:
            said = read_results(start(PVPYTHON, SCRIPT, folder, str(port)), folder)
        if server.wait(PATIENCE) != 0:
            raise AssertionError(server.stdout.read())
        return said
    finally:
        server.kill()
        server.wait()
        server.stdout.close()


def join_ranks(ranks):
    """The triangles of all ranks, by block, whatever their order and first corner."""
    blocks = {}
    for rank in ranks:
        for block, leaf in rank.items():
            for triangle in leaf["triangles"]:
                corners = [tuple(corner) for corner in triangle]
                first = corners.index(min(corners))
                blocks.setdefault(block, []).append(tuple(corners[first:] + corners[:first]))
    return {block: sorted(triangles) for block, triangles in blocks.items()}


@unittest.skipUnless(os.path.exists(PVBATCH), "no pvbatch")
class Parallel:
    """Tests of each kind of server, over class members that say how to run it."""

    @classmethod
    def setUpClass(cls):
        if not HAS_MPIRUN:
            raise unittest.SkipTest("no mpirun")
        cls.alone = run_batch()
        cls.said = cls.run_cases()

    def test_triangles_are_those_of_one_process(self):
        for case, said in self.said.items():
            with self.subTest(case):
                self.assertEqual(len(said["ranks"]), self.ranks)
                self.assertEqual(len(self.alone[case]["ranks"]), 1)
                own, expected = join_ranks(said["ranks"]), join_ranks(self.alone[case]["ranks"])
                if "fails" not in case:
                    self.assertEqual(own, expected)
                    self.assertEqual(len(own) == 0, case == "nothing")

    def test_statistics_are_those_of_all_ranks(self):
        for case, said in self.said.items():
            with self.subTest(case):
                for block in {block for rank in said["ranks"] for block in rank}:
                    fields = [rank[block]["field"] for rank in said["ranks"] if block in rank]
                    self.assertTrue(all(field == fields[0] for field in fields), fields)
                self.assertEqual(said["flips"], sum(said["flipped"]))
                self.assertEqual(said["iterations"], len(said["flipped"]))
                self.assertEqual(said["bad"], 0)
                self.assertEqual(said["geometry"], self.alone[case]["geometry"])

    def test_rounds(self):
        for case, rounds in {"pieces": 2, "unstructured pieces": 2, "one rank has all": 1}.items():
            self.assertGreaterEqual(self.said[case]["rounds"], rounds)
            self.assertEqual(self.said[case]["moved"] > 0, rounds > 1)
            self.assertEqual((self.alone[case]["rounds"], self.alone[case]["moved"]), (0, 0))

    def test_live_update_is_not_ignored_silently(self):
        for case, said in self.said.items():
            self.assertEqual("LiveUpdate is for one mesh" in said["text"], case == "pieces")

    def test_one_failure_is_that_of_all(self):
        last = f"rank {self.ranks - 1}: "
        for case, where in {"one fails": last, "block fails": "block 2: " + last}.items():
            said = self.said[case]
            self.assertEqual(said["errors"], 1)
            self.assertIn(where + "Invalid mesh: cell 0 names point 77", said["text"])
            self.assertTrue(said["stopped"].startswith("failed: " + where), said["stopped"])
        for block, triangles in join_ranks(self.alone["block fails"]["ranks"]).items():
            self.assertEqual(join_ranks(self.said["block fails"]["ranks"])[block], triangles)

    def test_nothing_else_is_said(self):
        for case, said in self.said.items():
            if case not in ("pieces", "one fails", "block fails"):
                self.assertEqual((said["errors"], said["warnings"]), (0, 0), said["text"])
                self.assertEqual(said["stopped"], "converged", case)


class BatchOnTwoRanks(Parallel, unittest.TestCase):
    ranks = 2

    @staticmethod
    def run_cases():
        return run_batch(*launch(2))


class BatchOnThreeRanks(Parallel, unittest.TestCase):
    ranks = 3

    @staticmethod
    def run_cases():
        return run_batch(*launch(3))


class ServerOnTwoRanks(Parallel, unittest.TestCase):
    ranks = 2

    @staticmethod
    def run_cases():
        return run_server(2)


class ServerOnThreeRanks(Parallel, unittest.TestCase):
    ranks = 3

    @staticmethod
    def run_cases():
        return run_server(3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
