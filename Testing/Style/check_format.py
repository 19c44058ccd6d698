#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_format.py ROOT

C++ files are formatted as by clang-format 14 with the project's .clang-format. Skipped without that
version, since others differ in details.
"""

import os
import re
import shutil
import subprocess
import sys

from source_tree import CPP_SUFFIXES, finish, list_files, skip

MAJOR_VERSION = "14"


def find_clang_format():
    """The program's path; skips the check if there is none of the right version."""
    for name in (f"clang-format-{MAJOR_VERSION}", "clang-format"):
        program = shutil.which(name)
        if program and major_version(program) == MAJOR_VERSION:
            return program
    return skip(f"needs clang-format {MAJOR_VERSION}")


def major_version(program):
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    return re.search(r"version (\d+)", version.stdout).group(1)


def is_formatted(program, path):
    command = [program, "--style=file", "--dry-run", "--Werror", path]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def main():
    root = sys.argv[1]
    program = find_clang_format()
    problems = [
        f"{path}: run clang-format -i on it"
        for path in list_files(root)
        if path.endswith(CPP_SUFFIXES) and not is_formatted(program, os.path.join(root, path))
    ]
    finish("format", problems)


if __name__ == "__main__":
    main()
