// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlip
 * @brief   turn a triangle mesh into a Delaunay mesh by parallel edge flips
 *
 * vtkDelaunayFlip makes a triangle mesh Delaunay. The points stay where they are; only how they are
 * joined changes. Every iteration flips, in parallel, an independent set of edges that are not
 * locally Delaunay. The update ends when no such edge is left that may be flipped.
 *
 *     vtkNew<vtkPoints> points;
 *     points->InsertNextPoint(0, 0, 0);
 *     points->InsertNextPoint(2, -1, 0);
 *     points->InsertNextPoint(4, 0, 0);
 *     points->InsertNextPoint(2, 1, 0);
 *     vtkNew<vtkCellArray> triangles;
 *     triangles->InsertNextCell({ 0, 1, 2 });
 *     triangles->InsertNextCell({ 0, 2, 3 });
 *     vtkNew<vtkPolyData> mesh;
 *     mesh->SetPoints(points);
 *     mesh->SetPolys(triangles);
 *     vtkNew<vtkDelaunayFlip> flip;
 *     flip->SetInputData(mesh);
 *     flip->Update(); // GetOutput() has two better triangles
 *     flip->GetTotalFlips(); // 1
 *
 * Input: any vtkPolyData, also as a block of a composite dataset. Quads, polygons and triangle
 * strips are first split into triangles (see Triangulate). Nothing is assumed about the mesh: it
 * may be open or non-manifold, have mixed winding, and contain duplicate, degenerate or unused
 * parts. Edges that are not provably safe to flip stay and are counted. The optional second input
 * holds constraint edges, as lines and polygons with the same point ids or at the same places (see
 * SetConstraintsConnection()). Lines of the first input are constraints too (see
 * LinesAsConstraints).
 *
 * Output port 0: the mesh. It shares the vtkPoints object of the input and keeps its point data,
 * verts and lines. Every triangle keeps its place in the cell array and its cell data; triangles
 * that no flip changed are bit-identical. Active cell normals are recomputed for changed triangles.
 * If cells were split, global cell ids become pedigree ids, since they are no longer unique. Output
 * cells are ordered verts, lines, polygons (triangles of strips after those of the polygons),
 * strips. Cells with fewer than three points pass unchanged. Input without triangles, polygons or
 * strips passes as a shallow copy, with an empty table.
 *
 * Output port 1: a vtkTable with one row per iteration and the columns Iteration, Tested,
 * NonDelaunay, Flipped, Excluded, Blocked, MinimumAngle (degrees; -1 where it was not computed)
 * and Seconds. Port 0 has the same columns as field data, unless there are no rows, and arrays with
 * one value each: Converged, StopReason, Summary, TotalFlips, NonDelaunayAfter, BlockedByShape,
 * BlockedByDeviation, BlockedByEdge, TrianglesBelow10Before, TrianglesBelow10After and so on for 20
 * and 30 degrees, RefinementPoints, RefinementRounds (how often they were added),
 * UnrefinedTriangles (those that could not get better), ReachedPointLimit (1 if PointLimit has
 * ended refinement), FixedEdges, NonManifoldEdges, ConstraintEdges, UnmatchedConstraints,
 * InsertedConstraints, ConstraintFlips, GeometryUsed, GeometryReason, Tolerance ("automatic", the
 * value, or "none" if the in-circle predicate decides) and Backend. In the field data each name
 * begins with "DelaunayFlip:", e.g. "DelaunayFlip:Flipped", so that input arrays with the short
 * names pass. Such arrays of an earlier update, and those of GenerateFlipCount and GenerateQuality,
 * do not pass.
 *
 * Edges that never flip: boundary, non-manifold and wrongly wound edges, feature edges of surfaces
 * (FeatureAngle), constraint edges, borders between regions (RegionArray) and the edges of ghost
 * cells (vtkGhostType: duplicate, refined or hidden).
 *
 * An update does not depend on earlier ones. Where the points of a mesh move from update to update,
 * or from one time step to the next, each update begins with the triangles of the input. Only with
 * LiveUpdate it continues from the flipped triangles.
 *
 * Comparison with vtkDelaunay2D: that filter builds a new triangulation from points, as
 * vtkDelaunayFlipPoints does. This one improves an existing mesh, planar in any orientation or a
 * surface in space, and keeps its holes, borders and constraints. In the plane it is exact: by
 * default each edge is judged by an error-free in-circle predicate.
 *
 * The work is done on a GPU if the build has the CUDA backend, there is a GPU, and the mesh is
 * large enough; otherwise on CPU threads (see Backend). Both give the same output, bit for bit,
 * with any number of threads. Only Seconds and Backend may differ.
 *
 * @warning
 * Points that belong to no triangle stay unused. On surfaces the result is Delaunay in the sense of
 * opposite-angle sums. An edge stays and is reported as blocked if its flip would fold the surface
 * over, or create an edge that exists already.
 *
 * @warning
 * Points and triangles of the input are viewed, not copied. Observers may stop, remove, replace or
 * empty the input and the output of an update, but must not make these arrays grow or shrink in
 * place meanwhile.
 *
 * Composite input (multiblock, partitioned): every polygonal block is a mesh of its own; other
 * blocks pass unchanged, with a warning. If a block fails, the error names it, its output is empty,
 * and the other blocks are flipped. The methods that return results, and the only table, have the
 * sums over all blocks; the field data of a block are its own. Composite constraints with the same
 * structure apply block by block; a warning names those that no block has.
 *
 * The partitions of a dataset (vtkPartitionedDataSet, vtkMultiPieceDataSet) are one mesh: edges
 * between them flip, too. Points of several partitions are the same if they have the same global id
 * (active global ids of the point data, in all partitions) or, without global ids, equal
 * coordinates and at least one of them is at the border of its partition. Where such a point
 * coincides with another one of its own partition, it is not known which of the two is meant; a
 * warning says so. Duplicate ghost cells (vtkGhostType) are dropped. Every triangle stays in its
 * partition, with its cell data. Points that a partition then lacks are added behind its own, which
 * become double if they are integers. Every partition gets the arrays of all partitions. An array
 * that it lacked is 0 or empty there, except at points that it shares with a partition that has the
 * array. All results are those of the whole mesh.
 *
 * @par References
 * - C. Navarro, N. Hitschfeld, E. Scheihing: A GPU-based method for generating quasi-Delaunay
 *   triangulations based on edge-flips, GRAPP 2013 (the parallel method).
 * - C. L. Lawson: Software for C1 surface interpolation, in Mathematical Software III, 1977 (edge
 *   flips end in the Delaunay triangulation).
 * - J. R. Shewchuk: Adaptive precision floating-point arithmetic and fast robust geometric
 *   predicates, Discrete & Computational Geometry 18, 1997.
 *
 * @sa
 * vtkDelaunayFlipPoints vtkDelaunay2D vtkFeatureEdges vtkTriangleFilter
 */
#ifndef vtkDelaunayFlip_h
#define vtkDelaunayFlip_h

#include "vtkDelaunayFlipAlgorithm.h"
#include "vtkDelaunayFlipFiltersModule.h" // For export macro

#include <array>
#include <vector>

namespace delaunayflip
{
struct FlipRequest;
}

class VTKDELAUNAYFLIPFILTERS_EXPORT vtkDelaunayFlip : public vtkDelaunayFlipAlgorithm
{
public:
  static vtkDelaunayFlip* New();
  vtkTypeMacro(vtkDelaunayFlip, vtkDelaunayFlipAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The space in which edges are judged. PLANAR judges in the plane of the points, in any
   * orientation; the update fails if they lie in no plane. PLANAR_XY judges by x and y alone, for
   * terrain. SURFACE judges in space, by opposite-angle sums. AUTO (default) chooses the first of
   * these that fits:
   *
   * PLANAR if all used points lie in one plane, within 1e-6 of the diagonal of their bounding box.
   *
   * PLANAR_XY if the mesh is a height field over x and y, and either z extends further than both x
   * and y, as with degrees and metres, or 95 % of the area slopes less than 45 degrees. It is a
   * height field if in the projection all triangles, except at most one in 1,000, have area and
   * face the same side, and the triangles around any point turn at most once. If z extends more
   * than ten times as far as x and as y, one in five may have no area, and one in 100 of the others
   * may face the other side, as where an ocean crosses 180 degrees; those stay as they are and are
   * counted in a warning. The slope of a sliver is that of its steepest edge, because the planes of
   * slivers are steep even in gentle terrain.
   *
   * SURFACE otherwise. If no more triangles than that ruled out a height field, a warning says so.
   * Choose PLANAR_XY yourself for steeper terrain.
   *
   * SPHERE, which AUTO never chooses, is for globes around the origin. An edge is good if the far
   * corner of one triangle is not beyond the plane of the other, by exact arithmetic. So the mesh
   * becomes the convex hull of its points, the Delaunay triangulation on the sphere. No flip turns
   * a triangle over, seen from the origin.
   *
   * GetGeometryReason() says why a geometry was used. If SURFACE is used on a height field, chosen
   * by AUTO or by you, and flips turn triangles over in x and y, a warning counts them.
   */
  enum GeometryType
  {
    GEOMETRY_AUTO = 0,
    GEOMETRY_PLANAR = 1,
    GEOMETRY_PLANAR_XY = 2,
    GEOMETRY_SURFACE = 3,
    GEOMETRY_SPHERE = 4,
    GEOMETRY_MIXED = 5 ///< Returned by GetGeometryUsed(); cannot be set.
  };
  vtkSetClampMacro(Geometry, int, GEOMETRY_AUTO, GEOMETRY_SPHERE);
  vtkGetMacro(Geometry, int);
  void SetGeometryToAuto() { this->SetGeometry(GEOMETRY_AUTO); }
  void SetGeometryToPlanar() { this->SetGeometry(GEOMETRY_PLANAR); }
  void SetGeometryToPlanarXY() { this->SetGeometry(GEOMETRY_PLANAR_XY); }
  void SetGeometryToSurface() { this->SetGeometry(GEOMETRY_SURFACE); }
  void SetGeometryToSphere() { this->SetGeometry(GEOMETRY_SPHERE); }
  ///@}

  ///@{
  /**
   * How an edge is judged. With IN_CIRCLE (default), by the exact in-circle predicate, in planar
   * geometry. With OPPOSITE_ANGLES an edge is bad if the two angles opposite to it sum to more than
   * pi + Tolerance. Surfaces always use OPPOSITE_ANGLES.
   */
  enum CriterionType
  {
    CRITERION_IN_CIRCLE = 0,
    CRITERION_OPPOSITE_ANGLES = 1
  };
  vtkSetClampMacro(Criterion, int, CRITERION_IN_CIRCLE, CRITERION_OPPOSITE_ANGLES);
  vtkGetMacro(Criterion, int);
  void SetCriterionToInCircle() { this->SetCriterion(CRITERION_IN_CIRCLE); }
  void SetCriterionToOppositeAngles() { this->SetCriterion(CRITERION_OPPOSITE_ANGLES); }
  ///@}

  ///@{
  /**
   * How far an opposite-angle sum may exceed pi before the edge is bad, in radians: at least 0 and
   * below 1, or -1 (default); other values fail the update. -1 is automatic: each edge has its own
   * tolerance, the largest change of its sum that one unit in the last place of its points'
   * coordinates (float or double) can cause. This tolerance is larger far from the origin and for
   * short edges. With it, a surface that is Delaunay within the precision of its points comes back
   * bit-identical. Has no effect on the in-circle criterion, which is exact; a warning says so
   * where another value than -1 is set.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * What happens to an edge if its four points lie exactly on one circle. KEEP (default) leaves it,
   * so that a Delaunay mesh comes back bit-identical. CANONICAL makes the result independent of the
   * input's triangles if nothing overlaps and no edge is left blocked; only flat triangles along
   * fixed edges may differ. It needs planar geometry and the in-circle criterion; otherwise the
   * update fails.
   */
  enum TieRuleType
  {
    TIE_RULE_KEEP = 0,
    TIE_RULE_CANONICAL = 1
  };
  vtkSetClampMacro(TieRule, int, TIE_RULE_KEEP, TIE_RULE_CANONICAL);
  vtkGetMacro(TieRule, int);
  void SetTieRuleToKeep() { this->SetTieRule(TIE_RULE_KEEP); }
  void SetTieRuleToCanonical() { this->SetTieRule(TIE_RULE_CANONICAL); }
  ///@}

  ///@{
  /**
   * On surfaces, an edge stays if the normals of its two triangles differ by more than this angle
   * in the input. In degrees, 0 to 180; default 30; 180 turns feature edges off.
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * On surfaces, an edge stays if its flip would move the surface by more than this length, in the
   * unit of the points: the distance between the edge and the one that would take its place. It
   * holds for each flip; the moves of many flips can add up. 0 allows only flips in flat quads.
   * Default: VTK_DOUBLE_MAX, no limit. The update fails if it is negative or NaN.
   */
  vtkSetMacro(MaximumDeviation, double);
  vtkGetMacro(MaximumDeviation, double);
  ///@}

  ///@{
  /**
   * The name of a cell array that labels regions: edges between triangles with different values
   * stay. The array may hold numbers or strings, with any number of components. Default: none (""
   * or null). The update fails if the input has no such array.
   */
  vtkSetStdStringFromCharMacro(RegionArray);
  vtkGetCharFromStdStringMacro(RegionArray);
  ///@}

  ///@{
  /**
   * Add a region, for a mesh in x and y: a place in a part of the mesh that kept edges enclose, the
   * label of its triangles (a 32-bit integer), and the largest area of a triangle there (0: as
   * elsewhere). If there are regions, the output has a cell array "Region" with these labels, and 0
   * elsewhere. If several are in one part, the first one counts. Default: none.
   */
  void AddRegion(double x, double y, double label, double maximumArea);
  void RemoveAllRegions();
  ///@}

  ///@{
  /**
   * Keep the edges of the mesh that lie along lines of the input, that is, join consecutive points
   * of its polylines. Default on. Lines always pass to the output; those that are constraints, with
   * the points that refinement has added on their edges.
   */
  vtkSetMacro(LinesAsConstraints, bool);
  vtkGetMacro(LinesAsConstraints, bool);
  vtkBooleanMacro(LinesAsConstraints, bool);
  ///@}

  ///@{
  /**
   * In planar geometry, insert constraints that are not edges of the mesh: before the first
   * iteration, flips turn each of them into an edge, or into a chain of edges if it passes through
   * points of the mesh. With the in-circle criterion the result is then a constrained Delaunay
   * triangulation. InsertConstraints (default on) is for the second input, InsertLines (default
   * off, because lines may be contours that the mesh need not follow) for the lines of the first
   * input, if LinesAsConstraints is on.
   *
   * Constraints are inserted in the order of the inputs and their cells, whether they are edges
   * already or not; those that are not to be inserted are fixed before. A constraint that would
   * cross an edge that stays, or leave the mesh, is not inserted. Such constraints are counted, and
   * the update gives one warning that names the first of them. On surfaces nothing is inserted.
   */
  vtkSetMacro(InsertConstraints, bool);
  vtkGetMacro(InsertConstraints, bool);
  vtkBooleanMacro(InsertConstraints, bool);
  vtkSetMacro(InsertLines, bool);
  vtkGetMacro(InsertLines, bool);
  vtkBooleanMacro(InsertLines, bool);
  ///@}

  ///@{
  /**
   * Split quads, polygons and triangle strips into triangles and flip those too. A quad is split
   * along the diagonal from its first to its third point, unless that runs outside it; a larger
   * polygon becomes a fan if it is convex, else its ears are clipped. Before, corners that repeat
   * the one before them are dropped, as in triangles written as quads and in rings closed by their
   * first point. A cell of more than three points, of which fewer than three are left, has no
   * triangle: it is left out with its data, and a warning counts such cells. Triangles of strips
   * that name a point twice are left out too. Default on. If off, such cells pass unchanged and
   * their edges stay. They are then counted as the triangles that they would become, with all of
   * their edges fixed.
   */
  vtkSetMacro(Triangulate, bool);
  vtkGetMacro(Triangulate, bool);
  vtkBooleanMacro(Triangulate, bool);
  ///@}

  ///@{
  /**
   * GPUs that share the mesh, instead of DeviceId: CUDA's numbers separated by commas, such as
   * "0,1", or "all"; empty (default): DeviceId alone. They flip a large mesh
   * faster than one GPU, or one that is too large for it; the result is the same. The GPUs must be
   * connected by NVLink. If one cannot be used, that is treated as with DeviceId. A list that
   * cannot be read is an error.
   */
  vtkSetStdStringFromCharMacro(Devices);
  vtkGetCharFromStdStringMacro(Devices);
  ///@}

  ///@{
  /**
   * In how many pieces the mesh is flipped, one after the other, so that it may be larger than the
   * memory of a GPU: 1 to 255, or 0 (default): one, or the fewest that are possible if it has more
   * than 715 million triangles. Devices then flip pieces in turn, and need no NVLink. In planar
   * geometry with the canonical tie rule the triangles with an area do not depend on it. With
   * LiveUpdate, the first update flips the whole mesh if there are several pieces.
   */
  vtkSetClampMacro(NumberOfPieces, int, 0, 255);
  vtkGetMacro(NumberOfPieces, int);
  ///@}

  ///@{
  /**
   * Compute the smallest angle of the mesh after every iteration, instead of only after the first
   * and the last one. Costs one pass over the mesh per iteration. Default off. No effect with
   * several pieces.
   */
  vtkSetMacro(TrackQuality, bool);
  vtkGetMacro(TrackQuality, bool);
  vtkBooleanMacro(TrackQuality, bool);
  ///@}

  ///@{
  /**
   * Add the cell array vtkDelaunayFlipCount (int): in how many flips each triangle took part,
   * including those that insert constraints; 0 for other cells. Default off.
   */
  vtkSetMacro(GenerateFlipCount, bool);
  vtkGetMacro(GenerateFlipCount, bool);
  vtkBooleanMacro(GenerateFlipCount, bool);
  ///@}

  ///@{
  /**
   * Add the cell arrays "Smallest angle before (degrees)" and "Smallest angle after (degrees)"
   * (double): the smallest angle of each triangle, 0 to 60, in space or, with PLANAR_XY, in the
   * projection. Before is the angle of the triangle that was in the same place in the input, after
   * polygons were split. 0 for triangles without area; NaN if a coordinate is NaN or infinite, and
   * for cells that are not triangles. An aborted update leaves them out. Default off.
   */
  vtkSetMacro(GenerateQuality, bool);
  vtkGetMacro(GenerateQuality, bool);
  vtkBooleanMacro(GenerateQuality, bool);
  ///@}

  ///@{
  /**
   * Constraint edges, optional: edges of the mesh along the lines and polygons of this input stay,
   * and those that the mesh does not have are inserted (see InsertConstraints).
   * If this input has no points, or the same points as the first input (the same number and bits),
   * its point ids are those of the mesh, as with the source of vtkDelaunay2D. Otherwise edges are
   * matched by the coordinates of their points, so the output of vtkFeatureEdges, which renumbers
   * points, can be used. Coordinates must be equal, not just close; if one input has float points
   * and the other double, they are compared after rounding to float. If several points of the mesh
   * coincide, all pairs of them that are edges of the mesh match. Constraint edges that match no
   * edge of the mesh and are not inserted are counted, and the update gives one warning. An update
   * of a piece of the mesh asks for all of this input. If both inputs come from a common algorithm,
   * it asks for the same piece of both.
   */
  void SetConstraintsConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(1, port); }
  void SetConstraintsData(vtkPolyData* constraints) { this->SetInputData(1, constraints); }
  ///@}

  ///@{
  /**
   * How many edges of the mesh are constraint edges, by lines of the first input or by the second
   * input, including the edges of inserted constraints; how many edges of these lines and of the
   * second input match no edge of the mesh and were not inserted; how many were inserted; and how
   * many flips that took, which are not part of TotalFlips and the iterations. After a warm start,
   * as at the beginning. All are sums over blocks: if all blocks share the constraints, an edge
   * counts as unmatched once for each block that does not have it.
   */
  vtkIdType GetNumberOfConstraintEdges() const;
  vtkIdType GetNumberOfUnmatchedConstraints() const;
  vtkIdType GetNumberOfInsertedConstraints() const;
  vtkIdType GetNumberOfConstraintFlips() const;
  ///@}

  ///@{
  /**
   * Why bad edges are left. A flip would fold the mesh over, or MaximumDeviation blocks it, or it
   * would make an edge that exists already. The rest, if any, could still flip: the update ended
   * early.
   */
  vtkIdType GetBlockedByShape() const;
  vtkIdType GetBlockedByDeviation() const;
  vtkIdType GetBlockedByEdge() const;
  ///@}

  ///@{
  /**
   * The geometry that the last update used, one of GeometryType. GEOMETRY_AUTO before the first
   * update, after an error and for a mesh without triangles; GEOMETRY_MIXED, "mixed", if blocks
   * differ.
   */
  int GetGeometryUsed() const;
  const char* GetGeometryUsedAsString() const;
  ///@}

  /**
   * Why the last update used that geometry, in plain English, e.g. "all points lie in one plane;
   * the feature angle has no effect". "" when GetGeometryUsed() is GEOMETRY_AUTO.
   */
  const char* GetGeometryReason() const;

protected:
  vtkDelaunayFlip() = default;
  ~vtkDelaunayFlip() override = default;

#ifndef __VTK_WRAP__
  void FlipLeaves(delaunayflip::MeshBlock& block,
    const std::vector<delaunayflip::MeshBlock>& constraints,
    delaunayflip::UpdateSummary& summary) override;
  bool HasTolerance() const override { return this->Tolerance >= 0.0; }

  /**
   * Asks for the flips of a mesh, all at once.
   * @param constraints may be null.
   */
  delaunayflip::FlipRequest MakeRequest(vtkPolyData* mesh, vtkPolyData* constraints);
#endif

  int Geometry = GEOMETRY_AUTO;
  int Criterion = CRITERION_IN_CIRCLE;
  double Tolerance = -1.0;
  int TieRule = TIE_RULE_KEEP;
  double FeatureAngle = 30.0;
  double MaximumDeviation = VTK_DOUBLE_MAX;
  std::string RegionArray;
  std::vector<std::array<double, 4>> Regions; ///< x, y, label and largest area of each.
  bool LinesAsConstraints = true;
  bool InsertConstraints = true;
  bool InsertLines = false;
  bool Triangulate = true;
  std::string Devices;
  int NumberOfPieces = 0;
  bool TrackQuality = false;
  bool GenerateFlipCount = false;
  bool GenerateQuality = false;

private:
#ifndef __VTK_WRAP__
  /**
   * Calls visit(name, property, member) for each property of this class that is an option of the
   * engine, but not for Devices, a text.
   */
  template <typename Visit>
  void ForEachOption(const Visit& visit) const;
#endif

  vtkDelaunayFlip(const vtkDelaunayFlip&) = delete;
  void operator=(const vtkDelaunayFlip&) = delete;
};

#endif
