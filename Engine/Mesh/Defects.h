// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEFECTS_H
#define DELAUNAYFLIP_DEFECTS_H

#include "FlipReport.h"
#include "HostDevice.h"

#include <cstdint>
#include <string>

/// @file
/// Counts of defects of the input, on either backend.

namespace delaunayflip
{

/// A count and the three smallest ids, whatever the order of counting.
struct IdSample
{
  static constexpr int Kept = 3;

  std::int64_t Count = 0;
  std::int64_t Smallest[Kept] = { 0, 0, 0 }; ///< The first min(Count, 3), ascending.

  DELAUNAYFLIP_HOST_DEVICE void Note(std::int64_t id)
  {
    this->Keep(id, this->Count);
    ++this->Count;
  }

  DELAUNAYFLIP_HOST_DEVICE IdSample& operator+=(const IdSample& other)
  {
    for (int i = 0; i < Kept && i < other.Count; ++i)
    {
      this->Keep(other.Smallest[i], this->Count + i);
    }
    this->Count += other.Count;
    return *this;
  }

private:
  /// Inserts an id among `count` known ones.
  DELAUNAYFLIP_HOST_DEVICE void Keep(std::int64_t id, std::int64_t count)
  {
    for (int i = 0; i < Kept; ++i)
    {
      if (i >= count)
      {
        this->Smallest[i] = id;
        return;
      }
      if (id < this->Smallest[i])
      {
        const std::int64_t next = this->Smallest[i];
        this->Smallest[i] = id;
        id = next;
      }
    }
  }
};

inline Defect MakeDefect(
  const std::string& what, const IdSample& sample, DefectIds ids = DefectIds::Triangles)
{
  Defect defect{ what, sample.Count, {}, ids };
  for (int i = 0; i < IdSample::Kept && i < sample.Count; ++i)
  {
    defect.FirstIds.push_back(sample.Smallest[i]);
  }
  return defect;
}

}

#endif
