#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: build-docs.sh [FOLDER]
# Installs missing packages (Debian) and builds the documentation's site into FOLDER (default:
# build-docs/html). Warnings are errors.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." >/dev/null && pwd)
site=$(realpath -m "${1:-$root/build-docs/html}")
export PYTHONDONTWRITEBYTECODE=1

"$root/Utilities/install-packages.sh" docs
/usr/bin/python3 -m sphinx -q -W --keep-going -d "$root/build-docs/cache" "$root/Documentation" "$site"
echo "Done: $site/index.html"
