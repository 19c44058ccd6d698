#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the parts of a reproduction of the paper that have not run yet, then draws and writes the
report. reproduce_paper.sh calls it with the programs that it needs; its --help has the options."""

import argparse
import dataclasses
import os
import platform
import re
import subprocess
import sys
import time

import parts
import surfaces
from results import Results, read_json, write_json


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("output", help="folder of the report")
    parser.add_argument("--scale", choices=parts.SCALES, default="full")
    parser.add_argument("--program", help="delaunay-flip-paper")
    parser.add_argument("--rivals", help="a Python that has other people's packages")
    parser.add_argument("--meshes", help="folder of .ply, .stl and .vtk surfaces")
    parser.add_argument("--time-limit", type=float, metavar="SECONDS",
                        help="start no part that would end after this time; call again for the rest")
    parser.add_argument("--parts", type=re.compile, metavar="PATTERN", default=re.compile(""),
                        help="run only the parts whose names match this regular expression")
    parser.add_argument("--no-times", action="store_true",
                        help="run every program once, without times, as on a busy machine")
    parser.add_argument("--run-only", action="store_true", help="do not draw; do that later")
    parser.add_argument("--draw-only", action="store_true", help="run nothing; draw the results that exist")
    return parser.parse_args()


def ask(command):
    """The output of a command; empty if it fails."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def describe_machine(arguments, program_path):
    """The machine, as described in the report."""
    machine = read_json(program_path)
    folder = os.path.dirname(os.path.abspath(__file__))
    machine["system"] = platform.platform()
    machine["python"] = platform.python_version()
    machine["gpu_name"] = ask(["nvidia-smi", "--query-gpu=name,driver_version,memory.total",
                               "--format=csv,noheader"]).splitlines()[:1]
    machine["commit"] = ask(["git", "-C", folder, "describe", "--always", "--dirty"])
    machine["when"] = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime())
    machine["scale"] = arguments.scale
    machine["rivals"] = list_rivals(arguments)
    return machine


def list_rivals(arguments):
    """{"scipy": {"version": ..., "licence": ...} or {"absent": ...}}"""
    if not arguments.rivals:
        return {}
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "rivals.py")
    path = os.path.join(arguments.output, "rivals.json")
    subprocess.run([arguments.rivals, script, "list", "--output", path], check=True)
    return read_json(path)


class Runner:
    """Runs parts one after the other."""

    def __init__(self, arguments, plan):
        self.arguments = arguments
        self.plan = plan
        self.start = time.monotonic()
        self.failed_groups = set()
        self.places = {
            "{program}": [arguments.program],
            "{rivals}": [arguments.rivals or "", os.path.join(
                os.path.dirname(os.path.abspath(__file__)), "rivals.py")],
        }

    def path_of(self, part):
        return os.path.join(self.arguments.output, "parts", part.name + ".json")

    def is_done(self, part):
        path = self.path_of(part)
        return os.path.isfile(path) and "failed" not in read_json(path)

    def run_all(self):
        """@returns how many parts are left for another call."""
        left = [part for part in self.plan.parts
                if self.arguments.parts.search(part.name) and not self.is_done(part)]
        for number, part in enumerate(left):
            remaining = sum(p.seconds for p in left[number:])
            if self.is_too_late(part):
                print(f"time limit: {len(left) - number} parts are left; call again", flush=True)
                return len(left) - number
            print(f"[{number + 1}/{len(left)}] {part.what} (about {part.seconds:.0f} s; "
                  f"{remaining / 60:.1f} min left)", flush=True)
            self.run(part)
        return 0

    def is_too_late(self, part):
        limit = self.arguments.time_limit
        return limit is not None and time.monotonic() - self.start + part.seconds > limit

    def run(self, part):
        if part.group in self.failed_groups:
            self.note_failure(part, "skipped: it failed on a smaller mesh")
            return
        command = []
        for word in part.command:
            command += self.places.get(word, [word.replace("{folder}", self.arguments.output)])
        scratch = self.path_of(part) + ".new"
        start = time.monotonic()
        try:
            done = subprocess.run([*command, "--output", scratch], capture_output=True, text=True,
                                  timeout=parts.LONGEST, check=False)
            reason = done.stderr.strip()[-300:] if done.returncode else ""
            if done.returncode and not reason:
                reason = f"exit status {done.returncode}"
        except subprocess.TimeoutExpired:
            reason = f"stopped after {parts.LONGEST} s"
        if reason:
            self.note_failure(part, reason)
            return
        part_result = read_json(scratch)
        part_result["command"] = " ".join(part.command)
        part_result["seconds"] = round(time.monotonic() - start, 1)
        os.remove(scratch)
        write_json(self.path_of(part), part_result)

    def note_failure(self, part, reason):
        print(f"    {reason}", flush=True)
        if part.group:
            self.failed_groups.add(part.group)
        write_json(self.path_of(part), {"failed": reason, "command": " ".join(part.command)})


def run_parts(arguments):
    """@returns how many parts are left."""
    os.makedirs(os.path.join(arguments.output, "parts"), exist_ok=True)
    path = os.path.join(arguments.output, "machine.json")
    subprocess.run([arguments.program, "machine", "--output", path], check=True)
    machine = describe_machine(arguments, path)
    write_json(path, machine)
    scale = parts.SCALES[arguments.scale]
    if arguments.no_times:
        scale = dataclasses.replace(scale, timing=("--no-times",))
    meshes = surfaces.prepare(arguments, scale.surface)
    present = [name for name, about in machine["rivals"].items() if "absent" not in about]
    plan = parts.Plan(scale, machine["gpu"], present, meshes)
    return Runner(arguments, plan).run_all()


def main():
    arguments = parse_arguments()
    left = 0 if arguments.draw_only else run_parts(arguments)
    results = Results(arguments.output)
    results.write_merged()
    if arguments.run_only:
        return 3 if left else 0
    try:
        import report
    except ImportError as error:  # a machine with a GPU may have no matplotlib
        print(f"no report here ({error}): draw it elsewhere from {arguments.output} by --draw-only")
        return 3 if left else 0
    report.write(results)
    print(f"{arguments.output}/report.html and report.md are written")
    return 3 if left else 0


if __name__ == "__main__":
    sys.exit(main())
