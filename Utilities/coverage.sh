#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: coverage.sh
# Builds the engine and its tests by Clang in build-coverage/, runs them (meshes a tenth as large, as
# under the sanitizers) with the first cases of the fuzzer, and prints which lines and branches of
# Engine/ they took; build-coverage/report/index.html shows them. A branch is a condition in the
# source, true or false; exceptions are none. The exit status is 0 only at 95 % of the lines and 90 %
# of the branches. Needs Clang and LLVM (Debian: clang, llvm). JOBS: how many compilers at a time
# (default 2).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
build=$root/build-coverage
programs=(DelaunayFlipCoreTests DelaunayFlipFallbackTests DelaunayFlipEngineAllocationTests
  delaunay-flip-fuzz-engine)

cmake -S "$root" -B "$build" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -DNDEBUG" \
  -DDELAUNAYFLIP_BUILD_TESTING=ON -DDELAUNAYFLIP_BUILD_VTK=OFF -DDELAUNAYFLIP_ENABLE_CUDA=OFF \
  -DDELAUNAYFLIP_SANITIZER=coverage
cmake --build "$build" --parallel "${JOBS:-2}" --target "${programs[@]}"

rm -rf "$build/profiles" "$build/report" # of an earlier run
export LLVM_PROFILE_FILE=$build/profiles/%p.profraw
for program in "${programs[@]:0:3}"; do
  "$build/bin/$program" --gtest_brief=1
done
"$build/bin/delaunay-flip-fuzz-engine" --cases 2000

llvm-profdata merge -sparse -o "$build/tests.profdata" "$build"/profiles/*.profraw
measured=("$build/bin/${programs[0]}")
for program in "${programs[@]:1}"; do
  measured+=(-object "$build/bin/$program")
done
measured+=(-instr-profile="$build/tests.profdata" -ignore-filename-regex='/(Testing|usr)/')
llvm-cov show "${measured[@]}" -format=html -output-dir="$build/report" -show-branches=count
llvm-cov report "${measured[@]}"
llvm-cov export "${measured[@]}" -summary-only | python3 -c '
import json, sys
totals = json.load(sys.stdin)["data"][0]["totals"]
lines, branches = (totals[kind]["percent"] for kind in ("lines", "branches"))
print(f"lines {lines:.1f} % (goal 95), branches {branches:.1f} % (goal 90)")
sys.exit(lines < 95 or branches < 90)'
