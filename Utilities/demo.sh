#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages (Debian), builds the command in build/, flips badly triangulated terrain,
# and draws the result. Writes to demo-output/. Each phase says how long the demo has run.
# JOBS in the environment is the number of compilers that run at a time (default: one per core).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
build="$root/build"
output="$root/demo-output"
python=/usr/bin/python3
jobs=${JOBS:-$(nproc)}
export PYTHONDONTWRITEBYTECODE=1
export NINJA_STATUS="[%f/%t, %e s] "

step()
{
  printf '\n== %d:%02d  %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$1"
}

has_gpu()
{
  nvidia-smi --list-gpus 2>/dev/null | grep -q .
}

# The CUDA backend takes long to compile, so it is built only where it can run, and for the GPU that
# is here. An existing build keeps its options. The tests need more packages.
configure()
{
  local options=()
  if [ -f "$build/CMakeCache.txt" ]; then
    echo "build/ exists and keeps its options"
  elif has_gpu; then
    echo "with CUDA if its compiler is here, since this machine has a GPU"
    options=(-G Ninja -DDELAUNAYFLIP_BUILD_TESTING=OFF -DDELAUNAYFLIP_CUDA_FOR_THIS_MACHINE=ON)
  else
    echo "without CUDA, since this machine has no NVIDIA GPU (nvidia-smi lists none)"
    options=(-G Ninja -DDELAUNAYFLIP_BUILD_TESTING=OFF -DDELAUNAYFLIP_ENABLE_CUDA=OFF)
  fi
  cmake -S "$root" -B "$build" -DPython3_EXECUTABLE=$python "${options[@]}" >/dev/null
}

step "Packages: a compiler, VTK and Matplotlib, as far as they are missing"
"$root/Utilities/install-packages.sh" demo

step "Build of the command, with $jobs jobs: one to three minutes on two cores"
configure
cmake --build "$build" --parallel "$jobs" --target delaunay-flip

step "Terrain of 100,000 points, badly triangulated"
mkdir -p "$output"
"$python" "$root/Utilities/make_terrain.py" "$output/before.vtp"

step "delaunay-flip before.vtp after.vtp --geometry planar-xy"
"$build/bin/delaunay-flip" "$output/before.vtp" "$output/after.vtp" --geometry planar-xy \
  --report "$output/report.json" --statistics "$output/iterations.csv"

step "Pictures, by Matplotlib"
"$python" "$root/Utilities/draw_demo.py" "$output"

step "Done. Look at"
cat <<END
  $output/before_after.png   the terrain, its edges and its angles
  $output/iterations.png     the flips of every iteration
  $output/after.vtp          the mesh (before.vtp is the input; ParaView opens both)
  $output/report.json        the run in numbers
  $output/iterations.csv     the iterations in numbers
Your own mesh:
  $(printf %q "$build/bin/delaunay-flip") INPUT OUTPUT
The rest, for C++ and Python, takes half a minute more:
  cmake --build $(printf %q "$build") --parallel $jobs
  export PYTHONPATH=$(printf %q "$build/lib/python3/dist-packages")
END
