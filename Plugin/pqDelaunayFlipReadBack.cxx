// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipReadBack.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "vtkSMProxy.h"

#include <cstring>

void pqDelaunayFlipReadBack::Start()
{
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::dataUpdated, this, &pqDelaunayFlipReadBack::Refresh);
}

void pqDelaunayFlipReadBack::Stop()
{
  // The connection ends with this object.
}

void pqDelaunayFlipReadBack::Refresh(pqPipelineSource* source)
{
  vtkSMProxy* proxy = source->getProxy();
  if (std::strcmp(proxy->GetXMLName(), "DelaunayFlip") == 0)
  {
    proxy->UpdatePropertyInformation();
  }
}
