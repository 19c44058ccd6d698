// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveRun.h"

#include "vtkAppendPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDelaunayFlip.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

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

std::string DescribeState(const LiveStatus& status)
{
  switch (status.State)
  {
    case LiveState::Failed:
    {
      // If the filter's source failed, the filter itself has no message.
      const std::string reason = status.Filter->GetErrorMessage();
      return Wrap("failed: " + (reason.empty() ? "no input" : reason));
    }
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

/// An update caused only by a change of the input or of an option is a step too.
LiveStep MakeStep(vtkDelaunayFlip* filter, bool withholdsMesh)
{
  const vtkMTimeType before = filter->GetOutputDataObject(0)->GetUpdateTime();
  bool works = true;
  if (withholdsMesh)
  {
    works = filter->AdvanceSession();
  }
  else
  {
    filter->Advance();
    works = filter->GetExecutive()->Update(0) != 0;
  }
  const bool isWithheld = filter->GetMeshIsWithheld();
  if (!works || filter->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
  {
    return { LiveState::Failed, isWithheld };
  }
  const bool isNew = filter->GetOutputDataObject(0)->GetUpdateTime() != before;
  const int reason = filter->GetStopReason();
  const LiveState state = !isNew                             ? LiveState::Unchanged
    : reason == vtkDelaunayFlip::STOP_REASON_RUNNING         ? LiveState::UnderWay
    : reason == vtkDelaunayFlip::STOP_REASON_ABORTED         ? LiveState::Aborted
    : reason == vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT ? LiveState::Limited
                                                             : LiveState::Converged;
  if (isWithheld && IsEnd(state))
  {
    filter->GetExecutive()->Update(0); // puts the mesh out
  }
  return { state, isWithheld };
}

bool IsEnd(LiveState state) { return state != LiveState::UnderWay && state != LiveState::Aborted; }

bool IsComposite(vtkDataObject* data) { return vtkCompositeDataSet::SafeDownCast(data) != nullptr; }

vtkSmartPointer<vtkPolyData> JoinBlocks(vtkDataObject* data)
{
  vtkNew<vtkAppendPolyData> append;
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!blocks)
  {
    return vtkPolyData::SafeDownCast(data);
  }
  const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    if (auto* mesh = vtkPolyData::SafeDownCast(block->GetCurrentDataObject()))
    {
      append->AddInputData(mesh);
    }
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
  }
  return append->GetOutput();
}

std::string DescribeStatus(const LiveStatus& status)
{
  char angle[64] = "";
  if (!std::isnan(status.SmallestAngle))
  {
    std::snprintf(angle, sizeof(angle), "\nsmallest angle %.2f degrees", status.SmallestAngle);
  }
  const std::string drawing = status.Drawing.empty() ? "" : "\n" + Wrap(status.Drawing);
  return DescribeMesh(status) + angle + drawing;
}

}
