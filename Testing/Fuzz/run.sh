#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: run.sh [engine|points|refinements|moves|spheres|files|ranks|arrays] [--cases N] [--seed S] [--jobs J] [--libfuzzer SECONDS]
# Builds a fuzz target and runs cases 0 to N - 1 (default 1000000) of a seed (default 1) on J
# processes (default: all cores), a thousand per process. The programs for the engine (default), for
# points, refinements, moves and spheres are built in build-fuzz/ with AddressSanitizer,
# UndefinedBehaviorSanitizer and the leak check. The command, which gets mutated files, and the
# filter on several ranks, of which one may have other options, are built in build-fuzz-files/
# without them; so is the library for Python in build-fuzz-arrays/, to which fuzz_arrays.py gives
# arrays of all layouts. Results are kept in results/ there: after a stop, run the script again to
# continue. The exit status is 0 only if no case failed. To run one case again and print its mesh,
# file or arrays:
#
#   build-fuzz/bin/delaunay-flip-fuzz-engine --seed S --first CASE --cases 1 --print
#
# --libfuzzer lets libFuzzer (Clang) search for that long instead, guided by the branches that a case
# of the engine takes. FUZZ_PROGRAM names a built program to run; then none is built.
set -euo pipefail

target=engine cases=1000000 seed=1 jobs=$(nproc) seconds=0
fail_usage()
{
  sed -n 's/^# Usage: /usage: /p' "$0" >&2
  exit 2
}
while [ $# -gt 0 ]; do
  case "$1" in
    engine | points | refinements | moves | spheres | files | ranks | arrays) target=$1 ;;
    --cases | --seed | --jobs | --libfuzzer)
      [ $# -ge 2 ] || fail_usage
      case "$1" in
        --cases) cases=$2 ;;
        --seed) seed=$2 ;;
        --jobs) jobs=$2 ;;
        --libfuzzer) seconds=$2 ;;
      esac
      shift
      ;;
    *) fail_usage ;;
  esac
  shift
done

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build-fuzz
options=(-DDELAUNAYFLIP_BUILD_VTK=OFF -DDELAUNAYFLIP_SANITIZER=address)
if [ "$target" = arrays ]; then
  build=$root/build-fuzz-arrays
  options=(-DDELAUNAYFLIP_BUILD_VTK=OFF)
elif [[ "$target" =~ ^(files|ranks)$ ]]; then
  build=$root/build-fuzz-files
  options=(-DDELAUNAYFLIP_BUILD_VTK=ON)
fi
results=$build/results
mkdir -p "$results"
# An error of a sanitizer ends like a crash, so that the driver names the case.
export ASAN_OPTIONS=abort_on_error=1:detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1

# Usage: build_target PROGRAM [CMAKE_OPTION...]
build_target()
{
  local program=$1
  shift
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g1 -DNDEBUG" -DDELAUNAYFLIP_BUILD_TESTING=ON \
    -DPython3_EXECUTABLE=/usr/bin/python3 -DDELAUNAYFLIP_ENABLE_CUDA=OFF "$@"
  cmake --build "$build" --parallel "${JOBS:-2}" --target "$program"
}

if [ "$seconds" -gt 0 ]; then
  build=$root/build-libfuzzer
  program=delaunay-flip-libfuzzer-$target
  build_target "$program" "${options[@]}" -DCMAKE_CXX_COMPILER=clang++ -DDELAUNAYFLIP_LIBFUZZER=ON
  mkdir -p "$build/corpus-$target"
  cd "$build"
  exec "bin/$program" -seed="$seed" -max_total_time="$seconds" -max_len=256 -timeout=60 \
    -fork="$jobs" "corpus-$target"
fi

program=${FUZZ_PROGRAM:-$build/bin/delaunay-flip-fuzz-$target}
if [ "$target" = arrays ] && [ -z "${FUZZ_PROGRAM:-}" ]; then
  program=$root/Testing/Fuzz/fuzz_arrays.py
  build_target DelaunayFlipC "${options[@]}"
  export PATH=/usr/bin:$PATH PYTHONPATH=$build/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1
elif [ -z "${FUZZ_PROGRAM:-}" ]; then
  build_target "delaunay-flip-fuzz-$target" "${options[@]}"
fi

# Usage: run_part FIRST CASES - runs one process and keeps its output.
run_part()
{
  local log="$results/$target-$seed-$1.log"
  if "$program" --seed "$seed" --first "$1" --cases "$2" >"$log" 2>&1; then
    tail -n 1 "$log" >>"$done_list"
    rm "$log"
  else
    echo "FAILED: see $log" >&2
  fi
}
export -f run_part
done_list=$results/$target-$seed.done
touch "$done_list"
export program results target seed done_list

part=1000
for ((first = 0; first < cases; first += part)); do
  count=$((cases - first < part ? cases - first : part))
  if ! grep -q "^seed $seed, cases $first to $((first + count - 1)):" "$done_list"; then
    echo "$first $count"
  fi
done | xargs -P "$jobs" -L 1 bash -c 'run_part "$@"' run_part

passed=$(awk '{ sub(/:/, "", $6); passed += $6 - $4 + 1 } END { print passed + 0 }' "$done_list")
failed=$(find "$results" -name "$target-$seed-*.log" | wc -l)
echo "$target, seed $seed: $passed cases passed; $failed parts of up to $part failed"
[ "$failed" -eq 0 ]
