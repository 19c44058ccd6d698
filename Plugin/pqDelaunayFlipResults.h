// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipResults_h
#define pqDelaunayFlipResults_h

#include "pqPropertyWidget.h"

#include <QList>

class QLabel;
class vtkSMProperty;
class vtkSMPropertyGroup;

/// A group of information properties, shown as plain text beside their names. The text can be
/// selected and copied, but not edited. Advanced properties are not shown: they are for scripts.
class pqDelaunayFlipResults : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqDelaunayFlipResults(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private Q_SLOTS:
  void refresh();

private:
  QLabel* makeValue(vtkSMProperty* smproperty);

  QList<QLabel*> Values; ///< Labels, whose object names are those of the properties.
};

#endif
