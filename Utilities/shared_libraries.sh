#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: shared_libraries.sh PROGRAM... - paths of their shared libraries but those of every Linux,
# for a bundle.
set -euo pipefail

ldd "$@" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' |
  grep -v -E '/(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)\.so' | sort -u
