// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFlip.h"

#include "FlipError.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace delaunayflip
{

namespace
{
std::string Write(bool value) { return value ? "on" : "off"; }

std::string Write(double value)
{
  // GCC 10, which makes the wheel, has no std::to_chars for it.
  const auto write = [value](int digits)
  {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(digits) << value;
    return text;
  };
  double read = 0.0;
  const bool isShort = (write(15) >> read) && read == value;
  return write(isShort ? 15 : 17).str();
}
}

void RequireSameOptions(const FlipOptions& options, PieceGroup& group,
  const std::vector<std::pair<std::string, std::string>>& more)
{
  std::vector<std::pair<std::string, std::string>> all = {
    { "Geometry", ToString(options.Geometry) },
    { "Criterion", options.Criterion == CriterionKind::InCircle ? "in-circle" : "opposite-angles" },
    { "TieRule", options.TieRule == TieRuleKind::Keep ? "keep" : "canonical" },
    { "Tolerance", Write(options.Tolerance) },
    { "FeatureAngle", Write(options.FeatureAngle) },
    { "MaximumDeviation", Write(options.MaximumDeviation) },
    { "MaximumIterations", std::to_string(options.MaximumIterations) },
    { "TrackQuality", Write(options.TrackQuality) },
  };
  all.insert(all.end(), more.begin(), more.end());
  std::string own;
  for (const auto& option : all)
  {
    own += option.second + '\0';
  }
  std::vector<Message> ranks = group.Gather(Message(own.begin(), own.end()));
  std::vector<const char*> values;
  for (const Message& rank : ranks)
  {
    values.push_back(rank.data());
  }
  for (const auto& option : all)
  {
    const std::string first = values[0];
    for (std::size_t rank = 0; rank < values.size(); ++rank)
    {
      const std::string value = values[rank];
      if (value != first)
      {
        throw InvalidOptions(option.first + " is '" + first + "' on rank 0, but '" + value +
          "' on rank " + std::to_string(rank) + "; set it to the same on all ranks");
      }
      values[rank] += value.size() + 1;
    }
  }
}

void FlippedPiece::Clear()
{
  this->Triangles.clear();
  this->FlipCounts.clear();
  this->GoneTriangles.clear();
  this->ReceivedTriangles.clear();
  this->ReceivedPoints.clear();
  this->ReceivedCoordinates.clear();
}

std::vector<PieceOrigin> ListOrigins(const FlippedPiece& flipped, int rank)
{
  const std::size_t kept = flipped.FlipCounts.size() - flipped.ReceivedTriangles.size();
  std::vector<PieceOrigin> origins;
  origins.reserve(flipped.FlipCounts.size());
  auto gone = flipped.GoneTriangles.begin();
  for (std::int64_t slot = 0; origins.size() < kept; ++slot)
  {
    if (gone != flipped.GoneTriangles.end() && *gone == slot)
    {
      ++gone;
      continue;
    }
    origins.push_back({ rank, slot });
  }
  origins.insert(origins.end(), flipped.ReceivedTriangles.begin(), flipped.ReceivedTriangles.end());
  return origins;
}

}
