// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Formats.h"
#include "PointHeader.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

/// @file
/// .xyz, .csv and .txt: a row of text for each point, x y [z] and perhaps more, perhaps after a
/// line of names. Where points make lines, a column has the number of the line. Lines that begin
/// with # or // are comments; the names may be in one.

namespace delaunayflip
{

namespace
{

/// What the numbers of a file of points are like.
class PointTable
{
public:
  PointTable(TextLines& lines, const ChosenColumns& chosen, Content content)
    : Lines(lines),
      Header(ReadHeader(lines, chosen)),
      HasChoice(!chosen.IsEmpty()),
      AreOfLines(content == Content::Segments),
      IsFlat(content == Content::Places || content == Content::Rows),
      KeepsRows(content == Content::Rows)
  {
    this->Coordinates->SetNumberOfComponents(3);
    if (lines.Words.empty())
    {
      return;
    }
    this->FitNames(chosen);
    this->ChooseColumns(chosen);
    this->ReadLines();
    if (!this->AreOfLines)
    {
      this->RefuseIds();
    }
  }

  vtkNew<vtkDoubleArray> Coordinates;
  std::vector<std::int64_t> LineNumbers; ///< Per point, if they are of lines.
  std::vector<std::string> Warnings;
  std::vector<std::string> Notes;
  bool HasAngles = false; ///< Whether x and y are called longitudes and latitudes.

private:
  /// Compares the line of names with the first point. A comment may be anything.
  void FitNames(const ChosenColumns& chosen)
  {
    Words& words = this->Lines.Words;
    Words& names = this->Header.Names;
    const bool isTable = this->Lines.Separator != ' ';
    if (isTable && (!this->Header.IsComment || this->Header.Separator == this->Lines.Separator))
    {
      // Cells at the end may be empty.
      words.resize(std::max(words.size(), names.size()));
    }
    this->Count = words.size();
    if (this->Count < 2)
    {
      this->Lines.Fail("a point has two or three coordinates: x y [z]");
    }
    const bool fits = names.empty() || names.size() == this->Count;
    if (!fits && !this->Header.IsComment && !chosen.AreNumbers())
    {
      this->Lines.Fail("has " + std::to_string(this->Count) +
        " columns, but the line of names has " + std::to_string(names.size()));
    }
    if (!fits)
    {
      this->TellDropped();
      names.clear();
    }
  }

  /// Tells of a line that was taken for one of names, but fits no points.
  void TellDropped()
  {
    if (!this->Header.IsComment)
    {
      this->Warnings.push_back("left out line " + std::to_string(this->Header.Line) +
        ", which has other columns than the first point: " + Quoted(this->Header.Names));
    }
  }

  /// Finds the columns of x, y and, if there is one, z. Tells of all that is left out.
  void ChooseColumns(const ChosenColumns& chosen)
  {
    const Words& names = this->Header.Names;
    if (!chosen.IsEmpty())
    {
      this->Columns = chosen.Find(names);
      const auto last = std::max_element(this->Columns.begin(), this->Columns.end());
      if (this->Columns.empty() || *last >= this->Count)
      {
        const std::string unnamed = std::to_string(this->Count) + " without names";
        this->Lines.FailFile("--columns names another column than there are: " +
          (names.empty() ? unnamed : Quoted(names)));
      }
    }
    else if (!names.empty())
    {
      this->Columns = FindKnownColumns(names);
      if (this->Columns.empty())
      {
        this->Lines.FailFile("which of its columns are x and y? They are " + Quoted(names) +
          "; name them, by name or number, as in --columns 1,2,3");
      }
    }
    else
    {
      this->Columns = { 0, 1 };
      this->Columns.resize(std::min<std::size_t>(this->Count, 3), 2);
      this->RequireNumbers();
    }
    if (this->AreOfLines)
    {
      this->ChooseLineColumn();
    }
    this->TellColumns();
  }

  /// The numbers of lines are in a column of this name, or in the last one of x y [z] line.
  void ChooseLineColumn()
  {
    const Words& names = this->Header.Names;
    this->LineColumn = FindLineColumn(names);
    const bool isPlain = names.empty() && (this->Count == 3 || this->Count == 4);
    if (isPlain)
    {
      this->LineColumn = this->Count - 1;
      this->Columns.resize(this->LineColumn);
    }
    else if (this->LineColumn == names.size())
    {
      this->Lines.FailFile("which of its columns has the number of the line that a point is on? "
                           "The columns of such a file are x,y,line or x,y,z,line");
    }
  }

  /// Without names, the first columns have numbers, or the user says which.
  void RequireNumbers() const
  {
    for (const std::size_t column : this->Columns)
    {
      const std::string_view word = this->Lines.Words[column];
      if (!word.empty() && !IsValue(word))
      {
        this->Lines.FailOn(
          word, " is not a number; where other columns are x, y and z, say which: --columns 2,3,4");
      }
    }
  }

  void TellColumns()
  {
    const Words& names = this->Header.Names;
    const std::size_t axes = std::min<std::size_t>(this->Columns.size(), this->IsFlat ? 2 : 3);
    Words taken, others;
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      taken.emplace_back();
      if (this->Columns[axis] < names.size())
      {
        taken.back() = names[this->Columns[axis]];
      }
    }
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const bool isTaken =
        std::find(this->Columns.begin(), this->Columns.end(), i) != this->Columns.end();
      if (!isTaken && !(this->AreOfLines && i == this->LineColumn))
      {
        others.push_back(names[i]);
      }
    }
    this->HasAngles = AreAngles(taken[0], taken[1]);
    const bool isPlain = std::all_of(
      taken.begin(), taken.end(), [](std::string_view name) { return name.size() == 1; });
    if (!names.empty() && !this->HasChoice && !isPlain)
    {
      this->Notes.push_back("took " + Quoted(taken) + " as " + (axes == 3 ? "x, y, z" : "x, y"));
    }
    const bool lacksHeight = this->Columns.size() == 2 && !this->HasChoice && !this->IsFlat;
    this->TellsOthers =
      others.empty() && names.empty() && !this->AreOfLines && this->Count > this->Columns.size();
    if (!others.empty() && lacksHeight)
    {
      this->Warnings.push_back(
        "left out the columns " + Quoted(others) + "; no name is known as that of z, so z is 0");
    }
    else if (!others.empty())
    {
      this->Warnings.push_back("left out the columns " + Quoted(others));
    }
    else if (this->TellsOthers && this->HasChoice)
    {
      this->Warnings.emplace_back("left out all columns but those of --columns");
    }
    else if (this->TellsOthers)
    {
      this->Warnings.push_back(
        "left out the columns from number " + std::to_string(this->Columns.size() + 1) + " on");
    }
  }

  /// How many columns a line must have. Between blanks no cell is empty, so a missing one would
  /// move the others. Cells between other separators may be empty.
  std::size_t CountRequired() const
  {
    const Words& words = this->Lines.Words;
    if (this->Lines.Separator != ' ')
    {
      return 0;
    }
    if (!this->Header.Names.empty() && !this->Header.IsComment)
    {
      return this->Count;
    }
    const auto text = std::find_if_not(words.begin(), words.end(), IsNumber);
    const auto last = std::find_if(words.rbegin(), words.rend(), IsNumber);
    const bool hasNames = !this->Header.Names.empty() || this->HasChoice;
    if (hasNames)
    {
      return static_cast<std::size_t>(words.rend() - last);
    }
    return static_cast<std::size_t>(text - words.begin());
  }

  void ReadLines()
  {
    TextLines& lines = this->Lines;
    const std::size_t fewest = this->CountRequired();
    const auto text = std::find_if_not(lines.Words.begin(), lines.Words.end(), IsValue);
    this->Numbers = static_cast<std::size_t>(text - lines.Words.begin());
    const std::string_view rest = lines.Rest;
    this->Coordinates->Allocate(3 * (std::count(rest.begin(), rest.end(), '\n') + 2));
    std::int64_t longer = 0; // lines
    std::string firstLonger;
    this->KeepRows(this->Header.EmptyRows);
    do
    {
      const Words& words = lines.Words;
      if (IsComment(lines) || IsBlank(lines))
      {
        this->KeepRows(IsComment(lines) || words.empty() ? 0 : 1);
        continue;
      }
      if (words.size() < fewest)
      {
        lines.Fail("has " + std::to_string(words.size()) + " columns, but " + lines.Noun +
          "s before it have " + std::to_string(fewest) + "; a value is missing");
      }
      // Text at the end may have any number of words. Numbers may come from decimal commas.
      if (words.size() > this->Count &&
        std::all_of(words.begin(), words.begin() + this->Count + 1, IsNumber))
      {
        lines.Fail("begins with more than " + std::to_string(this->Count) +
          " numbers, but the first point has " + std::to_string(this->Count) + " columns");
      }
      if (words.size() > this->Count && longer++ == 0)
      {
        firstLonger = std::to_string(lines.GetLine());
      }
      this->ReadPoint();
    } while (lines.Next());
    if (longer > 0 && !this->TellsOthers)
    {
      this->Warnings.push_back("left out the columns from number " +
        std::to_string(this->Count + 1) + " on, which " + Counted(longer, lines.Noun) +
        (longer == 1 ? " has (" : " have (the first is ") + lines.Noun + " " + firstLonger + ")");
    }
  }

  /// Puts points that are nowhere where rows have empty cells only, if these are wanted.
  void KeepRows(int rows)
  {
    for (int i = 0; i < rows && this->KeepsRows; ++i)
    {
      this->Coordinates->InsertNextTuple3(NAN, NAN, 0.0);
    }
  }

  void ReadPoint()
  {
    const std::string_view first = this->Lines.Words[0];
    this->HasIntegers =
      this->HasIntegers && !first.empty() && first.find_first_not_of("0123456789") == first.npos;
    for (std::size_t i = 0; i < 3; ++i)
    {
      double coordinate = 0.0;
      if (i < this->Columns.size())
      {
        coordinate = this->ReadCoordinate(this->Columns[i], i);
      }
      this->Coordinates->InsertNextValue(coordinate);
    }
    if (this->AreOfLines)
    {
      this->LineNumbers.push_back(this->Lines.Number<std::int64_t>(this->LineColumn));
    }
  }

  double ReadCoordinate(std::size_t column, std::size_t axis)
  {
    Words& words = this->Lines.Words;
    std::string_view word;
    if (column < words.size())
    {
      word = words[column];
    }
    const bool isUnknownHeight = this->AreOfLines && axis == 2 && word.empty();
    if (isUnknownHeight)
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const bool hasPoint = word.find('.') != word.npos;
    std::string text;
    if (word.find(',') != word.npos)
    {
      text = WithPoint(word);
    }
    const bool hasComma = !text.empty();
    this->HasPoints = this->HasPoints || hasPoint;
    this->HasCommas = this->HasCommas || hasComma;
    if (this->HasPoints && hasComma)
    {
      this->Lines.FailOn(word, " has a decimal comma, but numbers before it have a decimal point");
    }
    if (this->HasCommas && hasPoint)
    {
      this->Lines.FailOn(word, " has a decimal point, but numbers before it have a decimal comma");
    }
    this->HasFractions[axis] = this->HasFractions[axis] || hasPoint || hasComma;
    if (hasComma)
    {
      words[column] = text;
    }
    return this->Lines.Number<double>(column);
  }

  /// Without names, a first column of different integers before three coordinates is that of ids,
  /// or could be; and so is one that counts the lines.
  void RefuseIds() const
  {
    const vtkIdType points = this->Coordinates->GetNumberOfTuples();
    const bool hasMore = this->Numbers > 3;
    const vtkIdType fewest = hasMore ? 3 : 10; // fewer may be so by chance
    if (!this->Header.Names.empty() || this->HasChoice || this->Columns.size() < 3 ||
      !this->HasIntegers || points < fewest)
    {
      return;
    }
    std::vector<double> first(points);
    for (vtkIdType i = 0; i < points; ++i)
    {
      first[i] = this->Coordinates->GetTypedComponent(i, 0);
    }
    const auto countUp = [](double a, double b) { return b != a + 1.0; };
    const bool counts = std::adjacent_find(first.begin(), first.end(), countUp) == first.end();
    std::sort(first.begin(), first.end());
    const bool areDifferent = std::adjacent_find(first.begin(), first.end()) == first.end();
    const bool haveFractions = this->HasFractions[1] && this->HasFractions[2];
    if (counts || (hasMore && areDifferent && haveFractions))
    {
      std::string remedy = "--columns 2,3 or 1,2,3";
      if (hasMore)
      {
        remedy = "--columns 2,3,4, or 3,2,4 where northing comes before easting, or 1,2,3";
      }
      this->Lines.FailFile("its first column looks like numbers of points, not like x, and no line "
                           "names the columns; say which are x, y and z: " +
        remedy);
    }
  }

  TextLines& Lines;
  PointHeader Header;
  const bool HasChoice; ///< Whether the user chose the columns.
  const bool AreOfLines; ///< Whether a column has the number of the line that a point is on.
  const bool IsFlat; ///< Whether z does not matter.
  const bool KeepsRows; ///< Whether rows with empty cells only are points, too.
  Places Columns;
  std::size_t LineColumn = 0;
  std::size_t Count = 0; ///< How many columns the first point has.
  std::size_t Numbers = 0; ///< How many numbers the first point begins with.
  bool TellsOthers = false; ///< Whether a warning tells of the columns at the end.
  bool HasIntegers = true; ///< Whether the first column has only integers without a sign.
  bool HasPoints = false;
  bool HasCommas = false;
  std::array<bool, 3> HasFractions = {};
};

}

FileMesh ReadPoints(const InputFile& file, const std::string& columns, Content content)
{
  FileMesh result;
  TextLines lines(file);
  const PointTable table(lines, ChosenColumns(columns), content);
  result.Warnings = table.Warnings;
  result.Notes = table.Notes;
  result.HasAngles = table.HasAngles;
  result.Mesh->SetPoints(vtkNew<vtkPoints>());
  result.Mesh->GetPoints()->SetData(table.Coordinates);
  return result;
}

FileMesh ReadTextLines(const InputFile& file)
{
  FileMesh result;
  TextLines text(file);
  text.Noun = "row";
  const PointTable table(text, ChosenColumns(""), Content::Segments);
  result.Warnings = table.Warnings;
  result.Notes = table.Notes;
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkCellArray> lines;
  const std::vector<std::int64_t>& numbers = table.LineNumbers;
  const auto placeOf = [&table](std::size_t row)
  {
    std::array<double, 3> place;
    table.Coordinates->GetTypedTuple(static_cast<vtkIdType>(row), place.data());
    return place;
  };
  for (std::size_t begin = 0, end = 0; begin < numbers.size(); begin = end)
  {
    const std::int64_t number = numbers[begin];
    end = static_cast<std::size_t>(std::find_if(numbers.begin() + begin, numbers.end(),
                                     [=](auto each) { return each != number; }) -
      numbers.begin());
    if (end - begin == 1)
    {
      file.Fail("the line with the number " + std::to_string(number) +
        " has one point; the points of a line are consecutive rows with the same number");
    }
    std::vector<vtkIdType> ids;
    const bool isClosed = placeOf(begin) == placeOf(end - 1);
    for (std::size_t row = begin; row < end - (isClosed ? 1 : 0); ++row)
    {
      ids.push_back(points->InsertNextPoint(placeOf(row).data()));
    }
    if (isClosed)
    {
      ids.push_back(ids.front());
    }
    lines->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  result.Mesh->SetPoints(points);
  result.Mesh->SetLines(lines);
  return result;
}

}
