#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# The experiments of the paper, and of its future work, in one command. In a source tree it installs
# what is missing (Debian) and builds into build-paper/ first; in a bundle (bundle_paper.sh) it runs
# the program beside it. Exit status: 0 done, 3 when the time limit left parts for another call.
set -euo pipefail

usage()
{
  cat <<'END'
Usage: reproduce_paper.sh [OPTION...] [OUTPUT]
Writes OUTPUT/report.md, plots/, results.json and parts/ (default: paper-output).
  --quick                meshes of up to 1 M points; on two cores less than 10 minutes
  --meshes FOLDER        surfaces (.ply, .stl, .vtk) for Fig. 11 and Table 2
  --time-limit SECONDS   stop after that; the next call goes on from there
  --parts PATTERN        run only parts with such names, a regular expression; for example, "gpu$"
  --no-rivals            without other people's programs, which pip would install
  --no-times             run every program once, for what is not time, on a busy machine
  --run-only             run the parts, and leave the drawing to another call
  --draw-only            run nothing; draw and write what is there
  --build-only           build the program and stop
A part that has run is not run again: remove its file from OUTPUT/parts for that.
END
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
output=paper-output scale=full rivals=yes draw=no build_only=no
options=()
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) scale=quick ;;
    --no-rivals) rivals=no ;;
    --build-only) build_only=yes ;;
    --no-times | --run-only) options+=("$1") ;;
    --draw-only)
      draw=yes
      options+=(--draw-only)
      ;;
    --meshes | --time-limit | --parts)
      options+=("$1" "${2:?$1 needs a value}")
      shift
      ;;
    --help)
      usage
      exit 0
      ;;
    -*)
      usage >&2
      exit 2
      ;;
    *) output=$1 ;;
  esac
  shift
done
export PYTHONDONTWRITEBYTECODE=1

# Usage: build - delaunay-flip-paper in build-paper/, for the GPU where there is a CUDA compiler.
build()
{
  export PATH=$PATH:${CUDA_HOME:-/usr/local/cuda}/bin
  cmake -S "$here/.." -B "$folder" -DCMAKE_BUILD_TYPE=Release -DDELAUNAYFLIP_BUILD_VTK=OFF \
    -DDELAUNAYFLIP_BUILD_TESTING=OFF -DDELAUNAYFLIP_BUILD_BENCHMARKS=ON \
    ${CUDA_ARCHITECTURES:+"-DCMAKE_CUDA_ARCHITECTURES=$CUDA_ARCHITECTURES"} >/dev/null
  cmake --build "$folder" --parallel "${JOBS:-2}" --target delaunay-flip-paper
}

# Usage: install_rivals - a virtual environment of our own. What does not install is absent; the
# report says so.
install_rivals()
{
  local package
  if [ ! -x "$venv/bin/pip" ] && ! python3 -m venv "$venv"; then
    echo "no virtual environment: the report will be without other people's programs"
    rm -rf "$venv"
    return
  fi
  for package in numpy matplotlib scipy triangle startinpy vtk meshlib; do
    if ! "$venv/bin/pip" install --quiet --disable-pip-version-check --prefer-binary "$package" \
      >>"$venv/install.log" 2>&1; then
      echo "absent: $package (see $venv/install.log)"
    fi
  done
}

# Usage: find_python - one that can draw.
find_python()
{
  local python
  for python in python3 /usr/bin/python3 "$venv/bin/python"; do
    if "$python" -c 'import matplotlib, numpy' 2>/dev/null; then
      echo "$python"
      return
    fi
  done
  echo python3 # runs the parts, and says that the report must be drawn elsewhere
}

if [ -x "$here/delaunay-flip-paper" ]; then
  folder=$here
  program=$here/delaunay-flip-paper
  export LD_LIBRARY_PATH=$here/libs${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  mkdir -p "$output"
  cp -rn "$here/meshes" "$output/" 2>/dev/null || echo "no surfaces in this bundle"
else
  folder=$(cd "$here/.." && pwd)/build-paper
  program=$folder/bin/delaunay-flip-paper
  if [ "$draw" = no ]; then
    "$here/install-packages.sh" paper
    build
  fi
fi
if [ "$build_only" = yes ]; then
  exit 0
fi
venv=$folder/rivals
if [ "$rivals" = yes ] && [ "$draw" = no ]; then
  install_rivals
fi
if [ "$rivals" = yes ] && [ -x "$venv/bin/python" ]; then
  options+=(--rivals "$venv/bin/python")
fi
exec "$(find_python)" "$here/paper/reproduce.py" "$output" --scale "$scale" --program "$program" \
  "${options[@]}"
