# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What cpack makes of the build works where it is unpacked. Utilities/test-on.sh also installs the
Debian package on a Debian that has nothing else.

DELAUNAYFLIP_BUILD in the environment is the build, DELAUNAYFLIP_CMAKE the program cmake.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest

from readme import read

CPACK = os.path.join(os.path.dirname(os.environ["DELAUNAYFLIP_CMAKE"]), "cpack")
VERSION = re.search(r"project\(\w+ VERSION ([\d.]+)", read("CMakeLists.txt")).group(1)
BUILT_PYTHON = glob.glob(f"{os.environ['DELAUNAYFLIP_BUILD']}/lib/python3/*/delaunayflip/*.so")

PROGRAM = """
import delaunayflip
from delaunayflip import vtkDelaunayFlip, vtkDelaunayFlipLiveView
assert delaunayflip.__file__.startswith({prefix!r}), delaunayflip.__file__
result = delaunayflip.flip([[0, 0], [2, -1], [4, 0], [2, 1]], [[0, 1, 2], [0, 2, 3]])
print(result.report.total_flips, vtkDelaunayFlip().GetClassName())
"""


class Packing(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def pack(self, generator):
        """The path of the only package."""
        config = os.path.join(os.environ["DELAUNAYFLIP_BUILD"], "CPackConfig.cmake")
        run = subprocess.run([CPACK, "--config", config, "-G", generator, "-B", self.path("packed")],
                             cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        (package,) = [entry.path for entry in os.scandir(self.path("packed")) if entry.is_file()]
        return package

    def expect_that_it_works(self, prefix):
        """The command and the Python package below the prefix, far from the build's libraries."""
        with open(self.path("rhombus.obj"), "w", encoding="utf-8") as file:
            file.write("v -3 0 0\nv 0 -1 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
        command = f"{prefix}/bin/delaunay-flip"
        self.assertEqual(self.run_program([command, "--version"]), f"delaunay-flip {VERSION}\n")
        output = self.run_program([command, self.path("rhombus.obj"), self.path("out.obj")])
        self.assertIn("1 in 1 iteration, converged", output)
        if BUILT_PYTHON:
            packages = f"{prefix}/lib/python3/dist-packages"
            output = self.run_program([sys.executable, "-c", PROGRAM.format(prefix=prefix)],
                                      PYTHONPATH=packages)
            self.assertEqual(output, "1 vtkDelaunayFlip\n")

    def run_program(self, command, **environment):
        run = subprocess.run(command, cwd=self.folder, env={**os.environ, **environment},
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout


class Archive(Packing):

    def test_unpacked(self):
        package = self.pack("TGZ")
        name = os.path.basename(package).removesuffix(".tar.gz")
        self.assertTrue(name.startswith(f"delaunayflip-{VERSION}-"), name)
        with tarfile.open(package) as archive:
            archive.extractall(self.folder)
        self.expect_that_it_works(self.path(name))


@unittest.skipUnless(shutil.which("dpkg-shlibdeps") and shutil.which("file"),
                     "no dpkg-shlibdeps or file (Debian: dpkg-dev, file)")
class DebianPackage(Packing):

    def setUp(self):
        super().setUp()
        self.package = self.pack("DEB")

    def read_field(self, name):
        return subprocess.run(["dpkg-deb", "-f", self.package, name], capture_output=True, text=True,
                              check=True).stdout.strip()

    def test_package(self):
        self.check_fields()
        subprocess.run(["dpkg-deb", "-x", self.package, self.folder], check=True)
        self.expect_that_it_works(self.path("usr"))

    def check_fields(self):
        self.assertEqual(self.read_field("Package"), "delaunayflip")
        self.assertEqual(self.read_field("Version"), VERSION)
        names = [part.split()[0] for part in self.read_field("Depends").split(",")]
        for library in ("libc6", "libstdc++6", "libtbb12", "libvtk9"):
            self.assertTrue(any(name.startswith(library) for name in names), names)
        for name in names:
            subprocess.run(["dpkg-query", "-W", name], stdout=subprocess.DEVNULL, check=True)


if __name__ == "__main__":
    unittest.main()
