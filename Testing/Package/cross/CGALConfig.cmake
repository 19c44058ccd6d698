# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause

# CGAL for test_cross.py, which compiles tests for other systems: its headers alone, which are in the
# folder DELAUNAYFLIP_CGAL_HEADERS. Boost.Multiprecision takes the place of GMP and MPFR.
find_package(Boost REQUIRED)
if(NOT TARGET CGAL::CGAL)
  add_library(CGAL::CGAL INTERFACE IMPORTED GLOBAL)
  target_include_directories(CGAL::CGAL INTERFACE "${DELAUNAYFLIP_CGAL_HEADERS}")
  target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP=1 CGAL_DISABLE_MPFR=1)
  target_compile_options(CGAL::CGAL INTERFACE -frounding-math) # as CGAL's own configuration
  target_link_libraries(CGAL::CGAL INTERFACE Boost::headers)
endif()
