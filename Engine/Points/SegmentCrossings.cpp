// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentCrossings.h"

#include "ExactPredicates.h"
#include "PortableMath.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace delaunayflip
{

namespace
{
using Integer = boost::multiprecision::cpp_int;

struct Fraction
{
  Integer Numerator, Denominator; ///< The denominator is positive.
};

bool operator<(const Fraction& a, const Fraction& b)
{
  return a.Numerator * b.Denominator < b.Numerator * a.Denominator;
}

struct Rounded
{
  double Value;
  double Shift; ///< How far it is from what was rounded.
};

/// A number below 2^63, rounded to the nearest multiple of 2^zeros, and to the even one of two.
/// @param zeros positive.
std::uint64_t RoundToMultiple(std::uint64_t bits, int zeros)
{
  if (zeros > 63)
  {
    return 0;
  }
  const std::uint64_t unit = std::uint64_t(1) << zeros;
  const std::uint64_t rest = bits & (unit - 1);
  const std::uint64_t below = bits - rest;
  const bool isOdd = (below & unit) != 0;
  const bool goesUp = rest > unit / 2 || (rest == unit / 2 && isOdd);
  return goesUp ? below + unit : below;
}

/// A fraction times 2^exponent, rounded once to the nearest double or float.
Rounded Round(const Fraction& fraction, int exponent, bool toFloat)
{
  if (fraction.Numerator == 0)
  {
    return { 0.0, 0.0 };
  }
  // A quotient of 62 or 63 bits, of which the last one also stands for all bits that follow.
  const Integer magnitude = abs(fraction.Numerator);
  const int shift =
    62 + static_cast<int>(msb(fraction.Denominator)) - static_cast<int>(msb(magnitude));
  Integer above = magnitude;
  Integer below = fraction.Denominator;
  if (shift > 0)
  {
    above <<= shift;
  }
  else
  {
    below <<= -shift;
  }
  Integer quotient, rest;
  divide_qr(above, below, quotient, rest);
  const std::int64_t bits = static_cast<std::int64_t>(quotient) | (rest != 0 ? 1 : 0);
  // Subnormal numbers have fewer bits than others.
  const int smallest = toFloat ? -149 : -1074;
  const int zeros = smallest - (exponent - shift);
  const int fewestToRound = 62 - (toFloat ? 24 : 53);
  auto rounded = static_cast<double>(bits);
  if (zeros > fewestToRound)
  {
    rounded = static_cast<double>(RoundToMultiple(static_cast<std::uint64_t>(bits), zeros));
  }
  else if (toFloat)
  {
    rounded = static_cast<double>(static_cast<float>(bits));
  }
  const auto off = static_cast<std::int64_t>(
    static_cast<std::uint64_t>(rounded) - static_cast<std::uint64_t>(bits));
  if (fraction.Numerator < 0)
  {
    rounded = -rounded;
  }
  return { std::ldexp(rounded, exponent - shift),
    std::ldexp(std::fabs(static_cast<double>(off)), exponent - shift) };
}

/// Where two segments cross.
struct Crossing
{
  std::size_t Earlier, Later; ///< Segments.
  Fraction OnEarlier, OnLater; ///< Shares of their lengths.
  Rounded X, Y;
};

/// A double in units of 2^exponent; an integer.
Integer ToInteger(double value, int exponent)
{
  const DoubleParts parts(value);
  if (parts.Mantissa == 0)
  {
    return 0;
  }
  const Integer magnitude = Integer(parts.Mantissa) << (parts.Exponent - exponent);
  if (parts.Negative)
  {
    return -magnitude;
  }
  return magnitude;
}

/// Segments by the cells of a grid that they pass, so that those near a point are found in little
/// time.
class SegmentCells
{
public:
  using Ends = std::array<PlanePoint, 2>;

  /// @param segments their ends, which are finite.
  explicit SegmentCells(const std::vector<Ends>& segments)
  {
    constexpr double Fewest = 64.0, Most = 1024.0;
    const double wanted = 2.0 * std::sqrt(static_cast<double>(segments.size()));
    this->Side = static_cast<std::int64_t>(std::clamp(wanted, Fewest, Most));
    for (const Ends& ends : segments)
    {
      for (const PlanePoint& end : ends)
      {
        this->Low = { std::min(this->Low.U, end.U), std::min(this->Low.V, end.V), 0.0 };
        this->High = { std::max(this->High.U, end.U), std::max(this->High.V, end.V), 0.0 };
      }
    }
    std::vector<std::pair<std::int64_t, std::size_t>> passed; // cells and segments
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      this->ForCells(segments[i], [&](std::int64_t cell) { passed.emplace_back(cell, i); });
    }
    std::sort(passed.begin(), passed.end());
    this->Starts.assign(this->Side * this->Side + 1, 0);
    for (const auto& [cell, segment] : passed)
    {
      ++this->Starts[cell + 1];
      this->Segments.push_back(segment);
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  }

  /// Calls visit(segment) for all segments near a place, and for some others.
  template <typename Visit>
  void ForSegmentsNear(const PlanePoint& place, const Visit& visit) const
  {
    const PlanePoint scaled = this->Scale(place);
    const auto side = static_cast<double>(this->Side);
    const bool isInside =
      scaled.U > -1.0 && scaled.U < side + 1.0 && scaled.V > -1.0 && scaled.V < side + 1.0;
    if (isInside)
    {
      const std::int64_t cell = this->GetRow(scaled.V) * this->Side + this->GetRow(scaled.U);
      for (std::int64_t i = this->Starts[cell]; i < this->Starts[cell + 1]; ++i)
      {
        visit(this->Segments[i]);
      }
    }
  }

private:
  /// Calls visit(cell) for the cells that a segment passes, and for those around them.
  template <typename Visit>
  void ForCells(const Ends& ends, const Visit& visit) const
  {
    PlanePoint a = this->Scale(ends[0]), b = this->Scale(ends[1]);
    if (b.U < a.U)
    {
      std::swap(a, b);
    }
    const auto heightAt = [&](double u)
    {
      const double share = b.U > a.U ? std::clamp((u - a.U) / (b.U - a.U), 0.0, 1.0) : 0.0;
      return a.V + share * (b.V - a.V);
    };
    const bool isUpright = this->GetRow(a.U) == this->GetRow(b.U);
    for (std::int64_t column = this->GetRow(a.U - 1.0); column <= this->GetRow(b.U + 1.0); ++column)
    {
      const auto left = static_cast<double>(column);
      const double one = isUpright ? a.V : heightAt(left - 1.0);
      const double other = isUpright ? b.V : heightAt(left + 2.0);
      const std::int64_t last = this->GetRow(std::max(one, other) + 1.0);
      for (std::int64_t row = this->GetRow(std::min(one, other) - 1.0); row <= last; ++row)
      {
        visit(row * this->Side + column);
      }
    }
  }

  /// A place in units of cells. Halves do not overflow.
  PlanePoint Scale(const PlanePoint& place) const
  {
    const auto scale = [&](double value, double low, double high)
    {
      const double width = 0.5 * high - 0.5 * low;
      const auto side = static_cast<double>(this->Side);
      return width > 0.0 ? (0.5 * value - 0.5 * low) / width * side : 0.0;
    };
    return { scale(place.U, this->Low.U, this->High.U), scale(place.V, this->Low.V, this->High.V),
      0.0 };
  }
  /// The row or column of a scaled coordinate.
  std::int64_t GetRow(double scaled) const
  {
    return static_cast<std::int64_t>(std::clamp(scaled, 0.0, static_cast<double>(this->Side - 1)));
  }

  std::int64_t Side; ///< How many rows and columns there are.
  PlanePoint Low{ INFINITY, INFINITY, 0.0 }, High{ -INFINITY, -INFINITY, 0.0 };
  std::vector<std::int64_t> Starts; ///< By cell, the first of its segments.
  std::vector<std::size_t> Segments;
};

/// Where a segment is split.
struct Cut
{
  std::size_t Segment;
  Fraction Share; ///< Which part of its length is before the cut.
  std::int64_t Point;
};

class Splitter
{
public:
  Splitter(const PlaneArray& points, std::vector<Segment> segments, const CrossingsCaller& caller)
    : Points(points),
      Caller(caller)
  {
    this->Result.Segments = std::move(segments);
  }

  SplitSegments Run()
  {
    constexpr int Rounds = 10;
    std::size_t most = 0; // pairs of a round
    for (int round = 0; round < Rounds; ++round)
    {
      const std::vector<std::pair<std::size_t, std::size_t>> pairs = this->FindPairs();
      most = round == 0 ? 4 * pairs.size() + 1000 : most;
      if (pairs.empty() || pairs.size() > most)
      {
        break;
      }
      this->Split(pairs);
    }
    return std::move(this->Result);
  }

  /// Splits segments at points within rounding of them, unless segments would cross that did not.
  std::vector<Segment> RunNear()
  {
    std::vector<std::size_t> segments;
    for (std::size_t i = 0; i < this->Result.Segments.size(); ++i)
    {
      if (IsFinite(this->GetStart(i)) && IsFinite(this->GetEnd(i)))
      {
        segments.push_back(i);
      }
    }
    std::vector<Cut> cuts;
    std::set<std::size_t> bent; // segments with points beside them
    std::map<std::pair<double, double>, std::int64_t> pointAt; // the one that is used
    this->ForPointsNear(
      segments,
      [this](std::size_t segment, std::int64_t point)
      { return this->IsWithinRounding(segment, point); },
      [&](std::size_t segment, std::int64_t point)
      {
        const PlanePoint place = this->At(point);
        const std::optional<Fraction> share = this->FindShare(segment, point);
        if (share &&
          pointAt.emplace(std::pair(place.U + 0.0, place.V + 0.0), point).first->second == point)
        {
          cuts.push_back({ segment, *share, point });
          if (FindOrientation(this->GetStart(segment), this->GetEnd(segment), place) != 0)
          {
            bent.insert(segment);
          }
        }
      });
    if (bent.empty())
    {
      return std::move(this->Result.Segments);
    }
    const std::vector<std::pair<std::size_t, std::size_t>> pairs = this->FindPairs();
    for (const std::size_t segment : FindRefused(pairs)) // as a whole
    {
      bent.erase(segment);
    }
    cuts.erase(std::remove_if(cuts.begin(), cuts.end(),
                 [&](const Cut& cut) { return bent.count(cut.Segment) == 0; }),
      cuts.end());
    std::vector<Segment> before = this->Result.Segments;
    this->SplitAt(cuts);
    const bool isWorse = this->FindPairs().size() > pairs.size();
    return isWorse ? std::move(before) : std::move(this->Result.Segments);
  }

private:
  /// The segments that will be left out, because they cross earlier ones that stay.
  /// @param pairs those that cross, in ascending order.
  static std::set<std::size_t> FindRefused(
    const std::vector<std::pair<std::size_t, std::size_t>>& pairs)
  {
    std::set<std::size_t> refused;
    for (const auto& [earlier, later] : pairs)
    {
      if (refused.count(earlier) == 0)
      {
        refused.insert(later);
      }
    }
    return refused;
  }

  PlanePoint At(std::int64_t id) const
  {
    if (id < this->Points.Count)
    {
      return { this->Points.Get(id, 0), this->Points.Get(id, 1), 0.0 };
    }
    const AddedPoint& added = this->Result.Added[id - this->Points.Count];
    return { added.X, added.Y, 0.0 };
  }

  /// The range of a segment in x and y.
  struct Box
  {
    std::array<double, 2> Low, High;
    std::size_t Segment;
  };

  /// Sorts boxes for a sweep along an axis. Returns how many pairs it will look at.
  static std::int64_t SortAlong(int axis, std::vector<Box>& boxes)
  {
    std::sort(boxes.begin(), boxes.end(),
      [axis](const Box& a, const Box& b)
      { return std::tie(a.Low[axis], a.Segment) < std::tie(b.Low[axis], b.Segment); });
    std::int64_t pairs = 0;
    for (auto box = boxes.begin(); box != boxes.end(); ++box)
    {
      pairs += std::upper_bound(box + 1, boxes.end(), box->High[axis],
                 [axis](double high, const Box& other) { return high < other.Low[axis]; }) -
        (box + 1);
    }
    return pairs;
  }

  /// The pairs of segments that cross, in ascending order: a sweep along the axis that takes less.
  std::vector<std::pair<std::size_t, std::size_t>> FindPairs() const
  {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < this->Result.Segments.size(); ++i)
    {
      const PlanePoint a = this->At(this->Result.Segments[i].From);
      const PlanePoint b = this->At(this->Result.Segments[i].To);
      if (IsFinite(a) && IsFinite(b))
      {
        boxes.push_back({ { std::min(a.U, b.U), std::min(a.V, b.V) },
          { std::max(a.U, b.U), std::max(a.V, b.V) }, i });
      }
    }
    const std::int64_t pairsAlongX = SortAlong(0, boxes);
    const int axis = SortAlong(1, boxes) < pairsAlongX ? 1 : 0;
    SortAlong(axis, boxes);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      if (i % 1024 == 0)
      {
        this->Caller.Check();
      }
      const Box& box = boxes[i];
      for (std::size_t j = i + 1; j < boxes.size() && boxes[j].Low[axis] <= box.High[axis]; ++j)
      {
        if (boxes[j].Low[1 - axis] <= box.High[1 - axis] &&
          box.Low[1 - axis] <= boxes[j].High[1 - axis] &&
          this->DoCross(box.Segment, boxes[j].Segment))
        {
          pairs.push_back(std::minmax(box.Segment, boxes[j].Segment));
        }
      }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// Whether two segments have exactly one point in common, which is an end of neither.
  bool DoCross(std::size_t first, std::size_t second) const
  {
    const PlanePoint a = this->At(this->Result.Segments[first].From);
    const PlanePoint b = this->At(this->Result.Segments[first].To);
    const PlanePoint c = this->At(this->Result.Segments[second].From);
    const PlanePoint d = this->At(this->Result.Segments[second].To);
    return FindOrientation(a, b, c) * FindOrientation(a, b, d) < 0 &&
      FindOrientation(c, d, a) * FindOrientation(c, d, b) < 0;
  }

  Crossing FindCrossing(std::size_t earlier, std::size_t later) const
  {
    const Segment& first = this->Result.Segments[earlier];
    const Segment& second = this->Result.Segments[later];
    const PlanePoint ends[4] = { this->At(first.From), this->At(first.To), this->At(second.From),
      this->At(second.To) };
    int unit = 1024; // more than any exponent
    for (const PlanePoint& end : ends)
    {
      for (const double value : { end.U, end.V })
      {
        if (value != 0.0)
        {
          unit = std::min(unit, DoubleParts(value).Exponent);
        }
      }
    }
    Integer x[4], y[4];
    for (int i = 0; i < 4; ++i)
    {
      x[i] = ToInteger(ends[i].U, unit);
      y[i] = ToInteger(ends[i].V, unit);
    }
    const auto cross = [&](int a, int b, int c)
    { return Integer((x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])); };
    const auto share = [](Integer fromStart, const Integer& atEnd)
    {
      Integer whole = fromStart - atEnd;
      return whole < 0 ? Fraction{ -fromStart, -whole } : Fraction{ fromStart, whole };
    };
    const Fraction t = share(cross(2, 3, 0), cross(2, 3, 1));
    const auto along = [&](const Integer(&values)[4])
    {
      return Round(
        { values[0] * t.Denominator + t.Numerator * (values[1] - values[0]), t.Denominator }, unit,
        this->Points.Floats != nullptr);
    };
    return { earlier, later, t, share(cross(0, 1, 2), cross(0, 1, 3)), along(x), along(y) };
  }

  /// Finds the points at crossings: those that are there already, and new ones for the others.
  std::vector<std::int64_t> TakePoints(const std::vector<Crossing>& crossings)
  {
    const auto placeOf = [](const Crossing& crossing)
    { return std::pair(crossing.X.Value + 0.0, crossing.Y.Value + 0.0); };
    constexpr std::int64_t None = -1;
    std::map<std::pair<double, double>, std::int64_t> pointAt;
    for (const Crossing& crossing : crossings)
    {
      pointAt.emplace(placeOf(crossing), None);
    }
    for (std::int64_t i = 0; i < this->CountPoints(); ++i)
    {
      const PlanePoint place = this->At(i);
      if (!IsFinite(place))
      {
        continue;
      }
      const auto found = pointAt.find({ place.U, place.V });
      if (found != pointAt.end() && found->second == None)
      {
        found->second = i;
      }
    }
    std::vector<std::int64_t> points;
    for (const Crossing& crossing : crossings)
    {
      const auto found = pointAt.find(placeOf(crossing));
      if (found->second == None)
      {
        found->second = this->CountPoints();
        const Segment& earlier = this->Result.Segments[crossing.Earlier];
        this->Result.Added.push_back({ found->first.first, found->first.second, earlier.From,
          earlier.To, Round(crossing.OnEarlier, 0, false).Value });
      }
      points.push_back(found->second);
      this->Result.LargestShift =
        std::max(this->Result.LargestShift, PlaneLength(crossing.X.Shift, crossing.Y.Shift));
    }
    return points;
  }

  /// How many points there are with those that have been added.
  std::int64_t CountPoints() const
  {
    return this->Points.Count + static_cast<std::int64_t>(this->Result.Added.size());
  }

  /// Cuts segments at the points that are exactly on them. The parts may bend where crossings are
  /// rounded, and would pass beside such points.
  /// @param cuts those at crossings. Other segments stay straight.
  void AddPointsOnSegments(std::vector<Cut>& cuts) const
  {
    std::vector<std::size_t> segments;
    for (const Cut& cut : cuts)
    {
      segments.push_back(cut.Segment);
    }
    std::sort(segments.begin(), segments.end());
    segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
    this->ForPointsNear(
      segments,
      [this](std::size_t segment, std::int64_t point) {
        return FindOrientation(this->GetStart(segment), this->GetEnd(segment), this->At(point)) ==
          0;
      },
      [&](std::size_t segment, std::int64_t point)
      {
        if (const std::optional<Fraction> share = this->FindShare(segment, point))
        {
          cuts.push_back({ segment, *share, point });
        }
      });
  }

  /// Calls visit(segment, point) in the order of the points for all those where
  /// isNear(segment, point), which is called on threads, and only for points not far away.
  template <typename IsNear, typename Visit>
  void ForPointsNear(
    const std::vector<std::size_t>& segments, const IsNear& isNear, const Visit& visit) const
  {
    constexpr std::int64_t Piece = 1 << 14, Batch = 64; // of points, and of pieces
    std::vector<SegmentCells::Ends> ends;
    for (const std::size_t segment : segments)
    {
      ends.push_back({ this->GetStart(segment), this->GetEnd(segment) });
    }
    const SegmentCells cells(ends);
    const std::int64_t pieces = (this->CountPoints() + Piece - 1) / Piece;
    for (std::int64_t first = 0; first < pieces; first += Batch)
    {
      this->Caller.Check();
      std::array<std::vector<std::pair<std::size_t, std::int64_t>>, Batch> found;
      this->Caller.Run(std::min(Batch, pieces - first),
        [&](std::int64_t task)
        {
          const std::int64_t begin = (first + task) * Piece;
          const std::int64_t end = std::min(begin + Piece, this->CountPoints());
          for (std::int64_t point = begin; point < end; ++point)
          {
            cells.ForSegmentsNear(this->At(point),
              [&](std::size_t i)
              {
                if (isNear(segments[i], point))
                {
                  found[task].emplace_back(segments[i], point);
                }
              });
          }
        });
      for (const auto& piece : found)
      {
        for (const auto& [segment, point] : piece)
        {
          visit(segment, point);
        }
      }
    }
  }

  PlanePoint GetStart(std::size_t segment) const
  {
    return this->At(this->Result.Segments[segment].From);
  }
  PlanePoint GetEnd(std::size_t segment) const
  {
    return this->At(this->Result.Segments[segment].To);
  }

  /// The share of a segment's longer extent at which a point is, if it is between the ends.
  std::optional<Fraction> FindShare(std::size_t segment, std::int64_t point) const
  {
    const PlanePoint a = this->GetStart(segment), b = this->GetEnd(segment), p = this->At(point);
    const bool isWide = std::fabs(0.5 * b.U - 0.5 * a.U) >= std::fabs(0.5 * b.V - 0.5 * a.V);
    const double from = isWide ? a.U : a.V, to = isWide ? b.U : b.V, at = isWide ? p.U : p.V;
    if (at <= std::min(from, to) || at >= std::max(from, to))
    {
      return std::nullopt;
    }
    int unit = 1024; // more than any exponent
    for (const double value : { from, at, to })
    {
      unit = value != 0.0 ? std::min(unit, DoubleParts(value).Exponent) : unit;
    }
    const Integer start = ToInteger(from, unit);
    const Integer part = ToInteger(at, unit) - start, whole = ToInteger(to, unit) - start;
    return whole < 0 ? Fraction{ -part, -whole } : Fraction{ part, whole };
  }

  /// Whether a point is so near to a segment, between its ends, that a part of the segment may pass
  /// it on either side by rounding.
  bool IsWithinRounding(std::size_t segment, std::int64_t point) const
  {
    constexpr double Roundings = 4.0;
    const Segment& ends = this->Result.Segments[segment];
    if (point == ends.From || point == ends.To)
    {
      return false;
    }
    const PlanePoint a = this->GetStart(segment), b = this->GetEnd(segment), p = this->At(point);
    const double largest =
      std::max({ std::fabs(a.U), std::fabs(a.V), std::fabs(b.U), std::fabs(b.V) });
    const double distance = Roundings * largest * (this->Points.Floats ? 0x1p-23 : 0x1p-52);
    // Most points are farther away, and comparisons are faster than a square root.
    const double room = 2.0 * distance;
    const bool isAway = p.U < std::min(a.U, b.U) - room || p.U > std::max(a.U, b.U) + room ||
      p.V < std::min(a.V, b.V) - room || p.V > std::max(a.V, b.V) + room;
    if (isAway)
    {
      return false;
    }
    const double u = b.U - a.U, v = b.V - a.V, length = PlaneLength(u, v);
    const double along = (u * (p.U - a.U) + v * (p.V - a.V)) / length;
    const double across = (u * (p.V - a.V) - v * (p.U - a.U)) / length;
    return along > distance && along < length - distance && std::fabs(across) <= distance;
  }

  /// Splits segments at cuts, which are sorted here.
  void SplitAt(std::vector<Cut>& cuts)
  {
    std::sort(cuts.begin(), cuts.end(),
      [](const Cut& a, const Cut& b)
      { return std::tie(a.Segment, a.Share, a.Point) < std::tie(b.Segment, b.Share, b.Point); });
    std::vector<Segment> split;
    auto cut = cuts.begin();
    for (std::size_t i = 0; i < this->Result.Segments.size(); ++i)
    {
      Segment rest = this->Result.Segments[i];
      for (; cut != cuts.end() && cut->Segment == i; ++cut)
      {
        if (cut->Point != rest.From) // several crossings may round to one point
        {
          split.push_back({ rest.From, cut->Point, rest.Ring, rest.Number });
          rest.From = cut->Point;
        }
      }
      if (rest.From != rest.To)
      {
        split.push_back(rest);
      }
    }
    this->Result.Segments = std::move(split);
  }

  void Split(const std::vector<std::pair<std::size_t, std::size_t>>& pairs)
  {
    std::vector<Crossing> crossings;
    for (const auto& [earlier, later] : pairs)
    {
      this->Caller.Check();
      crossings.push_back(this->FindCrossing(earlier, later));
    }
    const std::vector<std::int64_t> points = this->TakePoints(crossings);
    std::vector<Cut> cuts;
    for (std::size_t i = 0; i < crossings.size(); ++i)
    {
      cuts.push_back({ crossings[i].Earlier, crossings[i].OnEarlier, points[i] });
      cuts.push_back({ crossings[i].Later, crossings[i].OnLater, points[i] });
    }
    this->AddPointsOnSegments(cuts);
    this->SplitAt(cuts);
  }

  const PlaneArray& Points;
  const CrossingsCaller& Caller;
  SplitSegments Result;
};
}

SplitSegments SplitCrossings(
  const PlaneArray& points, std::vector<Segment> segments, const CrossingsCaller& caller)
{
  return Splitter(points, std::move(segments), caller).Run();
}

std::vector<Segment> SplitAtNearPoints(
  const PlaneArray& points, std::vector<Segment> segments, const CrossingsCaller& caller)
{
  return Splitter(points, std::move(segments), caller).RunNear();
}

}
