// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TimedAdvance_h
#define TimedAdvance_h

#include "FlipReport.h"

namespace delaunayflip
{

class FlipSession;

/// Calls FlipSession::Advance for as many iterations as fit into `seconds`, at least one.
bool AdvanceFor(FlipSession& session, double seconds, const FlipObserver& observer,
  const ProgressObserver& progress = {});

}

#endif
