#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages (Debian), builds the ParaView plugin in build-paraview/, and prints how
# to start ParaView with it. Uses the ParaView in ParaView_DIR, else the one installed with
# paraview-dev, else Debian's packages, unpacked into build-paraview-sdk/.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
build="$root/build-paraview"

"$root/Utilities/install-packages.sh" paraview
config=$("$root/Utilities/get-paraview.sh")
options=()
# A new build with a CUDA compiler is for one architecture, which takes a quarter of the time; newer
# GPUs run its PTX. An existing build keeps its options.
[ -f "$build/CMakeCache.txt" ] ||
  options=(-G Ninja -DDELAUNAYFLIP_BUILD_TESTING=OFF -DCMAKE_CUDA_ARCHITECTURES=75)
cmake -S "$root" -B "$build" -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DDELAUNAYFLIP_PARAVIEW=ON -DParaView_DIR="$config" "${options[@]}" >/dev/null
cmake --build "$build" --parallel "${JOBS:-2}"

plugin=$(find "$build/lib" -name DelaunayFlip.so | head -n 1)
libraries=$(dirname "$(dirname "$config")")
prefix=$(realpath "$libraries")
until [ -e "$prefix/bin/paraview" ] || [ "$prefix" = / ]; do
  prefix=$(dirname "$prefix")
done
start=("PV_PLUGIN_PATH=$(dirname "$plugin")")
if [ "$prefix" != /usr ]; then
  start+=("LD_LIBRARY_PATH=$libraries" "PYTHONPATH=$prefix/lib/python3/dist-packages")
fi
cat <<END

Done: $plugin
Start ParaView with it:
  $(printf '%q ' "${start[@]}" "$prefix/bin/paraview")
or load that file in a running one by Tools > Manage Plugins > Load New.
END
