#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>

#include "docks/propagation_column.h"
#include "tools/propagation_overlay.h"

class QAction;
class QGridLayout;
class QMenu;

namespace chainmail {

/// Shows a pass in slow motion and in single steps, forward and back, with the waiting lists of all panels.
class PropagationDock : public QDockWidget {
  Q_OBJECT

 public:
  PropagationDock(Document& document, Propagation& propagation, PropagationOverlay& overlay);

  /// Adds the steps to a menu.
  void fill(QMenu& menu);

 signals:
  /// Emitted when the panels must be redrawn.
  void changed();

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void arrangeLists();
  void followDock();
  QAction* add(const QString& name, const QString& text, const QKeySequence& key, const QString& tip);
  void makeActions();
  QWidget* makeButtons();
  QWidget* makeChoices();
  void makeSpeeds();
  void refresh();
  void refreshActions();

  Propagation& propagation_;
  PropagationOverlay& overlay_;
  QGridLayout* lists_;
  std::vector<PropagationColumn*> columns_;
  QAction *first_, *back_, *play_, *forward_, *last_, *follow_;
  QComboBox* speed_;
  QCheckBox *together_, *arrows_;
};

}  // namespace chainmail
