#pragma once

#include <QFrame>
#include <QLabel>
#include <QTimer>

#include "panels/legend.h"
#include "panels/panel_head.h"
#include "panels/view.h"

namespace chainmail {

/// One side of the comparison: the algorithm's selector, the view, and what the last pass did.
class Panel : public QFrame {
  Q_OBJECT

 public:
  Panel(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
        std::shared_ptr<MeshLevels> levels);

  View& view() { return *view_; }
  PanelHead& head() { return *head_; }
  QComboBox& selector() { return head_->selector(); }
  Legend& legend() { return *legend_; }
  /// Draws it over the panel's object, and says what it notes.
  void addOverlay(Overlay& overlay) { view_->addOverlay(overlay); }
  /// In lines and words on paper, in logical pixels: without what is to be clicked at.
  void drawIn(QPainter& painter, const QColor& ground);
  /// Paints and says anew what an overlay has changed.
  void refresh();

 private:
  void arrange();
  void listen();
  void showStatistics();
  QString describe(const Statistics& statistics, bool briefly) const;
  static QString describePass(const Statistics& statistics, bool briefly);
  static QString describeViolation(const Statistics& statistics, bool briefly);
  QString describeRemark(const Statistics& statistics) const;
  void showFigures(const Statistics& statistics);
  QStringList states(const Statistics& statistics) const;
  void drawHead(QPainter& painter) const;
  void drawStatistics(QPainter& painter) const;

  Document& document_;
  Colouring& colouring_;
  int panel_;
  QLabel* statistics_;
  View* view_;
  PanelHead* head_;
  Legend* legend_;
  QTimer refresh_;  // figures change at a rate that can be read, and only when there is something new
};

}  // namespace chainmail
