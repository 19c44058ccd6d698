# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a reproduction: each is a command that writes one JSON file and ends within nine
minutes."""

from dataclasses import dataclass

LONGEST = 540  # seconds that a part may take

EPSILONS = (1e-7, 1e-6, 1e-5, 1e-4, 5e-4, 1e-3)
FEATURE_ANGLES = (20, 30, 60, 180)
SURFACE_THRESHOLD = 30  # degrees; the paper does not say which it took


@dataclass(frozen=True)
class Part:
    """A command. {program}, {rivals}, {python} and {folder} in it are replaced by programs and the
    folder of its files; --output FILE is added at its end."""

    name: str
    what: str
    command: tuple
    seconds: float  # estimated time on a machine with two cores
    group: str = ""  # after a failure, later parts of the same group are skipped


@dataclass(frozen=True)
class Scale:
    """How large a reproduction is."""

    name: str
    sizes: tuple  # points of the random bad meshes
    gpu_sizes: tuple  # more of them, for a GPU alone
    largest_quality: int
    largest_rival: int
    chain: tuple  # triangles
    tests: int  # points
    ruined: int
    surface: int
    timing: tuple


SCALES = {
    "test": Scale("test", (1000, 2000, 4000), (), 2000, 2000, (6, 10, 50), 1000, 1500, 3000,
                  ("--repetitions", "1", "--seconds", "1")),
    "quick": Scale("quick", (100_000, 300_000, 1_000_000), (), 100_000, 300_000,
                   (6, 10, 30, 100, 300, 1000), 20_000, 20_000, 100_000,
                   ("--repetitions", "3", "--seconds", "8")),
    "full": Scale("full", (100_000, 250_000, 500_000, 1_000_000, 2_000_000, 5_000_000),
                  (20_000_000, 100_000_000), 5_000_000, 5_000_000,
                  (6, 10, 30, 100, 300, 1000, 3000, 10_000), 1_000_000, 200_000, 1_586_302,
                  ("--repetitions", "5", "--seconds", "10")),
}

# Approximate seconds of one run with a million points on two idle cores, from which the times of
# the parts are estimated.
PROGRAM_SECONDS = {
    "ours-gpu": 0.05, "ours-1": 1, "ours-all": 0.6, "no-chunks": 1.5, "paper-gpu": 0.2,
    "paper-1": 14, "paper-all": 8, "lawson": 4, "cgal": 0.7,
}
RIVAL_SECONDS = {"scipy": 8, "triangle": 2.5, "startinpy": 30, "vtk": 200}
# Beyond these numbers of points, single runs take longer than a part may; the time grows almost with
# their square.
RIVAL_LARGEST = {"vtk": 100_000, "startinpy": 1_000_000}


def format_count(count):
    if count >= 1_000_000:
        return f"{count / 1e6:g} M"
    return f"{count:,}"


class Plan:
    """The parts of a reproduction, in the order in which they run."""

    def __init__(self, scale, has_gpu, rivals, meshes):
        self.scale, self.has_gpu, self.rivals, self.meshes = scale, has_gpu, rivals, meshes
        self.parts = []
        self.add_figures()
        self.add_surfaces()
        self.add_future_work()
        self.add_rivals()

    def add(self, name, what, arguments, seconds, **more):
        gpu = ("--gpu",) if self.has_gpu else ()
        command = ("{program}", *map(str, arguments), *self.scale.timing, *gpu)
        self.parts.append(Part(name, what, command, seconds, **more))

    def add_figures(self):
        self.add("chain", "Fig. 6, the worst case",
                 ("chain", "--triangles", ",".join(map(str, self.scale.chain))), 10)
        for size in self.scale.sizes:
            self.add_random(size, self.groups_of(size))
        if self.has_gpu:
            for size in self.scale.gpu_sizes:
                self.add_random(size, (("ours-gpu", "paper-gpu"), ("ours-all",)))
        for size in (s for s in self.scale.sizes if s <= self.scale.largest_quality):
            self.add_quality(size)

    def groups_of(self, size):
        """Groups the programs into parts: all in one part only if they are quick."""
        gpu = (("ours-gpu", "paper-gpu"),) if self.has_gpu else ()
        groups = (("ours-1", "ours-all", "no-chunks"), ("paper-all",), ("lawson", "cgal"))
        if self.scale.name == "full":
            groups += (("paper-1",),)
        if size <= 100_000:
            return (sum(gpu + groups, ()),)
        return gpu + groups

    def add_random(self, size, groups):
        for programs in groups:
            seconds = size / 1e6 * (2 + sum(4 * PROGRAM_SECONDS[name] for name in programs))
            self.add(f"random-{size}-{programs[0]}",
                     f"Fig. 8a, {format_count(size)} points: {', '.join(programs)}",
                     ("random", "--points", size, "--programs", ",".join(programs)),
                     2 + seconds)

    def add_quality(self, size):
        if size not in (self.scale.sizes[0], 1_000_000, self.scale.largest_quality):
            return
        groups = (EPSILONS,) if size <= 100_000 else tuple((e,) for e in EPSILONS)
        for epsilons in groups:
            name = f"quality-{size}" + (f"-{epsilons[0]:g}" if len(epsilons) == 1 else "")
            self.add(name, f"Fig. 8b, {format_count(size)} points",
                     ("quality", "--points", size, "--epsilons", ",".join(map(str, epsilons))),
                     5 + size / 1e6 * 40 * len(epsilons))

    def add_surfaces(self):
        for mesh in self.meshes:
            self.add(f"surface-{mesh}", f"Fig. 11 and Table 2, {mesh}",
                     ("surface", "--mesh", "{folder}/meshes/" + mesh + ".dfmesh", "--threshold",
                      SURFACE_THRESHOLD), 5 + self.scale.surface / 1e6 * 100)

    def add_future_work(self):
        for mesh in ("random", "grid", "circles", "offset"):
            self.add(f"tests-{mesh}", f"in-circle against opposite angles, {mesh}",
                     ("tests", "--mesh", mesh, "--points", self.scale.tests),
                     2 + self.scale.tests / 1e6 * 300)
        angles = ",".join(map(str, FEATURE_ANGLES))
        for kind in ("flips", "splits", "anisotropic"):
            self.add(f"ruined-{kind}", f"bad surfaces, ruined by {kind}",
                     ("ruined", "--kind", kind, "--points", self.scale.ruined,
                      "--feature-angles", angles), 5 + self.scale.ruined / 1e6 * 300)
        for mesh in (mesh for mesh in self.meshes if not mesh.endswith("torus")):
            self.add(f"ruined-{mesh}", f"{mesh} as it is, over the feature angle",
                     ("as-it-is", "--mesh", "{folder}/meshes/" + mesh + ".dfmesh",
                      "--feature-angles", angles), 10)

    def add_rivals(self):
        for rival, size in ((r, s) for r in self.rivals if r in RIVAL_SECONDS
                            for s in self.scale.sizes):
            if size > min(self.scale.largest_rival, RIVAL_LARGEST.get(rival, size)):
                continue
            command = ("{rivals}", rival, "--points", str(size), "--program", "{program}",
                       *self.scale.timing)
            self.parts.append(Part(f"rival-{size}-{rival}",
                                   f"Fig. 8a, {format_count(size)} points: {rival}", command,
                                   2 + 3 * RIVAL_SECONDS[rival] * size / 1e6, group=rival))
        if "meshlib" in self.rivals:
            for mesh in self.meshes:
                path = "{folder}/meshes/" + mesh + ".dfmesh"
                command = ("{rivals}", "meshlib", "--mesh", path, *self.scale.timing)
                self.parts.append(Part(f"meshlib-{mesh}", f"Fig. 11, {mesh}: MeshLib", command,
                                       3 + self.scale.surface / 1e6 * 30, group="meshlib"))
