# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# The VTK modules DelaunayFlip::Filters and, if VTK can draw, DelaunayFlip::Rendering; their Python
# wrapping and their install rules.

if(NOT BUILD_SHARED_LIBS)
  message(FATAL_ERROR "The VTK modules are shared libraries: set BUILD_SHARED_LIBS to ON, or "
    "DELAUNAYFLIP_BUILD_VTK to OFF for the engine alone")
endif()
option(DELAUNAYFLIP_BUILD_RENDERING "Build the live view, where VTK has what it draws with" ON)

# All VTK modules that any folder uses are found here: VTK defines its targets in the folder that
# finds it first, and what those link to must be known there.
set(delaunayflip_vtk_drawing "") # for DelaunayFlip::Rendering and its example
if(DELAUNAYFLIP_BUILD_RENDERING)
  set(delaunayflip_vtk_drawing FiltersCore IOImage RenderingAnnotation RenderingCore
    RenderingFreeType RenderingOpenGL2)
  if(DELAUNAYFLIP_BUILD_TESTING)
    enable_language(C) # a VTK with MPI, such as Debian's, needs MPI for C
    list(APPEND delaunayflip_vtk_drawing InteractionStyle RenderingUI)
  endif()
endif()
set(delaunayflip_vtk CommonCore CommonDataModel CommonExecutionModel CommonMisc
  IOGeometry IOLegacy IOPLY IOXML vtksys)
if(DELAUNAYFLIP_BUILD_TESTING)
  list(APPEND delaunayflip_vtk FiltersCore FiltersSources FiltersVerdict IOImage RenderingCore RenderingOpenGL2
    TestingRendering)
endif()
set(delaunayflip_vtk_optional ParallelCore WrappingPythonCore WrappingTools ${delaunayflip_vtk_drawing})
if(DELAUNAYFLIP_BUILD_TESTING AND NOT DELAUNAYFLIP_SANITIZER) # MPI leaks
  enable_language(C)
  list(APPEND delaunayflip_vtk_optional IOParallelXML ParallelMPI) # of an example
endif()
list(REMOVE_ITEM delaunayflip_vtk_optional ${delaunayflip_vtk}) # CMake allows no component in both
find_package(VTK 9.1 REQUIRED
  COMPONENTS ${delaunayflip_vtk}
  OPTIONAL_COMPONENTS ${delaunayflip_vtk_optional})

set(delaunayflip_opengl VTK::glew) # what loads OpenGL's functions
if(TARGET VTK::glad) # since VTK 9.4
  set(delaunayflip_opengl VTK::glad)
endif()

set(delaunayflip_module_files "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module")
set(delaunayflip_vtk_installed CommonCore CommonDataModel CommonExecutionModel CommonTransforms) # what users need
option(DELAUNAYFLIP_BUILD_PARALLEL "Build the filter for many ranks, where VTK has ParallelCore" ON)
set(DELAUNAYFLIP_PARALLEL OFF) # whether it is built
if(DELAUNAYFLIP_BUILD_PARALLEL AND TARGET VTK::ParallelCore)
  set(DELAUNAYFLIP_PARALLEL ON)
  list(APPEND delaunayflip_module_files "${CMAKE_CURRENT_SOURCE_DIR}/FiltersParallel/vtk.module")
  list(APPEND delaunayflip_vtk_installed ParallelCore)
elseif(DELAUNAYFLIP_BUILD_PARALLEL)
  message(STATUS "Filter for many ranks: not built, this VTK has no ParallelCore")
endif()
set(DELAUNAYFLIP_RENDERING ${DELAUNAYFLIP_BUILD_RENDERING}) # whether the live view is built
foreach(component IN LISTS delaunayflip_vtk_drawing)
  if(NOT TARGET VTK::${component})
    message(STATUS "Live view: not built, this VTK has no ${component}")
    set(DELAUNAYFLIP_RENDERING OFF)
  endif()
endforeach()
if(DELAUNAYFLIP_RENDERING)
  list(APPEND delaunayflip_module_files "${CMAKE_CURRENT_SOURCE_DIR}/Rendering/vtk.module")
  list(APPEND delaunayflip_vtk_installed RenderingCore RenderingFreeType RenderingOpenGL2)
endif()

vtk_module_scan(
  MODULE_FILES ${delaunayflip_module_files}
  PROVIDES_MODULES delaunayflip_modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${delaunayflip_modules}
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delaunayflip"
  INSTALL_EXPORT DelaunayFlip)
foreach(delaunayflip_module IN LISTS delaunayflip_modules) # which need each other
  string(REPLACE "DelaunayFlip::" "" delaunayflip_target "${delaunayflip_module}")
  set_target_properties(${delaunayflip_target} PROPERTIES INSTALL_RPATH "$ORIGIN")
endforeach()

set(DELAUNAYFLIP_PYTHON OFF) # whether the Python package is built
if(DELAUNAYFLIP_SANITIZER)
  return() # Python itself would have to be instrumented
endif()
if(NOT TARGET VTK::WrappingPythonCore OR NOT TARGET VTK::WrapPython)
  message(STATUS "Python package delaunayflip: not built, this VTK has no Python wrapping")
  return()
endif()

find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
set(DELAUNAYFLIP_PYTHON ON)
vtk_module_wrap_python(
  MODULES ${delaunayflip_modules}
  PYTHON_PACKAGE delaunayflip
  MODULE_DESTINATION "${delaunayflip_packages}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  SOABI "${Python3_SOABI}"
  INSTALL_HEADERS OFF)
# By this name Python/delaunayflip/_vtk.py tells whether the modules are for the VTK in use.
file(GENERATE OUTPUT "${DELAUNAYFLIP_PYTHONPATH}/delaunayflip/_vtk_build.py"
  CONTENT "COMMON_CORE = \"$<TARGET_SONAME_FILE_NAME:VTK::CommonCore>\"\n")
install(FILES "${DELAUNAYFLIP_PYTHONPATH}/delaunayflip/_vtk_build.py"
  DESTINATION "${delaunayflip_packages}/delaunayflip" COMPONENT python)
