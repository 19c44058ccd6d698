# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writing that fails half-way (a file size limit takes the place of a full disk): the message names
the file."""

import os
import resource

from CommandTesting import FORMATS, CommandTest, bumpy_grid, make_mesh


class FullDisk(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write_mesh(bumpy_grid(30, 1), "mesh.vtk")

    def refuse(self, limit, *arguments, naming):
        """With files limited to `limit` bytes, expects exit code 3 and no new or changed file."""
        before = {name: self.content(name) for name in os.listdir(self.folder)}
        self.fail_with(
            3, self.mesh, *arguments, naming=[naming, "cannot be written", f"limited to {limit} byte"],
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
        )
        self.assertEqual(before, {name: self.content(name) for name in os.listdir(self.folder)})

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
        path = self.write_mesh(make_mesh([(0, 0, 0)] * 3, [(0, 1, 2), (0, 1)]), "in.vtk")
        result = self.fail_with(
            3, path, "out.obj",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, 1 << 20)))
        self.assertRegex(result.stderr, "polygon 1 has 2 points.*can hold it\n$")

    def test_report_and_statistics(self):
        self.succeed(self.mesh, "out.stl", "--report", "report.json")
        larger = os.path.getsize(self.path("out.stl"))
        self.refuse(larger // 100, "out.obj", "--report", "report.json", naming="out.obj")
        tiny = self.write_mesh(bumpy_grid(2, 0), "tiny.stl")
        self.mesh = tiny
        self.refuse(300, "tiny-out.stl", "--report", "report.json", naming="report.json")
        self.refuse(40, "tiny-out.stl", "--statistics", "table.csv", naming="tiny-out.stl")
