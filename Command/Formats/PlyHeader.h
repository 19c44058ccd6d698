// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYHEADER_H
#define DELAUNAYFLIP_PLYHEADER_H

#include "InputFile.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace delaunayflip
{

enum class PlyType
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Float32,
  Float64
};

/// Calls `function` with a zero of the type.
template <typename Function>
decltype(auto) VisitPlyType(PlyType type, const Function& function)
{
  switch (type)
  {
    case PlyType::Int8:
      return function(std::int8_t(0));
    case PlyType::UInt8:
      return function(std::uint8_t(0));
    case PlyType::Int16:
      return function(std::int16_t(0));
    case PlyType::UInt16:
      return function(std::uint16_t(0));
    case PlyType::Int32:
      return function(std::int32_t(0));
    case PlyType::UInt32:
      return function(std::uint32_t(0));
    case PlyType::Float32:
      return function(float(0));
    default:
      return function(double(0));
  }
}

struct PlyProperty
{
  std::string Name;
  PlyType Type; ///< Of a list: of its items.
  std::optional<PlyType> CountType; ///< Of a list: of the number of its items.
};

struct PlyElement
{
  std::string Name;
  std::int64_t Count = 0;
  std::vector<PlyProperty> Properties;

  bool HasLists() const;
};

enum class PlyEncoding
{
  Text,
  LittleEndian,
  BigEndian
};

/// What the header of a .ply says about the body.
struct PlyHeader
{
  PlyEncoding Encoding = PlyEncoding::Text;
  std::vector<PlyElement> Elements; ///< In the order of the body.
  std::size_t Size = 0; ///< The number of bytes before the body.

  /// The number of elements of a name, 0 where there are none.
  std::int64_t CountOf(const std::string& element) const;
};

/// Reads the header of a .ply. The file is long enough for the counts in it.
/// @throws CommandError (BadFile) that names the file, the line and the reason.
PlyHeader ReadPlyHeader(const InputFile& file);

}

#endif
