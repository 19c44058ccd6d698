// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlip
 * @brief   turn a triangle mesh into a Delaunay mesh by parallel edge flips
 *
 * vtkDelaunayFlip keeps the points of a mesh where they are and changes only how they are joined:
 * in every iteration it flips, in parallel, an independent set of edges that are not locally
 * Delaunay, until none is left that it may flip.
 *
 * What goes in: any vtkPolyData, also as a block of a composite dataset. Triangles are flipped;
 * quads, polygons and triangle strips are split into triangles first (see Triangulate). Nothing is
 * assumed about the mesh: it may be open, non-manifold, of mixed winding, with duplicate,
 * degenerate or unused parts. What is not provably safe to flip stays as it is and is counted.
 * The optional second input holds constraint edges as lines and polygons, over the same point ids
 * or at the same places (SetConstraintsConnection()); lines of the first input are constraints too
 * (LinesAsConstraints).
 *
 * What comes out: on port 0 the mesh, with the very same vtkPoints object and point data, verts
 * and lines, and with every triangle in the slot, and with the cell data, that it came with.
 * Triangles that no flip touched are bit-identical. Active cell normals are computed anew for
 * changed triangles. Where a cell was split, global cell ids become pedigree ids, since they are no
 * longer unique. Output cells are ordered verts, lines, polygons (triangles of strips after those
 * of the polygons), strips; cells of fewer than three points pass as they are. On port 1 a vtkTable
 * with one row per iteration: Iteration, Tested, NonDelaunay, Flipped, Excluded, Blocked,
 * MinimumAngle (degrees; NaN where it was not computed) and Seconds. Port 0 carries the same
 * columns as field data, beside one-value arrays: Converged, StopReason, TotalFlips,
 * NonDelaunayEdges, FixedEdges, NonManifoldEdges, ConstraintEdges, UnmatchedConstraintEdges,
 * GeometryUsed, GeometryReason, Tolerance ("automatic", the value, or "none" where the in-circle
 * predicate decides) and Backend. In the field data each name begins with "DelaunayFlip:", e.g.
 * "DelaunayFlip:Flipped", so that arrays of the input with such names pass. Input without
 * triangles, polygons or strips passes as a shallow copy, with a table of no rows.
 *
 * Edges that never flip: boundary, non-manifold and wrongly wound edges, feature edges of surfaces
 * (FeatureAngle), constraint edges, borders between regions (RegionArray) and the edges of ghost
 * cells (vtkGhostType: duplicate, refined or hidden).
 *
 * How it differs from its neighbours: vtkDelaunay2D makes a triangulation of points from nothing
 * and in x and y only; this filter improves a mesh that exists, planar in any orientation or a
 * surface in space, keeps its holes, borders and constraints, and is exact in the plane: by default
 * each edge is judged by an error-free in-circle predicate.
 *
 * Where the work is done: on a GPU, in a build with the CUDA backend, where there is one and the
 * mesh is large enough for it, else on threads of the CPU (see Backend). The same input gives the
 * same output, bit for bit, on either and for any number of threads; Seconds and Backend are the
 * only values that may differ.
 *
 * @warning
 * Points that do not belong to any triangle stay unused: nothing is inserted. On surfaces the
 * result is Delaunay in the sense of opposite-angle sums, and an edge whose flip would fold the
 * surface or duplicate an edge stays and is reported as blocked.
 *
 * Composite input (multiblock, partitioned): every polygonal block is flipped by itself, others
 * pass with a warning; an error empties the block that it names, and the others are flipped. The
 * read-back methods and the table, of which there is one, sum up all blocks; the field data of a
 * block are its own. Composite constraints of the same structure are taken block by block. The same
 * sums are made over the pieces of a parallel run, where the ranks of the global
 * vtkMultiProcessController, as in ParaView, update a piece each: all of them must update together.
 * Rank 0 has the table, and gives the messages.
 *
 * @warning
 * Edges between the pieces of a parallel run, or between the partitions of a dataset, stay, and the
 * counts do not know of them. An update that leaves such edges gives a warning.
 *
 * @par References
 * C. Navarro, N. Hitschfeld, E. Scheihing: "A GPU-based method for generating quasi-Delaunay
 * triangulations based on edge-flips", GRAPP 2013 (the parallel method).
 * C. L. Lawson: "Software for C1 surface interpolation", in Mathematical Software III, 1977 (edge
 * flips end in the Delaunay triangulation).
 * J. R. Shewchuk: "Adaptive precision floating-point arithmetic and fast robust geometric
 * predicates", Discrete & Computational Geometry 18, 1997.
 *
 * @sa
 * vtkDelaunay2D vtkFeatureEdges vtkTriangleFilter
 */
#ifndef vtkDelaunayFlip_h
#define vtkDelaunayFlip_h

#include "vtkDelaunayFlipFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For meshes of inputs

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkCompositeDataSet;
class vtkTable;

namespace delaunayflip
{
class FlipRun;
struct Block;
struct FlipOptions;
struct FlipReport;
struct IterationRecord;
struct MeshOutcome;
struct UpdateReport;
struct UpdateSummary;
enum class StopReasonKind;
}

class VTKDELAUNAYFLIPFILTERS_EXPORT vtkDelaunayFlip : public vtkPolyDataAlgorithm
{
public:
  static vtkDelaunayFlip* New();
  vtkTypeMacro(vtkDelaunayFlip, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * In which space edges are judged. PLANAR judges in the plane of the points, whatever its
   * orientation, and is an error if there is none. PLANAR_XY judges by x and y and lets z ride
   * along (terrain). SURFACE judges in space, by opposite-angle sums. AUTO (default) is the first
   * of these that fits:
   *
   * PLANAR when all used points lie in one plane, within 1e-6 of the diagonal of their bounding
   * box.
   *
   * PLANAR_XY when the mesh is a height field over x and y (all triangles but at most one in 1,000
   * have area there and turn the same way, and around no point they turn more than once) and either
   * z extends further than x and y, as with degrees and metres, or 95 % of the area slopes below 45
   * degrees. The slope of a sliver is that of its steepest edge: planes of slivers are steep in the
   * gentlest terrain.
   *
   * SURFACE else. One warning is given where only a few triangles, less than one in 100, stood
   * against PLANAR_XY. Ask for PLANAR_XY where terrain is steeper.
   *
   * GetGeometryReason() says why. Where SURFACE is used on a height field, by choice or not, and
   * its flips turn triangles over in x and y, a warning counts them.
   */
  enum GeometryType
  {
    GEOMETRY_AUTO = 0,
    GEOMETRY_PLANAR = 1,
    GEOMETRY_PLANAR_XY = 2,
    GEOMETRY_SURFACE = 3,
    GEOMETRY_MIXED = 4 ///< Of GetGeometryUsed() only.
  };
  vtkSetClampMacro(Geometry, int, GEOMETRY_AUTO, GEOMETRY_SURFACE);
  vtkGetMacro(Geometry, int);
  void SetGeometryToAuto() { this->SetGeometry(GEOMETRY_AUTO); }
  void SetGeometryToPlanar() { this->SetGeometry(GEOMETRY_PLANAR); }
  void SetGeometryToPlanarXY() { this->SetGeometry(GEOMETRY_PLANAR_XY); }
  void SetGeometryToSurface() { this->SetGeometry(GEOMETRY_SURFACE); }
  ///@}

  ///@{
  /**
   * How an edge is judged. IN_CIRCLE (default) is the exact predicate of planar geometry.
   * OPPOSITE_ANGLES is the criterion of the literature: the two angles opposite the edge sum to
   * more than pi + Tolerance. Surfaces always use OPPOSITE_ANGLES.
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
   * By how many radians an opposite-angle sum must exceed pi. At least 0 and below 1, or -1
   * (default), else the update fails. -1 is automatic: each edge has its own tolerance, as large as
   * the change of its sum that a unit in the last place of its points' coordinates (float or
   * double) may cause. It grows with the distance from the origin and with short edges. A surface
   * that is Delaunay within the precision of its points comes back bit-identical then. Without
   * effect on the in-circle criterion, which is exact.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * What happens to an edge whose four points lie on one circle exactly. KEEP (default) leaves it,
   * so that a Delaunay mesh comes back bit-identical. CANONICAL makes the result independent of the
   * triangles of the input; it needs planar geometry and the in-circle criterion, else the update
   * fails.
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
   * On surfaces, an edge stays when the normals of its two triangles differ by more than this many
   * degrees in the input. 0 to 180; default 30; 180 turns feature edges off.
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * Name of a cell array, numeric or of strings, with any number of components, that tells
   * regions apart: edges between triangles of different values stay. Default none ("" or null);
   * the update fails if the input has no such array.
   */
  vtkSetStdStringFromCharMacro(RegionArray);
  vtkGetCharFromStdStringMacro(RegionArray);
  ///@}

  ///@{
  /**
   * Keep the edges along the lines of the input (every pair of consecutive points of its polylines)
   * that are edges of the mesh. Default on. Lines pass to the output in any case.
   */
  vtkSetMacro(LinesAsConstraints, bool);
  vtkGetMacro(LinesAsConstraints, bool);
  vtkBooleanMacro(LinesAsConstraints, bool);
  ///@}

  ///@{
  /**
   * Split quads, polygons and triangle strips into triangles and flip those too. A quad is cut
   * along the diagonal of its first and third point unless that runs outside it; a larger polygon
   * becomes a fan where it is convex, else its ears are clipped. Default on. Off: such cells pass
   * untouched and their edges stay (in the counts they take part as the triangles they would
   * become, none of whose edges may flip).
   */
  vtkSetMacro(Triangulate, bool);
  vtkGetMacro(Triangulate, bool);
  vtkBooleanMacro(Triangulate, bool);
  ///@}

  ///@{
  /**
   * Where the flips run; the result is the same, bit for bit. AUTO (default) takes a GPU where
   * there is one that this build can use and there are at least 20,000 triangles, after polygons
   * and strips were split; where that GPU fails, for want of memory say, the CPU does the work and
   * the update gives one warning that says why. CUDA is a GPU for meshes of any size, and the
   * update fails if there is none or if it fails. THREADS are those of the CPU.
   */
  enum BackendType
  {
    BACKEND_AUTO = 0,
    BACKEND_CUDA = 1,
    BACKEND_THREADS = 2
  };
  vtkSetClampMacro(Backend, int, BACKEND_AUTO, BACKEND_THREADS);
  vtkGetMacro(Backend, int);
  void SetBackendToAuto() { this->SetBackend(BACKEND_AUTO); }
  void SetBackendToCUDA() { this->SetBackend(BACKEND_CUDA); }
  void SetBackendToThreads() { this->SetBackend(BACKEND_THREADS); }
  ///@}

  ///@{
  /**
   * CUDA's number of the GPU to use, 0 or more; -1 (default): the one that is current in the thread
   * that updates, usually 0. Where there is no such GPU, AUTO warns and takes the CPU, and CUDA
   * fails. Without effect where the flips run on the CPU.
   */
  vtkSetClampMacro(DeviceId, int, -1, VTK_INT_MAX);
  vtkGetMacro(DeviceId, int);
  ///@}

  ///@{
  /**
   * Threads to use; 0 (default): as many as the machine has. The result does not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Upper limit of iterations: -1 (default) goes on until no edge can flip, 0 makes none. On
   * surfaces -1 has a safety limit of the number of triangles + 1000, which gives a warning when it
   * is reached; a limit that was asked for gives none. StopReason tells of either, and the output
   * is a valid mesh.
   */
  vtkSetClampMacro(MaximumIterations, vtkIdType, -1, VTK_ID_MAX);
  vtkGetMacro(MaximumIterations, vtkIdType);
  ///@}

  ///@{
  /**
   * Compute the smallest angle of the mesh after every iteration instead of only after the first
   * and the last. Costs a pass over the mesh each time. Default off.
   */
  vtkSetMacro(TrackQuality, bool);
  vtkGetMacro(TrackQuality, bool);
  vtkBooleanMacro(TrackQuality, bool);
  ///@}

  ///@{
  /**
   * Add the cell array vtkDelaunayFlipCount (int): how often each triangle was part of a flip; 0
   * for other cells. Default off.
   */
  vtkSetMacro(GenerateFlipCount, bool);
  vtkGetMacro(GenerateFlipCount, bool);
  vtkBooleanMacro(GenerateFlipCount, bool);
  ///@}

  ///@{
  /**
   * Add the cell arrays vtkDelaunayFlipAngleBefore and vtkDelaunayFlipAngleAfter (double): the
   * smallest angle of each triangle in degrees, 0 to 60, in space or, with PLANAR_XY, in the
   * projection. Before is that of the triangle which the input, its polygons split, had in the same
   * place. 0 where a triangle has no area; NaN where a coordinate is NaN or infinite, and for cells
   * that are no triangles. Default off.
   */
  vtkSetMacro(GenerateQuality, bool);
  vtkGetMacro(GenerateQuality, bool);
  vtkBooleanMacro(GenerateQuality, bool);
  ///@}

  ///@{
  /**
   * Let the mesh be seen while it improves: every update makes IterationsPerUpdate more iterations
   * and gives the mesh, and what is told of it, as they are then. Default off. The filter keeps the
   * state from one update to the next, in memory of the host or of a GPU, until it is turned off.
   * The last of these meshes is, bit for bit, the one of an update without LiveUpdate.
   *
   * Ask for the next update with Advance():
   *
   *     do { flip->Update(); show(flip->GetOutput()); } while (flip->Advance());
   *
   * Another input or option starts again. When only points were moved, under the same cells, the
   * next update starts from the triangles that flips have made, with the edges that were fixed at
   * the beginning (a warm start); its statistics begin anew. Composite input and input in several
   * pieces (a parallel run) are flipped at once, with a warning, and so, silently, is input in
   * ParaView's pvbatch.
   */
  vtkSetMacro(LiveUpdate, bool);
  vtkGetMacro(LiveUpdate, bool);
  vtkBooleanMacro(LiveUpdate, bool);
  ///@}

  ///@{
  /**
   * Iterations that an update makes when LiveUpdate is on: 1 (default) or more, or 0 for as many as
   * fit 50 ms, at least one. With 0 the meshes on the way may differ from run to run; the last one
   * and the table do not.
   */
  vtkSetClampMacro(IterationsPerUpdate, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(IterationsPerUpdate, vtkIdType);
  ///@}

  /**
   * Lets the next update of a live run go on: marks the filter as modified, if there is more to do.
   * @returns whether there is: not after convergence, the iteration limit or an error, nor without
   * LiveUpdate.
   */
  bool Advance();

  ///@{
  /**
   * Hold a live run: while this is on, GetNeedsUpdate() returns false; Advance() and Step() still
   * work. Default off. To set it does not mark the filter as modified, for that would make a step.
   */
  void SetPaused(bool paused) { this->Paused = paused; }
  vtkGetMacro(Paused, bool);
  vtkBooleanMacro(Paused, bool);
  ///@}

  /**
   * As Advance(): one more update of a live run, paused or not. For a button beside Paused.
   */
  bool Step() { return this->Advance(); }

  /**
   * Lets the next update of a live run start from the input again.
   */
  void Restart();

  /**
   * For programs that poll (ParaView's LiveSource): as Advance(), but false before the first
   * update, after an abort and while Paused.
   */
  bool GetNeedsUpdate();

  ///@{
  /**
   * Constraint edges, optional: the edges along the lines and polygons of this input stay where
   * they are edges of the mesh. Where it has no points, or the very points of the first input (as
   * many, the same bits), its point ids are those of the mesh, as with the source of vtkDelaunay2D.
   * Else edges are matched by the coordinates of their points, so that the output of
   * vtkFeatureEdges, which numbers points anew, can be used. These must be equal, not near; where
   * one of the inputs has float points and the other double ones, they are compared after rounding
   * to float. Where several points of the mesh coincide, every pair of them that is an edge of the
   * mesh is meant. Constraint edges that match none are counted, and the update gives one warning.
   */
  void SetConstraintsConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(1, port); }
  void SetConstraintsData(vtkPolyData* constraints);
  ///@}

  /**
   * Gives back the memory, of GPUs and of the host, that the CUDA backend keeps from one update for
   * the next. All filters of a process share it; updates under way in other threads keep theirs.
   * The next update on a GPU begins a little slower. A filter that has been updated does this when
   * it is deleted. Never fails; does nothing where no GPU was used.
   */
  void ReleaseDeviceMemory();

  /// The table of iterations, output port 1.
  vtkTable* GetIterations();

  ///@{
  /**
   * What the last update did: over blocks and pieces NumberOfIterations is the largest, TotalFlips
   * the sum. From an observer of ProgressEvent, they are those of the current block up to now.
   * Progress is an estimate of the share of the time that has passed, from the split of polygons
   * and the search for edges on; AbortExecute is looked at whenever it is told, every 0.1 s or more
   * often for a million triangles. Aborted before the first iteration, the output holds the
   * triangles of the input, or its polygons where those were still being split.
   */
  vtkIdType GetNumberOfIterations() const;
  vtkIdType GetTotalFlips() const;
  ///@}

  ///@{
  /**
   * How many edges of the mesh the lines of the first input and the constraints of the second hold,
   * and how many constraint edges match no edge of the mesh. After a warm start, as at the
   * beginning. Sums as TotalFlips: where all blocks share the constraints, an edge is unmatched
   * once for each block that does not have it.
   */
  vtkIdType GetNumberOfConstraintEdges() const;
  vtkIdType GetNumberOfUnmatchedConstraintEdges() const;
  ///@}

  /**
   * Edges left that are not Delaunay and not fixed, after the last update; a sum as TotalFlips.
   */
  vtkIdType GetNumberOfNonDelaunayEdges() const;

  /**
   * Whether the last update ended because an iteration found nothing that it may flip.
   */
  bool GetConverged() const;

  ///@{
  /**
   * Why the last update ended. NOT_STARTED before any; RUNNING when a live update has made its
   * iterations and more are to come; FAILED after an error, when the outputs are empty and the text
   * is "failed: " and why. The update after an error needs nothing but what puts it right. Over
   * blocks and pieces it is the worst of all.
   */
  enum StopReasonType
  {
    STOP_REASON_NOT_STARTED = 0,
    STOP_REASON_CONVERGED = 1,
    STOP_REASON_ITERATION_LIMIT = 2,
    STOP_REASON_ABORTED = 3,
    STOP_REASON_RUNNING = 4,
    STOP_REASON_FAILED = 5
  };
  int GetStopReason() const;
  const char* GetStopReasonAsString() const;
  ///@}

  ///@{
  /**
   * The geometry that the last update used, one of GeometryType; GEOMETRY_AUTO before any, after an
   * error and for a mesh without triangles; GEOMETRY_MIXED, "mixed", if blocks or pieces differ.
   */
  int GetGeometryUsed() const;
  const char* GetGeometryUsedAsString() const;
  ///@}

  /**
   * Why the last update used that geometry, in plain English, e.g. "all points lie in one plane;
   * the feature angle has no effect". "" when GetGeometryUsed() is GEOMETRY_AUTO.
   */
  const char* GetGeometryReason() const;

  /**
   * Where the last update ran, e.g. "Threads: 8" or "CUDA: NVIDIA H200", or "Threads: 8, CUDA:
   * NVIDIA H200" where blocks differ; "" before any, after an error and for a mesh without
   * triangles.
   */
  const char* GetBackendUsed() const;

  ///@{
  /**
   * What was at fault when the last update failed: FAILURE_OPTIONS contradict each other or the
   * mesh, FAILURE_MESH names points that do not exist or is too large, FAILURE_BACKEND cannot run
   * here, FAILURE_OTHER (no memory). FAILURE_NONE before any update and after one that succeeded.
   * GetErrorCode() is then vtkErrorCode::UserError plus this number, or vtkErrorCode::NoError.
   */
  enum FailureType
  {
    FAILURE_NONE = 0,
    FAILURE_OPTIONS = 1,
    FAILURE_MESH = 2,
    FAILURE_BACKEND = 3,
    FAILURE_OTHER = 4
  };
  vtkGetMacro(Failure, int);
  ///@}

  /**
   * Why the last update failed, in words; "" before any update and after one that succeeded.
   */
  const char* GetErrorMessage() const;

  /**
   * Everything that is known of the last update, for C++ callers that include FlipReport.h.
   */
#ifndef __VTK_WRAP__
  const delaunayflip::FlipReport& GetReport() const;
#endif

protected:
  vtkDelaunayFlip();
  ~vtkDelaunayFlip() override;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * The mesh that an input, or a block of it, is; null if it is none. For subclasses that know more
   * surfaces than vtkPolyData. The same object as long as the input is the same. May throw
   * std::invalid_argument where the input contradicts itself: the update fails, with its text.
   */
  virtual vtkSmartPointer<vtkPolyData> GetMesh(vtkDataObject* input);

  int Geometry = GEOMETRY_AUTO;
  int Criterion = CRITERION_IN_CIRCLE;
  double Tolerance = -1.0;
  int TieRule = TIE_RULE_KEEP;
  double FeatureAngle = 30.0;
  std::string RegionArray;
  bool LinesAsConstraints = true;
  bool Triangulate = true;
  int Backend = BACKEND_AUTO;
  int DeviceId = -1;
  int NumberOfThreads = 0;
  vtkIdType MaximumIterations = -1;
  bool TrackQuality = false;
  bool GenerateFlipCount = false;
  bool GenerateQuality = false;
  bool LiveUpdate = false;
  vtkIdType IterationsPerUpdate = 1;
  bool Paused = false;

private:
  struct Connection;

  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  delaunayflip::UpdateSummary FlipMesh(
    vtkDataObject* input, vtkDataObject* constraints, vtkPolyData* output, bool isPiece);
  delaunayflip::UpdateSummary FlipBlocks(
    vtkCompositeDataSet* input, vtkDataObject* constraints, vtkCompositeDataSet* output);
  vtkSmartPointer<vtkDataObject> FlipBlock(const delaunayflip::Block& block,
    vtkPolyData* constraints, delaunayflip::UpdateSummary& summary);
  delaunayflip::MeshOutcome TryToFlip(const Connection& data);
  void Flip(const Connection& data);
  void Tell(const delaunayflip::UpdateSummary& summary, bool aloud);
  delaunayflip::FlipOptions GetOptions() const;
  void PassInput(const Connection& data, delaunayflip::StopReasonKind reason);
  std::unique_ptr<delaunayflip::FlipRun> GoOn(
    std::unique_ptr<delaunayflip::FlipRun> last, const Connection& data);
  bool Advance(delaunayflip::FlipRun& run, bool isLive);
  bool Observe(const delaunayflip::IterationRecord& record);
  bool ObserveProgress(double fraction);

  int Failure = FAILURE_NONE;
  std::string ErrorMessage;
  std::string StopReasonText; ///< After an error.
  bool HasExecuted = false;
  bool IsAtWork = false; ///< Within an update.
  bool MayGoOn = true; ///< Whether another live update can change the mesh.
  std::unique_ptr<delaunayflip::FlipRun> Run; ///< Of live updates.
  std::unique_ptr<delaunayflip::UpdateReport> Report; ///< Of the mesh under way; then, of all.

  vtkDelaunayFlip(const vtkDelaunayFlip&) = delete;
  void operator=(const vtkDelaunayFlip&) = delete;
};

#endif
