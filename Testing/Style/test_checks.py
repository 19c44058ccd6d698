#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The style checks pass on a small clean tree and fail for each fault that is planted in it."""

import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))

LICENCE = (
    "// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers\n"
    "// SPDX-License-Identifier: BSD-3-Clause\n"
)

ENGINE = (
    LICENCE.replace("//", "#")
    + "set(delaunayflip_engine_headers # the public ones\n  DelaunayFlip.h\n  FlipOptions.h)\n"
    + "set(delaunayflip_engine_rooms Geometry Mesh Flips Session)\n"
)

WIDE = 30 * "wide "
MARKDOWN = (
    f"# Head\n\n[link]({WIDE})\n\n    {WIDE}\n    {WIDE}\n\n```\nshort\n\n{WIDE}\n```\n\n"
    f"| a | {WIDE} |\n|---|---|\n\n![{WIDE}](picture.png)\n"
)

CLEAN = {
    ".clang-format": "BasedOnStyle: Mozilla\n",
    "Engine/CMakeLists.txt": ENGINE,
    "Engine/FlipOptions.h": LICENCE + "#include <vector>\n",
    "Engine/Mesh/EdgeMesh.h": LICENCE + '#include "FlipOptions.h"\n// printf("%d") prints\n',
    "Engine/Session/CallerMesh.h": LICENCE + '#include "EdgeMesh.h"\n#include "Team.cuh"\n',
    "CUDA/Team.cuh": LICENCE + '#include "EdgeMesh.h"\n',
    "Filters/vtkDelaunayFlip.cxx": LICENCE + '#include "FlipOptions.h"\n#include <vtkObject.h>\n',
    "Testing/Core/TestEdgeMesh.cpp": LICENCE + '#include "EdgeMesh.h"\n#include "vtkObject.h"\n',
    "Utilities/short.py": LICENCE.replace("//", "#") + "def answer():\n    return 42\n",
    "Documentation/wide.md": MARKDOWN,
    "CMakeLists.txt": "project(Clean VERSION 1.2.3)\n",
    "CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.3\n",
    "CHANGELOG.md": "## [Unreleased]\n\n## [1.2.3] - 2000-01-01\n\n## [1.2.2] - 1999-01-01\n",
    "Utilities/demo.sh": "#!/bin/sh\n" + LICENCE.replace("//", "#"),
}

SKIPPED = 125


class CheckedTree(unittest.TestCase):
    """A clean tree in a folder."""

    def setUp(self):
        self.tree = tempfile.TemporaryDirectory(prefix="style tree ")
        self.addCleanup(self.tree.cleanup)
        for path, text in CLEAN.items():
            self.write(path, text)

    def write(self, path, text):
        full = os.path.join(self.tree.name, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)

    def remove(self, path):
        os.remove(os.path.join(self.tree.name, path))

    def run_check(self, script, *arguments):
        """Exit status and output of one check on the tree."""
        command = [sys.executable, os.path.join(HERE, script), *arguments, self.tree.name]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode == SKIPPED:
            self.skipTest(result.stdout)
        return result.returncode, result.stdout + result.stderr

    def check_notices(self, check, path, text, expected):
        """The check passes, then names the fault once `path` contains `text`."""
        status, output = self.run_check(*check)
        self.assertEqual(status, 0, output)
        self.write(path, text)
        status, output = self.run_check(*check)
        self.assertEqual(status, 1, output)
        self.assertIn(expected, output)


class StyleChecks(CheckedTree):

    def test_engine_without_vtk(self):
        for path in ("Engine/Bad.cpp", "Engine/Mesh/Bad.h", "CUDA/Bad.cuh", "CUDA/Bad.cu"):
            with self.subTest(path):
                self.check_notices(
                    ["check_layering.py"],
                    path,
                    "#include <vtkPolyData.h>\n",
                    f"{path}: the engine includes vtkPolyData.h of VTK",
                )
                self.remove(path)

    def test_engine_below_filters(self):
        self.write("Filters/PolyDataBridge.h", LICENCE)
        self.check_notices(
            ["check_layering.py"],
            "Engine/Flips/Bad.h",
            '#include "../Filters/PolyDataBridge.h"\n',
            "Engine/Flips includes ../Filters/PolyDataBridge.h of Filters",
        )

    def test_rooms_in_order(self):
        for path, room in (
            ("Engine/Geometry/Bad.h", "Engine/Geometry"),
            ("Engine/DelaunayFlip.h", "the engine's public headers"),
        ):
            with self.subTest(path):
                self.check_notices(
                    ["check_layering.py"],
                    path,
                    '#include "EdgeMesh.h"\n',
                    f"{path}: {room} includes EdgeMesh.h of Engine/Mesh",
                )
                self.remove(path)

    def test_rooms_below_cuda(self):
        self.check_notices(
            ["check_layering.py"],
            "Engine/Flips/Bad.h",
            '#include "Team.cuh"\n',
            "Engine/Flips includes Team.cuh of CUDA",
        )

    def test_filters_below_command(self):
        self.write("Command/Arguments.h", LICENCE)
        self.check_notices(
            ["check_layering.py"],
            "Filters/Bad.cxx",
            '#  include "Arguments.h"\n',
            "Filters includes Arguments.h of Command",
        )

    def test_filters_below_rendering(self):
        self.write("Rendering/LiveScene.h", LICENCE)
        self.check_notices(
            ["check_layering.py"],
            "Filters/Bad.cxx",
            '#include "LiveScene.h"\n',
            "Filters includes LiveScene.h of Rendering",
        )

    def test_rendering_above_filters(self):
        self.check_notices(
            ["check_layering.py"],
            "Rendering/Bad.cxx",
            '#include "EdgeMesh.h"\n',
            "Rendering includes EdgeMesh.h of Engine/Mesh",
        )

    def test_engine_without_opengl(self):
        self.check_notices(
            ["check_layering.py"],
            "CUDA/Bad.cu",
            "#include <cuda_gl_interop.h>\n",
            "the engine includes cuda_gl_interop.h of OpenGL",
        )

    def test_cuda_below_the_session(self):
        for path in ("CUDA/Bad.cuh", "CUDA/Bad.cu"):
            with self.subTest(path):
                self.check_notices(
                    ["check_layering.py"],
                    path,
                    '#include "CallerMesh.h"\n',
                    "CUDA includes CallerMesh.h of Engine/Session",
                )
                self.remove(path)

    def test_shipped_code_without_tests(self):
        self.write("Testing/Meshes/GeneratedMeshes.h", LICENCE)
        for path, layer in (("Command/Bad.cxx", "Command"), ("CUDA/Bad.cu", "CUDA")):
            with self.subTest(path):
                self.check_notices(
                    ["check_layering.py"],
                    path,
                    '#include "GeneratedMeshes.h"\n',
                    f"{layer} includes GeneratedMeshes.h of Testing",
                )
                self.remove(path)

    def test_internal_header(self):
        self.check_notices(
            ["check_layering.py"],
            "Filters/Bad.h",
            '#include "EdgeMesh.h"\n',
            "Filters includes EdgeMesh.h of Engine/Mesh",
        )

    def test_long_function(self):
        lines = "  f();\n" * 80
        for path, text in (
            ("CUDA/Bad.cuh", f"void Long()\n{{\n{lines}}}\n"),
            ("CUDA/Bad.cu", f"__global__ void Long()\n{{\n{lines}}}\n"),
            ("Testing/Core/TestBad.cpp", f"TEST(Long, OfGoogleTest)\n{{\n{lines}}}\n"),
            ("Utilities/bad.py", "def long():\n" + "    f()\n" * 80),
        ):
            with self.subTest(path):
                self.check_notices(["check_functions.py"], path, text, f"{path}:1 ")
                self.remove(path)

    def test_licence(self):
        names = ("Engine/Bad.h", "CUDA/Bad.cuh", "CUDA/Bad.cu", "CMake/Bad.cmake", "Utilities/bad.py")
        for path in (*names, "Utilities/bad.sh"):
            with self.subTest(path):
                self.check_notices(["check_files.py", "licences"], path, "\n", path)
                self.remove(path)

    def test_size(self):
        path, text = "Testing/Data/big.vtp", "x" * 1_000_001
        self.check_notices(["check_files.py", "sizes"], path, text, f"{path}: 1000001 bytes")

    def test_words(self):
        names = ("Filters/Bad.cxx", "Rendering/Bad.cxx", "CUDA/Bad.cu", "CUDA/Bad.cuh")
        for word in ("std::exit(1);", "abort();", "std::cout << 1;", 'std::printf("x");'):
            with self.subTest(word):
                text = f"/* one\n two */ void F()\n{{ {word} }}\n"
                for path in (*names, "Engine/Mesh/Bad.h"):
                    self.check_notices(["check_files.py", "words"], path, text, f"{path}:3: ")
                    self.remove(path)

    def test_markdown(self):
        words = 20 * "word "  # 99 columns and a space
        for path, text in (
            ("README.md", f"Short.\n\n{words.strip()}\n{words}\n"),
            ("Documentation/method.md", f"- A list\n\n\n- {words}\n"),
            ("CHANGELOG.md", f"    code\n\nText.\n    {words}\n"),
            ("Engine/README.md", f"```\ncode\n```\n\n{words}[link](target)\n"),
        ):
            with self.subTest(path):
                expected = f"{path}:{text.count(chr(10))}: "
                self.check_notices(["check_files.py", "markdown"], path, text, expected)
                self.remove(path)

    def test_release(self):
        for path, text, found in (
            ("CMakeLists.txt", "project(Clean VERSION 1.2.4)\n", "CITATION.cff: version 1.2.3,"),
            ("CITATION.cff", "version: 1.2.2\n", "CITATION.cff: version 1.2.2, "),
            ("CHANGELOG.md", "## [1.2.2] - 1999-01-01\n", "CHANGELOG.md: newest version 1.2.2,"),
        ):
            with self.subTest(path):
                self.check_notices(["check_files.py", "release"], path, text, found)
                self.write(path, CLEAN[path])


class FormatCheck(CheckedTree):

    def test_format(self):
        for path in ("CUDA/Bad.cu", "CUDA/Bad.cuh", "Engine/Bad.h", "Filters/Bad.cxx"):
            with self.subTest(path):
                self.check_notices(
                    ["check_format.py"], path, "int  x ;\n", f"{path}: run clang-format"
                )
                self.remove(path)


if __name__ == "__main__":
    unittest.main()
