# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The files of a reproduction, OUTPUT/parts/NAME.json, one for each part, and their combined
results."""

import json
import os
import re


class Results:
    """Rows of all parts that have run. A row is a program on a mesh."""

    def __init__(self, folder):
        self.folder = folder
        self.parts = {}
        self.machine = {}
        path = os.path.join(folder, "machine.json")
        if os.path.isfile(path):
            self.machine = read_json(path)
        parts = os.path.join(folder, "parts")
        for name in sorted(os.listdir(parts), key=natural_order) if os.path.isdir(parts) else []:
            if name.endswith(".json"):
                self.parts[name[: -len(".json")]] = read_json(os.path.join(parts, name))

    def rows(self, experiment):
        """The rows of all parts of an experiment, e.g. "random"."""
        return [
            row
            for name, part in self.parts.items()
            if name.split("-")[0] == experiment
            for row in part.get("rows", [])
        ]

    def failures(self):
        """(part, reason) for each part that did not run to its end."""
        return [(name, part["failed"]) for name, part in self.parts.items() if "failed" in part]

    def write_merged(self):
        write_json(
            os.path.join(self.folder, "results.json"),
            {"machine": self.machine, "parts": self.parts},
        )


def natural_order(name):
    """A key for sorting by the numbers within names: 250000 before 1000000."""
    return [(int(word), "") if word.isdigit() else (-1, word) for word in re.split(r"(\d+)", name)]


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def write_json(path, value):
    """Writes the whole file or none: a part that was stopped leaves no file."""
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1)
        file.write("\n")
    os.replace(path + ".new", path)


def median(row, name="total_ms"):
    """Milliseconds, or None if the row has no such time."""
    time = row.get(name)
    return time["median"] if time else None
