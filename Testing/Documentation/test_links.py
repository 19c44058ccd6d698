# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Links between the pages lead somewhere, and every page and picture is reached by one. The messages
that the pages explain are those of the sources."""
import glob
import json
import os
import re
import unittest

from pages import FENCE, ROOT, anchors, links, list_pages, read

TOCTREE = re.compile(r"^```\{toctree\}\n(?:^:[^\n]*\n)*(.*?)^```$", re.DOTALL | re.MULTILINE)


def resolve(page, target):
    """The path, relative to ROOT, and the anchor that a link of a page names."""
    path, _, anchor = target.partition("#")
    return os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page, anchor


class Links(unittest.TestCase):

    def test_targets(self):
        for page in list_pages():
            for target in links(page):
                if "://" in target:
                    continue
                with self.subTest(f"{page}: {target}"):
                    path, anchor = resolve(page, target)
                    self.assertTrue(os.path.exists(os.path.join(ROOT, path)), "no such file")
                    if anchor:
                        self.assertIn(anchor, anchors(path))

    def test_pages_of_the_site(self):
        listed = {f"Documentation/{name}.md" for part in TOCTREE.findall(read("Documentation/index.md"))
                  for name in part.split()}
        pages = {page for page in list_pages() if page.startswith("Documentation/")}
        self.assertEqual(listed | {"Documentation/index.md"}, pages)

    def test_pictures(self):
        used = {resolve(page, target)[0] for page in list_pages() for target in links(page)}
        for folder, _, names in os.walk(f"{ROOT}/Documentation/images"):
            for name in names:
                self.assertIn(os.path.relpath(os.path.join(folder, name), ROOT), used)


class Names(unittest.TestCase):

    def test_names_of_the_method(self):
        """Types, functions and files that the page names exist."""
        paths = [path for folder in ("Engine", "CUDA", "Filters", "Rendering")
                 for path in glob.glob(f"{ROOT}/{folder}/**/*.*", recursive=True)]
        known = {os.path.basename(path) for path in paths}
        known |= set(re.findall(r"\w+", "\n".join(read(path) for path in paths)))
        names = set(re.findall(r"`((?:[A-Z]\w*[a-z]\w*|\w+(?=\.))(?:\.(?:h|cpp|cxx|cuh|cu))?)`",
                               read("Documentation/method.md")))
        self.assertGreater(len(names), 30)
        self.assertEqual(set(), names - known)

    def test_public_headers(self):
        listed = re.search(r"public headers are (.*?)\. Everything", read("CONTRIBUTING.md"), re.DOTALL)
        headers = [os.path.basename(path) for path in glob.glob(f"{ROOT}/Engine/*.h")]
        self.assertEqual(sorted(headers), sorted(re.findall(r"`(\w+\.h)`", listed.group(1))))


class Pictures(unittest.TestCase):

    def test_one_palette(self):
        """Angles have the same colours in pictures, live views, PyVista and ParaView."""
        rows = json.loads(read("Plugin/AngleColors.json"))["RGBPoints"]
        colors = [[round(part, 2) for part in rows[i + 1:i + 4]] for i in range(0, len(rows), 4)]
        self.assertEqual([12 * i for i in range(6)], rows[::4])
        for path in "Utilities/draw_demo.py", "Python/delaunayflip/pyvista.py":
            named = re.search(r'\["(#\w+)"(?:, "#\w+"){5}\]', read(path)).group(0)
            self.assertEqual(colors, [[round(int(color[i:i + 2], 16) / 255, 2) for i in (0, 2, 4)]
                                      for color in re.findall(r"#(\w{6})", named)])
        table = re.search(r"angleColors\[\] = \{([^}]*)\}", read("Rendering/MapperColors.h"))
        self.assertEqual(sum(colors, []), [float(part) for part in table.group(1).split(",")])


class Text(unittest.TestCase):

    def test_no_line_is_a_comment(self):
        """The site leaves out lines that begin with %."""
        for page in list_pages():
            with self.subTest(page):
                self.assertNotRegex(FENCE.sub("", read(page)), r"(?m)^ *%")


class Messages(unittest.TestCase):

    def test_messages(self):
        """The terms of the list in faq.md; "..." stands for anything."""
        folders = ("Engine", "CUDA", "Filters", "FiltersParallel", "Command", "Python")
        literals = "".join(read(path) for folder in folders
                           for path in glob.glob(f"{ROOT}/{folder}/**/*.*", recursive=True)
                           if not path.endswith(".pyc"))
        literals = re.sub(r'"\s*"', "", literals)  # adjacent strings are one
        terms = re.findall(r"^(`[^\n]*`)\n: ", read("Documentation/faq.md"), re.MULTILINE)
        self.assertGreater(len(terms), 10)
        for message in (text for term in terms for text in re.findall("`([^`]*)`", term)):
            for part in message.split(" ... "):
                with self.subTest(message):
                    self.assertTrue(part in literals, "no message of the sources")
