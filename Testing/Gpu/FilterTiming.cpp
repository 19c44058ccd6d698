// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterTiming.h"

#include "BenchmarkPolyData.h"
#include "RowTiming.h"

#include "vtkDelaunayFlip.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <stdexcept>

namespace delaunayflip
{

BenchmarkRow TimeFilter(const BenchmarkMesh& mesh, const RepetitionPlan& plan)
{
  BenchmarkRow row = MakeRow(mesh, "vtkDelaunayFlip: CUDA");
  Try(row,
    [&]
    {
      vtkNew<vtkDelaunayFlip> filter;
      filter->SetInputData(ToPolyData(mesh));
      filter->SetGeometry(static_cast<int>(mesh.Geometry));
      filter->SetBackendToCUDA();
      std::vector<double> times;
      row.Repetitions = Repeat(plan,
        [&](bool isWarm)
        {
          filter->Modified();
          LapWatch watch;
          filter->Update();
          const double time = watch.Lap();
          times.insert(times.end(), isWarm ? 1 : 0, time);
          return time;
        });
      if (filter->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
      {
        throw std::runtime_error("the filter failed");
      }
      row.Total = GetMedian(times);
      row.TotalFlips = filter->GetTotalFlips();
      row.Iterations = filter->GetNumberOfIterations();
      row.Left = filter->GetNumberOfNonDelaunayEdges();
      row.Note = "Update()";
    });
  return row;
}

}
