// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyArrays.h"

#include "Counted.h"

#include <vtkBitArray.h>
#include <vtkCharArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLongArray.h>
#include <vtkShortArray.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeUInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnsignedLongArray.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace delaunayflip
{

namespace
{

std::string LowerCase(std::string_view word)
{
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return lower;
}

/// Decodes special characters, which the format writes as % and two hexadecimal digits.
std::string Decoded(std::string_view word)
{
  std::string decoded;
  for (std::size_t i = 0; i < word.size(); ++i)
  {
    unsigned int code = 0;
    const char* const digits = word.data() + i + 1;
    if (word[i] == '%' && i + 2 < word.size() &&
      std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2)
    {
      decoded += static_cast<char>(code);
      i += 2;
    }
    else
    {
      decoded += word[i];
    }
  }
  return decoded;
}

template <typename T>
T FromBigEndian(const char* bytes)
{
  char reversed[sizeof(T)];
  std::reverse_copy(bytes, bytes + sizeof(T), reversed);
  T value;
  std::memcpy(&value, reversed, sizeof(T));
  return value;
}

}

std::string LegacyArrays::NextKeyword()
{
  this->Cursor.SkipSpace();
  return LowerCase(this->Cursor.NextWord());
}

std::string LegacyArrays::NextName()
{
  this->Cursor.SkipSpace();
  return Decoded(this->Cursor.NextWord());
}

vtkIdType LegacyArrays::NextCount()
{
  this->Cursor.SkipSpace();
  const auto count = this->Cursor.NextNumber<vtkIdType>();
  if (count < 0)
  {
    this->Cursor.Fail("a negative count");
  }
  return count;
}

bool LegacyArrays::IsAtDigit()
{
  this->Cursor.SkipSpace();
  return !this->Cursor.IsAtEnd() && std::isdigit(*this->Cursor.NextBytes(0));
}

vtkSmartPointer<vtkAbstractArray> LegacyArrays::Read(
  const std::string& type, vtkIdType tuples, vtkIdType components)
{
  using Reader = vtkSmartPointer<vtkAbstractArray> (LegacyArrays::*)(vtkIdType, int);
  static const std::map<std::string, Reader> readers = {
    { "bit", &LegacyArrays::ReadBits },
    { "char", &LegacyArrays::ReadPlain<vtkCharArray> },
    { "signed_char", &LegacyArrays::ReadPlain<vtkCharArray> },
    { "unsigned_char", &LegacyArrays::ReadPlain<vtkUnsignedCharArray> },
    { "short", &LegacyArrays::ReadPlain<vtkShortArray> },
    { "unsigned_short", &LegacyArrays::ReadPlain<vtkUnsignedShortArray> },
    { "vtkidtype", &LegacyArrays::ReadIds },
    { "int", &LegacyArrays::ReadPlain<vtkIntArray> },
    { "unsigned_int", &LegacyArrays::ReadPlain<vtkUnsignedIntArray> },
    { "long", &LegacyArrays::ReadPlain<vtkLongArray> },
    { "unsigned_long", &LegacyArrays::ReadPlain<vtkUnsignedLongArray> },
    { "vtktypeint64", &LegacyArrays::ReadPlain<vtkTypeInt64Array> },
    { "vtktypeuint64", &LegacyArrays::ReadPlain<vtkTypeUInt64Array> },
    { "float", &LegacyArrays::ReadPlain<vtkFloatArray> },
    { "double", &LegacyArrays::ReadPlain<vtkDoubleArray> },
    { "string", &LegacyArrays::ReadStrings },
    { "utf8_string", &LegacyArrays::ReadStrings },
  };
  const auto reader = readers.find(LowerCase(type));
  if (reader == readers.end())
  {
    this->Cursor.Fail("an array of an unknown type");
  }
  constexpr vtkIdType mostComponents = 1 << 20;
  if (components < 1 || components > mostComponents || tuples > VTK_ID_MAX / components)
  {
    this->Cursor.Fail("an array of " + std::to_string(tuples) + " tuples of " +
      std::to_string(components) + " components");
  }
  const auto array = (this->*reader->second)(tuples, static_cast<int>(components));
  this->ReadMetaData(array);
  return array;
}

vtkSmartPointer<vtkDataArray> LegacyArrays::ReadNumbers(
  const std::string& type, vtkIdType tuples, vtkIdType components)
{
  const auto array = this->Read(type, tuples, components);
  if (!vtkDataArray::SafeDownCast(array))
  {
    this->Cursor.Fail("an array of strings where numbers belong");
  }
  return vtkDataArray::SafeDownCast(array);
}

template <typename Array>
vtkSmartPointer<vtkAbstractArray> LegacyArrays::ReadPlain(vtkIdType tuples, int components)
{
  this->RequireBytes(tuples * components, sizeof(typename Array::ValueType));
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  this->ReadValues(array->GetPointer(0), tuples * components);
  return array;
}

/// Ids are stored as int.
vtkSmartPointer<vtkAbstractArray> LegacyArrays::ReadIds(vtkIdType tuples, int components)
{
  this->RequireBytes(tuples * components, sizeof(std::int32_t));
  std::vector<std::int32_t> values(tuples * components);
  this->ReadValues(values.data(), tuples * components);
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

template <typename T>
void LegacyArrays::ReadValues(T* values, vtkIdType count)
{
  if (this->IsBinary)
  {
    const char* bytes = this->NextBytes(count * sizeof(T));
    for (vtkIdType i = 0; i < count; ++i)
    {
      values[i] = FromBigEndian<T>(bytes + i * sizeof(T));
    }
    return;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    this->Cursor.SkipSpace();
    values[i] = this->Cursor.NextNumber<T>();
  }
}

/// Binary files have eight bits per byte, the first in the highest place.
vtkSmartPointer<vtkAbstractArray> LegacyArrays::ReadBits(vtkIdType tuples, int components)
{
  const vtkIdType count = tuples * components;
  this->RequireBytes(this->IsBinary ? count / 8 : count, 1);
  auto array = vtkSmartPointer<vtkBitArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::vector<unsigned char> values(this->IsBinary ? (count + 7) / 8 : count);
  this->ReadValues(values.data(), static_cast<vtkIdType>(values.size()));
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetValue(i, this->IsBinary ? values[i / 8] >> (7 - i % 8) & 1 : values[i]);
  }
  return array;
}

/// One line per string in text files; a length and bytes in binary files.
vtkSmartPointer<vtkAbstractArray> LegacyArrays::ReadStrings(vtkIdType tuples, int components)
{
  if (static_cast<std::size_t>(tuples * components) > this->Cursor.GetBytesLeft())
  {
    this->RequireBytes(tuples * components, 1);
  }
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  this->Cursor.SkipLine();
  for (vtkIdType i = 0; i < tuples * components; ++i)
  {
    array->SetValue(i, this->NextString());
  }
  return array;
}

std::string LegacyArrays::NextString()
{
  if (!this->IsBinary)
  {
    if (this->Cursor.IsAtEnd())
    {
      this->Cursor.Fail("the file ends within its strings (truncated or corrupt)");
    }
    const std::string line = this->Cursor.RestOfLine();
    this->Cursor.SkipLine();
    return Decoded(line);
  }
  const std::size_t length = this->NextStringLength();
  this->RequireBytes(static_cast<vtkIdType>(length), 1);
  return { this->Cursor.NextBytes(length), length };
}

/// The highest two bits of the length give its size: 1, 2, 4 or 8 bytes.
std::size_t LegacyArrays::NextStringLength()
{
  this->RequireBytes(1, 1);
  const int kind = static_cast<unsigned char>(*this->Cursor.NextBytes(0)) >> 6;
  const std::size_t size = std::size_t(1) << (3 - kind);
  this->RequireBytes(1, size);
  const char* const bytes = this->Cursor.NextBytes(size);
  std::uint64_t length = static_cast<unsigned char>(bytes[0]) & 0x3f;
  for (std::size_t i = 1; i < size; ++i)
  {
    length = length << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return static_cast<std::size_t>(length);
}

/// A binary value takes `size` bytes. A value in text takes at least a digit and, unless it is the
/// last one, a blank.
void LegacyArrays::RequireBytes(vtkIdType count, std::size_t size) const
{
  const std::size_t left = this->Cursor.GetBytesLeft();
  const std::size_t most = this->IsBinary ? left / size : (left + 1) / 2;
  if (count < 0 || static_cast<std::size_t>(count) > most)
  {
    this->Cursor.Fail(Counted(count, "value") + " do not fit into the " +
      Counted(static_cast<std::int64_t>(left), "byte") + " after it (truncated or corrupt)");
  }
}

/// The bytes after the end of the line.
const char* LegacyArrays::NextBytes(std::size_t size)
{
  if (size == 0)
  {
    return nullptr;
  }
  this->Cursor.SkipLine();
  this->RequireBytes(static_cast<vtkIdType>(size), 1);
  return this->Cursor.NextBytes(size);
}

/// Skips to the blank line at the end.
void LegacyArrays::ReadMetaData(vtkAbstractArray* array)
{
  const TextCursor before = this->Cursor;
  if (this->NextKeyword() != "metadata")
  {
    this->Cursor = before;
    return;
  }
  this->Cursor.SkipLine();
  while (!this->Cursor.IsAtLineEnd())
  {
    const bool namesComponents = LowerCase(this->Cursor.NextWord()) == "component_names";
    this->Cursor.SkipLine();
    for (int i = 0; namesComponents && i < array->GetNumberOfComponents(); ++i)
    {
      array->SetComponentName(i, Decoded(this->Cursor.RestOfLine()).c_str());
      this->Cursor.SkipLine();
    }
  }
}

}
