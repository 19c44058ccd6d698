# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases of flip_on_ranks.py under mpirun."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

from launching import HAS_MPIRUN, launch, make_environment

HERE = os.path.dirname(os.path.abspath(__file__))
PATIENCE = 300  # seconds: a rank must not wait forever for another one

try:
    from vtkmodules.vtkParallelMPI import vtkMPIController  # noqa: F401
    import mpi4py  # noqa: F401
    HAS_MPI = HAS_MPIRUN
except ImportError:
    HAS_MPI = False


def flip_on(ranks, case, **arguments):
    """What rank 0 says of a case."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "facts.json")
        run = subprocess.run(
            [*launch(ranks), sys.executable, os.path.join(HERE, "flip_on_ranks.py"), case,
             json.dumps(arguments), path],
            encoding="utf-8", env=make_environment(), timeout=PATIENCE, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if run.returncode != 0:
            raise AssertionError(run.stdout)
        with open(path, encoding="utf-8") as file:
            return json.load(file)


@unittest.skipUnless(HAS_MPI, "needs mpirun, mpi4py and a VTK with MPI")
class RanksTest(unittest.TestCase):
    """Cases with what rank 0 says of them."""

    def expect_done(self, facts):
        self.assertEqual((facts["stopped"], facts["again"]), ("converged", 0), facts)
        self.assertEqual(facts["left"], facts["left again"])
        self.assertEqual(facts["geometry"], facts["geometry alone"])

    def expect_same(self, ranks, **arguments):
        arguments = {"maker": "make_random", "count": 500, "kind": "space", "ids": True,
                     "options": {"TieRule": 1, "NumberOfThreads": 1}, **arguments}
        facts = flip_on(ranks, "same", **arguments)
        self.expect_done(facts)
        self.assertTrue(facts["same"], facts)
        return facts
