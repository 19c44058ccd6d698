// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartitionPoints.h"

#include "PieceInput.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace delaunayflip
{
namespace
{

/// What makes two points the same: coordinates, or a global id.
using Place = std::array<double, 3>;

/// What the cells of a partition say of its points.
class PointUse
{
public:
  explicit PointUse(vtkPolyData* mesh)
    : Fans(mesh->GetNumberOfPoints(), 0),
      Uses(mesh->GetNumberOfPoints(), Unused)
  {
    vtkNew<vtkIdList> ids;
    this->Visit(mesh->GetLines(), ids, [&]() { this->AddLine(ids); });
    this->Visit(mesh->GetPolys(), ids, [&]() { this->AddPolygon(ids); });
    this->Visit(mesh->GetStrips(), ids, [&]() { this->AddStrip(ids); });
  }

  bool IsUsed(vtkIdType point) const { return this->Uses[point] != Unused; }
  bool IsOfPolygon(vtkIdType point) const { return this->Uses[point] == OfPolygon; }

  /// Whether polygons do not close around it.
  bool IsAtBorder(vtkIdType point) const
  {
    return this->Fans[point] != 0 || !this->IsOfPolygon(point);
  }

private:
  enum Use : unsigned char
  {
    Unused,
    OfLine,
    OfPolygon
  };

  template <typename Add>
  void Visit(vtkCellArray* cells, vtkIdList* ids, const Add& add)
  {
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, ids);
      add();
    }
  }

  void AddLine(vtkIdList* ids)
  {
    for (const vtkIdType id : *ids)
    {
      this->Uses[id] = OfLine;
    }
  }

  void AddPolygon(vtkIdList* ids)
  {
    const vtkIdType count = ids->GetNumberOfIds();
    for (vtkIdType i = 0; i < count; ++i)
    {
      this->AddCorner(
        ids->GetId(i), ids->GetId((i + 1) % count), ids->GetId((i + count - 1) % count));
    }
  }

  void AddStrip(vtkIdList* ids)
  {
    for (vtkIdType i = 0; i + 2 < ids->GetNumberOfIds(); ++i)
    {
      const vtkIdType a = ids->GetId(i), b = ids->GetId(i + 1 + i % 2),
                      c = ids->GetId(i + 2 - i % 2);
      this->AddCorner(a, b, c);
      this->AddCorner(b, c, a);
      this->AddCorner(c, a, b);
    }
  }

  /// Around a closed fan every neighbour is the next one once, and once the previous one.
  void AddCorner(vtkIdType point, vtkIdType next, vtkIdType previous)
  {
    this->Uses[point] = OfPolygon;
    this->Fans[point] += Scatter(next) - Scatter(previous);
  }

  static std::uint64_t Scatter(vtkIdType id)
  {
    std::uint64_t bits = static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    return bits ^ (bits >> 27);
  }

  std::vector<std::uint64_t> Fans;
  std::vector<unsigned char> Uses;
};

/// A point that other partitions may have, too.
struct Candidate
{
  Place At;
  std::size_t Partition;
  vtkIdType Number; ///< Among the points of all partitions.
  bool IsOfPolygon;
  bool IsAtBorder;
};

class PointJoiner
{
public:
  explicit PointJoiner(const std::vector<vtkSmartPointer<vtkPolyData>>& partitions)
    : Partitions(partitions)
  {
    this->First.push_back(0);
    for (const auto& mesh : partitions)
    {
      this->First.push_back(this->First.back() + mesh->GetNumberOfPoints());
    }
    this->Same.resize(this->First.back());
    std::iota(this->Same.begin(), this->Same.end(), 0);
  }

  PartitionPoints Run()
  {
    std::vector<Candidate> all = this->ListCandidates();
    const auto order = [](const Candidate& one)
    { return std::make_tuple(one.At, !one.IsOfPolygon, one.Number); };
    std::sort(all.begin(), all.end(),
      [&](const Candidate& a, const Candidate& b) { return order(a) < order(b); });
    for (auto begin = all.begin(); begin != all.end();)
    {
      const auto end =
        std::find_if(begin, all.end(), [&](const Candidate& one) { return one.At != begin->At; });
      this->JoinPlace(TakeOnePerPartition(begin, end));
      begin = end;
    }
    this->NumberPoints();
    return std::move(this->Result);
  }

private:
  std::vector<Candidate> ListCandidates() const
  {
    std::vector<std::vector<std::int64_t>> numbers;
    bool haveNumbers = true;
    for (const auto& mesh : this->Partitions)
    {
      numbers.push_back(ReadPointNumbers(mesh));
      haveNumbers = haveNumbers && (!numbers.back().empty() || mesh->GetNumberOfPoints() == 0);
    }
    std::vector<Candidate> all;
    for (std::size_t k = 0; k < this->Partitions.size(); ++k)
    {
      const PointUse use(this->Partitions[k]);
      for (vtkIdType i = 0; i < this->Partitions[k]->GetNumberOfPoints(); ++i)
      {
        const Place at = haveNumbers ? MakePlace(numbers[k][i]) : this->FindPlace(k, i);
        if (use.IsUsed(i) && at == at) // no NaN
        {
          all.push_back(
            { at, k, this->First[k] + i, use.IsOfPolygon(i), haveNumbers || use.IsAtBorder(i) });
        }
      }
    }
    return all;
  }

  Place FindPlace(std::size_t partition, vtkIdType point) const
  {
    Place at;
    this->Partitions[partition]->GetPoint(point, at.data());
    return { at[0] + 0.0, at[1] + 0.0, at[2] + 0.0 }; // -0 becomes 0
  }

  /// All bits of the id, which a double may not have.
  static Place MakePlace(std::int64_t number)
  {
    return { static_cast<double>(number >> 32), static_cast<double>(number & 0xffffffff), 0.0 };
  }

  /// Without the ends of lines where the partition has a point of polygons.
  template <typename Iterator>
  static std::vector<Candidate> TakeOnePerPartition(Iterator begin, Iterator end)
  {
    std::vector<Candidate> list;
    for (Iterator one = begin; one != end; ++one)
    {
      const bool isKnown = std::any_of(list.begin(), list.end(),
        [=](const Candidate& other) { return other.Partition == one->Partition; });
      if (one->IsOfPolygon || !isKnown)
      {
        list.push_back(*one);
      }
    }
    return list;
  }

  void JoinPlace(const std::vector<Candidate>& list)
  {
    const bool isShared = list.front().Partition != list.back().Partition;
    const bool isAtBorder =
      std::any_of(list.begin(), list.end(), [](const Candidate& one) { return one.IsAtBorder; });
    if (!isShared || !isAtBorder)
    {
      return;
    }
    const auto repeated = std::adjacent_find(list.begin(), list.end(),
      [](const Candidate& a, const Candidate& b) { return a.Partition == b.Partition; });
    if (repeated != list.end())
    {
      this->Result.Ambiguous += static_cast<vtkIdType>(list.size());
      return;
    }
    const auto first = std::min_element(list.begin(), list.end(),
      [](const Candidate& a, const Candidate& b) { return a.Number < b.Number; });
    for (const Candidate& one : list)
    {
      this->Same[one.Number] = first->Number;
    }
  }

  void NumberPoints()
  {
    const auto areDoubles = [](vtkPolyData* mesh)
    { return mesh->GetPoints() && mesh->GetPoints()->GetDataType() == VTK_DOUBLE; };
    this->Result.Points = vtkSmartPointer<vtkPoints>::New();
    this->Result.Points->SetDataType(
      std::any_of(this->Partitions.begin(), this->Partitions.end(), areDoubles) ? VTK_DOUBLE
                                                                                : VTK_FLOAT);
    std::vector<vtkIdType> numbers(this->Same.size());
    for (std::size_t k = 0; k < this->Partitions.size(); ++k)
    {
      for (vtkIdType i = this->First[k]; i < this->First[k + 1]; ++i)
      {
        numbers[i] = this->Same[i] < i
          ? numbers[this->Same[i]]
          : this->Result.Points->InsertNextPoint(this->Partitions[k]->GetPoint(i - this->First[k]));
      }
      this->Result.Ids.emplace_back(
        numbers.begin() + this->First[k], numbers.begin() + this->First[k + 1]);
    }
  }

  const std::vector<vtkSmartPointer<vtkPolyData>>& Partitions;
  std::vector<vtkIdType> First; ///< Of every partition, among the points of all.
  std::vector<vtkIdType> Same; ///< Of every point: the first one that is the same.
  PartitionPoints Result;
};

}

PartitionPoints JoinPoints(const std::vector<vtkSmartPointer<vtkPolyData>>& partitions)
{
  return PointJoiner(partitions).Run();
}

}
