// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReportTables_h
#define ReportTables_h

class vtkFieldData;

namespace delaunayflip
{

struct FlipReport;
struct UpdateReport;

/// The prefix of array names in the field data of a mesh, where the user may have an array
/// "Seconds" already. A table has no other columns and needs no prefix.
constexpr const char* FieldPrefix = "DelaunayFlip:";

/// Adds the columns of the iterations as arrays with one tuple per iteration. Replaces arrays with
/// the same names.
void AddIterationColumns(const FlipReport& report, const char* prefix, vtkFieldData* data);

/// Adds these columns, and one-tuple arrays that sum up the run, to the field data of a mesh.
/// Replaces arrays with the same names.
void AddFieldData(const UpdateReport& report, vtkFieldData* data);

/// Updates what AddFieldData has added to the field data of a mesh, if it has.
void RenewFieldData(const UpdateReport& report, vtkFieldData* data);

}

#endif
