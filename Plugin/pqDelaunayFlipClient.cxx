// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipClient.h"

#include "pqApplicationCore.h"
#include "pqArraySelectorPropertyWidget.h"
#include "pqCoreUtilities.h"
#include "pqInputSelectorWidget.h"
#include "pqPipelineSource.h"
#include "pqPresetGroupsManager.h"
#include "pqPropertyLinks.h"
#include "pqPropertyWidget.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"
#include "vtkCommand.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettings.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionPresets.h"

#include <QAbstractItemModel>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QFile>
#include <QHBoxLayout>
#include <QIcon>
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
        const QString title = line.left(colon).toHtmlEscaped().replace(" ", "&nbsp;");
        // A line would break between - and >.
        const QString value = line.mid(colon + 2).toHtmlEscaped().replace("-&gt;", "&rarr;");
        table += "<tr><td><i>" + title + "&nbsp;</i></td><td>" + value + "</td></tr>";
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

/// ParaView's list of arrays for an optional array. It says None where ParaView shows only an icon.
class ArrayList : public pqArraySelectorPropertyWidget
{
  Q_OBJECT

public:
  ArrayList(vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parentWidget)
    : pqArraySelectorPropertyWidget(smproperty, smproxy, parentWidget),
      Choices(this->findChild<QComboBox*>())
  {
    // Later, since ParaView is filling the list.
    QObject::connect(this->Choices->model(), &QAbstractItemModel::rowsInserted, this,
      &ArrayList::nameNone, Qt::QueuedConnection);
    this->nameNone();
  }

private:
  void nameNone()
  {
    const int none = this->Choices->findText(QString());
    if (none >= 0)
    {
      this->Choices->setItemText(none, "None");
      this->Choices->setItemIcon(none, QIcon());
    }
  }

  QComboBox* Choices;
};

/// Whether a property has ParaView's default, and not one that the user has saved.
bool IsFree(vtkSMProxy* shown, const char* name)
{
  vtkSMProperty* property = shown->GetProperty(name);
  return property && property->IsValueDefault();
}

/// Shows the edges of a mesh, in grey, unless they would cover all of it.
void ChooseEdges(vtkSMProxy* shown, vtkSMSourceProxy* source)
{
  constexpr vtkTypeInt64 MostCells = 20000;
  // No angle has this colour. ParaView's edges are blue, as good triangles are.
  const double grey[] = { 0.3, 0.3, 0.3 };
  if (IsFree(shown, "EdgeColor"))
  {
    vtkSMPropertyHelper(shown, "EdgeColor").Set(grey, 3);
  }
  vtkSMPropertyHelper representation(shown, "Representation", true);
  const bool isSurface = QString(representation.GetAsString()) == "Surface";
  if (isSurface && source->GetDataInformation(0)->GetNumberOfCells() < MostCells)
  {
    representation.Set("Surface With Edges");
  }
}

/// The text of statistics, so that it fits into half a window.
void ChooseLetters(vtkSMProxy* shown)
{
  vtkSMPropertyHelper(shown, "Justification", true).Set(0); // left, not centred
  if (IsFree(shown, "FontSize"))
  {
    vtkSMPropertyHelper(shown, "FontSize").Set(12);
  }
}

/// The ends of a legend of angles are 0 and 60. ParaView would write 6.0e+01.
void ChooseLegend(vtkSMProxy* shown)
{
  vtkSMProxy* colors = vtkSMPropertyHelper(shown, "LookupTable", true).GetAsProxy();
  const QString array =
    colors ? colors->GetSessionProxyManager()->GetProxyName("lookup_tables", colors) : "";
  if (array.contains("Smallestangle") && IsFree(shown, "RangeLabelFormat"))
  {
    vtkSMPropertyHelper format(shown, "RangeLabelFormat");
    const bool isPrintf = QString(format.GetAsString()).startsWith('%'); // until 6.0
    format.Set(isPrintf ? "%g" : "{:g}");
  }
}

/// What a view shows at first. The user may change all of it.
void ChooseDisplay(vtkSMProxy* shown)
{
  if (shown->GetSessionProxyManager()->GetInLoadXMLState())
  {
    return;
  }
  vtkSMProxy* input = vtkSMPropertyHelper(shown, "Input", true).GetAsProxy();
  auto* source = vtkSMSourceProxy::SafeDownCast(input);
  const QString name = source ? source->GetXMLName() : "";
  if (name == "DelaunayFlip" || name == "DelaunayFromPoints")
  {
    ChooseEdges(shown, source);
  }
  else if (name == "DelaunayFlipStatistics")
  {
    ChooseLetters(shown);
  }
  else if (!source)
  {
    ChooseLegend(shown);
  }
  shown->UpdateVTKObjects();
}

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
    [](pqRepresentation* shown) { ChooseDisplay(shown->getProxy()); });
}

void pqDelaunayFlipClient::refresh(pqPipelineSource* source)
{
  vtkSMProxy* proxy = source->getProxy();
  const QString name = proxy->GetXMLName();
  if (name == "DelaunayFlip" || name == "DelaunayFromPoints" || name == "InterpolateFromPoints")
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
  const QString type = property->GetPanelWidget();
  if (type == "DelaunayFlipSourceList")
  {
    return new SourceList(proxy, property, parentWidget);
  }
  if (type == "DelaunayFlipArrayList")
  {
    return new ArrayList(proxy, property, parentWidget);
  }
  return nullptr;
}

pqPropertyWidget* pqDelaunayFlipClient::createWidgetForPropertyGroup(
  vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parentWidget)
{
  const QString type = group->GetPanelWidget();
  if (type == "DelaunayFlipLiveControls")
  {
    return new LiveControls(proxy, parentWidget);
  }
  if (type == "DelaunayFlipSummary")
  {
    return new Summary(proxy, parentWidget);
  }
  return nullptr;
}

#include "pqDelaunayFlipClient.moc"
