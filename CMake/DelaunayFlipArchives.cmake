# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# What cpack makes of a build: an archive that works wherever it is unpacked, and a Debian package
# that depends on the libraries of the machine where it was made.
set(CPACK_GENERATOR TGZ)
find_program(DELAUNAYFLIP_DPKG_SHLIBDEPS dpkg-shlibdeps
  DOC "Finds the packages that a Debian package depends on (Debian: dpkg-dev)")
find_program(DELAUNAYFLIP_FILE file DOC "Tells libraries from other files (Debian: file)")
mark_as_advanced(DELAUNAYFLIP_DPKG_SHLIBDEPS DELAUNAYFLIP_FILE)
if(DELAUNAYFLIP_DPKG_SHLIBDEPS AND DELAUNAYFLIP_FILE)
  list(APPEND CPACK_GENERATOR DEB)
endif()

set(CPACK_PACKAGE_NAME delaunayflip)
set(CPACK_PACKAGE_VENDOR "The DelaunayFlip developers")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_FILE_NAME
  "delaunayflip-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_STRIP_FILES ON)
set(CPACK_MONOLITHIC_INSTALL ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_PACKAGE_DESCRIPTION
  "Turns a triangle mesh into a Delaunay mesh by flipping its edges, in parallel: \
the points stay where they are, the slivers go. This package has the command \
delaunay-flip, the VTK filter vtkDelaunayFlip for C++ and Python, and the \
engine for C++, C and NumPy.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The libraries that the package itself contains.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
# The Python package uses NumPy, and VTK's Python modules where these are wanted.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-vtk9")

set(delaunayflip_texts "${CMAKE_INSTALL_DATAROOTDIR}/doc/delaunayflip")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${delaunayflip_texts}" RENAME copyright)
install(FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${delaunayflip_texts}")
if(TARGET delaunay-flip)
  execute_process(COMMAND sed -nE -f "${CMAKE_CURRENT_LIST_DIR}/man_page.sed"
    "${PROJECT_SOURCE_DIR}/Documentation/reference/command.md"
    OUTPUT_FILE "${PROJECT_BINARY_DIR}/delaunay-flip.1")
  install(FILES "${PROJECT_BINARY_DIR}/delaunay-flip.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${PROJECT_SOURCE_DIR}/Command/delaunay-flip.bash" RENAME delaunay-flip
    DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions")
endif()
# All may read the files, whatever the umask of who makes the package.
file(WRITE "${PROJECT_BINARY_DIR}/make_readable.cmake" "execute_process(
  COMMAND chmod -R u=rwX,go=rX \"\${CPACK_TEMPORARY_INSTALL_DIRECTORY}\")\n")
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_BINARY_DIR}/make_readable.cmake")
include(CPack)
