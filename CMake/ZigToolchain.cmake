# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# A toolchain for other systems: the compiler of the package ziglang of PyPI, which is Clang with the
# libraries of each system. Utilities/build-wheels.sh uses it. In the environment:
#   DELAUNAYFLIP_ZIG         the program zig
#   DELAUNAYFLIP_ZIG_TARGET  what to build for, e.g. aarch64-linux-gnu.2.28
set(target "$ENV{DELAUNAYFLIP_ZIG_TARGET}")
if(target MATCHES "macos")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_OSX_SYSROOT "")
  set(CMAKE_INSTALL_NAME_DIR @rpath) # else the library is named by its path in the build
  set(CMAKE_BUILD_WITH_INSTALL_NAME_DIR ON)
elseif(target MATCHES "windows")
  set(CMAKE_SYSTEM_NAME Windows)
else()
  set(CMAKE_SYSTEM_NAME Linux)
endif()
string(REGEX MATCH "^[a-z0-9_]+" CMAKE_SYSTEM_PROCESSOR "${target}")

set(CMAKE_C_COMPILER "$ENV{DELAUNAYFLIP_ZIG}" cc -target ${target})
set(CMAKE_CXX_COMPILER "$ENV{DELAUNAYFLIP_ZIG}" c++ -target ${target})
# CMake runs these without arguments of ours. They find the compiler beside them, also in a folder that
# was moved.
foreach(tool ar ranlib)
  string(TOUPPER ${tool} variable)
  set(program "$ENV{DELAUNAYFLIP_ZIG}-${tool}")
  if(NOT EXISTS "${program}")
    file(WRITE "${program}" "#!/bin/sh\nexec \"\${0%-*}\" ${tool} \"$@\"\n")
    file(CHMOD "${program}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  endif()
  set(CMAKE_${variable} "${program}")
endforeach()

# Boost 1.74 derives from std::unary_function, which libc++ leaves out of C++17.
set(CMAKE_CXX_FLAGS_INIT -D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -Wl,-s) # no symbols but those that are exported
set(CMAKE_BUILD_WITH_INSTALL_RPATH ON) # there is no install_name_tool to change it later

# Libraries and headers that are found here are for this machine, so the caller names those to use.
set(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH OFF)
