// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"
#include "MeshFile.h"

#include <cmath>
#include <cstdlib>
#include <iostream>

/// @file
/// Real meshes, which are not part of this project. export_meshes.py writes them to the folder
/// DELAUNAYFLIP_MESH_DIR; without it these tests are skipped.

namespace delaunayflip
{
namespace
{

std::string GetFolder()
{
  const char* folder = std::getenv("DELAUNAYFLIP_MESH_DIR");
  return folder ? folder : "";
}

/// The path of a mesh; empty if it is not in the folder.
std::string FindMesh(const std::string& name)
{
  const std::string end = "/" + name + ".dfmesh";
  for (const std::string& path : ListMeshFiles(GetFolder()))
  {
    if (path.size() > end.size() && path.substr(path.size() - end.size()) == end)
    {
      return path;
    }
  }
  return "";
}

class RealDataTest : public GpuTest
{
protected:
  void SetUp() override
  {
    GpuTest::SetUp();
    if (!IsSkipped() && ListMeshFiles(GetFolder()).empty())
    {
      GTEST_SKIP() << "no meshes: DELAUNAYFLIP_MESH_DIR is '" << GetFolder() << "'";
    }
  }
};

TEST_F(RealDataTest, TheGpuGivesTheCpusBits)
{
  for (const std::string& path : ListMeshFiles(GetFolder()))
  {
    SCOPED_TRACE(path);
    const FileMesh mesh = ReadMeshFile(path);
    ExpectGpuAgrees(mesh.View(), FlipOptions());
    ExpectGpuAgrees(mesh.View(), MakeOptions(BackendKind::CUDA, GeometryKind::Surface));
    if (mesh.IsHeightField)
    {
      ExpectGpuAgrees(mesh.View(), MakeOptions(BackendKind::CUDA, GeometryKind::PlanarXY));
    }
  }
}

/// What is known about a mesh from other programs. If the number of flips depends on their order,
/// it is known only approximately.
struct KnownAnswer
{
  const char* Mesh;
  GeometryKind Geometry;
  std::int64_t Bad;
  std::int64_t Flips;
  std::int64_t MostLeft;
  double Share;
};

constexpr GeometryKind XY = GeometryKind::PlanarXY;
constexpr GeometryKind Auto = GeometryKind::Auto;
constexpr GeometryKind Space = GeometryKind::Surface;

constexpr KnownAnswer KnownAnswers[] = {
  { "greenland_cdt", XY, 0, 0, 0, 0.0 },
  { "lake_superior_cdt_constrained", XY, 0, 0, 0, 0.0 },
  { "su2_cht_3cyl_mixed", XY, 12047, 12047, 0, 0.0 },
  { "adcirc_alaska", XY, 5196, 5575, 0, 0.05 },
  { "tin_bigtujunga_bad_60k", XY, 34770, 335500, 0, 0.05 },
  { "turbine_siting_terrain_utm", XY, 0, 0, 0, 0.0 },
  { "adcirc_alaska", Auto, 5196, 5588, 0, 0.0 },
  { "turbine_siting_terrain_utm", Auto, 0, 0, 0, 0.0 },
  { "turbine_siting_terrain_utm", Space, 5176, 5176, 0, 0.0 },
  { "dragon_vrip_res2", Auto, 41911, 48600, 250, 0.05 },
  { "horse_cyberware", Auto, 3188, 3596, 6, 0.05 },
  { "bunny_zipper", Auto, 2116, 2189, 0, 0.05 },
  { "lucy_100k", Auto, 19741, 25600, 5, 0.05 },
  { "turbineblade", Auto, 23377, 27268, 0, 0.05 },
  { "dtc_ship_hull", Auto, 1176, 1176, 0, 0.0 },
  { "pv_42400-IDGH", Auto, 1845, 3100, 16, 0.05 },
  { "tm_featuretype", Auto, 386, 1450, 0, 0.05 },
  { "mf_openscad", Auto, 315, 1330, 50, 0.15 },
  { "cm_fandisk", Auto, 551, 551, 0, 0.0 },
  { "gc_moebius", Auto, 17, 17, 0, 0.0 },
  { "gc_lego", Auto, 97, 97, 0, 0.0 },
  { "gc_triple_vierbein", Auto, 0, 0, 0, 0.0 },
};

void ExpectAbout(std::int64_t expected, std::int64_t actual, double share)
{
  EXPECT_LE(std::abs(static_cast<double>(actual - expected)), share * static_cast<double>(expected))
    << actual << " instead of " << expected;
}

TEST_F(RealDataTest, KnownAnswersHold)
{
  for (const KnownAnswer& known : KnownAnswers)
  {
    SCOPED_TRACE(known.Mesh);
    const std::string path = FindMesh(known.Mesh);
    if (path.empty())
    {
      std::cout << "no " << known.Mesh << " in " << GetFolder() << "\n";
      continue;
    }
    const FileMesh mesh = ReadMeshFile(path);
    FlipOptions options = MakeOptions(BackendKind::CUDA, known.Geometry);
    options.Tolerance = 1e-9; // takes coordinates as exact
    const FlipReport report = Flip(mesh.View(), options).Report;
    EXPECT_TRUE(report.Converged());
    ExpectAbout(known.Bad, report.NonDelaunayBefore, known.Share);
    ExpectAbout(known.Flips, report.TotalFlips, known.Share);
    EXPECT_LE(report.NonDelaunayAfter, known.MostLeft);
  }
}

/// Constraint edges keep a constrained Delaunay mesh; without them it takes 32 flips.
TEST_F(RealDataTest, ConstraintsHold)
{
  const std::string path = FindMesh("lake_superior_cdt_constrained");
  if (path.empty())
  {
    GTEST_SKIP() << "no Lake Superior in " << GetFolder();
  }
  const FileMesh mesh = ReadMeshFile(path);
  TriangleMesh free = mesh.View();
  free.NumberOfConstraintEdges = 0;
  const FlipReport report =
    ExpectGpuAgrees(free, MakeOptions(BackendKind::CUDA, GeometryKind::PlanarXY)).Report;
  EXPECT_EQ(29, report.NonDelaunayBefore);
  EXPECT_EQ(32, report.TotalFlips);
  ASSERT_EQ(2u, report.Iterations.size());
  EXPECT_EQ(29, report.Iterations[0].Flipped);
  EXPECT_EQ(3, report.Iterations[1].Flipped);
}

}
}
