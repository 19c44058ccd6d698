// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExperimentSupport.h"
#include "MeshAudit.h"
#include "MeshFile.h"
#include "PaperTests.h"
#include "SequentialLawson.h"

#include <cmath>

/// @file
/// Section 5.2: surfaces.

namespace delaunayflip
{

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Epsilon = 1e-6; ///< Of eq. 5, for sequential Lawson in double precision.

/// The options by which all results are judged.
FlipOptions MakeJudge(double threshold)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = threshold;
  options.Tolerance = 2.0 * Epsilon;
  return options;
}

/// Adds the duplicate edges, the bad edges left and the smallest angles.
void DescribeResult(const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles, Json& row)
{
  const TriangleMesh after = WithTriangles(mesh, triangles);
  row["duplicate_edges"] = CountDuplicateEdgesGained(mesh.Triangles, after.Triangles);
  row["non_manifold_before"] = CountEdges(mesh.Triangles).NonManifold;
  row["bad_by_angle"] = CountNonDelaunayEdges(after, MakeJudge(180.0));
  row["smallest_angle_before"] = MinimumAngle(mesh, GeometryKind::Surface);
  row["smallest_angle"] = MinimumAngle(after, GeometryKind::Surface);
}

/// Sequential Lawson in space, by the paper's test and threshold in double precision.
class SurfaceLawson
{
public:
  SurfaceLawson(const TriangleMesh& mesh, double threshold)
    : Test{ Pi + Epsilon },
      Normals{ std::cos(threshold * Pi / 180.0) },
      Mesh(CopyTriangles(mesh))
  {
    for (std::int64_t i = 0; i < mesh.Points.Count; ++i)
    {
      this->Points.push_back(
        { mesh.Points.Get(i, 0), mesh.Points.Get(i, 1), mesh.Points.Get(i, 2), 0.0 });
    }
  }

  /// No theorem is known, to the paper or to us, by which this must end.
  std::int64_t Run()
  {
    const std::int64_t limit = 50 * std::int64_t(this->Mesh.Vertices.size());
    return RunLawson(
      this->Mesh, [this](std::int32_t c) { return this->IsBad(c); }, limit);
  }

  const std::vector<std::int32_t>& GetTriangles() const { return this->Mesh.Vertices; }

private:
  static std::vector<std::int32_t> CopyTriangles(const TriangleMesh& mesh)
  {
    std::vector<std::int32_t> ids(3 * mesh.Triangles.Count);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const auto corner = static_cast<std::int64_t>(i);
      ids[i] = static_cast<std::int32_t>(mesh.Triangles.Get(corner / 3, corner % 3));
    }
    return ids;
  }

  const PaperPoint3<double>& At(std::int32_t corner) const
  {
    return this->Points[this->Mesh.Vertices[corner]];
  }

  bool IsBad(std::int32_t corner) const
  {
    const auto& a = this->At(corner);
    const auto& p = this->At(CornerMesh::Next(corner));
    const auto& q = this->At(CornerMesh::Previous(corner));
    const auto& b = this->At(this->Mesh.Twins[corner]);
    return this->Test.IsBad(p, q, a, b) && this->Normals.Admits(p, q, a, b);
  }

  OppositeAngleTest<double> Test;
  NormalThreshold<double> Normals;
  CornerMesh Mesh;
  std::vector<PaperPoint3<double>> Points;
};

Json RunSurfaceLawson(
  const ExperimentSettings& settings, const TriangleMesh& mesh, double threshold)
{
  Json row = { { "program", "lawson" }, { "points", mesh.Points.Count },
    { "triangles", mesh.Triangles.Count } };
  std::vector<std::int32_t> triangles;
  Stopwatches watches(settings);
  watches.Repeat(
    [&]
    {
      SurfaceLawson lawson(mesh, threshold);
      const double flips = MeasureMilliseconds([&] { row["flips"] = lawson.Run(); });
      triangles = lawson.GetTriangles();
      return Json{ { "flips_ms", flips } };
    });
  watches.Store(row);
  DescribeResult(mesh, triangles, row);
  return row;
}

PaperOptions MakePaperOptions(double threshold, bool onGpu)
{
  PaperOptions options;
  options.Dimension = 3;
  options.Epsilon = FloatEpsilon;
  options.NormalThreshold = threshold;
  options.OnGpu = onGpu;
  options.MaximumIterations = 150;
  return options;
}

}

Json RunSurface(const ExperimentSettings& settings, const std::string& path, double threshold)
{
  const FileMesh file = ReadMeshFile(path);
  const TriangleMesh mesh = file.View();
  Json rows = Json::array();
  const auto add = [&](Json row, double degrees)
  {
    row["mesh"] = file.Name;
    row["threshold"] = degrees;
    rows.push_back(std::move(row));
  };
  const auto describe = [&](MethodRun run)
  {
    DescribeResult(mesh, run.Triangles, run.Row);
    return run.Row;
  };
  for (const double degrees : { threshold, 180.0 })
  {
    for (const bool onGpu : { false, true })
    {
      if (onGpu && !settings.OnGpu)
      {
        continue;
      }
      FlipOptions ours = MakeJudge(degrees);
      ours.Tolerance = -1.0;
      ours.Backend = onGpu ? BackendKind::CUDA : BackendKind::Threads;
      const std::string place = onGpu ? "-gpu" : "-all";
      add(describe(RunOurs(settings, mesh, ours, "ours" + place)), degrees);
      const PaperOptions papers = MakePaperOptions(degrees, onGpu);
      add(describe(RunPapers(settings, mesh, papers, "paper" + place)), degrees);
    }
    add(RunSurfaceLawson(settings, mesh, degrees), degrees);
  }
  return rows;
}

}
