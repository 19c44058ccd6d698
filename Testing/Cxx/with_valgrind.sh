#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: with_valgrind.sh PROGRAM [ARGUMENT...] - runs a program under valgrind, which must find no
# error and no lost memory. Exit status 125 (skipped) without valgrind.
if ! command -v valgrind >/dev/null; then
  echo "skipped: no valgrind"
  exit 125
fi
exec valgrind --quiet --error-exitcode=1 --leak-check=full --show-leak-kinds=definite \
  --errors-for-leak-kinds=definite "$@"
