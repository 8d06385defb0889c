#pragma once

#include <QSvgRenderer>
#include <QWidget>
#include <optional>

#include "common/plot_pictures.h"

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
  /// Returns the values near a position as text: those of the nearest mark, or those of each line at that x. Returns an
  /// empty string if there are none.
  QString readingAt(QPointF position);

 protected:
  bool event(QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  const report::PlotLayout& drawn();
  QString markReading(QPointF position);
  QString curveReading(QPointF position);
  QString curveReading(const report::PlotPanel& panel, double share, double pixel) const;

  report::Plot plot_;
  QString emptyText_;
  std::optional<report::PlotLayout> layout_;  // for the current plot, size and font
  QSvgRenderer drawing_;
  QString shownReading_;
};

/// The legend of a plot: what its marks and lines stand for.
class PlotLegend : public QWidget {
  Q_OBJECT

 public:
  void show(report::Plot plot);
  QSize sizeHint() const override { return drawing_.defaultSize(); }
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void changeEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void draw();

  report::Plot plot_;
  QSvgRenderer drawing_;
};

}  // namespace chainmail
