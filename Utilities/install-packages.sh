#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: install-packages.sh engine|build|demo|test|docs|proof|paper|paraview
# Installs the Debian packages for building the engine alone, for building everything, the demo, the
# tests, the documentation's site, the measurements of the tests (coverage, fuzzing), the
# reproduction of the paper, or the ParaView plugin with its tests. Asks no questions, removes
# nothing, and changes nothing if all are installed already. ParaView itself is not included, since
# it cannot be installed beside python3-vtk9; see get-paraview.sh.
set -euo pipefail

engine=(g++ cmake ninja-build ca-certificates libtbb-dev libboost-dev)
# Debian's libvtk9-dev depends on everything that its find_package(VTK) needs, except the headers of
# Python and of OpenGL.
build=("${engine[@]}" libvtk9-dev libgdal-dev python3-vtk9 python3-dev libgl-dev
  libcli11-dev nlohmann-json3-dev)
demo=(python3-numpy python3-matplotlib)
tests=(libgtest-dev libcgal-dev xvfb xauth git clang-format universal-ctags dpkg-dev file
  python3-numpy python3-matplotlib python3-venv valgrind openmpi-bin python3-mpi4py ccache)
docs=(doxygen python3-sphinx python3-myst-parser python3-breathe furo python3-sphinx-copybutton
  python3-numpy)
proof=(clang llvm libclang-rt-dev)
paper=("${engine[@]}" libbenchmark-dev libcgal-dev libcli11-dev nlohmann-json3-dev python3-venv
  python3-numpy python3-matplotlib python3-vtk9)
# What find_package(ParaView) of Debian's paraview-dev needs without depending on it, and what
# ParaView's programs load. Qt is that of the release's ParaView.
qt5=(qtbase5-dev libqt5svg5-dev libqt5opengl5-dev libqt5x11extras5-dev qttools5-dev
  qttools5-dev-tools qtxmlpatterns5-dev-tools libqt5sql5-sqlite python3-pyqt5)
qt6=(qt6-base-dev qt6-svg-dev qt6-tools-dev qt6-tools-dev-tools qt6-declarative-dev qt6-5compat-dev
  libqt6sql6-sqlite python3-pyqt6)
paraview=("${engine[@]}" xvfb xauth
  libgl-dev libopengl-dev libegl-dev libgl2ps-dev libglew-dev libx11-dev libxcursor-dev
  libfreetype-dev libjpeg-dev libpng-dev libtiff-dev
  libavcodec-dev libavformat-dev libavutil-dev libswscale-dev libogg-dev libtheora-dev
  libhdf5-openmpi-dev libnetcdf-dev libgdal-dev libproj-dev
  libopenmpi-dev openmpi-bin libpython3-dev python3-mpi4py python3-numpy python3-matplotlib
  libdouble-conversion-dev libeigen3-dev libexpat1-dev libjsoncpp-dev liblz4-dev liblzma-dev
  libutfcpp-dev libxml2-dev zlib1g-dev)

usage()
{
  echo "usage: $0 engine|build|demo|test|docs|proof|paper|paraview" >&2
  exit 2
}

apt_get()
{
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || return 1
    as_root=(sudo)
  fi
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 \
    -o Dpkg::Use-Pty=0 "$@" </dev/null
}

# Reads what apt-get prints, and says how far it is.
count_packages()
{
  local line count=0
  while IFS= read -r line; do
    [[ $line == "Setting up "* ]] || continue
    count=$((count + 1))
    [ $((count % 50)) -ne 0 ] || echo "$count packages are set up"
  done
}

# Usage: dependencies PACKAGE - as this release has them; the first of alternatives; no virtual
# packages, which are in < >.
dependencies()
{
  LC_ALL=C apt-cache depends "$1" 2>/dev/null |
    awk '/Depends:/ { if (!alternative && $2 !~ /</) print $2; alternative = /\|Depends:/ }'
}

# Usage: add_libraries_of_paraview - to what is wanted: its Qt, its VTK if that is a package of its
# own (from Debian testing on), and all that its programs load.
add_libraries_of_paraview()
{
  local libraries
  [ -n "$(dependencies paraview)" ] || apt_get update || true
  mapfile -t libraries < <({ dependencies paraview; dependencies python3-paraview; } |
    grep -v -x -E 'paraview|python3')
  wanted+=("${libraries[@]}")
  case " ${libraries[*]} " in
    *" libqt6core"*) wanted+=("${qt6[@]}") ;;
    *) wanted+=("${qt5[@]}") ;;
  esac
  case " ${libraries[*]} " in
    *" libvtk9"*) wanted+=(libvtk9-dev libvtk9-qt-dev) ;;
  esac
}

case "${1:-}" in
  engine) wanted=("${engine[@]}") ;;
  build) wanted=("${build[@]}") ;;
  demo) wanted=("${build[@]}" "${demo[@]}") ;;
  proof) wanted=("${build[@]}" "${tests[@]}" "${proof[@]}") ;;
  test) wanted=("${build[@]}" "${tests[@]}" "${docs[@]}") ;;
  docs) wanted=("${docs[@]}") ;;
  paper) wanted=("${paper[@]}") ;;
  paraview) wanted=("${paraview[@]}") ;;
  *) usage ;;
esac

if ! command -v apt-get >/dev/null; then
  echo "No apt-get here. Install the equivalents of these packages: ${wanted[*]}" >&2
  exit 0
fi
if [ "$1" = paraview ]; then
  add_libraries_of_paraview
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

echo "Installing ${missing[*]}"
if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
  echo "Run as root, or install by hand: apt-get install ${missing[*]}" >&2
  exit 1
fi
apt_get update
# Removes nothing: python3-vtk9, for one, cannot be installed beside ParaView's Python.
install=(install -y --no-remove --no-install-recommends "${missing[@]}")
apt_get --print-uris "${install[@]}" 2>/dev/null | awk '{ size += $3 }
  END { printf "%d packages with what they need, %d MB to download\n", NR, size / 1e6 }' || true
if ! apt_get "${install[@]}" | count_packages; then
  echo "Cannot install these packages beside those that are here" >&2
  exit 1
fi
