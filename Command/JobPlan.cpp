// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JobPlan.h"

namespace delaunayflip
{

namespace
{

// Times per triangle, relative to building the edges of a badly triangulated terrain and flipping
// them. Writing includes reading the file back.
constexpr double Flips = 4.0;

double GetReadCost(MeshFormat format)
{
  switch (format)
  {
    case MeshFormat::VTK:
    case MeshFormat::PLY:
      return 0.5;
    case MeshFormat::VTP:
      return 1.8;
    case MeshFormat::STL:
      return 3.5;
    case MeshFormat::OBJ:
      break;
  }
  return 1.4;
}

double GetWriteCost(MeshFormat format)
{
  switch (format)
  {
    case MeshFormat::VTK:
    case MeshFormat::PLY:
    case MeshFormat::STL:
      return 1.6;
    case MeshFormat::VTP:
      return 6.0;
    case MeshFormat::OBJ:
      break;
  }
  return 3.6;
}

}

JobPlan PlanJob(MeshFormat input, MeshFormat output)
{
  const double read = GetReadCost(input);
  const double all = read + Flips + GetWriteCost(output);
  return { read / all, (read + Flips) / all };
}

}
