#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The style checks pass on a small clean tree, and each fails for the faults that are planted in it."""

import os
import subprocess
import sys
import tempfile
import unittest

import check_files

HERE = os.path.dirname(os.path.abspath(__file__))
LICENCE = "".join(f"// {line}\n" for line in check_files.LICENCE)
HASH_LICENCE = LICENCE.replace("//", "#")
WIDE = 30 * "wide "

CLEAN = {
    ".clang-format": "BasedOnStyle: Mozilla\n",
    "Engine/CMakeLists.txt": "set(delaunayflip_engine_headers # the public ones\n  FlipOptions.h)\n"
                             "set(delaunayflip_engine_rooms Geometry Mesh Flips Session)\n",
    "Engine/FlipOptions.h": LICENCE + "#include <vector>\n",
    "Engine/Mesh/EdgeMesh.h": LICENCE + '#include "FlipOptions.h"\n// printf("%d") prints\n',
    "Engine/Session/CallerMesh.h": LICENCE + '#include "EdgeMesh.h"\n#include "Team.cuh"\n',
    "CUDA/Team.cuh": LICENCE + '#include "EdgeMesh.h"\n',
    "Filters/vtkDelaunayFlip.cxx": LICENCE + '#include "FlipOptions.h"\n#include <vtkObject.h>\n',
    "Filters/vtkDelaunayFlip.h": LICENCE + '#include "FlipOptions.h"\n',
    "Filters/MeshBlocks.h": LICENCE + '#include "UpdateReport.h"\n',
    "Filters/UpdateReport.h": LICENCE + '#include "FlipOptions.h"\n',
    "Rendering/BufferFiller.h": LICENCE,
    "Testing/Core/EdgeMeshTest.cpp": LICENCE + '#include "EdgeMesh.h"\n#include "vtkObject.h"\n',
    "Testing/Meshes/GeneratedMeshes.h": LICENCE,
    "Utilities/short.py": "#!/usr/bin/env python3\n" + HASH_LICENCE + "def answer():\n    return 42\n",
    "Documentation/wide.md": f"[link]({WIDE})\n\n    {WIDE}\n\n```\n{WIDE}\n```\n\n| {WIDE} |\n",
    "CMakeLists.txt": "project(Clean VERSION 1.2.3)\n",
    "CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.3\n",
    "CHANGELOG.md": "## [Unreleased]\n\n## [1.2.3] - 2000-01-01\n\n## [1.2.2] - 1999-01-01\n",
}

# (file, its text, what the check says of it)
FAULTS = {
    "licences": [("CUDA/Bad.cu", "\n", "CUDA/Bad.cu: "), ("Utilities/bad.sh", "\n", "bad.sh: ")],
    "sizes": [("Testing/Data/big.vtp", "x" * 1_000_001, "big.vtp: 1000001 bytes")],
    "words": [("Engine/Mesh/Bad.h", "/* one\n two */ void F() { abort(); }\n", "Bad.h:2: abort("),
              ("FiltersParallel/Bad.cxx", "std::cout << 1;\n", "Bad.cxx:1: std::cout"),
              ("Engine/Flips/Bad.h", "// The second\n// phase flips.\n", "Bad.h:2: phase: say pass"),
              ("CUDA/Bad.cuh", "// Before step 4.\n", "Bad.cuh:1: step 4: say pass"),
              ("CUDA/Bad.cuh", "// Each on its GPU's part.\n", "Bad.cuh:1: gpu's part: say share"),
              ("Engine/Ask/Bad.h", "// A violation.\n", "Bad.h:1: violation: say bad edge"),
              ("Filters/Bad.h", "/// 1: a left turn.\n", "Bad.h:1: left turn: say orientation"),
              ("Engine/Mesh/Bad.h", "/// The held edges.\n", "Bad.h:1: held edge: say fixed"),
              ("CUDA/Bad.cu", "// In an iteration round.\n", "Bad.cu:1: iteration round: say iter"),
              ("Engine/Mesh/Bad.h", "int Count; ///< Of edges.\n", "Bad.h:1: Of: begin with"),
              ("Testing/Core/Bad.cpp", "/**\n * The same.\n */\n", "Bad.cpp:2: The same: begin"),
              ("Command/bad.sh", "# A mesh who" "se edges flip.\n", "bad.sh:1: who" "se: make two"),
              ("Engine/Flips/Bad.h", "double s = std::sin(x);\n", "Bad.h:1: sin(: its bits"),
              ("CUDA/Bad.cuh", "struct PointCloud;\n", "Bad.cuh:1: cloud: say points")],
    "markdown": [("README.md", f"Short.\n\n{WIDE}\n", "README.md:3: 150 columns")],
    "release": [("CITATION.cff", "version: 1.2.2\n", "CITATION.cff: version 1.2.2, "),
                ("CHANGELOG.md", "## [1.2.2] - 1999-01-01\n", "CHANGELOG.md: version 1.2.2, ")],
    "format": [("CUDA/Bad.cuh", "int  x ;\n", "CUDA/Bad.cuh: run clang-format")],
    "functions": [("CUDA/Bad.cu", "void Long()\n{\n" + "  f();\n" * 80 + "}\n", "Bad.cu:1 Long: 83"),
                  ("Utilities/bad.py", "def long():\n" + "    f()\n" * 80, "bad.py:1 long: 81")],
    "layering": [
        ("CUDA/Bad.cu", "#include <vtkPolyData.h>\n", "the engine includes vtkPolyData.h of VTK"),
        ("CUDA/Bad.cu", "#include <cuda_gl_interop.h>\n", "cuda_gl_interop.h of OpenGL"),
        ("Engine/Flips/Bad.h", "#include <sys/mman.h>\n", "sys/mman.h of an operating system"),
        ("CUDA/Bad.cuh", '#include "CallerMesh.h"\n', "CUDA includes CallerMesh.h of"),
        ("Engine/Flips/Bad.h", '#include "../CUDA/Team.cuh"\n', "includes ../CUDA/Team.cuh of CUDA"),
        ("Engine/Geometry/Bad.h", '#include "EdgeMesh.h"\n', "Geometry includes EdgeMesh.h of"),
        ("Engine/FlipOptions.h", '#include "EdgeMesh.h"\n', "public headers includes EdgeMesh.h"),
        ("Filters/Bad.h", '#include "EdgeMesh.h"\n', "Filters includes EdgeMesh.h of Engine/Mesh"),
        ("Filters/Bad.cxx", '# include "BufferFiller.h"\n', "Filters includes BufferFiller.h of"),
        ("Filters/UpdateReport.cxx", '#include "MeshBlocks.h"\n',
         "Filters/UpdateReport: includes Filters/MeshBlocks, which"),
        ("Command/Bad.cxx", '#include "GeneratedMeshes.h"\n', "GeneratedMeshes.h of Testing")],
}


class Checks(unittest.TestCase):

    NAMES = FAULTS.keys() - {"format"}

    def write(self, path, text):
        full = os.path.join(self.tree, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)

    def run_check(self, name):
        """Exit status and output of a check on the tree."""
        script = ["check_layering.py"] if name == "layering" else ["check_files.py", name]
        run = subprocess.run([sys.executable, *script, self.tree], cwd=HERE, capture_output=True,
                             text=True, check=False)
        if run.returncode == check_files.SKIPPED:
            self.skipTest(run.stdout)
        return run.returncode, run.stdout + run.stderr

    def test_each_can_fail(self):
        for name in self.NAMES:
            for path, text, message in FAULTS[name]:
                with (self.subTest(name, path=path, text=text[:40]),
                      tempfile.TemporaryDirectory(prefix="style tree ") as self.tree):
                    for clean, words in CLEAN.items():
                        self.write(clean, words)
                    self.assertEqual(self.run_check(name), (0, f"{name}: 0 problems\n"))
                    self.write(path, text)
                    status, output = self.run_check(name)
                    self.assertEqual(status, 1, output)
                    self.assertIn(message, output)


class FormatCheck(Checks):
    """Skipped without its tool."""

    NAMES = ("format",)


if __name__ == "__main__":
    unittest.main()
