// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipHiddenArrays_h
#define pqDelaunayFlipHiddenArrays_h

#include <QObject>

/// Keeps the filter's field data, one array per column of its table, out of the menu Color By. It
/// adds an expression to those by which ParaView hides arrays. The user's expressions stay, and the
/// new one is not written to the settings file.
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
