// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VtkIntegers.h"

#include "InputFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>

namespace delaunayflip
{

namespace
{

bool IsBlank(char letter) { return letter == ' ' || (letter >= '\t' && letter <= '\r'); }

/// Whether a word is an integer that fits into a type, or no integer at all.
template <typename T>
bool Fits(std::string_view word)
{
  const bool isNegative = std::is_unsigned_v<T> && word.substr(0, 1) == "-";
  if (isNegative)
  {
    const std::string_view digits = word.substr(1);
    return digits.find_first_not_of('0') == digits.npos ||
      digits.find_first_not_of("0123456789") != digits.npos;
  }
  T value = 0;
  return ReadNumber(word, value) != std::errc::result_out_of_range;
}

struct IntegerType
{
  std::string_view Name;
  bool (*Fits)(std::string_view);
};

constexpr IntegerType IntegerTypes[] = {
  { "UInt8", Fits<std::uint8_t> },
  { "UInt16", Fits<std::uint16_t> },
  { "UInt32", Fits<std::uint32_t> },
  { "UInt64", Fits<std::uint64_t> },
  { "Int8", Fits<std::int8_t> },
  { "Int16", Fits<std::int16_t> },
  { "Int32", Fits<std::int32_t> },
  { "Int64", Fits<std::int64_t> },
  { "unsigned_char", Fits<std::uint8_t> },
  { "unsigned_short", Fits<std::uint16_t> },
  { "unsigned_int", Fits<std::uint32_t> },
  { "unsigned_long", Fits<unsigned long> },
  { "vtktypeuint64", Fits<std::uint64_t> },
  { "char", Fits<char> },
  { "signed_char", Fits<std::int8_t> },
  { "short", Fits<std::int16_t> },
  { "int", Fits<std::int32_t> },
  { "long", Fits<long> },
  { "vtktypeint64", Fits<std::int64_t> },
};

/// Takes the next word from a text; empty at its end.
std::string_view TakeWord(std::string_view& text)
{
  const char* const end = text.data() + text.size();
  const char* const first = std::find_if_not(text.data(), end, IsBlank);
  const char* const last = std::find_if(first, end, IsBlank);
  text.remove_prefix(static_cast<std::size_t>(last - text.data()));
  return { first, static_cast<std::size_t>(last - first) };
}

std::string Lower(std::string_view word)
{
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return lower;
}

/// Attributes with a name, a type and as many components.
struct AttributeKind
{
  std::string_view Keyword;
  std::int64_t Components;
};

constexpr AttributeKind AttributeKinds[] = { { "vectors", 3 }, { "normals", 3 }, { "tensors", 9 },
  { "tensors6", 6 }, { "global_ids", 1 }, { "pedigree_ids", 1 }, { "edge_flags", 1 } };

/// Goes through the words of a .vtk that VTK has read without complaint.
class LegacyText
{
public:
  explicit LegacyText(const InputFile& file)
    : File(file),
      Text(file.GetBytes())
  {
    this->SkipLine(); // the version
    this->SkipLine(); // the title
  }

  void Check()
  {
    if (Lower(this->Take()) != "ascii")
    {
      return;
    }
    for (std::string_view word = this->Take(); !word.empty(); word = this->Take())
    {
      if (std::isalpha(static_cast<unsigned char>(word.front())))
      {
        this->CheckSection(Lower(word));
      }
    }
  }

private:
  std::string_view Take() { return TakeWord(this->Text); }

  /// @returns what is left of the line.
  std::string_view SkipLine()
  {
    const std::string_view line = this->Text.substr(0, this->Text.find('\n'));
    this->Text.remove_prefix(std::min(line.size() + 1, this->Text.size()));
    return line;
  }

  std::int64_t TakeCount() { return this->CountOf(this->Take(), 0); }

  /// @param other where the word is no number.
  std::int64_t CountOf(std::string_view word, std::int64_t other) const
  {
    std::int64_t count = other;
    ReadNumber(word, count);
    return std::clamp<std::int64_t>(
      count, 0, static_cast<std::int64_t>(this->File.GetBytes().size()));
  }

  void CheckSection(const std::string& keyword)
  {
    const auto* const kind = std::find_if(std::begin(AttributeKinds), std::end(AttributeKinds),
      [&keyword](const AttributeKind& one) { return one.Keyword == keyword; });
    if (kind != std::end(AttributeKinds))
    {
      const std::string_view name = this->Take();
      this->CheckArray(name, this->Take(), kind->Components * this->Tuples);
    }
    else if (keyword == "points")
    {
      const std::int64_t points = this->TakeCount();
      this->CheckArray("", this->Take(), 3 * points);
    }
    else if (keyword == "point_data" || keyword == "cell_data")
    {
      this->Tuples = this->TakeCount();
    }
    else if (keyword == "scalars")
    {
      this->CheckScalars();
    }
    else if (keyword == "texture_coordinates")
    {
      const std::string_view name = this->Take();
      const std::int64_t components = this->TakeCount();
      this->CheckArray(name, this->Take(), components * this->Tuples);
    }
    else if (keyword == "color_scalars")
    {
      this->Take();
      this->Skip(this->TakeCount() * this->Tuples);
    }
    else if (keyword == "lookup_table")
    {
      constexpr std::int64_t Channels = 4;
      this->Take();
      this->Skip(this->TakeCount() * Channels);
    }
    else if (keyword == "field")
    {
      this->CheckField();
    }
    else if (keyword == "metadata")
    {
      this->SkipMetadata();
    }
  }

  /// The number of components may be missing; a table of colors is named in any case. VTK reads
  /// words, whatever lines they are in.
  void CheckScalars()
  {
    const std::string_view name = this->Take();
    const std::string_view type = this->Take();
    std::int64_t components = 1;
    const std::string_view next = this->Take();
    if (Lower(next) != "lookup_table")
    {
      components = this->CountOf(next, 1);
      this->Take(); // LOOKUP_TABLE
    }
    this->Take(); // the name of the table
    this->CheckArray(name, type, components * this->Tuples);
  }

  /// The first word of what is left of a line.
  std::string_view TakeRest()
  {
    std::string_view line = this->SkipLine();
    return TakeWord(line);
  }

  void CheckField()
  {
    this->Take(); // its name
    for (std::int64_t arrays = this->TakeCount(); arrays > 0 && !this->Text.empty(); --arrays)
    {
      std::string_view name = this->Take();
      if (Lower(name) == "metadata")
      {
        this->SkipMetadata();
        name = this->Take();
      }
      if (Lower(name) == "null_array")
      {
        continue;
      }
      const std::int64_t components = this->TakeCount();
      const std::int64_t tuples = this->TakeCount();
      this->CheckArray(name, this->Take(), components * tuples);
    }
  }

  /// It ends with an empty line.
  void SkipMetadata()
  {
    this->SkipLine();
    while (!this->Text.empty() && !this->TakeRest().empty())
    {
    }
  }

  void Skip(std::int64_t words)
  {
    for (std::int64_t i = 0; i < words && !this->Take().empty(); ++i)
    {
    }
  }

  /// @param name of the array; empty for that of the points.
  void CheckArray(std::string_view name, std::string_view type, std::int64_t count)
  {
    const std::string kind = Lower(type);
    if (kind == "string" || kind == "utf8_string")
    {
      this->SkipLine();
      for (std::int64_t i = 0; i < count && !this->Text.empty(); ++i)
      {
        this->SkipLine();
      }
      return;
    }
    const std::string_view text = this->Text;
    this->Skip(count);
    RequireIntegers(this->File, name.empty() ? "of POINTS" : "'" + std::string(name) + "'", kind,
      text.substr(0, text.size() - this->Text.size()));
  }

  const InputFile& File;
  std::string_view Text; ///< What is left.
  std::int64_t Tuples = 0; ///< How many attributes now have.
};

}

void RequireIntegers(
  const InputFile& file, const std::string& name, std::string_view type, std::string_view text)
{
  const auto* const known = std::find_if(std::begin(IntegerTypes), std::end(IntegerTypes),
    [type](const IntegerType& one) { return one.Name == type; });
  if (known == std::end(IntegerTypes))
  {
    return;
  }
  for (std::string_view word = TakeWord(text); !word.empty(); word = TakeWord(text))
  {
    if (!known->Fits(word))
    {
      file.Fail(std::string(word.substr(0, 40)) + " in the array " + name +
        " does not fit into its type " + std::string(type));
    }
  }
}

void RequireIntegersOfLegacy(const InputFile& file) { LegacyText(file).Check(); }

}
