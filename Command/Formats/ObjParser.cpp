// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ObjParser.h"

#include <algorithm>
#include <cctype>

namespace delaunayflip
{

namespace
{

constexpr std::int64_t None = CornerVectors::None;

/// The numbers of a vertex, its texture coordinates and its normal.
using Corner = std::array<std::int64_t, 3>;

/// Puts a value at `place`, after filling in the values that were left out before it.
template <typename T>
void PutAt(std::vector<T>& values, std::size_t place, T value, T leftOut)
{
  values.resize(place, leftOut);
  values.push_back(value);
}

class ObjParser
{
public:
  /// @param limits how many vertices, texture coordinates and normals the file has, as far as known
  ObjParser(const InputFile& file, const Corner& limits)
    : Cursor(file),
      Limits(limits)
  {
    this->Cursor.ContinueLines();
    this->Cursor.EndLinesAt('#');
  }

  void Parse()
  {
    for (this->Cursor.SkipSpace(); !this->Cursor.IsAtEnd(); this->Cursor.SkipSpace())
    {
      this->ParseLine(this->Cursor.NextWord());
      this->Cursor.SkipLine();
    }
  }

  /// Checked at the end, because indices may refer to later lines.
  bool HasInvalidIndices() const
  {
    const Corner counts = this->Count();
    return !std::equal(
      this->Highest.begin(), this->Highest.end(), counts.begin(), std::less_equal<std::int64_t>());
  }

  Corner Count() const
  {
    return { static_cast<std::int64_t>(this->Content.Positions.size() / 3),
      static_cast<std::int64_t>(this->Content.Textures.size() / 3),
      static_cast<std::int64_t>(this->Content.Normals.size() / 3) };
  }

  ObjContent Content;

private:
  void ParseLine(std::string_view keyword)
  {
    if (keyword == "v")
    {
      this->ParseVertex();
    }
    else if (keyword == "f")
    {
      this->ParseCell(this->Content.Faces, 3);
    }
    else if (keyword == "vn")
    {
      this->ParseVector(this->Content.Normals, 3);
    }
    else if (keyword == "vt")
    {
      this->ParseVector(this->Content.Textures, 1);
    }
    else if (keyword == "l")
    {
      this->ParseCell(this->Content.Lines, 2);
    }
    else if (keyword == "p")
    {
      this->ParseCell(this->Content.Verts, 1);
    }
    else if (keyword == "mtllib")
    {
      this->Content.Libraries.push_back(this->Cursor.RestOfLine());
    }
    else if (!this->ParseLabel(keyword))
    {
      this->CountUnknown(keyword);
    }
  }

  /// A vertex is x y z, then perhaps a weight, then perhaps a color.
  void ParseVertex()
  {
    const std::size_t vertex = this->Content.Positions.size();
    std::array<double, 7> values = {};
    std::size_t count = 0;
    while (!this->Cursor.IsAtLineEnd() && count < values.size())
    {
      values[count++] = this->Cursor.NextNumber<double>();
    }
    if (count < 3 || !this->Cursor.IsAtLineEnd())
    {
      this->Cursor.Fail(count < 3 ? "a vertex with fewer than three coordinates"
                                  : "a vertex with more than seven numbers");
    }
    this->Content.Positions.insert(
      this->Content.Positions.end(), values.begin(), values.begin() + 3);
    if (count >= 6)
    {
      this->Content.Colors.resize(vertex, std::numeric_limits<double>::quiet_NaN());
      this->Content.Colors.insert(
        this->Content.Colors.end(), values.begin() + count - 3, values.begin() + count);
    }
  }

  /// Three numbers; those after the first `fewest` may be left out.
  void ParseVector(std::vector<double>& values, int fewest)
  {
    for (int i = 0; i < 3; ++i)
    {
      const bool isLeftOut = i >= fewest && this->Cursor.IsAtLineEnd();
      values.push_back(isLeftOut ? 0.0 : this->Cursor.NextNumber<double>());
    }
  }

  void ParseCell(ObjCells& cells, int fewest)
  {
    int corners = 0;
    for (; !this->Cursor.IsAtLineEnd(); ++corners)
    {
      const Corner corner = this->ParseCorner(this->Cursor.NextWord());
      const std::size_t place = cells.Points.size();
      cells.Points.push_back(corner[0]);
      if (corner[1] != None)
      {
        PutAt(cells.Textures, place, corner[1], None);
      }
      if (corner[2] != None)
      {
        PutAt(cells.Normals, place, corner[2], None);
      }
    }
    if (corners < fewest)
    {
      this->Cursor.Fail("fewer than " + std::to_string(fewest) + " corners");
    }
    this->EndCell(cells);
  }

  void EndCell(ObjCells& cells)
  {
    for (std::size_t label = 0; label < ObjLabels.size(); ++label)
    {
      if (!this->Content.Names[label].empty())
      {
        PutAt(cells.Labels[label], cells.Ends.size(), this->Current[label], -1);
      }
    }
    cells.Ends.push_back(static_cast<vtkIdType>(cells.Points.size()));
  }

  /// A corner is vertex, vertex/texture, vertex/texture/normal or vertex//normal.
  Corner ParseCorner(std::string_view word)
  {
    Corner corner = { None, None, None };
    const Corner seen = this->Count();
    const char* here = word.data();
    const char* const end = here + word.size();
    for (std::size_t kind = 0; kind < corner.size(); ++kind)
    {
      std::int64_t index = 0;
      const auto [next, error] = std::from_chars(here, end, index);
      const bool isLeftOut = kind > 0 && (here == end || *here == '/');
      if (!isLeftOut)
      {
        const bool isIndex = error == std::errc() && (next == end || *next == '/');
        corner[kind] = isIndex ? this->Resolve(kind, index, seen[kind]) : this->FailOn(word);
      }
      here = isLeftOut ? here : next;
      if (here == end)
      {
        return corner;
      }
      ++here; // the slash
    }
    this->FailOn(word);
  }

  [[noreturn]] std::int64_t FailOn(std::string_view word)
  {
    std::string text(word.substr(0, 40));
    std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
    this->Cursor.Fail("'" + text + "' is not an index");
  }

  /// In the file, index 1 is the first element, and -1 the last one before this line.
  std::int64_t Resolve(std::size_t kind, std::int64_t index, std::int64_t seen)
  {
    if (index == 0 || index < -seen || index > this->Limits[kind])
    {
      this->Cursor.Fail("index " + std::to_string(index) + " is out of range");
    }
    this->Highest[kind] = std::max(this->Highest[kind], index);
    return index < 0 ? seen + index : index - 1;
  }

  bool ParseLabel(std::string_view keyword)
  {
    const auto found = std::find_if(ObjLabels.begin(), ObjLabels.end(),
      [keyword](const ObjLabel& label) { return label.Keyword == keyword; });
    if (found == ObjLabels.end())
    {
      return false;
    }
    const auto label = static_cast<std::size_t>(found - ObjLabels.begin());
    const std::string name = this->Cursor.RestOfLine();
    if (name.empty())
    {
      this->Current[label] = -1;
      return true;
    }
    const auto next = static_cast<int>(this->Content.Names[label].size());
    const auto [place, isNew] = this->Known[label].try_emplace(name, next);
    if (isNew)
    {
      this->Content.Names[label].push_back(name);
    }
    this->Current[label] = place->second;
    return true;
  }

  void CountUnknown(std::string_view keyword)
  {
    const bool isWord = std::all_of(keyword.begin(), keyword.end(),
      [](unsigned char letter) { return std::isalnum(letter) || letter == '_'; });
    if (!isWord)
    {
      this->Cursor.Fail("not a line of an OBJ file");
    }
    ++this->Content.Unknown[std::string(keyword)];
  }

  TextCursor Cursor;
  Corner Limits;
  Corner Highest = {};
  std::array<std::map<std::string, int>, ObjLabels.size()> Known;
  std::array<int, ObjLabels.size()> Current = { -1, -1, -1, -1 };
};

}

ObjContent ParseObj(const InputFile& file)
{
  constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
  ObjParser parser(file, { any, any, any });
  parser.Parse();
  if (parser.HasInvalidIndices())
  {
    ObjParser(file, parser.Count()).Parse(); // fails, on the line
  }
  return std::move(parser.Content);
}

}
