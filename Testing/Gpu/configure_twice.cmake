# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# Usage: cmake -DSOURCE=... -DBINARY=... -DCOMPILER=... -P configure_twice.cmake
# Checks that a second run of CMake still builds for the same GPUs, not for the compiler's default.
file(REMOVE_RECURSE "${BINARY}")
foreach(run first second)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${BINARY}" -DDELAUNAYFLIP_BUILD_VTK=OFF
      -DDELAUNAYFLIP_BUILD_TESTING=OFF -DDELAUNAYFLIP_ENABLE_CUDA=ON
      "-DCMAKE_CUDA_COMPILER=${COMPILER}"
    OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
  string(REGEX MATCH "CUDA backend: for architectures [^\n]*" ${run} "${text}")
  if(NOT status EQUAL 0 OR NOT ${run})
    message(FATAL_ERROR "The ${run} run failed:\n${text}")
  endif()
endforeach()
if(NOT first STREQUAL second)
  message(FATAL_ERROR "first run: ${first}\nsecond run: ${second}")
endif()
