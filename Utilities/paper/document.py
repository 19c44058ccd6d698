#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: document.py OUTPUT [--without-times]
       document.py --check

Puts a reproduction into Documentation/: its numbers into paper.json, its plots into images/paper/,
and its report into paper.md, between the two marked lines. --check tells whether that text still
agrees with the numbers.
"""

import json
import os
import re
import shutil
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
DOCUMENT = os.path.join(ROOT, "Documentation/paper.md")
NUMBERS = os.path.join(ROOT, "Documentation/paper.json")
IMAGES = os.path.join(ROOT, "Documentation/images/paper")
BEGIN, END = "<!-- begin of what document.py writes -->", "<!-- end of it -->"
OF_THE_DAY = ("commit", "system", "when")


def strip(part, with_times):
    """A part without the data that are specific to the day of its run."""
    kept = {name: value for name, value in part.items() if name in ("rows", "command", "failed")}
    if not with_times:
        kept["rows"] = [{name: value for name, value in row.items() if not name.endswith("_ms")}
                        for row in part.get("rows", [])]
    return kept


def make_numbers(merged, with_times):
    machine = {name: value for name, value in merged["machine"].items() if name not in OF_THE_DAY}
    parts = {name: strip(part, with_times) for name, part in merged["parts"].items()}
    return {"machine": machine, "parts": parts}


def write_numbers(numbers):
    """JSON with one row per line."""
    text = json.dumps(numbers, separators=(",", ":"), ensure_ascii=False)
    text = re.sub(r'(\{"program":|"[a-z0-9-]+":\{"(?:rows|command|failed)")', r"\n\1", text)
    with open(NUMBERS, "w", encoding="utf-8") as file:
        file.write(text + "\n")


def make_text(folder):
    """Makes the Markdown from the numbers, and draws the plots into `folder`."""
    import report
    from results import Results, read_json

    results = Results(folder)
    numbers = read_json(NUMBERS)
    results.machine, results.parts = numbers["machine"], numbers["parts"]
    sections, tables = report.gather(results)
    text = report.make_markdown(sections, tables, "images/paper")
    return text[text.index("\n## ") :].strip()  # the page has its own introduction


def read_document():
    """The text before, between and after the marked lines."""
    with open(DOCUMENT, encoding="utf-8") as file:
        before, rest = file.read().split(BEGIN)
    return (before, *rest.split(END))


def publish(output, with_times):
    with open(os.path.join(output, "results.json"), encoding="utf-8") as file:
        write_numbers(make_numbers(json.load(file), with_times))
    text = make_text(output)
    before, _, after = read_document()
    with open(DOCUMENT, "w", encoding="utf-8") as file:
        file.write(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}")
    shutil.rmtree(IMAGES, ignore_errors=True)
    os.makedirs(IMAGES)
    for name in re.findall(r"\(images/paper/(\w+\.png)\)", text):
        shutil.copy(os.path.join(output, "plots", name), IMAGES)


def main():
    if sys.argv[1:] == ["--check"]:
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            same = make_text(folder) == read_document()[1].strip()
        print(f"paper.md {'agrees' if same else 'does not agree'} with paper.json")
        return 0 if same else 1
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    publish(sys.argv[1], "--without-times" not in sys.argv)
    return 0


if __name__ == "__main__":
    sys.exit(main())
