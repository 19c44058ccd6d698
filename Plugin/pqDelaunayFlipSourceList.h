// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqDelaunayFlipSourceList_h
#define pqDelaunayFlipSourceList_h

#include "pqPropertyWidget.h"

#include <QString>
#include <QStringList>
#include <QTimer>
#include <QVector>

class QComboBox;
class vtkSMProperty;

/// A list of the sources of polygonal data for an optional input, and "(none)". Unlike ParaView's
/// own list, it leaves out sources downstream of the filter: a loop would crash ParaView.
class pqDelaunayFlipSourceList : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqDelaunayFlipSourceList(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  void apply() override;
  void reset() override;

private Q_SLOTS:
  void refill();
  void showInput();
  void edit();

private:
  /// An output port: its name, and a key from the source's id and the port's number.
  struct Source
  {
    QString Text;
    QString Key;

    bool operator==(const Source& other) const
    {
      return this->Text == other.Text && this->Key == other.Key;
    }
  };

  QVector<Source> findSources() const;
  void setInput(const QStringList& key);

  QComboBox* Choices;
  QVector<Source> Sources; ///< The entries of the list.
  bool IsEdited = false; ///< Whether edited since the last Apply or Reset.
  QTimer Changes; ///< Fires once after one or more changes.
};

#endif
