// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyReader.h"

#include "Console.h"
#include "TextCursor.h"

#include <vtkNew.h>
#include <vtkPolyDataReader.h>

#include <strings.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>

namespace delaunayflip
{

namespace
{

/// Checks what VTK's reader does not say well.
void CheckHead(const InputFile& file)
{
  TextCursor cursor(file);
  if (cursor.RestOfLine().rfind("# vtk DataFile Version", 0) != 0)
  {
    file.Fail("not a VTK file (it does not start with '# vtk DataFile Version')");
  }
  cursor.SkipLine();
  cursor.SkipLine(); // the title
  cursor.SkipSpace();
  cursor.NextWord(); // ASCII or BINARY
  cursor.SkipSpace();
  const std::string keyword(cursor.NextWord());
  const std::string type(cursor.NextWord());
  if (strcasecmp(keyword.c_str(), "dataset") == 0 && strcasecmp(type.c_str(), "polydata") != 0)
  {
    FailOnType(file, type);
  }
}

/// Compares the counts of a file with what VTK read: on some faults it gives up a part of the mesh
/// and says nothing.
class LegacyCounts
{
public:
  explicit LegacyCounts(const InputFile& file)
    : File(file)
  {
    constexpr std::size_t prefix = std::size("# vtk DataFile Version");
    this->HasOffsets = std::atof(std::string(file.GetBytes().substr(prefix, 9)).c_str()) >= 5.0;
  }

  void Compare(const char* keyword, vtkIdType found) const
  {
    const std::size_t size = std::strlen(keyword);
    const std::string_view bytes = this->File.GetBytes();
    vtkIdType announced = 0;
    bool isThere = false;
    for (std::size_t end = bytes.find('\n'); end < bytes.size(); end = bytes.find('\n', end + 1))
    {
      const std::string_view line = bytes.substr(end + 1, size + 32);
      if (line.size() > size && line[size] == ' ' && strncasecmp(line.data(), keyword, size) == 0)
      {
        vtkIdType count = 0;
        std::from_chars(line.data() + size + 1, line.data() + line.size(), count);
        // From version 5 on, the number of offsets, which is one more.
        const bool isOneMore = this->HasOffsets && std::strcmp(keyword, "POINTS") != 0;
        announced += isOneMore ? std::max<vtkIdType>(count - 1, 0) : count;
        isThere = true;
      }
    }
    if (isThere && announced != found)
    {
      this->File.Fail(std::string(keyword) + ": the file says " + std::to_string(announced) +
        ", but " + std::to_string(found) + " can be read (truncated or corrupt)");
    }
  }

private:
  const InputFile& File;
  bool HasOffsets = false;
};

}

void FailOnType(const InputFile& file, const std::string& type)
{
  file.Fail("holds " + type.substr(0, 40) +
    ", not a surface mesh (PolyData); ParaView's Extract Surface (vtkDataSetSurfaceFilter) "
    "extracts one");
}

FileMesh ReadLegacy(const InputFile& file, VTKMessages& messages)
{
  CheckHead(file);
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(file.GetPath().c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  {
    const MutedStandardError muted;
    reader->Update();
  }
  const std::string problems = messages.TakeProblems();
  FileMesh result;
  result.Mesh = reader->GetOutput();
  if (!problems.empty() || !result.Mesh)
  {
    file.Fail("cannot be read: " + (problems.empty() ? "it contains no mesh" : problems));
  }
  if (!result.Mesh->GetPoints())
  {
    file.Fail("has no POINTS (truncated or corrupt)");
  }
  const LegacyCounts counts(file);
  counts.Compare("POINTS", result.Mesh->GetNumberOfPoints());
  counts.Compare("VERTICES", result.Mesh->GetNumberOfVerts());
  counts.Compare("LINES", result.Mesh->GetNumberOfLines());
  counts.Compare("POLYGONS", result.Mesh->GetNumberOfPolys());
  counts.Compare("TRIANGLE_STRIPS", result.Mesh->GetNumberOfStrips());
  return result;
}

}
