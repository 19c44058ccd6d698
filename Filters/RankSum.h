// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RankSum_h
#define RankSum_h

namespace delaunayflip
{

struct UpdateSummary;

/// The piece of its input that an update was asked for.
struct Piece
{
  int Number;
  int Count;
};

/// Makes the summary that of all pieces, where the processes of this program update one each, in
/// the order of their ranks, as those of ParaView do and those of programs with a global
/// vtkMultiProcessController. Every rank must come here once an update, whatever became of its
/// meshes. Elsewhere it only notes that a piece has seams.
/// @returns whether this process is the one that tells the user.
bool JoinRanks(UpdateSummary& summary, const Piece& piece);

}

#endif
