// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyTexture.h"

#include <vtkCellArray.h>

namespace delaunayflip
{

void PlyTexture::Attach(FileMesh& mesh, const InputFile& file)
{
  if (this->Corners.Values.empty())
  {
    return;
  }
  this->Corners.Components = 2;
  std::int64_t begin = 0;
  for (std::size_t face = 0; face < this->Ends.size(); ++face)
  {
    const vtkIdType corners = mesh.Mesh->GetPolys()->GetCellSize(static_cast<vtkIdType>(face));
    const std::int64_t size = this->Ends[face] - begin;
    if (size != 0 && size != 2 * corners)
    {
      file.Fail("face " + std::to_string(face) + " has " + std::to_string(size) +
        " texture coordinates; its corners need " + std::to_string(2 * corners));
    }
    for (vtkIdType corner = 0; corner < corners; ++corner)
    {
      this->Corners.OfCorner.push_back(size == 0 ? CornerVectors::None : begin / 2 + corner);
    }
    begin = this->Ends[face];
  }
  AttachTexture(mesh, file.GetName(), this->Corners);
}

}
