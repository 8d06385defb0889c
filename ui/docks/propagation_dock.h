#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>

#include "docks/propagation_column.h"
#include "tools/propagation_overlay.h"

class QGridLayout;

namespace chainmail {

class Actions;

/// Shows a pass in slow motion and in single steps, forward and back, with the waiting lists of all panels.
class PropagationDock : public QDockWidget {
  Q_OBJECT

 public:
  PropagationDock(Document& document, Propagation& propagation, PropagationOverlay& overlay, Actions& actions);

 signals:
  /// Emitted when the panels must be redrawn.
  void changed();

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void arrangeLists();
  void followDock();
  void addActions(Actions& actions);
  QWidget* makeButtons(Actions& actions);
  QWidget* makeChoices(Actions& actions);
  void makeSpeeds();
  void refresh();

  Propagation& propagation_;
  PropagationOverlay& overlay_;
  QGridLayout* lists_;
  std::vector<PropagationColumn*> columns_;
  QComboBox* speed_;
  QCheckBox *together_, *arrows_;
};

}  // namespace chainmail
