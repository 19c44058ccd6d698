# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for the style checks: the files of the project, and how a check ends."""

import os
import subprocess
import sys

SKIPPED = 125  # CTest's SKIP_RETURN_CODE in this project

CPP_SUFFIXES = (".h", ".c", ".cpp", ".cxx", ".cuh", ".cu")

UNTRACKED = (".git", "demo-output", "paper-output", "__pycache__")


def list_files(root):
    """Paths, relative to `root`, of the project's files: what git tracks or would track."""
    command = ["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    try:
        output = subprocess.run(command, capture_output=True, check=True).stdout
        paths = [path for path in output.decode().split("\0") if path]
    except (OSError, subprocess.CalledProcessError):
        paths = walk(root)
    return sorted(path for path in paths if os.path.isfile(os.path.join(root, path)))


def walk(root):
    """The same without git, e.g. in an unpacked archive: everything except build folders."""
    for folder, subfolders, names in os.walk(root):
        subfolders[:] = [name for name in subfolders if not is_built(name)]
        for name in names:
            yield os.path.relpath(os.path.join(folder, name), root)


def is_built(folder_name):
    return folder_name.startswith("build") or folder_name in UNTRACKED


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def finish(what, problems):
    """Prints the problems, one per line, and ends the process: 1 with any, 0 with none."""
    for problem in problems:
        print(problem)
    print(f"{what}: {len(problems)} problems")
    sys.exit(1 if problems else 0)


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)
