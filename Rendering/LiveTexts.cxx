// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveTexts.h"

#include "ShownMesh.h"

#include "vtkDelaunayFlip.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <sstream>

namespace delaunayflip
{

const char* const KeyHelp = "space: run/pause   n: next step   b: begin again   "
                            "k: colours   g: edges   i: statistics   d: drawing   q: quit";

namespace
{

/// 1234567 -> "1,234,567"
std::string Group(vtkIdType number)
{
  std::string text = std::to_string(number);
  for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
  {
    text.insert(static_cast<std::size_t>(i), ",");
  }
  return text;
}

/// 2, "flip" -> "2 flips"
std::string Count(vtkIdType number, const std::string& things)
{
  return Group(number) + " " + things + (number == 1 ? "" : "s");
}

std::string DescribeCounts(vtkDelaunayFlip* filter)
{
  return Count(filter->GetTotalFlips(), "flip") + ", " +
    Count(filter->GetNumberOfNonDelaunayEdges(), "bad edge") + " left";
}

/// Why there is no mesh. If the filter's source failed, the filter itself has no message.
std::string GetReason(vtkDelaunayFlip* filter)
{
  const std::string message = filter->GetErrorMessage();
  return message.empty() ? "no input" : message;
}

/// Breaks a text into lines that fit into a window.
std::string Wrap(const std::string& text)
{
  constexpr std::size_t width = 60; // characters
  std::istringstream words(text);
  std::string wrapped;
  std::string word;
  for (std::size_t begin = 0; words >> word; wrapped += word)
  {
    const bool fits = wrapped.size() - begin + 1 + word.size() <= width;
    wrapped += wrapped.empty() ? "" : fits ? " " : "\n";
    begin = fits ? begin : wrapped.size();
  }
  return wrapped;
}

std::string DescribeAngle(double degrees)
{
  if (std::isnan(degrees))
  {
    return {};
  }
  char text[64];
  std::snprintf(text, sizeof(text), "\nsmallest angle %.2f degrees", degrees);
  return text;
}

std::string DescribeState(const LiveStatus& status)
{
  switch (status.State)
  {
    case LiveState::Failed:
      return Wrap("failed: " + GetReason(status.Filter));
    case LiveState::Converged:
      return "converged";
    case LiveState::Limited:
      return "iteration limit";
    case LiveState::Aborted:
      return "aborted";
    default:
      return status.IsRunning ? "running" : "paused";
  }
}

/// After a failure the filter has no counts, so the text says which frame is shown instead.
std::string DescribeMesh(const LiveStatus& status)
{
  const std::string state = DescribeState(status);
  const std::string triangles = Count(status.Triangles, "triangle");
  if (status.State == LiveState::Failed)
  {
    return state + "\nthe mesh of frame " + Group(status.Frame);
  }
  if (status.Frame == 0)
  {
    return "input, " + state + "\n" + triangles;
  }
  if (IsComposite(status.Filter->GetOutputDataObject(0)))
  {
    return "all blocks in one step, " + state + "\n" + DescribeCounts(status.Filter);
  }
  return "iteration " + Group(status.Filter->GetNumberOfIterations()) + ", " + state + "\n" +
    DescribeCounts(status.Filter);
}

}

std::string DescribeStatus(const LiveStatus& status)
{
  const std::string drawing = status.Drawing.empty() ? "" : "\n" + Wrap(status.Drawing);
  return DescribeMesh(status) + DescribeAngle(status.SmallestAngle) + drawing;
}

}
