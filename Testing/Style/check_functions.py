#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_functions.py ROOT

No function is longer than 80 lines, counted from the line of the name to the closing brace. Skipped
without universal-ctags.
"""

import json
import os
import shutil
import subprocess
import sys

from source_tree import CPP_SUFFIXES, finish, list_files, skip

MOST_LINES = 80

COMMAND = [
    "ctags",
    "--options=NONE",
    "--languages=C++,Python",
    "--langmap=C++:+.h.cuh.cu",
    "--kinds-C++=f",
    "--kinds-Python=fm",
    "--fields=+ne",
    "--output-format=json",
    "-f",
    "-",
    "-L",
    "-",
]


def require_ctags():
    program = shutil.which("ctags")
    if not program:
        skip("needs universal-ctags")
    command = [program, "--list-features"]
    features = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    if "json" not in features:
        skip("needs universal-ctags with JSON output")


def find_functions(root, paths):
    """(lines, where) of every function in the files."""
    listing = subprocess.run(
        COMMAND, input="\n".join(paths), capture_output=True, text=True, cwd=root, check=True
    )
    tags = [json.loads(line) for line in listing.stdout.splitlines()]
    return [
        (tag["end"] - tag["line"] + 1, f"{tag['path']}:{tag['line']} {tag['name']}")
        for tag in tags
        if "end" in tag
    ]


def judge(functions):
    """Problems with the lengths of functions."""
    if not functions:
        return ["ctags found no function at all"]
    return [f"{where}: {lines} lines" for lines, where in functions if lines > MOST_LINES]


def main():
    root = sys.argv[1]
    require_ctags()
    paths = [path for path in list_files(root) if path.endswith(CPP_SUFFIXES + (".py",))]
    finish("functions", judge(find_functions(os.path.abspath(root), paths)))


if __name__ == "__main__":
    main()
