// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RoundedDigits.h"

#include "FlipReport.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string_view>
#include <vector>

namespace delaunayflip
{

namespace
{

constexpr vtkIdType SampleSize = 10000; ///< Points and cells that are looked at.

/// The shortest decimal number that is read as this one.
struct Decimal
{
  int Digits; ///< Significant ones.
  int Exponent; ///< The power of ten of the first digit.

  int GetDigits() const { return this->Digits; }
  /// How many digits are behind the point.
  int CountDecimals() const { return this->Digits - 1 - this->Exponent; }
};

template <typename Real>
Decimal ToDecimal(Real value)
{
  std::array<char, 64> text;
  const char* const end =
    std::to_chars(text.data(), std::end(text), std::abs(value), std::chars_format::scientific).ptr;
  const std::string_view number(text.data(), end - text.data());
  const std::size_t mark = number.find('e');
  const int digits = static_cast<int>(mark > 1 ? mark - 1 : 1); // without the point
  return { digits, std::atoi(std::string(number.substr(mark + 1)).c_str()) };
}

/// Some of the coordinates of a mesh.
class CoordinateSample
{
public:
  explicit CoordinateSample(vtkPolyData* mesh)
  {
    const vtkIdType count = mesh->GetNumberOfPoints();
    const bool areFloats = mesh->GetPoints()->GetDataType() == VTK_FLOAT;
    if (!areFloats)
    {
      this->MostDigits = 12;
    }
    for (vtkIdType i = 0; i < count; i += 1 + count / SampleSize)
    {
      std::array<double, 3> point;
      mesh->GetPoint(i, point.data());
      ++this->Points;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double x = point[axis];
        this->Distinct[axis].insert(x);
        if (x != 0.0 && std::isfinite(x))
        {
          this->Numbers.push_back(areFloats ? ToDecimal(static_cast<float>(x)) : ToDecimal(x));
        }
      }
    }
  }

  /// The unit of the last place to which they were rounded; 0 if they were not, or are a lattice.
  /// @param digits receives how many there are.
  double FindUnit(int& digits) const
  {
    if (this->Points < FewestPoints || this->Numbers.empty() || this->IsLattice())
    {
      return 0.0;
    }
    const int exponent = this->FindUsual([](const Decimal& number) { return number.Exponent; });
    digits = this->FindUsual([](const Decimal& number) { return number.Digits; });
    if (digits <= this->MostDigits && this->AreMostly(&Decimal::GetDigits, digits))
    {
      return std::pow(10.0, exponent - digits + 1);
    }
    const int decimals =
      this->FindUsual([](const Decimal& number) { return number.CountDecimals(); });
    digits = exponent + 1 + decimals;
    const bool areFixed =
      digits <= this->MostDigits && this->AreMostly(&Decimal::CountDecimals, decimals);
    return areFixed ? std::pow(10.0, -decimals) : 0.0;
  }

private:
  /// Numbers that were not rounded have more digits: floats at least 8, doubles mostly 16.
  int MostDigits = 7;
  static constexpr std::size_t FewestPoints = 100; ///< Others may have short numbers by chance.

  /// The largest value of 99 % of the numbers; a few of another origin may have more.
  template <typename Get>
  int FindUsual(const Get& get) const
  {
    std::vector<int> values;
    std::transform(this->Numbers.begin(), this->Numbers.end(), std::back_inserter(values), get);
    const auto usual = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
    std::nth_element(values.begin(), usual, values.end());
    return *usual;
  }

  /// Whether no axis has many different coordinates.
  bool IsLattice() const
  {
    return std::all_of(this->Distinct.begin(), this->Distinct.end(),
      [this](const std::set<double>& values) { return 4 * values.size() < this->Points; });
  }

  /// Whether so many digits are used as far as can be expected: a tenth of all numbers end with 0.
  bool AreMostly(int (Decimal::*count)() const, int wanted) const
  {
    const auto used = std::count_if(this->Numbers.begin(), this->Numbers.end(),
      [=](const Decimal& number) { return (number.*count)() == wanted; });
    return 4 * static_cast<std::size_t>(used) >= 3 * this->Numbers.size();
  }

  std::vector<Decimal> Numbers;
  std::array<std::set<double>, 3> Distinct;
  std::size_t Points = 0;
};

/// The median length of the first edges of polygons.
double FindMedianEdge(vtkPolyData* mesh)
{
  std::vector<double> squares;
  vtkCellArray* polygons = mesh->GetPolys();
  const vtkIdType count = polygons->GetNumberOfCells();
  const vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < count; cell += 1 + count / SampleSize)
  {
    polygons->GetCellAtId(cell, corners);
    if (corners->GetNumberOfIds() < 2)
    {
      continue;
    }
    std::array<double, 3> from, to;
    mesh->GetPoint(corners->GetId(0), from.data());
    mesh->GetPoint(corners->GetId(1), to.data());
    squares.push_back(vtkMath::Distance2BetweenPoints(from.data(), to.data()));
  }
  if (squares.empty())
  {
    return 0.0;
  }
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(*middle);
}

}

RoundedCoordinates FindRounding(vtkPolyData* mesh)
{
  RoundedCoordinates rounded;
  const double unit = CoordinateSample(mesh).FindUnit(rounded.Digits);
  const double length = FindMedianEdge(mesh);
  constexpr double Units = 4.0; // a triangle has three points, and the angle two
  constexpr double Largest = 0.1; // radians, beyond which the mesh itself is rounded away
  const double tolerance = length > 0.0 ? Units * unit / length : 0.0;
  if (tolerance <= Largest)
  {
    rounded.Tolerance = std::stod(FormatNumber(tolerance, 1)); // as the summary says it
  }
  return rounded;
}

std::string DescribeRounding(const RoundedCoordinates& rounded)
{
  return "hint: coordinates are rounded to " + std::to_string(rounded.Digits) +
    " digits, which makes edges bad; --tolerance " + FormatNumber(rounded.Tolerance, 1) +
    " leaves alone those that are bad by no more\n";
}

}
