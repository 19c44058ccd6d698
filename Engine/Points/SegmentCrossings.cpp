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
  auto rounded = static_cast<double>(bits);
  if (toFloat)
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

class Splitter
{
public:
  Splitter(const PlaneArray& points, std::vector<Segment> segments)
    : Points(points)
  {
    this->Result.Segments = std::move(segments);
  }

  SplitSegments Run(const std::function<void()>& check)
  {
    constexpr int Rounds = 10;
    std::size_t most = 0; // pairs of a round
    for (int round = 0; round < Rounds; ++round)
    {
      const std::vector<std::pair<std::size_t, std::size_t>> pairs = this->FindPairs(check);
      most = round == 0 ? 4 * pairs.size() + 1000 : most;
      if (pairs.empty() || pairs.size() > most)
      {
        break;
      }
      this->Split(pairs, check);
    }
    return std::move(this->Result);
  }

private:
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
  std::vector<std::pair<std::size_t, std::size_t>> FindPairs(
    const std::function<void()>& check) const
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
        check();
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

  void Split(const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
    const std::function<void()>& check)
  {
    struct Cut
    {
      std::size_t Segment;
      Fraction Share;
      std::int64_t Point;
    };
    std::vector<Crossing> crossings;
    for (const auto& [earlier, later] : pairs)
    {
      check();
      crossings.push_back(this->FindCrossing(earlier, later));
    }
    const std::vector<std::int64_t> points = this->TakePoints(crossings);
    std::vector<Cut> cuts;
    for (std::size_t i = 0; i < crossings.size(); ++i)
    {
      cuts.push_back({ crossings[i].Earlier, crossings[i].OnEarlier, points[i] });
      cuts.push_back({ crossings[i].Later, crossings[i].OnLater, points[i] });
    }
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

  const PlaneArray& Points;
  SplitSegments Result;
};
}

SplitSegments SplitCrossings(
  const PlaneArray& points, std::vector<Segment> segments, const std::function<void()>& check)
{
  return Splitter(points, std::move(segments)).Run(check);
}

}
