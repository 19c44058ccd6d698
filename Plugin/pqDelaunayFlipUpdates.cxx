// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipUpdates.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqView.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QString>

namespace
{

void ReadBack(pqPipelineSource* flip)
{
  flip->getProxy()->UpdatePropertyInformation();
  for (pqPipelineSource* consumer : flip->getAllConsumers())
  {
    consumer->renderAllViews(); // later, from the event loop
  }
}

void SetScale(pqPipelineSource* chart)
{
  const int isLog = vtkSMPropertyHelper(chart->getProxy(), "LogScale").GetAsInt();
  for (pqView* view : chart->getViews())
  {
    vtkSMProxy* proxy = view->getProxy();
    if (proxy->GetProperty("LeftAxisLogScale"))
    {
      vtkSMPropertyHelper(proxy, "LeftAxisLogScale").Set(isLog);
      proxy->UpdateVTKObjects();
      view->render();
    }
  }
}

}

void pqDelaunayFlipUpdates::Start()
{
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::dataUpdated, this, &pqDelaunayFlipUpdates::Refresh);
}

void pqDelaunayFlipUpdates::Stop()
{
  // The connection ends with this object.
}

void pqDelaunayFlipUpdates::Refresh(pqPipelineSource* source)
{
  const QString name = source->getProxy()->GetXMLName();
  if (name == "DelaunayFlip")
  {
    ReadBack(source);
  }
  else if (name == "PlotDelaunayFlips")
  {
    SetScale(source);
  }
}
