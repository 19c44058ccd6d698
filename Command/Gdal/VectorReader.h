// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VECTORREADER_H
#define DELAUNAYFLIP_VECTORREADER_H

#include "GdalModule.h"

namespace delaunayflip
{

/// Does what GdalModule::ReadVectors does.
FileMesh ReadVectors(const VectorRequest& request);

}

#endif
