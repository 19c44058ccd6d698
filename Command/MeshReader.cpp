// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReader.h"

#include "InputFile.h"
#include "LegacyReader.h"
#include "ObjReader.h"
#include "PlyReader.h"
#include "ReadingLimits.h"
#include "StlReader.h"
#include "XmlReader.h"

#include <new>
#include <stdexcept>

namespace delaunayflip
{

namespace
{

FileMesh ReadFormat(const InputFile& file, MeshFormat format, VTKMessages& messages)
{
  switch (format)
  {
    case MeshFormat::VTK:
      return ReadLegacy(file, messages);
    case MeshFormat::VTP:
      return ReadXml(file, messages);
    case MeshFormat::PLY:
      return ReadPly(file);
    case MeshFormat::STL:
      return ReadStl(file);
    default:
      return ReadObj(file);
  }
}

}

FileMesh ReadMesh(const std::string& path, MeshFormat format, VTKMessages& messages)
{
  const InputFile file(path);
  const ReadingLimits limits(file.GetBytes().size());
  try
  {
    return ReadFormat(file, format, messages);
  }
  catch (const std::bad_alloc&)
  {
  }
  catch (const std::length_error&)
  {
  }
  file.Fail(
    "cannot be read: not enough memory, or the file is corrupt: it asks for more than its " +
    std::to_string(file.GetBytes().size()) + " bytes can hold");
}

}
