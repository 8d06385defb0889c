#pragma once

#include <QActionGroup>
#include <QComboBox>

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

}  // namespace chainmail
