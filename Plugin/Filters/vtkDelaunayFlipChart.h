// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipChart
 * @brief   prepare the iterations of vtkDelaunayFlip for a line chart
 *
 * The input is the table of iterations. The output has the columns to draw: Iteration, Flipped,
 * Excluded, Blocked, NonDelaunay, Tested and MinimumAngle, as double. Columns that the input lacks
 * are left out. A single row is repeated, because a line needs two points.
 */
#ifndef vtkDelaunayFlipChart_h
#define vtkDelaunayFlipChart_h

#include "vtkDelaunayFlipParaViewFiltersModule.h" // For export macro
#include "vtkTableAlgorithm.h"

class VTKDELAUNAYFLIPPARAVIEWFILTERS_EXPORT vtkDelaunayFlipChart : public vtkTableAlgorithm
{
public:
  static vtkDelaunayFlipChart* New();
  vtkTypeMacro(vtkDelaunayFlipChart, vtkTableAlgorithm);

  ///@{
  /**
   * For a logarithmic axis: replace counts of 0, which have no logarithm, by NaN, which is not
   * drawn. Even a single 0 would make ParaView draw a linear axis and warn. Default off.
   */
  vtkSetMacro(LogScale, bool);
  vtkGetMacro(LogScale, bool);
  vtkBooleanMacro(LogScale, bool);
  ///@}

protected:
  vtkDelaunayFlipChart() = default;
  ~vtkDelaunayFlipChart() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  bool LogScale = false;
};

#endif
