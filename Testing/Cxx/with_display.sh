#!/bin/sh
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# with_display.sh PROGRAM [ARGUMENT...] - runs a program that draws, on the current display or else
# on a virtual one. Without either it exits with 125, which CTest reports as skipped.
if [ -n "$DISPLAY" ]; then
  exec "$@"
elif ! command -v Xvfb >/dev/null; then
  echo "skipped: no display, and no Xvfb to make one" >&2
  exit 125
fi

# The server chooses a free number itself: xvfb-run guesses one, and sometimes guesses that of a
# server which is about to end. Without -noreset the server resets whenever its last client leaves,
# and refuses new ones meanwhile.
folder=$(mktemp -d)
LD_LIBRARY_PATH= Xvfb -displayfd 3 -screen 0 1600x1200x24 -nolisten tcp -noreset \
  3>"$folder/display" >"$folder/log" 2>&1 &
server=$!
trap 'kill $server 2>/dev/null; rm -r "$folder"' EXIT
trap 'exit 143' INT TERM
while ! [ -s "$folder/display" ]; do
  if ! kill -0 $server 2>/dev/null; then
    cat "$folder/log" >&2
    exit 1
  fi
  sleep 0.1
done
export DISPLAY=":$(cat "$folder/display")"
"$@"
