#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_files.py licences|sizes|words ROOT

licences: every source file begins with the two SPDX lines (after a #! line, if any).
sizes: no file of the repository is over 1 MB.
words: the libraries never print to standard output and never end the process.
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

LIBRARY_FOLDERS = ("CUDA/", "Engine/", "Filters/", "Plugin/", "Rendering/")
FORBIDDEN = re.compile(
    r"\b(?:_?exit|quick_exit|abort|terminate|printf|puts)\s*\(|\bstd::cout\b|\bstdout\b"
)
COMMENT_OR_STRING = re.compile(
    r"""//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])'|"(?:\\.|[^"\\\n])*\"""", re.DOTALL
)


def check_licences(root):
    for path in list_files(root):
        if not path.endswith(LICENSED_SUFFIXES):
            continue
        lines = read(root, path).splitlines()
        start = 1 if lines and lines[0].startswith("#!") else 0
        head = [line.lstrip("/# ") for line in lines[start : start + 2]]
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
        for number, line in enumerate(code_only(read(root, path)).splitlines(), 1):
            for word in FORBIDDEN.findall(line):
                yield f"{path}:{number}: {word}"


def code_only(text):
    """C++ text with comments and strings blanked and its line breaks kept."""
    return COMMENT_OR_STRING.sub(lambda match: "\n" * match.group().count("\n"), text)


CHECKS = {"licences": check_licences, "sizes": check_sizes, "words": check_words}


def main():
    name, root = sys.argv[1:3]
    finish(name, list(CHECKS[name](root)))


if __name__ == "__main__":
    main()
