# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""How tests start programs on several ranks, more than there are free cores if need be.

It is also a program: launching.py RANKS PROGRAM [ARGUMENT...] runs PROGRAM. The exit status is that of
mpirun, or 125, skipped, without mpirun.
"""
import os
import shutil
import subprocess
import sys

HAS_MPIRUN = shutil.which("mpirun") is not None


def launch(ranks):
    """The command that starts the program which follows it."""
    command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1"]
    library = os.environ.get("DELAUNAYFLIP_SLEEPING_YIELD")
    # With a rank on every core, whatever else runs, such as other tests, makes ranks wait.
    if library and ranks >= (os.cpu_count() or 1):
        command += ["-x", "LD_PRELOAD=" + library]
    return [*command, "-n", str(ranks)]


def make_environment():
    """For mpirun, even where the caller runs under MPI itself, as pvpython does: within a run, mpirun
    would start no other."""
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_", "OPAL_"))}
    # Open MPI's hwloc would look for GPUs at every X server, and die with one that other tests end.
    environment["HWLOC_COMPONENTS"] = "-gl"
    return environment


def main():
    if not HAS_MPIRUN:
        print("skipped: no mpirun")
        sys.exit(125)
    command = [*launch(int(sys.argv[1])), *sys.argv[2:]]
    sys.exit(subprocess.run(command, env=make_environment(), check=False).returncode)


if __name__ == "__main__":
    main()
