// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkTable.h"

#include <cstdio>

namespace delaunayflip
{
namespace
{

/// A number of a row. A new one is a line in Columns and its member in BenchmarkRow.
struct Column
{
  const char* Key; ///< In JSON.
  const char* Heading;
  int Width;
  int Digits; ///< After the decimal point.
  double (*Get)(const BenchmarkRow& row); ///< NaN where it does not apply.
};

double FromCount(std::int64_t count) { return count < 0 ? NAN : static_cast<double>(count); }

const Column Columns[] = {
  { "points", "points", 10, 0, [](const BenchmarkRow& row) { return FromCount(row.Points); } },
  { "triangles", "triangles", 10, 0,
    [](const BenchmarkRow& row) { return FromCount(row.Triangles); } },
  { "repetitions", "runs", 4, 0, [](const BenchmarkRow& row) { return double(row.Repetitions); } },
  { "build_ms", "build ms", 9, 2, [](const BenchmarkRow& row) { return row.Build; } },
  { "flips_ms", "flips ms", 9, 2, [](const BenchmarkRow& row) { return row.Flips; } },
  { "store_ms", "store ms", 9, 2, [](const BenchmarkRow& row) { return row.Store; } },
  { "total_ms", "total ms", 9, 2, [](const BenchmarkRow& row) { return row.Total; } },
  { "times_cuda", "x CUDA", 7, 2, [](const BenchmarkRow& row) { return row.TimesCuda; } },
  { "flips", "flips", 10, 0, [](const BenchmarkRow& row) { return FromCount(row.TotalFlips); } },
  { "iterations", "iter.", 6, 0,
    [](const BenchmarkRow& row) { return FromCount(row.Iterations); } },
  { "left", "left", 5, 0, [](const BenchmarkRow& row) { return FromCount(row.Left); } },
  { "device_bytes_per_point", "GPU B/pt", 8, 1,
    [](const BenchmarkRow& row) { return row.DeviceBytes; } },
};

constexpr int MeshWidth = 34;
constexpr int ProgramWidth = 22;

std::string Pad(const std::string& text, int width)
{
  const std::size_t wanted = static_cast<std::size_t>(width);
  return text.size() < wanted ? text + std::string(wanted - text.size(), ' ') : text;
}

std::string PadLeft(const std::string& text, int width)
{
  const std::size_t wanted = static_cast<std::size_t>(width);
  return text.size() < wanted ? std::string(wanted - text.size(), ' ') + text : text;
}

std::string FormatNumber(double number, int digits, const std::string& none)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, number);
  return std::isnan(number) ? none : text;
}

std::string FormatJsonRow(const BenchmarkRow& row)
{
  std::string text = "{\"mesh\": " + QuoteJson(row.Mesh) +
    ", \"program\": " + QuoteJson(row.Program) + ", \"note\": " + QuoteJson(row.Note) +
    ", \"failed\": " + (row.HasFailed ? "true" : "false");
  for (const Column& column : Columns)
  {
    const int digits = column.Digits == 0 ? 0 : 4;
    text +=
      std::string(", \"") + column.Key + "\": " + FormatNumber(column.Get(row), digits, "null");
  }
  return text + "}";
}

}

std::string FormatHeading()
{
  std::string text = Pad("mesh", MeshWidth) + " " + Pad("program", ProgramWidth);
  for (const Column& column : Columns)
  {
    text += " " + PadLeft(column.Heading, column.Width);
  }
  return text;
}

std::string FormatRow(const BenchmarkRow& row)
{
  std::string text = Pad(row.Mesh, MeshWidth) + " " + Pad(row.Program, ProgramWidth);
  for (const Column& column : Columns)
  {
    text += " " + PadLeft(FormatNumber(column.Get(row), column.Digits, "-"), column.Width);
  }
  return row.Note.empty() ? text : text + "  " + row.Note;
}

std::string QuoteJson(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      quoted += '\\';
    }
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string FormatJson(const std::vector<BenchmarkRow>& rows)
{
  std::string text = "[";
  for (const BenchmarkRow& row : rows)
  {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + FormatJsonRow(row);
  }
  return text + "\n  ]";
}

}
