# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Python package in clean virtual environments, as `pip install` puts it there.

DELAUNAYFLIP_WHEEL in the environment names a wheel to test, e.g. one of Utilities/build-wheel.sh;
without it the package is built from the sources.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

from pages import ROOT, read

FLIP = """
import importlib.metadata, pydoc, sys, delaunayflip
result = delaunayflip.flip([[0, 0], [2, -1], [4, 0], [2, 1]], [[0, 1, 2], [0, 2, 3]])
assert result.report.total_flips == 1 and result.report.converged
assert not [name for name in sys.modules if name.startswith("vtk")]
pydoc.render_doc(delaunayflip)  # help() looks up all names
print(delaunayflip.__version__, importlib.metadata.version("delaunayflip"))
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


_CLEAN = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}


class Environment:
    """A virtual environment in a temporary folder."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self._folder.name)
        self.python = str(self.path / "bin" / "python")
        made = subprocess.run([sys.executable, "-m", "venv", self.path], capture_output=True,
                              text=True, check=False)
        if made.returncode != 0:
            raise unittest.SkipTest(f"no virtual environments here (Debian: python3-venv)\n{made.stdout}")

    def close(self):
        self._folder.cleanup()

    def run(self, *arguments, **options):
        """Runs the environment's Python in its folder, which has no sources."""
        options = {"cwd": self.path, "env": _CLEAN, **options}
        return subprocess.run([self.python, *arguments], capture_output=True, text=True,
                              check=False, **options)

    def pip(self, *arguments):
        return self.run("-m", "pip", "install", "--quiet", "--disable-pip-version-check", *arguments)

    def fetch(self, *packages):
        """Installs packages of others; skips the tests where that is impossible."""
        run = self.pip(*packages)
        if run.returncode != 0:
            raise unittest.SkipTest(f"cannot install {' '.join(packages)}:\n{run.stderr[-2000:]}")

    def test(self, *modules):
        """Runs tests of Testing/Python."""
        return self.run("-m", "unittest", *modules, cwd=os.path.join(ROOT, "Testing", "Python"))

    def install_package(self, wheel):
        run = self.pip("--no-deps", wheel)
        if run.returncode != 0:
            raise AssertionError(run.stdout + run.stderr)


def build_wheel(folder):
    """The wheel to test: that of DELAUNAYFLIP_WHEEL, or one made in `folder`: for other machines, if
    DELAUNAYFLIP_WHEEL is "manylinux", and else for this one."""
    wheel = os.environ.get("DELAUNAYFLIP_WHEEL", "")
    if wheel not in ("", "manylinux"):
        return wheel
    run = _build_manylinux(folder) if wheel else _build_here(folder)
    if run.returncode != 0:
        raise AssertionError(run.stdout + run.stderr)
    (wheel,) = pathlib.Path(folder).glob("*.whl")
    return str(wheel)


def _build_manylinux(folder):
    """By Utilities/build-wheel.sh, for one GPU, in a quarter of the time for all."""
    if os.geteuid() != 0 or shutil.which("debootstrap") is None:
        raise unittest.SkipTest("build-wheel.sh needs root and debootstrap")
    return subprocess.run(
        [f"{ROOT}/Utilities/build-wheel.sh", folder], capture_output=True, text=True, check=False,
        env={**_CLEAN, "CUDAARCHS": os.environ.get("CUDAARCHS", "75")})


def _build_here(folder):
    environment = Environment()
    try:
        environment.fetch("scikit-build-core")
        return environment.run(
            "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation",
            "--wheel-dir", folder, "--config-settings=cmake.define.DELAUNAYFLIP_ENABLE_CUDA=OFF", ROOT,
            env={**_CLEAN, "CMAKE_BUILD_PARALLEL_LEVEL": "2"})
    finally:
        environment.close()


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

    def test_name(self):
        """It serves every Python 3, and says for which machines: if for others, those with an old glibc;
        and its size is one that an index takes."""
        name = pathlib.Path(self.wheel).name
        self.assertRegex(name, r"^delaunayflip-[0-9.]+-py3-none-(many)?linux\w*_x86_64\.whl$")
        tag = re.search(r"manylinux_2_(\d+)_", name)
        if tag:
            self.assertLessEqual(int(tag.group(1)), 31)
            self.assertLess(pathlib.Path(self.wheel).stat().st_size, 60e6)

    def test_flips_without_vtk(self):
        """The version has one home."""
        version = re.search(r"project\(DelaunayFlip VERSION ([0-9.]+)", read("CMakeLists.txt")).group(1)
        run = self.environment.run("-c", FLIP)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertEqual(run.stdout.split(), [version, version])

    def test_files(self):
        """The package and what it needs: no second copy of the library, nothing of VTK, and no
        oneTBB, which is the system's, or in the library."""
        with zipfile.ZipFile(self.wheel) as archive:
            names = set(archive.namelist())
        sources = {f"delaunayflip/{path.name}"
                   for path in pathlib.Path(ROOT, "Python", "delaunayflip").glob("*.py")}
        sources |= {"delaunayflip/py.typed", "delaunayflip/plugin/DelaunayFlip.py",
                    "delaunayflip/AngleColors.json", "delaunayflip/libdelaunayflip.so.1",
                    "delaunayflip/DelaunayFlip.xml"}
        package = {name for name in names if name.startswith("delaunayflip/")}
        self.assertEqual(package, sources)
        self.assertEqual({name for name in names - package if ".dist-info/" not in name}, set())

    def test_licences(self):
        """A wheel for other machines has those of all that is inside, and a list of it."""
        with zipfile.ZipFile(self.wheel) as archive:
            licences = {pathlib.Path(name).stem for name in archive.namelist()
                        if re.search(r"\.dist-info/licenses/.*\.txt$", name)}
            lists = [json.loads(archive.read(name)) for name in archive.namelist()
                     if name.endswith("/sboms/delaunayflip.cdx.json")]
        inside = {part["name"].replace(" ", "-") for made in lists for part in made["components"]
                  if part["type"] == "library"}
        self.assertEqual(inside, licences)
        if "manylinux" in pathlib.Path(self.wheel).name:
            self.assertLessEqual({"oneTBB", "Boost"}, inside)

    def test_types(self):
        path = self.environment.path / "typed.py"
        wrong = TYPED.replace('"planar"', '"round"').replace("threads=1", "thread=1")
        for program, found in ((TYPED, "Success"), (wrong, "Found 2 errors")):
            path.write_text(program, encoding="utf-8")
            run = self.environment.run("-m", "mypy", "--strict", str(path))
            self.assertIn(found, run.stdout)


class Vtk(unittest.TestCase):
    """The wheel beside the wheels of VTK and PyVista; these are large."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.wheel = build_wheel(folder.name)

    def check(self, *packages, modules=("test_vtk_delaunay_flip",)):
        environment = Environment()
        self.addCleanup(environment.close)
        environment.fetch("numpy", *packages)
        environment.install_package(self.wheel)
        run = environment.test(*modules)
        self.assertEqual(run.returncode, 0, run.stderr)
        which = environment.run("-c", "import delaunayflip; print(delaunayflip.vtkDelaunayFlip)")
        self.assertIn("_vtk_filter", which.stdout, which.stderr)

    def test_vtk(self):
        for release in ("vtk==9.2.6", "vtk==9.4.2", "vtk"):
            with self.subTest(release):
                self.check(release)

    def test_newest_pyvista(self):
        self.check("pyvista[io]", "imageio", "trimesh", "meshio", "laspy[lazrs]", "nbclient", "ipykernel",
                   modules=("test_pyvista", "test_vtk_delaunay_flip"))

    def test_cvista(self):
        self.check("pyvista[io]", "cvista", "cvista-io", "cvista-rendering", "imageio", "trimesh",
                   "meshio", modules=("test_pyvista",))
