// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Each allocation of one rank fails once: all ranks fail, and say which rank and why.

#include "FailingAllocations.h"

#include "GeneratedMeshes.h"
#include "MeshDivision.h"
#include "OtherGroup.h"
#include "PieceFlip.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

constexpr int Ranks = 3;
constexpr int Failing = 1;

/// A group with allocations that do not fail, as if messages went by another library.
class SparedGroup : public OtherGroup
{
public:
  using OtherGroup::OtherGroup;

  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    const SparedAllocations spared;
    return OtherGroup::Exchange(std::move(messages));
  }
  std::vector<Message> Gather(const Message& message) override
  {
    const SparedAllocations spared;
    return OtherGroup::Gather(message);
  }
};

/// Flips the pieces. @returns what went wrong on every rank.
std::vector<std::string> FlipAll(const std::vector<MeshPiece>& pieces, const FlipOptions& options)
{
  std::vector<std::string> errors(Ranks);
  RunInThreads(Ranks,
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      SparedGroup spared(group);
      FlippedPiece flipped;
      try
      {
        if (rank == Failing)
        {
          FlipPiece(pieces[rank], options, spared, flipped);
        }
        else
        {
          const SparedAllocations others;
          FlipPiece(pieces[rank], options, spared, flipped);
        }
      }
      catch (const std::exception& error)
      {
        const SparedAllocations others;
        errors[rank] = error.what();
      }
    });
  return errors;
}

/// Flips with the first allocation of a rank failing, its second, and so on until all get through.
void FailEach(const std::vector<MeshPiece>& pieces, FlipOptions options)
{
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 1;
  FlipAll(pieces, options); // also what a process allocates only once
  const std::vector<std::string> none(Ranks);
  const std::vector<std::string> expected(Ranks, "rank 1: not enough memory");
  int told = 0;
  int managed = 0; // functions of the C++ library do without memory that they only like to have
  for (bool hasFailed = true; hasFailed && !testing::Test::HasFailure();)
  {
    FailingAllocations failing(told + managed + 1);
    const SparedAllocations spared;
    const std::vector<std::string> errors = FlipAll(pieces, options);
    hasFailed = FailingAllocations::Stop();
    EXPECT_TRUE(errors == none || (hasFailed && errors == expected)) << errors[0] << errors[2];
    told += errors == expected ? 1 : 0;
    managed += errors == none && hasFailed ? 1 : 0;
  }
  EXPECT_GT(told, 200);
  EXPECT_LT(managed, 10);
}

std::vector<MeshPiece> ViewAll(const std::vector<OwnPiece>& pieces)
{
  std::vector<MeshPiece> views;
  for (const OwnPiece& piece : pieces)
  {
    views.push_back(piece.View());
  }
  return views;
}

TEST(PieceAllocations, OfAPlaneFailOnce)
{
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  const std::vector<OwnPiece> pieces = DivideMesh(MakeRandomBadMeshDouble(24, 1).View(), Ranks);
  FailEach(ViewAll(pieces), options);
}

/// Within each piece, and from it into others.
TEST(PieceAllocations, OfConstraintsFailOnce)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(24, 1);
  const std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), Ranks);
  std::vector<MeshPiece> views = ViewAll(pieces);
  std::vector<std::vector<std::int64_t>> ends;
  const std::vector<unsigned char> toInsert(3, 1);
  for (MeshPiece& view : views)
  {
    const std::int64_t last = view.Mesh.Points.Count - 1;
    ends.push_back({ 0, last, 1, last - 1, 2, last / 2 });
    view.Mesh.ConstraintEdges = ends.back().data();
    view.Mesh.NumberOfConstraintEdges = 3;
    view.Mesh.ConstraintsToInsert = toInsert.data();
  }
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  FailEach(views, options);
}

TEST(PieceAllocations, OfASurfaceFailOnce)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 180.0;
  const std::vector<OwnPiece> pieces = DivideMesh(MakeBadSphere(8, 4, 1).View(), Ranks);
  FailEach(ViewAll(pieces), options);
}

}
}
