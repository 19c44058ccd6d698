// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OUTPUTBUFFER_H
#define DELAUNAYFLIP_OUTPUTBUFFER_H

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace delaunayflip
{

/// Collects the bytes of a file and writes them in large pieces.
class OutputBuffer
{
public:
  explicit OutputBuffer(const std::string& path);

  void Add(std::string_view text);

  /// Adds a decimal number, in any locale, with as many digits as a double needs to be read back
  /// exactly.
  void AddNumber(double number);
  void AddNumber(std::int64_t number);

  /// The bytes of a number, in this machine's order.
  template <typename T>
  void AddBytes(T number)
  {
    this->Add(std::string_view(reinterpret_cast<const char*>(&number), sizeof(T)));
  }

  /// Must be called at the end.
  /// @throws CommandError (BadFile) if the file is incomplete.
  void Close();

private:
  std::ofstream File;
  std::string Bytes;
};

}

#endif
