# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: . boost.sh - what the wheels say of Debian's Boost, for build-wheel.sh and build-wheels.sh

print_boost_version()
{
  sed -n 's/#define BOOST_LIB_VERSION "\(.*\)"/\1/p' /usr/include/boost/version.hpp | tr _ .
}

print_boost_licence()
{
  sed -n '/^ Boost Software License - Version/,/^$/{/^$/q;s/^ //;s/^\.$//;p}' \
    /usr/share/doc/libboost*-dev/copyright
}
