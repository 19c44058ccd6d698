# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The examples of the pages work: all blocks of a page in a language, one after the other, in a
folder with the meshes of Utilities/make_examples.py. Blocks named console are not run. Those in
CMake and C++ are built by Testing/Package/test_package.py.

DELAUNAYFLIP_BUILD in the environment is the build.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from pages import ROOT, blocks, list_pages, read, snippets

BIN = os.path.join(os.environ["DELAUNAYFLIP_BUILD"], "bin")
TIME = re.compile(r"^(time|wrote) .*\n", re.MULTILINE)
ARGUMENT = re.compile(r"^ +((?:-\w, *)?-?-?\w\S*(?: [A-Z{]\S*)?)(?:\s{2,}|(?<=\}) )"
                      r"(\S.*(?:\n {20,}\S.*)*)$", re.MULTILINE)
NUMBER = re.compile(r"\d[\d,]*\.?\d*")

# A live view is closed at the end of its run.
RUN = "view.Run()\n"
FAST_RUN = ('view.AddObserver("EndEvent", lambda *_: interactor.TerminateApp())\n'
            "view.SetFrameInterval(1)\n" + RUN)


class Examples(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.meshes = tempfile.TemporaryDirectory()
        subprocess.run([sys.executable, f"{ROOT}/Utilities/make_examples.py", cls.meshes.name],
                       stdout=subprocess.DEVNULL, check=True)

    @classmethod
    def tearDownClass(cls):
        cls.meshes.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.path.join(folder.name, "work")
        shutil.copytree(self.meshes.name, self.folder)

    def run_in_folder(self, *command):
        environment = {**os.environ, "PATH": BIN + os.pathsep + os.environ["PATH"]}
        run = subprocess.run(command, cwd=self.folder, env=environment, timeout=120,
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout


class Shell(Examples):

    def test_pages(self):
        """What a block prints is as in the block of text that follows."""
        for page in list_pages():
            printed = ""
            for language, text in blocks(page):
                with self.subTest(page, block=text):
                    if language == "sh":
                        printed = self.run_in_folder("bash", "-ec", text)
                    elif language == "text" and printed:
                        self.compare(TIME.sub("", text), TIME.sub("", printed))

    def compare(self, expected, printed):
        """Expects equal words and similar counts: another NumPy makes slightly other meshes."""
        self.assertEqual(NUMBER.sub("N", expected), NUMBER.sub("N", printed))
        for one, other in zip(NUMBER.findall(expected), NUMBER.findall(printed)):
            one, other = float(one.replace(",", "")), float(other.replace(",", ""))
            if one >= 500:
                self.assertLess(abs(one - other), 0.05 * one, printed)

    def test_help(self):
        """The table of the page on the command, from which its man page is made, is what --help prints;
        versions of CLI11 differ in the layout."""
        printed = self.run_in_folder("delaunay-flip", "--help")
        rows = ["| `{}` | {} |".format(name.replace(" --", "--"), " ".join(text.split()))
                for name, text in ARGUMENT.findall(printed)]
        page = read("Documentation/reference/command.md").splitlines()
        self.assertEqual([line for line in page if line.startswith("| `")], rows, "\n".join(rows))

    def test_man_page_and_completion(self):
        build = os.environ["DELAUNAYFLIP_BUILD"]
        with open(os.path.join(build, "delaunay-flip.1"), encoding="utf-8") as file:
            self.assertIn("\n.TP\n.B \\-\\-report FILE\nWrite a summary of the run (JSON)\n", file.read())
        for words, choices in (("--geom", "--geometry"), ("--geometry pl", "planar planar-xy"),
                               ("--constraints ro", "road.vtk"), ("pla", "plate.vtk")):
            *before, word = ("delaunay-flip " + words).split()
            printed = self.run_in_folder("bash", "-c", f"""
                source {ROOT}/Command/delaunay-flip.bash
                COMP_WORDS=({' '.join(before)} {word}) COMP_CWORD={len(before)}
                _delaunay_flip delaunay-flip {word} {before[-1]}
                echo "${{COMPREPLY[@]}}" """)
            self.assertEqual(printed.split(), choices.split())


class Python(Examples):

    def test_pages(self):
        for page in list_pages():
            program = "\n".join(snippets("python", page)).replace(RUN, FAST_RUN)
            if program:
                with self.subTest(page):
                    self.run_in_folder(sys.executable, "-c", program)

    def test_the_package_is_where_they_say(self):
        build, package = os.environ["DELAUNAYFLIP_BUILD"], os.environ["PYTHONPATH"]
        place = f"`PYTHONPATH=build/{os.path.relpath(package, build)}`"
        for page in ("README.md", "Documentation/start/python.md"):
            self.assertIn(place, read(page))


class Engine(unittest.TestCase):

    def test_snippets_are_those_of_the_example(self):
        example = " ".join(read("Examples/Cxx/FlipArrays.cpp").split())
        found = [text for text in snippets("cpp", "Documentation/start/cpp.md")
                 if "delaunayflip::" in text]
        self.assertEqual(len(found), 2)
        for part in "\n\n".join(found).split("\n\n"):
            self.assertTrue(" ".join(part.split()) in example, f"not in the example:\n{part}")
