// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVDelaunayFlip
 * @brief   vtkPDelaunayFlip for all types of surfaces in ParaView
 *
 * Besides vtkPolyData it accepts unstructured grids of surface cells (vertices, lines, triangles,
 * quads, pixels, polygons, strips) and two-dimensional structured, rectilinear and image data, e.g.
 * height fields. Points keep their ids, and cells their data; the output is a vtkPolyData. Image
 * and rectilinear data are planar: use Warp By Scalar first to turn them into terrain.
 *
 * A dataset with other cells is an error. As a block of a composite dataset it passes unchanged,
 * with one warning per update.
 *
 * In a parallel server all processes flip their pieces as one mesh; with one process, also without
 * MPI, this is vtkDelaunayFlip.
 */
#ifndef vtkPVDelaunayFlip_h
#define vtkPVDelaunayFlip_h

#include "vtkDelaunayFlipParaViewFiltersModule.h" // For export macro
#include "vtkPDelaunayFlip.h"
#include "vtkSmartPointer.h" // For the surface of the last update

class vtkDataSet;
class vtkPolyData;

class VTKDELAUNAYFLIPPARAVIEWFILTERS_EXPORT vtkPVDelaunayFlip : public vtkPDelaunayFlip
{
public:
  static vtkPVDelaunayFlip* New();
  vtkTypeMacro(vtkPVDelaunayFlip, vtkPDelaunayFlip);

protected:
  vtkPVDelaunayFlip();
  ~vtkPVDelaunayFlip() override = default;

  vtkSmartPointer<vtkPolyData> GetMesh(vtkDataObject* input) override;

private:
  // The last input and its surface: a live run continues only with the same arrays.
  vtkSmartPointer<vtkDataSet> Source;
  vtkMTimeType SourceTime = 0;
  vtkSmartPointer<vtkPolyData> Surface;
};

#endif
