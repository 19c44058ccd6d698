# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Virtual environments with the Python package in them, as `pip install` puts it there.

DELAUNAYFLIP_WHEEL in the environment names a wheel to test, e.g. one of Utilities/build-wheel.sh;
without it the package is built from the sources.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from readme import ROOT

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
    if wheel == "manylinux":
        return _build_manylinux(folder)
    return wheel or _build_here(folder)


def _build_manylinux(folder):
    """By Utilities/build-wheel.sh, for one GPU, in a quarter of the time for all."""
    if os.geteuid() != 0 or shutil.which("debootstrap") is None:
        raise unittest.SkipTest("build-wheel.sh needs root and debootstrap")
    run = subprocess.run([f"{ROOT}/Utilities/build-wheel.sh", folder], capture_output=True, text=True,
                         check=False, env={**_CLEAN, "CUDAARCHS": os.environ.get("CUDAARCHS", "75")})
    if run.returncode != 0:
        raise AssertionError(run.stdout + run.stderr)
    return _find_wheel(folder)


def _find_wheel(folder):
    (wheel,) = pathlib.Path(folder).glob("*.whl")
    return str(wheel)


def _build_here(folder):
    environment = Environment()
    try:
        environment.fetch("scikit-build-core")
        run = environment.run(
            "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation",
            "--wheel-dir", folder, "--config-settings=cmake.define.DELAUNAYFLIP_ENABLE_CUDA=OFF", ROOT,
            env={**_CLEAN, "CMAKE_BUILD_PARALLEL_LEVEL": "2"})
    finally:
        environment.close()
    if run.returncode != 0:
        raise AssertionError(run.stdout + run.stderr)
    return _find_wheel(folder)
