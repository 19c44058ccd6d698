// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef HostProgram_h
#define HostProgram_h

namespace delaunayflip
{

/// Whether the filter runs in ParaView's pvbatch, where no one watches the mesh improve: its
/// scripts and state files want the end.
bool IsBatchProgram();

}

#endif
