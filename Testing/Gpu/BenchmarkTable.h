// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BENCHMARKTABLE_H
#define DELAUNAYFLIP_BENCHMARKTABLE_H

#include "BenchmarkRow.h"

#include <string>
#include <vector>

namespace delaunayflip
{

/// The heading of the text table, without an end of line.
std::string FormatHeading();

/// A row under that heading.
std::string FormatRow(const BenchmarkRow& row);

/// Text as a JSON string, quotes included.
std::string QuoteJson(const std::string& text);

/// The rows as a JSON array of objects; what does not apply is null.
std::string FormatJson(const std::vector<BenchmarkRow>& rows);

}

#endif
