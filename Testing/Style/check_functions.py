#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_functions.py ROOT

Functions are short: a median under 10 lines, nine in ten under 35, none over 60, counted from the
line of the name to the closing brace. Skipped without universal-ctags.
"""

import json
import os
import shutil
import statistics
import subprocess
import sys

from source_tree import CPP_SUFFIXES, finish, list_files, skip

MEDIAN_BELOW, NINE_IN_TEN_BELOW, NONE_OVER = 10, 35, 60

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
    """Problems with the lengths of all functions together, then with single ones."""
    if not functions:
        return ["ctags found no function at all"]
    lengths = sorted(lines for lines, _ in functions)
    median = statistics.median(lengths)
    tenth_longest = lengths[int(0.9 * (len(lengths) - 1))]
    print(f"{len(lengths)} functions: median {median} lines, nine in ten at most {tenth_longest}")
    problems = []
    if median >= MEDIAN_BELOW:
        problems.append(f"the median is {median} lines, not under {MEDIAN_BELOW}")
    if tenth_longest >= NINE_IN_TEN_BELOW:
        problems.append(f"nine in ten reach {tenth_longest} lines, not under {NINE_IN_TEN_BELOW}")
    problems += [f"{where}: {lines} lines" for lines, where in functions if lines > NONE_OVER]
    return problems


def main():
    root = sys.argv[1]
    require_ctags()
    paths = [path for path in list_files(root) if path.endswith(CPP_SUFFIXES + (".py",))]
    finish("functions", judge(find_functions(os.path.abspath(root), paths)))


if __name__ == "__main__":
    main()
