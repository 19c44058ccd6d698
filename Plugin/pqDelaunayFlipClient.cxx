// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipClient.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqInputSelectorWidget.h"
#include "pqPipelineSource.h"
#include "pqPresetGroupsManager.h"
#include "pqPropertyLinks.h"
#include "pqPropertyWidget.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettings.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionPresets.h"

#include <QAbstractItemModel>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QFile>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSet>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <string>

namespace
{

pqServerManagerModel* GetModel() { return pqApplicationCore::instance()->getServerManagerModel(); }

/// Adds a filter and everything downstream of it.
void AddDownstream(pqPipelineSource* source, QSet<pqPipelineSource*>& found)
{
  if (source && !found.contains(source))
  {
    found.insert(source);
    for (pqPipelineSource* consumer : source->getAllConsumers())
    {
      AddDownstream(consumer, found);
    }
  }
}

/// Buttons that pause a live run, make one step of it, and restart it. They act at once, without
/// Apply.
class LiveControls : public pqPropertyWidget
{
public:
  LiveControls(vtkSMProxy* smproxy, QWidget* parentWidget)
    : pqPropertyWidget(smproxy, parentWidget)
  {
    this->setShowLabel(false);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    this->Pause = this->addButton("Paused");
    this->Pause->setText("Pause");
    this->Pause->setCheckable(true);
    this->Links.setAutoUpdateVTKObjects(true);
    this->Links.addPropertyLink(
      this->Pause, "checked", SIGNAL(toggled(bool)), smproxy, smproxy->GetProperty("Paused"));
    QObject::connect(this->addButton("Step"), &QPushButton::clicked, this,
      [this]()
      {
        this->Pause->setChecked(true); // otherwise the next step would follow by itself
        this->invoke("Step");
      });
    QObject::connect(this->addButton("Restart"), &QPushButton::clicked, this,
      [this]() { this->invoke("Restart"); });
  }

private:
  QPushButton* addButton(const char* name)
  {
    auto* button = new QPushButton(name, this);
    button->setObjectName(name);
    button->setToolTip(pqPropertyWidget::getTooltip(this->proxy()->GetProperty(name)));
    this->layout()->addWidget(button);
    return button;
  }

  void invoke(const char* command)
  {
    SM_SCOPED_TRACE(CallMethod).arg(this->proxy()).arg("InvokeCommand").arg(command);
    this->proxy()->InvokeCommand(command);
    pqApplicationCore::instance()->render();
  }

  QPushButton* Pause;
  pqPropertyLinks Links;
};

/// What the last update did, as a table of text that can be selected and copied, but not edited.
class Summary : public pqPropertyWidget
{
  Q_OBJECT

public:
  Summary(vtkSMProxy* smproxy, QWidget* parentWidget)
    : pqPropertyWidget(smproxy, parentWidget),
      Text(new QLabel(this))
  {
    vtkSMProperty* smproperty = smproxy->GetProperty("Summary");
    auto* box = new QVBoxLayout(this);
    box->setContentsMargins(0, 0, 0, 0);
    box->addWidget(this->Text);
    this->Text->setObjectName("Summary");
    this->Text->setToolTip(pqPropertyWidget::getTooltip(smproperty));
    this->Text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    this->Text->setWordWrap(true);
    pqCoreUtilities::connect(smproperty, vtkCommand::ModifiedEvent, this, SLOT(refresh()));
    pqCoreUtilities::connect(
      smproxy->GetProperty("BackendUsed"), vtkCommand::ModifiedEvent, this, SLOT(refresh()));
    this->refresh();
  }

private Q_SLOTS:
  void refresh()
  {
    const auto read = [this](const char* name)
    { return QString(vtkSMPropertyHelper(this->proxy(), name, true).GetAsString()); };
    const QString text = read("Summary") + "where: " + read("BackendUsed");
    QString table;
    for (const QString& line : text.split('\n'))
    {
      const int colon = line.indexOf(": ");
      if (colon > 0)
      {
        table += "<tr><td><i>" + line.left(colon).toHtmlEscaped().replace(" ", "&nbsp;") +
          "&nbsp;</i></td><td>" + line.mid(colon + 2).toHtmlEscaped() + "</td></tr>";
      }
    }
    const bool isKnown = text.indexOf('\n') > 0; // before the first update it is empty
    this->Text->setText(isKnown ? "<table>" + table + "</table>" : QString());
    this->fit();
  }

private:
  void resizeEvent(QResizeEvent*) override { this->fit(); }

  /// Breaks lines where the panel ends, which may be narrower than its widgets.
  void fit()
  {
    QWidget* ancestor = this->parentWidget();
    while (ancestor && !qobject_cast<QAbstractScrollArea*>(ancestor))
    {
      ancestor = ancestor->parentWidget();
    }
    if (ancestor)
    {
      QWidget* visible = static_cast<QAbstractScrollArea*>(ancestor)->viewport();
      const int width = visible->width() - this->mapTo(visible, QPoint(0, 0)).x();
      this->Text->setMaximumWidth(width);
      this->Text->setMinimumHeight(this->Text->heightForWidth(std::min(width, this->width())));
    }
  }

  QLabel* Text;
};

/// ParaView's list of sources for an optional input, without those downstream of the filter: a loop
/// would crash ParaView.
class SourceList : public pqInputSelectorWidget
{
  Q_OBJECT

public:
  SourceList(vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parentWidget)
    : pqInputSelectorWidget(smproxy, smproperty, parentWidget),
      Choices(this->findChild<QComboBox*>())
  {
    // Later, since ParaView is filling the list.
    QObject::connect(this->Choices->model(), &QAbstractItemModel::rowsInserted, this,
      &SourceList::omitLoops, Qt::QueuedConnection);
    QObject::connect(GetModel(),
      QOverload<pqPipelineSource*, pqPipelineSource*, int>::of(
        &pqServerManagerModel::connectionAdded),
      this, &SourceList::omitLoops);
    this->omitLoops();
  }

private:
  void omitLoops()
  {
    QSet<pqPipelineSource*> sources;
    AddDownstream(GetModel()->findItem<pqPipelineSource*>(this->proxy()), sources);
    const QSignalBlocker blocker(this->Choices);
    for (pqPipelineSource* source : sources)
    {
      for (int i = this->Choices->count() - 1; i >= 0; --i)
      {
        const QString text = this->Choices->itemText(i), name = source->getSMName();
        if (text == name || text.startsWith(name + ":"))
        {
          this->Choices->removeItem(i);
        }
      }
    }
  }

  QComboBox* Choices;
};

/// Makes the colours of angles the defaults of two arrays, and a preset that the user may choose.
void AddColors()
{
  QFile file(":/DelaunayFlip/AngleColors.json");
  file.open(QIODevice::ReadOnly);
  const std::string colors = file.readAll().toStdString();
  const std::string table = "\": {\"PVLookupTable\": " + colors + "}";
  constexpr double Priority = 0.5; // below what the user chooses
  vtkSMSettings::GetInstance()->AddCollectionFromString(
    "{\"array_lookup_tables\": {\"Smallestanglebeforedegrees" + table +
      ", \"Smallestangleafterdegrees" + table + "}}",
    Priority);
  const char* const name = "Smallest angle";
  vtkSMTransferFunctionPresets* presets = vtkSMTransferFunctionPresets::GetInstance();
  if (!presets->HasPreset(name)) // the user may have changed it
  {
    presets->AddPreset(name, colors);
  }
  auto* groups = qobject_cast<pqPresetGroupsManager*>(
    pqApplicationCore::instance()->manager("PRESET_GROUP_MANAGER"));
  if (groups && groups->presetRankInGroup(name, "Default") < 0)
  {
    groups->addToGroup("Default", name);
  }
}

}

void pqDelaunayFlipClient::startup()
{
  AddColors();
  QObject::connect(
    GetModel(), &pqServerManagerModel::dataUpdated, this, &pqDelaunayFlipClient::refresh);
  QObject::connect(GetModel(), &pqServerManagerModel::representationAdded, this,
    [](pqRepresentation* shown)
    {
      vtkSMProxy* proxy = shown->getProxy();
      vtkSMProxy* source = vtkSMPropertyHelper(proxy, "Input", true).GetAsProxy();
      if (source && std::string("DelaunayFlipStatistics") == source->GetXMLName() &&
        !proxy->GetSessionProxyManager()->GetInLoadXMLState())
      {
        vtkSMPropertyHelper(proxy, "Justification", true).Set(0); // left, not centred
        proxy->UpdateVTKObjects();
      }
    });
}

void pqDelaunayFlipClient::refresh(pqPipelineSource* source)
{
  vtkSMProxy* proxy = source->getProxy();
  const QString name = proxy->GetXMLName();
  if (name == "DelaunayFlip" || name == "DelaunayFromPoints")
  {
    proxy->UpdatePropertyInformation();
    QSet<pqPipelineSource*> downstream;
    AddDownstream(source, downstream);
    downstream.remove(source); // ParaView renders its views
    for (pqPipelineSource* consumer : downstream)
    {
      consumer->renderAllViews(); // later, from the event loop
    }
  }
}

pqPropertyWidget* pqDelaunayFlipClient::createWidgetForProperty(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parentWidget)
{
  const bool isList = QString(property->GetPanelWidget()) == "DelaunayFlipSourceList";
  return isList ? new SourceList(proxy, property, parentWidget) : nullptr;
}

pqPropertyWidget* pqDelaunayFlipClient::createWidgetForPropertyGroup(
  vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parentWidget)
{
  const QString type = group->GetPanelWidget();
  return type == "DelaunayFlipLiveControls" ? new LiveControls(proxy, parentWidget)
    : type == "DelaunayFlipSummary"
    ? static_cast<pqPropertyWidget*>(new Summary(proxy, parentWidget))
    : nullptr;
}

#include "pqDelaunayFlipClient.moc"
