# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The site can be built without a warning, and its reference says what the comments of the sources say,
in their order."""
import glob
import html
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from pages import ROOT, read

TOOLS = [name for name in ("sphinx", "myst_parser", "breathe")
         if importlib.util.find_spec(name) is None]
if not shutil.which("doxygen"):
    TOOLS.append("doxygen")


# Comments behind members, over one line or more.
BEHIND = re.compile(r"///<[^\n]*(?:\n +///<[^\n]*)*")


def strip(page):
    """The text of a page in HTML."""
    return html.unescape(re.sub(r"<[^>]*>", "", page))


def letters(text):
    return re.sub(r"\W", "", text)


@unittest.skipIf(TOOLS, f"absent: {', '.join(TOOLS)} (Debian: Utilities/install-packages.sh docs)")
class Site(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.told = subprocess.run(
            [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html",
             f"{ROOT}/Documentation", folder.name],
            env={**os.environ, "DELAUNAYFLIP_DOXYGEN": os.path.join(folder.name, "doxygen")},
            capture_output=True, text=True, check=False)
        cls.reference = {}
        for path in glob.glob(f"{folder.name}/reference/*.html"):
            with open(path, encoding="utf-8") as file:
                cls.reference[os.path.basename(path)] = file.read()

    def read(self, name):
        return strip(self.reference[name])

    def test_no_warnings(self):
        self.assertEqual(self.told.returncode, 0, self.told.stderr)

    def test_comments_are_whole(self):
        """Doxygen may swap or drop lines of a comment behind a member."""
        text, found = letters("".join(map(self.read, self.reference))), 0
        for header in re.findall(r"[\w/]+\.h", read("Documentation/Doxyfile")):
            for comment in BEHIND.findall(read(header)):
                lines = [letters(line) for line in re.split(r"\n? *///<", comment)]
                if any(len(line) > 8 and line in text for line in lines):  # of a public member
                    found += 1
                    with self.subTest(header, comment=comment):
                        self.assertTrue("".join(lines) in text, "torn")
        self.assertGreater(found, 50)

    def test_attributes_are_whole(self):
        """Sphinx takes what is before a colon in the comment of an attribute for its type."""
        self.assertNotRegex(self.read("python.html"), r'Type:\s+[^\n]*["“]')

    def test_paragraphs_are_whole(self):
        """A list written without dashes is torn where its lines end."""
        for name in ("vtk.html", "c.html", "cpp.html"):
            paragraphs = map(strip, re.findall(r"<p>(.*?)</p>", self.reference[name], re.DOTALL))
            torn = [one for one in paragraphs if re.match(r'[a-z]{2,}[," ]', one) and one.endswith(".")]
            self.assertEqual(torn, [], name)
