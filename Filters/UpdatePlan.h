// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdatePlan_h
#define UpdatePlan_h

#include "FlipReport.h"

class vtkPolyData;

namespace delaunayflip
{

/// What an update has to do, as far as it takes time.
struct UpdateWork
{
  vtkPolyData* Mesh;
  vtkPolyData* Constraints; ///< Or null.
  bool LinesAreConstraints;
  bool HasRegions;
  bool IsWarm; ///< Fixed edges of the first mesh have to be found, too.
  bool WantsAngles;
};

/// Turns the progress of each part of an update into that of the whole. The parts follow each other
/// in the order below; each gets the share of the time that it is expected to take.
class UpdatePlan
{
public:
  /// @param observer may be empty.
  UpdatePlan(const UpdateWork& work, ProgressObserver observer);

  ProgressObserver ForFixedEdges() const { return this->MakePartUpTo(FixedEdges); }
  ProgressObserver ForPolygons() const { return this->MakePartUpTo(Polygons); }
  ProgressObserver ForConstraints() const { return this->MakePartUpTo(Constraints); }
  ProgressObserver ForRegions() const { return this->MakePartUpTo(Regions); }
  ProgressObserver ForSession() const { return this->MakePartUpTo(Session); }
  ProgressObserver ForOutput() const { return this->MakePartUpTo(Output); }

private:
  enum Part
  {
    FixedEdges,
    Polygons,
    Constraints,
    Regions,
    Session,
    Output,
    NumberOfParts
  };

  ProgressObserver MakePartUpTo(Part part) const;

  ProgressObserver Observer;
  double Ends[NumberOfParts];
};

}

#endif
