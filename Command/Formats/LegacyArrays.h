// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LEGACYARRAYS_H
#define DELAUNAYFLIP_LEGACYARRAYS_H

#include "TextCursor.h"

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <string>

namespace delaunayflip
{

/// Reads the arrays of a legacy .vtk, as text or big-endian binary.
class LegacyArrays
{
public:
  explicit LegacyArrays(TextCursor& cursor)
    : Cursor(cursor)
  {
  }

  void SetBinary() { this->IsBinary = true; }
  bool GetBinary() const { return this->IsBinary; }

  /// The next word in lower case, in this line or a later one; empty at the end of the file.
  std::string NextKeyword();

  /// The next word, decoded: a blank is written as %20.
  std::string NextName();

  /// The next word as a non-negative number.
  vtkIdType NextCount();

  /// Whether the next word begins with a digit.
  bool IsAtDigit();

  /// @throws CommandError (BadFile): the file, the line and the reason.
  [[noreturn]] void Fail(const std::string& reason) const { this->Cursor.Fail(reason); }

  /// Reads an array and, if they follow, the names of its components. `type` is named as in the
  /// format. Other metadata that follow, such as ranges, are ignored.
  /// @throws CommandError (BadFile). If the file is too short, this happens before memory is
  /// allocated.
  vtkSmartPointer<vtkAbstractArray> Read(
    const std::string& type, vtkIdType tuples, vtkIdType components);

  /// The same, only for types of numbers.
  vtkSmartPointer<vtkDataArray> ReadNumbers(
    const std::string& type, vtkIdType tuples, vtkIdType components);

private:
  template <typename Array>
  vtkSmartPointer<vtkAbstractArray> ReadPlain(vtkIdType tuples, int components);
  template <typename T>
  void ReadValues(T* values, vtkIdType count);
  vtkSmartPointer<vtkAbstractArray> ReadIds(vtkIdType tuples, int components);
  vtkSmartPointer<vtkAbstractArray> ReadBits(vtkIdType tuples, int components);
  vtkSmartPointer<vtkAbstractArray> ReadStrings(vtkIdType tuples, int components);
  std::string NextString();
  std::size_t NextStringLength();
  void RequireBytes(vtkIdType count, std::size_t size) const;
  const char* NextBytes(std::size_t size);
  void ReadMetaData(vtkAbstractArray* array);

  TextCursor& Cursor;
  bool IsBinary = false;
};

}

#endif
