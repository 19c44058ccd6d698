// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"
#include "MeshFile.h"

#include <cstdlib>

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

/// Testing/Command/RealData.py has the known answers, with the second tolerance.
TEST_F(RealDataTest, TheGpuGivesTheCpusBits)
{
  for (const std::string& path : ListMeshFiles(GetFolder()))
  {
    SCOPED_TRACE(path);
    const FileMesh mesh = ReadMeshFile(path);
    TriangleMesh free = mesh.View();
    free.NumberOfConstraintEdges = 0;
    for (const double tolerance : { -1.0, 1e-9 })
    {
      ExpectGpuAgrees(mesh.View(), With(&FlipOptions::Tolerance, tolerance));
      ExpectGpuAgrees(mesh.View(), With(&FlipOptions::Tolerance, tolerance, OnSurface()));
    }
    if (mesh.IsHeightField)
    {
      ExpectGpuAgrees(mesh.View(), InPlane());
      ExpectGpuAgrees(free, InPlane());
    }
  }
}

}
}
