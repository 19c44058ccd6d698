// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef HostProgram_h
#define HostProgram_h

namespace delaunayflip
{

/// Whether the filter runs in ParaView's pvbatch, where nobody watches the mesh improve, and
/// scripts and state files expect the final mesh.
bool IsBatchProgram();

}

#endif
