// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipText
 * @brief   statistics of vtkDelaunayFlip as a text for a render view
 *
 * The input is the mesh of vtkDelaunayFlip, with its statistics as field data. The output is a
 * table with one string in a column Text, which ParaView draws in its render views: the summary of
 * the update, with lines broken for half of a window. During a live run the text is updated with
 * every frame. For another mesh the text says that there are no statistics. Only a build for
 * ParaView has this class.
 */
#ifndef vtkDelaunayFlipText_h
#define vtkDelaunayFlipText_h

#include "vtkDelaunayFlipFiltersModule.h" // For export macro
#include "vtkTableAlgorithm.h"

class VTKDELAUNAYFLIPFILTERS_EXPORT vtkDelaunayFlipText : public vtkTableAlgorithm
{
public:
  static vtkDelaunayFlipText* New();
  vtkTypeMacro(vtkDelaunayFlipText, vtkTableAlgorithm);

protected:
  vtkDelaunayFlipText() = default;
  ~vtkDelaunayFlipText() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
};

#endif
