# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# Resolves DELAUNAYFLIP_ENABLE_CUDA into DELAUNAYFLIP_HAS_CUDA and enables the language.
set(DELAUNAYFLIP_HAS_CUDA OFF)
if(NOT DELAUNAYFLIP_ENABLE_CUDA OR DELAUNAYFLIP_SANITIZER)
  return() # the CPU's sanitizers do not support device code
endif()

# Older ones lack what DeviceMemory.cpp asks of the runtime (cudaDriverEntryPointQueryResult).
set(delaunayflip_oldest_cuda 12)

# Sets delaunayflip_nvcc and delaunayflip_nvcc_version to the nvcc that CMake would take, or to
# nothing. CMake itself must not try an old one: it often rejects the host's compiler, and CMake then
# says that there is no CUDA compiler.
function(delaunayflip_find_nvcc)
  separate_arguments(named UNIX_COMMAND "$ENV{CUDACXX}") # it may have options
  if(CMAKE_CUDA_COMPILER)
    set(named "${CMAKE_CUDA_COMPILER}")
  endif()
  list(APPEND named nvcc)
  list(GET named 0 name)
  unset(program)
  find_program(program NAMES "${name}" PATHS "$ENV{CUDA_PATH}/bin" NO_CACHE)
  set(text "")
  if(program)
    execute_process(COMMAND "${program}" --version OUTPUT_VARIABLE text ERROR_QUIET)
  endif()
  string(REGEX MATCH "release ([0-9]+\\.[0-9]+)" release "${text}")
  set(delaunayflip_nvcc "${program}" PARENT_SCOPE)
  set(delaunayflip_nvcc_version "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

delaunayflip_find_nvcc()
set(delaunayflip_reason "")
if(delaunayflip_nvcc_version AND delaunayflip_nvcc_version VERSION_LESS delaunayflip_oldest_cuda)
  string(CONCAT delaunayflip_reason "${delaunayflip_nvcc} is of CUDA ${delaunayflip_nvcc_version}, "
    "and CUDA ${delaunayflip_oldest_cuda} or newer is needed")
else()
  include(CheckLanguage)
  check_language(CUDA)
  if(NOT CMAKE_CUDA_COMPILER)
    set(delaunayflip_reason "no CUDA compiler was found")
  endif()
endif()
if(delaunayflip_reason)
  if(NOT DELAUNAYFLIP_ENABLE_CUDA STREQUAL "AUTO")
    message(FATAL_ERROR "DELAUNAYFLIP_ENABLE_CUDA is ${DELAUNAYFLIP_ENABLE_CUDA}, but "
      "${delaunayflip_reason}; install a newer CUDA Toolkit and set CMAKE_CUDA_COMPILER to its "
      "nvcc, or set DELAUNAYFLIP_ENABLE_CUDA to OFF")
  endif()
  message(STATUS "CUDA backend: not built, ${delaunayflip_reason}")
  return()
endif()

set(CMAKE_CUDA_STANDARD 17)
set(CMAKE_CUDA_STANDARD_REQUIRED ON)
set(CMAKE_CUDA_RUNTIME_LIBRARY Static)
set(CMAKE_CUDA_VISIBILITY_PRESET hidden)
# Enabling the language would store the compiler's default in the cache, and the next run of CMake
# would mistake it for the user's choice. So a value must be set first.
set(delaunayflip_choose_architectures OFF)
if(NOT CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
  set(delaunayflip_choose_architectures ON)
  set(CMAKE_CUDA_ARCHITECTURES 75)
endif()
enable_language(CUDA)
option(DELAUNAYFLIP_CUDA_FOR_THIS_MACHINE
  "Build the CUDA backend only for the GPUs that are here; if there are none, PTX for Turing, which newer drivers compile"
  ${DELAUNAYFLIP_WHEEL})
if(delaunayflip_choose_architectures AND DELAUNAYFLIP_CUDA_FOR_THIS_MACHINE)
  execute_process(COMMAND nvidia-smi --query-gpu=compute_cap --format=csv,noheader
    OUTPUT_VARIABLE delaunayflip_gpus ERROR_QUIET)
  string(REGEX MATCHALL "[0-9]+\\.[0-9]" delaunayflip_gpus "${delaunayflip_gpus}")
  list(TRANSFORM delaunayflip_gpus REPLACE "\\." "")
  execute_process(COMMAND "${CMAKE_CUDA_COMPILER}" --list-gpu-arch OUTPUT_VARIABLE delaunayflip_known)
  set(delaunayflip_architectures "")
  foreach(delaunayflip_gpu IN LISTS delaunayflip_gpus)
    if(delaunayflip_gpu LESS 75 OR NOT delaunayflip_known MATCHES "compute_${delaunayflip_gpu}\n")
      set(delaunayflip_gpu 75) # too old, or newer than the toolkit: runs PTX
    endif()
    list(APPEND delaunayflip_architectures ${delaunayflip_gpu})
  endforeach()
  if(delaunayflip_architectures)
    list(REMOVE_DUPLICATES delaunayflip_architectures)
    set(CMAKE_CUDA_ARCHITECTURES ${delaunayflip_architectures})
  endif()
elseif(delaunayflip_choose_architectures)
  # Every generation from Turing on that the toolkit knows, newer ones through PTX. The "all-major"
  # of toolkits before 13 begins earlier.
  if(CMAKE_CUDA_COMPILER_VERSION VERSION_LESS 13 OR CMAKE_VERSION VERSION_LESS 3.23)
    set(CMAKE_CUDA_ARCHITECTURES 75 80 86 90)
  else()
    set(CMAKE_CUDA_ARCHITECTURES all-major)
  endif()
endif()
find_package(CUDAToolkit REQUIRED)
set(DELAUNAYFLIP_HAS_CUDA ON)
message(STATUS "CUDA backend: for architectures ${CMAKE_CUDA_ARCHITECTURES}")
