#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: bundle_paper.sh [OUTPUT.tar.gz] (default: delaunay-flip-paper.tar.gz)
# Packs what reproduce_paper.sh needs on a machine without development packages: the program of
# build-paper/, which it builds, the shared libraries that not every Linux has, and the scripts.
# Surfaces in build-paper/meshes (.dfmesh files, as in OUTPUT/meshes of a run) go along. Unpack it,
# then run delaunay-flip-paper/reproduce_paper.sh. The machine needs a C++ runtime not older than
# this one's and python3; where that has no matplotlib, draw the output elsewhere by --draw-only.
# CUDA_ARCHITECTURES chooses the GPUs, JOBS the number of compilers at a time.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
root=$(cd "$here/.." && pwd)
build=$root/build-paper
output=${1:-delaunay-flip-paper.tar.gz}

"$here/reproduce_paper.sh" --build-only
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
folder=$temporary/delaunay-flip-paper
mkdir -p "$folder/libs" "$folder/paper"
strip -o "$folder/delaunay-flip-paper" "$build/bin/delaunay-flip-paper"
"$here/shared_libraries.sh" "$build/bin/delaunay-flip-paper" | while read -r library; do
  cp -L "$library" "$folder/libs/"
done
cp "$here"/paper/*.* "$root/Testing/Gpu/export_meshes.py" "$folder/paper/"
cp "$here/reproduce_paper.sh" "$root/LICENSE" "$folder/"
if [ -d "$build/meshes" ]; then
  cp -r "$build/meshes" "$folder/"
fi
tar -C "$temporary" -czf "$output" delaunay-flip-paper
echo "$output: $(du -sh "$output" | cut -f 1)"
