#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs everything that needs a GPU: the tests of the CUDA backend, the whole test suites of the
# engine and the VTK filter on the GPU, compute-sanitizer, and benchmarks against the CPU. In a source tree it first builds into
# build-gpu/; in a bundle (bundle.sh) it runs the programs beside it. The results are in results.txt
# and results.json in the output folder. The exit status is 0 only if nothing failed. What cannot
# run here is reported as skipped; without a GPU nothing passes.
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
END
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
output=gpu-results
filter=
tests=yes benchmarks=yes
quick=()
while [ $# -gt 0 ]; do
  case "$1" in
    --output | --filter)
      if [ $# -lt 2 ]; then
        echo "$1 needs a value" >&2
        exit 2
      fi
      if [ "$1" = --output ]; then output=$2; else filter=$2; fi
      shift
      ;;
    --quick) quick=(--quick) ;;
    --tests-only) benchmarks=no ;;
    --benchmarks-only) tests=no ;;
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

if [ -x "$here/DelaunayFlipGpuTests" ]; then
  programs=$here
  package=$here
  meshes=$here/meshes
  export LD_LIBRARY_PATH=$here/libs${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
else
  build=$(cd "$here/../.." && pwd)/build-gpu
  "$here/build.sh" "$build"
  programs=$build/bin
  package=$(dirname "$(find "$build" -path '*/dist-packages/delaunayflip' -print -quit)"):$here/../Python
  meshes=$build/meshes
fi
if [ -d "$meshes" ]; then
  export DELAUNAYFLIP_MESH_DIR=$meshes
fi

mkdir -p "$output"
output=$(cd "$output" && pwd)
(
  cd "$output"
  rm -f results.txt results.json machine.json steps.tsv benchmarks.* gpu-tests.* sanitizer-*.log \
    engine-tests-on-cuda.* filter-tests-on-cuda.* program-*.log \
    gpus-in-turn.*
)
"$programs/delaunay-flip-gpu-benchmark" --describe >"$output/machine.json"
has_gpu=yes
if grep -q '"gpu": null' "$output/machine.json"; then
  has_gpu=no
  echo "no GPU: everything that needs one is skipped"
fi

# Usage: note STEP STATUS [REASON] - STATUS is an exit status, or "skipped" for REASON.
note() { printf '%s\t%s\t%s\n' "$1" "$2" "${3:-}" >>"$output/steps.tsv"; }

# Usage: run_step NAME COMMAND... - writes the output to NAME.log and, if it matters, to the screen.
run_step()
{
  local name=$1 status=0
  shift
  printf '\n== %s\n' "$name"
  "$@" >"$output/$name.log" 2>&1 || status=$?
  note "$name" "$status"
  if [ "$status" -ne 0 ]; then
    echo "exit status $status; the end of $name.log:"
    tail -n 40 "$output/$name.log"
  else
    tail -n 2 "$output/$name.log"
  fi
}

# Usage: run_program NAME COMMAND... - the same for a program without a report, which ends with
# status 77 where it cannot run; the last line that it prints says why.
run_program()
{
  local name=program-$1 status=0
  shift
  printf '\n== %s\n' "$name"
  "$@" >"$output/$name.log" 2>&1 || status=$?
  tail -n 40 "$output/$name.log"
  if [ "$status" -eq 77 ]; then
    note "$name" skipped "$(tail -n 1 "$output/$name.log")"
  else
    note "$name" "$status"
  fi
}

# Usage: run_on_cuda NAME PROGRAM - runs tests that do not choose a backend on the GPU.
run_on_cuda()
{
  run_step "$1" env DELAUNAYFLIP_TEST_BACKEND=cuda "$programs/$2" "--gtest_filter=${filter:-*}" \
    --gtest_brief=1 "--gtest_output=json:$output/$1.json"
}

run_tests()
{
  run_step gpu-tests "$programs/DelaunayFlipGpuTests" "--gtest_filter=${filter:-*}" \
    --gtest_brief=1 "--gtest_output=json:$output/gpu-tests.json"
  run_on_cuda engine-tests-on-cuda DelaunayFlipCoreTests
  if [ -x "$programs/DelaunayFlipCxxTests" ]; then
    run_on_cuda filter-tests-on-cuda DelaunayFlipCxxTests
  else
    echo "SKIPPED: the tests of the filter, because there was no VTK to build them"
    note filter-tests-on-cuda skipped "built without VTK"
  fi
  if [ -z "$filter" ]; then
    # Several GPUs whose launches run one after the other.
    run_step gpus-in-turn env CUDA_LAUNCH_BLOCKING=1 "$programs/DelaunayFlipGpuTests" \
      --gtest_brief=1 '--gtest_filter=SharedMeshTest.Plane:SharedMeshTest.Surface*' \
      "--gtest_output=json:$output/gpus-in-turn.json"
    run_program c-device-arrays "$programs/delaunayflip-c-device-test"
    run_program python-device-arrays env "PYTHONPATH=$package${PYTHONPATH:+:$PYTHONPATH}" \
      python3 "$here/test_device_arrays.py"
  fi
}

find_sanitizer()
{
  local program
  for program in compute-sanitizer "${CUDA_HOME:-/usr/local/cuda}/bin/compute-sanitizer"; do
    if command -v "$program"; then
      return
    fi
  done
}

# Small meshes, because every memory access is checked. racecheck checks shared memory only.
run_sanitizer()
{
  local sanitizer tool
  sanitizer=$(find_sanitizer)
  for tool in memcheck racecheck initcheck synccheck; do
    if [ "$has_gpu" = no ]; then
      note "sanitizer-$tool" skipped "no GPU"
    elif [ -n "$filter" ]; then
      note "sanitizer-$tool" skipped "--filter"
    elif [ -z "$sanitizer" ]; then
      note "sanitizer-$tool" skipped "no compute-sanitizer"
    else
      run_step "sanitizer-$tool" timeout 300 "$sanitizer" --tool "$tool" --error-exitcode 86 \
        "$programs/DelaunayFlipGpuTests" --gtest_brief=1 '--gtest_filter=SmallMeshTest.*:DeviceMesh*:DeviceLayoutTest*FewTriangles'
    fi
  done
}

run_benchmarks()
{
  local real=()
  if [ -d "$meshes" ]; then
    real=(--meshes "$meshes")
  fi
  printf '\n== benchmarks\n'
  local status=0
  "$programs/delaunay-flip-gpu-benchmark" "${quick[@]}" "${real[@]}" \
    --json "$output/benchmarks.json" 2>&1 | tee "$output/benchmarks.log" || status=$?
  note benchmarks "$status"
}

if [ "$tests" = yes ]; then
  run_tests
  run_sanitizer
fi
if [ "$benchmarks" = yes ]; then
  run_benchmarks
fi
printf '\n'
python3 "$here/summarize.py" "$output"
