// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTLIST_H
#define DELAUNAYFLIP_CONSTRAINTLIST_H

#include "ConstraintInsertion.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Constraints, with one flag for each: whether it is to be inserted. Those that are known to be
/// edges must be added first.
class ConstraintList
{
public:
  void AddEdge(std::int64_t from, std::int64_t to)
  {
    this->Add(from, to, false);
    ++this->Known;
  }
  void Add(std::int64_t from, std::int64_t to, bool isToInsert)
  {
    this->Ends.insert(this->Ends.end(), { from, to });
    this->ToInsert.push_back(isToInsert ? 1 : 0);
  }

  /// Gives a mesh views of these constraints.
  TriangleMesh AddTo(TriangleMesh mesh) const
  {
    mesh.ConstraintEdges = this->Ends.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->ToInsert.size());
    mesh.ConstraintsToInsert = this->ToInsert.data();
    return mesh;
  }

  std::int64_t CountToInsert() const
  {
    return std::count(this->ToInsert.begin(), this->ToInsert.end(), static_cast<unsigned char>(1));
  }

  /// Calls visit(from, to) for all constraints of `made`, the mesh after the insertion, except the
  /// edges that were known before.
  template <typename Visit>
  void ForEachMade(const TriangleMesh& made, const Visit& visit) const
  {
    for (std::int64_t i = this->Known; i < made.NumberOfConstraintEdges; ++i)
    {
      visit(made.ConstraintEdges[2 * i], made.ConstraintEdges[2 * i + 1]);
    }
  }

private:
  std::vector<std::int64_t> Ends;
  std::vector<unsigned char> ToInsert;
  std::int64_t Known = 0;
};

/// The ids and flips of triangles after an insertion.
struct MadeTriangles
{
  MadeTriangles(const ConstraintInsertion& insertion, const TriangleMesh& mesh)
    : Ids(3 * mesh.Triangles.Count),
      Flips(mesh.Triangles.Count)
  {
    const TriangleArray triangles = insertion.GetMesh(mesh).Triangles;
    for (std::size_t i = 0; i < this->Ids.size(); ++i)
    {
      const auto corner = static_cast<std::int64_t>(i);
      this->Ids[i] =
        static_cast<std::int32_t>(triangles.Get(corner / 3, static_cast<int>(corner % 3)));
    }
    insertion.AddFlipCounts(this->Flips.data());
  }

  std::vector<std::int32_t> Ids;
  std::vector<std::int32_t> Flips;
};

}

#endif
