// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExperimentSupport.h"
#include "MeshFile.h"
#include "PaperSurfaces.h"
#include "SurfaceChange.h"
#include "TriangleAngles.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

/// @file
/// Future work 2: surfaces of bad quality.

namespace delaunayflip
{

namespace
{

constexpr std::uint32_t Seed = 12;
constexpr double JudgeTolerance = 1e-6;

/// A surface of about this many points, improved by flips.
OwnedMesh<double> MakeGoodSurface(const std::string& shape, std::int64_t points)
{
  const double side = std::sqrt(static_cast<double>(points) / 2.0);
  OwnedMesh<double> mesh = shape == "box"
    ? MakeBox(static_cast<std::int32_t>(std::sqrt(static_cast<double>(points) / 6.0)))
    : MakeBumpyTorus(
        static_cast<std::int32_t>(2.0 * side), static_cast<std::int32_t>(side), 0.0, Seed);
  FlipOptions options = OnThreads(0);
  options.Geometry = GeometryKind::Surface;
  FlipToDelaunay(mesh.View(), options, { mesh.Triangles.data(), mesh.NumberOfTriangles() });
  return mesh;
}

/// A torus with points twenty times as dense along it as around its tube, and random diagonals.
OwnedMesh<double> MakeAnisotropic(std::int64_t points)
{
  const double around = std::sqrt(static_cast<double>(points) / 40.0);
  return MakeBumpyTorus(
    static_cast<std::int32_t>(40.0 * around), static_cast<std::int32_t>(around), 0.45, Seed);
}

OwnedMesh<double> MakeRuinedSurface(
  const std::string& kind, const std::string& shape, std::int64_t points)
{
  if (kind == "anisotropic")
  {
    return MakeAnisotropic(points);
  }
  OwnedMesh<double> mesh = MakeGoodSurface(shape, points);
  if (kind == "flips")
  {
    RuinByFlips(mesh, 6.0, Seed);
  }
  else if (kind == "splits")
  {
    RuinBySplits(mesh, 0.1, Seed);
  }
  else
  {
    throw std::invalid_argument("unknown way to ruin a surface: " + kind);
  }
  return mesh;
}

double FindMeanSmallestAngle(const TriangleMesh& mesh)
{
  std::vector<double> degrees(mesh.Triangles.Count);
  FindSmallestAngles(mesh, GeometryKind::Surface, 0, degrees.data());
  return std::accumulate(degrees.begin(), degrees.end(), 0.0) / static_cast<double>(degrees.size());
}

Json RunOne(const ExperimentSettings& settings, const OwnedMesh<double>& mesh, double featureAngle)
{
  FlipOptions options = settings.OnGpu ? OnGpu() : OnThreads(0);
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = featureAngle;
  MethodRun run = RunOurs(settings, mesh.View(), options, "ours");
  std::vector<double> angles(mesh.NumberOfTriangles());
  const TriangleMesh after = WithTriangles(mesh.View(), run.Triangles);
  const auto findSmallest = [&](const TriangleMesh& surface)
  {
    FindSmallestAngles(surface, GeometryKind::Surface, 0, angles.data());
    return *std::min_element(angles.begin(), angles.end());
  };
  Json& row = run.Row;
  row["feature_angle"] = featureAngle;
  row["smallest_angle_before"] = findSmallest(mesh.View());
  row["smallest_angle"] = findSmallest(after);
  row["mean_smallest_angle_before"] = FindMeanSmallestAngle(mesh.View());
  row["mean_smallest_angle"] = FindMeanSmallestAngle(after);
  const ViolationReasons reasons = FindReasons(mesh, run.Triangles, options, JudgeTolerance);
  row["left_fixed"] = reasons.Fixed;
  row["left_duplicate"] = reasons.Duplicate;
  row["left_fold"] = reasons.Fold;
  row["left_other"] = reasons.Other;
  const SurfaceChange change = MeasureChange(mesh, run.Triangles);
  row["distance"] = change.Distance;
  row["volume_change"] = change.Volume;
  row.erase("flipped");
  row.erase("excluded");
  return row;
}

}

Json RunRuined(const ExperimentSettings& settings, const std::string& kind, std::int64_t points,
  const std::vector<double>& featureAngles)
{
  Json rows = Json::array();
  for (const std::string shape : { "torus", "box" })
  {
    if (kind == "anisotropic" && shape == "box")
    {
      continue;
    }
    const OwnedMesh<double> mesh = MakeRuinedSurface(kind, shape, points);
    const double goal = FindMeanSmallestAngle(MakeGoodSurface(shape, points).View());
    for (const double featureAngle : featureAngles)
    {
      Json row = RunOne(settings, mesh, featureAngle);
      row["ruined_by"] = kind;
      row["shape"] = shape;
      row["mean_smallest_angle_of_good"] = goal;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

Json RunAsItIs(const ExperimentSettings& settings, const std::string& path,
  const std::vector<double>& featureAngles)
{
  const FileMesh file = ReadMeshFile(path);
  OwnedMesh<double> mesh;
  mesh.Triangles = file.Triangles;
  mesh.Points = file.Doubles;
  mesh.Points.insert(mesh.Points.end(), file.Floats.begin(), file.Floats.end());
  Json rows = Json::array();
  for (const double featureAngle : featureAngles)
  {
    Json row = RunOne(settings, mesh, featureAngle);
    row["ruined_by"] = "nothing";
    row["shape"] = file.Name;
    rows.push_back(std::move(row));
  }
  return rows;
}

}
