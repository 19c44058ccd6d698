// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExperimentSupport.h"
#include "PaperMeshBuilder.h"
#include "PaperSurfaces.h"
#include "PaperTests.h"
#include "Predicates.h"

#include <cmath>
#include <limits>
#include <stdexcept>

/// @file
/// Future work 1: the in-circle test against that of opposite angles. The exact results for a row
/// are computed from the points as rounded to its precision.

namespace delaunayflip
{

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::uint32_t Seed = 6;

/// Like a survey's plane coordinates in metres: a square kilometre far from the origin.
OwnedMesh<double> MoveFarAway(OwnedMesh<double> mesh)
{
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] = 1000.0 * mesh.Points[i] + 500000.0;
    mesh.Points[i + 1] = 1000.0 * mesh.Points[i + 1] + 4500000.0;
  }
  return mesh;
}

OwnedMesh<double> MakeTestMesh(const std::string& name, std::int64_t points)
{
  const auto side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(points)));
  OwnedMesh<double> mesh;
  if (name == "random" || name == "offset")
  {
    mesh = WidenToDoubles(MakePaperRandomMesh(points));
    return name == "random" ? mesh : MoveFarAway(std::move(mesh));
  }
  if (name != "grid" && name != "circles")
  {
    throw std::invalid_argument("unknown mesh: " + name);
  }
  mesh = name == "grid" ? MakeGridMesh(side - 1, side - 1) : MakeCircles(2 * side, side / 2);
  RuinByFlips(mesh, 3.0, Seed);
  return mesh;
}

/// A test with its tolerance.
struct TestChoice
{
  PaperTestKind Kind;
  double Epsilon;
  std::string Name;
};

template <typename Real>
std::vector<TestChoice> ListTests()
{
  // Shewchuk's bound on the rounding error: a determinant of larger magnitude has the right sign.
  const double unit = 0.5 * std::numeric_limits<Real>::epsilon();
  const double bound = (10.0 + 96.0 * unit) * unit;
  const double epsilon = sizeof(Real) == 4 ? FloatEpsilon : 1e-7;
  return { { PaperTestKind::OppositeAngles, 0.0, "angles" },
    { PaperTestKind::OppositeAngles, epsilon, "angles, epsilon" },
    { PaperTestKind::InCircle, 0.0, "in-circle" },
    { PaperTestKind::InCircle, bound, "in-circle, error bound" } };
}

/// Adds how many edges of a mesh a test has judged, and how many of its decisions exact arithmetic
/// contradicts.
template <typename Real, typename Test>
void CountWrongDecisions(const PaperMesh<PaperPoint2<Real>>& mesh, const Test& test, Json& row)
{
  std::int64_t edges = 0, falseBad = 0, missedBad = 0;
  const auto at = [&](std::int32_t vertex) { return mesh.Vertices[vertex]; };
  for (std::int64_t e = 0; e < mesh.NumberOfEdges(); ++e)
  {
    if (mesh.TriangleB[e].First < 0)
    {
      continue;
    }
    const auto p = at(mesh.Ends[e].First), q = at(mesh.Ends[e].Second);
    const auto a = at(mesh.Triangles[mesh.Opposites[e].First]);
    const auto b = at(mesh.Triangles[mesh.Opposites[e].Second]);
    const double exact[4][2] = { { p.X, p.Y }, { q.X, q.Y }, { a.X, a.Y }, { b.X, b.Y } };
    const bool isBad = InCircle(exact[0], exact[1], exact[2], exact[3]) > 0;
    const bool saysBad = test.IsBad(p, q, a, b);
    ++edges;
    falseBad += saysBad && !isBad;
    missedBad += isBad && !saysBad;
  }
  row["decisions"] = row.value("decisions", std::int64_t(0)) + edges;
  row["false_bad"] = row.value("false_bad", std::int64_t(0)) + falseBad;
  row["missed_bad"] = row.value("missed_bad", std::int64_t(0)) + missedBad;
}

std::int64_t CountTurnedOver(const TriangleMesh& mesh)
{
  std::int64_t turned = 0;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    double corners[3][2];
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t vertex = mesh.Triangles.Get(t, slot);
      corners[slot][0] = mesh.Points.Get(vertex, 0);
      corners[slot][1] = mesh.Points.Get(vertex, 1);
    }
    turned += Orientation(corners[0], corners[1], corners[2]) <= 0;
  }
  return turned;
}

/// All tests in one precision.
template <typename Real>
class TestRows
{
public:
  TestRows(const ExperimentSettings& settings, const std::string& name, OwnedMesh<Real> mesh)
    : Settings(settings),
      Name(name),
      Mesh(std::move(mesh)),
      View(this->Mesh.View())
  {
    FlipOptions options;
    options.Geometry = GeometryKind::PlanarXY;
    this->Exact.resize(this->Mesh.Triangles.size());
    FlipToDelaunay(this->View, options, { this->Exact.data(), this->Mesh.NumberOfTriangles() });
  }

  void AddTo(Json& rows)
  {
    for (const bool onGpu : { false, true })
    {
      if (onGpu && !this->Settings.OnGpu)
      {
        continue;
      }
      for (const TestChoice& test : ListTests<Real>())
      {
        rows.push_back(this->RunPapersTest(test, onGpu));
      }
      rows.push_back(this->RunOurTest(CriterionKind::InCircle, onGpu, "ours, in-circle"));
      rows.push_back(this->RunOurTest(CriterionKind::OppositeAngles, onGpu, "ours, angles"));
    }
  }

private:
  Json RunPapersTest(const TestChoice& test, bool onGpu)
  {
    PaperOptions options;
    options.Test = test.Kind;
    options.InDouble = sizeof(Real) == 8;
    options.Epsilon = test.Epsilon;
    options.OnGpu = onGpu;
    options.MaximumIterations = 150;
    Json row = this->Describe(RunPapers(this->Settings, this->View, options, test.Name));
    const ThreadBackend threads(0);
    for (const std::vector<std::int32_t>* triangles : { &this->Mesh.Triangles, &this->Exact })
    {
      const auto mesh =
        MakePaperMesh<PaperPoint2<Real>>(WithTriangles(this->View, *triangles), threads);
      if (test.Kind == PaperTestKind::InCircle)
      {
        const InCircleTest<Real> inCircle{ static_cast<Real>(test.Epsilon), Real(1) };
        CountWrongDecisions(mesh, inCircle, row);
      }
      else
      {
        const OppositeAngleTest<Real> angles{ static_cast<Real>(Pi + test.Epsilon) };
        CountWrongDecisions(mesh, angles, row);
      }
    }
    return row;
  }

  Json RunOurTest(CriterionKind criterion, bool onGpu, const std::string& program)
  {
    FlipOptions options = onGpu ? OnGpu() : OnThreads(0);
    options.Geometry = GeometryKind::PlanarXY;
    options.Criterion = criterion;
    return this->Describe(RunOurs(this->Settings, this->View, options, program));
  }

  Json Describe(MethodRun run)
  {
    const TriangleMesh after = WithTriangles(this->View, run.Triangles);
    run.Row["mesh"] = this->Name;
    run.Row["precision"] = sizeof(Real) == 8 ? "double" : "float";
    run.Row["bad_left"] = CountExactViolations(after);
    run.Row["turned_over"] = CountTurnedOver(after);
    run.Row["turned_over_before"] = CountTurnedOver(this->View);
    run.Row.erase("flipped");
    run.Row.erase("excluded");
    return std::move(run.Row);
  }

  const ExperimentSettings& Settings;
  std::string Name;
  OwnedMesh<Real> Mesh;
  TriangleMesh View;
  std::vector<std::int32_t> Exact; ///< The triangles of the exact result.
};

}

Json RunTests(const ExperimentSettings& settings, const std::string& mesh, std::int64_t points)
{
  const OwnedMesh<double> made = MakeTestMesh(mesh, points);
  Json rows = Json::array();
  TestRows<float>(settings, mesh, RoundToFloats(made)).AddTo(rows);
  TestRows<double>(settings, mesh, made).AddTo(rows);
  return rows;
}

}
