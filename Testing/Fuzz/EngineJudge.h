// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINEJUDGE_H
#define DELAUNAYFLIP_ENGINEJUDGE_H

#include "EngineCase.h"

namespace delaunayflip
{

/// Runs a case and reports a failure of GoogleTest for each promise of the engine that is broken:
///
/// - one thread, several, and a session that advances step by step give the same bits;
/// - the caller's arrays stay as they are;
/// - edges by kind, the Euler characteristic and triangles that no flip touched stay;
/// - the statistics add up, and the loop ends by itself;
/// - the bad edges left are those that the audit finds and, in x and y, those that rational
///   arithmetic finds;
/// - a triangulation without overlaps stays one; if no edge is fixed or blocked, it becomes
///   Delaunay, and with canonical ties it is that of Lawson's algorithm in rational arithmetic.
void JudgeEngineCase(const EngineCase& drawn);

}

#endif
