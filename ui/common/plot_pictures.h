#pragma once

#include <QByteArray>
#include <QFont>
#include <QPalette>
#include <QPixmap>
#include <QStringList>

#include "report/page/svg.h"

namespace chainmail {

/// Returns the style of plots on a palette's background. Their marks have enough contrast to it.
report::SvgStyle plotStyle(const QPalette& palette, const QFont& font);

/// Returns a plot as an SVG drawing.
QByteArray plotDrawing(const report::Plot& plot, const report::SvgStyle& style);

/// Returns the mark of an algorithm as a square picture of `size` logical pixels.
QPixmap plotMark(Algorithm algorithm, bool hollow, int size, double devicePixelRatio, const QPalette& palette);

/// The size of a saved plot on paper: the usual one fits a column. Only PNG has dots.
struct PlotSize {
  double widthMm = 88, heightMm = 60;
  int dotsPerInch = 300;
};

/// Filters of a save dialog for the formats of savePlot.
QStringList plotFilters();

/// Writes a plot with its title and legend, dark on white: as SVG or PDF if the path ends in .svg or .pdf, else as PNG.
/// Throws Error if the file cannot be written.
void savePlot(const report::Plot& plot, const QString& path, const PlotSize& size = {});

}  // namespace chainmail
