# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writing that fails half-way (a file size limit takes the place of a full disk), and allocations
that fail: the message names a file and what was being done to it."""

import os
import re
import resource
import unittest

from CommandTesting import FORMATS, CommandTest, bumpy_grid, make_mesh, write_mesh


class FullDisk(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = write_mesh(bumpy_grid(30, 1), self.path("mesh.vtk"))

    def refuse(self, limit, *arguments, naming):
        """With files limited to `limit` bytes, expects exit code 3 and no new or changed file."""
        before = {name: self.content(name) for name in os.listdir(self.folder)}
        result = self.run_command(
            self.mesh,
            *arguments,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
        )
        self.assertEqual(result.returncode, 3, result.stderr)
        errors = [line for line in result.stderr.splitlines() if line.startswith("error:")]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertIn(naming, errors[0])
        self.assertIn("cannot be written", errors[0])
        self.assertIn(f"limited to {limit} byte", errors[0])
        self.assertEqual(before, {name: self.content(name) for name in os.listdir(self.folder)})

    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_mesh(self):
        for extension in FORMATS:
            name = "out" + extension
            self.succeed(self.mesh, name)
            size = os.path.getsize(self.path(name))
            for limit in (0, 100, size // 3, size - 1):
                self.refuse(limit, name, naming=name)

    def test_text_cut_between_lines(self):
        """The truncated file can be read; only its number of triangles is wrong."""
        self.succeed(self.mesh, "out.obj")
        limit = self.content("out.obj").index(b"\n", -500) + 1
        self.refuse(limit, "out.obj", naming="out.obj")

    def test_a_limit_is_not_blamed_for_other_errors(self):
        path = write_mesh(make_mesh([(0, 0, 0)] * 3, [(0, 1, 2), (0, 1)]), self.path("in.vtk"))
        result = self.run_command(
            path, "out.obj",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, 1 << 20)))
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, "polygon 1 has 2 points.*can hold it\n$")

    def test_report_and_statistics(self):
        self.succeed(self.mesh, "out.stl", "--report", "report.json")
        larger = os.path.getsize(self.path("out.stl"))
        self.refuse(larger // 100, "out.obj", "--report", "report.json", naming="out.obj")
        tiny = write_mesh(bumpy_grid(2, 0), self.path("tiny.stl"))
        self.mesh = tiny
        self.refuse(300, "tiny-out.stl", "--report", "report.json", naming="report.json")
        self.refuse(40, "tiny-out.stl", "--statistics", "table.csv", naming="tiny-out.stl")


NAMED = {
    "read": r"error: (mesh|lines)\.\w+: .*cannot be read",
    "flip": r"error: mesh\.\w+: cannot be flipped: .*(not enough memory|crashed)",
    "write": r"error: out\.\w+: cannot be written: ",
}


class Memory(CommandTest):
    def test_every_message_names_file_and_phase(self):
        seen = set()
        for source, target in ((".vtk", ".obj"), (".obj", ".ply"), (".vtp", ".vtp"), (".ply", ".vtk")):
            mesh = bumpy_grid(6, 1)
            write_mesh(mesh, self.path("mesh" + source))
            write_mesh(mesh, self.path("lines.stl"))
            number, harmless = 1, 0
            while harmless < 3:  # in a row: then there are no more allocations
                failed = self.fail_at(number, "mesh" + source, "out" + target, seen)
                harmless = 0 if failed or number < 100 else harmless + 1
                number = 1 + number * 5 // 4
        self.assertEqual(seen, set(NAMED))

    def fail_at(self, number, source, target, seen):
        """Makes the allocation with this number fail. Returns whether that mattered."""
        environment = dict(os.environ, FAILING_NEW=str(number))
        environment["LD_PRELOAD"] = os.environ["DELAUNAYFLIP_FAILING_NEW"]
        result = self.run_command(
            source, target, "--constraints", "lines.stl", "--threads", 1, "--quiet", env=environment
        )
        if os.path.exists(self.path(target)):
            os.remove(self.path(target))
            self.assertEqual(result.returncode, 0, result.stderr)
            return False
        self.assertEqual(result.returncode, 3, f"{number}: {result.stderr}")
        phases = [phase for phase, text in NAMED.items() if re.search(text, result.stderr)]
        self.assertEqual(len(phases), 1, f"{source}, {number}: {result.stderr}")
        seen.update(phases)
        return True

if __name__ == "__main__":
    unittest.main(verbosity=2)
