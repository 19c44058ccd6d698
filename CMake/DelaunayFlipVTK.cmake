# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# The VTK module DelaunayFlip::Filters, its Python package and its install rules.

# All that any folder uses is looked for here: VTK makes its targets where it is found first, and
# what those link to must be known there.
set(delaunayflip_vtk CommonCore CommonDataModel CommonExecutionModel
  IOGeometry IOLegacy IOPLY IOXML vtksys)
if(DELAUNAYFLIP_BUILD_TESTING)
  list(APPEND delaunayflip_vtk FiltersCore FiltersVerdict IOImage RenderingCore RenderingOpenGL2
    TestingRendering)
endif()
find_package(VTK 9.1 REQUIRED
  COMPONENTS ${delaunayflip_vtk}
  OPTIONAL_COMPONENTS WrappingPythonCore WrappingTools)

vtk_module_scan(
  MODULE_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
  PROVIDES_MODULES delaunayflip_modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${delaunayflip_modules}
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delaunayflip"
  INSTALL_EXPORT DelaunayFlip)
install(FILES CUDA/FlipReport.h CUDA/FlipOptions.h # of vtkDelaunayFlip::GetReport()
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delaunayflip")

# find_package(DelaunayFlip) of other projects.
include(CMakePackageConfigHelpers)
set(delaunayflip_cmake "${CMAKE_INSTALL_LIBDIR}/cmake/DelaunayFlip")
configure_package_config_file(CMake/DelaunayFlipConfig.cmake.in
  "${CMAKE_BINARY_DIR}/DelaunayFlipConfig.cmake" INSTALL_DESTINATION "${delaunayflip_cmake}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/DelaunayFlipConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/DelaunayFlipConfig.cmake"
  "${CMAKE_BINARY_DIR}/DelaunayFlipConfigVersion.cmake" DESTINATION "${delaunayflip_cmake}")

set(DELAUNAYFLIP_PYTHON OFF) # whether the Python package is built
if(NOT TARGET VTK::WrappingPythonCore OR NOT TARGET VTK::WrapPython)
  message(STATUS "Python package delaunayflip: not built, this VTK has no Python wrapping")
  return()
endif()

find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
set(DELAUNAYFLIP_PYTHON ON)
set(delaunayflip_packages "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
set(DELAUNAYFLIP_PYTHONPATH "${CMAKE_BINARY_DIR}/${delaunayflip_packages}")
vtk_module_wrap_python(
  MODULES ${delaunayflip_modules}
  PYTHON_PACKAGE delaunayflip
  MODULE_DESTINATION "${delaunayflip_packages}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  SOABI "${Python3_SOABI}"
  INSTALL_HEADERS OFF)
configure_file(Filters/Python/__init__.py "${DELAUNAYFLIP_PYTHONPATH}/delaunayflip/__init__.py"
  COPYONLY)
install(FILES Filters/Python/__init__.py
  DESTINATION "${delaunayflip_packages}/delaunayflip" COMPONENT python)
