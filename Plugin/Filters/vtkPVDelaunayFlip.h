// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVDelaunayFlip
 * @brief   vtkDelaunayFlip for everything that is a surface in ParaView
 *
 * Beside vtkPolyData it takes unstructured grids of surface cells (vertices, lines, triangles,
 * quads, pixels, polygons, strips) and structured, rectilinear and image data of two dimensions,
 * e.g. height fields. Points keep their ids, and cells their data; the output is a vtkPolyData.
 * Image and rectilinear data are planar: terrain becomes a surface by Warp By Scalar first.
 *
 * A dataset with other cells is an error. As a block of a composite dataset it passes unchanged,
 * with one warning per update.
 */
#ifndef vtkPVDelaunayFlip_h
#define vtkPVDelaunayFlip_h

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipParaViewFiltersModule.h" // For export macro
#include "vtkSmartPointer.h" // For the surface of the last update

class vtkDataSet;
class vtkPolyData;

class VTKDELAUNAYFLIPPARAVIEWFILTERS_EXPORT vtkPVDelaunayFlip : public vtkDelaunayFlip
{
public:
  static vtkPVDelaunayFlip* New();
  vtkTypeMacro(vtkPVDelaunayFlip, vtkDelaunayFlip);

protected:
  vtkPVDelaunayFlip();
  ~vtkPVDelaunayFlip() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkSmartPointer<vtkPolyData> GetMesh(vtkDataObject* input) override;

private:
  // The surface of the last input: a live run goes on only with the same arrays.
  vtkSmartPointer<vtkDataSet> Source;
  vtkMTimeType SourceTime = 0;
  vtkSmartPointer<vtkPolyData> Surface;

  vtkPVDelaunayFlip(const vtkPVDelaunayFlip&) = delete;
  void operator=(const vtkPVDelaunayFlip&) = delete;
};

#endif
