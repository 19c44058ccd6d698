// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipPoints
 * @brief   make a Delaunay mesh from points, with or without segments, by parallel edge flips
 *
 * vtkDelaunayFlipPoints joins points to triangles in x and y, or in another plane (see Projection).
 * They are a valid mesh first. Its edges then flip until all of them are Delaunay. The result is
 * exact, and depends on the places of the points and the segments alone: not on the order of the
 * points, nor on threads or GPUs. Where four or more points lie on one circle, the triangles are
 * those of vtkDelaunayFlip with the canonical tie rule.
 *
 *     vtkNew<vtkPoints> points;
 *     points->InsertNextPoint(0, 0, 0);
 *     points->InsertNextPoint(2, -1, 10);
 *     points->InsertNextPoint(4, 0, 20);
 *     points->InsertNextPoint(2, 1, 30);
 *     vtkNew<vtkPolyData> given;
 *     given->SetPoints(points);
 *     vtkNew<vtkDelaunayFlipPoints> triangulate;
 *     triangulate->SetInputData(given);
 *     triangulate->Update();
 *     triangulate->GetOutput()->GetNumberOfPolys(); // 2
 *
 * Input port 0: any vtkPointSet; its cells do not matter, but see LinesAsSegments. Port 1,
 * optional: the segments, a vtkPolyData. Its lines become edges of the mesh, such as the breaklines
 * of a terrain. So do its polygons, and its lines that end where they begin (ClosedLinesAsRings).
 * These are also rings of the outline or of holes (see RingRule, FirstHole): what is outside the
 * outline, or inside a hole, is removed. Without an outline everything is inside. If this input has
 * no points, or the points of the first input (the same number and bits), its point ids are those
 * of the first input, as with the source of vtkDelaunay2D. Otherwise a point of it that lies at the
 * place of a point of the first input is that point, and all others are added. Places are compared
 * as by vtkDelaunayFlip: x, y and z must be equal, as floats if one of the inputs has float points.
 *
 * Output port 0: a vtkPolyData with all points of the input, in their order and with their point
 * data, and triangles, which are counter-clockwise in the plane. Without added points it shares
 * the vtkPoints object of the input, but not in live updates. Added points come last. First are
 * those of the second input with their z and point data. An array of numbers that only the first
 * input has is interpolated for them, as by SegmentHeights SURVEY; other arrays that only one input
 * has are 0 or empty for the points of the other. If both have an array of one name, numbers of the
 * second input become float or double if those of the first one are. If types or components then
 * differ, the values of the second input are in an array with " (2)" after its name. Its arrays
 * with too few tuples are left out. Then come those where segments cross, and those of refinement
 * (MinimumAngle, MaximumArea, MaximumEdge, SizeArray, AddRegion). Global ids become pedigree ids if
 * points are added, since they are no longer unique. With PassSegments the output also has the
 * edges of the segments, as lines. Port 1: the table of iterations, as of vtkDelaunayFlip.
 *
 * The field data of port 0 are those of vtkDelaunayFlip, and these arrays of one value each. Their
 * names begin with "DelaunayFlip:", too: UsedPoints, PointsNotFinite, RepeatedPoints, PointsTooNear
 * (see PointTolerance), SegmentEdges (the edges that segments have become), RefusedSegments,
 * Crossings (the points added where segments cross), LargestShift (how far rounding has moved one
 * of them at most), OutsideTriangles and LargeTriangles (those removed by rings, and by Alpha and
 * LongestEdge), LeftOutRings, MoveRounds (see KeepSession) and PointsInside (on a sphere: points
 * inside of the convex hull).
 *
 * Some points are not used. If several are at one place in the plane, only the one with the lowest
 * id is used, for any z. Points with a NaN or infinite coordinate are not used, but in XY their z
 * does not matter. Unused points stay in the output, and a warning counts them. n places with h of
 * them on the hull give 2 n - 2 - h triangles. If there are fewer than three places, or all lie on
 * one line, there are no triangles, and a warning says why. A warning with the boxes around points
 * and segments says if outlines, holes or lengths leave no triangle of a point of the first input.
 *
 * Segments are taken in the order of the cells: lines of the first input, then lines and then
 * polygons of the second one. A segment through points is split there. Segments may overlap. One
 * that crosses an earlier one is refused and counted, and a warning names the first such segments;
 * with SplitCrossings both are split where they cross. If a segment of a ring is refused, the
 * update fails, and the error names the ring: its number is its cell id. Rings without an area,
 * such as those of two points, are left out, with a warning; their segments stay. A ring with the
 * edges of an earlier one, such as a polygon and its line, is left out, too. A ring that runs more
 * than once along its loop counts once. Without an outline the mesh reaches to holes outside of the
 * points of the first input, and a warning counts such points.
 *
 * The heights of added points are those of the second input. But if its lines, outlines or holes
 * have z = 0 throughout, and the points of the first input do not, the added points get heights of
 * these, with a warning that counts them (see SegmentHeights). So do those with a z that is NaN or
 * infinite.
 *
 * An aborted update gives the triangles so far; segments that are not inserted yet are missing, and
 * nothing is removed. If the triangulation was kept for it (see KeepSession), there are no
 * triangles; it stays as it was, and the next update follows the points again.
 *
 * What the properties of vtkDelaunay2D become:
 *
 * | vtkDelaunay2D | vtkDelaunayFlipPoints |
 * |---|---|
 * | Input | the same |
 * | Source | the second input, SetSegmentsConnection(); for polygons also RingRule ORIENTATION |
 * | Alpha | Alpha; the lines and vertices of an alpha shape are not made, only its triangles |
 * | Tolerance, a share of the extent | PointTolerance, a distance |
 * | Offset, BoundingTriangulation | none: there are no points but those of the inputs |
 * | Transform | Transform |
 * | ProjectionPlaneMode | Projection, Transform |
 * | RandomPointInsertion | none: the order of the points does not matter |
 * | OutputPointsPrecision | none: the output has the points of the input |
 *
 * Unlike with vtkDelaunay2D, no triangle at the hull is missing, segments through points are split
 * there, and those that cross are reported.
 *
 * Composite input (multiblock, partitioned): the points of every block are triangulated alone;
 * blocks that are no point sets pass unchanged, with a warning. A composite second input has the
 * same structure, and its blocks apply block by block; any other applies to all. Blocks and
 * partitions without points stay empty. Points in several partitions of one dataset, or segments,
 * are an error: join them first. In a pipeline of several pieces the first one asks for all points
 * and has all triangles, and the others are empty. Points that a filter upstream keeps in other
 * pieces are missing: gather them in the first one before.
 *
 * @warning
 * The inputs are viewed, not copied, as by vtkDelaunayFlip. A projection is rounded once, to
 * double; the rounded places are what is Delaunay. At most 357 million points.
 *
 * @sa
 * vtkDelaunayFlip vtkDelaunayFlipInterpolator vtkDelaunay2D
 */
#ifndef vtkDelaunayFlipPoints_h
#define vtkDelaunayFlipPoints_h

#include "vtkDelaunayFlipAlgorithm.h"
#include "vtkDelaunayFlipFiltersModule.h" // For export macro
#include "vtkSmartPointer.h" // For the points that are read

#include <array> // For the regions
#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkAbstractTransform;
class vtkPointData;
class vtkPointSet;

namespace delaunayflip
{
struct Defect;
struct TriangulationRequest;
}

class VTKDELAUNAYFLIPFILTERS_EXPORT vtkDelaunayFlipPoints : public vtkDelaunayFlipAlgorithm
{
public:
  static vtkDelaunayFlipPoints* New();
  vtkTypeMacro(vtkDelaunayFlipPoints, vtkDelaunayFlipAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The segments, optional: see above.
   */
  void SetSegmentsConnection(vtkAlgorithmOutput* port)
  {
    this->SetInputConnection(this->SegmentsPort, port);
  }
  void SetSegmentsData(vtkPolyData* segments) { this->SetInputData(this->SegmentsPort, segments); }
  ///@}

  ///@{
  /**
   * Where the points are joined. XY (default) ignores z. BEST_FITTING_PLANE is that of
   * vtkPlane::ComputeBestFittingPlane, seen from above. If points are far from it, it differs by
   * some degrees from the plane with the smallest sum of squared distances. A Transform replaces
   * both.
   *
   * SPHERE makes the convex hull of points around the origin, the Delaunay triangulation on a
   * sphere: n places have 2 n - 4 triangles, counter-clockwise from outside. Points inside of the
   * hull are not used, and a warning counts them. OPEN_SPHERE leaves out a triangle if its
   * circumcircle encloses half of the sphere or more, so points on a part of the sphere get an open
   * mesh. On a sphere segments run along great circles, the shorter way, and the inside of a ring
   * is the smaller one of its sides; with the ring rule ORIENTATION, in the outline, the one to its
   * left. Regions and lengths are errors; they are not supported there yet.
   */
  enum ProjectionType
  {
    PROJECTION_XY = 0,
    PROJECTION_BEST_FITTING_PLANE = 1,
    PROJECTION_SPHERE = 2,
    PROJECTION_OPEN_SPHERE = 3
  };
  vtkSetClampMacro(Projection, int, PROJECTION_XY, PROJECTION_OPEN_SPHERE);
  vtkGetMacro(Projection, int);
  void SetProjectionToXY() { this->SetProjection(PROJECTION_XY); }
  void SetProjectionToBestFittingPlane() { this->SetProjection(PROJECTION_BEST_FITTING_PLANE); }
  void SetProjectionToSphere() { this->SetProjection(PROJECTION_SPHERE); }
  void SetProjectionToOpenSphere() { this->SetProjection(PROJECTION_OPEN_SPHERE); }
  ///@}

  ///@{
  /**
   * On a sphere, whether x and y are longitudes and latitudes in degrees. Then the points of the
   * output are the places on the unit sphere, in double precision. Their z, if it is not 0
   * throughout, is in the point array "Height", unless the input has such an array already. All
   * longitudes of a pole are one place. In another projection it has no effect, and there is a
   * warning. Default off.
   */
  vtkSetMacro(Degrees, bool);
  vtkGetMacro(Degrees, bool);
  vtkBooleanMacro(Degrees, bool);
  ///@}

  ///@{
  /**
   * A transform of the points, or null (default). Points are joined by their x and y after it. The
   * points of the output are not transformed.
   */
  virtual void SetTransform(vtkAbstractTransform* transform);
  vtkGetObjectMacro(Transform, vtkAbstractTransform);
  ///@}

  ///@{
  /**
   * Remove triangles that have a circumcircle with a larger radius, or a longer edge; 0 (default):
   * none. Triangles at a segment stay. Both are measured in the plane.
   */
  vtkSetClampMacro(Alpha, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Alpha, double);
  vtkSetClampMacro(LongestEdge, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LongestEdge, double);
  ///@}

  ///@{
  /**
   * Points nearer than this to one that is used and has a lower id are not used. 0 (default): only
   * those at the same place. Points where segments cross may be nearer to others.
   */
  vtkSetClampMacro(PointTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(PointTolerance, double);
  ///@}

  ///@{
  /**
   * Split segments that cross, instead of refusing the later one. The crossing is computed exactly
   * and rounded once; a point that is there already is used. Its z and point data are interpolated
   * along the earlier segment, in a projection x and y too. Default off.
   */
  vtkSetMacro(SplitCrossings, bool);
  vtkGetMacro(SplitCrossings, bool);
  vtkBooleanMacro(SplitCrossings, bool);
  ///@}

  ///@{
  /**
   * Add a region: a place in a part that segments enclose, the label of its triangles (a 32-bit
   * integer), and the largest area of a triangle there (0: as elsewhere). If there are regions, the
   * output has a cell array "Region" with these labels, and 0 elsewhere. If several are in one
   * part, the first one counts.
   */
  void AddRegion(double x, double y, double label, double maximumArea);
  void RemoveAllRegions();
  ///@}

  ///@{
  /**
   * When a place is inside a set of rings. EVEN_ODD (default): if a path from there to infinity
   * crosses the rings an odd number of times. NON_ZERO: if the counter-clockwise turns of the rings
   * around it differ from the clockwise ones. ORIENTATION, as for vtkDelaunay2D: counter-clockwise
   * rings of the outline enclose what is kept, clockwise ones cut holes.
   */
  enum RingRuleType
  {
    RING_RULE_EVEN_ODD = 0,
    RING_RULE_NON_ZERO = 1,
    RING_RULE_ORIENTATION = 2
  };
  vtkSetClampMacro(RingRule, int, RING_RULE_EVEN_ODD, RING_RULE_ORIENTATION);
  vtkGetMacro(RingRule, int);
  void SetRingRuleToEvenOdd() { this->SetRingRule(RING_RULE_EVEN_ODD); }
  void SetRingRuleToNonZero() { this->SetRingRule(RING_RULE_NON_ZERO); }
  void SetRingRuleToOrientation() { this->SetRingRule(RING_RULE_ORIENTATION); }
  ///@}

  ///@{
  /**
   * Rings of the second input are holes from this cell id on; those before are the outline. What is
   * inside the holes is removed. -1 (default): there are no holes.
   */
  vtkSetClampMacro(FirstHole, vtkIdType, -1, VTK_ID_MAX);
  vtkGetMacro(FirstHole, vtkIdType);
  ///@}

  ///@{
  /**
   * The z of points that only the second input has. SURVEY: that of the first input there, linear
   * in the triangulation of its points alone, and outside of it that of the nearest place on its
   * boundary. Whatever the choice, all arrays of numbers that the second input does not have are
   * found in this way; integers are rounded. OWN: that of the second input. AUTO (default): SURVEY
   * for points with a z that is not finite, and for its lines, outlines or holes, each of the three
   * by itself, that have z = 0 throughout, if the first input has other heights; else OWN. Only for
   * x and y: in another projection AUTO is OWN, and SURVEY is an error. With Degrees the array
   * "Height" has z of the second input with OWN, or if it is not 0 throughout; else it is
   * interpolated.
   */
  enum SegmentHeightsType
  {
    SEGMENT_HEIGHTS_AUTO = 0,
    SEGMENT_HEIGHTS_SURVEY = 1,
    SEGMENT_HEIGHTS_OWN = 2
  };
  vtkSetClampMacro(SegmentHeights, int, SEGMENT_HEIGHTS_AUTO, SEGMENT_HEIGHTS_OWN);
  vtkGetMacro(SegmentHeights, int);
  void SetSegmentHeightsToAuto() { this->SetSegmentHeights(SEGMENT_HEIGHTS_AUTO); }
  void SetSegmentHeightsToSurvey() { this->SetSegmentHeights(SEGMENT_HEIGHTS_SURVEY); }
  void SetSegmentHeightsToOwn() { this->SetSegmentHeights(SEGMENT_HEIGHTS_OWN); }
  ///@}

  ///@{
  /**
   * Take the lines of the first input, if it is a vtkPolyData, as segments, also closed ones.
   * Default off.
   */
  vtkSetMacro(LinesAsSegments, bool);
  vtkGetMacro(LinesAsSegments, bool);
  vtkBooleanMacro(LinesAsSegments, bool);
  ///@}

  ///@{
  /**
   * Take a line of the second input that ends where it begins as a ring, as polygons are. Off: it
   * is a breakline, such as a closed contour. Default on.
   */
  vtkSetMacro(ClosedLinesAsRings, bool);
  vtkGetMacro(ClosedLinesAsRings, bool);
  vtkBooleanMacro(ClosedLinesAsRings, bool);
  ///@}

  ///@{
  /**
   * Whether the output has the edges that segments have become, each once, as lines before the
   * triangles. Then its cell array "SegmentIds" has, for each line, the id of the cell of the
   * second input along which it runs (of several, the first one), and -1 for each triangle. Its
   * point array "SegmentIds" has the id of the cell on which refinement has put each point, and -1
   * for all other points. With LinesAsSegments, lines of the first input have the number of cells
   * of the second input plus their own cell id. Default off.
   */
  vtkSetMacro(PassSegments, bool);
  vtkGetMacro(PassSegments, bool);
  vtkBooleanMacro(PassSegments, bool);
  ///@}

  ///@{
  /**
   * Whether the triangulation is kept for the next update. If only points have moved then, it
   * follows them: the points walk to their places and edges flip, which takes a fraction of the
   * time if they move by up to about a tenth of their distances. Segments move with their points:
   * they must be between the same ones. Point data and the number of iterations do not matter. The
   * output is that of a new filter, with the same triangles in the same order, except for the
   * iterations and flips; MoveRounds in the field data is not 0. If many triangles would turn over,
   * if points meet or part at one place or go through a segment, or while segments cross, the
   * points are triangulated anew, and MoveRounds is 0.
   *
   * AUTO (default) keeps it if the first input has several time steps. ON suits points that a
   * program moves. OFF frees the memory with the next update. The engine keeps about 150 bytes a
   * point, on the host or on a GPU, as long as the filter lives. Triangles are then sorted by their
   * point ids, lowest first, which takes up to a fifth of the time of a new triangulation.
   *
   * It has no effect, and nothing is kept or sorted, with regions, refinement, a sphere, Alpha,
   * LongestEdge, PointTolerance, MaximumIterations, composite input, or SplitCrossings if there are
   * segments.
   */
  enum KeepSessionType
  {
    KEEP_SESSION_AUTO = 0,
    KEEP_SESSION_ON = 1,
    KEEP_SESSION_OFF = 2
  };
  vtkSetClampMacro(KeepSession, int, KEEP_SESSION_AUTO, KEEP_SESSION_OFF);
  vtkGetMacro(KeepSession, int);
  void SetKeepSessionToAuto() { this->SetKeepSession(KEEP_SESSION_AUTO); }
  void SetKeepSessionToOn() { this->SetKeepSession(KEEP_SESSION_ON); }
  void SetKeepSessionToOff() { this->SetKeepSession(KEEP_SESSION_OFF); }
  ///@}

  ///@{
  /**
   * The number of edges that segments have become in the last update, and of segments that were
   * refused, summed over blocks. The field data have all counts.
   */
  vtkIdType GetNumberOfSegmentEdges() const;
  vtkIdType GetNumberOfRefusedSegments() const;
  ///@}

  /**
   * The time when the filter or its transform was modified, whichever is later.
   */
  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  /**
   * A function of the program that each update calls with every defect that it has found. If it
   * returns true, neither a warning nor the report has the defect. Default: none.
   */
  using DefectHandler = std::function<bool(const delaunayflip::Defect&)>;
  void SetDefectHandler(DefectHandler handler)
  {
    this->Handler = std::move(handler);
    this->Modified();
  }
#endif

protected:
  vtkDelaunayFlipPoints();
  ~vtkDelaunayFlipPoints() override;

#ifndef __VTK_WRAP__
  /**
   * Warns of latitudes beyond 90 degrees.
   * @param name what has the points, or "".
   */
  static void WarnOfLatitudes(vtkPoints* degrees, const std::string& name, const std::string& where,
    delaunayflip::UpdateSummary& summary);

  /**
   * Adds z of points to their data. Their places on a sphere do not have it.
   * @param name the array.
   * @param always whether also if z = 0 throughout.
   * @returns false if there is such an array already, and z is lost that is not 0 throughout.
   */
  static bool KeepHeights(
    vtkPoints* degrees, const std::string& name, bool always, vtkPointData* data);

  void FlipLeaves(delaunayflip::MeshBlock& block,
    const std::vector<delaunayflip::MeshBlock>& segments,
    delaunayflip::UpdateSummary& summary) override;

  /// Asks for the triangles of a dataset. The meshes of the request are not set yet.
  delaunayflip::TriangulationRequest MakeRequest(vtkPointSet* input);

  /// Takes the defects that the handler tells of out of the report of the mesh.
  void HandleDefects();

  bool IsOnSphere() const;

  /// Whether x and y of points are longitudes and latitudes.
  bool HasAngles() const { return this->Degrees && this->IsOnSphere(); }

  /// The points of an input for a block with their data and, if they are segments, its lines.
  vtkSmartPointer<vtkPolyData> ReadPoints(vtkPointSet* input, const delaunayflip::MeshBlock& block,
    delaunayflip::UpdateSummary& summary) const;

  /// The segments for a block; null if there are none. May throw.
  /// @param heights the array that gets z of longitudes and latitudes; "": none.
  vtkSmartPointer<vtkPolyData> FindSegments(const delaunayflip::MeshBlock& block,
    const std::vector<delaunayflip::MeshBlock>& segments, const std::string& heights,
    delaunayflip::UpdateSummary& summary) const;
#endif

  int SegmentsPort = 1;
  int Projection = PROJECTION_XY;
  bool Degrees = false;
  vtkAbstractTransform* Transform = nullptr;
  double Alpha = 0.0;
  double LongestEdge = 0.0;
  double PointTolerance = 0.0;
  bool SplitCrossings = false;
  int RingRule = RING_RULE_EVEN_ODD;
  std::vector<std::array<double, 4>> Regions; ///< x, y, label and largest area of each.
  vtkIdType FirstHole = -1;
  int SegmentHeights = SEGMENT_HEIGHTS_AUTO;
  bool LinesAsSegments = false;
  bool ClosedLinesAsRings = true;
  bool PassSegments = false;
  int KeepSession = KEEP_SESSION_AUTO;

private:
#ifndef __VTK_WRAP__
  /**
   * Calls visit(name, property, member) for each property of this class that is an option of the
   * engine.
   */
  template <typename Visit>
  void ForEachOption(const Visit& visit) const;
#endif

  bool WantsToKeep();

  DefectHandler Handler;

  vtkDelaunayFlipPoints(const vtkDelaunayFlipPoints&) = delete;
  void operator=(const vtkDelaunayFlipPoints&) = delete;
};

#endif
