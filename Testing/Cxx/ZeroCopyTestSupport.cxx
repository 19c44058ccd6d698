// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ZeroCopyTestSupport.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

const std::string WithoutCopies = "drawn without copies";

Bytes RunView::GetPicture()
{
  vtkNew<vtkUnsignedCharArray> pixels;
  const int* size = this->Window->GetSize();
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  return Bytes(pixels->GetPointer(0), pixels->GetPointer(pixels->GetNumberOfValues()));
}

vtkActor* RunView::GetActor()
{
  vtkActorCollection* actors = this->View->GetRenderer()->GetActors();
  actors->InitTraversal();
  return actors->GetNextActor();
}

Cells RunView::GetTriangles()
{
  vtkNew<vtkPolyData> mesh;
  EXPECT_TRUE(this->Filter->StoreMesh(mesh));
  return GetCells(mesh->GetPolys());
}

std::string RunView::Print()
{
  std::ostringstream text;
  this->View->Print(text);
  return text.str();
}

ViewPair::ViewPair(vtkPolyData* mesh)
  : Copying(mesh),
    Sharing(mesh)
{
  this->Copying->ZeroCopyOff();
}

void ViewPair::Step()
{
  this->Copying->Step();
  this->Sharing->Step();
}

double Compare(const Bytes& a, const Bytes& b)
{
  EXPECT_EQ(a.size(), b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i + 2 < std::min(a.size(), b.size()); i += 3)
  {
    bool isSame = true;
    for (std::size_t k = i; k < i + 3; ++k)
    {
      isSame = isSame && std::abs(int(a[k]) - int(b[k])) <= 8;
    }
    different += isSame ? 0 : 1;
  }
  return 3.0 * static_cast<double>(different) / static_cast<double>(a.size());
}

Cells FlipAtOnce(vtkPolyData* mesh)
{
  WatchedFilter filter(mesh);
  return GetCells(RunCleanly(filter)->GetPolys());
}
