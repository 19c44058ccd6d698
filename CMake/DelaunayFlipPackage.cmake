# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs the engine, its C interface, and what find_package(DelaunayFlip) of other projects reads.
# The VTK modules install themselves; see DelaunayFlipVTK.cmake.
set(delaunayflip_cmake "${CMAKE_INSTALL_LIBDIR}/cmake/DelaunayFlip")
install(TARGETS DelaunayFlipEngine EXPORT DelaunayFlipEngine
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  PUBLIC_HEADER DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delaunayflip")
install(EXPORT DelaunayFlipEngine NAMESPACE DelaunayFlip:: FILE DelaunayFlip-engine-targets.cmake
  DESTINATION "${delaunayflip_cmake}")
install(TARGETS DelaunayFlipC EXPORT DelaunayFlipC
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
  PUBLIC_HEADER DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delaunayflip")
install(EXPORT DelaunayFlipC NAMESPACE DelaunayFlip:: FILE DelaunayFlip-c-targets.cmake
  DESTINATION "${delaunayflip_cmake}")

# The values for DelaunayFlipConfig.cmake.in.
string(REPLACE "DelaunayFlip::" "" delaunayflip_vtk_components "${delaunayflip_modules}")
set(delaunayflip_packages_of_engine TBB) # the library is static, so its users link these
if(DELAUNAYFLIP_HAS_CUDA)
  list(APPEND delaunayflip_packages_of_engine CUDAToolkit)
endif()

include(CMakePackageConfigHelpers)
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/DelaunayFlipConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/DelaunayFlipConfig.cmake" INSTALL_DESTINATION "${delaunayflip_cmake}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/DelaunayFlipConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/DelaunayFlipConfig.cmake"
  "${PROJECT_BINARY_DIR}/DelaunayFlipConfigVersion.cmake" DESTINATION "${delaunayflip_cmake}")
