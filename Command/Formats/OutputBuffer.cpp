// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OutputBuffer.h"

#include "CommandError.h"

#include <charconv>
#include <cmath>

namespace delaunayflip
{

namespace
{

constexpr std::size_t PieceSize = 1 << 20;

}

OutputBuffer::OutputBuffer(const std::string& path)
  : File(path, std::ios::binary)
{
  this->Bytes.reserve(2 * PieceSize);
}

void OutputBuffer::Add(std::string_view text)
{
  this->Bytes += text;
  if (this->Bytes.size() >= PieceSize)
  {
    this->File.write(this->Bytes.data(), static_cast<std::streamsize>(this->Bytes.size()));
    this->Bytes.clear();
  }
}

void OutputBuffer::AddNumber(double number)
{
  char text[32];
  char* const end = std::to_chars(text, text + sizeof(text), number).ptr;
  // A NaN may have a sign, which is left out.
  this->Add(
    std::isnan(number) ? "nan" : std::string_view(text, static_cast<std::size_t>(end - text)));
}

void OutputBuffer::AddNumber(std::int64_t number)
{
  char text[32];
  char* const end = std::to_chars(text, text + sizeof(text), number).ptr;
  this->Add(std::string_view(text, static_cast<std::size_t>(end - text)));
}

void OutputBuffer::Close()
{
  this->File.write(this->Bytes.data(), static_cast<std::streamsize>(this->Bytes.size()));
  this->Bytes.clear();
  this->File.close();
  if (!this->File)
  {
    throw CommandError(ExitCode::BadFile, "the file is incomplete");
  }
}

}
