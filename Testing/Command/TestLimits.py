# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small files that ask for much memory, and pipes as files."""

import os
import resource
import threading

from CommandTesting import FORMATS, BadFileTest, bumpy_grid, triangles_of
from TestNumbers import TRIANGLE, as_text

MOST_MEMORY = 3 << 30  # for refusing a file of a few hundred bytes


class ExcessiveSizes(BadFileTest):
    """Such a file must be refused within a few seconds, by a process with little memory. The fuzzer
    of files changes numbers of all formats, too."""

    def refuse_quickly(self, name, content, *naming):
        self.write(name, content)
        with self.subTest(content):
            result = self.fail_with(
                3,
                name,
                "out.vtk",
                naming=[name, *naming],
                preexec_fn=lambda: (
                    resource.setrlimit(resource.RLIMIT_CPU, (20, 20)),
                    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY)),
                ),
            )
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def test_counts_of_vtk(self):
        head = "# vtk DataFile Version 3.0\nt\n{}\nDATASET POLYDATA\n"
        for encoding in ("ASCII", "BINARY"):
            for body in (
                "FIELD f 1\nname 1 4000000000 string\n",
                "FIELD f 1\nname 1 4000000000 bit\n",
                "FIELD f 1\nname 4000000000 4000000000 double\n",
                "FIELD f 4000000000\n",
                "POINTS 4000000000 float\n0 0 0\n",
                "POINTS 1 float\n0 0 0\nPOLYGONS 1000000000 4000000000\n3 0 0 0\n",
                "POINTS 0 float\nPOLYGONS 9000000000000000000 9\n3 0 0 0\n",
            ):
                self.refuse_quickly("a.vtk", head.format(encoding) + body)

    def test_offsets_of_vtk(self):
        text = "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
        text += "0 0 0 1 0 0 0 1 0\nPOLYGONS 2 3\nOFFSETS vtktypeint64\n0 {}\n"
        text += "CONNECTIVITY vtktypeint64\n0 1 2\n"
        self.write("good.vtk", text.format(3))
        self.succeed("good.vtk", "out.vtk")
        os.remove(self.path("out.vtk"))
        for last in (4, 999999999999, -1, 2):
            self.refuse_quickly("a.vtk", text.format(last))

    def test_counts_of_vtp(self):
        good = as_text(TRIANGLE, "a.vtp")
        for name, right, wrong in (
            ("Components", 3, (" ", "", 0, -3, "3x", 99999999999, 2147483648)),
            ("Points", 3, (99999999999, " ")),
            ("Polys", 1, (99999999,)),
        ):
            for count in wrong:
                self.refuse_quickly("a.vtp", good.replace(
                    f'NumberOf{name}="{right}"', f'NumberOf{name}="{count}"'))
        self.refuse_quickly("a.vtp", good.replace(">3<", ">99999999999<"))
        field = '<FieldData><DataArray type="{}" Name="f" NumberOfTuples="4000000000"/></FieldData>'
        for kind in ("Float64", "String", "Bit"):
            content = good.replace("<Piece", field.format(kind) + "<Piece", 1)
            self.refuse_quickly("a.vtp", content)

    def test_a_file_larger_than_memory(self):
        with open(self.path("a.ply"), "wb") as file:
            file.truncate(2 * MOST_MEMORY)  # a hole, which takes no room on the disk
        limit = (MOST_MEMORY, MOST_MEMORY)
        result = self.run_command(
            "a.ply", "out.vtk", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit))
        self.assertEqual(result.returncode, 3)
        self.assertEqual(result.stderr, "error: a.ply: cannot be read: not enough memory\n")

    def test_memory_that_is_really_needed(self):
        """A large file may use as much memory as it needs."""
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 300000)
        self.assertEqual(self.report("a.obj", "out.stl")["triangles"], 300000)


class Pipes(BadFileTest):
    def test_every_format(self):
        mesh = bumpy_grid(20, 0)
        for extension in FORMATS:
            path = self.write_mesh(mesh, "in" + extension)
            self.succeed(path, "expected.stl")
            os.mkfifo(self.path("pipe" + extension))
            writer = threading.Thread(
                target=self.write, args=("pipe" + extension, self.content(path)))
            writer.start()
            self.succeed("pipe" + extension, "out.stl")
            writer.join()
            self.assertEqual(
                triangles_of(self.read_mesh("out.stl")),
                triangles_of(self.read_mesh("expected.stl")),
                extension,
            )

    def test_errors_name_the_pipe(self):
        os.mkfifo(self.path("pipe.obj"))
        writer = threading.Thread(target=self.write, args=("pipe.obj", "v 0 0 x\n"))
        writer.start()
        self.fail_with(3, "pipe.obj", "out.vtk", naming=["pipe.obj: line 1: 'x'"])
        writer.join()
