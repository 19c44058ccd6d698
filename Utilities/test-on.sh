#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: test-on.sh 12|13|testing [OPTION_OF_test.sh]
# Copies this checkout into a minimal Debian of that release and runs demo.sh, build-plugin.sh and
# test.sh there, as on a new machine; then makes a Debian package, installs it in another minimal
# Debian and runs it. Prints a line for robustness.md's table of releases at the end. Exit status 0: all
# of it succeeded. Needs root, debootstrap and ca-certificates.
#
# The Debian is made once and kept, with the build folders in it, so that the next run only rebuilds.
# It is in DELAUNAYFLIP_ROOTS/debian-RELEASE (default: ~/.cache/delaunayflip-roots), and the other
# beside it, new every time. DEBIAN_MIRROR is the archive to install from; JOBS is passed on.
set -euo pipefail

declare -A suites=([12]=bookworm [13]=trixie [testing]=testing)
if [ $# -lt 1 ] || [ -z "${suites[$1]:-}" ]; then
  echo "usage: $0 12|13|testing [OPTION_OF_test.sh]" >&2
  exit 2
fi
release=$1
shift
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "$0 needs root and debootstrap (Debian: debootstrap)" >&2
  exit 1
fi

checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
roots=${DELAUNAYFLIP_ROOTS:-$HOME/.cache/delaunayflip-roots}
root=$roots/debian-$release
other=$root-package
copy=/delaunayflip/checkout # within the root
certificates=/etc/ssl/certificates-of-host.crt # within the root
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}

# Usage: make_debian FOLDER - under another name until it is complete.
make_debian()
{
  local partial=$1.partial
  rm -rf "$partial" "$1"
  mkdir -p "$roots"
  debootstrap --variant=minbase "${suites[$release]}" "$partial" "$mirror" >"$1.log" ||
    { tail "$1.log" >&2 && exit 1; }
  # An archive that is a copy may have old lists of packages.
  echo 'Acquire::Check-Valid-Until "false";' >"$partial/etc/apt/apt.conf.d/90delaunayflip"
  echo force-unsafe-io >"$partial/etc/dpkg/dpkg.cfg.d/90delaunayflip" # faster
  mv "$partial" "$1"
}

# What git tracks or would track, in the place of an earlier copy, but with its build folders. Files
# that are the same keep their times, so that only what depends on others is built again.
copy_checkout()
{
  local old=$root$copy new=$root$copy.new file
  rm -rf "$new"
  mkdir -p "$old" "$new"
  git -C "$checkout" ls-files --cached --others --exclude-standard -z |
    (cd "$checkout" && while IFS= read -r -d '' file; do
      [ ! -f "$file" ] || printf '%s\0' "$file"
    done) | tar -C "$checkout" --null -T - -c | tar -C "$new" --no-same-owner --touch -x
  (cd "$new" && find . -type f -print0) | while IFS= read -r -d '' file; do
    ! cmp -s "$new/$file" "$old/$file" || touch -r "$old/$file" "$new/$file"
  done
  find "$old" -mindepth 1 -maxdepth 1 -name 'build*' -exec mv -t "$new" {} +
  rm -rf "$old"
  mv "$new" "$old"
}

# Usage: open_debian FOLDER - in a mount namespace of this script's own, so that nothing stays
# mounted. Terminals are tested, so /dev comes with its devpts; MPI looks into /sys. pip trusts whom
# this machine trusts, e.g. a proxy.
open_debian()
{
  cp -L /etc/resolv.conf "$1/etc/resolv.conf"
  mkdir -p "$1/etc/ssl"
  cp -L /etc/ssl/certs/ca-certificates.crt "$1$certificates"
  mount -t proc proc "$1/proc"
  mount -t sysfs -o ro sysfs "$1/sys"
  mount --rbind /dev "$1/dev"
}

# Usage: in_debian FOLDER COMMAND... - with an environment like that of a new login.
in_debian()
{
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM="${TERM:-dumb}" \
    JOBS="${JOBS:-2}" PIP_CERT="$certificates" chroot "$@"
}

inside()
{
  in_debian "$root" "$@"
}

# Makes the Debian package of what test.sh has built, and uses it where nothing else is installed.
install_package()
{
  inside sh -c "cd $copy/build && rm -rf packages && cpack -G DEB -B packages" >/dev/null &&
    make_debian "$other" &&
    open_debian "$other" &&
    cp "$root$copy"/build/packages/*.deb "$other/tmp/delaunayflip.deb" &&
    in_debian "$other" sh -ec '
      apt-get -qq update
      DEBIAN_FRONTEND=noninteractive apt-get -qq -y install /tmp/delaunayflip.deb >/dev/null
      cd /tmp
      printf "v -3 0 0\nv 0 -1 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n" >rhombus.obj
      delaunay-flip rhombus.obj better.vtp
      python3 -c "
import delaunayflip
points, triangles = [[-3, 0], [0, -1], [3, 0], [0, 1]], [[0, 1, 2], [0, 2, 3]]
assert delaunayflip.flip(points, triangles).report.total_flips == 1
print(delaunayflip.vtkDelaunayFlip().GetClassName(), \"from Python\")"'
}

# Usage: attempt NAME COMMAND... - shows and keeps what it prints; adds its name to `failures` if it
# fails.
attempt()
{
  local name=$1
  shift
  printf '\n== %s on Debian %s\n' "$name" "$release"
  if ! "$@" 2>&1 | tee "$root.$name.log"; then
    failures+=("$name")
  fi
}

# Usage: in_copy COMMAND... - in the root, in the copy of the checkout.
in_copy()
{
  # shellcheck disable=SC2016 # expands in the root
  inside bash -c 'cd "$0" && exec "$@"' "$copy" "$@"
}

# Usage: version_of PACKAGE - as upstream counts; "-" if it is not installed.
version_of()
{
  # shellcheck disable=SC2016 # dpkg-query's own variable
  { inside dpkg-query -W -f='${Version}\n' "$1" 2>/dev/null || echo -; } |
    sed 's/^[0-9]*://; s/[-+~].*//; s/^$/-/'
}

# ParaView is unpacked, not installed; get-paraview.sh finds it again.
version_of_paraview()
{
  inside apt-cache show paraview 2>/dev/null | sed -n 's/^Version: \([0-9.]*\).*/\1/p' | head -n 1
}

print_line()
{
  local outcome
  outcome=$(sed -n 's/^tests: //p' "$root.test.sh.log" | tail -n 1)
  [ ${#failures[@]} -eq 0 ] || outcome="${outcome:+$outcome; }${failures[*]} failed"
  printf '| Debian %s | %s | %s | %s | %s | %s | %s |\n' "$(inside cat /etc/debian_version)" \
    "$(inside g++ -dumpfullversion)" "$(version_of cmake)" "$(version_of libvtk9-dev)" \
    "$(version_of python3)" "$(version_of_paraview)" "$outcome"
}

if [ "${DELAUNAYFLIP_UNSHARED:-}" != yes ]; then
  DELAUNAYFLIP_UNSHARED=yes exec unshare --mount -- "$0" "$release" "$@"
fi
mount --make-rprivate /
failures=()
[ -d "$root" ] || make_debian "$root"
copy_checkout
open_debian "$root"
attempt demo.sh in_copy Utilities/demo.sh
attempt build-plugin.sh in_copy Utilities/build-plugin.sh
attempt test.sh in_copy Utilities/test.sh "$@"
attempt package install_package
printf '\n'
print_line
[ ${#failures[@]} -eq 0 ]
