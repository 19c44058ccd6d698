#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs what needs a GPU that both CUDA and OpenGL use: the tests of drawing without copies, in
# windows of EGL, and the benchmark of frames. In a source tree it first builds into build-gpu/; in a
# bundle (bundle_window.sh) it runs the programs beside it. Results are written as they come, to
# window-*.log and window-benchmark.json in the output folder, and a line per step to the screen. The
# exit status is 0 only if nothing failed. Without such a GPU everything is reported as skipped.
set -euo pipefail

usage()
{
  cat <<'END'
Usage: run_window.sh [OPTION...] [OUTPUT_FOLDER]
  --tests-only        no benchmark
  --benchmarks-only   no tests
  --quick             a small mesh and few frames
OUTPUT_FOLDER: default ./window-results
END
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
output=window-results
tests=yes benchmarks=yes quick=no
for argument in "$@"; do
  case "$argument" in
    --tests-only) benchmarks=no ;;
    --benchmarks-only) tests=no ;;
    --quick) quick=yes ;;
    --help)
      usage
      exit 0
      ;;
    -*)
      usage >&2
      exit 2
      ;;
    *) output=$argument ;;
  esac
done
mkdir -p "$output"
output=$(cd "$output" && pwd)

# Usage: find_driver - the folder of NVIDIA's EGL, where the loader does not know it.
find_driver()
{
  local folder
  for folder in /usr/local/nvidia/lib64 /usr/local/nvidia/lib /usr/lib/x86_64-linux-gnu; do
    if [ -e "$folder/libEGL_nvidia.so.0" ]; then
      echo "$folder"
      return
    fi
  done
}

if [ -x "$here/DelaunayFlipWindowTests" ]; then
  programs=$here
  driver=$(find_driver)
  export LD_LIBRARY_PATH=$here/libs${driver:+:$driver}${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
else
  build=$(cd "$here/../.." && pwd)/build-gpu
  "$here/build.sh" "$build"
  cmake --build "$build" --parallel "${JOBS:-2}" \
    --target DelaunayFlipWindowTests delaunay-flip-window-benchmark SwellingSurface
  programs=$build/bin
fi
# A machine without a display often has the driver's EGL, but not the file that names it.
if ! ls /usr/share/glvnd/egl_vendor.d/*nvidia* /etc/glvnd/egl_vendor.d/*nvidia* >/dev/null 2>&1; then
  echo '{"file_format_version": "1.0.0", "ICD": {"library_path": "libEGL_nvidia.so.0"}}' \
    >"$output/egl_nvidia.json"
  export __EGL_VENDOR_LIBRARY_FILENAMES=$output/egl_nvidia.json
fi

failures=0

# Usage: run_step NAME COMMAND... - status 77: it cannot run here, and the last line says why.
run_step()
{
  local name=$1 status=0
  shift
  timeout 200 "$@" >"$output/$name.log" 2>&1 || status=$?
  if [ "$status" -eq 77 ]; then
    echo "$name: $(tail -n 1 "$output/$name.log")"
  elif [ "$status" -ne 0 ]; then
    failures=$((failures + 1))
    echo "$name: failed with status $status; the end of $name.log:"
    grep -v '\[ RUN\|\[       OK' "$output/$name.log" | tail -n 30
  elif grep -q '\[  SKIPPED \]' "$output/$name.log"; then
    echo "$name: skipped: $(grep -A 1 ': Skipped' "$output/$name.log" | sed -n 2p)"
  else
    echo "$name: passed, $(grep -c '\[       OK' "$output/$name.log") tests"
  fi
}

run_benchmark()
{
  local sizes=(--frames 30 --moving 100000 1000000 5000000)
  if [ "$quick" = yes ]; then
    sizes=(--frames 5 --moving 10000 50000)
  fi
  local status=0
  timeout 300 "$programs/delaunay-flip-window-benchmark" "${sizes[@]}" \
    2>"$output/window-benchmark.log" | tee "$output/window-benchmark.json" || status=$?
  if [ "$status" -ne 0 ] && [ "$status" -ne 77 ]; then
    failures=$((failures + 1))
    echo "window-benchmark: failed with status $status"
    tail -n 5 "$output/window-benchmark.log"
  fi
  if [ "$status" -ne 77 ]; then
    "$programs/SwellingSurface" --points "${sizes[3]}" --backend cuda 2>&1 |
      tee "$output/window-example.log"
  fi
}

if [ "$tests" = yes ]; then
  run_step window-tests "$programs/DelaunayFlipWindowTests"
  run_step window-colors "$programs/DelaunayFlipGpuTests" '--gtest_filter=DeviceColors*:DrawnTriangles*'
fi
if [ "$benchmarks" = yes ]; then
  run_benchmark
fi
exit $((failures > 0))
