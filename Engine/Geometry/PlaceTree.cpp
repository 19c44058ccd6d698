// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlaceTree.h"

#include "Predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delaunayflip
{

namespace
{
bool IsFinite(const PlaneVector& point)
{
  return delaunayflip::IsFinite(point[0]) && delaunayflip::IsFinite(point[1]);
}

std::size_t CountNodes(std::int64_t places, std::int64_t leafSize)
{
  std::size_t leaves = 1;
  for (; places > leafSize; places = (places + 1) / 2)
  {
    leaves *= 2;
  }
  return 2 * leaves;
}

/// Whether all points certainly lie to the right of a line.
template <std::size_t Count>
bool AreRightOf(
  const PlanePoint& from, const PlanePoint& to, const std::array<PlanePoint, Count>& points)
{
  return std::all_of(points.begin(), points.end(),
    [&](const PlanePoint& point) { return FilteredOrientation(from, to, point) < 0; });
}

/// Whether a side of a convex polygon certainly separates it from the points.
template <std::size_t Sides, std::size_t Count>
bool HasSeparatingSide(
  const std::array<PlanePoint, Sides>& polygon, const std::array<PlanePoint, Count>& points)
{
  for (std::size_t i = 0; i < Sides; ++i)
  {
    if (AreRightOf(polygon[i], polygon[(i + 1) % Sides], points))
    {
      return true;
    }
  }
  return false;
}

/// Least and greatest of some numbers.
struct Range
{
  double Lower = INFINITY, Upper = -INFINITY;

  void Include(double value)
  {
    this->Lower = std::min(this->Lower, value);
    this->Upper = std::max(this->Upper, value);
  }
  double GetLength() const { return this->Upper - this->Lower; }
};
}

PlaceTree::PlaceTree(const std::vector<PlaneVector>& points)
  : PlaceOf(points.size())
{
  this->FindPlaces(points);
  this->Scale();
  std::vector<std::int64_t> order(this->Places.size());
  std::iota(order.begin(), order.end(), 0);
  this->Order(this->GetRoot(), order);
  this->Reorder(order);
  this->PointsLeft.resize(this->Places.size() + 1);
  for (const std::int64_t place : this->PlaceOf)
  {
    ++this->PointsLeft[place];
  }
  this->Nodes.resize(CountNodes(this->GetElsewhere(), LeafSize));
  this->MakeNodes(this->GetRoot());
}

void PlaceTree::FindPlaces(const std::vector<PlaneVector>& points)
{
  std::vector<std::int64_t> byPlace(points.size());
  std::iota(byPlace.begin(), byPlace.end(), 0);
  const auto isFinite = [&](std::int64_t point) { return IsFinite(points[point]); };
  const auto end = std::partition(byPlace.begin(), byPlace.end(), isFinite);
  std::sort(
    byPlace.begin(), end, [&](std::int64_t a, std::int64_t b) { return points[a] < points[b]; });
  for (auto point = byPlace.begin(); point != end; ++point)
  {
    if (this->Places.empty() || this->Places.back() != points[*point])
    {
      this->Places.push_back(points[*point]);
    }
    this->PlaceOf[*point] = this->GetElsewhere() - 1;
  }
  for (auto point = end; point != byPlace.end(); ++point)
  {
    this->PlaceOf[*point] = this->GetElsewhere();
  }
}

/// By a power of two that brings the largest coordinate to 1 .. 2. What underflows changes by less
/// than the filters allow for.
void PlaceTree::Scale()
{
  double largest = 0.0;
  for (const PlaneVector& place : this->Places)
  {
    largest = std::max({ largest, std::fabs(place[0]), std::fabs(place[1]) });
  }
  const int exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
  const double factors[2] = { std::scalbn(1.0, exponent / 2),
    std::scalbn(1.0, exponent - exponent / 2) };
  const auto scale = [&](double x) { return x * factors[0] * factors[1]; };
  for (const PlaneVector& place : this->Places)
  {
    this->Scaled.push_back({ scale(place[0]), scale(place[1]), 0.0 });
  }
}

/// Divides the places in halves across the longer side of their box, recursively.
void PlaceTree::Order(const NodeRange& range, std::vector<std::int64_t>& order) const
{
  if (range.IsLeaf())
  {
    return;
  }
  const auto begin = order.begin() + range.Begin;
  const auto end = order.begin() + range.End;
  Range u, v;
  std::for_each(begin, end,
    [&](std::int64_t place)
    {
      u.Include(this->Scaled[place].U);
      v.Include(this->Scaled[place].V);
    });
  const bool byV = v.GetLength() > u.GetLength();
  // Places are numbered by u, then by v, and no two are equal.
  const auto isBefore = [&](std::int64_t a, std::int64_t b)
  {
    const double vOfA = this->Scaled[a].V, vOfB = this->Scaled[b].V;
    return byV && vOfA != vOfB ? vOfA < vOfB : a < b;
  };
  std::nth_element(begin, order.begin() + range.GetMiddle(), end, isBefore);
  this->Order(range.GetLeft(), order);
  this->Order(range.GetRight(), order);
}

/// Renumbers the places by the order of the leaves.
void PlaceTree::Reorder(const std::vector<std::int64_t>& order)
{
  const std::vector<PlaneVector> places = this->Places;
  const std::vector<PlanePoint> scaled = this->Scaled;
  std::vector<std::int64_t> rank(order.size() + 1, this->GetElsewhere());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    this->Places[i] = places[order[i]];
    this->Scaled[i] = scaled[order[i]];
    rank[order[i]] = static_cast<std::int64_t>(i);
  }
  for (std::int64_t& place : this->PlaceOf)
  {
    place = rank[place];
  }
}

void PlaceTree::MakeNodes(const NodeRange& range)
{
  this->Nodes[range.Index].PlacesLeft = range.End - range.Begin;
  this->Fit(range);
  if (!range.IsLeaf())
  {
    this->MakeNodes(range.GetLeft());
    this->MakeNodes(range.GetRight());
  }
}

void PlaceTree::Fit(const NodeRange& range)
{
  Range u, v;
  PlanePoint lowest{}, highest{}, first{}, last{};
  this->ForPlaces(range,
    [&](const PlanePoint& p)
    {
      first = p.U < u.Lower ? p : first;
      last = p.U > u.Upper ? p : last;
      lowest = p.V < v.Lower ? p : lowest;
      highest = p.V > v.Upper ? p : highest;
      u.Include(p.U);
      v.Include(p.V);
    });
  Node& node = this->Nodes[range.Index];
  node.PlacesAtFit = node.PlacesLeft;
  node.Bounds = { { u.Lower, v.Lower, 0.0 }, { u.Upper, v.Upper, 0.0 } };
  node.IsSlim = false;
  if (u.GetLength() > 0.0 && v.GetLength() > 0.0)
  {
    const bool byV = v.GetLength() > u.GetLength();
    this->FitSlimRectangle(range, byV ? lowest : first, byV ? highest : last);
  }
}

/// Makes the hull a rectangle along the line from `first` to `last` if that is slim.
void PlaceTree::FitSlimRectangle(
  const NodeRange& range, const PlanePoint& first, const PlanePoint& last)
{
  const double length = std::hypot(last.U - first.U, last.V - first.V);
  const double cosine = (last.U - first.U) / length;
  const double sine = (last.V - first.V) / length;
  Range along, across;
  this->ForPlaces(range,
    [&](const PlanePoint& p)
    {
      along.Include(cosine * p.U + sine * p.V);
      across.Include(cosine * p.V - sine * p.U);
    });
  Node& node = this->Nodes[range.Index];
  const Box& box = node.Bounds;
  constexpr double SlimShare = 0.25;
  node.IsSlim = along.GetLength() * across.GetLength() <
    SlimShare * (box.Upper.U - box.Lower.U) * (box.Upper.V - box.Lower.V);
  if (node.IsSlim)
  {
    constexpr double Margin = 0x1p-47; // more than the rounding of all these numbers, below 4
    const auto place = [&](double s, double t) {
      return PlanePoint{ cosine * s - sine * t, sine * s + cosine * t, 0.0 };
    };
    node.Hull = { place(along.Lower - Margin, across.Lower - Margin),
      place(along.Upper + Margin, across.Lower - Margin),
      place(along.Upper + Margin, across.Upper + Margin),
      place(along.Lower - Margin, across.Upper + Margin) };
  }
}

bool PlaceTree::Remove(std::int64_t point)
{
  const std::int64_t place = this->PlaceOf[point];
  const bool wasLast = --this->PointsLeft[place] == 0;
  if (wasLast && place != this->GetElsewhere())
  {
    this->RemovePlace(place);
  }
  return wasLast;
}

/// Fits leaves again, and other nodes when half of their places are gone: n log^2 n steps in all.
void PlaceTree::RemovePlace(std::int64_t place)
{
  NodeRange range = this->GetRoot();
  for (bool isLeaf = false; !isLeaf;)
  {
    Node& node = this->Nodes[range.Index];
    isLeaf = range.IsLeaf();
    --node.PlacesLeft;
    if (isLeaf || 2 * node.PlacesLeft <= node.PlacesAtFit)
    {
      this->Fit(range);
    }
    range = place < range.GetMiddle() ? range.GetLeft() : range.GetRight();
  }
}

std::int64_t PlaceTree::FindInside(const std::array<std::int64_t, 3>& corners) const
{
  if (this->PointsLeft[this->GetElsewhere()] > 0)
  {
    return this->GetElsewhere();
  }
  Triangle triangle{};
  Range u, v;
  for (int i = 0; i < 3; ++i)
  {
    triangle.Places[i] = this->PlaceOf[corners[i]];
    triangle.Corners[i] = this->Scaled[triangle.Places[i]];
    u.Include(triangle.Corners[i].U);
    v.Include(triangle.Corners[i].V);
  }
  triangle.Bounds = { { u.Lower, v.Lower, 0.0 }, { u.Upper, v.Upper, 0.0 } };
  return this->Search(this->GetRoot(), triangle);
}

/// The children of a node in another order at every call.
std::int64_t PlaceTree::Search(const NodeRange& range, const Triangle& triangle) const
{
  const Meeting meeting = this->Meet(this->Nodes[range.Index], triangle);
  if (meeting == Meeting::Outside)
  {
    return NoPlace;
  }
  if (meeting == Meeting::Inside)
  {
    return this->PickPlace(range);
  }
  if (range.IsLeaf())
  {
    return this->SearchLeaf(range, triangle);
  }
  const bool right = this->Scatter() >> 63 != 0;
  const std::int64_t found = this->Search(right ? range.GetRight() : range.GetLeft(), triangle);
  return found != NoPlace ? found
                          : this->Search(right ? range.GetLeft() : range.GetRight(), triangle);
}

/// A remaining place of a node: a different one at every call, so that the one found first is not
/// the one removed next.
std::int64_t PlaceTree::PickPlace(NodeRange range) const
{
  std::uint64_t scattered = this->Scatter();
  for (; !range.IsLeaf(); scattered *= 2)
  {
    const bool right = (scattered >> 63 != 0 && this->Nodes[2 * range.Index + 1].PlacesLeft > 0) ||
      this->Nodes[2 * range.Index].PlacesLeft == 0;
    range = right ? range.GetRight() : range.GetLeft();
  }
  const auto isLeft = [](std::int64_t points) { return points > 0; };
  const auto first = this->PointsLeft.begin();
  return std::find_if(first + range.Begin, first + range.End, isLeft) - first;
}

std::int64_t PlaceTree::SearchLeaf(const NodeRange& range, const Triangle& triangle) const
{
  for (std::int64_t i = range.Begin; i < range.End; ++i)
  {
    if (this->PointsLeft[i] > 0 && this->IsInside(i, triangle))
    {
      return i;
    }
  }
  return NoPlace;
}

bool PlaceTree::IsInside(std::int64_t place, const Triangle& triangle) const
{
  const auto& [a, b, c] = triangle.Places;
  if (place == a || place == b || place == c ||
    HasSeparatingSide(triangle.Corners, std::array<PlanePoint, 1>{ this->Scaled[place] }))
  {
    return false;
  }
  const auto turn = [&](std::int64_t from, std::int64_t to)
  {
    return Orientation(
      this->Places[from].data(), this->Places[to].data(), this->Places[place].data());
  };
  return turn(a, b) >= 0 && turn(b, c) >= 0 && turn(c, a) >= 0;
}

/// Also returns Partly if the filters cannot decide.
PlaceTree::Meeting PlaceTree::Meet(const Node& node, const Triangle& triangle) const
{
  ++this->Visits;
  const Box& box = node.Bounds;
  const Box& other = triangle.Bounds;
  if (node.PlacesLeft == 0 || box.Upper.U < other.Lower.U || box.Lower.U > other.Upper.U ||
    box.Upper.V < other.Lower.V || box.Lower.V > other.Upper.V)
  {
    return Meeting::Outside;
  }
  bool isInside = true;
  for (int i = 0; i < 3; ++i)
  {
    const PlanePoint& from = triangle.Corners[i];
    const PlanePoint& to = triangle.Corners[(i + 1) % 3];
    const bool down = to.V<from.V, right = to.U> from.U;
    // The corners of the box that lie farthest to the left and to the right of the side.
    const PlanePoint leftmost{ down ? box.Upper.U : box.Lower.U, right ? box.Upper.V : box.Lower.V,
      0.0 };
    const PlanePoint rightmost{ down ? box.Lower.U : box.Upper.U, right ? box.Lower.V : box.Upper.V,
      0.0 };
    if (FilteredOrientation(from, to, leftmost) < 0)
    {
      return Meeting::Outside;
    }
    isInside = isInside && FilteredOrientation(from, to, rightmost) == 1;
  }
  const bool areApart = node.IsSlim && !isInside &&
    (HasSeparatingSide(triangle.Corners, node.Hull) ||
      HasSeparatingSide(node.Hull, triangle.Corners));
  return areApart ? Meeting::Outside : (isInside ? Meeting::Inside : Meeting::Partly);
}

}
