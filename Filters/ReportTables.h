// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReportTables_h
#define ReportTables_h

class vtkFieldData;

namespace delaunayflip
{

struct FlipReport;

/// Adds one array for each column of the iterations, with one tuple an iteration. Arrays of equal
/// names are replaced.
void AddIterationColumns(const FlipReport& report, vtkFieldData* data);

/// Adds the arrays of one tuple that sum the run up. Arrays of equal names are replaced.
void AddTotals(const FlipReport& report, vtkFieldData* data);

}

#endif
