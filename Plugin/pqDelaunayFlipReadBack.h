// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipReadBack_h
#define pqDelaunayFlipReadBack_h

#include <QObject>

class pqPipelineSource;

/// Keeps the group Last Update of the Properties panel true. ParaView reads such properties while
/// it applies the others, which is before the pipeline runs; this reads them again after every run.
class pqDelaunayFlipReadBack : public QObject
{
public:
  void Start();
  void Stop();

private:
  static void Refresh(pqPipelineSource* source);
};

#endif
