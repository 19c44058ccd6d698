#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: get-paraview.sh [FOLDER]
# Prints the folder for ParaView_DIR: the one in the environment, else that of paraview-dev where it
# is installed, else that of Debian's three packages unpacked into FOLDER (default
# build-paraview-sdk/), which this fetches when they are not there yet. Unpacked aside they do not
# conflict with python3-vtk9 and need no root. Exit status 1, with the reason on standard error, where
# none is to be had.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m "${1:-$root/build-paraview-sdk}")
packages=(paraview paraview-dev python3-paraview)

# Usage: find_config PREFIX - prints the folder of ParaView's CMake files below it, if there is one.
find_config()
{
  local config
  for config in "$1"/lib/*/cmake/paraview-*/paraview-config.cmake; do
    if [ -f "$config" ]; then
      dirname "$config"
      return 0
    fi
  done
  return 1
}

fail()
{
  rm -rf "$folder.partial"
  echo "No ParaView: $1" >&2
  exit 1
}

# Beside the folder, and renamed when complete: an interrupted run leaves none that looks whole.
unpack()
{
  local partial="$folder.partial" package
  rm -rf "$partial"
  mkdir -p "$partial"
  (cd "$partial" && apt-get -qq -o APT::Sandbox::User= download "${packages[@]}") >&2 ||
    fail "apt-get cannot download ${packages[*]}; if it never ran here: apt-get update"
  for package in "$partial"/*.deb; do
    dpkg -x "$package" "$partial"
    rm "$package"
  done
  find_config "$partial/usr" >/dev/null || fail "the packages hold no CMake files"
  rm -rf "$folder"
  mv "$partial" "$folder"
}

if [ -n "${ParaView_DIR:-}" ]; then
  echo "$ParaView_DIR"
  exit 0
fi
if dpkg-query -W -f='${db:Status-Status}' paraview-dev 2>/dev/null | grep -qx installed; then
  find_config /usr && exit 0
fi
if ! find_config "$folder/usr"; then
  command -v apt-get >/dev/null || fail "no apt-get here; set ParaView_DIR to the CMake files of your own"
  unpack
  find_config "$folder/usr"
fi
