#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: get-paraview.sh [FOLDER]
# Prints the folder for ParaView_DIR: the one in the environment; else that of paraview-dev, if
# installed and complete; else that of three Debian packages, which are downloaded if necessary and
# unpacked into FOLDER (default build-paraview-sdk/). Unpacked there they do not conflict with python3-vtk9 and
# need no root. If there is no ParaView, the exit status is 1 and standard error has the reason.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
folder=$(realpath -m "${1:-$root/build-paraview-sdk}")
packages=(paraview paraview-dev python3-paraview)

# Usage: find_config PREFIX - prints the folder of ParaView's CMake files below it, if there is one
# and the files that these name exist.
find_config()
{
  local config
  for config in "$1"/lib/*/cmake/paraview-*/paraview-config.cmake; do
    if [ -f "$config" ] && has_python_modules "$1" "$(dirname "$config")"; then
      dirname "$config"
      return 0
    fi
  done
  return 1
}

# Usage: has_python_modules PREFIX CONFIG - they belong to another package than the CMake files, and
# from Debian 13 on have other names; see link_python_modules.
has_python_modules()
{
  local module
  while read -r module; do
    [ -e "$1/$module" ] || return 1
  done < <(grep -rhoE 'lib/python3[^"]*/vtk[A-Za-z0-9]*\.so' "$2" | sort -u)
}

fail()
{
  rm -rf "$folder.partial"
  echo "No ParaView: $1" >&2
  exit 1
}

# Unpacked beside the folder and renamed at the end, so that an interrupted run leaves no incomplete
# folder.
unpack()
{
  local partial="$folder.partial" package
  if [ -e "$folder" ] && ! rmdir "$folder" 2>/dev/null; then
    fail "$folder has something else; remove it, or name another folder"
  fi
  rm -rf "$partial"
  mkdir -p "$partial"
  (cd "$partial" && apt-get -qq -o APT::Sandbox::User= download "${packages[@]}") >&2 ||
    fail "apt-get cannot download ${packages[*]}; first run apt-get update if you never have"
  for package in "$partial"/*.deb; do
    dpkg -x "$package" "$partial"
    rm "$package"
  done
  link_python_modules "$partial/usr"
  find_config "$partial/usr" >/dev/null || fail "the packages contain no CMake files"
  mv -T "$partial" "$folder"
}

# Usage: link_python_modules PREFIX - ParaView's CMake files say vtkX.so where the packages of Debian
# 13 and newer have vtkX.cpython-313-x86_64-linux-gnu.so and the like.
link_python_modules()
{
  local module
  while read -r module; do
    ln -s "$(basename "$module")" "${module%%.cpython-*}.so"
  done < <(find "$1/lib/python3/dist-packages" -name 'vtk*.cpython-*.so')
}

if [ -n "${ParaView_DIR:-}" ]; then
  echo "$ParaView_DIR"
  exit 0
fi
if dpkg-query -W -f='${db:Status-Status}' paraview-dev 2>/dev/null | grep -qx installed; then
  find_config /usr && exit 0
fi
if ! find_config "$folder/usr"; then
  command -v apt-get >/dev/null || fail "no apt-get here; set ParaView_DIR to your ParaView's CMake files"
  unpack
  find_config "$folder/usr"
fi
