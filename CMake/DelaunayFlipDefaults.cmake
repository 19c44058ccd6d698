# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# Settings of all targets: language level, output folders, build type, sanitizers.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# Compilers for Arm fuse products and sums unless they are told not to; see Engine/CMakeLists.txt.
# The instructions that all x86-64 processors have cannot, but an option can allow more of them.
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" OR CMAKE_CXX_FLAGS MATCHES "-m(arch|cpu|fma|avx)")
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-ffp-contract=off>)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
# This is as after an installation: the Python package finds the C library beside its own folder.
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")

# VTK modules default to static libraries, which neither Python nor ParaView can load.
if(PROJECT_IS_TOP_LEVEL)
  option(BUILD_SHARED_LIBS "Build the VTK module as a shared library" ON)
elseif(NOT DEFINED BUILD_SHARED_LIBS)
  set(BUILD_SHARED_LIBS ON) # not in the cache, which belongs to the parent project
endif()

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Real meshes that this project cannot ship. Tests that need them are skipped without them.
set(DELAUNAYFLIP_DATA_DIR "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data" CACHE PATH
  "Folder of real meshes for the real-data tests")

option(DELAUNAYFLIP_LIBFUZZER "Instrument for libFuzzer and build its targets (Clang)" OFF)

# Makes a first build shorter. It is off by default because it hides that a source lacks an
# include.
option(DELAUNAYFLIP_PRECOMPILE "Precompile headers of the standard library and of VTK" OFF)
set(delaunayflip_standard_headers
  <algorithm> <array> <cmath> <cstdint> <cstring> <functional> <iterator> <limits> <map> <memory>
  <numeric> <set> <sstream> <string> <tuple> <type_traits> <utility> <vector>)
set(delaunayflip_vtk_headers
  <vtkCellArray.h> <vtkCellData.h> <vtkDoubleArray.h> <vtkFieldData.h> <vtkInformation.h>
  <vtkInformationVector.h> <vtkIntArray.h> <vtkNew.h> <vtkObjectFactory.h> <vtkPointData.h>
  <vtkPoints.h> <vtkPolyData.h> <vtkSmartPointer.h> <vtkStringArray.h>)

# Usage: delaunayflip_precompile(TARGET HEADER...) - if DELAUNAYFLIP_PRECOMPILE asks for it.
function(delaunayflip_precompile target)
  if(DELAUNAYFLIP_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${delaunayflip_standard_headers} ${ARGN})
  endif()
endfunction()

# Usage: delaunayflip_instrument(TARGET) - adds warnings, and what DELAUNAYFLIP_SANITIZER and
# DELAUNAYFLIP_LIBFUZZER ask for.
function(delaunayflip_instrument target)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wall -Wextra -Wshadow>)
  if(DELAUNAYFLIP_LIBFUZZER)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    target_link_options(${target} PUBLIC -fsanitize=fuzzer-no-link)
  endif()
  if(DELAUNAYFLIP_SANITIZER STREQUAL "address")
    set(flags -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  elseif(DELAUNAYFLIP_SANITIZER STREQUAL "thread")
    set(flags -fsanitize=thread -fno-omit-frame-pointer)
  elseif(DELAUNAYFLIP_SANITIZER STREQUAL "coverage")
    set(flags -fprofile-instr-generate -fcoverage-mapping -fprofile-update=atomic)
  else()
    return()
  endif()
  target_compile_options(${target} PRIVATE ${flags})
  target_link_options(${target} PUBLIC ${flags})
endfunction()
