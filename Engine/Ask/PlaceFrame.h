// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEFRAME_H
#define DELAUNAYFLIP_PLACEFRAME_H

#include "PlaceOffsets.h"
#include "PlaneMesh.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace delaunayflip
{

/// The power of two by which a number that is not negative comes to be between 1 and 2; the largest
/// one that is finite for the smallest numbers.
DELAUNAYFLIP_HOST_DEVICE inline double InvertPowerOfTwo(double number)
{
  constexpr int MantissaBits = 52;
  constexpr std::uint64_t TwiceTheBias = 2046;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  std::uint64_t exponent = bits >> MantissaBits;
  if (exponent >= TwiceTheBias) // its inverse would be too small to be a normal number
  {
    exponent = TwiceTheBias - 1;
  }
  const std::uint64_t inverse = (TwiceTheBias - exponent) << MantissaBits;
  double power = 0.0;
  std::memcpy(&power, &inverse, sizeof(power));
  return power;
}

/// The scale for a place and what is around it, by the triangle that has it.
class PlaceFrame
{
public:
  DELAUNAYFLIP_HOST_DEVICE PlaceFrame(
    const PlaneMesh& mesh, const PlanePoint& place, TriangleId triangle)
    : Mesh(mesh)
  {
    double largest = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint point = mesh.GetPoint(mesh.GetVertex(MakeCorner(triangle, slot)));
      for (const double half : { 0.5 * point.U - 0.5 * place.U, 0.5 * point.V - 0.5 * place.V })
      {
        if (std::fabs(half) > largest)
        {
          largest = std::fabs(half);
        }
      }
    }
    this->Scale = InvertPowerOfTwo(largest);
    this->Place = { place.U * this->Scale, place.V * this->Scale };
  }

  DELAUNAYFLIP_HOST_DEVICE const ScaledPoint& GetPlace() const { return this->Place; }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPoint(VertexId vertex) const
  {
    const PlanePoint point = this->Mesh.GetPoint(vertex);
    return { point.U * this->Scale, point.V * this->Scale };
  }

private:
  const PlaneMesh& Mesh;
  ScaledPoint Place;
  double Scale;
};

}

#endif
