#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: build.sh [--only] BUILD_FOLDER [TARGET...] - used by run.sh and bundle.sh: builds the
# engine, its tests, the GPU benchmark and more targets; if there is VTK, also the tests of the
# filter, and the benchmark times it. Writes the real meshes in DELAUNAYFLIP_DATA_DIR (default: as
# CMake's) to BUILD_FOLDER/meshes, if they and VTK's Python package exist. With --only builds the
# GPU benchmark and the targets alone. JOBS: the number of compilers at a time; CUDA_ARCHITECTURES:
# CMake's list of them.
set -euo pipefail

only=no
if [ "$1" = --only ]; then
  only=yes
  shift
fi
build=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
root=$(cd "$here/../.." && pwd)
export PATH=$PATH:${CUDA_HOME:-/usr/local/cuda}/bin

options=(-DCMAKE_BUILD_TYPE=Release -DDELAUNAYFLIP_ENABLE_CUDA=ON
  -DDELAUNAYFLIP_BUILD_TESTING=ON -DDELAUNAYFLIP_BUILD_BENCHMARKS=ON
  ${CUDA_ARCHITECTURES:+"-DCMAKE_CUDA_ARCHITECTURES=$CUDA_ARCHITECTURES"})
if [ ! -f "$build/CMakeCache.txt" ] && command -v ninja >/dev/null; then
  options+=(-G Ninja)
fi
targets=(DelaunayFlipGpuTests DelaunayFlipCoreTests DelaunayFlipAskTests delaunay-flip-gpu-benchmark
  delaunay-flip-point-benchmark delaunay-flip-fuzz-points DelaunayFlipC
  delaunayflip-c-device-test "${@:2}")
if cmake -S "$root" -B "$build" "${options[@]}" -DDELAUNAYFLIP_BUILD_VTK=ON; then
  targets+=(DelaunayFlipCxxTests)
else
  echo "no VTK found: only the engine will be tested and benchmarked"
  cmake -S "$root" -B "$build" "${options[@]}" -DDELAUNAYFLIP_BUILD_VTK=OFF
fi
if [ "$only" = yes ]; then targets=(delaunay-flip-gpu-benchmark "${@:2}"); fi
cmake --build "$build" --parallel "${JOBS:-2}" --target "${targets[@]}"
if [ "$only" = yes ]; then exit; fi

data=${DELAUNAYFLIP_DATA_DIR:-$(sed -n 's/^DELAUNAYFLIP_DATA_DIR:PATH=//p' "$build/CMakeCache.txt")}
if [ ! -d "$data" ]; then
  echo "no real meshes: no folder $data (DELAUNAYFLIP_DATA_DIR)"
  exit
fi
for python in python3 /usr/bin/python3; do # the system's may not be the first
  if "$python" -c 'import numpy, vtkmodules.vtkIOGeometry' 2>/dev/null; then
    exec "$python" "$here/export_meshes.py" "$data" "$build/meshes"
  fi
done
echo "no real meshes: no Python with VTK and numpy to read them (Debian: python3-vtk9)"
