#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: bundle.sh [--window [--loader]] [OUTPUT.tar.gz, OUTPUT.tar.xz or FOLDER]
# (default: delaunay-flip-gpu.tar.gz)
# Builds in build-gpu/ and packs what run.sh needs on a machine with a GPU and without development
# packages: programs, shared libraries that not every Linux has, and real meshes. With --window also
# what run.sh --window needs, with the neutral part of EGL; with --loader for run.sh --window only,
# with the C library and its loader too, so that a Debian with a newer VTK can make it for a machine
# with an older system. Unpack it there and run delaunay-flip-gpu/run.sh. The machine needs an NVIDIA
# driver, without --loader a C++ runtime not older than this one's, and python3; compute-sanitizer is
# used if installed. CUDA_ARCHITECTURES chooses other GPUs than the project's default, JOBS the number
# of compilers at a time.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build-gpu
window=() only=()
if [ "${1:-}" = --window ]; then
  window=(DelaunayFlipWindowTests delaunay-flip-window-benchmark SwellingSurface)
  shift
fi
if [ "${1:-}" = --loader ]; then
  only=(--only)
  shift
fi
output=${1:-delaunay-flip-gpu.tar.gz}
programs=(DelaunayFlipGpuTests DelaunayFlipCoreTests DelaunayFlipAskTests
  delaunay-flip-gpu-benchmark
  delaunay-flip-point-benchmark delaunay-flip-fuzz-points
  delaunayflip-c-device-test "${window[@]}")
if [ ${#only[@]} -gt 0 ]; then programs=(delaunay-flip-gpu-benchmark "${window[@]}"); fi

# Usage: carry_loader FOLDER - in place of every program a script that runs it by this machine's
# loader, with this machine's libraries. They are not in libs/, where the shell would find them.
carry_loader()
{
  local folder=$1 program library
  rm -rf "$folder"/{own,programs}
  mv "$folder/libs" "$folder/own"
  mkdir "$folder/programs"
  ldd "${programs[@]/#/$build/bin/}" |
    awk '$2 == "=>" && $3 ~ /^\// { print $3 } $1 ~ /\/ld-linux/ { print $1 }' | sort -u |
    while read -r library; do
      [ -e "$folder/own/$(basename "$library")" ] || cp -L "$library" "$folder/own/"
    done
  for program in "${programs[@]}"; do
    mv "$folder/$program" "$folder/programs/"
    cat >"$folder/$program" <<'END'
#!/bin/sh
here=$(dirname "$0")
exec "$here/own/ld-linux-x86-64.so.2" \
  --library-path "$here/own${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$here/programs/$(basename "$0")" "$@"
END
    chmod +x "$folder/$program"
  done
}

# Usage: fill FOLDER
fill()
{
  local folder=$1 program library
  mkdir -p "$folder/libs"
  for program in "${programs[@]}"; do
    strip -o "$folder/$program" "$build/bin/$program"
  done
  {
    "$root/Utilities/shared_libraries.sh" "${programs[@]/#/$build/bin/}"
    if [ ${#window[@]} -gt 0 ]; then # loaded at run time: the neutral EGL finds the driver's
      ldconfig -p |
        awk '$1 ~ /^lib(EGL|GLdispatch|OpenGL|GLX|GL)\.so\.[01]$/ && !seen[$1]++ { print $NF }'
    fi
  } | while read -r library; do
    strip -o "$folder/libs/$(basename "$library")" "$(readlink -f "$library")"
  done
  cp "$here/run.sh" "$here/summarize.py" "$root/LICENSE" "$folder/"
  if [ ${#only[@]} -gt 0 ]; then
    carry_loader "$folder"
  else
    cp "$here/test_device_arrays.py" "$here/../Python/lattice.py" \
      "$here/../Benchmarks/"{compare,interpolate,moving,refine,sphere}.py "$folder/"
    cp -r "$root/Python/delaunayflip" "$folder/"
    cp -L "$build/lib/libdelaunayflip.so.1" "$folder/delaunayflip/"
    if [ -d "$build/meshes" ]; then
      cp -r "$build/meshes" "$folder/"
    fi
  fi
  cat >"$folder/BUILD.txt" <<END
commit: $(git -C "$root" describe --always --dirty 2>/dev/null || echo unknown)
built: $(date -u +%Y-%m-%dT%H:%MZ) with $(c++ --version | head -n 1)
CUDA architectures: $architectures
END
}

"$here/build.sh" "${only[@]}" "$build" "${window[@]}"
# Not in the cache if it is the project's default.
architectures=$(sed -n 's/^CMAKE_CUDA_ARCHITECTURES:[A-Z]*=//p' "$build/CMakeCache.txt")
architectures=${architectures:-the default of the project}
if [ ${#only[@]} -eq 0 ] && [ -x "$build/bin/DelaunayFlipCxxTests" ]; then
  programs+=(DelaunayFlipCxxTests)
fi

case "$output" in
  *.tar.gz | *.tgz | *.tar.xz)
    temporary=$(mktemp -d)
    trap 'rm -rf "$temporary"' EXIT
    fill "$temporary/delaunay-flip-gpu"
    tar -C "$temporary" -caf "$output" delaunay-flip-gpu
    ;;
  *) fill "$output" ;;
esac
echo "$output: $(du -sh "$output" | cut -f 1), for CUDA architectures $architectures"
