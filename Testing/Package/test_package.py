# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Configures, builds and runs projects that use an installed build, or this folder as a subproject; and
packs the build.

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
from unittest import mock

from pages import ROOT, read, snippets

CMAKE = os.environ["DELAUNAYFLIP_CMAKE"]
EXAMPLE = f"{ROOT}/Examples/Cxx/FlipArrays.cpp"
HEAD = "cmake_minimum_required(VERSION 3.22)\nproject(Consumer LANGUAGES CXX)\n"
NO_VTK = "-DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON"
CPACK = os.path.join(os.path.dirname(CMAKE), "cpack")
VERSION = re.search(r"project\(\w+ VERSION ([\d.]+)", read("CMakeLists.txt")).group(1)
BUILT_PYTHON = glob.glob(f"{os.environ['DELAUNAYFLIP_BUILD']}/lib/python3/*/delaunayflip/*.so")
PROGRAM = """
import delaunayflip
from delaunayflip import vtkDelaunayFlip, vtkDelaunayFlipLiveView
assert delaunayflip.__file__.startswith({prefix!r}), delaunayflip.__file__
result = delaunayflip.flip([[0, 0], [2, -1], [4, 0], [2, 1]], [[0, 1, 2], [0, 2, 3]])
print(result.report.total_flips, vtkDelaunayFlip().GetClassName())
"""


def list_public_headers():
    text = re.sub(r"#.*", "", read("Engine/CMakeLists.txt"))
    return re.search(r"set\(delaunayflip_engine_headers\s+([^)]*)\)", text).group(1).split()


class Consumer(unittest.TestCase):
    """A project in a folder of its own, with an installation beside it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.prefix = self.path("prefix")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def install(self, build):
        self.run_command([CMAKE, "--install", build, "--prefix", self.prefix])

    def configure(self, *options, source=None):
        """The command."""
        return [CMAKE, "-S", source or self.folder, "-B", self.path("build"), "-G", "Ninja",
                f"-DCMAKE_PREFIX_PATH={self.prefix}", *options]

    def build(self, *options, source=None):
        self.run_command(self.configure(*options, source=source))
        self.run_command([CMAKE, "--build", self.path("build"), "--parallel", "2"])

    def read_option(self, name):
        """An entry of the cache; None if there is none."""
        with open(self.path("build/CMakeCache.txt"), encoding="utf-8") as file:
            found = re.search(rf"^{name}:\w+=(.*)$", file.read(), re.MULTILINE)
        return found and found.group(1)

    def run_command(self, command, **environment):
        run = subprocess.run(command, cwd=self.folder, env={**os.environ, **environment},
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def run_program(self, name):
        return self.run_command([self.path(f"build/{name}")])

    def write_rhombus(self):
        self.write("rhombus.obj", "v -3 0 0\nv 0 -1 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
        return self.path("rhombus.obj")

    def expect_flips(self):
        self.assertIn("39601 flips", self.run_program("consumer"))


class Engine(Consumer):
    """Consumers of the engine of an installed build."""

    def setUp(self):
        super().setUp()
        self.install(os.environ["DELAUNAYFLIP_BUILD"])

    def test_engine(self):
        self.write("CMakeLists.txt", HEAD + f"""
find_package(DelaunayFlip {VERSION} REQUIRED COMPONENTS Engine)
add_executable(consumer "{EXAMPLE}")
target_link_libraries(consumer PRIVATE DelaunayFlip::Engine)
if(TARGET DelaunayFlip::Filters)
  message(FATAL_ERROR "VTK was not requested")
endif()
""")
        self.build(NO_VTK)
        self.expect_flips()
        self.assertTrue(self.read_option("TBB_DIR"))
        self.assertIsNone(self.read_option("VTK_DIR"))

    def test_headers(self):
        """Each public header is installed and compiles alone; no other header of the engine is."""
        installed = os.listdir(f"{self.prefix}/include/delaunayflip")
        headers = list_public_headers() + ["delaunayflip_c.h"]
        self.assertEqual(sorted(name for name in installed if not name.startswith("vtk")),
                         sorted(headers))
        for header in headers:
            self.write(f"{header}.cpp", f"#include <{header}>\n")
        sources = " ".join(f"{header}.cpp" for header in headers)
        self.write("CMakeLists.txt", HEAD + f"""
find_package(DelaunayFlip REQUIRED COMPONENTS Engine)
add_library(headers OBJECT {sources})
target_link_libraries(headers PRIVATE DelaunayFlip::Engine)
""")
        self.build()

    def test_c_program(self):
        """It links libdelaunayflip alone: no C++, no oneTBB, no VTK."""
        self.build(NO_VTK, "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON", source=f"{ROOT}/Examples/C")
        self.assertIn("1 flip,", self.run_program("flip-arrays-c"))

# What the other examples of the page on C++ need around them.
MORE = """
#include <DeviceMesh.h>
#include <DelaunayFlip.h>
#include <vtkCallbackCommand.h>
#include <vtkDelaunayFlip.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <iostream>

class MyFilter : public vtkPolyDataAlgorithm
{{
public:
  static MyFilter* New();
  vtkTypeMacro(MyFilter, vtkPolyDataAlgorithm);

protected:
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  void Follow(vtkObject*, unsigned long, void*);
}};

vtkStandardNewMacro(MyFilter);

{within}

bool Watch(vtkDelaunayFlip* flip)
{{
{observer}
  return isStopped;
}}

void FlipOnDevice(const float* devicePoints, const std::int32_t* deviceIds,
  std::int32_t* deviceResult, std::int64_t numberOfPoints, std::int64_t numberOfTriangles, void* stream)
{{
{device}
}}
"""


class Modules(Consumer):
    """Consumers of the VTK modules of an installed build."""

    def setUp(self):
        super().setUp()
        self.install(os.environ["DELAUNAYFLIP_BUILD"])

    def test_snippets_of_the_documentation(self):
        page = "Documentation/start/cpp.md"
        (project,) = [text for text in snippets("cmake", page) if "project(" in text]
        (program,) = [text for text in snippets("cpp", page) if "main()" in text]
        self.write("CMakeLists.txt", project.replace("my_program.cpp)", "my_program.cpp more.cpp)"))
        self.write("my_program.cpp", program)
        others = [text for text in snippets("cpp", page) if "main()" not in text]
        observer, within, device = (next(text for text in others if word in text)
                                    for word in ("vtkCallbackCommand", "MyFilter::", "DeviceMesh"))
        self.write("more.cpp", MORE.format(observer=observer, within=within, device=device))
        self.build()
        failed = subprocess.run([self.path("build/my_program")], cwd=self.path("."), check=False,
                                capture_output=True, text=True)
        self.assertEqual(failed.returncode, 1)  # its file is missing
        self.assertIn("terrain.vtp", failed.stderr)
        subprocess.run([f"{self.prefix}/bin/delaunay-flip", self.write_rhombus(),
                        self.path("terrain.vtp"), "--max-iterations", "0"],
                       stdout=subprocess.DEVNULL, check=False)
        self.assertEqual(self.run_program("my_program"), "1 flips\n")

    def test_examples(self):
        self.build(source=f"{ROOT}/Examples/Cxx")
        self.assertIn("39601 flips", self.run_program("FlipArrays"))


class Subproject(Consumer):
    """This folder in another project."""

    def test_subproject(self):
        self.write("CMakeLists.txt", HEAD + f"""
add_subdirectory("{ROOT}" delaunayflip)
add_executable(consumer "{EXAMPLE}")
target_link_libraries(consumer PRIVATE DelaunayFlip::Engine)
""")
        self.build("-DDELAUNAYFLIP_BUILD_VTK=OFF", "-DDELAUNAYFLIP_ENABLE_CUDA=OFF", NO_VTK)
        self.expect_flips()
        self.assertEqual(self.read_option("DELAUNAYFLIP_BUILD_TESTING"), "OFF")
        self.assertIsNone(self.read_option("BUILD_SHARED_LIBS"))
        self.assertEqual(self.read_option("CMAKE_BUILD_TYPE"), "")


class CudaVersion(Consumer):
    """The engine where the nvcc that CMake finds is a program that only says its version."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("bin"))
        self.nvcc = self.path("bin/nvcc")

    def write_nvcc(self, version):
        self.write("bin/nvcc", f"""#!/bin/sh
[ "$1" = --version ] || exit 1
echo "nvcc: NVIDIA (R) Cuda compiler driver"
echo "Cuda compilation tools, release {version}, V{version}.89"
""")
        os.chmod(self.nvcc, 0o755)

    def configure_engine(self, *options, **environment):
        """How CMake ended, and what it said, in one line."""
        with mock.patch.dict(os.environ, {"CUDACXX": "", **environment}):
            run = subprocess.run(
                self.configure("-DDELAUNAYFLIP_BUILD_VTK=OFF", "-DDELAUNAYFLIP_BUILD_TESTING=OFF",
                               *options, source=ROOT), capture_output=True, text=True, check=False)
        return run.returncode, " ".join((run.stdout + run.stderr).split())

    def test_an_old_one_is_not_used(self):
        """Found in the path and then from the cache, or named; an error where CUDA is asked for."""
        self.write_nvcc("11.8")
        reason = f"{self.nvcc} is of CUDA 11.8, and CUDA 12 or newer is needed"
        in_path = {"PATH": f"{self.path('bin')}:{os.environ['PATH']}"}
        named = [f"-DCMAKE_CUDA_COMPILER={self.nvcc}"]
        for options, environment in (([], in_path), ([], in_path),
                                     ([], {"CUDACXX": f"{self.nvcc} -ccbin g++"}), (named, {})):
            with self.subTest(options=options, environment=environment):
                code, text = self.configure_engine(*options, **environment)
                self.assertEqual(code, 0, text)
                self.assertIn(f"CUDA backend: not built, {reason}", text)
        code, text = self.configure_engine("-DDELAUNAYFLIP_ENABLE_CUDA=ON", *named)
        self.assertNotEqual(code, 0)
        self.assertIn(f"{reason}; install a newer CUDA Toolkit", text)


class Packing(Consumer):
    """What cpack makes of the build works where it is unpacked. Utilities/test-on.sh also installs the
    Debian package on a Debian that has nothing else."""

    def pack(self, generator):
        """The path of the only package."""
        config = os.path.join(os.environ["DELAUNAYFLIP_BUILD"], "CPackConfig.cmake")
        self.run_command([CPACK, "--config", config, "-G", generator, "-B", self.path("packed")])
        (package,) = [entry.path for entry in os.scandir(self.path("packed")) if entry.is_file()]
        return package

    def expect_that_it_works(self, prefix):
        """The command and the Python package below the prefix, far from the build's libraries."""
        command = f"{prefix}/bin/delaunay-flip"
        self.assertEqual(self.run_command([command, "--version"]), f"delaunay-flip {VERSION}\n")
        output = self.run_command([command, self.write_rhombus(), self.path("out.obj")])
        self.assertIn("1 in 1 iteration, converged", output)
        if BUILT_PYTHON:
            packages = f"{prefix}/lib/python3/dist-packages"
            output = self.run_command([sys.executable, "-c", PROGRAM.format(prefix=prefix)],
                                      PYTHONPATH=packages)
            self.assertEqual(output, "1 vtkDelaunayFlip\n")


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

    def test_package(self):
        package = self.pack("DEB")
        fields = self.run_command(["dpkg-deb", "-f", package])
        self.assertRegex(fields, rf"(?s)Package: delaunayflip\n.*Version: {VERSION}\n")
        needed = re.search(r"^Depends: (.*)$", fields, re.MULTILINE).group(1)
        for library in ("libc6", "libstdc++6", "libtbb12", "libvtk9"):
            self.assertIn(library, needed)
        self.run_command(["dpkg-query", "-W", *(part.split()[0] for part in needed.split(","))])
        self.run_command(["dpkg-deb", "-x", package, self.folder])
        for path in ("man/man1/delaunay-flip.1", "bash-completion/completions/delaunay-flip"):
            self.assertTrue(os.path.exists(self.path(f"usr/share/{path}")), path)
        self.expect_that_it_works(self.path("usr"))
