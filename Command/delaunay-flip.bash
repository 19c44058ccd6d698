# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Completion for bash: options and their choices, as --help prints them, and names of files.
_delaunay_flip()
{
  local help choices
  help=$("$1" --help 2>/dev/null)
  choices=$(sed -nE "s/^ *$3 \{([^}]*)\}.*/\1/p" <<<"$help")
  if [ -n "$choices" ]; then
    mapfile -t COMPREPLY < <(compgen -W "${choices//,/ }" -- "$2")
  elif [[ $2 == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE '^ +(-h, *)?--[a-z-]+' <<<"$help")" -- "$2")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$2")
  fi
}
complete -o filenames -F _delaunay_flip delaunay-flip
