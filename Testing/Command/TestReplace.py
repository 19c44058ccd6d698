# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""How existing files are replaced: links are followed, owners stay, all files change or none."""

import json
import os
import stat
import subprocess
import unittest

from CommandTesting import CommandTest, bumpy_grid, command_line


class ReplaceTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write_mesh(bumpy_grid(6, 0), "mesh.vtk")


class Links(ReplaceTest):
    def check_link(self, link, target):
        """The output goes to the target of the link, which stays a link."""
        self.succeed(self.mesh, link)
        self.assertTrue(os.path.islink(self.path(link)), link)
        self.assertFalse(os.path.islink(self.path(target)), target)
        self.assertEqual(self.read_mesh(target).GetNumberOfPolys(), 50)

    def test_dangling_links_are_followed(self):
        os.mkdir(self.path("deep"))
        os.symlink("new.vtk", self.path("relative.vtk"))
        os.symlink(self.path("newer.vtk"), self.path("absolute.vtk"))
        os.symlink("deep/newest.vtk", self.path("chain"))
        os.symlink("chain", self.path("chain.vtk"))
        os.symlink("../up.vtk", self.path("deep/up.vtk"))
        for link, target in (("relative.vtk", "new.vtk"), ("absolute.vtk", "newer.vtk"),
                             ("chain.vtk", "deep/newest.vtk"), ("deep/up.vtk", "up.vtk")):
            self.check_link(link, target)
            self.check_link(link, target)  # no longer dangling

    def test_a_link_to_itself_is_refused(self):
        os.symlink("loop.vtk", self.path("loop.vtk"))
        self.fail_with(3, self.mesh, "loop.vtk", naming=["loop.vtk", "symbolic links"])
        self.assertTrue(os.path.islink(self.path("loop.vtk")))

    def test_links_to_one_file(self):
        for name in ("out.vtk", "report.json"):
            os.symlink("both", self.path(name))
        arguments = (self.mesh, "out.vtk", "--report", "report.json")
        self.fail_with(2, *arguments, naming=["report.json", "same file"])


class Streams(ReplaceTest):
    """A report to a stream is added to it; nothing is replaced."""

    def test_to_a_file_behind_stdout(self):
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "link"):
            if name == "link":
                os.symlink("/dev/stdout", self.path(name))
            for flags in ("ab", "r+b"):
                self.write("log", "before\n")
                with open(self.path("log"), flags) as log:
                    log.seek(0, os.SEEK_END)
                    inode = os.fstat(log.fileno()).st_ino
                    code = subprocess.run(
                        command_line("mesh.vtk", "out.vtk", "--report", name),
                        cwd=self.folder, stdout=log, check=False,
                    ).returncode  # fmt: skip
                self.assertEqual(code, 0)
                self.assertEqual(os.stat(self.path("log")).st_ino, inode)
                text = self.content("log").decode()
                self.assertRegex(text, r"(?s)^before\n{\n.*\n}\nbad edges  .*wrote +out.vtk\n$")

    def test_to_a_pipe(self):
        for name in ("/dev/stdout", "/dev/stderr"):
            result = self.succeed("mesh.vtk", "out.vtk", "--report", name, "--quiet")
            text = result.stdout if name == "/dev/stdout" else result.stderr
            self.assertEqual(json.loads(text)["triangles"], 50)
        os.mkfifo(self.path("pipe"))
        with subprocess.Popen(command_line("mesh.vtk", "out.vtk", "--statistics", "pipe"),
                              cwd=self.folder, stdout=subprocess.DEVNULL) as process:  # fmt: skip
            with open(self.path("pipe"), encoding="ascii") as pipe:
                self.assertRegex(pipe.read(), "^Iteration,Tested")
            self.assertEqual(process.wait(60), 0)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe")).st_mode))

    def test_that_cannot_be_written(self):
        self.fail_with(3, "mesh.vtk", "out.vtk", "--report", "/dev/full", naming=["/dev/full", "space"])
        self.assertFalse(os.path.exists(self.path("out.vtk")))
        self.succeed("mesh.vtk", "out.vtk", "--report", "/dev/null")


@unittest.skipIf(os.geteuid() != 0, "only root may give files away")
class Owner(ReplaceTest):
    def test_owner_group_and_mode_stay(self):
        for name, mode in (("out.vtk", 0o640), ("report.json", 0o604)):
            self.write(name, "")
            os.chown(self.path(name), 12345, 23456)
            os.chmod(self.path(name), mode)
            self.succeed(self.mesh, "out.vtk", "--report", "report.json")
            status = os.stat(self.path(name))
            self.assertGreater(status.st_size, 0)
            self.assertEqual((status.st_uid, status.st_gid), (12345, 23456), name)
            self.assertEqual(stat.S_IMODE(status.st_mode), mode, name)

    def test_where_the_system_does_not_let_it(self):
        """Another user's file becomes the caller's, without a mode meant for its owner."""
        os.chmod(self.folder, 0o777)
        self.write("out.vtk", "")
        os.chown(self.path("out.vtk"), 12345, 23456)
        os.chmod(self.path("out.vtk"), 0o4666)
        result = subprocess.run(
            command_line("mesh.vtk", "out.vtk"), cwd=self.folder, check=False, encoding="utf-8",
            stdin=subprocess.DEVNULL, capture_output=True, user=54321, group=54321, extra_groups=[],
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        status = os.stat(self.path("out.vtk"))
        self.assertEqual((status.st_uid, stat.S_IMODE(status.st_mode)), (54321, 0o666))


class AllOrNothing(ReplaceTest):
    """One of several files becomes a folder while the command waits for its input."""

    names = {"out.vtk": (), "table.csv": ("--statistics",), "report.json": ("--report",)}

    def run_while(self, change):
        """Runs the command on a pipe, and calls `change` after it has opened its files."""
        os.mkfifo(self.path("pipe.vtk"))
        arguments = [word for name, option in self.names.items() for word in (*option, name)]
        with subprocess.Popen(
            command_line("pipe.vtk", *arguments), cwd=self.folder, encoding="utf-8",
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        ) as process:  # fmt: skip
            with open(self.path("pipe.vtk"), "wb") as pipe:  # waits for the reader
                change()
                pipe.write(self.content("mesh.vtk"))
            _, errors = process.communicate(timeout=60)
        os.remove(self.path("pipe.vtk"))
        return process.returncode, errors

    def test_no_file_changes_if_one_cannot_be_replaced(self):
        for exists in (True, False):
            for name in self.names:
                for other in self.names:
                    if exists:
                        self.write(other, f"before {other}")
                    elif os.path.exists(self.path(other)):
                        os.remove(self.path(other))
                self.refuse(name, exists)

    def refuse(self, name, exists):
        def change():
            if exists:
                os.remove(self.path(name))
            os.mkdir(self.path(name))

        code, errors = self.run_while(change)
        self.assertEqual(code, 3, errors)
        self.assertIn(f"error: {name}: cannot be written", errors)
        for other in self.names:
            if other != name and exists:
                self.assertEqual(self.content(other), f"before {other}".encode(), name)
            elif other != name:
                self.assertFalse(os.path.exists(self.path(other)), f"{other} beside {name}")
        os.rmdir(self.path(name))
