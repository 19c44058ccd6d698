// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFile.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// The reader of the files that Testing/Gpu/export_meshes.py writes.

namespace delaunayflip
{
namespace
{

class MeshFileTest : public testing::Test
{
protected:
  template <typename Number>
  void Append(std::initializer_list<Number> numbers)
  {
    for (const Number number : numbers)
    {
      this->Bytes.append(reinterpret_cast<const char*>(&number), sizeof(Number));
    }
  }

  /// Two triangles with a constraint edge between them.
  void FillWithTwoTriangles()
  {
    this->Bytes = "DFMESH01";
    this->Append<std::int64_t>({ 4, 4, 2, 1, 1 });
    this->Append<float>({ 0, 0, 0, 1, 0, 0, 1, 1, 5, 0, 1, 0 });
    this->Append<std::int32_t>({ 0, 1, 2, 0, 2, 3 });
    this->Append<std::int64_t>({ 2, 0 });
  }

  FileMesh Read() const
  {
    std::ofstream(this->Path, std::ios::binary) << this->Bytes;
    return ReadMeshFile(this->Path);
  }

  const TemporaryFolder Folder;
  const std::string Path = this->Folder / "MeshFileTest.dfmesh";
  std::string Bytes;
};

TEST_F(MeshFileTest, GivesBackTheMesh)
{
  this->FillWithTwoTriangles();
  const FileMesh mesh = this->Read();
  EXPECT_EQ("MeshFileTest", mesh.Name);
  EXPECT_TRUE(mesh.IsHeightField);
  EXPECT_EQ(4, mesh.View().Points.Count);
  EXPECT_EQ(5.0, mesh.View().Points.Get(2, 2));
  EXPECT_EQ(2, mesh.View().Triangles.Count);
  EXPECT_EQ(3, mesh.View().Triangles.Get(1, 2));
  ASSERT_EQ(1, mesh.View().NumberOfConstraintEdges);
  EXPECT_EQ(2, mesh.View().ConstraintEdges[0]);
  EXPECT_EQ(ListMeshFiles(this->Folder.GetPath()), std::vector<std::string>{ this->Path });
}

TEST_F(MeshFileTest, RefusesWhatIsNotWhole)
{
  this->FillWithTwoTriangles();
  const std::string whole = this->Bytes;
  for (const std::size_t size : { std::size_t(0), std::size_t(20), whole.size() - 1 })
  {
    this->Bytes = whole.substr(0, size);
    EXPECT_THROW(this->Read(), std::runtime_error) << size;
  }
  this->Bytes = whole + "x";
  EXPECT_THROW(this->Read(), std::runtime_error);
  this->Bytes = whole;
  this->Bytes[0] = 'X';
  EXPECT_THROW(this->Read(), std::runtime_error);
  EXPECT_THROW(ReadMeshFile(this->Path + ".absent"), std::runtime_error);
  EXPECT_TRUE(ListMeshFiles(this->Path + ".absent").empty());
}

}
}
