# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# A wheel has the library in the package, where pyproject.toml puts the Python files. A wheel has no
# symbolic links, so the library's file gets the name by which it is loaded.
if(DELAUNAYFLIP_WHEEL)
  message(STATUS "Compiling the engine takes about two minutes on two cores, and longer with "
    "CUDA; --config-settings=cmake.define.DELAUNAYFLIP_ENABLE_CUDA=OFF leaves CUDA out")
  set_target_properties(DelaunayFlipC PROPERTIES
    VERSION 1
    INSTALL_RPATH_USE_LINK_PATH ON)
  install(TARGETS DelaunayFlipC
    LIBRARY DESTINATION delaunayflip COMPONENT wheel NAMELINK_SKIP
    RUNTIME DESTINATION delaunayflip COMPONENT wheel) # of Windows
  install(FILES "${PROJECT_SOURCE_DIR}/Plugin/DelaunayFlip.xml"
    "${PROJECT_SOURCE_DIR}/Plugin/AngleColors.json"
    DESTINATION delaunayflip COMPONENT wheel)
  return()
endif()

# The Python package delaunayflip, in the folder DELAUNAYFLIP_PYTHONPATH of the build. It finds
# libdelaunayflip in a folder above; DelaunayFlipVTK adds the wrapped VTK modules.
set(delaunayflip_packages "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
set(DELAUNAYFLIP_PYTHONPATH "${CMAKE_BINARY_DIR}/${delaunayflip_packages}")

file(GLOB delaunayflip_python_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/Python/delaunayflip/*.py")
list(APPEND delaunayflip_python_files "${PROJECT_SOURCE_DIR}/Python/delaunayflip/py.typed"
  # For plugin/DelaunayFlip.py, a plugin of ParaView:
  "${PROJECT_SOURCE_DIR}/Plugin/DelaunayFlip.xml" "${PROJECT_SOURCE_DIR}/Plugin/AngleColors.json")
foreach(file IN LISTS delaunayflip_python_files)
  get_filename_component(name "${file}" NAME)
  configure_file("${file}" "${DELAUNAYFLIP_PYTHONPATH}/delaunayflip/${name}" COPYONLY)
endforeach()
set(delaunayflip_plugin "${PROJECT_SOURCE_DIR}/Python/delaunayflip/plugin/DelaunayFlip.py")
configure_file("${delaunayflip_plugin}"
  "${DELAUNAYFLIP_PYTHONPATH}/delaunayflip/plugin/DelaunayFlip.py" COPYONLY)
if(NOT DELAUNAYFLIP_PARAVIEW)
  install(FILES ${delaunayflip_python_files}
    DESTINATION "${delaunayflip_packages}/delaunayflip" COMPONENT python)
  install(FILES "${delaunayflip_plugin}"
    DESTINATION "${delaunayflip_packages}/delaunayflip/plugin" COMPONENT python)
endif()
