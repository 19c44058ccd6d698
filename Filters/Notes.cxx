// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Notes.h"

#include "FlipError.h"
#include "FlipReport.h"

#include "vtkDelaunayFlip.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>

namespace delaunayflip
{

FlipFailure ExplainException()
{
  try
  {
    throw;
  }
  catch (const InvalidOptions& error)
  {
    return { vtkDelaunayFlip::FAILURE_OPTIONS, error.what() };
  }
  catch (const BackendUnavailable& error)
  {
    return { vtkDelaunayFlip::FAILURE_BACKEND, error.what() };
  }
  catch (const FlipError& error)
  {
    return { vtkDelaunayFlip::FAILURE_MESH, error.what() };
  }
  catch (const std::invalid_argument& error) // of a subclass of the filter
  {
    return { vtkDelaunayFlip::FAILURE_MESH, error.what() };
  }
  catch (const std::bad_alloc&)
  {
    return { vtkDelaunayFlip::FAILURE_OTHER, "not enough memory" };
  }
  catch (const std::exception& error)
  {
    return { vtkDelaunayFlip::FAILURE_OTHER, error.what() };
  }
  catch (...)
  {
    return { vtkDelaunayFlip::FAILURE_OTHER, "an exception of unknown type" };
  }
}

namespace
{

constexpr std::size_t Most = 3; // places named per text, and texts

std::string Join(const std::vector<std::string>& items, const char* separator)
{
  std::string text;
  const std::size_t count = std::min(items.size(), Most);
  for (std::size_t i = 0; i < count; ++i)
  {
    text += (i == 0 ? "" : separator) + items[i];
  }
  return items.size() > Most
    ? text + separator + "and " + std::to_string(items.size() - Most) + " more"
    : text;
}

}

std::string Describe(const std::vector<Note>& notes)
{
  std::vector<std::string> texts;
  std::vector<std::vector<std::string>> places;
  for (const Note& note : notes)
  {
    const auto known = std::find(texts.begin(), texts.end(), note.Text);
    if (known == texts.end())
    {
      texts.push_back(note.Text);
      places.push_back({ note.Where });
    }
    else
    {
      places[known - texts.begin()].push_back(note.Where);
    }
  }
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    const std::string where = Join(places[i], ", ");
    texts[i] = where.empty() ? texts[i] : where + ": " + texts[i];
  }
  return Join(texts, "; ");
}

std::string DescribeTrouble(const FlipReport& report, bool hasAskedForLimit, bool hasTolerance)
{
  std::string text = DescribeDefects(report.Defects);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (report.StopReason == StopReasonKind::IterationLimit && !hasAskedForLimit)
  {
    add("stopped by the safety limit of " + std::to_string(report.Iterations.size()) +
      " iterations with " + std::to_string(report.NonDelaunayAfter) +
      " edges left that are not Delaunay");
  }
  if (hasTolerance && report.Tolerance == "none")
  {
    add("Tolerance has no effect on the in-circle criterion, which is exact; it is for opposite "
        "angles");
  }
  if (!report.Fallback.empty())
  {
    add("the GPU could not be used, the CPU did the work: " + report.Fallback);
  }
  return text;
}

}
