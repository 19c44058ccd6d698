# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Makes the man page of delaunay-flip from the table of Documentation/reference/command.md.
1i .TH DELAUNAY\\-FLIP 1\
.SH NAME\
delaunay\\-flip \\- turns a triangle mesh into a Delaunay mesh by edge flips\
.SH SYNOPSIS\
.B delaunay\\-flip\
[OPTIONS] INPUT OUTPUT\
.SH DESCRIPTION\
Flips edges until the mesh is Delaunay. Points never move.\
.SH OPTIONS
s/\\/\\e/g
s/-/\\-/g
s/^\| `([^`]*)` \| (.*) \|$/.TP\n.B \1\n\2/p
$a .SH EXIT STATUS\
0 done; 2 wrong usage; 3 a file cannot be read or written; 4 iteration limit reached (the output is\
written); 5 the requested backend is not available; 129, 130 or 143 ended by a signal.
