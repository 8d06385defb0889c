#pragma once

#include <QLabel>
#include <QRadioButton>
#include <QSlider>
#include <QTreeView>
#include <QWidget>

#include "docks/propagation/waiting_list_model.h"

namespace chainmail {

/// The pass of one panel in the Propagation dock: its current step and its waiting list.
class PropagationColumn : public QWidget {
  Q_OBJECT

 public:
  PropagationColumn(Document& document, Propagation& propagation, int panel);

  /// Shows the current step of the pass.
  void refresh();

 protected:
  void changeEvent(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fitSections();
  void showTitle();
  void makeList();
  void arrange();
  QString describe(const PassPlayer& player) const;

  Document& document_;
  Propagation& propagation_;
  int panel_;
  QLabel* title_;
  QRadioButton* choice_;
  QSlider* slider_;
  QLabel* state_;
  QTreeView* list_;
  WaitingListModel model_;
};

}  // namespace chainmail
