// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipUpdates_h
#define pqDelaunayFlipUpdates_h

#include <QObject>

class pqPipelineSource;

/// What the client does after every update of the plugin's filters.
///
/// Delaunay Flip: reads the group Last Update of the Properties panel again. ParaView reads such
/// properties when it applies the others, which is before the pipeline runs. Also renders what
/// other filters make of the output, since ParaView renders only the views of the live source
/// itself.
///
/// Plot Delaunay Flips: gives the axis of the chart the scale for which the filter prepared the
/// data.
class pqDelaunayFlipUpdates : public QObject
{
public:
  void Start();
  void Stop();

private:
  static void Refresh(pqPipelineSource* source);
};

#endif
