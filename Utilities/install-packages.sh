#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: install-packages.sh build|demo|test
# Installs the Debian packages that building, the demo or the tests need; asks nothing, and touches
# nothing when all of them are there already.
set -euo pipefail

# What find_package(VTK) of Debian's libvtk9-dev asks for comes with that package, except for the
# headers of Python and of OpenGL.
build=(g++ cmake ninja-build ca-certificates
  libvtk9-dev python3-vtk9 python3-dev libgl-dev
  libtbb-dev libboost-dev libcli11-dev nlohmann-json3-dev)
demo=(python3-numpy python3-matplotlib)
tests=(libgtest-dev libcgal-dev xvfb xauth git clang-format-14 clang-format universal-ctags
  python3-numpy)

case "${1:-}" in
  build) wanted=("${build[@]}") ;;
  demo) wanted=("${build[@]}" "${demo[@]}") ;;
  test) wanted=("${build[@]}" "${tests[@]}") ;;
  *)
    echo "usage: $0 build|demo|test" >&2
    exit 2
    ;;
esac

if ! command -v apt-get >/dev/null; then
  echo "No apt-get here. Make sure you have the equivalents of: ${wanted[*]}" >&2
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Run as root, or install by hand: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt_get()
{
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 \
    -o Dpkg::Use-Pty=0 "$@" </dev/null
}

echo "Installing ${missing[*]}"
apt_get update
apt_get install -y --no-install-recommends "${missing[@]}" >/dev/null
