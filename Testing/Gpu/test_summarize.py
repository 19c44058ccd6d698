#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""summarize.py must not report skipped steps as passed, nor failed steps as skipped."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "summarize.py")

GPU = {"name": "A GPU", "compute_capability": "9.0", "multiprocessors": 132,
       "memory_bytes": 85 * 10**9, "cuda_runtime": "13.0", "cuda_of_driver": "13.0"}


def report(*results):
    """A GoogleTest report; a result is "COMPLETED", "SKIPPED" or "FAILED"."""
    tests = [{"name": f"test{i}", "result": "COMPLETED" if result == "FAILED" else result,
              **({"failures": [{}]} if result == "FAILED" else {})}
             for i, result in enumerate(results)]
    return {"testsuites": [{"name": "Suite", "testsuite": tests}]}


class Summary(unittest.TestCase):
    def summarize(self, gpu, steps, **files):
        """Exit status, results and last line for the files that run.sh would have left."""
        with tempfile.TemporaryDirectory() as folder:
            files["machine"] = {"machine": "A CPU", "cores": 2, "gpu": gpu}
            for name, content in files.items():
                with open(f"{folder}/{name.replace('_', '-')}.json", "w", encoding="utf-8") as file:
                    json.dump(content, file)
            with open(f"{folder}/steps.tsv", "w", encoding="utf-8") as file:
                file.writelines("\t".join(step) + "\n" for step in steps)
            with open(f"{folder}/benchmarks.log", "w", encoding="utf-8") as file:
                file.write("the table\n")
            command = [sys.executable, SCRIPT, folder]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(done.stderr, "")
            with open(f"{folder}/results.json", encoding="utf-8") as file:
                results = json.load(file)
        return done.returncode, results, done.stdout.splitlines()[-1]

    def test_all_is_well(self):
        steps = [("gpu-tests", "0", ""), ("sanitizer-memcheck", "0", ""), ("benchmarks", "0", "")]
        status, results, last = self.summarize(
            GPU, steps, gpu_tests=report("COMPLETED", "SKIPPED"), benchmarks={"rows": [{}]}
        )
        self.assertEqual((status, last), (0, "nothing failed"))
        counts = results["tests"]["gpu-tests"]
        self.assertEqual([counts[key] for key in ("passed", "failed", "skipped")], [1, 0, 1])
        self.assertEqual(results["sanitizer"], {"memcheck": "passed"})
        self.assertEqual(results["programs"], {})
        self.assertEqual(results["benchmarks"]["rows"], [{}])

    def test_no_gpu(self):
        steps = [("gpu-tests", "0", ""), ("sanitizer-memcheck", "skipped", "no GPU")]
        status, results, last = self.summarize(None, steps, gpu_tests=report("SKIPPED"))
        self.assertEqual((status, last), (0, "no GPU: skipped"))
        self.assertEqual(results["tests"]["gpu-tests"]["passed"], 0)
        self.assertEqual(results["sanitizer"], {"memcheck": "skipped: no GPU"})

    def test_programs(self):
        steps = [("filter-tests", "skipped", "no VTK"), ("c", "0", ""),
                 ("python-arrays", "skipped", "no CuPy")]
        status, results, last = self.summarize(GPU, steps)
        self.assertEqual((status, last), (0, "nothing failed"))
        self.assertEqual(results["tests"], {})
        self.assertEqual(results["programs"], {
            "filter-tests": "skipped: no VTK", "c": "passed", "python-arrays": "skipped: no CuPy"})

    def test_failures(self):
        for steps, reports in (
            ([("gpu-tests", "1", "")], {"gpu_tests": report("COMPLETED", "FAILED")}),
            ([("gpu-tests", "139", "")], {}),  # it crashed before it could write a report
            ([("sanitizer-racecheck", "86", "")], {}),
            ([("sanitizer-racecheck", "124", "")], {}),
            ([("c", "1", "")], {}),
            ([("benchmarks", "1", "")], {}),
        ):
            for gpu in (GPU, None):
                with self.subTest(steps=steps, gpu=gpu):
                    status, _, last = self.summarize(gpu, steps, **reports)
                    self.assertEqual((status, last), (1, "FAILED"))


if __name__ == "__main__":
    unittest.main()
