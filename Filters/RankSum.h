// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RankSum_h
#define RankSum_h

namespace delaunayflip
{

struct UpdateSummary;

/// The piece that an update was requested for.
struct Piece
{
  int Number;
  int Count;
};

/// Sums `summary` up over all pieces if each process of this program updates one piece, in the
/// order of ranks. This is so in ParaView and in programs that set a global
/// vtkMultiProcessController. Every rank must call this once per update, even if its meshes failed.
/// In other programs, this only notes that a piece has seams.
/// @returns whether this process gives the messages.
bool JoinRanks(UpdateSummary& summary, const Piece& piece);

}

#endif
