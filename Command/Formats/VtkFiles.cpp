// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Console.h"
#include "DataArrays.h"
#include "Formats.h"
#include "VtkIntegers.h"

#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLFileReadTester.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <fcntl.h>
#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>

/// @file
/// VTK's readers and writers, with checks: on some faults of a file its readers give up a part of
/// the mesh, or all of it, and say nothing.

namespace delaunayflip
{

namespace
{

[[noreturn]] void FailOnType(const InputFile& file, const std::string& type)
{
  const bool isImage = type == "STRUCTURED_POINTS" || type == "ImageData";
  std::string remedy = "Extract Surface (vtkDataSetSurfaceFilter) extracts one";
  if (isImage)
  {
    remedy = "Warp By Scalar makes terrain of an image of heights, and " + remedy;
  }
  file.Fail(
    "holds " + type.substr(0, 40) + ", not a surface mesh (PolyData); ParaView's " + remedy);
}

/// Discards what is written to stderr while the result lives: the output of a crashing reader helps
/// nobody.
std::shared_ptr<void> MuteStandardError()
{
  const int saved = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
  return { nullptr,
    [saved](void*)
    {
      dup2(saved, STDERR_FILENO);
      close(saved);
    } };
}

/// Runs a reader. Any message of its means that a part of the file is missing.
template <typename Reader>
FileMesh Run(Reader* reader, const InputFile& file)
{
  reader->SetFileName(file.GetPath().c_str());
  {
    const auto muted = MuteStandardError();
    reader->Update();
  }
  const std::string problems = TakeVTKProblems();
  FileMesh result;
  result.Mesh = reader->GetOutput();
  if (!problems.empty())
  {
    file.Fail("cannot be read: " + problems);
  }
  if (!result.Mesh)
  {
    file.Fail("cannot be read: it contains no mesh");
  }
  return result;
}

void RequireCount(
  const InputFile& file, const std::string& what, vtkIdType announced, vtkIdType found)
{
  if (announced != found)
  {
    file.Fail(what + ": the file says " + std::to_string(announced) + ", but " +
      std::to_string(found) + " can be read (truncated or corrupt)");
  }
}

struct MeshCount
{
  const char* Keyword; ///< In a .vtk.
  const char* Attribute; ///< In a .vtp.
  vtkIdType Number;
  vtkCellArray* Cells; ///< Null for points.
};

std::array<MeshCount, 5> CountsOf(vtkPolyData* mesh)
{
  return { { { "POINTS", "NumberOfPoints", mesh->GetNumberOfPoints(), nullptr },
    { "VERTICES", "NumberOfVerts", mesh->GetNumberOfVerts(), mesh->GetVerts() },
    { "LINES", "NumberOfLines", mesh->GetNumberOfLines(), mesh->GetLines() },
    { "POLYGONS", "NumberOfPolys", mesh->GetNumberOfPolys(), mesh->GetPolys() },
    { "TRIANGLE_STRIPS", "NumberOfStrips", mesh->GetNumberOfStrips(), mesh->GetStrips() } } };
}

/// The headers of a .vtk before its data, such as "POINTS 4 float" and "POLYGONS 2 8": by keyword,
/// the sums of the two numbers, how many points or cells there are and how many integers behind.
std::map<std::string, std::array<vtkIdType, 2>> ReadHeaders(std::string_view bytes, bool hasOffsets)
{
  std::map<std::string, std::array<vtkIdType, 2>> headers;
  std::size_t end = bytes.find('\n', bytes.find('\n') + 1); // of the title
  for (; end < bytes.size(); end = bytes.find('\n', end + 1))
  {
    const std::string_view rest = bytes.substr(end + 1, 100);
    if (rest.empty() || !std::isalpha(static_cast<unsigned char>(rest.front())))
    {
      continue;
    }
    std::istringstream line(std::string(rest.substr(0, rest.find('\n'))));
    std::string keyword, second, third;
    vtkIdType count = 0, size = 0;
    if (!(line >> keyword >> count))
    {
      continue; // a line of text
    }
    line >> second >> third;
    std::transform(keyword.begin(), keyword.end(), keyword.begin(), ::toupper);
    if (keyword == "POINT_DATA" || keyword == "CELL_DATA")
    {
      break;
    }
    ReadNumber(second, size);
    const bool isArray = !third.empty() && std::isalpha(static_cast<unsigned char>(third.front()));
    if (!isArray) // such as "points 1 4 int" of a FIELD
    {
      // From version 5 on, the number of offsets, which is one more.
      const bool isLarger = hasOffsets && keyword != "POINTS";
      if (isLarger)
      {
        count = std::max<vtkIdType>(count - 1, 0);
      }
      headers[keyword][0] += count;
      headers[keyword][1] += size;
    }
  }
  return headers;
}

/// VTK's reader, which afterwards compares what it read with what the file says.
class CheckedXmlReader : public vtkXMLPolyDataReader
{
public:
  static CheckedXmlReader* New();
  vtkTypeMacro(CheckedXmlReader, vtkXMLPolyDataReader);

  const InputFile* File = nullptr;
  std::map<std::string, vtkIdType> Announced; ///< The counts of all pieces, by attribute.

protected:
  int ReadVTKFile(vtkXMLDataElement* root) override
  {
    this->Announced.clear();
    this->Prepare(root);
    return this->Superclass::ReadVTKFile(root);
  }

  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType arrayIndex, vtkAbstractArray* array,
    vtkIdType startIndex, vtkIdType numValues, FieldType type) override
  {
    const int done =
      this->Superclass::ReadArrayValues(element, arrayIndex, array, startIndex, numValues, type);
    if (IsText(element) && vtkDataArray::SafeDownCast(array))
    {
      if (this->TextOf(element).find_first_of("nN") != std::string_view::npos)
      {
        this->File->Fail("nan or inf as text, which VTK changes; binary data may have them");
      }
    }
    // Cell data are read in parts, of verts, lines, strips and polygons, so they may have more.
    const std::string parent = element->GetParent()->GetName();
    if (done && numValues > 0 && parent != "CellData" && parent != "FieldData" &&
      this->HasMore(element, startIndex + numValues))
    {
      this->File->Fail(
        "an array of the element " + parent + " has more values than the file says (corrupt)");
    }
    return done;
  }

private:
  /// Adds up counts, and removes ranges: VTK computes them again, and it writes infinite ones,
  /// which it cannot read.
  void Prepare(vtkXMLDataElement* element)
  {
    const bool isPiece = std::strcmp(element->GetName(), "Piece") == 0;
    element->RemoveAttribute("RangeMin");
    element->RemoveAttribute("RangeMax");
    this->RequireIntegersOf(element);
    for (int i = element->GetNumberOfNestedElements() - 1; i >= 0; --i)
    {
      vtkXMLDataElement* const child = element->GetNestedElement(i);
      const char* const key = child->GetAttribute("name");
      const std::string count = std::string("NumberOf") + child->GetName();
      if (key && std::strstr(key, "RANGE"))
      {
        element->RemoveNestedElement(child);
        continue;
      }
      if (isPiece && child->GetNumberOfNestedElements() > 0 &&
        !element->GetAttribute(count.c_str()) && !std::strstr(child->GetName(), "Data"))
      {
        this->File->Fail("Piece has no " + count + ", but an element " + child->GetName());
      }
      this->Prepare(child);
    }
    for (int i = 0; i < element->GetNumberOfAttributes(); ++i)
    {
      const std::string name = element->GetAttributeName(i);
      if (name.rfind("NumberOf", 0) == 0)
      {
        const vtkIdType count = this->ReadCount(name, element->GetAttributeValue(i));
        if (isPiece)
        {
          this->Announced[name] += count;
        }
      }
    }
  }

  vtkIdType ReadCount(const std::string& name, const std::string& text) const
  {
    // A value takes a byte at least; compressed it may take less.
    const vtkIdType compression = name == "NumberOfComponents" ? 1 : 10000;
    const auto bytes = static_cast<vtkIdType>(this->File->GetBytes().size());
    vtkIdType count = -1;
    if (ReadNumber(text, count) != std::errc() || count < 0 || count / compression > bytes)
    {
      this->File->Fail(name + "=\"" + text + "\" is not a valid count (corrupt)");
    }
    return count;
  }

  static bool IsText(vtkXMLDataElement* element)
  {
    const char* const format = element->GetAttribute("format");
    return !format || std::strcmp(format, "ascii") == 0;
  }

  /// The numbers of an array in text.
  std::string_view TextOf(vtkXMLDataElement* element) const
  {
    const std::string_view bytes = this->File->GetBytes();
    const auto start = static_cast<std::size_t>(element->GetXMLByteIndex());
    const std::size_t begin = std::min(bytes.find('>', start), bytes.size() - 1) + 1;
    return bytes.substr(begin, bytes.find('<', begin) - begin);
  }

  void RequireIntegersOf(vtkXMLDataElement* element) const
  {
    const char* const type = element->GetAttribute("type");
    const char* const name = element->GetAttribute("Name");
    if (type && IsText(element) && std::strcmp(element->GetName(), "DataArray") == 0)
    {
      const std::string ofParent = std::string("of ") + element->GetParent()->GetName();
      RequireIntegers(
        *this->File, name ? "'" + std::string(name) + "'" : ofParent, type, this->TextOf(element));
    }
  }

  /// Whether an array of numbers has another value after its first `count`. Asks for the last of
  /// these too: VTK 9.1 fails at the very end of compressed data if all of its blocks are full.
  bool HasMore(vtkXMLDataElement* element, vtkIdType count)
  {
    int type = 0;
    vtkTypeInt64 offset = 0;
    double values[2];
    if (!element->GetWordTypeAttribute("type", type) || type == VTK_BIT || type == VTK_STRING)
    {
      return false;
    }
    if (element->GetScalarAttribute("offset", offset))
    {
      return this->XMLParser->ReadAppendedData(offset, values, count - 1, 2, type) > 1;
    }
    const int isText = static_cast<int>(IsText(element));
    return this->XMLParser->ReadInlineData(element, isText, values, count - 1, 2, type) > 1;
  }
};

vtkStandardNewMacro(CheckedXmlReader);

template <typename Writer>
void Run(Writer* writer, vtkPolyData* mesh, const std::string& path)
{
  writer->SetInputData(mesh);
  writer->SetFileName(path.c_str());
  const bool written = writer->Write() != 0;
  const std::string problems = TakeVTKProblems();
  if (writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError)
  {
    throw CommandError(ExitCode::BadFile, "no space for the whole file");
  }
  if (!written || !problems.empty() || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw CommandError(ExitCode::BadFile, problems.empty() ? "the writer failed" : problems);
  }
}

/// VTK writes the range of the vectors' lengths with an array, and cannot read an infinite one. The
/// squares of coordinates above 1e154 are infinite.
void LimitRange(vtkDataArray* array)
{
  constexpr double most = 1e308; // the largest double, rounded as VTK writes it, would be infinite
  double range[2];
  array->GetRange(range, -1);
  if (array->GetNumberOfComponents() > 1 && !(std::isfinite(range[0]) && std::isfinite(range[1])))
  {
    for (double& end : range)
    {
      end = std::isnan(end) ? 0.0 : std::clamp(end, -most, most);
    }
    array->GetInformation()->Set(vtkDataArray::L2_NORM_RANGE(), range, 2);
  }
}

/// Makes bytes of bits if a tuple has several, which VTK would spoil.
void MakeBytes(vtkFieldData* data)
{
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
    if (array && array->GetName() && array->GetDataType() == VTK_BIT &&
      array->GetNumberOfComponents() > 1)
    {
      const vtkNew<vtkUnsignedCharArray> bytes;
      bytes->DeepCopy(array);
      data->AddArray(bytes); // in its place
    }
  }
}

/// Throws where VTK's .vtp writer crashes or makes a file that cannot be read, and changes arrays
/// and ranges that VTK could not read back.
/// @param tuples how many arrays must have; -1: any number.
void PrepareForXml(vtkFieldData* data, vtkIdType tuples)
{
  MakeBytes(data);
  auto* const attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(index);
    const std::string name = GetName(array);
    const auto require = [&name](bool isTrue, const std::string& fault)
    {
      if (!isTrue)
      {
        throw CommandError(ExitCode::BadFile,
          "the array '" + name + "' has " + fault +
            ", which this file format cannot hold; a .vtk can hold it");
      }
    };
    auto* const strings = vtkStringArray::SafeDownCast(array);
    for (vtkIdType i = 0; strings && i < strings->GetNumberOfValues(); ++i)
    {
      require(strings->GetValue(i).find('\0') == std::string::npos, "a string with a zero byte");
    }
    const int type = array->GetDataType();
    const bool canBeIds =
      type == VTK_INT || type == VTK_LONG || type == VTK_LONG_LONG || type == VTK_ID_TYPE;
    const bool areIds =
      attributes && (array == attributes->GetPedigreeIds() || array == attributes->GetGlobalIds());
    require(!areIds || canBeIds, "ids that are not integers with a sign");
    for (int component = -1; component < array->GetNumberOfComponents(); ++component)
    {
      const char* const part = component < 0 ? name.c_str() : array->GetComponentName(component);
      require(!part || !HasMarkup(part),
        "one of < > & \" or a control character in the name of the array or of a component");
    }
    require(tuples < 0 || array->GetNumberOfTuples() == tuples,
      std::to_string(array->GetNumberOfTuples()) + " tuples instead of " + std::to_string(tuples));
    if (auto* const numbers = vtkDataArray::SafeDownCast(array))
    {
      LimitRange(numbers);
    }
  }
}

/// Changes what VTK's .vtk writer would spoil: ids, which it cuts to 32 bits, and bits of
/// several components. Colors with a name that VTK cannot read back are no longer active, and so
/// are the kinds of active arrays that it would leave out.
void PrepareForLegacy(vtkFieldData* data)
{
  MakeBytes(data);
  auto* const attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
    if (!array || !array->GetName())
    {
      continue;
    }
    auto* const ids = vtkIdTypeArray::SafeDownCast(array);
    if (ids && std::any_of(ids->Begin(), ids->End(), [](auto id) { return id != int(id); }))
    {
      const vtkNew<vtkLongLongArray> changed;
      changed->DeepCopy(array);
      data->AddArray(changed); // in its place
    }
    const std::string name = array->GetName();
    const bool isPlain = std::all_of(name.begin(), name.end(),
      [](unsigned char c) { return std::isgraph(c) && c != '%' && c != '"'; });
    if (attributes && data->GetArray(index) == attributes->GetScalars() && !isPlain &&
      data->GetArray(index)->GetDataType() == VTK_UNSIGNED_CHAR)
    {
      attributes->SetActiveAttribute(-1, vtkDataSetAttributes::SCALARS);
    }
  }
  for (int kind = vtkDataSetAttributes::TANGENTS;
       attributes && kind <= vtkDataSetAttributes::HIGHERORDERDEGREES; ++kind)
  {
    attributes->SetActiveAttribute(-1, kind);
  }
}

}

FileMesh ReadLegacy(const InputFile& file)
{
  const std::string mark = "# vtk DataFile Version";
  const std::string_view bytes = file.GetBytes();
  std::istringstream head(std::string(bytes.substr(0, 1000)));
  std::string line, keyword, type;
  std::getline(head, line);
  if (line.rfind(mark, 0) != 0)
  {
    file.Fail("not a VTK file (it does not start with '" + mark + "')");
  }
  const bool hasOffsets = std::atof(line.c_str() + mark.size()) >= 5.0;
  std::getline(head, line); // the title
  head >> line >> keyword >> type;
  if (strcasecmp(keyword.c_str(), "dataset") == 0 && strcasecmp(type.c_str(), "polydata") != 0)
  {
    FailOnType(file, type);
  }
  vtkNew<vtkPolyDataReader> reader;
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  const FileMesh result = Run(reader.Get(), file);
  vtkPolyData* const mesh = result.Mesh;
  if (!mesh->GetPoints())
  {
    file.Fail("has no POINTS (truncated or corrupt)");
  }
  RequireIntegersOfLegacy(file);
  const auto headers = ReadHeaders(bytes, hasOffsets);
  for (const MeshCount& count : CountsOf(mesh))
  {
    const std::string section = count.Keyword;
    const auto header = headers.find(section);
    if (header != headers.end())
    {
      RequireCount(file, section, header->second[0], count.Number);
      vtkIdType integers = 0;
      if (count.Cells)
      {
        integers = count.Cells->GetNumberOfConnectivityIds();
      }
      if (count.Cells && !hasOffsets)
      {
        integers += count.Number;
      }
      RequireCount(file, section + ", all integers", header->second[1], integers);
    }
  }
  return result;
}

FileMesh ReadXml(const InputFile& file)
{
  vtkNew<vtkXMLFileReadTester> tester;
  tester->SetFileName(file.GetPath().c_str());
  const char* const type = tester->TestReadFile() ? tester->GetFileDataType() : nullptr;
  if (!type)
  {
    file.Fail("not a VTK XML file");
  }
  if (std::strcmp(type, "PolyData") != 0)
  {
    FailOnType(file, type);
  }
  vtkNew<CheckedXmlReader> reader;
  reader->File = &file;
  FileMesh result = Run<CheckedXmlReader>(reader, file);
  vtkPolyData* const mesh = result.Mesh;
  for (const MeshCount& count : CountsOf(mesh))
  {
    RequireCount(file, count.Attribute, reader->Announced[count.Attribute], count.Number);
  }
  if (!mesh->GetPoints())
  {
    mesh->SetPoints(vtkNew<vtkPoints>());
  }
  return result;
}

void WriteLegacy(vtkPolyData* mesh, const std::string& path)
{
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileTypeToBinary();
  PrepareForLegacy(mesh->GetFieldData());
  PrepareForLegacy(mesh->GetPointData());
  PrepareForLegacy(mesh->GetCellData());
  Run(writer.Get(), mesh, path);
}

void WriteStl(vtkPolyData* mesh, const std::string& path)
{
  vtkNew<vtkSTLWriter> writer;
  writer->SetFileTypeToBinary();
  Run(writer.Get(), mesh, path);
}

void WriteXml(vtkPolyData* mesh, const std::string& path)
{
  PrepareForXml(mesh->GetFieldData(), -1);
  PrepareForXml(mesh->GetPointData(), mesh->GetNumberOfPoints());
  PrepareForXml(mesh->GetCellData(), mesh->GetNumberOfCells());
  LimitRange(mesh->GetPoints()->GetData());
  vtkNew<vtkXMLPolyDataWriter> writer;
  // Appended data, raw or base64, would be twice as fast. But Debian 12's ParaView 5.11 cannot read
  // them: VTK before 9.3 with an expat that delays parsing (2.6, or 2.5 with that fix) fails.
  writer->SetDataModeToBinary();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToLZ4(); // a fifth of zlib's time, for files half as large again
  Run(writer.Get(), mesh, path);

  // Parses the whole file, to its last tag, but does not decode the numbers, which takes three
  // times as long.
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  if (!TakeVTKProblems().empty() || reader->GetNumberOfPieces() != 1)
  {
    throw CommandError(ExitCode::BadFile, "the file is incomplete when read back");
  }
}

}
