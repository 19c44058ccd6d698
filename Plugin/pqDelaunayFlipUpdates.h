// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipUpdates_h
#define pqDelaunayFlipUpdates_h

#include <QObject>

class pqPipelineSource;

/// What the client does after every update of the plugin's filters.
///
/// Delaunay Flip: it reads the group Last Update of the Properties panel again, since ParaView
/// reads such properties while it applies the others, which is before the pipeline runs. It also
/// renders what other filters make of the output, since ParaView renders the views of a live source
/// alone.
///
/// Plot Delaunay Flips: it gives the axis of the chart the scale that the filter prepared for.
class pqDelaunayFlipUpdates : public QObject
{
public:
  void Start();
  void Stop();

private:
  static void Refresh(pqPipelineSource* source);
};

#endif
