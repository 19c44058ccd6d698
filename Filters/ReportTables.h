// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReportTables_h
#define ReportTables_h

class vtkFieldData;

namespace delaunayflip
{

struct FlipReport;
struct UpdateReport;

/// How the names of arrays begin in the field data of a mesh, where the user may have a "Seconds"
/// of his own. A table, which has nothing else, needs no prefix.
constexpr const char* FieldPrefix = "DelaunayFlip:";

/// Adds one array for each column of the iterations, with one tuple per iteration. Arrays of equal
/// names are replaced.
void AddIterationColumns(const FlipReport& report, const char* prefix, vtkFieldData* data);

/// Adds these columns, and arrays of one tuple that sum the run up, to the field data of a mesh.
/// Arrays of equal names are replaced.
void AddFieldData(const UpdateReport& report, vtkFieldData* data);

/// Does so where it was done before.
void RenewFieldData(const UpdateReport& report, vtkFieldData* data);

}

#endif
