// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyHeader.h"

#include "Counted.h"
#include "TextCursor.h"

#include <algorithm>
#include <map>

namespace delaunayflip
{

namespace
{

class PlyHeaderParser
{
public:
  explicit PlyHeaderParser(const InputFile& file)
    : File(file),
      Cursor(file)
  {
  }

  PlyHeader Parse()
  {
    if (this->Cursor.NextWord() != "ply")
    {
      this->File.Fail("not a PLY file (it does not start with 'ply')");
    }
    this->Cursor.SkipLine();
    while (this->ParseLine())
    {
      this->Cursor.SkipLine();
      if (this->Cursor.IsAtEnd())
      {
        this->File.Fail("its header has no end (truncated or corrupt)");
      }
    }
    if (!this->HasFormat)
    {
      this->File.Fail("its header has no format");
    }
    this->Cursor.SkipLine();
    this->Header.Size = this->Cursor.GetOffset();
    this->CheckCounts();
    return this->Header;
  }

private:
  /// Whether more lines follow.
  bool ParseLine()
  {
    const std::string_view keyword = this->Cursor.NextWord();
    if (keyword == "format")
    {
      this->ParseFormat();
    }
    else if (keyword == "element")
    {
      this->ParseElement();
    }
    else if (keyword == "property")
    {
      this->ParseProperty();
    }
    else if (keyword != "comment" && keyword != "obj_info" && keyword != "end_header" &&
      keyword != "Created" /* by Open Asset Import Library */ && !keyword.empty())
    {
      this->Cursor.Fail("not a line of a PLY header");
    }
    return keyword != "end_header";
  }

  void ParseFormat()
  {
    static const std::map<std::string, PlyEncoding, std::less<>> encodings = {
      { "ascii", PlyEncoding::Text }, { "binary_little_endian", PlyEncoding::LittleEndian },
      { "binary_big_endian", PlyEncoding::BigEndian }
    };
    const auto found = encodings.find(this->Cursor.NextWord());
    if (found == encodings.end())
    {
      this->Cursor.Fail("unknown format");
    }
    this->Header.Encoding = found->second;
    this->HasFormat = true;
  }

  void ParseElement()
  {
    PlyElement element;
    element.Name = this->Cursor.NextWord();
    element.Count = this->Cursor.NextNumber<std::int64_t>();
    if (element.Count < 0)
    {
      this->Cursor.Fail("a negative number of elements");
    }
    for (const PlyElement& other : this->Header.Elements)
    {
      if (other.Name == element.Name)
      {
        this->Cursor.Fail("a second definition of element " + element.Name);
      }
    }
    this->Header.Elements.push_back(element);
  }

  void ParseProperty()
  {
    if (this->Header.Elements.empty())
    {
      this->Cursor.Fail("a property before any element");
    }
    PlyProperty property;
    std::string_view type = this->Cursor.NextWord();
    if (type == "list")
    {
      property.CountType = this->ParseType(this->Cursor.NextWord());
      type = this->Cursor.NextWord();
    }
    property.Type = this->ParseType(type);
    property.Name = this->Cursor.NextWord();
    if (property.CountType >= PlyType::Float32)
    {
      this->Cursor.Fail("the length of a list must be an integer");
    }
    this->Header.Elements.back().Properties.push_back(property);
  }

  PlyType ParseType(std::string_view name)
  {
    static const std::map<std::string, PlyType, std::less<>> types = { { "char", PlyType::Int8 },
      { "int8", PlyType::Int8 }, { "uchar", PlyType::UInt8 }, { "uint8", PlyType::UInt8 },
      { "short", PlyType::Int16 }, { "int16", PlyType::Int16 }, { "ushort", PlyType::UInt16 },
      { "uint16", PlyType::UInt16 }, { "int", PlyType::Int32 }, { "int32", PlyType::Int32 },
      { "uint", PlyType::UInt32 }, { "uint32", PlyType::UInt32 }, { "float", PlyType::Float32 },
      { "float32", PlyType::Float32 }, { "double", PlyType::Float64 },
      { "float64", PlyType::Float64 } };
    const auto found = types.find(name);
    if (found == types.end())
    {
      this->Cursor.Fail("unknown type of a property");
    }
    return found->second;
  }

  /// The fewest bytes that one element can take.
  std::int64_t LeastSize(const PlyElement& element) const
  {
    if (this->Header.Encoding == PlyEncoding::Text)
    {
      return 2 * static_cast<std::int64_t>(element.Properties.size()); // a digit and a blank
    }
    std::int64_t size = 0;
    for (const PlyProperty& property : element.Properties)
    {
      size += VisitPlyType(property.CountType.value_or(property.Type),
        [](auto zero) { return static_cast<std::int64_t>(sizeof(zero)); });
    }
    return size;
  }

  void CheckCounts() const
  {
    const auto body = static_cast<std::int64_t>(this->Cursor.GetBytesLeft());
    for (const PlyElement& element : this->Header.Elements)
    {
      // The last line may lack its line break.
      const std::int64_t least = std::max<std::int64_t>(this->LeastSize(element), 1);
      if (element.Count > (body + 1) / least)
      {
        this->File.Fail("its header says 'element " + element.Name + " " +
          std::to_string(element.Count) + "', too many for the " + Counted(body, "byte") +
          " after it (truncated or corrupt)");
      }
    }
  }

  const InputFile& File;
  TextCursor Cursor;
  PlyHeader Header;
  bool HasFormat = false;
};

}

bool PlyElement::HasLists() const
{
  return std::any_of(this->Properties.begin(), this->Properties.end(),
    [](const PlyProperty& property) { return property.CountType.has_value(); });
}

std::int64_t PlyHeader::CountOf(const std::string& element) const
{
  const auto found = std::find_if(this->Elements.begin(), this->Elements.end(),
    [&element](const PlyElement& candidate) { return candidate.Name == element; });
  return found == this->Elements.end() ? 0 : found->Count;
}

PlyHeader ReadPlyHeader(const InputFile& file) { return PlyHeaderParser(file).Parse(); }

}
