# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two ranks with different pieces and blocks: the panel has the sums over all of them.

parallel_batch.py runs in pvbatch. Its cases are compared here with the same meshes in one process.
"""

import ast
import itertools
import json
import os
import shutil
import subprocess
import sys

from PluginTesting import PluginTest, fetch, main, make_surface

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPT = os.path.join(HERE, "parallel_batch.py")
PATIENCE = 200  # seconds: a rank must not wait forever for another one


def read_table(name):
    """A table of the script, which only pvbatch may run."""
    with open(SCRIPT, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    return next(ast.literal_eval(line.value) for line in tree.body
                if isinstance(line, ast.Assign) and line.targets[0].id == name)


CASES = read_table("CASES")
KINDS = read_table("KINDS")


def find_launcher():
    """The command that starts two ranks. Exits as skipped if it is missing."""
    pvbatch = os.path.join(os.path.dirname(os.environ["DELAUNAYFLIP_PVPYTHON"]), "pvbatch")
    if not os.path.exists(pvbatch) or not shutil.which("mpirun"):
        print("skipped: no pvbatch or no mpirun")
        sys.exit(125)
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", pvbatch]


def run_cases():
    """The messages and results of the filter, by case."""
    # pvpython runs under MPI itself; within it, mpirun would start no other run.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_", "OPAL_"))}
    environment["PYTHONPATH"] = HERE + os.pathsep + environment.get("PYTHONPATH", "")
    run = subprocess.run([*LAUNCHER, SCRIPT, *CASES], encoding="utf-8", env=environment,
                         timeout=PATIENCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, check=False)
    if run.returncode != 0 or "all is well" not in run.stdout:
        raise AssertionError(run.stdout)
    said = {}
    for line in run.stdout.splitlines():
        if line.startswith("{"):
            said.update(json.loads(line))
    return said


LAUNCHER = find_launcher()


class Parallel(PluginTest):
    @classmethod
    def setUpClass(cls):
        cls.said = run_cases()

    def flip_alone(self, size, kind):
        """The number of flips in every iteration of one mesh, as polygonal data."""
        source = self.read(make_surface(size, kind), f"{size}.vtp")
        table = fetch(self.flip(source, TieRule="Canonical"), 1)
        column = table.GetRowData().GetArray("Flipped")
        return [int(column.GetTuple1(i)) for i in range(column.GetNumberOfTuples())]

    def expect_sums(self, case):
        kinds = KINDS.get(case, {})
        alone = [self.flip_alone(size, kinds.get(block)) for rank in CASES[case]
                 for block, size in rank.items() if size > 0]
        rows = [sum(row) for row in itertools.zip_longest(*alone, fillvalue=0)]
        said = self.said[case]
        self.assertEqual(said["flipped"], rows)
        self.assertEqual(said["flips"], sum(rows))
        self.assertEqual(said["iterations"], len(rows))
        self.assertEqual(said["bad"], 0)
        return said

    def test_sums(self):
        for case in CASES:
            with self.subTest(case):
                self.expect_sums(case)

    def test_edges_between_pieces(self):
        for case, said in self.said.items():
            with self.subTest(case):
                seams = case in ("pieces", "shared block", "unstructured pieces")
                self.assertEqual("edges between pieces" in said["text"], seams, said["text"])
                self.assertEqual(said["warnings"], int(seams), said["text"])

    def test_live_update_is_not_ignored_silently(self):
        for case, said in self.said.items():
            self.assertEqual("LiveUpdate is for one mesh" in said["text"], case == "pieces")

    def test_errors_of_another_rank(self):
        for case, where in {"one fails": "rank 1: ", "block fails": "rank 1, block 3: "}.items():
            said = self.said[case]
            self.assertEqual(said["errors"], 1)
            self.assertIn(where + "Invalid mesh: cell 0 names point 77", said["text"])
            self.assertTrue(said["stopped"].startswith("failed: " + where), said["stopped"])

    def test_no_other_errors(self):
        for case, said in self.said.items():
            if "fails" not in case:
                self.assertEqual((said["errors"], said["stopped"]), (0, "converged"), case)


if __name__ == "__main__":
    main()
