// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipHiddenArrays_h
#define pqDelaunayFlipHiddenArrays_h

#include <QObject>

/// Keeps the field data of the filter, an array a column of its table, out of the menu Color By:
/// one expression more by which ParaView hides arrays. Those of the user stay, and the settings
/// file does not get to know it.
class pqDelaunayFlipHiddenArrays : public QObject
{
public:
  void Start();
  void Stop();

private:
  void AddExpression();

  unsigned long Observer = 0;
  bool IsAdding = false;
};

#endif
