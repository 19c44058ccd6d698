// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MissingConstraints.h"

#include "FixedEdges.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{

/// The vertex pairs that constraints are to make edges of, and which of them are edges already.
class WantedEdges
{
public:
  explicit WantedEdges(const TriangleMesh& mesh)
    : IsEnd(mesh.Points.Count, 0)
  {
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t from = CheckConstraint(mesh, i, 0);
      const std::int64_t to = CheckConstraint(mesh, i, 1);
      if (mesh.ConstraintsToInsert[i] != 0 && from != to)
      {
        this->Keys.push_back(ToKey(from, to));
        this->IsEnd[from] = 1;
        this->IsEnd[to] = 1;
      }
    }
    std::sort(this->Keys.begin(), this->Keys.end());
    this->Keys.erase(std::unique(this->Keys.begin(), this->Keys.end()), this->Keys.end());
    this->IsEdge.resize(this->Keys.size(), 0);
  }

  bool IsEmpty() const { return this->Keys.empty(); }

  /// By threads at the same time.
  void NoteSide(std::int64_t from, std::int64_t to)
  {
    if (this->MayEndAt(from) && this->MayEndAt(to))
    {
      const std::size_t i = this->Find(from, to);
      if (i < this->Keys.size())
      {
        AtomicStore<unsigned char>(&this->IsEdge[i], 1);
      }
    }
  }

  MissingConstraints ListMissing(const TriangleMesh& mesh) const
  {
    MissingConstraints missing;
    std::vector<bool> isListed(this->Keys.size(), false);
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
      const std::size_t found = this->Find(ends[0], ends[1]);
      missing.IsMissing.push_back(found < this->Keys.size() && this->IsEdge[found] == 0);
      if (missing.IsMissing.back() && !isListed[found])
      {
        isListed[found] = true;
        missing.First.push_back(i);
      }
    }
    return missing;
  }

private:
  static std::uint64_t ToKey(std::int64_t from, std::int64_t to)
  {
    return EdgeKey(static_cast<VertexId>(from), static_cast<VertexId>(to));
  }

  bool MayEndAt(std::int64_t point) const
  {
    const auto count = static_cast<std::int64_t>(this->IsEnd.size());
    return point >= 0 && point < count && this->IsEnd[point] != 0;
  }

  /// The place of a pair among the keys, or one beyond the last.
  std::size_t Find(std::int64_t from, std::int64_t to) const
  {
    const std::uint64_t key = ToKey(from, to);
    const auto place = std::lower_bound(this->Keys.begin(), this->Keys.end(), key);
    return place != this->Keys.end() && *place == key ? place - this->Keys.begin()
                                                      : this->Keys.size();
  }

  std::vector<unsigned char> IsEnd; ///< One per point.
  std::vector<std::uint64_t> Keys; ///< Ascending.
  std::vector<unsigned char> IsEdge; ///< One per key.
};

}

MissingConstraints FindMissingConstraints(const TriangleMesh& mesh, const ThreadBackend& backend)
{
  WantedEdges wanted(mesh);
  if (wanted.IsEmpty())
  {
    return {};
  }
  const TriangleArray triangles = mesh.Triangles;
  backend.ForEach(triangles.Count,
    [&](std::int64_t t)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        wanted.NoteSide(triangles.Get(t, slot), triangles.Get(t, NextSlot(slot)));
      }
    });
  return wanted.ListMissing(mesh);
}

}
