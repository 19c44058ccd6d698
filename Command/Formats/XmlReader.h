// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_XMLREADER_H
#define DELAUNAYFLIP_XMLREADER_H

#include "FileMesh.h"
#include "InputFile.h"

namespace delaunayflip
{

class VTKMessages;

/// Reads a .vtp by VTK's reader. What VTK believes of a file is checked before: sizes against its
/// length; ranges, which VTK writes but cannot always read, are not read; and numbers as text are
/// read here, exactly. May die on a corrupt file: to be called in a child process.
/// @throws CommandError (BadFile) that names the file and the reason.
FileMesh ReadXml(const InputFile& file, VTKMessages& messages);

}

#endif
