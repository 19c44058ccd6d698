// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_XMLREADER_H
#define DELAUNAYFLIP_XMLREADER_H

#include "FileMesh.h"
#include "InputFile.h"

namespace delaunayflip
{

class VTKMessages;

/// Reads a .vtp with VTK's reader, after some checks: sizes are compared with the length of the
/// file, ranges are ignored because VTK cannot read all that it writes, and numbers in text are
/// read here, exactly. Call this in a child process: VTK may crash on a corrupt file.
/// @throws CommandError (BadFile) that names the file and the reason.
FileMesh ReadXml(const InputFile& file, VTKMessages& messages);

}

#endif
