# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# The plugin, with the VTK module DelaunayFlip::Filters inside, for one installation of ParaView.
# ParaView has its own VTK, so find_package(VTK) must not be called.
if(NOT BUILD_SHARED_LIBS)
  message(FATAL_ERROR "ParaView loads shared plugins only: set BUILD_SHARED_LIBS to ON")
endif()
enable_language(C) # ParaView's dependencies are searched for in C
find_package(ParaView 5.9 REQUIRED)

paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/paraview.plugin"
  PROVIDES_PLUGINS delaunayflip_plugins
  REQUIRES_MODULES delaunayflip_plugin_modules
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
# ParaView would add the folder of paraview.plugin, which is the root itself, and CMake refuses
# that. ParaView takes the folder from this property; the file named in it is not read again.
set_property(GLOBAL PROPERTY _paraview_plugin_DelaunayFlip_file
  "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin")

paraview_plugin_build(
  PLUGINS ${delaunayflip_plugins}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  PLUGINS_COMPONENT plugin
  INSTALL_HEADERS OFF)
