// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_JOBPLAN_H
#define DELAUNAYFLIP_JOBPLAN_H

#include "MeshFormat.h"

namespace delaunayflip
{

/// The shares of a job's time, 0 .. 1, at which its parts are expected to end. Writing takes the
/// rest.
struct JobPlan
{
  double Read;
  double Flip;
};

/// Estimated from the measured times per triangle for these formats.
JobPlan PlanJob(MeshFormat input, MeshFormat output);

}

#endif
