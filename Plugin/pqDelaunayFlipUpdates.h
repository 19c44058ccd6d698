// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipUpdates_h
#define pqDelaunayFlipUpdates_h

#include <QObject>

class pqPipelineSource;

/// What the client does after every update of the plugin's filters.
///
/// Delaunay Flip: reads the group Last Update of the Properties panel again, because ParaView reads
/// such properties when it applies the others, before the pipeline runs. It also renders the views
/// of downstream filters, because ParaView renders only those of the live source itself.
///
/// Plot Delaunay Flips: sets the axis of the chart to the scale, linear or logarithmic, for which
/// the filter prepared the data.
class pqDelaunayFlipUpdates : public QObject
{
public:
  void Start();
  void Stop();

private:
  static void Refresh(pqPipelineSource* source);
};

#endif
