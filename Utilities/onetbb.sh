# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: . onetbb.sh - Debian's oneTBB as a static library, for build-wheel.sh and build-wheels.sh

# Usage: get_tbb FOLDER - puts the sources into FOLDER/onetbb and sets tbb_version. The system's lists
# of packages stay as they are: deb-src is added to copies.
get_tbb()
{
  local work=$1 apt=$1/apt file archive
  archive=$(find "$work" -maxdepth 1 -name 'onetbb_*.orig.tar.*')
  if [ -z "$archive" ]; then
    mkdir -p "$apt/parts" "$apt/lists"
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
      [ -f "$file" ] || continue
      case $file in
        *.sources) sed 's/^Types: .*/Types: deb-src/' "$file" ;;
        *.list) sed -n 's/^deb /deb-src /p' "$file" ;;
        *) continue ;;
      esac >"$apt/parts/$(basename "$file")"
    done
    local lists=(-q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$apt/parts"
      -o Dir::State::Lists="$apt/lists" -o Dir::Cache="$apt" -o APT::Sandbox::User=)
    apt-get "${lists[@]}" update
    (cd "$work" && apt-get "${lists[@]}" source --download-only onetbb)
    archive=$(find "$work" -maxdepth 1 -name 'onetbb_*.orig.tar.*')
  fi
  tbb_version=$(basename "$archive" | sed 's/onetbb_\(.*\)\.orig.*/\1/')
  if [ ! -d "$work/onetbb" ]; then
    rm -rf "$work/onetbb.partial"
    mkdir "$work/onetbb.partial"
    tar -xf "$archive" -C "$work/onetbb.partial" --strip-components=1
    # A library that is not a file of its own has no resources of Windows, and exports nothing.
    sed -i '/PRIVATE tbb\.rc/d' "$work/onetbb.partial/src/tbb/CMakeLists.txt"
    sed -i 's/__declspec(dllexport)//' "$work/onetbb.partial/include/oneapi/tbb/detail/_export.h"
    mv "$work/onetbb.partial" "$work/onetbb"
  fi
}

# Usage: build_tbb SOURCES BUILD PREFIX [OPTION...] - unless it is there
build_tbb()
{
  if [ -f "$3/lib/cmake/TBB/TBBConfig.cmake" ]; then
    return
  fi
  cmake -S "$1" -B "$2" -G Ninja -Wno-dev -Wno-deprecated -DCMAKE_BUILD_TYPE=Release \
    -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DTBB_TEST=OFF -DTBB_STRICT=OFF \
    -DTBBMALLOC_BUILD=OFF -DTBB_ENABLE_IPO=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON \
    -DCMAKE_CXX_VISIBILITY_PRESET=hidden -DCMAKE_VISIBILITY_INLINES_HIDDEN=ON \
    -DCMAKE_INSTALL_PREFIX="$3" -DCMAKE_INSTALL_LIBDIR=lib "${@:4}"
  cmake --build "$2" --target install
}
