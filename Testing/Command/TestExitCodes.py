# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every exit code of the command."""

import os
import stat

from CommandTesting import CommandTest, bumpy_grid, make_mesh, triangles_of, worst_case


class WrongUsage(CommandTest):
    def setUp(self):
        super().setUp()
        self.planar = self.write_mesh(bumpy_grid(4, 0), "planar.vtk")
        self.surface = self.write_mesh(bumpy_grid(4, 1), "surface.vtk")
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        cells = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
        self.tetrahedron = self.write_mesh(make_mesh(points, cells), "tetrahedron.vtk")

    def tearDown(self):
        self.assertFalse(os.path.exists(self.path("out.vtk")))
        super().tearDown()

    def refuse(self, naming, *arguments, mesh=None):
        self.fail_with(2, mesh or self.planar, "out.vtk", *arguments, naming=[naming])

    def test_missing_arguments(self):
        self.fail_with(2, naming=["INPUT"])
        self.fail_with(2, self.planar, naming=["OUTPUT"])

    def test_unknown_option(self):
        self.refuse("--fast", "--fast")
        self.refuse("did you mean --geometry?", "--geomtry", "planar")
        self.refuse("did you mean --quiet?", "--quite=1")

    def test_smallest_angle(self):
        """Asked for, as of a mesh generator, it is answered by what guarantees one."""
        for words in (["--min-angle", "20"], ["--MINIMUM-ANGLE=20"], ["--min_angle", "20"]):
            self.refuse(words[0].split("=")[0] + ": flips alone guarantee no smallest angle", *words)
            self.refuse("--minimum-angle adds points", *words)
        self.refuse("--minimum-angle", "--from-points", "--minimum-angle", "34")

    def test_unknown_extension(self):
        known = [".vtk", ".vtp", ".ply", ".stl", ".obj"]
        self.fail_with(2, self.planar, "out.abc", naming=["out.abc", *known])
        self.fail_with(2, "in.abc", "out.vtk", naming=["in.abc", ".xyz", *known])
        self.fail_with(2, "in", "out.vtk", naming=known)
        for name, way in (("in.vtu", "Extract Surface"), ("in.off", "between .off and .ply"),
                          ("in.MSH", "delaunayflip.meshio.flip"), ("fort.14", "delaunayflip.flip"),
                          ("in.2dm", "delaunayflip.flip"), ("in.gr3", "as arrays"),
                          ("in.LAZ", "delaunayflip.laspy.triangulate")):
            self.fail_with(2, name, "out.vtk", naming=[name, way])

    def test_choices(self):
        for option in ("--geometry", "--criterion", "--tie-rule", "--backend"):
            self.refuse(option, option, "0")
            self.refuse(option, option)

    def test_ranges(self):
        for option, values in {
            "--feature-angle": ["-1", "180.5", "nan", "x"],
            "--max-deviation": ["-1e-9", "nan", "-1%", "%", "1%%", "1 cm", ""],
            "--tolerance": ["-1e-9", "-2", "1", "nan", "inf"],
            "--threads": ["-1", "1.5", "99999999"],
            "--device": ["-2", "0.5", "x", "nan", "9999999999", "gpu0"],
            "--devices": ["x", "0,", "-1", "0.5", "0;1", "all,0"],
            "--pieces": ["-1", "256", "1.5", "x"],
            "--max-iterations": ["-2", "1e30", "x"],
        }.items():
            for value in values:
                self.refuse(option, option, value)

    def test_contradictions(self):
        canonical = ("--tie-rule", "canonical")
        self.refuse("anonical", *canonical, "--geometry", "surface")
        self.refuse("anonical", *canonical, "--criterion", "opposite-angles")
        self.refuse("anonical", *canonical, mesh=self.tetrahedron)
        self.refuse("lane", "--geometry", "planar", mesh=self.surface)
        self.refuse("--insert-lines", "--ignore-lines", "--insert-lines")

    def test_empty_names(self):
        self.fail_with(2, "", "out.vtk", naming=["INPUT", "empty"])
        self.fail_with(2, self.planar, "", naming=["OUTPUT", "empty"])
        for option in ("--constraints", "--region-array", "--statistics", "--report"):
            self.refuse("empty", option, "")
            self.refuse(option, option, "")

    def test_one_name_for_two_files(self):
        self.refuse("out.vtk", "--report", "./out.vtk")
        self.refuse("same", "--report", "same", "--statistics", "same")
        self.refuse("planar.vtk", "--statistics", self.planar)


class BadFile(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write_mesh(bumpy_grid(4, 0), "mesh.vtk")

    def test_missing_input(self):
        self.fail_with(3, "none.vtk", "out.vtk", naming=["none.vtk", "No such file"])
        self.assertFalse(os.path.exists(self.path("out.vtk")))

    def test_folder_as_input(self):
        os.mkdir(self.path("folder.vtk"))
        self.fail_with(3, "folder.vtk", "out.vtk", naming=["folder.vtk", "folder"])

    def test_output_not_writable(self):
        self.fail_with(3, self.mesh, "none/out.vtk", naming=["none/out.vtk", "No such file"])
        os.mkdir(self.path("folder.vtk"))
        self.fail_with(3, self.mesh, "folder.vtk", naming=["folder.vtk", "regular file"])

    def test_nothing_is_written_when_one_file_cannot_be(self):
        self.fail_with(3, self.mesh, "out.vtk", "--report", "none/r", naming=["none/r"])
        # A pipe: a mesh is read back after writing, and special files must not be replaced.
        os.mkfifo(self.path("pipe.vtk"))
        self.fail_with(3, self.mesh, "pipe.vtk", naming=["pipe.vtk", "regular file"])
        os.symlink("/dev/stdout", self.path("stdout.vtk"))
        self.fail_with(3, self.mesh, "stdout.vtk", naming=["stdout.vtk", "regular file"])
        self.assertEqual(sorted(os.listdir(self.folder)), ["mesh.vtk", "pipe.vtk", "stdout.vtk"])
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe.vtk")).st_mode))


class Success(CommandTest):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout
        self.assertEqual([line for line in text.splitlines() if len(line) > 80], [])
        groups = [line for line in text.splitlines() if line.endswith(":") and line[0] != " "]
        self.assertEqual(groups, ["Examples:", "What to read:", "Where edges are judged:", "What stays:",
                                  "From points:", "Points to add:", "Heights from points:", "Where it runs:",
                                  "What to write:", "Help:"])
        self.assertIn("\n  --merge-points            First join points", text)
        for code in ("0 done", "2 wrong", "3 input", "4 iteration", "5 the", "129, 130, 131 or 143"):
            self.assertIn(code, text)
        self.assertRegex(self.succeed("--version").stdout, r"^delaunay-flip \d+\.\d+\.\d+$")

    def test_iteration_limit(self):
        mesh = self.write_mesh(worst_case(4), "mesh.vtk")
        report = self.report(mesh, "out.vtk", "--max-iterations", "2", code=4)
        self.assertEqual(report["stop_reason"], "iteration limit")
        self.assertFalse(report["converged"])
        self.assertEqual((report["number_of_iterations"], report["total_flips"]), (2, 3))
        self.assertGreater(report["non_delaunay_after"], 0)
        self.assertEqual(len(triangles_of(self.read_mesh("out.vtk"))), 6)

    def test_numbers_are_decimal(self):
        """Leading zeros do not make a number octal."""
        mesh = self.write_mesh(worst_case(20), "mesh.vtk")
        for text, iterations in (("010", 10), ("08", 8), ("+9", 9), ("-01", 37), ("000", 0)):
            report = self.report(
                *(mesh, "out.vtk", "--max-iterations", text), code=0 if iterations > 30 else 4)
            self.assertEqual(report["number_of_iterations"], iterations, text)
        backend = self.report(mesh, "out.vtk", "--backend", "threads", "--threads", "010")["backend"]
        self.assertEqual(backend, "Threads: 10")
        for text in ("0x10", "1e1", "10.0", "", " 10", "1 0", "+-1", "99999999999999999999"):
            self.fail_with(2, mesh, "out.vtk", f"--max-iterations={text}", naming=["max-iterations"])
