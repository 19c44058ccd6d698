#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_files.py CHECK ROOT

licences: every source file begins with the two SPDX lines (after a #! line, if any).
sizes: no file of the repository is over 1 MB.
words: the libraries never print to standard output and never end the process; the engine calls no
function with last bits that depend on the system; the libraries have one word for each idea
(CONTRIBUTING.md, Words). No comment of C++ begins with Of, As and their like, and no file has words
that make sentences hard to read.
markdown: lines of text are under 100 columns. Tables, pictures, code and the targets of links may
be wider.
release: the citation and the changelog have the version that CMakeLists.txt has.
format: C++ files are formatted as by clang-format 14 with the project's .clang-format. Other
versions differ in details, so without this one the check is skipped.
functions: no function is longer than 80 lines, counted from the line of the name to the closing
brace. Skipped without universal-ctags.
"""

import glob
import json
import os
import re
import shutil
import subprocess
import sys

SKIPPED = 125  # CTest's SKIP_RETURN_CODE in this project
CPP_SUFFIXES = (".h", ".c", ".cpp", ".cxx", ".cuh", ".cu")

LICENCE = [
    "SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers",
    "SPDX-License-Identifier: BSD-3-Clause",
]
LICENSED_SUFFIXES = CPP_SUFFIXES + (".py", ".sh", ".cmake")

LARGEST = 1_000_000  # bytes
LONGEST = 80  # lines of a function
WIDEST = 99  # columns of a page
FORMAT_VERSION = "14"

LIBRARY_FOLDERS = (
    "CInterface/", "CUDA/", "Engine/", "Filters/", "FiltersParallel/", "Plugin/", "Rendering/")
FORBIDDEN = re.compile(
    r"\b(?:_?exit|quick_exit|abort|terminate|printf|puts)\s*\(|\bstd::cout\b|\bstdout\b")
# Other systems have other last bits. These may be used where no mesh depends on them.
SYSTEM_MATH = re.compile(
    r"\b(?:sin|cos|tan|asin|acos|atan|atan2|pow|exp|exp2|log|log2|log10|cbrt|hypot|fma)\s*\(")
MAY_USE_SYSTEM_MATH = (
    "Engine/Geometry/PortableMath.cpp", "Engine/Geometry/SurfaceAngles.h", "Engine/MeshAudit.cpp",
    "Engine/Mesh/SmallestAngle.h", "Engine/Mesh/RunProgress.h")
COMMENT_OR_STRING = re.compile(
    r"""//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])'|"(?:\\.|[^"\\\n])*\"""", re.DOTALL)
# Words for what has another name already, in the libraries.
TWINS = {
    re.compile(pattern, re.IGNORECASE): word for pattern, word in (
        (r"phase", "pass"),
        (r"\bsteps? [1-6]\b", "pass"),
        (r"cloud", "points"),
        (r"violations?\b", "bad edge"),
        (r"\b(?:left|right)[- ]turns?\b|\bturns? (?:to the )?(?:left|right)\b", "orientation"),
        (r"\bedges? (?:(?:that )?(?:is|are) )?held\b|\bheld edge", "fixed"),
        (r"\b(?:detections?|iterations?) (?:rounds?|phases?)\b", "iteration"),
        (r"\bparts? of (?:a|the|each|every|all) (?:GPU|device)s?\b|\b(?:GPU|device)'?s'? parts?\b",
         "share"),
    )}
# These make sentences that have to be read twice, in any file of words.
AVOIDED = re.compile(r"\bwho[s]e\b|\bwhat to tell of\b|\bstayed itself\b", re.IGNORECASE)
OPENING = re.compile(r"(?://[/!]?<?|/\*\*?<?|^ *\*) +((?:And|As|Nor|Of|Or|So that|The same)\b)")
AVOIDED_IN = LICENSED_SUFFIXES + (".cff", ".md", ".module", ".svg", ".txt", ".xml")
MARKDOWN_CODE = re.compile(r"^```.*?^```|(?:\A|(?<=\n\n))(?: {4}[^\n]*\n)+", re.DOTALL | re.MULTILINE)
LINK_TARGET = re.compile(r"\]\([^)]*\)")

FORMATTER = [f"clang-format-{FORMAT_VERSION}", "--style=file", "--dry-run", "--Werror"]
CTAGS = [
    "ctags", "--options=NONE", "--languages=C++,Python", "--langmap=C++:+.h.cuh.cu", "--kinds-C++=f",
    "--kinds-Python=fm", "--fields=+ne", "--output-format=json", "-f", "-", "-L", "-"]


def list_files(root, suffixes=""):
    """Paths, relative to `root`, of the project's files: what git tracks or would track."""
    command = ["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    paths = run.stdout.split("\0")
    if run.returncode != 0:  # not in git, as in an unpacked archive
        paths = [os.path.relpath(path, root) for path in glob.glob(f"{root}/**", recursive=True)]
        paths = [path for path in paths if not re.match("build|.*-output/|.*__pycache__", path)]
    return sorted(path for path in paths
                  if path.endswith(suffixes) and os.path.isfile(os.path.join(root, path)))


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def finish(what, problems):
    """Prints the problems, one per line, and ends the process: 1 with any, 0 with none."""
    for problem in problems:
        print(problem)
    print(f"{what}: {len(problems)} problems")
    sys.exit(1 if problems else 0)


def require(program):
    """Skips the check without the program."""
    if not shutil.which(program):
        print(f"skipped: needs {program}")
        sys.exit(SKIPPED)


def check_licences(root):
    for path in list_files(root, LICENSED_SUFFIXES):
        lines = read(root, path).splitlines()
        start = 1 if lines and lines[0].startswith("#!") else 0
        if [line.lstrip("/#* ") for line in lines[start : start + 2]] != LICENCE:
            yield f"{path}: does not begin with the two SPDX lines"


def check_sizes(root):
    for path in list_files(root):
        size = os.path.getsize(os.path.join(root, path))
        if size > LARGEST:
            yield f"{path}: {size} bytes"


def list_lines(root, path, left_out):
    """(where, line) of the file, without what matches `left_out`."""
    text = left_out.sub(lambda match: "\n" * match.group().count("\n"), read(root, path))
    for number, line in enumerate(text.splitlines(), 1):
        yield f"{path}:{number}", line


def check_words(root):
    nothing = re.compile(r"(?!)")
    for path in list_files(root, CPP_SUFFIXES):
        if path.startswith(LIBRARY_FOLDERS):
            for where, line in list_lines(root, path, COMMENT_OR_STRING):
                yield from (f"{where}: {word}" for word in FORBIDDEN.findall(line))
                if path.startswith(("CUDA/", "Engine/")) and path not in MAY_USE_SYSTEM_MATH:
                    yield from (f"{where}: {word}: its bits depend on the system; see PortableMath.h"
                                for word in SYSTEM_MATH.findall(line))
            for where, line in list_lines(root, path, nothing):
                yield from (f"{where}: {match.group().lower()}: say {word}" for twin, word in TWINS.items()
                            for match in twin.finditer(line))
    for path in list_files(root, AVOIDED_IN):
        for where, line in list_lines(root, path, nothing):
            yield from (f"{where}: {phrase}: make two sentences" for phrase in AVOIDED.findall(line))
            if path.endswith(CPP_SUFFIXES):
                yield from (f"{where}: {word}: begin with a subject" for word in OPENING.findall(line))


def check_markdown(root):
    for path in list_files(root, ".md"):
        for where, line in list_lines(root, path, MARKDOWN_CODE):
            columns = len(LINK_TARGET.sub("]", line))
            if columns > WIDEST and not line.startswith(("|", "![")):
                yield f"{where}: {columns} columns"


def check_release(root):
    version, cited, newest = (
        re.search(pattern, read(root, path), re.MULTILINE).group(1) for path, pattern in (
            ("CMakeLists.txt", r"^project\(\w+ VERSION ([\d.]+)"), ("CITATION.cff", r"^version: (\S+)"),
            ("CHANGELOG.md", r"^## \[(\d[^]]*)\] - ")))
    for path, found in (("CITATION.cff", cited), ("CHANGELOG.md", newest)):
        if found != version:
            yield f"{path}: version {found}, but CMakeLists.txt has {version}"


def check_format(root):
    require(FORMATTER[0])
    run = subprocess.run([*FORMATTER, *list_files(root, CPP_SUFFIXES)], capture_output=True, text=True,
                         cwd=root, check=False)
    for path in sorted(set(re.findall(r"^(\S+):\d+:\d+: error:", run.stderr, re.MULTILINE))):
        yield f"{path}: run clang-format -i on it"
    if run.returncode != 0 and "error:" not in run.stderr:
        yield run.stderr


def check_functions(root):
    require("ctags")
    listing = subprocess.run(CTAGS, input="\n".join(list_files(root, CPP_SUFFIXES + (".py",))),
                             capture_output=True, text=True, cwd=root, check=True).stdout
    tags = [json.loads(line) for line in listing.splitlines()]
    if not tags:
        yield "ctags found no function at all"
    for tag in tags:
        lines = tag.get("end", 0) - tag["line"] + 1
        if lines > LONGEST:
            yield f"{tag['path']}:{tag['line']} {tag['name']}: {lines} lines"


if __name__ == "__main__":
    finish(sys.argv[1], list(globals()[f"check_{sys.argv[1]}"](sys.argv[2])))
