// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPDelaunayFlip
 * @brief   vtkDelaunayFlip for one mesh with its pieces on many ranks
 *
 * Every process of the controller has a piece of a mesh, and all of them update together. The edges
 * between pieces flip like all others, so that the result is that of one process: in planar
 * geometry with the canonical tie rule the same triangles; otherwise a mesh with no edge left that
 * may flip, which depends on how the mesh is divided, and on nothing else. With one process, or
 * without a controller, this filter is vtkDelaunayFlip.
 *
 * Input: a vtkPolyData on every process, which may be empty, or composite data on every process.
 * Each block of composite data is a mesh of its own. A process may have a piece of it in the same
 * place of the same structure, and null where it has none. Blocks that are no meshes pass
 * unchanged, with a warning. All partitions of a dataset, on all processes, are one mesh: a process
 * joins those that it has, as vtkDelaunayFlip does, and they are its piece. Points of several
 * pieces are the same if they have the same global id (active global ids of the point data, on all
 * processes that have points) or, without global ids, equal coordinates and one of them is at the
 * border of its piece. Points that coincide within a piece are then not matched, because it is not
 * known which of them is meant. A warning counts them; global ids made before the mesh is cut avoid
 * it. Duplicate ghost cells (vtkGhostType) are dropped first. Constraints (second input) may be on
 * any process, all or in part; they are matched by coordinates. The ends of lines
 * (LinesAsConstraints) are points of the process that has them, if need be without cells.
 * Constraints that are edges stay, wherever they are. In planar geometry a process inserts those
 * that lie within its piece. Others count as unmatched, with a warning: insert constraints before
 * the mesh is divided. Where triangles overlap or have no area, several processes insert none.
 *
 * Output: the piece of each process. Triangles may move to another process, with their cell data;
 * those that stayed come first, in their order, then those received. The points are those of the
 * input, the same vtkPoints object if none were received, else followed by received points with
 * their point data. Verts, lines and cells that are not flipped stay. If the process has several
 * partitions, the first one has all of this, and the others are empty.
 *
 * All results (GetTotalFlips() and the like, the field data) are those of the whole mesh, the same
 * on every process; only rank 0 has the table of iterations and gives messages. GetNumberOfRounds()
 * tells how often pieces were flipped and the edges between them tested. AbortExecute on any
 * process stops all of them. If one process fails, the update fails on all, with the same message.
 * It fails if properties differ between processes, and names one; only those of the hardware may
 * (Backend, NumberOfThreads, DeviceId, Devices, NumberOfPieces). MaximumIterations limits those of
 * all rounds together, where what processes do at the same time is one iteration.
 *
 * @warning
 * With several processes LiveUpdate is off, with a warning, and TrackQuality has no effect: only
 * the smallest angle after the last iteration is known. Every process must have an input, of the
 * same kind.
 *
 * @sa
 * vtkDelaunayFlip
 */
#ifndef vtkPDelaunayFlip_h
#define vtkPDelaunayFlip_h

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipFiltersParallelModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <vector> // For std::vector

class vtkMultiProcessController;

namespace delaunayflip
{
class PieceGroup;
}

class VTKDELAUNAYFLIPFILTERSPARALLEL_EXPORT vtkPDelaunayFlip : public vtkDelaunayFlip
{
public:
  static vtkPDelaunayFlip* New();
  vtkTypeMacro(vtkPDelaunayFlip, vtkDelaunayFlip);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The controller of the processes that have the pieces. Default: the global one. Null: the input
   * of this process is the whole mesh.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * If the last update flipped a mesh on several processes: how often the pieces were flipped and
   * the edges between them tested, and how many times a triangle changed owner. Else 0.
   */
  vtkGetMacro(NumberOfRounds, vtkIdType);
  vtkGetMacro(NumberOfMovedTriangles, vtkIdType);
  ///@}

protected:
  vtkPDelaunayFlip();
  ~vtkPDelaunayFlip() override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

#ifndef __VTK_WRAP__
  /**
   * The ranks that have the pieces of the input and update together, or null if this process flips
   * what it has alone.
   */
  virtual std::unique_ptr<delaunayflip::PieceGroup> MakeGroup();

  std::vector<delaunayflip::MeshBlock> ListBlocks(vtkDataObject* input,
    const std::vector<delaunayflip::MeshBlock>& constraints,
    delaunayflip::UpdateSummary& summary) override;
  void FlipLeaves(delaunayflip::MeshBlock& block,
    const std::vector<delaunayflip::MeshBlock>& constraints,
    delaunayflip::UpdateSummary& summary) override;
#endif

  vtkMultiProcessController* Controller = nullptr;
  vtkIdType NumberOfRounds = 0;
  vtkIdType NumberOfMovedTriangles = 0;

private:
  bool HasSeveralProcesses() const;

  std::unique_ptr<delaunayflip::PieceGroup> Group; ///< The last update's; null for one process.

  vtkPDelaunayFlip(const vtkPDelaunayFlip&) = delete;
  void operator=(const vtkPDelaunayFlip&) = delete;
};

#endif
