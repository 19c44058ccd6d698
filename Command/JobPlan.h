// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_JOBPLAN_H
#define DELAUNAYFLIP_JOBPLAN_H

#include "MeshFormat.h"

namespace delaunayflip
{

/// At which share of a job's time, 0 .. 1, its parts are expected to end. The rest is for writing.
struct JobPlan
{
  double Read;
  double Flip;
};

/// By what each part took per triangle in files of these formats.
JobPlan PlanJob(MeshFormat input, MeshFormat output);

}

#endif
