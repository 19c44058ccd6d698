#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_files.py licences|sizes|words|markdown|release ROOT

licences: every source file begins with the two SPDX lines (after a #! line, if any).
sizes: no file of the repository is over 1 MB.
words: the libraries never print to standard output and never end the process.
markdown: lines of text are under 100 columns. Tables, pictures, code and the targets of links may
be wider.
release: the citation and the changelog have the version that CMakeLists.txt has.
"""

import os
import re
import sys

from source_tree import CPP_SUFFIXES, finish, list_files, read

LICENCE = (
    "SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers",
    "SPDX-License-Identifier: BSD-3-Clause",
)
LICENSED_SUFFIXES = CPP_SUFFIXES + (".py", ".sh", ".cmake")

LARGEST = 1_000_000  # bytes

LIBRARY_FOLDERS = ("CInterface/", "CUDA/", "Engine/", "Filters/", "Plugin/", "Rendering/")
FORBIDDEN = re.compile(
    r"\b(?:_?exit|quick_exit|abort|terminate|printf|puts)\s*\(|\bstd::cout\b|\bstdout\b"
)
COMMENT_OR_STRING = re.compile(
    r"""//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])'|"(?:\\.|[^"\\\n])*\"""", re.DOTALL
)

MARKDOWN_COLUMNS = 100
MARKDOWN_CODE = re.compile(r"^```.*?^```|(?:\A|(?<=\n\n))(?: {4}[^\n]*\n)+", re.DOTALL | re.MULTILINE)
LINK_TARGET = re.compile(r"\]\([^)]*\)")


def check_licences(root):
    for path in list_files(root):
        if not path.endswith(LICENSED_SUFFIXES):
            continue
        lines = read(root, path).splitlines()
        start = 1 if lines and lines[0].startswith("#!") else 0
        head = [line.lstrip("/#* ") for line in lines[start : start + 2]]
        if tuple(head) != LICENCE:
            yield f"{path}: does not begin with the two SPDX lines"


def check_sizes(root):
    for path in list_files(root):
        size = os.path.getsize(os.path.join(root, path))
        if size > LARGEST:
            yield f"{path}: {size} bytes"


def check_words(root):
    for path in list_files(root):
        if not path.startswith(LIBRARY_FOLDERS) or not path.endswith(CPP_SUFFIXES):
            continue
        text = blank(COMMENT_OR_STRING, read(root, path))
        for number, line in enumerate(text.splitlines(), 1):
            for word in FORBIDDEN.findall(line):
                yield f"{path}:{number}: {word}"


def check_markdown(root):
    for path in list_files(root):
        if not path.endswith(".md"):
            continue
        text = blank(MARKDOWN_CODE, read(root, path))
        for number, line in enumerate(text.splitlines(), 1):
            columns = len(LINK_TARGET.sub("]", line))
            if columns >= MARKDOWN_COLUMNS and not line.startswith(("|", "![")):
                yield f"{path}:{number}: {columns} columns"


def check_release(root):
    version = find(r"^project\(\w+ VERSION ([\d.]+)", read(root, "CMakeLists.txt"))
    cited = find(r"^version: (\S+)", read(root, "CITATION.cff"))
    if cited != version:
        yield f"CITATION.cff: version {cited}, but CMakeLists.txt has {version}"
    newest = find(r"^## \[(\d[^]]*)\] - ", read(root, "CHANGELOG.md"))
    if newest != version:
        yield f"CHANGELOG.md: newest version {newest}, but CMakeLists.txt has {version}"


def find(pattern, text):
    """The group of the first match; None without one."""
    match = re.search(pattern, text, re.MULTILINE)
    return match and match.group(1)


def blank(pattern, text):
    """The text without the matches, but with all line breaks."""
    return pattern.sub(lambda match: "\n" * match.group().count("\n"), text)


CHECKS = {
    "licences": check_licences,
    "sizes": check_sizes,
    "words": check_words,
    "markdown": check_markdown,
    "release": check_release,
}


def main():
    name, root = sys.argv[1:3]
    finish(name, list(CHECKS[name](root)))


if __name__ == "__main__":
    main()
