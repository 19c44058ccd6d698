#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: draw_paraview.sh [FOLDER] - takes the documentation's pictures of ParaView's client into FOLDER
# (default: Documentation/images), on a virtual display. Needs the plugin (preset paraview, in
# build-paraview/) and python3-pyqt5 or, for ParaViews with Qt 6, python3-pyqt6, to find the client's
# widgets.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
pictures=$(realpath -m "${1:-$root/Documentation/images}")
config=$(sed -n 's/^ParaView_DIR:[A-Z]*=//p' "$root/build-paraview/CMakeCache.txt")
prefix=$(realpath "$config/../../../..")
plugin=$(find "$root/build-paraview/lib" -name DelaunayFlip.so | head -n 1)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

qt=$(sed -n 's/^set(PARAVIEW_QT_MAJOR_VERSION "\(.*\)")/\1/p' "$config/paraview-config.cmake")
libraries=$(dirname "$(dirname "$config")")
/usr/bin/python3 "$root/Utilities/make_terrain.py" --points 1500 "$folder/before.vtp"
HOME=$folder DELAUNAYFLIP_QT=${qt:-5} DELAUNAYFLIP_FOLDER=$folder DELAUNAYFLIP_PLUGIN=$plugin \
  LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} \
  PYTHONPATH=$prefix/lib/python3/dist-packages:$root/Testing/ParaView \
  "$root/Testing/Cxx/with_display.sh" "$prefix/bin/paraview" --script="$root/Utilities/draw_paraview.py"
mkdir -p "$pictures"
mv "$folder"/paraview*.png "$pictures"
