#pragma once

#include <QElapsedTimer>
#include <QFrame>
#include <QLabel>
#include <QTimer>
#include <optional>

#include "panels/legend.h"
#include "panels/panel_head.h"
#include "panels/panel_state.h"
#include "panels/view.h"

namespace chainmail {

/// One panel of the comparison: the head with the algorithm, the legend, the view, a sentence on the violation of
/// links, and on demand the figures of the last pass.
class Panel : public QFrame {
  Q_OBJECT

 public:
  Panel(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
        std::shared_ptr<MeshLevels> levels, QTimer& refresh);

  View& view() { return *view_; }
  PanelHead& head() { return *head_; }
  QComboBox& selector() { return head_->selector(); }
  Legend& legend() { return *legend_; }
  /// Returns the title of the overlay that colours the object; empty if there is none.
  QString overlayTitle() const;
  /// Shows or hides the figures of the last pass below the sentence.
  void showFigures(bool on);
  /// Marks the cursor, widens links and shows one large number, so that an audience can follow.
  void setLecture(bool on);
  /// Draws an overlay over the object and shows its notes in the head.
  void addOverlay(Overlay& overlay) { view_->addOverlay(overlay); }
  /// Draws the panel as a figure, in logical pixels: texts, colour swatch and legend, without buttons and boxes. The
  /// object is drawn as vector graphics, or, with `pixelRatio`, as a picture of that many pixels per logical pixel.
  /// Without `legend`, it has only the part of the legend that the window shows: another one explains the rest.
  void drawIn(QPainter& painter, const QColor& ground, std::optional<double> pixelRatio = std::nullopt,
              bool legend = true);
  /// Shows the legend and the figures of the present frame.
  void showStatistics();
  /// Repaints after an overlay has changed, and updates figures and legend.
  void refresh();

 signals:
  /// The legend may have changed.
  void legendChanged();

 private:
  void arrange();
  void makeUnsettled();
  void listen();
  void refreshLater();
  void followWork();
  QString work(const Statistics& statistics);
  bool hasMoved(const Statistics& statistics);
  double worstViolation() const;
  void update(const Statistics& statistics);
  QString describe(const Statistics& statistics, bool briefly, qsizetype parts) const;
  static QString inWords(const Statistics& statistics);
  static QStringList describePass(const Statistics& statistics, bool briefly);
  static QStringList describeViolation(const Statistics& statistics, bool briefly);
  QString describeRemark(const Statistics& statistics) const;
  QStringList states(const Statistics& statistics) const;
  void drawHead(QPainter& painter) const;
  void drawStatistics(QPainter& painter) const;

  Document& document_;
  Colouring& colouring_;
  int panel_;
  ViolationLine* violation_;
  QWidget* unsettled_;
  QLabel* distance_;  // in `unsettled_`
  QLabel* statistics_;
  View* view_;
  PanelHead* head_;
  Legend* legend_;
  QTimer& refresh_;        // limits how often the figures of all panels change, so that they can be read
  QTimer late_;            // looks again while the solver works
  QElapsedTimer busy_;     // runs since the solver has been working without a new frame
  bool answered_ = false;  // true if a frame came since the algorithm, the object or the handle changed
  bool grabbed_ = false;
  MeshPointer movedMesh_;           // the object of the last frame
  std::uint64_t passesBefore_ = 0;  // of its solver, before it had this object
};

}  // namespace chainmail
