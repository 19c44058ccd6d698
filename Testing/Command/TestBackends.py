# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Where the flips run: on machines with and without a GPU, in builds with and without CUDA."""

import os
import unittest

from CommandTesting import CommandTest, bumpy_grid, read_report, worst_case

# The folder with a driver that is too old; empty in a build without the CUDA backend.
OLD_DRIVER = os.environ.get("DELAUNAYFLIP_OLD_DRIVER", "")
REASON = "CUDA could not " if OLD_DRIVER else "this build has no CUDA backend"
NO_SUCH_DEVICE = "1000000"


def with_old_driver():
    paths = [OLD_DRIVER, os.environ.get("LD_LIBRARY_PATH", "")]
    return {**os.environ, "LD_LIBRARY_PATH": ":".join(filter(None, paths))}


class BackendTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.small = self.write_mesh(worst_case(4), "small.vtk")
        # Just large enough for a GPU to be chosen: 20,402 triangles.
        self.large = self.write_mesh(bumpy_grid(102, 0), "large.vtk")

    def run_on(self, mesh, *arguments, **options):
        """The report and the standard error, in lines, of a run that succeeds."""
        path = self.path("report.json")
        result = self.succeed(mesh, "out.vtk", "--report", path, *arguments, **options)
        return read_report(path), result.stderr.splitlines()


class Backends(BackendTest):
    def test_help_tells_the_rule(self):
        text = " ".join(self.succeed("--help").stdout.split())
        self.assertIn("at least 20000 triangles", text)
        self.assertIn("--device", text)

    def test_auto_is_silent(self):
        for mesh in (self.small, self.large):
            report, lines = self.run_on(mesh)
            self.assertEqual(lines, [])
            self.assertEqual(report["fallback"], "")
            self.assertRegex(report["backend"], r"^(Threads: \d+|CUDA: .+)$")

    def test_device_is_nothing_to_the_cpu(self):
        for mesh, backend in ((self.small, "auto"), (self.large, "threads")):
            for device in ("-1", "0", NO_SUCH_DEVICE):
                report, lines = self.run_on(mesh, "--backend", backend, "--device", device)
                self.assertEqual(lines, [])
                self.assertRegex(report["backend"], r"^Threads: \d+$")

    def test_forced(self):
        """With a GPU that the build can use, the run succeeds; otherwise an error says why."""
        arguments = (self.small, "out.vtk", "--backend", "cuda")
        if self.run_command(*arguments).returncode == 0:
            self.assertRegex(self.report(*arguments)["backend"], r"^CUDA: .+$")
            os.remove(self.path("out.vtk"))
            arguments += ("--device", NO_SUCH_DEVICE)
        self.fail_with(5, *arguments, naming=[REASON])
        self.assertFalse(os.path.exists(self.path("out.vtk")))


@unittest.skipUnless(OLD_DRIVER, "no CUDA backend")
class Fallback(BackendTest):
    """A build with the CUDA backend, with a driver that is too old for it."""

    def test_the_cpu_takes_over(self):
        self.run_on(self.large, "--backend", "threads")
        expected = self.content("out.vtk")
        report, lines = self.run_on(self.large, env=with_old_driver())
        self.assertEqual(self.content("out.vtk"), expected)
        self.assertRegex(report["backend"], r"^Threads: \d+$")
        self.assertRegex(report["fallback"], "^CUDA could not .*update NVIDIA's driver$")
        warning = "warning: the GPU could not be used, the CPU did the work: "
        self.assertEqual(lines, [warning + report["fallback"]])

    def test_a_small_mesh_does_not_ask_for_a_gpu(self):
        report, lines = self.run_on(self.small, env=with_old_driver())
        self.assertEqual(lines, [])
        self.assertEqual(report["fallback"], "")

    def test_forced_does_not_fall_back(self):
        arguments = (self.large, "out.vtk", "--backend", "cuda")
        result = self.fail_with(5, *arguments, env=with_old_driver())
        self.assertRegex(result.stderr, "^error: CUDA could not .*update NVIDIA's driver\n$")
        self.assertFalse(os.path.exists(self.path("out.vtk")))
