#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how one mesh in pieces scales, by delaunay-flip-pieces.

    scaling.py [--quick] [--mesh random|grid] [--gpus 0,1 | --processes PROGRAM2] [--turns N]
               [--output scaling.json] PROGRAM

Strong scaling: one mesh (20 million points) in 1, 2, 4, 8 and 16 pieces, a rank with one thread
each, and undivided, with as many threads. It is a random bad mesh, the worst that we know, or
(--mesh grid) a grid with jitter. Weak scaling: 1.25 million points per piece. With --gpus the same
for pieces on these GPUs, and the undivided mesh on the first and on all of them. With --processes,
and delaunay-flip-processes, strong scaling also with processes of mpirun. All cases run once in
turn, then again (--turns, 3), so what slows the machine down for a while slows all of them; the
median of a case counts. Prints a table and what the cost model says of 64 nodes; the JSON has every
run.

of threads: the time of as many threads on the undivided mesh, divided by that of the pieces.
efficiency: the undivided time, or the weak time of one piece, divided by what ranks x time would be
if every rank had a core of its own; with fewer cores than ranks, the same of CPU times, which does
not count waiting.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys

PIECES = (1, 2, 4, 8, 16)
FULL = {"strong": 20_000_000, "weak": 1_250_000}
QUICK = {"strong": 320_000, "weak": 40_000}

# Assumed of a cluster, not measured: seconds per message, bytes per second and node.
LATENCY, BANDWIDTH = 5e-6, 10e9
NODES = 64


def plan(sizes, mesh, gpus, with_processes):
    """Settings of all cases, by name."""
    cases = {}
    devices = [f"devices={gpus}"] if gpus else []
    first = [f"devices={gpus.split(',')[0]}"] if gpus else []
    cases["undivided"] = [f"points={sizes['strong']}", "pieces=0", *first]
    if gpus:
        cases["undivided, all GPUs"] = [f"points={sizes['strong']}", "pieces=0", *devices]
    for pieces in PIECES:
        if not gpus and pieces > 1:
            cases[f"threads {pieces}"] = [
                f"points={sizes['strong']}", "pieces=0", f"threads={pieces}"]
        cases[f"strong {pieces}"] = [f"points={sizes['strong']}", f"pieces={pieces}", *devices]
        cases[f"weak {pieces}"] = [f"points={sizes['weak'] * pieces}", f"pieces={pieces}", *devices]
        if with_processes:
            cases[f"strong, processes {pieces}"] = cases[f"strong {pieces}"]
    if gpus:
        for pieces in (2, 4, 8):
            cases[f"one GPU {pieces}"] = [f"points={sizes['strong']}", f"pieces={pieces}", *first]
    return {name: [f"mesh={mesh}", *settings] for name, settings in cases.items()}


def measure(command, settings):
    text = subprocess.run([*command, *settings], check=True, capture_output=True, text=True).stdout
    return json.loads(text)


def get_command(name, options):
    """What runs a case."""
    if "processes" not in name:
        return [options.program]
    ranks = name.split()[-1]
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, options.processes]


def run_all(options, cases):
    runs = {name: [] for name in cases}
    for turn in range(options.turns):
        for name, settings in cases.items():
            run = measure(get_command(name, options), settings)
            runs[name].append(run)
            print(f"turn {turn + 1} of {options.turns}: {name}: {run['seconds']:.3f} s, "
                  f"CPU {run['cpu_seconds']:.3f} s", file=sys.stderr)
    return runs


def take_median(runs):
    """A run with the medians of all times; the counts are the same in all runs."""
    return {
        key: statistics.median(run[key] for run in runs) if key.endswith("seconds") else value
        for key, value in runs[0].items()
    }


def print_table(cases, cores):
    print("case | wall s | CPU s | in communication s | of threads | efficiency | rounds | "
          "seam edges | moved | MB sent by a rank")
    print("---|---|---|---|---|---|---|---|---|---")
    for name, case in cases.items():
        pieces = int(case["pieces"]) or int(case["threads"])
        base = cases["weak 1" if name.startswith("weak") else "undivided"]
        ideal = base["cpu_seconds"] * (pieces if name.startswith("weak") else 1)
        if cores >= pieces and not case["devices"]:
            ideal = base["seconds"] * (pieces if name.startswith("weak") else 1)
            share = ideal / (pieces * case["seconds"])
        else:
            share = ideal / case["cpu_seconds"]
        threads = cases.get("undivided" if pieces == 1 else f"threads {pieces}")
        has_rival = "strong" in name and threads
        rival = f"{threads['seconds'] / case['seconds']:.2f}" if has_rival else ""
        print(
            f"{name} | {case['seconds']:.3f} | {case['cpu_seconds']:.3f} | "
            f"{case['communication_seconds']:.3f} | {rival} | {share:.2f} | {case['rounds']} | "
            f"{case['seam_edges']} | {case['moved']} | {case['bytes_sent'] / 1e6:.1f}"
        )


def fit_model(cases):
    """Costs per triangle and per seam edge, from the weak cases: the fewest and the most pieces."""
    alone, many = cases["weak 1"], cases[f"weak {PIECES[-1]}"]
    ranks = PIECES[-1]
    triangles = many["triangles"] / ranks
    seams = 2 * many["seam_edges"] / ranks  # of a rank; each edge has two
    triangle = alone["cpu_seconds"] / alone["triangles"]
    in_rounds = max(0.0, many["cpu_seconds"] - triangle * many["triangles"])
    return {
        "seconds_per_triangle": triangle,
        "seconds_per_seam_edge": in_rounds / ranks / seams,
        "seam_edges_per_root_of_triangles": seams / math.sqrt(triangles),
        "bytes_per_seam_edge": many["bytes_sent"] / seams,
        "rounds": many["rounds"],
        "exchanges": many["exchanges"],
        "gathers": many["gathers"],
    }


def predict(model, triangles):
    """Seconds of a rank with so many triangles, a core each, on NODES nodes."""
    seams = model["seam_edges_per_root_of_triangles"] * math.sqrt(triangles)
    steps = model["exchanges"] * (NODES - 1) + 2 * model["gathers"] * math.ceil(math.log2(NODES))
    return {
        "flips": triangles * model["seconds_per_triangle"],
        "rounds": seams * model["seconds_per_seam_edge"],
        "latency": LATENCY * steps,
        "transfer": seams * model["bytes_per_seam_edge"] / BANDWIDTH,
    }


def print_model(model):
    print("\nmodel: " + ", ".join(f"{name} {value:.3g}" for name, value in model.items()))
    print(f"{NODES} nodes, assuming {LATENCY * 1e6:g} us per message and {BANDWIDTH / 1e9:g} GB/s:")
    for triangles in (1e6, 1e7, 1e8):
        parts = predict(model, triangles)
        total = sum(parts.values())
        text = ", ".join(f"{name} {seconds:.3g} s" for name, seconds in parts.items())
        print(f"  {triangles:.0e} triangles per core: {total:.3g} s ({text}), "
              f"efficiency {parts['flips'] / total:.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--quick", action="store_true", help="small meshes, for two cores")
    parser.add_argument("--mesh", choices=("random", "grid"), default="random")
    parser.add_argument("--gpus", default="", help="CUDA's numbers, separated by commas")
    parser.add_argument("--processes", help="delaunay-flip-processes")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--output", default="scaling.json")
    options = parser.parse_args()
    cases = plan(QUICK if options.quick else FULL, options.mesh, options.gpus, options.processes)
    runs = run_all(options, cases)
    medians = {name: take_median(case) for name, case in runs.items()}
    cores = len(os.sched_getaffinity(0))
    print(f"{medians['undivided']['machine']}; {cores} cores may be used\n")
    print_table(medians, cores)
    model = fit_model(medians)
    print_model(model)
    with open(options.output, "w", encoding="utf-8") as file:
        assumed = {"latency": LATENCY, "bandwidth": BANDWIDTH}
        json.dump({"runs": runs, "model": model, **assumed}, file, indent=1)


if __name__ == "__main__":
    main()
