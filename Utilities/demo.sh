#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages (Debian), builds the command in build/, flips badly triangulated terrain,
# and draws the result. Writes to demo-output/. Each phase says how long the demo has run.
# In a new build/ the engine, which needs no VTK, is compiled while VTK is downloaded and unpacked.
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

# Prints the options of a new build, one a line. The CUDA backend takes long to compile, so it is
# built only where it can run, and for the GPU that is here. The tests need more packages.
list_options()
{
  echo -GNinja
  echo -DDELAUNAYFLIP_BUILD_TESTING=OFF
  echo -DDELAUNAYFLIP_PRECOMPILE=ON
  if has_gpu; then
    echo -DDELAUNAYFLIP_CUDA_FOR_THIS_MACHINE=ON
  else
    echo -DDELAUNAYFLIP_ENABLE_CUDA=OFF
  fi
}

# The whole build takes its objects. With `nice`, packages go first where processors are few.
compile_engine()
{
  cmake -S "$root" -B "$build" "${options[@]}" -DDELAUNAYFLIP_BUILD_VTK=OFF
  nice cmake --build "$build" --parallel "$jobs" --target DelaunayFlipEngine
}

# In a process group of its own, which `stop_engine` ends whatever it is doing.
start_engine()
{
  mkdir -p "$build"
  set -m
  compile_engine </dev/null >"$log" 2>&1 &
  set +m
  engine=$!
}

# shellcheck disable=SC2317 # a trap calls it
stop_engine()
{
  [ -n "$engine" ] || return 0
  kill -- "-$engine" 2>/dev/null || true
  wait "$engine" 2>/dev/null || true
}

# Shows what is left to compile.
await_engine()
{
  tail -n 1 -f --pid="$engine" "$log"
  if ! wait "$engine"; then
    engine=
    tail -n 20 "$log" >&2
    echo "The engine does not compile: see $log" >&2
    exit 1
  fi
  engine=
}

log="$build/engine.log"
engine= # the process that compiles it
options=()
trap stop_engine EXIT

if [ -f "$build/CMakeCache.txt" ]; then
  step "Packages: a compiler, VTK and Matplotlib, as far as they are missing"
  "$root/Utilities/install-packages.sh" demo
  echo "build/ exists and keeps its options; VTK is switched on"
else
  step "Packages: a compiler and what the engine needs, as far as they are missing"
  "$root/Utilities/install-packages.sh" engine
  mapfile -t options < <(list_options)
  if has_gpu; then
    echo "with CUDA if its compiler is here, since this machine has a GPU"
  else
    echo "without CUDA, since this machine has no NVIDIA GPU (nvidia-smi lists none)"
  fi
  step "Packages: VTK and Matplotlib. Meanwhile the engine is compiled; see $log"
  start_engine
  "$root/Utilities/install-packages.sh" demo
  step "The rest of the engine, with $jobs jobs"
  await_engine
fi

step "Build of the command, with $jobs jobs: a minute on two cores"
cmake -S "$root" -B "$build" -DPython3_EXECUTABLE=$python "${options[@]}" \
  -DDELAUNAYFLIP_BUILD_VTK=ON >/dev/null
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
