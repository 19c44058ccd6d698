#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs everything that needs a GPU: the tests of the CUDA backend, the whole test suites of the
# engine and the VTK filter on the GPU, compute-sanitizer, and benchmarks against the CPU. In a
# source tree it first builds into build-gpu/; in a bundle (bundle.sh) it runs the programs beside
# it. The results are in results.txt and results.json in the output folder. The exit status is 0 only
# if nothing failed. What cannot run here is reported as skipped; without a GPU nothing passes.
set -euo pipefail

usage()
{
  cat <<'END'
Usage: run.sh [OPTION...] [OUTPUT_FOLDER]
  --output FOLDER     where results.txt, results.json and the logs go (default: ./gpu-results)
  --quick             few sizes and repetitions
  --tests-only        no benchmarks
  --benchmarks-only   no tests and no compute-sanitizer
  --filter PATTERN    only the tests of this --gtest_filter; no compute-sanitizer
  --window            instead, what needs a GPU that both CUDA and OpenGL use: the tests of drawing
                      without copies, in windows of EGL, and the benchmark of frames
END
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
output=gpu-results
filter='*'
tests=yes benchmarks=yes window=no
quick=()
while [ $# -gt 0 ]; do
  case "$1" in
    --output)
      output=${2:?--output needs a value}
      shift
      ;;
    --filter)
      filter=${2:?--filter needs a value}
      shift
      ;;
    --quick) quick=(--quick) ;;
    --tests-only) benchmarks=no ;;
    --benchmarks-only) tests=no ;;
    --window) window=yes ;;
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
mkdir -p "$output"
output=$(cd "$output" && pwd)
(
  cd "$output"
  rm -f results.{txt,json} machine.json steps.tsv benchmarks.{json,log} gpu-tests.* \
    {engine,filter}-tests-on-cuda.* gpus-in-turn.* sanitizer-*.log points-*.log {c,python}-device-arrays.log window-*.{json,log}
)

if [ -e "$here/BUILD.txt" ]; then
  programs=$here
  package=$here
  meshes=$here/meshes
  export LD_LIBRARY_PATH=$here/libs${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
else
  build=$(cd "$here/../.." && pwd)/build-gpu
  if [ "$window" = yes ]; then
    "$here/build.sh" --only "$build" DelaunayFlipWindowTests delaunay-flip-window-benchmark \
      SwellingSurface
  else
    "$here/build.sh" "$build"
  fi
  programs=$build/bin
  package=$(dirname "$(find "$build" -path '*/dist-packages/delaunayflip' -print -quit)"):$here/../Python
  meshes=$build/meshes
fi
if [ -d "$meshes" ]; then
  export DELAUNAYFLIP_MESH_DIR=$meshes
fi
"$programs/delaunay-flip-gpu-benchmark" --describe >"$output/machine.json"
has_gpu=yes
if grep -q '"gpu": null' "$output/machine.json"; then
  has_gpu=no
  echo "no GPU: everything that needs one is skipped"
fi

# Usage: note STEP STATUS [REASON] - STATUS is an exit status, or "skipped" for REASON.
note() { printf '%s\t%s\t%s\n' "$1" "$2" "${3:-}" >>"$output/steps.tsv"; }

# Usage: run_step NAME COMMAND... - writes the output to NAME.log and, if it matters, to the screen.
# Programs end with status 77 where they cannot run; the last line that they print says why.
run_step()
{
  local name=$1 status=0
  shift
  printf '\n== %s\n' "$name"
  "$@" >"$output/$name.log" 2>&1 || status=$?
  if [ "$status" -eq 77 ]; then
    note "$name" skipped "$(tail -n 1 "$output/$name.log")"
  else
    note "$name" "$status"
  fi
  if [ "$status" -eq 0 ]; then
    tail -n 2 "$output/$name.log"
  else
    echo "exit status $status; the end of $name.log:"
    tail -n 40 "$output/$name.log"
  fi
}

# Usage: run_tests NAME PROGRAM FILTER - of GoogleTest.
run_tests()
{
  run_step "$1" "$programs/$2" "--gtest_filter=$3" --gtest_brief=1 \
    "--gtest_output=json:$output/$1.json"
}

run_all_tests()
{
  run_tests gpu-tests DelaunayFlipGpuTests "$filter"
  export DELAUNAYFLIP_TEST_BACKEND=cuda # for tests that do not choose a backend
  run_tests engine-tests-on-cuda DelaunayFlipCoreTests "$filter"
  run_tests query-tests-on-cuda DelaunayFlipAskTests "$filter"
  if [ -x "$programs/DelaunayFlipCxxTests" ]; then
    run_tests filter-tests-on-cuda DelaunayFlipCxxTests "$filter"
  else
    note filter-tests-on-cuda skipped "built without VTK"
  fi
  unset DELAUNAYFLIP_TEST_BACKEND
  if [ "$filter" = '*' ]; then
    # Several GPUs, with launches that run one after the other.
    CUDA_LAUNCH_BLOCKING=1 run_tests gpus-in-turn DelaunayFlipGpuTests \
      'SharedMeshTest.Plane:SharedMeshTest.Surface*'
    if [ "$has_gpu" = yes ]; then
      run_step points-fuzzed env DELAUNAYFLIP_TEST_BACKEND=cuda \
        "$programs/delaunay-flip-fuzz-points" --cases 20000
    else
      note points-fuzzed skipped "no GPU"
    fi
    run_step c-device-arrays "$programs/delaunayflip-c-device-test"
    run_step python-device-arrays env "PYTHONPATH=$package${PYTHONPATH:+:$PYTHONPATH}" \
      python3 "$here/test_device_arrays.py"
  fi
}

# Small meshes, because every memory access is checked. racecheck checks shared memory only.
run_sanitizer()
{
  local sanitizer tool reason=
  sanitizer=$(PATH=$PATH:${CUDA_HOME:-/usr/local/cuda}/bin command -v compute-sanitizer) ||
    reason="no compute-sanitizer"
  if [ "$filter" != '*' ]; then reason=--filter; fi
  if [ "$has_gpu" = no ]; then reason="no GPU"; fi
  for tool in memcheck racecheck initcheck synccheck; do
    if [ -n "$reason" ]; then
      note "sanitizer-$tool" skipped "$reason"
    else
      run_step "sanitizer-$tool" timeout 300 "$sanitizer" --tool "$tool" --error-exitcode 86 \
        "$programs/DelaunayFlipGpuTests" --gtest_brief=1 \
        '--gtest_filter=SmallMeshTest.*:SmallAskTest.*:DeviceMesh*:DeviceLayoutTest*FewTriangles'
    fi
  done
}

run_benchmarks()
{
  local real=() status=0
  if [ -d "$meshes" ]; then
    real=(--meshes "$meshes")
  fi
  printf '\n== benchmarks\n'
  "$programs/delaunay-flip-gpu-benchmark" "${quick[@]}" "${real[@]}" \
    --json "$output/benchmarks.json" 2>&1 | tee "$output/benchmarks.log" || status=$?
  note benchmarks "$status"
  if [ ${#quick[@]} -eq 0 ]; then
    run_step points-benchmark "$programs/delaunay-flip-point-benchmark"
  fi
}

# A machine without a display often has the driver's EGL, but not the file that names it, nor its
# folder among those of the loader.
prepare_egl()
{
  local folder
  for folder in /usr/local/nvidia/lib64 /usr/local/nvidia/lib /usr/lib/x86_64-linux-gnu; do
    if [ -e "$folder/libEGL_nvidia.so.0" ]; then
      export LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$folder
      break
    fi
  done
  if ! ls /usr/share/glvnd/egl_vendor.d/*nvidia* /etc/glvnd/egl_vendor.d/*nvidia* >/dev/null 2>&1; then
    echo '{"file_format_version": "1.0.0", "ICD": {"library_path": "libEGL_nvidia.so.0"}}' \
      >"$output/egl_nvidia.json"
    export __EGL_VENDOR_LIBRARY_FILENAMES=$output/egl_nvidia.json
  fi
}

run_window()
{
  local frames=30 moving=100000 sizes=(1000000 5000000)
  if [ ${#quick[@]} -gt 0 ]; then
    frames=5 moving=20000 sizes=(50000)
  fi
  prepare_egl
  if [ "$tests" = yes ]; then
    run_tests window-tests DelaunayFlipWindowTests "$filter"
  fi
  if [ "$benchmarks" = yes ]; then
    run_step window-benchmark timeout 300 "$programs/delaunay-flip-window-benchmark" \
      --frames "$frames" --moving "$moving" "${sizes[@]}"
    cat "$output/window-benchmark.log"
    if [ "$has_gpu" = yes ]; then
      run_step window-example "$programs/SwellingSurface" --points "${sizes[0]}" --backend cuda
    fi
  fi
}

if [ "$window" = yes ]; then
  run_window
else
  if [ "$tests" = yes ]; then
    run_all_tests
    run_sanitizer
  fi
  if [ "$benchmarks" = yes ]; then
    run_benchmarks
  fi
fi
printf '\n'
python3 "$here/summarize.py" "$output"
