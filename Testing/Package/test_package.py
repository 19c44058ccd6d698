# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Configures, builds and runs projects that use an installed build, or this folder as a subproject.

DELAUNAYFLIP_BUILD in the environment is the build, DELAUNAYFLIP_CMAKE the program cmake.
"""
import os
import re
import subprocess
import tempfile
import unittest
from unittest import mock

from readme import ROOT, read, snippets

CMAKE = os.environ["DELAUNAYFLIP_CMAKE"]
EXAMPLE = f"{ROOT}/Examples/Cxx/FlipArrays.cpp"
C_EXAMPLE = f"{ROOT}/Examples/C/flip_arrays.c"
HEAD = "cmake_minimum_required(VERSION 3.22)\nproject(Consumer LANGUAGES CXX)\n"
NO_VTK = "-DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON"


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

    def run_cmake(self, *arguments):
        return subprocess.run([CMAKE, *arguments], capture_output=True, text=True, check=False)

    def succeed(self, *arguments):
        run = self.run_cmake(*arguments)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def install(self, build):
        self.succeed("--install", build, "--prefix", self.prefix)

    def configure(self, *options, source=None):
        return self.run_cmake(
            "-S", source or self.folder, "-B", self.path("build"), "-G", "Ninja",
            f"-DCMAKE_PREFIX_PATH={self.prefix}", *options)

    def build(self, *options, source=None):
        run = self.configure(*options, source=source)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.succeed("--build", self.path("build"), "--parallel", "2")

    def read_option(self, name):
        """An entry of the cache; None if there is none."""
        with open(self.path("build/CMakeCache.txt"), encoding="utf-8") as file:
            found = re.search(rf"^{name}:\w+=(.*)$", file.read(), re.MULTILINE)
        return found and found.group(1)

    def run_program(self, name):
        return subprocess.run([self.path(f"build/{name}")], cwd=self.folder, capture_output=True,
                              text=True, check=True).stdout

    def expect_flips(self):
        self.assertIn("39601 flips", self.run_program("consumer"))


class Engine(Consumer):
    """Consumers of the engine of an installed build."""

    def setUp(self):
        super().setUp()
        self.install(os.environ["DELAUNAYFLIP_BUILD"])

    def test_engine(self):
        self.write("CMakeLists.txt", HEAD + f"""
find_package(DelaunayFlip 0.1 REQUIRED COMPONENTS Engine)
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
        self.write("CMakeLists.txt", f"""
cmake_minimum_required(VERSION 3.22)
project(Consumer LANGUAGES C)
find_package(DelaunayFlip 0.1 REQUIRED COMPONENTS C)
add_executable(consumer "{C_EXAMPLE}")
target_link_libraries(consumer PRIVATE DelaunayFlip::C)
""")
        self.build(NO_VTK, "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON")
        self.assertIn("1 flips", self.run_program("consumer"))

    def test_a_component_that_is_not_there(self):
        self.write("CMakeLists.txt", HEAD + "find_package(DelaunayFlip REQUIRED COMPONENTS Wings)\n")
        run = self.configure()
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("Wings", run.stderr)


class Modules(Consumer):
    """Consumers of the VTK modules of an installed build."""

    def setUp(self):
        super().setUp()
        self.install(os.environ["DELAUNAYFLIP_BUILD"])

    def test_snippets_of_the_documentation(self):
        page = "Documentation/start/cpp.md"
        (project,) = [text for text in snippets("cmake", page) if "project(" in text]
        (program,) = [text for text in snippets("cpp", page) if "main()" in text]
        self.write("CMakeLists.txt", project)
        self.write("my_program.cpp", program)
        self.build()
        subprocess.run([f"{self.prefix}/bin/delaunay-flip", self.write_rhombus(),
                        self.path("terrain.vtp"), "--max-iterations", "0"],
                       stdout=subprocess.DEVNULL, check=False)
        self.assertEqual(self.run_program("my_program"), "1 flips\n")

    def write_rhombus(self):
        self.write("rhombus.obj", "v -3 0 0\nv 0 -1 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
        return self.path("rhombus.obj")

    def test_all_components(self):
        self.write("CMakeLists.txt", HEAD.replace("CXX", "C CXX") + f"""
find_package(DelaunayFlip REQUIRED)
add_executable(consumer "{EXAMPLE}")
target_link_libraries(consumer PRIVATE DelaunayFlip::Engine DelaunayFlip::Filters)
""")
        self.build()
        self.expect_flips()

    def test_examples(self):
        self.build(source=f"{ROOT}/Examples/Cxx")
        self.assertIn("39601 flips", self.run_program("FlipArrays"))


class Subproject(Consumer):
    """This folder in another project, which installs the engine with itself."""

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
        self.install(self.path("build"))
        self.use_what_it_installed()

    def use_what_it_installed(self):
        os.rename(self.path("build"), self.path("first"))
        self.write("CMakeLists.txt", HEAD + f"""
find_package(DelaunayFlip REQUIRED)
add_executable(consumer "{EXAMPLE}")
target_link_libraries(consumer PRIVATE DelaunayFlip::Engine)
find_package(DelaunayFlip COMPONENTS Filters)
if(DelaunayFlip_FOUND)
  message(FATAL_ERROR "it has no VTK")
endif()
""")
        self.build(NO_VTK)
        self.expect_flips()


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
            run = self.configure("-DDELAUNAYFLIP_BUILD_VTK=OFF", "-DDELAUNAYFLIP_BUILD_TESTING=OFF",
                                 *options, source=ROOT)
        return run.returncode, " ".join((run.stdout + run.stderr).split())

    def expect_no_backend(self, reason, *options, **environment):
        code, text = self.configure_engine(*options, **environment)
        self.assertEqual(code, 0, text)
        self.assertIn(f"CUDA backend: not built, {reason}", text)

    def test_an_old_one_is_not_used(self):
        self.write_nvcc("11.8")
        reason = f"{self.nvcc} is of CUDA 11.8, and CUDA 12 or newer is needed"
        path = f"{self.path('bin')}:{os.environ['PATH']}"
        for options, environment in (
                ([], {"PATH": path}), # the second time, from the cache
                ([], {"PATH": path}),
                ([], {"CUDACXX": f"{self.nvcc} -ccbin g++"}),
                ([f"-DCMAKE_CUDA_COMPILER={self.nvcc}"], {})):
            with self.subTest(options=options, environment=environment):
                self.expect_no_backend(reason, *options, **environment)

    def test_an_old_one_is_an_error_where_cuda_is_asked_for(self):
        self.write_nvcc("11.8")
        code, text = self.configure_engine("-DDELAUNAYFLIP_ENABLE_CUDA=ON",
                                           f"-DCMAKE_CUDA_COMPILER={self.nvcc}")
        self.assertNotEqual(code, 0)
        self.assertIn(f"{self.nvcc} is of CUDA 11.8, and CUDA 12 or newer is needed; install a "
                      "newer CUDA Toolkit", text)

    def test_the_oldest_one_is_tried(self):
        self.write_nvcc("12.0")
        self.expect_no_backend("no CUDA compiler", CUDACXX=self.nvcc)


if __name__ == "__main__":
    unittest.main()
