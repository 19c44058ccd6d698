#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_layering.py ROOT

Includes point downwards only: CUDA knows no VTK, Filters knows CUDA's public headers, Rendering
knows Filters alone, Command knows CUDA's public headers and Filters, Plugin knows none of them;
nothing that ships knows Testing or Examples.
"""

import os
import re
import sys

from source_tree import CPP_SUFFIXES, finish, list_files, read

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)

# The headers of the engine that other layers may include; they include only each other.
DOORS = {
    "CudaDevice.h",
    "DelaunayFlip.h",
    "FlipError.h",
    "FlipOptions.h",
    "FlipReport.h",
    "HostDevice.h",
    "MeshAudit.h",
    "PolygonSplit.h",
    "Predicates.h",
    "TriangleMesh.h",
}

# Layer: the layers that it may include.
BELOW = {
    "CUDA": {"CUDA"},
    "Filters": {"CUDA", "Filters"},
    "Rendering": {"Filters", "Rendering"},
    "Command": {"CUDA", "Filters", "Command"},
    "Plugin": {"Plugin"},
    "Examples": {"CUDA", "Filters", "Rendering", "Examples"},
}


def layer_of(path):
    return path.split("/", 1)[0] if "/" in path else ""


def violations(path, name, home):
    """What is wrong with file `path` including `name`; `home` maps header names to layers."""
    layer, header = layer_of(path), os.path.basename(name)
    if layer == "CUDA" and header.lower().startswith("vtk"):
        yield f"{path}: the engine includes {name} of VTK"
    target = home.get(header)
    if target is None:
        return
    if target not in BELOW[layer]:
        yield f"{path}: {layer} includes {name} of {target}"
    elif target == "CUDA" and header not in DOORS:
        if layer != "CUDA":
            yield f"{path}: {name} is internal to CUDA"
        elif os.path.basename(path) in DOORS:
            yield f"{path}: a public header includes the internal {name}"


def main():
    root = sys.argv[1]
    paths = [path for path in list_files(root) if path.endswith(CPP_SUFFIXES)]
    home = {os.path.basename(path): layer_of(path) for path in paths if path.endswith(".h")}
    problems = [
        problem
        for path in paths
        if layer_of(path) in BELOW
        for name in INCLUDE.findall(read(root, path))
        for problem in violations(path, name, home)
    ]
    finish("layering", problems)


if __name__ == "__main__":
    main()
