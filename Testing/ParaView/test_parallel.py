# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Servers with several ranks flip the pieces of these as one mesh: pvbatch and pvserver under
mpirun, compared with pvbatch as one process, without MPI. parallel_cases.py runs in all of them.
Examples/ParaView/flip_in_parallel.py runs on two ranks; its files have the triangles of one.
"""

import glob
import json
import os
import select
import socket
import subprocess
import tempfile
import time
import unittest

from launching import HAS_MPIRUN, launch, make_environment
from paraview import simple
from PluginTesting import PLUGIN, PluginTest, fetch, get_triangles, main, make_lattice

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPT = os.path.join(HERE, "parallel_cases.py")
EXAMPLE = os.path.join(HERE, "..", "..", "Examples", "ParaView", "flip_in_parallel.py")
PVPYTHON = os.environ["DELAUNAYFLIP_PVPYTHON"]
PVBATCH = os.path.join(os.path.dirname(PVPYTHON), "pvbatch")
PATIENCE = 200  # seconds: a rank must not wait forever for another one
CAN_RUN = HAS_MPIRUN and os.path.exists(PVBATCH)


def start(*command, **variables):
    environment = dict(make_environment(), **variables)
    environment["PYTHONPATH"] = HERE + os.pathsep + environment["PYTHONPATH"]
    return subprocess.Popen(command, encoding="utf-8", env=environment, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def read_results(program, folder):
    """What the filter says in parallel_cases.py, by case."""
    printed = program.communicate(timeout=PATIENCE)[0]
    if program.returncode != 0 or "all is well" not in printed:
        raise AssertionError(printed)
    with open(os.path.join(folder, "facts.json"), encoding="utf-8") as file:
        return json.load(file)


def launch_if_many(ranks):
    return launch(ranks) if ranks > 1 else []


def run_batch(ranks):
    with tempfile.TemporaryDirectory() as folder:
        return read_results(start(*launch_if_many(ranks), PVBATCH, SCRIPT, folder), folder)


def wait_for_text(stream, text):
    """Reads the output of a program until it contains `text`. Returns the output."""
    printed, deadline = "", time.monotonic() + PATIENCE
    while text not in printed and time.monotonic() < deadline:
        if select.select([stream], [], [], 1.0)[0]:
            piece = os.read(stream.fileno(), 4096).decode()
            if not piece:
                break
            printed += piece
    return printed


def run_server(ranks):
    """Runs the cases by a client of a server."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        port = listener.getsockname()[1]  # free
    command = [*launch_if_many(ranks), os.environ["DELAUNAYFLIP_PVSERVER"], f"--server-port={port}"]
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
    """The triangles of all ranks, whatever their order and first corner."""
    triangles = []
    for rank in ranks:
        for triangle in rank["triangles"]:
            corners = [tuple(corner) for corner in triangle]
            first = corners.index(min(corners))
            triangles.append(tuple(corners[first:] + corners[:first]))
    return sorted(triangles)


class Parallel:
    """Tests of each kind of server, over class members that say how to run it."""

    @classmethod
    def setUpClass(cls):
        if not CAN_RUN:
            raise unittest.SkipTest("no mpirun or no pvbatch")
        cls.alone = run_batch(1)
        cls.said = cls.server(cls.ranks)

    def test_all_is_that_of_one_process(self):
        for case in ("pieces", "other pieces"):
            with self.subTest(case):
                said, alone = self.said[case], self.alone[case]
                self.assertEqual((len(said["ranks"]), len(alone["ranks"])), (self.ranks, 1))
                self.assertEqual(join_ranks(said["ranks"]), join_ranks(alone["ranks"]))
                fields = [rank["field"] for rank in said["ranks"]]
                self.assertTrue(all(field == fields[0] for field in fields), fields)
                self.assertEqual(said["flips"], sum(said["flipped"]))
                self.assertEqual(said["iterations"], len(said["flipped"]))
                self.assertEqual((said["bad"], said["geometry"]), (0, alone["geometry"]))
                self.assertGreaterEqual(said["rounds"], 2)
                self.assertGreater(said["moved"], 0)
                self.assertEqual((alone["rounds"], alone["moved"]), (0, 0))
                # Even with LiveUpdate the end is reached at once; a client that polls is told.
                self.assertEqual((said["stopped"], alone["stopped"]), ("converged", "converged"))
                is_told = case == "pieces" and self.server is run_server
                self.assertEqual((said["errors"], said["warnings"] > 0), (0, is_told))
                self.assertEqual("LiveUpdate is for one mesh" in said["text"], is_told)

    def test_one_failure_is_that_of_all(self):
        said, where = self.said["one fails"], f"rank {self.ranks - 1}: "
        self.assertEqual(said["errors"], 1)
        self.assertIn(where + "Invalid mesh: cell 0 names point 77", said["text"])
        self.assertTrue(said["stopped"].startswith("failed: " + where), said["stopped"])


class BatchOnTwoRanks(Parallel, unittest.TestCase):
    ranks, server = 2, staticmethod(run_batch)


class ServerOnThreeRanks(Parallel, unittest.TestCase):
    ranks, server = 3, staticmethod(run_server)


@unittest.skipUnless(os.path.exists(PVBATCH), "no pvbatch")
class Remote(unittest.TestCase):
    def test_a_server_of_one_process(self):
        """Says the same as pvbatch, errors too; and ends with its client."""
        alone, remote = run_batch(1), run_server(1)
        del alone["pieces"]  # a live run, which clients poll
        for case, said in alone.items():
            self.assertEqual(join_ranks(remote[case]["ranks"]), join_ranks(said["ranks"]))
            for name in set(said) - {"ranks", "text"}:
                self.assertEqual(remote[case][name], said[name], (case, name))


def list_places(mesh):
    return {frozenset(mesh.GetPoint(i) for i in triangle) for triangle in get_triangles(mesh)}


@unittest.skipUnless(CAN_RUN, "no mpirun or no pvbatch")
class Example(PluginTest):
    def run_example(self, *arguments):
        """@returns what it printed, and the exit status."""
        program = start(
            *launch(2), PVBATCH, EXAMPLE, *arguments, PV_PLUGIN_PATH=os.path.dirname(PLUGIN))
        return program.communicate(timeout=PATIENCE)[0], program.returncode

    def expect_pieces_of(self, mesh):
        path = self.path("flipped.pvtp")
        printed, status = self.run_example(mesh, path)
        self.assertEqual(status, 0, printed)
        self.assertRegex(printed, r"[1-9]\d* flips in [2-9]\d* rounds, 0 bad edges left")
        self.assertEqual(len(glob.glob(self.path("flipped*/*.vtp"))), 2)
        pieces = fetch(simple.XMLPartitionedPolydataReader(FileName=[path]))
        alone = fetch(self.flip(simple.OpenDataFile(mesh)))
        self.assertEqual(pieces.GetNumberOfCells(), alone.GetNumberOfCells())
        self.assertEqual(list_places(pieces), list_places(alone))

    def test_pieces(self):
        """Sheared so far that edges between the pieces flip."""
        self.expect_pieces_of(self.save(make_lattice(20, shear=2.7)))


if __name__ == "__main__":
    main()
