// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYARRAYS_H
#define DELAUNAYFLIP_PLYARRAYS_H

#include "PlyHeader.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <cstring>
#include <vector>

class vtkDataSetAttributes;

namespace delaunayflip
{

/// Stores the values of a scalar property one after the other; ignores the values of a list.
class PlyColumn
{
public:
  PlyColumn() = default;
  PlyColumn(PlyType type, vtkDataArray* array, int component);

  template <typename Values>
  void Store(Values& values)
  {
    VisitPlyType(this->Type,
      [this, &values](auto zero)
      {
        const auto value = values.template Next<decltype(zero)>();
        this->Widens ? this->Put(static_cast<double>(value)) : this->Put(value);
      });
  }

private:
  template <typename T>
  void Put(T value)
  {
    std::memcpy(this->Next, &value, sizeof(T));
    this->Next += this->Stride;
  }

  PlyType Type = PlyType::Int8;
  bool Widens = false; ///< Whether the array has doubles although the property does not.
  char* Next = nullptr;
  std::size_t Stride = 0;
};

/// The scalar properties of one kind of element, as arrays. Some, such as red, green and blue,
/// become components of one array; the others have one array each, with their own name and type.
class PlyArrays
{
public:
  explicit PlyArrays(const PlyElement& element);

  /// A column for every property.
  std::vector<PlyColumn> Columns;

  /// Takes out the array of x, y and z; null if there is none.
  vtkSmartPointer<vtkDataArray> TakePoints();

  /// Adds the arrays, with these numbers of zero tuples before and after them.
  void AddTo(vtkDataSetAttributes* data, vtkIdType before = 0, vtkIdType after = 0) const;

private:
  using Members = std::vector<std::size_t>;
  Members FindMembers(const std::vector<std::string>& names) const;
  void AddArray(const std::string& name, const Members& members);

  const PlyElement& Element;
  std::vector<bool> Assigned;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays;
};

}

#endif
