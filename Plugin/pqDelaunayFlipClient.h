// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipClient_h
#define pqDelaunayFlipClient_h

#include "pqAutoStartInterface.h"
#include "pqPropertyWidgetInterface.h"

#include <QObject>

class pqPipelineSource;

/// What the plugin adds to the Qt client: widgets of the Properties panel, and what follows every
/// update of its filters.
///
/// It reads the group Last Update of the Properties panel again, because ParaView reads
/// such properties when it applies the others, before the pipeline runs. It also renders the views
/// of downstream filters, because ParaView renders only those of the live source itself.
class pqDelaunayFlipClient
  : public QObject
  , public pqAutoStartInterface
  , public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqAutoStartInterface pqPropertyWidgetInterface)

public:
  explicit pqDelaunayFlipClient(QObject* parent)
    : QObject(parent)
  {
  }

  void startup() override;
  void shutdown() override {}

  pqPropertyWidget* createWidgetForProperty(
    vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent) override;
  pqPropertyWidget* createWidgetForPropertyGroup(
    vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent) override;

private:
  static void refresh(pqPipelineSource* source);
};

#endif
