# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The README's snippets work. Those in CMake and C++ are built by test_package.py."""
import os
import subprocess
import sys
import tempfile
import unittest

from readme import ROOT, read, snippets


class Python(unittest.TestCase):

    def test_the_package_is_where_it_says(self):
        build, package = os.environ["DELAUNAYFLIP_BUILD"], os.environ["PYTHONPATH"]
        self.assertIn(f"`PYTHONPATH=build/{os.path.relpath(package, build)}`", read("README.md"))

    def test_snippets(self):
        """One program; its window closes at the end of the run."""
        close = 'view.AddObserver("EndEvent", lambda *_: interactor.TerminateApp())\n'
        faster = "view.SetFrameInterval(1)\n"
        program = "\n".join(snippets("python"))
        self.assertEqual(program.count("view.Run()\n"), 1)
        program = program.replace("view.Run()\n", close + faster + "view.Run()\n")
        program += "print(view.GetConverged(), iterations.GetNumberOfRows())\n"
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "demo-output"))
            subprocess.run(
                [sys.executable, f"{ROOT}/Utilities/make_terrain.py", "demo-output/before.vtp",
                 "--points", "1100"], cwd=folder, check=True)
            run = subprocess.run([sys.executable, "-c", program], cwd=folder, timeout=120,
                                 capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"^\d{4} flips, 0 bad edges left\n1 flips, 0 bad edges left\nTrue \d+\n$")


class Engine(unittest.TestCase):

    def test_snippet_is_the_one_of_the_example(self):
        example = " ".join(read("Examples/Cxx/FlipArrays.cpp").split())
        (snippet,) = [text for text in snippets("cpp") if "delaunayflip::" in text]
        for part in snippet.split("\n\n"):
            self.assertTrue(" ".join(part.split()) in example, f"not in the example:\n{part}")


if __name__ == "__main__":
    unittest.main()
