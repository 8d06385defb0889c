#pragma once

#include <QWidget>
#include <optional>

#include "common/plot_painting.h"

namespace chainmail {

/// Shows a plot, and the values under the pointer.
class PlotWidget : public QWidget {
  Q_OBJECT

 public:
  /// `emptyText` is shown while the plot is empty.
  explicit PlotWidget(const QString& emptyText);

  void show(report::Plot plot);
  const report::Plot& plot() const { return plot_; }
  QSize sizeHint() const override { return {200, 110}; }
  QSize minimumSizeHint() const override { return {120, 90}; }
  /// Returns the position of a value in the widget.
  QPointF positionOf(double x, double y);
  /// Returns the values near a position as text: those of the nearest mark, or those of each line at that x. Returns an
  /// empty string if there are none.
  QString readingAt(QPointF position);

 protected:
  bool event(QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  PlotPainting& painting();
  QString markReading(QPointF position);
  QString curveReading(QPointF position);

  report::Plot plot_;
  QString emptyText_;
  std::optional<PlotPainting> painting_;  // for the current plot and palette
  QString shownReading_;
};

/// The legend of a plot: what its marks and lines stand for.
class PlotLegend : public QWidget {
  Q_OBJECT

 public:
  void show(report::Plot plot);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  report::Plot plot_;
};

}  // namespace chainmail
