// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BadPlane.h"
#include "CgalDelaunay.h"
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "Machine.h"
#include "MeshAudit.h"
#include "MeshFile.h"
#include "PaperMethod.h"
#include "Predicates.h"
#include "SequentialLawson.h"
#include "TriangleAngles.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

/// @file
/// delaunay-flip-paper EXPERIMENT [SETTINGS]: the experiments of the paper, one at a time, as JSON.
/// reproduce_paper.sh runs them all. The experiments are named at the end of this file. SETTINGS is
/// a JSON object of public members of Experiments, e.g. {"Points": 1000, "Program": "lawson"}.

namespace delaunayflip
{
namespace
{

using Json = nlohmann::ordered_json;
using Ids = std::vector<std::int32_t>;

/// The epsilon of eq. 5, for sequential Lawson on surfaces, in double precision.
constexpr double LawsonEpsilon = 1e-6;

TriangleMesh WithTriangles(TriangleMesh mesh, const Ids& triangles)
{
  mesh.Triangles = TriangleArray(triangles.data(), static_cast<std::int64_t>(triangles.size()) / 3);
  return mesh;
}

template <typename To, typename From>
OwnedMesh<To> ConvertMesh(const OwnedMesh<From>& mesh)
{
  return { { mesh.Points.begin(), mesh.Points.end() }, mesh.Triangles };
}

FlipOptions MakeOptions(GeometryKind geometry, bool onGpu, int threads = 0)
{
  FlipOptions options;
  options.Geometry = geometry;
  options.Backend = onGpu ? BackendKind::CUDA : BackendKind::Threads;
  options.NumberOfThreads = threads;
  return options;
}

PaperOptions MakePaperOptions(bool onGpu, int threads = 0)
{
  PaperOptions options;
  options.OnGpu = onGpu;
  options.NumberOfThreads = threads;
  return options;
}

/// Edges that violate the exact in-circle criterion by x and y.
std::int64_t CountExactViolations(const TriangleMesh& mesh)
{
  return CountNonDelaunayEdges(mesh, MakeOptions(GeometryKind::PlanarXY, false));
}

/// The number of triangles of `found` that are not in `expected`, in any order and winding.
std::int64_t CountDifferentTriangles(const Ids& found, const Ids& expected)
{
  const auto sort = [](const Ids& ids)
  {
    std::vector<std::array<std::int32_t, 3>> triangles(ids.size() / 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      triangles[t] = { ids[3 * t], ids[3 * t + 1], ids[3 * t + 2] };
      std::sort(triangles[t].begin(), triangles[t].end());
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  const auto a = sort(found), b = sort(expected);
  std::vector<std::array<std::int32_t, 3>> different;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(different));
  return static_cast<std::int64_t>(different.size());
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

using EdgeSet = std::unordered_set<std::uint64_t>;

/// A random number in [0, 1), the same with every standard library.
double DrawUnit(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

/// Makes random flips, about `share` per triangle. Each is legal: the new edge did not exist, and
/// the normals of the two old and the two new triangles differ from that of the quad by less than
/// 20 degrees.
void RuinByFlips(OwnedMesh<double>& mesh, double share, std::uint32_t seed)
{
  const double limit = std::cos(20.0 * Pi / 180.0);
  std::mt19937 random(seed);
  CornerMesh corners(mesh.View().Triangles);
  EdgeSet edges;
  for (std::int32_t corner = 0; corner < corners.CountCorners(); ++corner)
  {
    edges.insert(corners.GetEnds(corner));
  }
  const auto at = [&](std::int32_t corner)
  { return LoadPoint(mesh.View().Points, corners.Vertices[corner]); };
  const auto keepsShape = [&](std::int32_t corner, std::int32_t twin)
  {
    const Vector3 a = at(corner), b = at(twin);
    const Vector3 p = at(CornerMesh::Next(corner)), q = at(CornerMesh::Previous(corner));
    const Vector3 quad = Cross(q - p, a - b); // twice the quad's vector area
    const auto isNear = [&](const Vector3& normal)
    { return Dot(normal, quad) / (Length(normal) * Length(quad)) > limit; };
    return isNear(Cross(p - a, q - a)) && isNear(Cross(q - b, p - b)) &&
      isNear(Cross(p - a, b - a)) && isNear(Cross(q - b, a - b));
  };
  const double attempts = share * static_cast<double>(mesh.NumberOfTriangles());
  for (std::int64_t i = static_cast<std::int64_t>(attempts); i > 0; --i)
  {
    const auto corner = static_cast<std::int32_t>(DrawUnit(random) * corners.CountCorners());
    const std::int32_t twin = corners.Twins[corner];
    if (twin < 0 || !keepsShape(corner, twin))
    {
      continue;
    }
    if (edges.insert(CornerMesh::MakeEnds(corners.Vertices[corner], corners.Vertices[twin])).second)
    {
      edges.erase(corners.GetEnds(corner));
      corners.Flip(corner);
    }
  }
  mesh.Triangles = corners.Vertices;
}

/// Splits about `share` of all edges of two triangles close to one end, at 2 % of their length. Two
/// of the four new triangles are then needles. The shape of the surface does not change.
void RuinBySplits(OwnedMesh<double>& mesh, double share, std::uint32_t seed)
{
  constexpr double Place = 0.02;
  std::mt19937 random(seed);
  const CornerMesh corners(mesh.View().Triangles);
  std::vector<char> isSplit(mesh.NumberOfTriangles(), 0);
  for (std::int32_t a = 0; a < corners.CountCorners(); ++a)
  {
    const std::int32_t b = corners.Twins[a];
    if (!corners.IsInterior(a) || DrawUnit(random) >= share || isSplit[a / 3] || isSplit[b / 3])
    {
      continue;
    }
    isSplit[a / 3] = isSplit[b / 3] = 1;
    const std::int32_t p = corners.Vertices[CornerMesh::Next(a)];
    const std::int32_t q = corners.Vertices[CornerMesh::Previous(a)];
    const auto middle = static_cast<std::int32_t>(mesh.NumberOfPoints());
    for (int axis = 0; axis < 3; ++axis)
    {
      const double from = mesh.Points[3 * p + axis];
      mesh.Points.push_back(from + Place * (mesh.Points[3 * q + axis] - from));
    }
    // (a, p, q) and (b, q, p) keep the part at q.
    mesh.Triangles[CornerMesh::Next(a)] = middle;
    mesh.Triangles[CornerMesh::Previous(b)] = middle;
    mesh.Triangles.insert(
      mesh.Triangles.end(), { corners.Vertices[a], p, middle, corners.Vertices[b], middle, p });
  }
}

using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>;

/// A surface that is asked for its distances.
struct Surface
{
  Surface(const std::vector<double>& points, const std::vector<std::int32_t>& ids)
    : Points(points)
  {
    for (std::size_t t = 0; t < ids.size(); t += 3)
    {
      const Kernel::Triangle_3 face(this->At(ids[t]), this->At(ids[t + 1]), this->At(ids[t + 2]));
      this->Volume += CGAL::volume(CGAL::Point_3<Kernel>(0, 0, 0), face[0], face[1], face[2]);
      for (std::size_t slot = 0; slot < 3; ++slot)
      {
        this->Edges.insert(CornerMesh::MakeEnds(ids[t + slot], ids[t + (slot + 1) % 3]));
      }
      if (!face.is_degenerate())
      {
        this->Nonempty.push_back(face);
      }
    }
    this->Tree.insert(this->Nonempty.begin(), this->Nonempty.end());
  }

  /// The largest squared distance of the middle of an edge that the other surface lacks.
  double FindSquaredDistance(const Surface& other) const
  {
    double largest = 0.0;
    for (const std::uint64_t edge : this->Edges)
    {
      if (other.Edges.count(edge) == 0)
      {
        const auto p = this->At(edge >> 32);
        const auto q = this->At(edge & 0xffffffffu);
        // Both surfaces contain p, so the nearest point is at most that far away.
        largest = std::max(largest, other.Tree.squared_distance(CGAL::midpoint(p, q), p));
      }
    }
    return largest;
  }

  double FindDiagonal() const
  {
    const auto box = this->Tree.bbox();
    return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  }

  Kernel::Point_3 At(std::size_t i) const
  {
    return { this->Points[3 * i], this->Points[3 * i + 1], this->Points[3 * i + 2] };
  }

  const std::vector<double>& Points;
  EdgeSet Edges;
  double Volume = 0.0;
  Faces Nonempty; ///< Those with area.
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> Tree;
};

/// Adds to a row how flips have changed a closed surface, and why bad edges are left.
///
/// "distance" is the largest one from the middle of an edge that only one of the surfaces has to
/// the other surface, relative to the bounding box's diagonal. "volume_change" is relative, too.
/// "left_fixed" counts bad edges of the result that are feature edges of the input, and
/// "left_other" those for which the report has no reason.
/// @param options with which `before` was flipped.
void DescribeChange(const OwnedMesh<double>& before, const std::vector<std::int32_t>& after,
  const FlipOptions& options, Json& row)
{
  const Surface old(before.Points, before.Triangles), current(before.Points, after);
  row["distance"] =
    std::sqrt(std::max(current.FindSquaredDistance(old), old.FindSquaredDistance(current))) /
    old.FindDiagonal();
  row["volume_change"] = (current.Volume - old.Volume) / old.Volume;
  FlipOptions free = options;
  free.FeatureAngle = 180.0;
  const auto left = row["bad_left"].get<std::int64_t>();
  row["left_fixed"] = CountNonDelaunayEdges(WithTriangles(before.View(), after), free) - left;
  row["left_other"] =
    left - row["left_duplicate"].get<std::int64_t>() - row["left_fold"].get<std::int64_t>();
}

std::vector<double> ListSmallestAngles(const TriangleMesh& mesh)
{
  std::vector<double> degrees(mesh.Triangles.Count);
  FindSmallestAngles(mesh, GeometryKind::Surface, 0, degrees.data());
  return degrees;
}

double FindMean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// One function for each experiment; all add to Rows an object for each program and mesh. The
/// other public members are settings. Times are lists of milliseconds, one for each run.
class Experiments
{
public:
  int Repetitions = 5; ///< Timed runs per program, after one to warm up. 0: no times.
  double Seconds = 20.0; ///< No repetition begins after this time.
  bool OnGpu = false; ///< Whether to use the GPU, too.
  std::string Mesh; ///< A file, or the name of a mesh.
  std::string Ruin; ///< How to ruin it: "flips", "splits", or not at all.
  std::int64_t Points = 100000;
  std::vector<std::int64_t> Triangles = { 6, 10, 100, 1000 };
  std::vector<double> Epsilons = { 1e-7, 1e-6, 1e-5, 1e-4, 1e-3 };
  std::string Program = "ours"; ///< "ours", "no-chunks", "paper", "lawson" or "cgal".
  Json Rows;

  /// Fig. 6: the worst case.
  void RunChain()
  {
    for (const std::int64_t triangles : this->Triangles)
    {
      const auto mesh =
        ConvertMesh<float>(MakeWorstCaseMesh(static_cast<std::int32_t>(triangles / 2 + 1)));
      for (const bool onGpu : this->ListPlaces())
      {
        this->Rows.push_back(this->FlipOurs(
          mesh.View(), MakeOptions(GeometryKind::Auto, onGpu, 1), onGpu ? "ours-gpu" : "ours-1"));
      }
      PaperOptions options = MakePaperOptions(this->OnGpu);
      options.InDouble = true;
      options.Epsilon = 1e-9;
      options.MaximumIterations = 2 * triangles;
      this->Rows.push_back(this->FlipAsPaper(mesh.View(), options, "paper"));
      this->Rows.push_back(this->FlipAsLawson(mesh.View()));
    }
  }

  /// Figs. 8a and 9: a random bad mesh by one program.
  void RunRandom()
  {
    const OwnedMesh<float> mesh = MakePlaneMesh(this->Points);
    const std::string& name = this->Program;
    const int threads = name.find("-1") != std::string::npos ? 1 : 0;
    if (name.find("paper") == 0)
    {
      Json row = this->FlipAsPaper(mesh.View(), MakePaperOptions(this->OnGpu, threads), name);
      row["bad_left"] = CountExactViolations(WithTriangles(mesh.View(), this->Result));
      this->Rows.push_back(row);
    }
    else if (name == "lawson")
    {
      this->Rows.push_back(this->FlipAsLawson(mesh.View()));
    }
    else if (name == "cgal")
    {
      Json row = MakeRow(name, mesh.View());
      this->Time(row, [&] { return Json{ { "total_ms", 1e3 * TimeCgalDelaunay(mesh).Seconds } }; });
      this->Rows.push_back(row);
    }
    else
    {
      // Surfaces are flipped without chunks. So a plane that is treated as a surface is flipped in
      // iterations over the whole mesh from the first one on.
      const bool hasChunks = name != "no-chunks";
      FlipOptions options =
        MakeOptions(hasChunks ? GeometryKind::Auto : GeometryKind::Surface, this->OnGpu, threads);
      options.FeatureAngle = hasChunks ? options.FeatureAngle : 180.0;
      this->Rows.push_back(this->FlipOurs(mesh.View(), options, name));
    }
  }

  /// Fig. 8b: triangles that differ from CGAL's.
  void RunQuality()
  {
    this->Repetitions = 0;
    const OwnedMesh<float> mesh = MakePlaneMesh(this->Points);
    const Ids expected = MakeCgalTriangles(mesh);
    FlipOptions options = MakeOptions(GeometryKind::Auto, this->OnGpu);
    this->Compare(this->FlipOurs(mesh.View(), options, "ours"), mesh.View(), expected);
    options.TieRule = TieRuleKind::Canonical;
    this->Compare(this->FlipOurs(mesh.View(), options, "ours, canonical"), mesh.View(), expected);
    for (const bool inDouble : { false, true })
    {
      for (const double epsilon : this->Epsilons)
      {
        PaperOptions paper = MakePaperOptions(this->OnGpu);
        paper.InDouble = inDouble;
        paper.Epsilon = epsilon;
        this->Compare(this->FlipAsPaper(mesh.View(), paper, "paper"), mesh.View(), expected);
      }
    }
  }

  /// Compares with a file of 32-bit ids, which another program wrote.
  void RunComparison()
  {
    const OwnedMesh<float> mesh = MakePlaneMesh(this->Points);
    std::ifstream file(this->Mesh, std::ios::binary | std::ios::ate);
    this->Result.resize(file ? static_cast<std::size_t>(file.tellg()) / 4 : 0);
    file.seekg(0);
    if (!file.read(reinterpret_cast<char*>(this->Result.data()),
          static_cast<std::streamsize>(4 * this->Result.size())))
    {
      throw std::runtime_error("cannot read " + this->Mesh);
    }
    this->Compare(Json::object(), mesh.View(), MakeCgalTriangles(mesh));
  }

  /// Fig. 11 and Table 2: a surface, with the normal threshold and without.
  void RunSurface()
  {
    const FileMesh file = ReadMeshFile(this->Mesh);
    const TriangleMesh mesh = file.View();
    for (const double degrees : { 30.0, 180.0 })
    {
      const auto add = [&](Json row)
      {
        row["mesh"] = file.Name;
        row["threshold"] = degrees;
        const TriangleMesh after = WithTriangles(mesh, this->Result);
        FlipOptions judge = MakeOptions(GeometryKind::Surface, false);
        judge.FeatureAngle = 180.0;
        judge.Tolerance = 2.0 * LawsonEpsilon;
        row["duplicate_edges"] = CountDuplicateEdgesGained(mesh.Triangles, after.Triangles);
        row["bad_by_angle"] = CountNonDelaunayEdges(after, judge);
        this->Rows.push_back(row);
      };
      for (const bool onGpu : this->ListPlaces())
      {
        const std::string place = onGpu ? "-gpu" : "-all";
        FlipOptions ours = MakeOptions(GeometryKind::Surface, onGpu);
        ours.FeatureAngle = degrees;
        add(this->FlipOurs(mesh, ours, "ours" + place));
        PaperOptions papers = MakePaperOptions(onGpu);
        papers.Dimension = 3;
        papers.NormalThreshold = degrees;
        add(this->FlipAsPaper(mesh, papers, "paper" + place));
      }
      add(this->FlipSurfaceAsLawson(mesh, std::cos(degrees * Pi / 180.0)));
    }
  }

  /// Future work 1: the in-circle test against that of opposite angles. The exact results for a row
  /// are computed from the points as rounded to its precision.
  void RunTests()
  {
    OwnedMesh<double> mesh;
    if (this->Mesh == "random" || this->Mesh == "offset")
    {
      mesh = ConvertMesh<double>(MakePlaneMesh(this->Points));
    }
    else
    {
      mesh = this->ReadMesh();
      RuinByFlips(mesh, 3.0, 6);
    }
    for (std::size_t i = 0; this->Mesh == "offset" && i < mesh.Points.size(); i += 3)
    {
      mesh.Points[i] = 1000.0 * mesh.Points[i] + 500000.0;
      mesh.Points[i + 1] = 1000.0 * mesh.Points[i + 1] + 4500000.0;
    }
    this->RunTestsIn(ConvertMesh<float>(mesh));
    this->RunTestsIn(mesh);
  }

  /// Future work 2: a surface of bad quality, or one that is improved by flips and then ruined.
  void RunRuined()
  {
    constexpr std::uint32_t Seed = 12;
    OwnedMesh<double> mesh = this->ReadMesh();
    Json about = { { "ruined_by", this->Ruin.empty() ? "nothing" : this->Ruin },
      { "shape", this->Mesh } };
    if (this->Ruin == "flips" || this->Ruin == "splits")
    {
      FlipToDelaunay(mesh.View(), MakeOptions(GeometryKind::Surface, false),
        { mesh.Triangles.data(), mesh.NumberOfTriangles() });
      about["mean_smallest_angle_of_good"] = FindMean(ListSmallestAngles(mesh.View()));
      this->Ruin == "flips" ? RuinByFlips(mesh, 6.0, Seed) : RuinBySplits(mesh, 0.1, Seed);
    }
    const std::vector<double> before = ListSmallestAngles(mesh.View());
    for (const double featureAngle : { 20.0, 30.0, 60.0, 180.0 })
    {
      FlipOptions options = MakeOptions(GeometryKind::Surface, this->OnGpu);
      options.FeatureAngle = featureAngle;
      Json row = this->FlipOurs(mesh.View(), options, "ours");
      const std::vector<double> after =
        ListSmallestAngles(WithTriangles(mesh.View(), this->Result));
      row.update(about);
      row["feature_angle"] = featureAngle;
      row["smallest_angle_before"] = *std::min_element(before.begin(), before.end());
      row["smallest_angle"] = *std::min_element(after.begin(), after.end());
      row["mean_smallest_angle_before"] = FindMean(before);
      row["mean_smallest_angle"] = FindMean(after);
      DescribeChange(mesh, this->Result, options, row);
      this->AddShort(row);
    }
  }

  /// Writes x and y of a random bad mesh's points in single precision, for other programs.
  void WritePoints()
  {
    const OwnedMesh<float> mesh = MakePlaneMesh(this->Points);
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      std::cout.write(reinterpret_cast<const char*>(&mesh.Points[i]), 2 * sizeof(float));
    }
  }

  /// Writes the machine and all rows.
  void WriteRows()
  {
    const Json json = { { "machine", DescribeMachine() }, { "gpu", HasCudaDevice() },
      { "rows", this->Rows } };
    std::cout << json.dump(1) << "\n";
  }

private:
  /// Reads a file, and shortens Mesh to its name.
  OwnedMesh<double> ReadMesh()
  {
    const FileMesh file = ReadMeshFile(this->Mesh);
    this->Mesh = file.Name;
    OwnedMesh<double> mesh{ file.Doubles, file.Triangles };
    mesh.Points.insert(mesh.Points.end(), file.Floats.begin(), file.Floats.end());
    return mesh;
  }

  /// Adds a row without its lists.
  void AddShort(Json row)
  {
    row.erase("flipped");
    row.erase("excluded");
    this->Rows.push_back(row);
  }

  /// Whether on the GPU, for each place where programs run.
  std::vector<bool> ListPlaces() const
  {
    return this->OnGpu ? std::vector<bool>{ false, true } : std::vector<bool>{ false };
  }

  static Json MakeRow(const std::string& program, const TriangleMesh& mesh)
  {
    return { { "program", program }, { "points", mesh.Points.Count },
      { "triangles", mesh.Triangles.Count } };
  }

  /// Calls run(), which returns an object of milliseconds, several times, and adds the times to a
  /// row. The first call warms up and does not count, unless it took more than half of the time.
  template <typename Run>
  void Time(Json& row, const Run& run) const
  {
    const Clock::time_point start = Clock::now();
    std::vector<Json> runs{ run() };
    if (this->Repetitions == 0)
    {
      return;
    }
    if (MillisecondsSince(start) < 500.0 * this->Seconds)
    {
      runs.clear();
      do
      {
        runs.push_back(run());
      } while (static_cast<int>(runs.size()) < this->Repetitions &&
        MillisecondsSince(start) <= 1e3 * this->Seconds);
    }
    for (const Json& times : runs)
    {
      for (const auto& [name, time] : times.items())
      {
        row[name].push_back(time);
      }
    }
  }

  /// Flips a mesh by this project into Result.
  Json FlipOurs(const TriangleMesh& mesh, const FlipOptions& options, const std::string& program)
  {
    Json row = MakeRow(program, mesh);
    this->Result.resize(3 * mesh.Triangles.Count);
    this->Time(row,
      [&]
      {
        const Clock::time_point start = Clock::now();
        FlipSession session(mesh, options);
        const double build = MillisecondsSince(start);
        session.Advance();
        const double flipped = MillisecondsSince(start);
        session.StoreTriangles({ this->Result.data(), mesh.Triangles.Count });
        const double total = MillisecondsSince(start);
        const FlipReport& report = session.GetReport();
        row["backend"] = report.Backend;
        row["iterations"] = report.Iterations.size();
        row["flips"] = report.TotalFlips;
        row["bad_left"] = report.NonDelaunayAfter;
        row["left_duplicate"] = report.BlockedByEdge;
        row["left_fold"] = report.BlockedByShape;
        row["stop"] = ToString(report.StopReason);
        row["flipped"] = row["excluded"] = Json::array();
        for (const IterationRecord& iteration : report.Iterations)
        {
          row["flipped"].push_back(iteration.Flipped);
          row["excluded"].push_back(iteration.Excluded);
        }
        return Json{ { "flips_ms", flipped - build }, { "total_ms", total } };
      });
    return row;
  }

  /// Flips by the paper's method. Flips are counted in a separate run.
  Json FlipAsPaper(
    const TriangleMesh& mesh, const PaperOptions& options, const std::string& program)
  {
    const PaperLoop run = MakePaperLoop(mesh, options);
    PaperOptions counting = options;
    counting.CountsIterations = true;
    const PaperResult result = run(counting);
    this->Result = result.Triangles;
    Json row = MakeRow(program, mesh);
    row["precision"] = options.InDouble ? "double" : "float";
    row["epsilon"] = options.Epsilon;
    row["backend"] = result.Backend;
    row["iterations"] = result.Iterations;
    std::int64_t flips = 0;
    row["stop"] = result.Converged ? "converged" : "iteration limit";
    row["flipped"] = row["excluded"] = Json::array();
    for (const PaperIteration& iteration : result.Counts)
    {
      row["flipped"].push_back(iteration.Flipped);
      row["excluded"].push_back(iteration.Bad - iteration.Flipped);
      flips += iteration.Flipped;
    }
    row["flips"] = flips;
    if (this->Repetitions > 0)
    {
      this->Time(row, [&] { return Json{ { "flips_ms", 1e3 * run(options).FlipSeconds } }; });
    }
    return row;
  }

  /// Sequential Lawson in the plane, exactly.
  Json FlipAsLawson(const TriangleMesh& mesh) const
  {
    Json row = MakeRow("lawson", mesh);
    this->Time(row,
      [&]
      {
        const Clock::time_point start = Clock::now();
        SequentialLawson lawson(mesh);
        const double build = MillisecondsSince(start);
        row["flips"] = lawson.Run();
        const double total = MillisecondsSince(start);
        return Json{ { "flips_ms", total - build }, { "total_ms", total } };
      });
    return row;
  }

  /// Sequential Lawson in space, by the paper's test and threshold in double precision. No theorem
  /// is known, to the paper or to us, by which this must end.
  Json FlipSurfaceAsLawson(const TriangleMesh& mesh, double normalCosine)
  {
    std::vector<PaperPoint<double, 3>> points;
    for (std::int64_t i = 0; i < mesh.Points.Count; ++i)
    {
      points.push_back({ mesh.Points.Get(i, 0), mesh.Points.Get(i, 1), mesh.Points.Get(i, 2), 0 });
    }
    const OppositeAngleTest<double> test{ Pi + LawsonEpsilon };
    Json row = MakeRow("lawson", mesh);
    this->Time(row,
      [&]
      {
        CornerMesh corners(mesh.Triangles);
        const auto at = [&](std::int32_t corner) { return points[corners.Vertices[corner]]; };
        const auto isBad = [&](std::int32_t p, std::int32_t q, std::int32_t a, std::int32_t b)
        {
          return test.IsBad(at(p), at(q), at(a), at(b)) &&
            AreAlmostParallel(at(p), at(q), at(a), at(b), normalCosine);
        };
        const Clock::time_point start = Clock::now();
        row["flips"] = RunLawson(corners, isBad, 150 * mesh.Triangles.Count);
        const double flips = MillisecondsSince(start);
        this->Result = corners.Vertices;
        return Json{ { "flips_ms", flips } };
      });
    return row;
  }

  /// Adds a row with how many triangles of Result differ from the expected ones.
  void Compare(Json row, const TriangleMesh& mesh, const Ids& expected)
  {
    const std::int64_t different = CountDifferentTriangles(this->Result, expected);
    row["triangles"] = this->Result.size() / 3;
    row["different"] = different;
    row["percent"] = 300.0 * static_cast<double>(different) / static_cast<double>(expected.size());
    row["bad_left"] = CountExactViolations(WithTriangles(mesh, this->Result));
    this->AddShort(row);
  }

  template <typename Real>
  void RunTestsIn(const OwnedMesh<Real>& mesh)
  {
    const TriangleMesh view = mesh.View();
    OwnedMesh<Real> exact = mesh;
    FlipToDelaunay(view, MakeOptions(GeometryKind::PlanarXY, false),
      { exact.Triangles.data(), exact.NumberOfTriangles() });
    const auto add = [&](Json row)
    {
      row["mesh"] = this->Mesh;
      row["precision"] = sizeof(Real) == 8 ? "double" : "float";
      const TriangleMesh after = WithTriangles(view, this->Result);
      row["bad_left"] = CountExactViolations(after);
      row["turned_over"] = CountTurnedOver(after);
      row["turned_over_before"] = CountTurnedOver(view);
      this->AddShort(row);
    };
    // Shewchuk's bound on the rounding error: a larger determinant has the right sign.
    const double unit = 0.5 * std::numeric_limits<Real>::epsilon();
    const double bound = (10.0 + 96.0 * unit) * unit;
    const double epsilon = sizeof(Real) == 4 ? PaperOptions().Epsilon : 1e-7;
    for (const bool onGpu : this->ListPlaces())
    {
      PaperOptions options = MakePaperOptions(onGpu);
      options.InDouble = sizeof(Real) == 8;
      for (const bool inCircle : { false, true })
      {
        options.Test = inCircle ? PaperTestKind::InCircle : PaperTestKind::OppositeAngles;
        const std::string name = inCircle ? "in-circle" : "angles";
        for (const bool isTolerant : { false, true })
        {
          options.Epsilon = !isTolerant ? 0.0 : inCircle ? bound : epsilon;
          const char* suffix = !isTolerant ? "" : inCircle ? ", error bound" : ", epsilon";
          Json row = this->FlipAsPaper(view, options, name + suffix);
          CountWrongDecisions(mesh, options, row);
          CountWrongDecisions(exact, options, row);
          add(row);
        }
      }
      FlipOptions ours = MakeOptions(GeometryKind::PlanarXY, onGpu);
      add(this->FlipOurs(view, ours, "ours, in-circle"));
      ours.Criterion = CriterionKind::OppositeAngles;
      add(this->FlipOurs(view, ours, "ours, angles"));
    }
  }

  /// Adds to a row how many edges of a mesh a test judges, and how many of its decisions exact
  /// arithmetic contradicts.
  template <typename Real>
  static void CountWrongDecisions(
    const OwnedMesh<Real>& mesh, const PaperOptions& options, Json& row)
  {
    const OppositeAngleTest<Real> angles{ static_cast<Real>(Pi + options.Epsilon) };
    const InCircleTest<Real> inCircle{ static_cast<Real>(options.Epsilon) };
    std::int64_t edges = 0, falseBad = 0, missedBad = 0;
    const CornerMesh corners(mesh.View().Triangles);
    for (std::int32_t corner = 0; corner < corners.CountCorners(); ++corner)
    {
      if (!corners.IsInterior(corner))
      {
        continue;
      }
      const std::int32_t ends[4] = { CornerMesh::Next(corner), CornerMesh::Previous(corner), corner,
        corners.Twins[corner] };
      PaperPoint<Real, 2> quad[4]; // p, q, a, b
      double exact[4][2];
      for (int i = 0; i < 4; ++i)
      {
        const Real* point = &mesh.Points[3 * std::size_t(corners.Vertices[ends[i]])];
        quad[i] = { point[0], point[1] };
        std::copy(point, point + 2, exact[i]);
      }
      const bool isBad = InCircle(exact[0], exact[1], exact[2], exact[3]) > 0;
      const bool saysBad = options.Test == PaperTestKind::InCircle
        ? inCircle.IsBad(quad[0], quad[1], quad[2], quad[3])
        : angles.IsBad(quad[0], quad[1], quad[2], quad[3]);
      ++edges;
      falseBad += saysBad && !isBad;
      missedBad += isBad && !saysBad;
    }
    row["decisions"] = row.value("decisions", std::int64_t(0)) + edges;
    row["false_bad"] = row.value("false_bad", std::int64_t(0)) + falseBad;
    row["missed_bad"] = row.value("missed_bad", std::int64_t(0)) + missedBad;
  }

  Ids Result; ///< The triangles that the last program has left.
};

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(
  Experiments, Repetitions, Seconds, OnGpu, Mesh, Ruin, Points, Triangles, Epsilons, Program)

}
}

int main(int argc, char** argv)
{
  using delaunayflip::Experiments;
  const std::map<std::string, void (Experiments::*)()> all = {
    { "machine", &Experiments::WriteRows },
    { "chain", &Experiments::RunChain },
    { "random", &Experiments::RunRandom },
    { "quality", &Experiments::RunQuality },
    { "compare", &Experiments::RunComparison },
    { "surface", &Experiments::RunSurface },
    { "tests", &Experiments::RunTests },
    { "ruined", &Experiments::RunRuined },
    { "points", &Experiments::WritePoints },
  };
  try
  {
    const auto experiment = all.find(argc > 1 ? argv[1] : "");
    if (experiment == all.end())
    {
      throw std::invalid_argument("no such experiment; see PaperExperiments.cpp");
    }
    Experiments experiments =
      argc > 2 ? nlohmann::json::parse(argv[2]).get<Experiments>() : Experiments();
    (experiments.*experiment->second)();
    if (!experiments.Rows.empty())
    {
      experiments.WriteRows();
    }
    return std::cout.flush() ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << "delaunay-flip-paper: " << error.what() << "\n";
    return 1;
  }
}
