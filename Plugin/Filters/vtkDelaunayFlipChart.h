// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipChart
 * @brief   what a line chart of the iterations of vtkDelaunayFlip shows
 *
 * In goes the table of iterations, out come its columns that are worth a line: Iteration, Flipped,
 * Excluded, Blocked, NonDelaunay, Tested and MinimumAngle, as numbers of type double. Columns that
 * the table lacks are left out. A single row comes out twice, since a line takes two points.
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * For a logarithmic axis: leave out counts of 0, which have no logarithm (they become NaN). With
   * one of them ParaView would draw a linear axis and a warning. Default off.
   */
  vtkSetMacro(LogScale, bool);
  vtkGetMacro(LogScale, bool);
  vtkBooleanMacro(LogScale, bool);
  ///@}

protected:
  vtkDelaunayFlipChart();
  ~vtkDelaunayFlipChart() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  bool LogScale = false;

  vtkDelaunayFlipChart(const vtkDelaunayFlipChart&) = delete;
  void operator=(const vtkDelaunayFlipChart&) = delete;
};

#endif
