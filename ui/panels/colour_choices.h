#pragma once

#include <QActionGroup>
#include <QComboBox>
#include <QJsonObject>
#include <QMenu>

#include "common/number_field.h"
#include "panels/colouring.h"

namespace chainmail {

/// The 'Colour by' setting of all panels: a selector for the tool bar, and the same choices as actions for a menu.
class ColourSelector : public QComboBox {
  Q_OBJECT

 public:
  explicit ColourSelector(Colouring& colouring);
  QList<QAction*> menuActions() const { return actions_->actions(); }
  /// Says that an overlay colours the objects instead, with its title; empty: none does.
  void showOverlay(const QString& title);

 private:
  void showMode();

  Colouring& colouring_;
  QString overlay_;
  QActionGroup* actions_;
};

/// The View menu's choice of the range of the colours: automatic, logarithmic, or fixed between two numbers. Each
/// colour mode has its own choice, because modes have other units. The choice is stored.
class ColourRangeMenu : public QMenu {
  Q_OBJECT

 public:
  ColourRangeMenu(Colouring& colouring, QWidget* parent);

  /// The range of the current mode for a session, and back. Ignores a range that is not valid.
  QJsonObject toJson() const;
  void take(const QJsonObject& json);

 private:
  void addKind(ColourRange::Kind kind, const QString& text, const char* name, const QString& tip);
  void addFields();
  NumberField* makeField(const QString& label, const char* name);
  void choose(const ColourRange& range);
  void chooseKind(ColourRange::Kind kind);
  void showRange();
  void restore();

  Colouring& colouring_;
  QActionGroup* kinds_;
  NumberField* lowest_;
  NumberField* highest_;
};

}  // namespace chainmail
