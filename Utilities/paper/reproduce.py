#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the parts of a reproduction of the paper that have not run yet, then writes the report.
reproduce_paper.sh calls it with the programs that it needs; its --help has the options. A part is a
command that writes one JSON file, OUTPUT/parts/NAME.json, and ends within nine minutes."""

import argparse
import glob
import json
import os
import platform
import re
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
RIVALS = os.path.join(HERE, "rivals.py")
LONGEST = 540  # seconds that a part may take

EPSILONS = (1e-7, 1e-6, 1e-5, 1e-4, 5e-4, 1e-3)
GENERATED = {"torus", "noisy-torus", "decimated-torus"}

# How large a reproduction is: points of the random bad meshes, more of them for a GPU alone, the
# largest for Fig. 8b and for other people's programs, triangles of chains, points of the tests, of
# ruined surfaces and of the tori, and options of time.
SCALES = {
    "test": dict(sizes=(1000, 2000, 4000), gpu_sizes=(), largest=2000, chain=(6, 10, 50),
                 tests=1000, ruined=1500, surface=3000, timing=(1, 1)),
    "quick": dict(sizes=(100_000, 300_000, 1_000_000), gpu_sizes=(), largest=100_000,
                  chain=(6, 10, 30, 100, 300, 1000), tests=20_000, ruined=20_000,
                  surface=100_000, timing=(3, 8)),
    "full": dict(sizes=(100_000, 250_000, 500_000, 1_000_000, 2_000_000, 5_000_000),
                 gpu_sizes=(20_000_000, 100_000_000), largest=5_000_000,
                 chain=(6, 10, 30, 100, 300, 1000, 3000, 10_000), tests=1_000_000,
                 ruined=200_000, surface=1_586_302, timing=(5, 10)),
}
# How each is ruined, and its file.
RUINED = (("flips", "good", "torus"), ("flips", "good", "box"), ("splits", "good", "torus"),
          ("splits", "good", "box"), ("anisotropic", "anisotropic", "torus"))
# Beyond these numbers of points, single runs of other people's programs take longer than a part may;
# the time grows almost with their square.
RIVAL_LARGEST = {"scipy": 5_000_000, "triangle": 5_000_000, "vtk": 100_000, "startinpy": 1_000_000}


def plan(scale, has_gpu, rivals, meshes):
    """(name, program, experiment, settings) of all parts, in the order in which they run."""
    yield "chain", "paper", "chain", {"Triangles": scale["chain"]}
    gpu = ["ours-gpu", "paper-gpu"] if has_gpu else []
    threads = ["ours-1", "ours-all", "no-chunks", "paper-all", "paper-1", "lawson", "cgal"]
    programs = [(size, name) for size in scale["sizes"] for name in gpu + threads]
    if has_gpu:
        programs += [(size, name) for size in scale["gpu_sizes"] for name in [*gpu, "ours-all"]]
    for size, name in programs:
        yield f"random-{size}-{name}", "paper", "random", {
            "Points": size, "Program": name, "OnGpu": name in gpu}
    for size in scale["sizes"]:
        if size <= scale["largest"] and size in (scale["sizes"][0], 1_000_000, scale["largest"]):
            for epsilon in EPSILONS:
                yield f"quality-{size}-{epsilon:g}", "paper", "quality", {
                    "Points": size, "Epsilons": [epsilon]}
    for mesh in meshes:
        path = {"Mesh": "{folder}/meshes/" + mesh + ".dfmesh"}
        yield f"surface-{mesh}", "paper", "surface", path
        if mesh not in GENERATED:
            yield f"ruined-{mesh}", "paper", "ruined", path
        if "meshlib" in rivals:
            yield f"meshlib-{mesh}", "rivals", "meshlib", path
    for mesh in ("random", "offset", "grid", "circles") if meshes else ("random", "offset"):
        path = mesh if mesh in ("random", "offset") else "{folder}/meshes/tests/" + mesh + ".dfmesh"
        yield f"tests-{mesh}", "paper", "tests", {"Mesh": path, "Points": scale["tests"]}
    for kind, folder, shape in RUINED if meshes else ():
        path = "{folder}/meshes/" + folder + "/" + shape + ".dfmesh"
        yield f"ruined-{kind}-{shape}", "paper", "ruined", {"Mesh": path, "Ruin": kind}
    for name, largest in RIVAL_LARGEST.items():
        for size in scale["sizes"] if name in rivals else ():
            if size <= min(largest, scale["largest"]):
                yield f"rival-{size}-{name}", "rivals", name, {"Points": size}


class Results:
    """Rows of all parts that have run. A row is a program on a mesh."""

    def __init__(self, folder, machine=None, parts=None):
        self.folder = folder
        self.machine = machine or read_json(os.path.join(folder, "machine.json")) or {}
        paths = sorted(glob.glob(os.path.join(folder, "parts", "*.json")), key=natural_order)
        self.parts = parts or {os.path.basename(path)[:-5]: read_json(path) for path in paths}

    def rows(self, experiment):
        """The rows of all parts of an experiment, e.g. "random"."""
        return [row for name, part in self.parts.items() if name.split("-")[0] == experiment
                for row in part.get("rows", [])]

    def failures(self):
        """(part, reason) for each part that did not run to its end."""
        return [(name, part["failed"]) for name, part in self.parts.items() if "failed" in part]


def natural_order(name):
    """A key for sorting by the numbers within names: 250000 before 1000000."""
    return [(int(word), "") if word.isdigit() else (-1, word) for word in re.split(r"(\d+)", name)]


def read_json(path):
    """None if there is no such file."""
    if not os.path.isfile(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def write_json(path, value):
    """Writes the whole file or none: a part that was stopped leaves no file."""
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1)
    os.replace(path + ".new", path)


def digest(row):
    """Replaces the times of a row by their spread. For chains, says whether the flips of iterations
    1, 2, ... are 1, 2, ... m / 2 ... 2, 1, and drops long lists, which only repeat that."""
    for name in [name for name in row if name.endswith("_ms")]:
        times = row[name]
        row[name] = {"median": statistics.median(times), "smallest": min(times),
                     "largest": max(times), "runs": len(times)}
    m = row.get("triangles", 0)
    if "flipped" in row and row.get("points") == m + 2:
        row["is_ramp"] = row["flipped"] == [min(i, m - i) for i in range(1, m)]
        if m > 100:
            del row["flipped"], row["excluded"]
    return row


def run(arguments, name, program, experiment, settings, timeout=LONGEST):
    """Runs a part and writes its file. @returns whether it was in time."""
    programs = {"paper": [arguments.program], "rivals": [arguments.rivals, RIVALS]}
    text = json.dumps({"DelaunayFlip": arguments.program, **settings})
    words = [*programs[program], experiment, text.replace("{folder}", arguments.output)]
    result = {"command": f"{program} {experiment} {json.dumps(settings)}"}
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=timeout, check=False)
        if done.returncode:
            result["failed"] = done.stderr.strip()[-300:] or f"exit status {done.returncode}"
        else:
            result["rows"] = [digest(row) for row in json.loads(done.stdout)["rows"]]
    except subprocess.TimeoutExpired:
        if timeout < LONGEST:
            return False
        result["failed"] = f"stopped after {LONGEST} s"
    if "failed" in result:
        print(f"    {result['failed']}", flush=True)
    write_json(os.path.join(arguments.output, "parts", name + ".json"), result)
    return True


def ask(*command):
    """The output of a command; empty if it fails."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def describe_machine(arguments):
    about = json.loads(ask(arguments.program, "machine"))
    return {"machine": about["machine"], "gpu": about["gpu"], "system": platform.platform(),
            "python": platform.python_version(),
            "gpu_name": ask("nvidia-smi", "--query-gpu=name,driver_version,memory.total",
                            "--format=csv,noheader").splitlines()[:1],
            "commit": ask("git", "-C", HERE, "describe", "--always", "--dirty"),
            "when": time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()),
            "scale": arguments.scale,
            "rivals": json.loads(ask(arguments.rivals or "", RIVALS, "list") or "{}")}


def prepare_meshes(arguments, scale):
    """Makes the surfaces that do not exist. @returns the names of those of Fig. 11, the generated
    ones first."""
    folder = os.path.join(arguments.output, "meshes")
    for python in filter(None, (arguments.rivals, sys.executable, "/usr/bin/python3")):
        if ask(python, "-c", "import numpy, vtkmodules.vtkIOPLY; print('yes')"):
            subprocess.run([python, os.path.join(HERE, "meshes.py"), folder,
                            *(str(scale[name]) for name in ("surface", "tests", "ruined")),
                            arguments.meshes or ""], check=True)
            break
    else:
        print(f"no Python with VTK and NumPy: no surfaces but those in {folder}")
    names = {os.path.basename(path)[:-7] for path in glob.glob(os.path.join(folder, "*.dfmesh"))}
    return [*sorted(names & GENERATED, reverse=True), *sorted(names - GENERATED)]


def run_parts(arguments):
    """@returns how many parts are left for another call."""
    start = time.monotonic()
    os.makedirs(os.path.join(arguments.output, "parts"), exist_ok=True)
    machine = describe_machine(arguments)
    write_json(os.path.join(arguments.output, "machine.json"), machine)
    scale = SCALES[arguments.scale]
    present = [name for name, about in machine["rivals"].items() if "version" in about]
    done = Results(arguments.output).parts
    left = [part for part in plan(
        scale, machine["gpu"], present, prepare_meshes(arguments, scale))
        if arguments.parts.search(part[0]) and "failed" in done.get(part[0], {"failed": ""})]
    shared = {"Repetitions": 0 if arguments.no_times else scale["timing"][0],
              "Seconds": scale["timing"][1], "OnGpu": machine["gpu"]}
    for number, (name, program, experiment, settings) in enumerate(left):
        timeout = min(LONGEST, arguments.time_limit - (time.monotonic() - start))
        print(f"[{number + 1}/{len(left)}] {name}", flush=True)
        if timeout <= 0 or not run(arguments, name, program, experiment, {**shared, **settings},
                                   timeout):
            print(f"time limit: {len(left) - number} parts are left; call again", flush=True)
            return len(left) - number
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("output", help="folder of the report")
    parser.add_argument("--scale", choices=SCALES, default="full")
    parser.add_argument("--program", help="delaunay-flip-paper")
    parser.add_argument("--rivals", help="a Python that has other people's packages")
    parser.add_argument("--meshes", help="folder of .ply, .stl and .vtk surfaces")
    parser.add_argument("--time-limit", type=float, metavar="SECONDS", default=float("inf"),
                        help="stop after this time; call again for the rest")
    parser.add_argument("--parts", type=re.compile, metavar="PATTERN", default=re.compile(""),
                        help="run only the parts with names that match this regular expression")
    parser.add_argument("--no-times", action="store_true",
                        help="run every program once, without times, as on a busy machine")
    parser.add_argument("--run-only", action="store_true", help="do not draw; do that later")
    parser.add_argument("--draw-only", action="store_true", help="run nothing; draw what exists")
    arguments = parser.parse_args()
    left = 0 if arguments.draw_only else run_parts(arguments)
    results = Results(arguments.output)
    write_json(os.path.join(arguments.output, "results.json"),
               {"machine": results.machine, "parts": results.parts})
    if not arguments.run_only:
        try:
            import report
        except ImportError as error:  # a machine with a GPU may have no matplotlib
            print(f"no report here ({error}): draw it elsewhere from {arguments.output} by "
                  "--draw-only")
        else:
            path = os.path.join(arguments.output, "report.md")
            with open(path, "w", encoding="utf-8") as file:
                file.write("# The paper, reproduced\n\n" + report.make(results))
            print(f"{path} is written")
    return 3 if left else 0


if __name__ == "__main__":
    sys.exit(main())
