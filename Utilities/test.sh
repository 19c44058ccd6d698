#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: test.sh [--long|--no-sanitizers]
# Installs missing packages (Debian), builds and tests: the whole project in build/, the ParaView
# plugin in build-paraview/, the engine, the filter and the command under AddressSanitizer and
# UndefinedBehaviorSanitizer in build-asan/, and the engine under ThreadSanitizer in build-tsan/. The
# exit status is 0 only if all tests pass; without ParaView the plugin counts as one skipped test.
#
# Under the sanitizers there are fewer tests, on smaller meshes. --long runs all tests there, at full
# size, and everywhere also those with the label "long": failing allocations, packages, the
# documentation's site, the paper's experiments and more fuzzing. It also builds and tests the engine
# by Clang in build-clang/, and takes hours. --no-sanitizers leaves the two sanitizers out.
#
# JOBS in the environment is the number of jobs that run at a time (default 2).
set -euo pipefail

long=OFF sanitizers=ON timeout=1500 # seconds a test may take
chosen=(--label-exclude long) flags="-O1 -g1"
case "$*" in
  "") ;;
  --long) long=ON timeout=14400 chosen=() flags="-O2 -g" ;;
  --no-sanitizers) sanitizers=OFF ;;
  *)
    echo "usage: $0 [--long|--no-sanitizers]" >&2
    exit 2
    ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
jobs=${JOBS:-2}
passed=0 failed=0 skipped=0
broken=() absent=()
export PYTHONDONTWRITEBYTECODE=1

# Usage: check FOLDER [CMAKE_OPTION...] - configures, builds and tests one configuration.
check()
{
  local folder=$1
  shift
  printf '\n== %s\n' "$folder"
  rm -f "$root/$folder/junit.xml"
  if ! configure_build_test "$folder" "$@"; then
    broken+=("$folder")
  fi
  count_results "$root/$folder/junit.xml"
}

configure_build_test()
{
  local build="$root/$1" generator=(-G Ninja)
  shift
  [ ! -f "$build/CMakeCache.txt" ] || generator=() # keeps its own
  cmake -S "$root" -B "$build" "${generator[@]}" -DPython3_EXECUTABLE=/usr/bin/python3 "$@" &&
    "${launcher[@]}" cmake --build "$build" --parallel "$jobs" &&
    "${launcher[@]}" ctest --test-dir "$build" "${chosen[@]}" --output-on-failure \
      --parallel "$jobs" --no-tests=error --timeout "$timeout" --output-junit "$build/junit.xml"
}

# ParaView's packages are downloaded if apt-get can; see get-paraview.sh.
check_plugin()
{
  local paraview
  if "$root/Utilities/install-packages.sh" paraview &&
    paraview=$("$root/Utilities/get-paraview.sh"); then
    check build-paraview -DCMAKE_BUILD_TYPE=Release -DDELAUNAYFLIP_BUILD_TESTING=ON \
      -DDELAUNAYFLIP_PARAVIEW=ON -DParaView_DIR="$paraview" -DCMAKE_CUDA_ARCHITECTURES=75
  else
    absent+=(build-paraview)
    skipped=$((skipped + 1))
  fi
}

# The engine by Clang, with its tests.
check_clang()
{
  if command -v clang++ >/dev/null; then
    check build-clang -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
      -DCMAKE_BUILD_TYPE=Release -DDELAUNAYFLIP_BUILD_TESTING=ON -DDELAUNAYFLIP_BUILD_VTK=OFF \
      -DDELAUNAYFLIP_ENABLE_CUDA=OFF
  else
    echo "no clang++ (Debian: clang)"
    absent+=(build-clang)
    skipped=$((skipped + 1))
  fi
}

# All but Python and the live view under AddressSanitizer with UndefinedBehaviorSanitizer; the engine
# under ThreadSanitizer.
check_under_sanitizers()
{
  # Without NDEBUG, so that the edge mesh is audited after every iteration.
  check build-asan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="$flags" \
    -DDELAUNAYFLIP_BUILD_TESTING=ON -DDELAUNAYFLIP_BUILD_RENDERING=OFF \
    -DDELAUNAYFLIP_SANITIZER=address \
    -DDELAUNAYFLIP_LONG_TESTS=$long

  # ThreadSanitizer of GCC 12 finds no room for its shadow memory if the kernel randomises addresses
  # strongly (Linux 6.6 and newer). This also affects the build, which runs the tests to list them.
  if setarch --addr-no-randomize true 2>/dev/null; then
    launcher=(setarch --addr-no-randomize)
  fi
  check build-tsan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DDELAUNAYFLIP_BUILD_TESTING=ON \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="$flags -DNDEBUG" -DDELAUNAYFLIP_BUILD_VTK=OFF \
    -DDELAUNAYFLIP_SANITIZER=thread -DDELAUNAYFLIP_LONG_TESTS=$long
  launcher=()
}

# Usage: count_results JUNIT_FILE - adds its tests to the totals; without a file, none ran.
count_results()
{
  [ -f "$1" ] || return 0
  local tests failures skips
  tests=$(attribute tests "$1")
  failures=$(attribute failures "$1")
  skips=$(attribute skipped "$1")
  passed=$((passed + tests - failures - skips))
  failed=$((failed + failures))
  skipped=$((skipped + skips))
}

attribute()
{
  sed -n "0,/<testcase/s/.*[^a-z]$1=\"\([0-9]*\)\".*/\1/p" "$2" | head -n 1
}

"$root/Utilities/install-packages.sh" test

# What several builds have in common is compiled once, because paths are relative to this checkout.
# Keeps a launcher that the caller has chosen.
if command -v ccache >/dev/null; then
  export CCACHE_NOHASHDIR=true CCACHE_BASEDIR=$root
  export CMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER-ccache}
  export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
  export CMAKE_CUDA_COMPILER_LAUNCHER=${CMAKE_CUDA_COMPILER_LAUNCHER-ccache}
fi

launcher=()
# With a CUDA compiler, builds for one architecture, in a quarter of the time for all; newer GPUs
# run its PTX. A build that demo.sh made may be without CUDA.
check build -DCMAKE_BUILD_TYPE=Release -DDELAUNAYFLIP_BUILD_TESTING=ON \
  -DDELAUNAYFLIP_ENABLE_CUDA=AUTO -DCMAKE_CUDA_ARCHITECTURES=75 -DDELAUNAYFLIP_LONG_TESTS=$long
# After build: its command makes the meshes with which those of the plugin are compared.
check_plugin
if [ $sanitizers = ON ]; then
  check_under_sanitizers
else
  absent+=(build-asan build-tsan)
  skipped=$((skipped + 2))
fi
if [ $long = ON ]; then
  check_clang
fi

printf '\n'
if [ ${#broken[@]} -gt 0 ]; then
  /usr/bin/python3 "$root/Utilities/list_failed_tests.py" "${broken[@]/#/$root/}"
  echo "FAILED in: ${broken[*]} (their output is above)"
fi
if [ ${#absent[@]} -gt 0 ]; then
  echo "SKIPPED: ${absent[*]}, not built and not tested (the reason is above)"
fi
echo "tests: $passed passed, $failed failed, $skipped skipped"
[ ${#broken[@]} -eq 0 ]
