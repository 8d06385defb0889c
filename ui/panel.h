#pragma once

#include <QComboBox>
#include <QFrame>
#include <QLabel>
#include <QTimer>

#include "legend.h"
#include "view.h"

namespace chainmail {

/// One side of the comparison: the algorithm's selector, the view, and what the last pass did.
class Panel : public QFrame {
  Q_OBJECT

 public:
  Panel(Document& document, Colouring& colouring, int panel, std::shared_ptr<Camera> camera,
        std::shared_ptr<MeshLevels> levels, colours::Colour colour);

  View& view() { return *view_; }
  QComboBox& selector() { return *selector_; }
  Legend& legend() { return *legend_; }
  /// Draws it over the panel's object, and says what it notes.
  void addOverlay(Overlay& overlay) { view_->addOverlay(overlay); }
  /// Paints and says anew what an overlay has changed.
  void refresh();

 private:
  void fillSelector();
  void showAlgorithm();
  void arrange(colours::Colour colour);
  void showStatistics();
  QString describe(const Statistics& statistics) const;
  QStringList states(const Statistics& statistics) const;

  Document& document_;
  Colouring& colouring_;
  int panel_;
  QComboBox* selector_;
  QLabel* state_;
  QLabel* statistics_;
  View* view_;
  Legend* legend_;
  QTimer refresh_;  // figures change at a rate that can be read, and only when there is something new
};

}  // namespace chainmail
