#pragma once

#include <QComboBox>
#include <QJsonObject>

#include "common/number_field.h"
#include "panels/colouring.h"

class QWidgetAction;

namespace chainmail {

class Actions;

/// The 'Colour by' setting of all panels: a selector for the tool bar, and the same choices as actions for a menu.
class ColourSelector : public QComboBox {
  Q_OBJECT

 public:
  explicit ColourSelector(Colouring& colouring);
  /// Adds the submenu of the View menu.
  void fill(Actions& actions);
  /// Says that an overlay colours the objects instead, with its title; empty: none does.
  void showOverlay(const QString& title);

 private:
  void showMode();

  Colouring& colouring_;
  QString overlay_;
};

/// The View menu's choice of the range of the colours: automatic, logarithmic, or fixed between two numbers. Each
/// colour mode has its own choice, because modes have other units. The choice is stored.
class ColourRangeMenu : public QObject {
  Q_OBJECT

 public:
  ColourRangeMenu(Colouring& colouring, QObject* parent);
  void fill(Actions& actions);

  /// The range of the current mode for a session, and back. Ignores a range that is not valid.
  QJsonObject toJson() const;
  void take(const QJsonObject& json);

 private:
  void arrangeFields();
  NumberField* makeField(const QString& label, const char* name);
  void choose(const ColourRange& range);
  void chooseKind(ColourRange::Kind kind);
  void showRange();
  void restore();

  Colouring& colouring_;
  QWidgetAction* fields_;
  NumberField* lowest_;
  NumberField* highest_;
};

}  // namespace chainmail
