// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipInterpolator
 * @brief   give a dataset the data of points, interpolated in their Delaunay triangulation
 *
 * vtkDelaunayFlipInterpolator takes the places of one dataset, such as the points of an image, and
 * finds the values that the points of another one, the source, have there: heights on a raster, or
 * along a line. The source is triangulated as by vtkDelaunayFlipPoints, with all properties of that
 * class; so segments, outlines and holes are possible. Places, too, are taken in x and y, or in the
 * projection of the source. On a sphere they are directions from the origin or, with Degrees,
 * longitudes and latitudes; Interpolation.h says what interpolation means there.
 *
 *     vtkNew<vtkPoints> points;
 *     points->InsertNextPoint(0, 0, 0);
 *     points->InsertNextPoint(2, 0, 10);
 *     points->InsertNextPoint(0, 2, 20);
 *     points->InsertNextPoint(2, 2, 30);
 *     vtkNew<vtkPolyData> source;
 *     source->SetPoints(points);
 *     vtkNew<vtkImageData> raster; // of 3 x 3 places
 *     raster->SetDimensions(3, 3, 1);
 *     vtkNew<vtkDelaunayFlipInterpolator> interpolator;
 *     interpolator->SetInputData(raster);
 *     interpolator->SetInputData(1, source);
 *     interpolator->Update();
 *     vtkPointData* data = interpolator->GetOutput()->GetPointData();
 *     vtkDataArray* heights = data->GetArray("Elevation");
 *     heights->GetTuple1(4); // 15.0
 *
 * Input port 0: the places, the points of any vtkDataSet. Port 1: the source, any vtkPointSet; its
 * cells do not matter, but see LinesAsSegments. Port 2, optional: the segments, a vtkPolyData, as
 * port 1 of vtkDelaunayFlipPoints.
 *
 * Output port 0: the first input with its data, and these point arrays, which replace those of the
 * same names:
 *
 * - each array of numbers of the source's point data, also one of several components. float stays
 *   float. Others, also integers, become double and are not rounded. Arrays of texts are left out,
 *   with a warning. Global and pedigree ids and ghost types are left out without one.
 * - "Elevation": z of the source's points (see ElevationArray). On a sphere only with Degrees.
 * - "vtkValidPointMask", char: 1 where a place is in a triangle or on its edge, else 0.
 *
 * Points that only the segments have get the data of the source there, and z as by SegmentHeights,
 * but keep those in arrays that the segments have, too.
 *
 * An array is the active scalars, vectors and so on if it is in the source, unless the first input
 * has others. One that replaces an array of the first input is not what that was. Elevation is the
 * active scalars if there are none. A place outside of all triangles has NaN, or see Outside. So
 * has a place that is not finite. Port 1: the table of iterations of the triangulation.
 *
 * Linear functions of x and y are reproduced within rounding, by both methods, except on a sphere.
 * At a point of the source the value is that of the point; of several at one place, that with the
 * lowest id. An image without a direction matrix has the values of a point set with its points, bit
 * for bit, but needs no memory for their coordinates.
 *
 * The triangulation is kept for the next update, also in memory of a GPU. It is made again only if
 * the source, the segments or an option that decides it has changed. After changing values in
 * place, mark the dataset or their array as modified; in composite data, their array. LiveUpdate
 * and PassSegments have no effect. An aborted update gives the first input without new arrays.
 *
 * Composite first input: every block has values of the source; if the source or the segments are
 * composite, of their blocks at the same place. Blocks that are no datasets pass unchanged, with a
 * warning. A composite source of a single dataset is an error: join its blocks first. In a pipeline
 * of several pieces every piece of the places asks for all of the source.
 *
 * @warning
 * The values of all arrays at all places are in memory once more during the update, in double.
 *
 * @sa
 * vtkDelaunayFlipPoints vtkProbeFilter vtkPointInterpolator2D
 */
#ifndef vtkDelaunayFlipInterpolator_h
#define vtkDelaunayFlipInterpolator_h

#include "vtkDelaunayFlipFiltersModule.h" // For export macro
#include "vtkDelaunayFlipPoints.h"

class vtkDataSet;

class VTKDELAUNAYFLIPFILTERS_EXPORT vtkDelaunayFlipInterpolator : public vtkDelaunayFlipPoints
{
public:
  static vtkDelaunayFlipInterpolator* New();
  vtkTypeMacro(vtkDelaunayFlipInterpolator, vtkDelaunayFlipPoints);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The points with the values: see above.
   */
  void SetSourceConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(1, port); }
  void SetSourceData(vtkDataObject* source) { this->SetInputData(1, source); }
  ///@}

  /**
   * The output if it is not composite, else null.
   */
  vtkDataSet* GetOutput();

  ///@{
  /**
   * How values between points are found. LINEAR (default): linear in each triangle. NATURAL:
   * Sibson's natural neighbours, smooth except at the points. Neighbours behind a segment do not
   * count. NATURAL is an error if MaximumIterations has left bad edges.
   */
  enum MethodType
  {
    METHOD_LINEAR = 0,
    METHOD_NATURAL = 1
  };
  vtkSetClampMacro(Method, int, METHOD_LINEAR, METHOD_NATURAL);
  vtkGetMacro(Method, int);
  void SetMethodToLinear() { this->SetMethod(METHOD_LINEAR); }
  void SetMethodToNatural() { this->SetMethod(METHOD_NATURAL); }
  ///@}

  ///@{
  /**
   * The values of a place that is in no triangle. NAN (default), or NEAREST: the value at the
   * nearest place on the boundary of the triangles, linear along its edges. ERROR: the update
   * fails, and the error counts such places.
   */
  enum OutsideType
  {
    OUTSIDE_NAN = 0,
    OUTSIDE_NEAREST = 1,
    OUTSIDE_ERROR = 2
  };
  vtkSetClampMacro(Outside, int, OUTSIDE_NAN, OUTSIDE_ERROR);
  vtkGetMacro(Outside, int);
  void SetOutsideToNan() { this->SetOutside(OUTSIDE_NAN); }
  void SetOutsideToNearest() { this->SetOutside(OUTSIDE_NEAREST); }
  void SetOutsideToError() { this->SetOutside(OUTSIDE_ERROR); }
  ///@}

  ///@{
  /**
   * The name of the array that has z of the source, interpolated. Default "Elevation"; "" or null:
   * none. If the source has an array of this name, that one is interpolated instead, with a
   * warning.
   */
  vtkSetStdStringFromCharMacro(ElevationArray);
  vtkGetCharFromStdStringMacro(ElevationArray);
  ///@}

protected:
  vtkDelaunayFlipInterpolator();
  ~vtkDelaunayFlipInterpolator() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

#ifndef __VTK_WRAP__
  std::vector<delaunayflip::MeshBlock> ListBlocks(vtkDataObject* input,
    const std::vector<delaunayflip::MeshBlock>& others,
    delaunayflip::UpdateSummary& summary) override;
  void FlipLeaves(delaunayflip::MeshBlock& block,
    const std::vector<delaunayflip::MeshBlock>& sources,
    delaunayflip::UpdateSummary& summary) override;
#endif

  int Method = METHOD_LINEAR;
  int Outside = OUTSIDE_NAN;
  std::string ElevationArray = "Elevation";

private:
#ifndef __VTK_WRAP__
  std::vector<delaunayflip::MeshBlock> ListSegments();
  delaunayflip::TriangulationRequest MakeSourceRequest(
    vtkPointSet* source, vtkPolyData* points, vtkPolyData* segments);
#endif
  void CheckPlaces(
    vtkDataSet* places, const std::string& where, delaunayflip::UpdateSummary& summary) const;
  std::string ChooseArrays(
    vtkPolyData* points, const std::string& where, delaunayflip::UpdateSummary& summary) const;

  vtkDelaunayFlipInterpolator(const vtkDelaunayFlipInterpolator&) = delete;
  void operator=(const vtkDelaunayFlipInterpolator&) = delete;
};

#endif
