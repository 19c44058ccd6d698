// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipSourceList.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "vtkCommand.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QComboBox>
#include <QSet>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace
{

pqServerManagerModel* GetModel() { return pqApplicationCore::instance()->getServerManagerModel(); }

QString MakeKey(vtkSMProxy* proxy, unsigned int port)
{
  return proxy ? QString("%1:%2").arg(proxy->GetGlobalID()).arg(port) : QString();
}

QString MakeText(pqOutputPort* port)
{
  pqPipelineSource* source = port->getSource();
  const QString name = source->getSMName();
  return source->getNumberOfOutputPorts() > 1 ? name + ":" + port->getPortName() : name;
}

/// A filter and everything downstream of it.
QSet<pqPipelineSource*> FindDownstream(pqPipelineSource* first)
{
  QSet<pqPipelineSource*> found{ first };
  QList<pqPipelineSource*> next{ first };
  while (!next.isEmpty())
  {
    for (pqPipelineSource* consumer : next.takeFirst()->getAllConsumers())
    {
      if (!found.contains(consumer))
      {
        found.insert(consumer);
        next.append(consumer);
      }
    }
  }
  return found;
}

bool HoldsPolygons(pqOutputPort* port)
{
  vtkPVDataInformation* information = port->getDataInformation();
  return information && information->DataSetTypeIsA("vtkPolyData");
}

}

pqDelaunayFlipSourceList::pqDelaunayFlipSourceList(
  vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget),
    Choices(new QComboBox(this))
{
  this->setProperty(smproperty);
  auto* box = new QVBoxLayout(this);
  box->setContentsMargins(0, 0, 0, 0);
  box->addWidget(this->Choices);
  this->Changes.setSingleShot(true);
  this->Changes.setInterval(0);
  QObject::connect(&this->Changes, SIGNAL(timeout()), this, SLOT(refill()));
  for (const char* change :
    { SIGNAL(sourceAdded(pqPipelineSource*)), SIGNAL(sourceRemoved(pqPipelineSource*)),
      SIGNAL(dataUpdated(pqPipelineSource*)), SIGNAL(nameChanged(pqServerManagerModelItem*)),
      SIGNAL(connectionAdded(pqPipelineSource*, pqPipelineSource*, int)) })
  {
    QObject::connect(GetModel(), change, &this->Changes, SLOT(start()));
  }
  pqCoreUtilities::connect(smproperty, vtkCommand::ModifiedEvent, this, SLOT(showInput()));
  this->refill();
  QObject::connect(this->Choices, SIGNAL(currentIndexChanged(int)), this, SLOT(edit()));
}

QVector<pqDelaunayFlipSourceList::Source> pqDelaunayFlipSourceList::findSources() const
{
  QVector<Source> sources{ { "(none)", "" } };
  auto* filter = GetModel()->findItem<pqPipelineSource*>(this->proxy());
  if (!filter)
  {
    return sources;
  }
  const QSet<pqPipelineSource*> downstream = FindDownstream(filter);
  for (pqPipelineSource* source : GetModel()->findItems<pqPipelineSource*>(filter->getServer()))
  {
    for (pqOutputPort* port : source->getOutputPorts())
    {
      if (!downstream.contains(source) && HoldsPolygons(port))
      {
        sources.append({ MakeText(port), MakeKey(source->getProxy(), port->getPortNumber()) });
      }
    }
  }
  return sources;
}

void pqDelaunayFlipSourceList::refill()
{
  const QVector<Source> sources = this->findSources();
  if (sources == this->Sources)
  {
    return;
  }
  this->Sources = sources;
  const QSignalBlocker blocker(this->Choices);
  const QVariant choice = this->Choices->currentData();
  this->Choices->clear();
  for (const Source& source : sources)
  {
    this->Choices->addItem(source.Text, source.Key);
  }
  if (this->IsEdited)
  {
    this->Choices->setCurrentIndex(qMax(0, this->Choices->findData(choice)));
  }
  else
  {
    this->showInput();
  }
}

void pqDelaunayFlipSourceList::showInput()
{
  const vtkSMPropertyHelper helper(this->property());
  const bool isSet = helper.GetNumberOfElements() > 0;
  const QString key = isSet ? MakeKey(helper.GetAsProxy(), helper.GetOutputPort()) : QString();
  const QSignalBlocker blocker(this->Choices);
  this->Choices->setCurrentIndex(
    this->Choices->findData(key)); // -1, an empty choice, if not listed
  this->IsEdited = false;
}

void pqDelaunayFlipSourceList::edit()
{
  this->IsEdited = true;
  Q_EMIT this->changeAvailable();
}

void pqDelaunayFlipSourceList::apply()
{
  if (this->IsEdited)
  {
    this->setInput(this->Choices->currentData().toString().split(':'));
    this->IsEdited = false;
  }
  pqPropertyWidget::apply();
}

void pqDelaunayFlipSourceList::setInput(const QStringList& key)
{
  auto* source =
    GetModel()->findItem<pqPipelineSource*>(static_cast<vtkTypeUInt32>(key.first().toUInt()));
  vtkSMPropertyHelper helper(this->property());
  if (source)
  {
    helper.Set(source->getProxy(), key.last().toUInt());
  }
  else
  {
    helper.SetNumberOfElements(0);
  }
}

void pqDelaunayFlipSourceList::reset()
{
  this->showInput();
  pqPropertyWidget::reset();
}
