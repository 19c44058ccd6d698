#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_layering.py ROOT

Includes point downwards only. Within the engine: public headers, then its rooms, in the order that
Engine/CMakeLists.txt gives both, with CUDA/ below the last room, then the other files at the root of
Engine/. Above the engine: CInterface, Filters, FiltersParallel, Rendering, Command and Plugin see its public headers, the
latter four the filters; nothing that ships sees Testing or Examples. The engine sees no VTK and no OpenGL.
It and CInterface see the operating system only in Engine/System.
Within the folders of LAYERED, a header and the source of the same name are one topic, and no two topics include each
other, directly or through others: one of the includes would point upwards.
"""

import os
import re
import sys

from check_files import CPP_SUFFIXES, finish, list_files, read

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)

# Headers of an operating system.
SYSTEM = re.compile(r"(sys|mach|linux)/.*|(unistd|dlfcn|pthread|sched|signal|fcntl|malloc|windows|io)\.h",
                    re.IGNORECASE)

PUBLIC = "the engine's public headers"
ROOT = "Engine"  # the files at its root, except the public headers

# Layers above the engine, and what they may include.
ABOVE = {
    "CInterface": {PUBLIC, "CInterface"},
    "Filters": {PUBLIC, "Filters"},
    "FiltersParallel": {PUBLIC, "Filters", "FiltersParallel"},
    "Rendering": {PUBLIC, "Filters", "Rendering"},
    "Command": {PUBLIC, "Filters", "Command"},
    "Plugin": {PUBLIC, "Filters", "FiltersParallel", "Plugin"},
    "Examples": {PUBLIC, "CInterface", "Filters", "FiltersParallel", "Rendering", "Examples"},
}

# Folders in which the files have layers of their own.
LAYERED = {"Filters", "FiltersParallel", "Rendering"}


def read_list(root, name):
    """The words of `set(name ...)` in Engine/CMakeLists.txt."""
    text = re.sub(r"#.*", "", read(root, "Engine/CMakeLists.txt"))
    return re.search(rf"set\({name}\s+([^)]*)\)", text).group(1).split()


class Layers:
    """Which layer a file belongs to, and which layers each may include."""

    def __init__(self, root):
        self.public = set(read_list(root, "delaunayflip_engine_headers"))
        rooms = read_list(root, "delaunayflip_engine_rooms")
        floors = [f"Engine/{room}" for room in rooms]
        self.floors = [PUBLIC, *floors[:-1], "CUDA", floors[-1], ROOT]

    def of(self, path):
        folder, name = os.path.split(path)
        if folder == "Engine" and name in self.public:
            return PUBLIC
        if folder == "Engine" or folder in self.floors:
            return folder
        return path.split("/", 1)[0] if "/" in path else ""

    def below(self, layer):
        """The layers that `layer` may include; None where anything goes."""
        if layer in self.floors:
            return set(self.floors[: self.floors.index(layer) + 1])
        return ABOVE.get(layer)


def violations(layers, path, name, home):
    """Problems with `path` including `name`; `home` maps header names to layers."""
    layer, header = layers.of(path), os.path.basename(name)
    below = layers.below(layer)
    if below is None:
        return
    if layer in layers.floors and header.lower().startswith("vtk"):
        yield f"{path}: the engine includes {name} of VTK"
    if layer in layers.floors and (name.startswith(("GL/", "EGL/")) or "cuda_gl" in name):
        yield f"{path}: the engine includes {name} of OpenGL"
    if layer in {*layers.floors, "CInterface"} - {"Engine/System"} and SYSTEM.fullmatch(name):
        yield f"{path}: {layer} includes {name} of an operating system; only Engine/System may"
    target = home.get(header)
    if target is not None and target not in below:
        yield f"{path}: {layer} includes {name} of {target}"


def circles(includes):
    """Problems with topics that include each other; `includes` maps each to the topics that it includes."""
    reached = {}
    for topic in includes:
        reached[topic], todo = set(), [topic]
        while todo:
            new = includes.get(todo.pop(), set()) - reached[topic]
            reached[topic] |= new
            todo.extend(new)
    for topic in sorted(includes):
        for other in sorted(includes[topic]):
            if topic in reached.get(other, ()):
                yield f"{topic}: includes {other}, which includes it, directly or through others"


def find_topics(layers, paths, texts):
    """For each topic in a layered folder, the topics of the same layer that it includes."""
    headers = {os.path.basename(path): path for path in paths if path.endswith((".h", ".cuh"))}
    topics = {}
    for path in paths:
        topic, layer = os.path.splitext(path)[0], layers.of(path)
        if layer not in LAYERED:
            continue
        for name in INCLUDE.findall(texts[path]):
            target = headers.get(os.path.basename(name), "")
            other = os.path.splitext(target)[0]
            if layers.of(target) == layer and other != topic:
                topics.setdefault(topic, set()).add(other)
    return topics


def main():
    root = sys.argv[1]
    layers = Layers(root)
    paths = [path for path in list_files(root) if path.endswith(CPP_SUFFIXES)]
    headers = [path for path in paths if path.endswith((".h", ".cuh"))]
    home = {os.path.basename(path): layers.of(path) for path in headers}
    texts = {path: read(root, path) for path in paths}
    problems = [
        problem
        for path in paths
        for name in INCLUDE.findall(texts[path])
        for problem in violations(layers, path, name, home)
    ]
    problems.extend(circles(find_topics(layers, paths, texts)))
    finish("layering", problems)


if __name__ == "__main__":
    main()
