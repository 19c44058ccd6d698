# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The pages for readers: the README, those in Documentation/, and what they contain."""
import glob
import os
import re

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
FENCE = re.compile(r"^```([\w{}-]*)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?\)")


def list_pages():
    """Paths relative to ROOT."""
    paths = glob.glob(f"{ROOT}/*.md") + glob.glob(f"{ROOT}/Documentation/**/*.md", recursive=True)
    return sorted(os.path.relpath(path, ROOT) for path in paths)


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def blocks(page):
    """(language, text) of each code block of a page, in order."""
    return FENCE.findall(read(page))


def snippets(language, page):
    """The code blocks of a page in a language, in order."""
    return [text for name, text in blocks(page) if name == language]


def links(page):
    """The targets of the links and pictures of a page."""
    return LINK.findall(FENCE.sub("", read(page)))


def anchors(page):
    """The names by which a link can end in #name: those that GitHub and MyST give to headings."""
    titles = (re.sub(r"`|\[([^\]]*)\]\([^)]*\)", r"\1", title)
              for title in HEADING.findall(FENCE.sub("", read(page))))
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}
