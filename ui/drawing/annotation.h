#pragma once

#include <QColor>
#include <QFontMetricsF>
#include <QLineF>
#include <QSizeF>
#include <QString>

class QPainter;

namespace chainmail {

/// A line over the object of a view, with a text at its middle (logical pixels).
struct Annotation {
  QLineF line;
  QString words;
};

/// Returns the box behind the text: next to the line and inside the view.
QRectF annotationBox(const Annotation& annotation, const QFontMetricsF& font, QSizeF view);
/// Draws the ends of the line and the text, but not the line itself.
void drawAnnotation(QPainter& painter, const Annotation& annotation, QColor ground, QSizeF view);
inline constexpr double annotationPadding = 4;      // pixels between the text and the edge of its box
inline constexpr double annotationEndDiameter = 9;  // pixels, diameter of the rings at the ends of the line

}  // namespace chainmail
