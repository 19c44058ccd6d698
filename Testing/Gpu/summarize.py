#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: summarize.py FOLDER

Makes results.json and results.txt from the files that run.sh left in FOLDER, and prints a summary
without the table of the benchmarks, which has been printed already. Exits with 0 if nothing failed,
else with 1.
"""

import json
import os
import platform
import subprocess
import sys

SANITIZER_FINDINGS = 86  # the exit status that run.sh sets for compute-sanitizer
TIMED_OUT = 124


def load(folder, name):
    """The content of a JSON file, or None if it is missing or incomplete."""
    try:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def load_steps(folder):
    """(name, status, reason) of every step; the status is a number or "skipped"."""
    with open(os.path.join(folder, "steps.tsv"), encoding="utf-8") as file:
        return [tuple(line.rstrip("\n").split("\t")) for line in file]


def driver_version():
    command = ["nvidia-smi", "--query-gpu=driver_version", "--format=csv,noheader"]
    try:
        output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    return output.split("\n", 1)[0].strip() or None


def count_tests(report, status):
    """Tests passed, failed and skipped of one GoogleTest program, and the names of the failed."""
    tests = [(f"{suite['name']}.{test['name']}", "FAILED" if test.get("failures") else
              test["result"]) for suite in report["testsuites"] for test in suite["testsuite"]]
    failed = [name for name, result in tests if result == "FAILED"]
    if status != "0" and not failed:
        failed = [f"the program ended with status {status}"]
    passed = sum(result == "COMPLETED" for _, result in tests)
    skipped = sum(result not in ("COMPLETED", "FAILED") for _, result in tests)
    return {"passed": passed, "failed": len(failed), "skipped": skipped, "failed_tests": failed,
            "status": status}


def judge(status, reason):
    if status == "skipped":
        return f"skipped: {reason}"
    if status == "0":
        return "passed"
    what = {SANITIZER_FINDINGS: "findings", TIMED_OUT: "took too long"}
    return "FAILED: " + what.get(int(status), f"exit status {status}")


def collect(folder):
    machine = load(folder, "machine.json") or {}
    about = {"processor": machine.get("machine"), "cores": machine.get("cores"),
             "system": platform.platform()}
    results = {"machine": about, "gpu": machine.get("gpu"), "tests": {}, "programs": {},
               "sanitizer": {}, "benchmarks": None}
    if results["gpu"]:
        results["gpu"]["driver"] = driver_version()
    for name, status, reason in load_steps(folder):
        if name == "benchmarks":
            rows = (load(folder, "benchmarks.json") or {}).get("rows", [])
            results["benchmarks"] = {"status": status, "rows": rows}
        elif name.startswith("sanitizer-"):
            results["sanitizer"][name.split("-", 1)[1]] = judge(status, reason)
        elif report := load(folder, f"{name}.json"):
            results["tests"][name] = count_tests(report, status)
        else:
            results["programs"][name] = judge(status, reason)
    return results


def describe_machine(results):
    machine, gpu = results["machine"], results["gpu"]
    yield f"machine: {machine['processor']}; {machine['system']}"
    if not gpu:
        yield "GPU: none"
        return
    yield (
        f"GPU: {gpu['name']}, compute capability {gpu['compute_capability']}, "
        f"{gpu['multiprocessors']} multiprocessors, {gpu['memory_bytes'] / 2**30:.0f} GiB; "
        f"driver {gpu['driver']} (CUDA {gpu['cuda_of_driver']}), runtime {gpu['cuda_runtime']}"
    )


def describe_checks(results):
    for name, counts in results["tests"].items():
        yield (f"{name}: {counts['passed']} passed, {counts['failed']} failed, "
               f"{counts['skipped']} skipped")
        yield from (f"  FAILED {test}" for test in counts["failed_tests"])
    for program, verdict in results["programs"].items():
        yield f"{program}: {verdict}"
    for tool, verdict in results["sanitizer"].items():
        yield f"compute-sanitizer {tool}: {verdict}"


def verdict_of(results):
    verdicts = [*results["programs"].values(), *results["sanitizer"].values()]
    if (any(counts["failed"] for counts in results["tests"].values())
            or any(verdict.startswith("FAILED") for verdict in verdicts)
            or (results["benchmarks"] or {"status": "0"})["status"] != "0"):
        return "FAILED"
    return "nothing failed" if results["gpu"] else "no GPU: skipped"


def table_of(folder, results):
    """The benchmark's own table, if it ran."""
    if results["benchmarks"] is None:
        return
    with open(os.path.join(folder, "benchmarks.log"), encoding="utf-8") as file:
        yield from file.read().splitlines()
    if results["benchmarks"]["status"] != "0":
        yield f"FAILED: the benchmarks ended with status {results['benchmarks']['status']}"
    yield ""


def main():
    folder = sys.argv[1]
    results = collect(folder)
    results["verdict"] = verdict_of(results)
    with open(os.path.join(folder, "results.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)
        file.write("\n")
    summary = [*describe_checks(results), results["verdict"]]
    lines = [*describe_machine(results), "", *table_of(folder, results), *summary]
    with open(os.path.join(folder, "results.txt"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    print("\n".join([*describe_machine(results), *summary]))
    sys.exit(1 if results["verdict"] == "FAILED" else 0)


if __name__ == "__main__":
    main()
