// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointSets.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{
namespace
{

using Random = std::mt19937_64;
constexpr double Pi = 3.14159265358979323846;

double Draw(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Place AtAngle(double radiusX, double radiusY, double turns)
{
  return { radiusX * std::cos(2 * Pi * turns), radiusY * std::sin(2 * Pi * turns) };
}

/// On one of so many closed lines, each inside the next.
Place DrawContour(Random& random, int levels)
{
  const double level = 1.0 + static_cast<double>(random() % levels);
  const double turns = Draw(random);
  const double radius =
    level * (1 + 0.25 * std::sin(6 * Pi * turns + 0.1 * level) + 0.1 * std::sin(14 * Pi * turns));
  return AtAngle(radius, 0.7 * radius, turns);
}

/// The path of a particle that is hit on all scales, at a time between 0 and 1.
Place FollowWalk(double time)
{
  Place place{ 0, 0 };
  for (int scale = 0; scale < 20; ++scale)
  {
    const double turns = std::ldexp(time, scale);
    const double size = std::pow(0.5, 0.5 * scale);
    place[0] += size * std::cos(2 * Pi * turns + scale * scale);
    place[1] += size * std::cos(2 * Pi * turns + 2 * scale * scale);
  }
  return place;
}

/// Layers around an ellipse, each a tenth thicker than the one before: the points of a mesh for the
/// flow around a wing.
Place AtLayer(double i, double n)
{
  const double around = std::ceil(3 * std::sqrt(n)), layers = std::ceil(n / around);
  const double growth = 1 + 5 / layers;
  const double away = std::pow(growth, std::floor(i / around)) - 1;
  return AtAngle(1 + 0.01 * away, 0.12 + 0.01 * away, std::fmod(i, around) / around);
}

const std::vector<PointSet> Sets = {
  { "uniform",
    [](Random& r, double, double) {
      return Place{ Draw(r), Draw(r) };
    } },
  { "clusters",
    [](Random& r, double i, double)
    {
      Random centre(static_cast<std::uint64_t>(i) % 30);
      const double size = std::pow(10.0, -1 - 3 * Draw(centre));
      const double x = Draw(centre), y = Draw(centre);
      const double distance = size * std::sqrt(-2 * std::log(1 - Draw(r)));
      const Place offset = AtAngle(distance, distance, Draw(r));
      return Place{ x + offset[0], y + offset[1] };
    } },
  { "lines",
    [](Random& r, double, double) {
      return Place{ Draw(r), static_cast<double>(r() % 100) / 100 + 1e-4 * Draw(r) };
    } },
  { "ring",
    [](Random& r, double, double)
    {
      const double radius = 1 + 1e-3 * Draw(r);
      return AtAngle(radius, radius, Draw(r));
    } },
  { "power",
    [](Random& r, double, double)
    {
      const double radius = std::pow(Draw(r), 4);
      return AtAngle(radius, radius, Draw(r));
    } },
  { "outlier",
    [](Random& r, double i, double) {
      return i == 0 ? Place{ 0.5, 1e4 } : Place{ Draw(r), Draw(r) };
    } },
  { "lattice",
    [](Random&, double i, double n)
    {
      const double side = std::ceil(std::sqrt(n));
      return Place{ std::fmod(i, side), std::floor(i / side) };
    } },
  { "contours40", [](Random& r, double, double) { return DrawContour(r, 40); } },
  { "contours400", [](Random& r, double, double) { return DrawContour(r, 400); } },
  { "ellipse", [](Random& r, double, double) { return AtAngle(1000, 1, Draw(r)); } },
  { "parabola",
    [](Random& r, double, double)
    {
      const double x = Draw(r);
      return Place{ x, x * x };
    } },
  { "hyperbola",
    [](Random& r, double, double)
    {
      const double x = 10 * Draw(r) + 0.1;
      return Place{ x, 1 / x };
    } },
  { "spiral",
    [](Random&, double i, double) { return AtAngle(i + 0.5, i + 0.5, 0.001 * i / (2 * Pi)); } },
  { "tall",
    [](Random& r, double, double) {
      return Place{ Draw(r), 1e4 * Draw(r) };
    } },
  { "scan_lines",
    [](Random& r, double i, double)
    {
      const double along = std::fmod(i, 200) + 0.1 * Draw(r);
      const double across = 10 * std::floor(i / 200) + 0.1 * Draw(r);
      return Place{ 0.8 * along - 0.6 * across, 0.6 * along + 0.8 * across };
    } },
  { "offset",
    [](Random& r, double, double)
    {
      const double x = 500000 + std::round(1e6 * Draw(r)) / 1e3;
      return Place{ x, 5.4e6 + std::round(1e6 * Draw(r)) / 1e3 };
    } },
  { "sunflower",
    [](Random&, double i, double)
    { return AtAngle(std::sqrt(i + 0.5), std::sqrt(i + 0.5), 2.399963 * i / (2 * Pi)); } },
  { "kuzmin",
    [](Random& r, double, double)
    {
      const double inside = 1 - Draw(r);
      const double radius = std::sqrt(1 / (inside * inside) - 1);
      return AtAngle(radius, radius, Draw(r));
    } },
  { "walk", [](Random&, double i, double n) { return FollowWalk(i / n); } },
  { "wide",
    [](Random& r, double, double) {
      return Place{ 1e4 * Draw(r), Draw(r) };
    } },
  { "turned_lattice",
    [](Random&, double i, double n)
    {
      const double side = std::ceil(std::sqrt(n));
      const double x = std::fmod(i, side), y = std::floor(i / side);
      return Place{ 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y };
    } },
  { "circle", [](Random& r, double, double) { return AtAngle(1, 1, Draw(r)); } },
  { "survey_lines", // of a ship that sails to and fro
    [](Random& r, double i, double n)
    {
      const double lines = 20, line = std::fmod(i, lines),
                   along = std::floor(i / lines) * lines / n;
      const double across = line + 0.1 * std::sin(9 * along + line) + 1e-3 * Draw(r);
      return Place{ lines * along, across + 0.1 * lines * along };
    } },
  { "profiles", // along straight roads
    [](Random& r, double i, double)
    {
      Random road(static_cast<std::uint64_t>(i) % 60);
      const double x = Draw(road), y = Draw(road), along = Draw(r);
      const double toX = Draw(road), toY = Draw(road);
      return Place{ x + along * (toX - x) + 1e-4 * Draw(r),
        y + along * (toY - y) + 1e-4 * Draw(r) };
    } },
  { "boundary_layers", [](Random&, double i, double n) { return AtLayer(i, n); } },
  { "two_circles",
    [](Random& r, double i, double)
    {
      const Place place = AtAngle(1, 1, Draw(r));
      return Place{ place[0], place[1] + 2 * std::fmod(i, 2) };
    },
    true },
  { "line_and_point",
    [](Random& r, double i, double) {
      return i == 0 ? Place{ 0.5, 1 } : Place{ Draw(r), 0 };
    },
    true },
  { "two_rows",
    [](Random& r, double i, double) {
      return i < 20 ? Place{ i / 19, 1 } : Place{ Draw(r), 0 };
    },
    true },
};

}

const std::vector<PointSet>& ListPointSets() { return Sets; }

std::vector<Place> MakePlaces(const PointSet& set, std::int64_t count)
{
  Random random(5);
  std::vector<Place> places;
  for (std::int64_t i = 0; i < count; ++i)
  {
    places.push_back(set.Make(random, static_cast<double>(i), static_cast<double>(count)));
  }
  std::shuffle(places.begin(), places.end(), random);
  return places;
}

}
