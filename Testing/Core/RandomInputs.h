// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RANDOMINPUTS_H
#define DELAUNAYFLIP_RANDOMINPUTS_H

#include "FlipTestSupport.h"

/// @file
/// Random points on which predicates go wrong, and random meshes with every kind of defect. A seed
/// gives the same on every machine.

namespace delaunayflip
{

using FourPoints = std::array<Point3, 4>;

/// Whether fixed-point integers hold the coordinates of a family.
enum class Fit
{
  Sometimes,
  Always,
  Never
};

/// Four points at a time: ties, near ties, and exponents at the limits of each kind of arithmetic.
struct PointFamily
{
  const char* Name;
  FourPoints (*Draw)(std::mt19937&);
  Fit FixedPoint;
};

std::vector<PointFamily> ListPointFamilies();

/// A small random mesh with every kind of defect, random constraints and random options.
struct RandomMess
{
  OwnedMesh<double> Mesh;
  std::vector<std::int64_t> Constraints; ///< Pairs of point ids.
  FlipOptions Options;

  TriangleMesh View() const { return WithConstraints(this->Mesh.View(), this->Constraints); }
};

RandomMess MakeRandomMess(std::uint32_t seed);

}

#endif
