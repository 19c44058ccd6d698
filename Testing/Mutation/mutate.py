#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Plants small faults in the engine and counts those that the tests catch.

    mutate.py plan          copies the sources to build-mutation/, with 200 faults in the files below
    mutate.py build         builds the tests there
    mutate.py run           runs them once for every fault; continues where it was stopped
    mutate.py report        prints how many faults were caught, and which survived

A fault is a comparison, a sign or a constant changed, two arguments swapped, or a statement left
out. The sources contain all faults at once, switched off; DELAUNAYFLIP_MUTANT=NUMBER in the
environment switches one on. So the tests are built only once. Needs python3-clang and clang
(Debian).
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build-mutation"
SOURCE = FOLDER / "source"

# The code that decides results: predicates, rules, the flip, the guard, claims and surveys.
TOPICS = {
    "predicates": ["Geometry/FilteredPredicates.h", "Geometry/ExactPredicates.h",
                   "Geometry/ExactPredicates.cpp", "Geometry/SurfaceAngles.h"],
    "rules": ["Flips/FlipRules.h"],
    "flip": ["Flips/EdgeFlip.h", "Flips/FlipSteps.h"],
    "guard": ["Flips/EdgeGuard.h", "Mesh/EdgeTable.h"],
    "claims": ["Flips/EdgeClaims.h"],
    "survey": ["Mesh/PlanarSurvey.h", "Mesh/MeshSurvey.h", "Mesh/MeshSurveyBuilder.h",
               "Mesh/GeometryChoice.h"],
}
# Together these include all of the files above.
UNITS = ["Threads/ThreadEngine.cpp", "Geometry/ExactPredicates.cpp"]
INCLUDES = ["Engine", "Engine/Geometry", "Engine/Mesh", "Engine/Flips", "Engine/Threads"]

OPPOSITES = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||",
             "||": "&&", "+": "-", "-": "+", "*": "+", "|": "&", "&": "|"}

# Functions whose first two arguments may be swapped.
SYMMETRIC = ["Dot", "EdgeKey", "Claim", "Holds", "Release", "MakeWord", "min", "max", "minmax"]

# The fuzzer comes first, because it finds most faults within a second; then the engine's tests,
# without those that take seconds each.
SLOW = ["*/100000*", "*/30000*", "*/10000P*", "Meshes/DeterminismTest.*", "Meshes/ProgressTest.*",
        "TiltedPlane.SimilarMeshes*", "LawsonOracle.*", "RandomMess.*", "PaperMethod.*"]
TESTS = [
    ["delaunay-flip-fuzz-engine", "--cases", "1500"],
    ["DelaunayFlipCoreTests", "--gtest_fail_fast", "--gtest_brief=1",
     "--gtest_filter=-" + ":".join(SLOW)],
]


class Fault:
    """A place in a file, and the text that makes it a fault."""

    def __init__(self, path, extent, kind, mutated, declares=None):
        self.path = path
        self.start = extent[0]
        self.end = extent[1]
        self.kind = kind
        self.mutated = mutated
        self.declares = declares  # "constexpr" or "static constexpr", which must be removed


# --- finding places ------------------------------------------------------------------------------

def parse_units():
    from clang import cindex
    index = cindex.Index.create()
    flags = ["-std=c++17", "-x", "c++"] + ["-I" + str(ROOT / i) for i in INCLUDES]
    for unit in UNITS:
        yield index.parse(str(ROOT / "Engine" / unit), args=flags)


def extent_of(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


class Finder:
    """All places of one file."""

    def __init__(self, path):
        self.path = path
        self.text = (ROOT / "Engine" / path).read_bytes()
        self.faults = []

    def get(self, extent):
        return self.text[extent[0]:extent[1]].decode()

    def add(self, cursor, kind, mutated, declares=None):
        self.faults.append(Fault(self.path, extent_of(cursor), kind, mutated, declares))

    def visit(self, cursor, in_function, in_block):
        from clang.cindex import CursorKind as K
        name = cursor.kind
        if name in (K.STATIC_ASSERT, K.TEMPLATE_TYPE_PARAMETER, K.ENUM_DECL, K.PARM_DECL):
            return
        if name == K.VAR_DECL and self.is_constant(cursor):
            self.add_constant(cursor)
            return
        if name in (K.FUNCTION_DECL, K.CXX_METHOD, K.FUNCTION_TEMPLATE, K.CONSTRUCTOR,
                    K.LAMBDA_EXPR):
            if "constexpr" in self.get(extent_of(cursor)).split("(")[0].split():
                return
            in_function = True
        if in_function:
            self.add_expression(cursor, name, K)
            if in_block and name in (K.CALL_EXPR, K.BINARY_OPERATOR,
                                     K.COMPOUND_ASSIGNMENT_OPERATOR, K.UNARY_OPERATOR):
                self.add(cursor, "statement", None)
        for child in cursor.get_children():
            self.visit(child, in_function, name == K.COMPOUND_STMT)

    def is_constant(self, cursor):
        return "constexpr" in self.get(extent_of(cursor)).split("=")[0].split()

    def add_constant(self, cursor):
        """A floating-point constant; others are often needed at compile time."""
        text = self.get(extent_of(cursor))
        if re.match(r"(static )?constexpr double \w+\s*=", text):
            value = text.split("=", 1)[1].strip()
            self.add(cursor, "constant", f"2.0 * ({value})", "constexpr")

    def add_expression(self, cursor, name, K):
        children = list(cursor.get_children())
        if name == K.BINARY_OPERATOR and len(children) == 2:
            left, right = (extent_of(c) for c in children)
            sign = self.get((left[1], right[0])).strip()
            if sign in OPPOSITES:
                self.add(cursor, "operator", f"({self.get(left)}) {OPPOSITES[sign]} "
                         f"({self.get(right)})")
        elif name == K.UNARY_OPERATOR and self.get(extent_of(cursor)).startswith(("-", "!")):
            self.add(cursor, "sign", f"({self.get(extent_of(cursor))[1:]})")
        elif name in (K.INTEGER_LITERAL, K.FLOATING_LITERAL):
            text = self.get(extent_of(cursor))
            is_zero = not text.strip("0.")
            changed = f"{text} + 1" if name == K.INTEGER_LITERAL or is_zero else f"2.0 * {text}"
            self.add(cursor, "constant", changed)
        elif name == K.CALL_EXPR:
            self.add_swap(cursor)

    def add_swap(self, cursor):
        """Swaps the first two arguments of a call with parentheses, if they differ."""
        arguments = [extent_of(a) for a in cursor.get_arguments() if a is not None]
        extent = extent_of(cursor)
        if (len(arguments) < 2 or not self.get(extent).endswith(")") or
                cursor.spelling in SYMMETRIC):
            return
        first, second = self.get(arguments[0]), self.get(arguments[1])
        if first != second and self.text[extent[0]:arguments[0][0]].strip().endswith(b"("):
            swapped = (self.get((extent[0], arguments[0][0])) + second + ", " + first +
                       self.get((arguments[1][1], extent[1])))
            self.add(cursor, "swap", swapped)


def is_in_file(cursor, path):
    place = cursor.location.file
    return place is not None and os.path.realpath(place.name) == str(ROOT / "Engine" / path)


def top_cursors(cursor, path):
    """The outermost cursors in a file."""
    for child in cursor.get_children():
        if is_in_file(child, path):
            yield child
        elif child.kind.name == "NAMESPACE":
            yield from top_cursors(child, path)


def find_faults(paths, units):
    faults = {}
    for path in paths:
        finder = Finder(path)
        for unit in units:
            for cursor in top_cursors(unit.cursor, path):
                finder.visit(cursor, False, False)
        for fault in finder.faults:
            faults[(path, fault.start, fault.end, fault.kind)] = fault
    return [faults[key] for key in sorted(faults)]


# --- planting ------------------------------------------------------------------------------------

def guard(number, fault, original):
    """The source text with a switch for the fault."""
    if fault.kind == "statement":
        return f"if (!MUTANT({number})) {{ {original}; }}"
    if fault.declares:
        head, value = original.split("=", 1)
        head = head.replace("static constexpr", "static inline const")
        head = head.replace("constexpr", "const")
        return f"{head}= MUTANT({number}) ? {fault.mutated} : {value.strip()}"
    return f"(MUTANT({number}) ? ({fault.mutated}) : ({original}))"


def plant(path, numbered):
    """Writes a file with its faults, which do not overlap; lines keep their numbers."""
    text = (ROOT / "Engine" / path).read_bytes()
    for number, fault in sorted(numbered, key=lambda item: -item[1].start):
        original = text[fault.start:fault.end].decode()
        guarded = guard(number, fault, original)
        lines = original.count("\n")
        guarded = guarded.replace("\n", " ") + "\n" * lines
        text = text[:fault.start] + guarded.encode() + text[fault.end:]
    (SOURCE / "Engine" / path).write_bytes(text)


def overlaps(fault, others):
    return any(fault.path == o.path and fault.start < o.end and o.start < fault.end
               for o in others)


def choose(faults, count, chosen, bad, generator):
    """Draws until there are `count` that neither overlap nor fail to compile."""
    pool = [f for f in faults if id(f) not in bad]
    generator.shuffle(pool)
    for fault in pool:
        if len(chosen) >= count:
            break
        if not overlaps(fault, chosen):
            chosen.append(fault)
    return chosen


def share(count, sizes):
    """How many faults to draw for each topic: in proportion to the square root of its places, so
    that small topics are represented too."""
    weights = {topic: size ** 0.5 for topic, size in sizes.items()}
    total = sum(weights.values())
    return {topic: max(1, round(count * weight / total)) for topic, weight in weights.items()}


def line_of(fault):
    return (ROOT / "Engine" / fault.path).read_bytes()[:fault.start].count(b"\n") + 1


def lines_of(fault):
    text = (ROOT / "Engine" / fault.path).read_bytes()
    first = line_of(fault)
    return range(first, first + text[fault.start:fault.end].count(b"\n") + 1)


def compile_errors():
    """(file, line) of each error of the compiler in the mutated engine."""
    found = set()
    for unit in UNITS + ["MeshAudit.cpp"]:
        command = ["g++", "-std=c++17", "-fsyntax-only", "-fmax-errors=0",
                   "-Werror=vla", "-include", str(ROOT / "Testing/Mutation/MutantSwitch.h")]
        command += ["-I" + str(SOURCE / i) for i in INCLUDES] + [str(SOURCE / "Engine" / unit)]
        result = subprocess.run(command, capture_output=True, text=True)
        for path, line in re.findall(r"/source/Engine/([\w/.]+):(\d+):\d+: error",
                                     result.stderr):
            found.add((path, int(line)))
    return found


def copy_sources():
    shutil.rmtree(SOURCE, ignore_errors=True)
    names = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"],
                           capture_output=True, text=True, check=True).stdout.split("\n")
    for name in names:
        if name and (ROOT / name).is_file():
            (SOURCE / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, SOURCE / name)


def describe(number, topic, fault):
    text = (ROOT / "Engine" / fault.path).read_bytes()
    original = " ".join(text[fault.start:fault.end].decode().split())
    mutated = " ".join((fault.mutated or "(left out)").split())
    return {"number": number, "topic": topic, "file": fault.path, "line": line_of(fault),
            "kind": fault.kind, "original": original, "mutated": mutated}


def plan(arguments):
    copy_sources()
    units = list(parse_units())
    faults = {topic: find_faults(paths, units) for topic, paths in TOPICS.items()}
    shares = share(arguments.count, {topic: len(found) for topic, found in faults.items()})
    generator = random.Random(arguments.seed)
    chosen = {topic: [] for topic in TOPICS}
    bad = set()
    while True:
        for topic in TOPICS:
            choose(faults[topic], shares[topic], chosen[topic], bad, generator)
        numbered = list(enumerate([(t, f) for t in TOPICS for f in chosen[t]], 1))
        for path in sum(TOPICS.values(), []):
            plant(path, [(n, f) for n, (_, f) in numbered if f.path == path])
        errors = compile_errors()
        rejected = [f for _, (_, f) in numbered if any((f.path, l) in errors for l in lines_of(f))]
        if not rejected:
            break
        print(f"{len(rejected)} do not compile; drawing others", flush=True)
        bad.update(id(f) for f in rejected)
        for topic in TOPICS:
            chosen[topic] = [f for f in chosen[topic] if id(f) not in bad]
    listed = [describe(n, topic, fault) for n, (topic, fault) in numbered]
    (FOLDER / "faults.json").write_text(json.dumps(listed, indent=1))
    print(f"{len(listed)} faults of {sum(len(f) for f in faults.values())} places, "
          f"in {FOLDER / 'faults.json'}")


# --- building and running ------------------------------------------------------------------------

def build(arguments):
    switch = SOURCE / "Testing/Mutation/MutantSwitch.h"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
               f"-DCMAKE_CXX_FLAGS=-include {switch}", "-DDELAUNAYFLIP_BUILD_TESTING=ON",
               "-DDELAUNAYFLIP_BUILD_VTK=OFF", "-DDELAUNAYFLIP_ENABLE_CUDA=OFF"]
    subprocess.run(["cmake", "-S", SOURCE, "-B", FOLDER / "build", *options], check=True)
    subprocess.run(["cmake", "--build", FOLDER / "build", "--parallel", str(arguments.jobs),
                    "--target", *[test[0] for test in TESTS]], check=True)


def run_test(programs, test, number, seconds):
    """How a test ended: "" when it passed."""
    environment = dict(os.environ, DELAUNAYFLIP_MUTANT=str(number))
    command = [str(programs / test[0]), *test[1:]]
    try:
        result = subprocess.run(command, env=environment, timeout=seconds, capture_output=True,
                                text=True, errors="replace")
    except subprocess.TimeoutExpired:
        return "does not end"
    if result.returncode == 0:
        return ""
    if result.returncode < 0:
        return f"dies of signal {-result.returncode}"
    failed = re.search(r"\[  FAILED  \] ([\w/.]+)", result.stdout)
    return failed.group(1) if failed else test[0]


def run_fault(programs, number, seconds):
    start = time.monotonic()
    for test in TESTS:
        caught = run_test(programs, test, number, seconds)
        if caught:
            break
    return {"number": number, "caught": caught, "seconds": round(time.monotonic() - start, 1)}


def read_results(folder):
    path = folder / "results.jsonl"
    lines = path.read_text().splitlines() if path.exists() else []
    return {entry["number"]: entry for entry in map(json.loads, lines)}


def run(arguments):
    folder = arguments.folder
    faults = json.loads((folder / "faults.json").read_text())
    programs = arguments.programs or folder / "build/bin"
    clean = run_fault(programs, 0, arguments.timeout)
    if clean["caught"]:
        sys.exit(f"the tests fail without a fault: {clean['caught']}")
    done = read_results(folder)
    waiting = [f["number"] for f in faults if f["number"] not in done]
    deadline = time.monotonic() + arguments.seconds

    def work(number):
        return run_fault(programs, number, arguments.timeout) \
            if time.monotonic() < deadline else None

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, \
            open(folder / "results.jsonl", "a") as results:
        for entry in pool.map(work, waiting):
            if entry:
                results.write(json.dumps(entry) + "\n")
                results.flush()
    print(f"{len(read_results(folder))} of {len(faults)} faults done; "
          f"without a fault the tests take {clean['seconds']} s")


def report(arguments):
    faults = json.loads((arguments.folder / "faults.json").read_text())
    done = read_results(arguments.folder)
    for topic in TOPICS:
        numbers = [f["number"] for f in faults if f["topic"] == topic and f["number"] in done]
        caught = sum(1 for n in numbers if done[n]["caught"])
        print(f"{topic}: {caught} of {len(numbers)} caught")
    for fault in faults:
        if fault["number"] in done and not done[fault["number"]]["caught"]:
            print(f"survived: {fault['number']} {fault['file']}:{fault['line']} {fault['kind']}: "
                  f"{fault['original']}  ->  {fault['mutated']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=["plan", "build", "run", "report"])
    parser.add_argument("--count", type=int, default=200, help="how many faults (plan)")
    parser.add_argument("--seed", type=int, default=1, help="of the choice of faults (plan)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=float("inf"),
                        help="starts no further fault after that long (run)")
    parser.add_argument("--timeout", type=float, default=600, help="of a test in seconds (run)")
    parser.add_argument("--folder", type=pathlib.Path, default=FOLDER,
                        help="where faults.json and the results are (run, report)")
    parser.add_argument("--programs", type=pathlib.Path, help="where the tests are (run)")
    arguments = parser.parse_args()
    {"plan": plan, "build": build, "run": run, "report": report}[arguments.step](arguments)


if __name__ == "__main__":
    main()
