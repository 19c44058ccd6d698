# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Run by test_parallel.py: parallel_batch.py FOLDER [PORT], in pvbatch on any number of ranks, or in
pvpython as the client of a server at the port.

Writes what the filter says of each case to FOLDER/facts.json, and files of the ranks beside it.
"""

import json
import os
import sys

from paraview import simple

import parallel_cases

if len(sys.argv) > 2:
    simple.Connect("127.0.0.1", int(sys.argv[2]))
    simple.LoadPlugin(os.environ["DELAUNAYFLIP_PLUGIN"], remote=True)
simple.LoadPlugin(os.environ["DELAUNAYFLIP_PLUGIN"], remote=False)
facts = {case: parallel_cases.run(case, sys.argv[1]) for case in parallel_cases.CASES}
with open(os.path.join(sys.argv[1], "facts.json"), "w", encoding="utf-8") as file:
    json.dump(facts, file)
print("all is well", flush=True)
