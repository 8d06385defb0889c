#pragma once

#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QPolygonF>
#include <QStringList>

#include "report/page/plot.h"

namespace chainmail {

/// Paints the first panel of a plot, in the text and grid colours of a palette. Keeps a reference to the plot.
class PlotPainting {
 public:
  PlotPainting(const report::Plot& plot, const QPalette& palette);

  /// Lays out the axes in an area, for the font of a paint device. Call it before the functions below.
  void layOut(const QRectF& area, const QFontMetricsF& metrics);
  void paint(QPainter& painter) const;
  /// The area between the axes.
  const QRectF& inner() const { return inner_; }
  QPointF positionOf(double x, double y) const;

  /// Paints the title and the keys of the series, in as many lines as needed. Returns the y coordinate of the lower
  /// edge.
  double paintHeading(QPainter& painter, const QRectF& area) const;
  /// Paints the keys of the series and the notes, one below the other.
  void paintLegend(QPainter& painter, const QRectF& area) const;
  QSizeF legendSize(const QFontMetricsF& metrics) const;

 private:
  struct Label {
    QRectF area;
    QString text;
  };

  void layOutLabels(const QRectF& area, const QFontMetricsF& metrics);
  void paintStrip(QPainter& painter) const;
  void paintGrid(QPainter& painter) const;
  void paintLabels(QPainter& painter) const;
  void paintLevel(QPainter& painter) const;
  void paintCurves(QPainter& painter) const;
  void paintMarks(QPainter& painter) const;
  void paintKey(QPainter& painter, std::size_t series, QPointF centre) const;
  QColor colourOf(std::size_t series) const;
  const report::PlotPanel* panel() const { return plot_.panels.empty() ? nullptr : &plot_.panels.front(); }

  const report::Plot& plot_;
  QPalette palette_;
  report::PlotAxes axes_;
  QRectF inner_;
  std::vector<Label> labels_;  // labels of the ticks, and titles of the axes
};

/// Returns the mark of an algorithm as a square picture of `size` logical pixels.
QPixmap plotMark(Algorithm algorithm, bool hollow, int size, double devicePixelRatio, const QPalette& palette);

/// Filters of a save dialog for the formats of savePlot.
QStringList plotFilters();

/// Writes a plot with its legend, dark on white: as SVG or PDF if the path ends in .svg or .pdf, else as PNG. Throws
/// Error if the file cannot be written.
void savePlot(const report::Plot& plot, const QString& path);

}  // namespace chainmail
