#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: list_failed_tests.py BUILD_FOLDER...
Prints the names of the tests that failed, each with the last lines of its output. test.sh ends with
them, so that nobody has to look for them among thousands of tests."""
import os
import sys
import xml.etree.ElementTree

LINES = 15


def list_failed(path):
    """Pairs (name, output)."""
    suite = xml.etree.ElementTree.parse(path).getroot()
    return [(case.get("name"), case.findtext("system-out", ""))
            for case in suite.iter("testcase") if case.get("status") == "fail"]


def main(folders):
    for folder in folders:
        path = os.path.join(folder, "junit.xml")
        for name, output in list_failed(path) if os.path.exists(path) else []:
            last = "".join(f"  {line}\n" for line in output.splitlines()[-LINES:])
            print(f"\nfailed in {os.path.basename(folder)}: {name}\n{last}")


if __name__ == "__main__":
    main(sys.argv[1:])
