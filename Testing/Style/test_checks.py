#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The style checks pass on a small clean tree and fail on each fault planted in it."""

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

CLEAN = {
    ".clang-format": "BasedOnStyle: Mozilla\n",
    "CUDA/FlipOptions.h": LICENCE + "#include <vector>\n",
    "CUDA/EdgeMesh.h": LICENCE + '#include "FlipOptions.h"\n// printf("%d") prints\n',
    "Filters/vtkDelaunayFlip.cxx": LICENCE + '#include "FlipOptions.h"\n#include <vtkObject.h>\n',
    "Testing/Core/TestEdgeMesh.cpp": LICENCE + '#include "EdgeMesh.h"\n#include "vtkObject.h"\n',
    "Utilities/short.py": LICENCE.replace("//", "#") + "def answer():\n    return 42\n",
    "Utilities/demo.sh": "#!/bin/sh\n" + LICENCE.replace("//", "#"),
}

SKIPPED = 125


class StyleChecks(unittest.TestCase):
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

    def run_check(self, script, *arguments):
        """Exit status and output of one check on the tree."""
        command = [sys.executable, os.path.join(HERE, script), *arguments, self.tree.name]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode == SKIPPED:
            self.skipTest(result.stdout)
        return result.returncode, result.stdout + result.stderr

    def check_notices(self, check, path, text, expected):
        """The check passes before `path` holds `text`, and names the fault after."""
        status, output = self.run_check(*check)
        self.assertEqual(status, 0, output)
        self.write(path, text)
        status, output = self.run_check(*check)
        self.assertEqual(status, 1, output)
        self.assertIn(expected, output)

    def test_engine_without_vtk(self):
        self.check_notices(
            ["check_layering.py"],
            "CUDA/Bad.cpp",
            "#include <vtkPolyData.h>\n",
            "CUDA/Bad.cpp: the engine includes vtkPolyData.h of VTK",
        )

    def test_engine_below_filters(self):
        self.write("Filters/PolyDataBridge.h", LICENCE)
        self.check_notices(
            ["check_layering.py"],
            "CUDA/Bad.cpp",
            '#include "../Filters/PolyDataBridge.h"\n',
            "CUDA includes ../Filters/PolyDataBridge.h of Filters",
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
            '#include "FlipOptions.h"\n',
            "Rendering includes FlipOptions.h of CUDA",
        )

    def test_shipped_code_without_tests(self):
        self.write("Testing/Meshes/GeneratedMeshes.h", LICENCE)
        self.check_notices(
            ["check_layering.py"],
            "Command/Bad.cxx",
            '#include "GeneratedMeshes.h"\n',
            "Command includes GeneratedMeshes.h of Testing",
        )

    def test_internal_header(self):
        self.check_notices(
            ["check_layering.py"],
            "Filters/Bad.h",
            '#include "EdgeMesh.h"\n',
            "EdgeMesh.h is internal to CUDA",
        )

    def test_leaking_door(self):
        self.check_notices(
            ["check_layering.py"],
            "CUDA/DelaunayFlip.h",
            '#include "EdgeMesh.h"\n',
            "CUDA/DelaunayFlip.h: a public header includes the internal EdgeMesh.h",
        )

    def test_format(self):
        self.check_notices(
            ["check_format.py"], "CUDA/Bad.cpp", "int  x ;\n", "CUDA/Bad.cpp: run clang-format"
        )

    def test_long_function(self):
        lines = "  f();\n" * 60
        for path, text in (
            ("CUDA/Bad.cpp", f"void Long()\n{{\n{lines}}}\n"),
            ("Testing/Core/TestBad.cpp", f"TEST(Long, OfGoogleTest)\n{{\n{lines}}}\n"),
            ("Utilities/bad.py", "def long():\n" + "    f()\n" * 60),
        ):
            with self.subTest(path):
                short = "".join(f"void f{i}()\n{{\n}}\n" for i in range(20))
                self.write("CUDA/Short.cpp", short)
                self.check_notices(["check_functions.py"], path, text, f"{path}:1 ")
                os.remove(os.path.join(self.tree.name, path))

    def test_functions_on_average(self):
        text = "".join(f"void f{i}()\n{{\n" + "  g();\n" * 40 + "}\n" for i in range(9))
        self.check_notices(["check_functions.py"], "CUDA/Bad.cpp", text, "the median is 43")

    def test_licence(self):
        for path in ("CUDA/Bad.h", "CMake/Bad.cmake", "Utilities/bad.py", "Utilities/bad.sh"):
            with self.subTest(path):
                self.check_notices(["check_files.py", "licences"], path, "\n", path)
                os.remove(os.path.join(self.tree.name, path))

    def test_size(self):
        path, text = "Testing/Data/big.vtp", "x" * 1_000_001
        self.check_notices(["check_files.py", "sizes"], path, text, f"{path}: 1000001 bytes")

    def test_words(self):
        for word in ("std::exit(1);", "abort();", "std::cout << 1;", 'std::printf("x");'):
            with self.subTest(word):
                text = f"/* one\n two */ void F()\n{{ {word} }}\n"
                for path in ("Filters/Bad.cxx", "Rendering/Bad.cxx"):
                    self.check_notices(["check_files.py", "words"], path, text, f"{path}:3: ")
                    os.remove(os.path.join(self.tree.name, path))


if __name__ == "__main__":
    unittest.main()
