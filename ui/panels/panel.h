#pragma once

#include <QFrame>
#include <QLabel>
#include <QTimer>
#include <optional>

#include "panels/legend.h"
#include "panels/panel_head.h"
#include "panels/view.h"
#include "panels/violation_line.h"

namespace chainmail {

/// One panel of the comparison: the head with the algorithm, the legend, the view, a sentence on the violation of
/// links, and on demand the figures of the last pass.
class Panel : public QFrame {
  Q_OBJECT

 public:
  Panel(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
        std::shared_ptr<MeshLevels> levels);

  View& view() { return *view_; }
  PanelHead& head() { return *head_; }
  QComboBox& selector() { return head_->selector(); }
  Legend& legend() { return *legend_; }
  /// Shows or hides the figures of the last pass below the sentence.
  void showFigures(bool on);
  /// Draws an overlay over the object and shows its notes in the head.
  void addOverlay(Overlay& overlay) { view_->addOverlay(overlay); }
  /// Draws the panel as a figure, in logical pixels: texts, colour swatch and legend, without buttons and boxes. The
  /// object is drawn as vector graphics, or, with `pixelRatio`, as a picture of that many pixels per logical pixel.
  void drawIn(QPainter& painter, const QColor& ground, std::optional<double> pixelRatio = std::nullopt);
  /// Repaints after an overlay has changed, and updates figures and legend.
  void refresh();

 private:
  void arrange();
  void listen();
  void showStatistics();
  void update(const Statistics& statistics);
  QString describe(const Statistics& statistics, bool briefly) const;
  static QString inWords(const Statistics& statistics);
  static QString describePass(const Statistics& statistics, bool briefly);
  static QString describeViolation(const Statistics& statistics, bool briefly);
  QString describeRemark(const Statistics& statistics) const;
  QStringList states(const Statistics& statistics) const;
  void drawHead(QPainter& painter) const;
  void drawStatistics(QPainter& painter) const;

  Document& document_;
  Colouring& colouring_;
  int panel_;
  ViolationLine* violation_;
  QLabel* statistics_;
  View* view_;
  PanelHead* head_;
  Legend* legend_;
  QTimer refresh_;  // limits how often the figures change, so that they can be read
};

}  // namespace chainmail
