// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipResults.h"

#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkVariant.h"

#include <QFormLayout>
#include <QLabel>

pqDelaunayFlipResults::pqDelaunayFlipResults(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* group, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
{
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  for (unsigned int i = 0; i < group->GetNumberOfProperties(); ++i)
  {
    vtkSMProperty* smproperty = group->GetProperty(i);
    if (QString(smproperty->GetPanelVisibility()) != "advanced")
    {
      QLabel* value = this->makeValue(smproperty);
      form->addRow(smproperty->GetXMLLabel(), value);
      form->labelForField(value)->setToolTip(value->toolTip());
      this->Values.append(value);
    }
  }
  this->refresh();
}

QLabel* pqDelaunayFlipResults::makeValue(vtkSMProperty* smproperty)
{
  auto* value = new QLabel(this);
  value->setObjectName(this->proxy()->GetPropertyName(smproperty));
  value->setToolTip(pqPropertyWidget::getTooltip(smproperty));
  value->setTextInteractionFlags(Qt::TextSelectableByMouse);
  value->setWordWrap(true);
  pqCoreUtilities::connect(smproperty, vtkCommand::ModifiedEvent, this, SLOT(refresh()));
  return value;
}

void pqDelaunayFlipResults::refresh()
{
  for (QLabel* value : this->Values)
  {
    const vtkSMPropertyHelper helper(this->proxy(), value->objectName().toUtf8().data());
    const bool isKnown = helper.GetNumberOfElements() > 0;
    value->setText(isKnown ? QString::fromStdString(helper.GetAsVariant(0).ToString()) : "");
  }
}
