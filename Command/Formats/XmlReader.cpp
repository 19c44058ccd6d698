// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "XmlReader.h"

#include "Console.h"
#include "LegacyReader.h"
#include "TextCursor.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLFileReadTester.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <vector>

namespace delaunayflip
{

namespace
{

/// The elements within another.
std::vector<vtkXMLDataElement*> Children(vtkXMLDataElement* element)
{
  std::vector<vtkXMLDataElement*> children;
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    children.push_back(element->GetNestedElement(i));
  }
  return children;
}

std::string AttributeOf(vtkXMLDataElement* element, const char* name)
{
  const char* const value = element->GetAttribute(name);
  return value ? value : "";
}

/// Checks the elements of a file before VTK trusts them, and afterwards what VTK made of them: on a
/// damaged element it gives up a part of the mesh, or all of it, and says nothing.
class XmlCheck
{
public:
  explicit XmlCheck(const InputFile& file)
    : File(file)
  {
  }

  void Check(vtkXMLDataElement* root)
  {
    // The most bytes that one compressed byte of the file can expand to.
    constexpr double compression = 10000;
    this->Growth = root->GetAttribute("compressor") ? compression : 1.0;
    for (vtkXMLDataElement* dataSet : Children(root))
    {
      for (vtkXMLDataElement* part : Children(dataSet))
      {
        if (std::strcmp(part->GetName(), "Piece") == 0)
        {
          this->CheckPiece(part);
        }
        else if (std::strcmp(part->GetName(), "FieldData") == 0)
        {
          this->CheckFieldData(part);
        }
      }
    }
  }

  void Compare(vtkPolyData* mesh)
  {
    this->CompareCount("NumberOfPoints", mesh->GetNumberOfPoints());
    this->CompareCount("NumberOfVerts", mesh->GetNumberOfVerts());
    this->CompareCount("NumberOfLines", mesh->GetNumberOfLines());
    this->CompareCount("NumberOfStrips", mesh->GetNumberOfStrips());
    this->CompareCount("NumberOfPolys", mesh->GetNumberOfPolys());
  }

private:
  void CompareCount(const char* name, vtkIdType found)
  {
    const double announced = this->Announced[name];
    if (announced != static_cast<double>(found))
    {
      this->File.Fail("Piece has " + std::string(name) + "=\"" +
        std::to_string(static_cast<vtkIdType>(std::min(announced, 9e18))) + "\", but " +
        std::to_string(found) + " can be read (an array is damaged or missing)");
    }
  }

  void CheckFieldData(vtkXMLDataElement* fieldData)
  {
    for (vtkXMLDataElement* array : Children(fieldData))
    {
      this->CheckArray(array, this->GetCount(array, "NumberOfTuples", 0));
    }
  }

  void CheckPiece(vtkXMLDataElement* piece)
  {
    double cells = 0;
    for (const char* kind : { "Points", "Verts", "Lines", "Strips", "Polys" })
    {
      const std::string name = "NumberOf" + std::string(kind);
      const double count = this->GetCount(piece, name.c_str(), 0);
      this->Announced[name] += count;
      cells += name == "NumberOfPoints" ? 0 : count;
    }
    for (vtkXMLDataElement* part : Children(piece))
    {
      const std::string name = part->GetName();
      const double tuples = name == "CellData" ? cells
        : name == "Points" || name == "PointData"
        ? this->GetCount(piece, "NumberOfPoints", 0)
        : this->GetCount(piece, ("NumberOf" + name).c_str(), 0);
      if (this->Announced.count("NumberOf" + name) && part->GetNumberOfNestedElements() > 0 &&
        !piece->GetAttribute(("NumberOf" + name).c_str()))
      {
        this->File.Fail("Piece has no NumberOf" + name + ", but an element " + name);
      }
      for (vtkXMLDataElement* array : Children(part))
      {
        this->CheckArray(array, AttributeOf(array, "Name") == "connectivity" ? 0 : tuples);
      }
    }
  }

  /// Fails if the file is too short for so many tuples. Removes attributes that VTK would misread.
  void CheckArray(vtkXMLDataElement* array, double tuples)
  {
    const double values = tuples * this->GetCount(array, "NumberOfComponents", 1);
    int type = 0;
    const bool isBits = array->GetWordTypeAttribute("type", type) && type == VTK_BIT;
    // A value takes at least a byte.
    if (values >
      (isBits ? 8.0 : 1.0) * this->Growth * static_cast<double>(this->File.GetBytes().size()))
    {
      this->File.Fail("array '" + AttributeOf(array, "Name") +
        "' has more values than the file has bytes for (truncated or corrupt)");
    }
    array->RemoveAttribute("RangeMin");
    array->RemoveAttribute("RangeMax");
    for (vtkXMLDataElement* key : Children(array))
    {
      // VTK computes ranges again; it writes infinite ones, which it cannot read.
      if (AttributeOf(key, "name").find("RANGE") != std::string::npos)
      {
        array->RemoveNestedElement(key);
      }
    }
  }

  /// A number that is at least `least`, 0 or 1.
  double GetCount(vtkXMLDataElement* element, const char* name, int least)
  {
    const std::string text = AttributeOf(element, name);
    const char* const end = text.data() + text.size();
    vtkIdType count = least;
    const auto [last, error] = std::from_chars(text.data(), end, count);
    if (element->GetAttribute(name) && (error != std::errc() || last != end || count < least))
    {
      this->File.Fail(std::string(name) + "=\"" + text + "\" is not a valid count");
    }
    return static_cast<double>(count);
  }

  const InputFile& File;
  double Growth = 1.0;
  std::map<std::string, double> Announced; ///< The counts of all pieces, by attribute.
};

/// VTK's reader, after the check, with numbers as text read by TextCursor.
class CheckedXmlReader : public vtkXMLPolyDataReader
{
public:
  static CheckedXmlReader* New();
  vtkTypeMacro(CheckedXmlReader, vtkXMLPolyDataReader);

  void SetFile(const InputFile& file)
  {
    this->File = &file;
    this->SetFileName(file.GetPath().c_str());
  }

  void CheckOutput()
  {
    if (this->Checks)
    {
      this->Checks->Compare(this->GetOutput());
    }
  }

protected:
  int ReadVTKFile(vtkXMLDataElement* root) override
  {
    this->Checks.emplace(*this->File).Check(root);
    return this->Superclass::ReadVTKFile(root);
  }

  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType arrayIndex, vtkAbstractArray* array,
    vtkIdType startIndex, vtkIdType numValues, FieldType type) override
  {
    auto* const numbers = vtkDataArray::SafeDownCast(array);
    const bool fits = arrayIndex + numValues <= array->GetNumberOfValues();
    if (!IsText(element) || !numbers || numbers->GetDataType() == VTK_BIT || !fits ||
      array->GetName() == std::string("vtkGhostLevels")) // which VTK converts
    {
      const int done =
        this->Superclass::ReadArrayValues(element, arrayIndex, array, startIndex, numValues, type);
      this->RequireEnd(element,
        done && numbers && numValues > 0 && this->HasMore(element, startIndex + numValues));
      return done;
    }
    TextCursor cursor = this->FindText(element);
    switch (numbers->GetDataType())
    {
      vtkTemplateMacro(ReadNumbers(
        cursor, static_cast<VTK_TT*>(numbers->GetVoidPointer(arrayIndex)), startIndex, numValues));
    }
    cursor.SkipSpace();
    this->RequireEnd(element, !cursor.IsAtEnd());
    array->Modified();
    return 1;
  }

private:
  /// Whether a binary array has another value after its first `count`.
  bool HasMore(vtkXMLDataElement* element, vtkIdType count)
  {
    int type = 0;
    vtkTypeInt64 offset = 0;
    double value = 0.0;
    if (!element->GetWordTypeAttribute("type", type) || type == VTK_BIT || IsText(element))
    {
      return false;
    }
    return element->GetScalarAttribute("offset", offset)
      ? this->XMLParser->ReadAppendedData(offset, &value, count, 1, type) > 0
      : this->XMLParser->ReadInlineData(element, 0, &value, count, 1, type) > 0;
  }

  /// Data of cells are read in parts, of verts, lines, strips and polygons, so they may have more;
  /// so are field data.
  void RequireEnd(vtkXMLDataElement* element, bool hasMore) const
  {
    const std::string parent = element->GetParent()->GetName();
    if (hasMore && parent != "CellData" && parent != "FieldData")
    {
      this->File->Fail("array '" + AttributeOf(element, "Name") + "' of the element " + parent +
        " has more values than the file says (corrupt)");
    }
  }

  static bool IsText(vtkXMLDataElement* element)
  {
    // VTK tries the first value of an empty array too.
    return !element->GetAttribute("offset") && AttributeOf(element, "format") != "binary" &&
      AttributeOf(element, "NumberOfTuples") != "0";
  }

  /// The text between the tag of an element and the next tag.
  TextCursor FindText(vtkXMLDataElement* element) const
  {
    const std::string_view bytes = this->File->GetBytes();
    const auto tag = static_cast<std::size_t>(element->GetXMLByteIndex());
    const std::size_t begin = std::min(bytes.find('>', tag), bytes.size() - 1) + 1;
    return TextCursor(*this->File, begin, bytes.find('<', begin));
  }

  template <typename T>
  static void ReadNumbers(TextCursor& cursor, T* numbers, vtkIdType skipped, vtkIdType count)
  {
    for (vtkIdType i = 0; i < skipped + count; ++i)
    {
      cursor.SkipSpace();
      const T number = cursor.NextNumber<T>();
      if (i >= skipped)
      {
        numbers[i - skipped] = number;
      }
    }
  }

  const InputFile* File = nullptr;
  std::optional<XmlCheck> Checks;
};

vtkStandardNewMacro(CheckedXmlReader);

void RequirePolyData(const InputFile& file)
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
}

}

FileMesh ReadXml(const InputFile& file, VTKMessages& messages)
{
  RequirePolyData(file);
  vtkNew<CheckedXmlReader> reader;
  reader->SetFile(file);
  {
    const MutedStandardError muted;
    reader->Update();
  }
  // Any warning of the reader means that a part of the file is missing.
  const std::string problems = messages.TakeProblems();
  FileMesh result;
  result.Mesh = reader->GetOutput();
  if (!problems.empty() || !result.Mesh)
  {
    file.Fail("cannot be read: " + (problems.empty() ? "it contains no mesh" : problems));
  }
  reader->CheckOutput();
  if (!result.Mesh->GetPoints())
  {
    const vtkNew<vtkPoints> none;
    result.Mesh->SetPoints(none);
  }
  return result;
}

}
