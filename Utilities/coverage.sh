#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: coverage.sh
# Builds the engine and its tests in build-coverage/, runs them (meshes a tenth as large, as under the
# sanitizers) with the first cases of the fuzzer, and prints which lines and branches of Engine/ they
# took; build-coverage/report/index.html shows them. Branches that only exceptions take do not count.
# The exit status is 0 only at 95 % of the lines and 90 % of the branches. Needs gcovr (Debian). JOBS:
# how many compilers at a time (default 2).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build-coverage

cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O0 -g1 -DNDEBUG" -DDELAUNAYFLIP_BUILD_TESTING=ON \
  -DDELAUNAYFLIP_BUILD_VTK=OFF -DDELAUNAYFLIP_ENABLE_CUDA=OFF -DDELAUNAYFLIP_SANITIZER=coverage
cmake --build "$build" --parallel "${JOBS:-2}" \
  --target DelaunayFlipCoreTests delaunay-flip-fuzz-engine
find "$build" -name '*.gcda' -delete # of an earlier run
"$build/bin/DelaunayFlipCoreTests" --gtest_brief=1
"$build/bin/delaunay-flip-fuzz-engine" --cases 2000

mkdir -p "$build/report"
cd "$build"
gcovr --root "$root" --filter "$root/Engine/" --exclude-throw-branches \
  --exclude-unreachable-branches --print-summary --txt --html-details report/index.html \
  --fail-under-line 95 --fail-under-branch 90 .
