#!/bin/sh
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# with_display.sh PROGRAM [ARGUMENT...] - runs a program that draws: on the display there is, else on
# a virtual one. Without either it exits with 125, which CTest reports as skipped.
if [ -n "$DISPLAY" ]; then
  exec "$@"
elif command -v xvfb-run >/dev/null; then
  exec xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24" "$@"
fi
echo "skipped: no display, and no xvfb-run to make one" >&2
exit 125
