// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VECTORREADER_H
#define DELAUNAYFLIP_VECTORREADER_H

#include "GdalModule.h"

class OGRSpatialReference;

namespace delaunayflip
{

/// A coordinate reference system in one of the formats that GDAL calls so.
std::string WriteCrs(const OGRSpatialReference& crs, const std::string& format);

/// Does what GdalModule::ReadVectors does.
FileMesh ReadVectors(const VectorRequest& request);

}

#endif
