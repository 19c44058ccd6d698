# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Run by test_live.py in pvbatch. Flips the mesh of a file with live update on and prints the
result."""

import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["DELAUNAYFLIP_PLUGIN"], remote=False)
flip = simple.DelaunayFlip(Input=simple.XMLPolyDataReader(FileName=[sys.argv[1]]), LiveUpdate=1)
flip.UpdatePipeline()
flip.SMProxy.UpdatePipelineInformation()
print("stopped:", flip.StopReason, flush=True)
