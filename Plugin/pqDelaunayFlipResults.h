// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipResults_h
#define pqDelaunayFlipResults_h

#include "pqPropertyWidget.h"

#include <QList>

class QLabel;
class vtkSMProperty;
class vtkSMPropertyGroup;

/// A group of properties that are read back, as plain text beside their names. Its text can be
/// selected and copied, and there is nothing to edit. Advanced properties are for scripts alone.
class pqDelaunayFlipResults : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqDelaunayFlipResults(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private Q_SLOTS:
  void refresh();

private:
  QLabel* makeValue(vtkSMProperty* smproperty);

  QList<QLabel*> Values; ///< With the names of their properties.
};

#endif
