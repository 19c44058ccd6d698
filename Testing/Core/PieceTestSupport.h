// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECETESTSUPPORT_H
#define DELAUNAYFLIP_PIECETESTSUPPORT_H

#include "DividedMesh.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What tests of divided meshes expect of them.

namespace delaunayflip
{

/// The parameter is the number of ranks.
class RanksTest : public testing::TestWithParam<int>
{
protected:
  Owners Scatter(const TriangleMesh& mesh) const { return DivideAtRandom(mesh, GetParam(), 21); }
  Owners Cut(const TriangleMesh& mesh) const { return DivideBySpace(mesh, GetParam()); }
};

/// 3 -> "3Ranks"
inline std::string NameRanks(const testing::TestParamInfo<int>& info)
{
  return std::to_string(info.param) + "Ranks";
}

/// Planar, with canonical ties, on one thread per rank: the triangles are unique.
FlipOptions MakeCanonical();

/// The same in pieces, without ranks.
FlipOptions MakeInPieces(int pieces);

/// On a surface, on one thread per rank.
FlipOptions MakeOnSurface(double featureAngle = 180.0);

/// Every ninth edge, as constraints.
std::vector<std::int64_t> ChooseEdges(const TriangleMesh& mesh);

void ExpectSameOnAllRanks(const std::vector<PiecesReport>& reports);

/// Reports a failure for every count of the whole mesh that one rank finds otherwise.
void ExpectSameCounts(const FlipReport& alone, const PiecesReport& together);

/// For meshes whose result is unique: expects the triangles and counts of one rank.
GroupResult ExpectSameTriangles(const TriangleMesh& mesh, const Owners& owners, int ranks,
  const FlipOptions& options, bool withNumbers = true);

/// For meshes whose result depends on the order of flips: expects that nothing is broken, that no
/// edge is left that may flip, and the same triangles in a second run.
/// @param fixed edges that must still be there and are not judged: pairs of ids.
GroupResult ExpectGoodTriangles(const TriangleMesh& mesh, const Owners& owners, int ranks,
  const FlipOptions& options, const std::vector<std::int64_t>& fixed = {});

}

#endif
