// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipLiveControls.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QSignalBlocker>

pqDelaunayFlipLiveControls::pqDelaunayFlipLiveControls(
  vtkSMProxy* smproxy, vtkSMPropertyGroup*, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
{
  this->setShowLabel(false);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  this->Pause = this->addButton("Paused");
  this->Pause->setText("Pause");
  this->Pause->setCheckable(true);
  QObject::connect(this->Pause, SIGNAL(toggled(bool)), this, SLOT(setPaused(bool)));
  QObject::connect(this->addButton("Step"), SIGNAL(clicked()), this, SLOT(step()));
  QObject::connect(this->addButton("Restart"), SIGNAL(clicked()), this, SLOT(restart()));
  pqCoreUtilities::connect(
    smproxy->GetProperty("Paused"), vtkCommand::ModifiedEvent, this, SLOT(showState()));
  this->showState();
}

QPushButton* pqDelaunayFlipLiveControls::addButton(const char* name)
{
  auto* button = new QPushButton(name, this);
  button->setObjectName(name);
  button->setToolTip(pqPropertyWidget::getTooltip(this->proxy()->GetProperty(name)));
  this->layout()->addWidget(button);
  return button;
}

void pqDelaunayFlipLiveControls::showState()
{
  const QSignalBlocker blocker(this->Pause);
  this->Pause->setChecked(vtkSMPropertyHelper(this->proxy(), "Paused").GetAsInt() != 0);
}

void pqDelaunayFlipLiveControls::setPaused(bool isPaused)
{
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->proxy());
  vtkSMPropertyHelper(this->proxy(), "Paused").Set(isPaused ? 1 : 0);
  this->proxy()->UpdateVTKObjects();
}

void pqDelaunayFlipLiveControls::step()
{
  this->Pause->setChecked(true); // otherwise the next step would follow by itself
  this->invoke("Step");
}

void pqDelaunayFlipLiveControls::restart() { this->invoke("Restart"); }

void pqDelaunayFlipLiveControls::invoke(const char* command)
{
  SM_SCOPED_TRACE(CallMethod).arg("proxy", this->proxy()).arg("InvokeCommand").arg(command);
  this->proxy()->InvokeCommand(command);
  pqApplicationCore::instance()->render();
}
