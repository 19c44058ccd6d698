// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipAlgorithm
 * @brief   what the filters have in common
 *
 * This is the base class of the filters. It has their common properties (where they run, for how
 * many iterations, live updates) and tells what the last update did.
 *
 * @sa
 * vtkDelaunayFlip vtkDelaunayFlipPoints vtkDelaunayFlipInterpolator
 */
#ifndef vtkDelaunayFlipAlgorithm_h
#define vtkDelaunayFlipAlgorithm_h

#include "vtkDelaunayFlipFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

class vtkTable;

namespace delaunayflip
{
class FlipSession;
class RunKeeper;
struct FlipOptions;
struct FlipReport;
struct MeshBlock;
struct UpdateRequest;
struct UpdateSummary;
}

class VTKDELAUNAYFLIPFILTERS_EXPORT vtkDelaunayFlipAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkDelaunayFlipAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the flips run; the result is the same, bit for bit. AUTO (default) uses a GPU if there is
   * one that this build supports and the mesh has at least 20,000 triangles, or would have them. If
   * that GPU fails, for example because it runs out of memory, the CPU does the work and one
   * warning says why. CUDA uses a GPU for meshes of any size; the update fails if there is no GPU
   * or the GPU fails. THREADS uses CPU threads.
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
   * CUDA's number of the GPU to use, 0 or more; -1 (default): the current device of the thread that
   * updates, usually 0. If there is no such GPU, AUTO uses the CPU, with a warning if there are
   * others, and with CUDA the update fails. Has no effect on the CPU.
   */
  vtkSetClampMacro(DeviceId, int, -1, VTK_INT_MAX);
  vtkGetMacro(DeviceId, int);
  ///@}

  ///@{
  /**
   * The number of CPU threads; 0 (default): as many as the machine has. At most twice as many are
   * used, or 16 if that is more, and fewer if the system cannot start so many; GetBackendUsed()
   * tells how many there were. The result does not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * The most iterations to make; 0 makes none, and -1 (default) sets no limit. On surfaces -1 still
   * has a safety limit, the number of triangles + 1000, with a warning if it is reached. Reaching a
   * limit that you set gives no warning. StopReason tells of both, and the output is a valid mesh.
   */
  vtkSetClampMacro(MaximumIterations, vtkIdType, -1, VTK_ID_MAX);
  vtkGetMacro(MaximumIterations, vtkIdType);
  ///@}

  ///@{
  /**
   * Refinement: points are added until no angle is smaller than MinimumAngle (0 to 33 degrees), no
   * triangle has a larger area than MaximumArea, and no edge is longer than MaximumEdge; 0
   * (default): no limit. All three are measured in the plane, with PLANAR_XY in x and y. Segments,
   * the boundary and all edges that stay are split, but never crossed. Triangles that cannot get
   * better are left, and a warning counts them: such edges meet there at a small angle or must not
   * be split, or the height is only a few roundings of the coordinates.
   *
   * From points, the new points get z and point data that are linear between the others; in a
   * projection x, y and z are. A mesh in the plane or of terrain is refined once no edge is bad: z
   * and point data are linear in the mesh before, and each triangle gets the data of the cell that
   * contains its centroid, and so exactly the label of its region. Lines and verts, cells that are
   * not split (Triangulate), and ghost cells stay as they are. Refinement is an error on surfaces
   * and spheres, and for a mesh in several partitions or pieces.
   */
  vtkSetClampMacro(MinimumAngle, double, 0.0, 33.0);
  vtkGetMacro(MinimumAngle, double);
  vtkSetClampMacro(MaximumArea, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumArea, double);
  vtkSetClampMacro(MaximumEdge, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumEdge, double);
  ///@}

  ///@{
  /**
   * A point array of numbers: the longest edge that triangles may have near each point, linear in
   * between. NaN: no limit near that point. Points that only the second input of a triangulation
   * has, without such an array, get it from the first input, as they get all arrays that the second
   * one does not have (see SegmentHeights). "" (default): none.
   */
  vtkSetStdStringFromCharMacro(SizeArray);
  vtkGetCharFromStdStringMacro(SizeArray);
  ///@}

  ///@{
  /**
   * Split no edge of the boundary. Then angles there may stay small, or become smaller. Default
   * off.
   */
  vtkSetMacro(KeepBoundary, bool);
  vtkGetMacro(KeepBoundary, bool);
  vtkBooleanMacro(KeepBoundary, bool);
  ///@}

  ///@{
  /**
   * The most points that the mesh may have. Refinement stops when there are so many, and a
   * warning says so. 0 (default): ten times as many as are given, at least a million.
   */
  vtkSetClampMacro(PointLimit, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(PointLimit, vtkIdType);
  ///@}

  ///@{
  /**
   * Show the mesh while it improves: every update makes IterationsPerUpdate more iterations and
   * outputs the mesh, with its statistics, as it is then. Default off. The filter keeps the state
   * between updates, in memory of the host or of a GPU, until LiveUpdate is turned off. The last
   * mesh is bit-identical to that of an update without LiveUpdate.
   *
   * Request the next update by Advance():
   *
   *     do { flip->Update(); show(flip->GetOutput()); } while (flip->Advance());
   *
   * A change of the input, or of an option that decides the mesh or where and how it is computed,
   * starts a new run. After changing values in place, mark their array, vtkPoints or vtkCellArray
   * as modified; the dataset, or its point or cell data, is not enough. If only the points of a
   * mesh were moved, under the same cells, the next update continues from the flipped triangles,
   * with the edges that were fixed at the beginning (a warm start); its statistics start again. In
   * the plane with the canonical tie rule its triangles are those of an update without LiveUpdate
   * if no edge is left blocked, but they may be in other cells. Composite input, and a piece of
   * several, is flipped at once, with a warning. So is any input in ParaView's pvbatch, without a
   * warning.
   */
  vtkSetMacro(LiveUpdate, bool);
  vtkGetMacro(LiveUpdate, bool);
  vtkBooleanMacro(LiveUpdate, bool);
  ///@}

  ///@{
  /**
   * The number of iterations per update when LiveUpdate is on: 1 (default) or more, or 0 for as
   * many as fit into 50 ms, at least one. With 0 the intermediate meshes may differ between runs;
   * the last one and the table do not.
   */
  vtkSetClampMacro(IterationsPerUpdate, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(IterationsPerUpdate, vtkIdType);
  ///@}

  /**
   * Requests the next step of a live run: marks the filter as modified if there is more to do.
   * @returns whether there is more to do: false after convergence, the iteration limit or an error,
   * and without LiveUpdate.
   */
  bool Advance();

  ///@{
  /**
   * Pause a live run: while this is on, GetNeedsUpdate() returns false; Advance() and Step() still
   * work. Default off. Setting it does not mark the filter as modified, since that would cause a
   * step.
   */
  void SetPaused(bool paused) { this->Paused = paused; }
  vtkGetMacro(Paused, bool);
  vtkBooleanMacro(Paused, bool);
  ///@}

  /**
   * Requests one more step of a live run, paused or not, as Advance() does. For a button.
   */
  bool Step() { return this->Advance(); }

  /**
   * Makes the next update of a live run start from the input again, also when an observer calls
   * this during an update.
   */
  void Restart();

  /**
   * For programs that poll, such as ParaView with a LiveSource: the same as Advance(), but returns
   * false before the first update, after an abort and while Paused is on.
   */
  bool GetNeedsUpdate();

  /**
   * Frees the memory, on GPUs and on the host, that the CUDA backend keeps for the next update. All
   * filters of a process share it; updates that are running in other threads keep theirs. The next
   * update on a GPU starts a little slower. A filter that has been updated does this when it is
   * deleted. Never fails; does nothing if no GPU was used.
   */
  void ReleaseDeviceMemory();

  /// The table of iterations, output port 1.
  vtkTable* GetIterations();

  ///@{
  /**
   * What the last update did. With several blocks, NumberOfIterations is the largest of
   * theirs and TotalFlips the sum. In an observer of ProgressEvent they are those of the current
   * block so far. Progress is the estimated share of the update's time that has passed, from the
   * splitting of polygons and the matching of constraints to the output. AbortExecute is checked
   * whenever progress is reported: for a million triangles at least every 0.1 s. If aborted before
   * the first iteration, the output has the triangles of the input, or its polygons if these had
   * not all been read; if later, those of the last iteration. AbortExecute is off again at the end,
   * and a live run goes on with the next update.
   */
  vtkIdType GetNumberOfIterations() const;
  vtkIdType GetTotalFlips() const;
  ///@}

  /**
   * How many bad edges, neither locally Delaunay nor fixed, are left after the last update; the sum
   * over blocks.
   */
  vtkIdType GetNonDelaunayAfter() const;

  /**
   * Whether the last update ended because an iteration found no edge that may flip.
   */
  bool GetConverged() const;

  ///@{
  /**
   * Why the last update ended. NOT_STARTED before the first update; RUNNING if a live update has
   * made its iterations and there is more to do; FAILED after an error, with empty outputs and the
   * text "failed: " and the reason. Once the cause is removed, the next update works. With several
   * blocks, the worst of their reasons.
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

  /**
   * What the last update did, for people: a line each for the mesh, the edges that were kept and by
   * what, the geometry and why, the bad edges and the smallest angle (degrees) before and after,
   * and the flips. Each line is a title, ": " and a text. After an error "failed: " and the reason;
   * "" before the first update and for a mesh without triangles.
   */
  const char* GetSummary() const;

  /**
   * Where the last update ran, e.g. "Threads: 8" or "CUDA: NVIDIA H200", or "Threads: 8, CUDA:
   * NVIDIA H200" if blocks differ. "" before the first update, after an error and for a mesh
   * without triangles.
   */
  const char* GetBackendUsed() const;

  ///@{
  /**
   * What caused the last update to fail. FAILURE_OPTIONS: options contradict each other or the
   * mesh. FAILURE_MESH: there is no mesh, it names points that do not exist, or it is too large.
   * FAILURE_BACKEND: the backend cannot run here. FAILURE_OTHER: no memory. FAILURE_NONE before the
   * first update and after success. GetErrorCode() returns vtkErrorCode::UnknownError after all of
   * them, else vtkErrorCode::NoError.
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
   * Why the last update failed, in words; "" before the first update and after success.
   */
  const char* GetErrorMessage() const;

  /**
   * The full report of the last update, for C++ callers that include FlipReport.h.
   */
#ifndef __VTK_WRAP__
  const delaunayflip::FlipReport& GetReport() const;

  /**
   * The ring that made the last update fail, a cell id of the second input; -1: none.
   */
  vtkIdType GetFailedRing() const { return this->FailedRing; }
#endif

  ///@{
  /**
   * For C++ callers that draw a live run from the memory of a GPU, where the mesh is already.
   *
   * AdvanceSession() makes the next step of a live run, as Advance() and an update do. But it
   * leaves output port 0 as it was in two cases: if it continues the run of the last update, and if
   * a vtkDelaunayFlipPoints has followed its points (see KeepSession there). In the second case
   * there may be more or fewer triangles than before. In both, GetMeshIsWithheld() is true, and the
   * next update, by whatever is connected to the port, puts the mesh out and makes no step. Port 1
   * and all results are those of the step. AdvanceSession() returns false if the executive failed.
   *
   * GetSession() returns the session of the last update, or null if LiveUpdate is off, the update
   * failed or the mesh is refined. It is valid until the next update. Its triangles are the
   * polygons of the output, in their order, if the input has no other polygons than triangles and
   * no strips, and if a vtkDelaunayFlipPoints does not sort them (see KeepSession there).
   */
#ifndef __VTK_WRAP__
  bool AdvanceSession();
  bool GetMeshIsWithheld() const;
  const delaunayflip::FlipSession* GetSession() const;
#endif
  ///@}

protected:
  vtkDelaunayFlipAlgorithm();
  ~vtkDelaunayFlipAlgorithm() override;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

#ifndef __VTK_WRAP__
  // What subclasses do, and what they need for it; the headers of the types are private.

  /**
   * The meshes of the input. Adds warnings of what of the second input is ignored. May throw; the
   * update then fails.
   * @param others the blocks of the second input.
   */
  virtual std::vector<delaunayflip::MeshBlock> ListBlocks(vtkDataObject* input,
    const std::vector<delaunayflip::MeshBlock>& others, delaunayflip::UpdateSummary& summary);

  /**
   * Flips a block: reads its mesh, updates the run, and stores the results. Adds warnings beside
   * those of the report. May throw.
   * @param others the blocks of the second input.
   */
  virtual void FlipLeaves(delaunayflip::MeshBlock& block,
    const std::vector<delaunayflip::MeshBlock>& others, delaunayflip::UpdateSummary& summary) = 0;

  /**
   * Whether the user has set a tolerance of angles.
   */
  virtual bool HasTolerance() const { return false; }

  /**
   * Gives a request what does not depend on the mesh: how many iterations an update makes, how it
   * reports progress and is aborted, and the options that are properties of this class.
   */
  void FillRequest(delaunayflip::UpdateRequest& request, delaunayflip::FlipOptions& options);

  std::unique_ptr<delaunayflip::RunKeeper> Runs;

  /// During an update that of the current mesh, afterwards the sum over all meshes.
  std::unique_ptr<delaunayflip::FlipReport> Report;
#endif

  const char* InputType = "vtkPolyData"; ///< The first input's, unless it is composite.
  bool KeepsType = false; ///< Output port 0 has the first input's type; else a vtkPolyData.
  bool HasSteps = true; ///< LiveUpdate has an effect.
  int SizeOfBlocks; ///< What it is measured by: vtkDataObject::CELL (default) or POINT.
  int SizeOfOthers; ///< What the second input is measured by.
  bool IsSilent = false; ///< Gives no messages and no rows of the table.
  int Backend = BACKEND_AUTO;
  int DeviceId = -1;
  int NumberOfThreads = 0;
  vtkIdType MaximumIterations = -1;
  double MinimumAngle = 0.0;
  double MaximumArea = 0.0;
  double MaximumEdge = 0.0;
  bool KeepBoundary = false;
  vtkIdType PointLimit = 0;
  std::string SizeArray;
  bool LiveUpdate = false;
  vtkIdType IterationsPerUpdate = 1;
  bool Paused = false;
  int Failure = FAILURE_NONE;
  vtkIdType FailedRing = -1;

private:
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  void FlipBlock(delaunayflip::MeshBlock& block, const std::vector<delaunayflip::MeshBlock>& others,
    delaunayflip::UpdateSummary& summary);
  void Keep(const delaunayflip::UpdateSummary& summary);
  void Publish(const delaunayflip::UpdateSummary& summary);
  void RefuseInput(const std::string& why);
#ifndef __VTK_WRAP__
  /**
   * Calls visit(name, property, member) for each property of this class that is an option of the
   * engine.
   */
  template <typename Visit>
  void ForEachOption(const Visit& visit) const;
#endif

  std::string ErrorMessage;
  std::string StopReasonText; ///< After an error.
  std::string Summary;
  bool IsAtWork = false; ///< An update is running, and another one is refused.
  bool IsRestarted = false; ///< Restart() was called since the last update began.

  vtkDelaunayFlipAlgorithm(const vtkDelaunayFlipAlgorithm&) = delete;
  void operator=(const vtkDelaunayFlipAlgorithm&) = delete;
};

#endif
