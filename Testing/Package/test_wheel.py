# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Python package in clean virtual environments."""
import pathlib
import re
import tempfile
import unittest
import zipfile

from readme import ROOT, read
from wheels import Environment, build_wheel

FLIP = """
import sys, delaunayflip
result = delaunayflip.flip([[0, 0], [2, -1], [4, 0], [2, 1]], [[0, 1, 2], [0, 2, 3]])
assert result.report.total_flips == 1 and result.report.converged
assert not [name for name in sys.modules if name.startswith("vtk")]
print(delaunayflip.__version__)
"""

TYPED = """
import numpy
from delaunayflip import Report, Result, Session, flip, smallest_angles

points = numpy.array([[0.0, 0.0], [2.0, -1.0], [4.0, 0.0], [2.0, 1.0]])
triangles = [[0, 1, 2], [0, 2, 3]]
result: Result = flip(points, triangles, geometry="planar", progress=lambda share: share < 2)
flips: int = result.report.total_flips
with Session(points, triangles, threads=1, constraints=[[0, 2]]) as session:
    running: bool = session.advance(1, on_iteration=lambda row: None)
    report: Report = session.report
angles = smallest_angles(points, session.triangles).mean()
"""


class Wheel(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.wheel = build_wheel(folder.name)
        cls.environment = Environment()
        cls.addClassCleanup(cls.environment.close)
        cls.environment.fetch("numpy", "mypy", "typing_extensions")
        cls.environment.install_package(cls.wheel)

    def run_python(self, program):
        run = self.environment.run("-c", program)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def test_name(self):
        """It serves every Python 3, and says for which machines."""
        self.assertRegex(pathlib.Path(self.wheel).name,
                         r"^delaunayflip-[0-9.]+-py3-none-(many)?linux\w*_x86_64\.whl$")

    def test_serves_other_machines(self):
        """If it says so: an old glibc, and a size that an index takes."""
        tag = re.search(r"manylinux_2_(\d+)_", self.wheel)
        if tag:
            self.assertLessEqual(int(tag.group(1)), 31)
            self.assertLess(pathlib.Path(self.wheel).stat().st_size, 60e6)

    def test_flips_without_vtk(self):
        self.assertEqual(self.run_python(FLIP).strip(), self.get_version())

    def get_version(self):
        """The version has one home."""
        return re.search(r"project\(DelaunayFlip VERSION ([0-9.]+)", read("CMakeLists.txt")).group(1)

    def test_version_of_the_metadata(self):
        printed = self.run_python(
            "from importlib.metadata import version; print(version('delaunayflip'))")
        self.assertEqual(printed.strip(), self.get_version())

    def test_files(self):
        """The package and what it needs: no second copy of the library, nothing of VTK."""
        with zipfile.ZipFile(self.wheel) as archive:
            names = set(archive.namelist())
        sources = {f"delaunayflip/{path.name}"
                   for path in pathlib.Path(ROOT, "Python", "delaunayflip").glob("*.py")}
        sources |= {"delaunayflip/py.typed", "delaunayflip/libdelaunayflip.so.1",
                    "delaunayflip/DelaunayFlip.xml"}
        package = {name for name in names if name.startswith("delaunayflip/")}
        self.assertEqual(package, sources)
        others = {name for name in names - package if ".dist-info/" not in name}
        for name in others:
            self.assertRegex(name, r"^delaunayflip\.libs/libtbb-\w+\.so")

    def check_types(self, program):
        path = self.environment.path / "typed.py"
        path.write_text(program, encoding="utf-8")
        return self.environment.run("-m", "mypy", "--strict", str(path))

    def test_types(self):
        run = self.check_types(TYPED)
        self.assertEqual(run.returncode, 0, run.stdout)
        run = self.check_types(TYPED.replace('"planar"', '"round"').replace("threads=1", "thread=1"))
        self.assertIn("Found 2 errors", run.stdout)


FILTER_TESTS = ("test_vtk_delaunay_flip",)


class Vtk(unittest.TestCase):
    """The wheel beside the wheels of VTK and PyVista; these are large."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.wheel = build_wheel(folder.name)

    def check(self, *packages, modules=FILTER_TESTS):
        environment = Environment()
        self.addCleanup(environment.close)
        environment.fetch("numpy", *packages)
        environment.install_package(self.wheel)
        run = environment.test(*modules)
        self.assertEqual(run.returncode, 0, run.stderr)
        which = environment.run("-c", "import delaunayflip; print(delaunayflip.vtkDelaunayFlip)")
        self.assertIn("_vtk_filter", which.stdout, which.stderr)

    def test_vtk_9_2(self):
        self.check("vtk==9.2.6")

    def test_vtk_9_4(self):
        self.check("vtk==9.4.2")

    def test_newest_vtk(self):
        self.check("vtk")

    def test_newest_pyvista(self):
        self.check("pyvista[io]", "imageio", "trimesh", "meshio", "nbclient", "ipykernel",
                   modules=("test_pyvista", *FILTER_TESTS))

    def test_cvista(self):
        self.check("pyvista[io]", "cvista", "cvista-io", "cvista-rendering", "imageio", "trimesh",
                   "meshio", modules=("test_pyvista",))


if __name__ == "__main__":
    unittest.main()
