// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipLiveControls_h
#define pqDelaunayFlipLiveControls_h

#include "pqPropertyWidget.h"

class QPushButton;
class vtkSMPropertyGroup;

/// Buttons that pause a live run, make one step of it, and restart it. They act at once, without
/// Apply.
class pqDelaunayFlipLiveControls : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqDelaunayFlipLiveControls(
    vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private Q_SLOTS:
  void setPaused(bool isPaused);
  void step();
  void restart();
  void showState();

private:
  QPushButton* addButton(const char* name);
  void invoke(const char* command);

  QPushButton* Pause;
};

#endif
