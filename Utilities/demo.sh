#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages (Debian), builds the command, the VTK modules and the Python package in
# build/, flips badly triangulated terrain, and draws the result. Writes to demo-output/.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
build="$root/build"
output="$root/demo-output"
python=/usr/bin/python3
export PYTHONDONTWRITEBYTECODE=1

step()
{
  printf '\n== %s\n' "$1"
}

# An existing build keeps its options. A new one has no tests, which need more packages. With a CUDA
# compiler it is for one architecture, which takes a quarter of the time; newer GPUs run its PTX.
build_all()
{
  local options=()
  [ -f "$build/CMakeCache.txt" ] ||
    options=(-G Ninja -DDELAUNAYFLIP_BUILD_TESTING=OFF -DCMAKE_CUDA_ARCHITECTURES=75)
  cmake -S "$root" -B "$build" -DPython3_EXECUTABLE=$python "${options[@]}" >/dev/null
  cmake --build "$build" --parallel "${JOBS:-2}"
}

step "Packages"
"$root/Utilities/install-packages.sh" demo

step "Build"
build_all

step "A terrain, triangulated without a thought"
mkdir -p "$output"
"$python" "$root/Utilities/make_terrain.py" "$output/before.vtp"

step "delaunay-flip before.vtp after.vtp --geometry planar-xy"
"$build/bin/delaunay-flip" "$output/before.vtp" "$output/after.vtp" --geometry planar-xy \
  --report "$output/report.json" --statistics "$output/iterations.csv"

step "Pictures"
"$python" "$root/Utilities/draw_demo.py" "$output"

cat <<END

Done. Look at
  $output/before_after.png   the terrain, its edges and its angles
  $output/iterations.png     the flips of every iteration
  $output/after.vtp          the mesh (before.vtp is the input; ParaView opens both)
  $output/report.json        the run in numbers
  $output/iterations.csv     the iterations in numbers
Your own mesh:
  $(printf %q "$build/bin/delaunay-flip") INPUT OUTPUT
In Python, from delaunayflip import vtkDelaunayFlip, after
  export PYTHONPATH=$(printf %q "$build/lib/python3/dist-packages")
END
