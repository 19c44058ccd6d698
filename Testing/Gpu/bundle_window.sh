#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: bundle_window.sh [OUTPUT.tar.xz] (default: delaunay-flip-window.tar.xz)
# Builds in build-gpu/ and packs what run_window.sh needs on a machine with a GPU and its driver
# alone: the programs, with the shared libraries of VTK and of the neutral part of EGL. Unpack it
# there and run delaunay-flip-window/run_window.sh. CUDA_ARCHITECTURES and JOBS as for build.sh.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build-gpu
output=${1:-delaunay-flip-window.tar.xz}
programs=(DelaunayFlipWindowTests delaunay-flip-window-benchmark DelaunayFlipGpuTests
  SwellingSurface)

if [ ! -f "$build/CMakeCache.txt" ]; then
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDELAUNAYFLIP_ENABLE_CUDA=ON \
    -DDELAUNAYFLIP_BUILD_TESTING=ON "-DCMAKE_CUDA_ARCHITECTURES=${CUDA_ARCHITECTURES:-}"
fi
cmake --build "$build" --parallel "${JOBS:-2}" --target "${programs[@]}"

temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
folder=$temporary/delaunay-flip-window
mkdir -p "$folder/libs"
for program in "${programs[@]}"; do
  strip -o "$folder/$program" "$build/bin/$program"
done
"$root/Utilities/shared_libraries.sh" "${programs[@]/#/$build/bin/}" | while read -r library; do
  strip -o "$folder/libs/$(basename "$library")" "$(readlink -f "$library")"
done
# Loaded at run time: the neutral EGL finds the driver's by these.
for library in libEGL.so.1 libGLdispatch.so.0 libOpenGL.so.0 libGLX.so.0 libGL.so.1; do
  found=$(ldconfig -p | awk -v name="$library" '$1 == name { print $NF; exit }')
  if [ -n "$found" ] && [ ! -e "$folder/libs/$library" ]; then
    cp -L "$found" "$folder/libs/$library"
  fi
done
cp "$here/run_window.sh" "$root/LICENSE" "$folder/"
tar -C "$temporary" -cf - delaunay-flip-window | xz -T0 -6 >"$output"
echo "$output: $(du -h "$output" | cut -f 1)"
