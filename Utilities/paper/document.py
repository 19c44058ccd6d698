#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: document.py OUTPUT

Puts a reproduction into Documentation/: its numbers into notebook/paper.json, its plots into
images/paper/, and its report into notebook/paper.md, between the two marked lines.
"""

import json
import os
import re
import shutil
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
DOCUMENT = os.path.join(ROOT, "Documentation/notebook/paper.md")
NUMBERS = os.path.join(ROOT, "Documentation/notebook/paper.json")
IMAGES = os.path.join(ROOT, "Documentation/images/paper")
BEGIN, END = "<!-- begin of what document.py writes -->", "<!-- end of it -->"
OF_THE_DAY = ("commit", "system", "when")


def make_text(folder):
    """Makes the Markdown from the numbers, and draws the plots into `folder`."""
    import report
    from reproduce import Results

    with open(NUMBERS, encoding="utf-8") as file:
        numbers = json.load(file)
    return report.make(
        Results(folder, numbers["machine"], numbers["parts"]), "../images/paper").strip()


def read_document():
    """The text before, between and after the marked lines."""
    with open(DOCUMENT, encoding="utf-8") as file:
        before, rest = file.read().split(BEGIN)
    return (before, *rest.split(END))


def publish(output):
    with open(os.path.join(output, "results.json"), encoding="utf-8") as file:
        results = json.load(file)
    machine = {name: value for name, value in results["machine"].items() if name not in OF_THE_DAY}
    text = json.dumps({"machine": machine, "parts": results["parts"]}, separators=(",", ":"),
                      ensure_ascii=False)
    with open(NUMBERS, "w", encoding="utf-8") as file:  # one row per line
        file.write(re.sub(
            r'(\{"program":|"[a-z0-9-]+":\{"(?:rows|command|failed)")', r"\n\1", text) + "\n")
    text = make_text(output)
    before, _, after = read_document()
    with open(DOCUMENT, "w", encoding="utf-8") as file:
        file.write(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}")
    shutil.rmtree(IMAGES, ignore_errors=True)
    shutil.copytree(os.path.join(output, "plots"), IMAGES)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    publish(sys.argv[1])
